// How large each quantity of a run is: what its error is relative to.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include <Eigen/Eigenvalues>

#include "footfall/simulate/system.hpp"

namespace footfall {

/// The natural size of every component of the state, from the largest mechanical energy E that the run has seen:
/// the depth z* that would store E in one normal spring, the speed v* = sqrt(2E/m); positions and times, which no
/// force depends on, are measured by the sphere's radius r and r/v*. A tolerance is relative to these, so it means the
/// same for a grain and for a boulder, and nothing is resolved relative to a quantity that happens to pass zero.
template <class System>
class Scales {
public:
    using S = typename System::S;
    using StateVector = typename System::StateVector;
    using Layout = std::remove_cvref_t<decltype(std::declval<System>().layout())>;

    Scales(const System& system, const Body& body, const Eigen::Vector3d& gravity, double tolerance)
        : system_(&system), mass_(body.mass), tolerance_(tolerance) {
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> moments(body.inertia, Eigen::EigenvaluesOnly);
        largest_moment_ = moments.eigenvalues().maxCoeff();
        for (const Sphere& sphere : body.spheres) radius_ = std::max(radius_, sphere.radius);
        bristle_seen_.assign(body.spheres.size(), 0.0);
        // Standing still, the body sinks in until the springs carry it: the least energy that matters.
        const double weight = mass_ * gravity.norm();
        if (weight > 0) {
            const double s = solve([&](double x) { return elastic_force(x); }, weight);
            static_depth_ = s * s;
            see_energy(weight * static_depth_);
        }
    }

    /// Takes note of the energy of motion and springs, and of the bristles.
    void see(const StateVector& y, double mechanical_energy) {
        if (mechanical_energy > 1.1 * energy_) see_energy(mechanical_energy);
        for (int i = 0; i < system_->spheres(); ++i)
            bristle_seen_[static_cast<std::size_t>(i)] = std::max(bristle_seen_[static_cast<std::size_t>(i)],
                                                                  static_cast<double>(system_->bristle(y, i).norm()));
    }

    /// z* [m], its root, v* [m/s].
    [[nodiscard]] double depth() const noexcept { return depth_; }
    [[nodiscard]] double root_depth() const noexcept { return std::sqrt(depth_); }
    [[nodiscard]] double speed() const noexcept { return speed_; }

    /// How deep the body sinks in at rest, on one sphere [m]; 0 without gravity.
    [[nodiscard]] double static_depth() const noexcept { return static_depth_; }

    /// One over the error that is allowed in each component of y.
    void weights(const StateVector& y, StateVector& weight) const {
        const auto& layout = system_->layout();
        weight.resizeLike(y);
        const auto set = [&](int first, int count, double size) {
            for (int c = first; c < first + count; ++c) weight[c] = S(1.0 / allowed(size, y[c]));
        };
        set(layout.position(), 3, radius_);
        set(Layout::velocity, 3, speed_);
        set(Layout::momentum, 3, speed_ * std::sqrt(mass_ * largest_moment_));
        set(Layout::orientation, 4, 1.0);
        set(layout.time(), 1, radius_ / speed_);
        for (int i = 0; i < layout.spheres; ++i) {
            set(layout.root_depth(i), 1, std::sqrt(depth_));
            if constexpr (System::LawType::has_states) {
                for (int k = 0; k < layout.friction_states; ++k)
                    set(layout.bristle(i) + k, 1, system_->law(i).friction.state_size(k));
            } else {
                set(layout.bristle(i), 2, std::max(bristle_seen_[static_cast<std::size_t>(i)], bristle_floor_));
            }
            set(layout.ledger(i), Layout::ledger_per_contact, energy_);
        }
    }

private:
    [[nodiscard]] double allowed(double size, const S& value) const {
        // No error can be smaller than the rounding of the number itself.
        const double rounding = 8 * static_cast<double>(std::numeric_limits<S>::epsilon() * abs_(value));
        return std::max({tolerance_ * size, rounding, std::numeric_limits<double>::min()});
    }
    static S abs_(const S& x) { return x < S(0) ? S(-x) : x; }

    [[nodiscard]] double elastic_force(double s) const {
        return static_cast<double>(system_->law(0).normal.force(S(s), S(0)).elastic);
    }
    [[nodiscard]] double stored(double s) const {
        return static_cast<double>(system_->law(0).normal.stored_energy(S(s)));
    }

    void see_energy(double energy) {
        energy_ = energy;
        speed_ = std::sqrt(2 * energy / mass_);
        const double s = solve([&](double x) { return stored(x); }, energy);
        depth_ = s * s;
        bristle_floor_ = 1e-2 * depth_;
        if constexpr (System::LawType::has_clutch) {
            const auto& friction = system_->law(0).friction;
            const double cone = static_cast<double>(friction.coefficient) * elastic_force(s) /
                                static_cast<double>(friction.stiffness * friction.scale(S(s)));
            if (cone > 0) bristle_floor_ = std::min(bristle_floor_, 1e-1 * cone);
        }
    }

    /// The s > 0 at which an increasing function reaches a value > 0, to a few digits.
    template <class F>
    [[nodiscard]] static double solve(F&& f, double value) {
        double low = -140, high = 140;  // log of s
        for (int k = 0; k < 40; ++k) {
            const double middle = 0.5 * (low + high);
            (f(std::exp(middle)) < value ? low : high) = middle;
        }
        return std::exp(0.5 * (low + high));
    }

    const System* system_;
    double mass_, tolerance_;
    double largest_moment_ = 0, radius_ = 0;
    double static_depth_ = 0;
    double energy_ = 0, depth_ = 1, speed_ = 1, bristle_floor_ = 1;
    std::vector<double> bristle_seen_;
};

}  // namespace footfall
