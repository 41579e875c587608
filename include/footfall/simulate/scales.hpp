// How large each quantity of a run is: what its error is relative to.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Eigenvalues>

#include "footfall/body/body.hpp"
#include "footfall/math/value_of.hpp"

namespace footfall {

/// The natural size of every component of the state, from the largest mechanical energy E that the run has seen: for
/// each contact the depth z* that would store E in its normal spring, the speed v* = sqrt(2E/m); positions and times,
/// which no force depends on, are measured by the sphere's radius r and r/v*. A tolerance is relative to these, so it
/// means the same for a grain and for a boulder, and nothing is resolved relative to a quantity that happens to pass
/// zero.
template <class Hybrid>
class Scales {
public:
    using S = typename Hybrid::S;
    using Value = ValueOf<S>;
    using State = typename Hybrid::State;

    Scales(const Hybrid& hybrid, const Body& body, const Eigen::Vector3d& gravity, double tolerance)
        : mass_(body.mass), tolerance_(tolerance) {
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> moments(body.inertia, Eigen::EigenvaluesOnly);
        largest_moment_ = moments.eigenvalues().maxCoeff();
        for (const Sphere& sphere : body.spheres) radius_ = std::max(radius_, sphere.radius);
        const auto contacts = static_cast<std::size_t>(hybrid.contacts());
        root_depth_.assign(contacts, 1.0);
        bristle_seen_.assign(contacts, 0.0);
        // Standing still, the body sinks in until the springs carry it: the least energy that matters.
        const double weight = mass_ * gravity.norm();
        if (weight > 0) {
            for (int i = 0; i < hybrid.contacts(); ++i)
                static_depth_ = std::max(static_depth_, square(hybrid.law(i).root_depth_under(weight)));
            see_energy(hybrid, weight * static_depth_);
        }
    }

    /// Takes note of the energy of motion and springs, and of the bristles.
    void see(const Hybrid& hybrid, const State& y, double mechanical_energy) {
        if (mechanical_energy > 1.1 * energy_) see_energy(hybrid, mechanical_energy);
        for (int i = 0; i < hybrid.contacts(); ++i) {
            double& seen = bristle_seen_[static_cast<std::size_t>(i)];
            const auto u = hybrid.law(i).bristle(hybrid.states(y, i));
            const double ux = as_double(u.x()), uy = as_double(u.y());
            seen = std::max(seen, std::sqrt(ux * ux + uy * uy));
        }
    }

    /// z* [m] and its root, of the stiffest contact.
    [[nodiscard]] double depth() const noexcept { return square(root_depth()); }
    [[nodiscard]] double root_depth() const noexcept {
        return *std::min_element(root_depth_.begin(), root_depth_.end());
    }
    /// v* [m/s].
    [[nodiscard]] double speed() const noexcept { return speed_; }
    /// How deep the body sinks in at rest, on its softest contact alone [m]; 0 without gravity.
    [[nodiscard]] double static_depth() const noexcept { return static_depth_; }

    /// One over the error that is allowed in each component of y.
    template <class Weights>
    void weights(const Hybrid& hybrid, const State& y, Weights& weight) const {
        using Plant = typename Hybrid::PlantType;
        weight.resize(y.size());
        const auto set = [&](int first, int count, double size) {
            for (int c = first; c < first + count; ++c) weight[c] = Value(1 / allowed(size, y[c]));
        };
        set(Plant::velocity, 3, speed_);
        set(Plant::momentum, 3, speed_ * std::sqrt(mass_ * largest_moment_));
        set(Plant::orientation, 4, 1.0);
        set(hybrid.follow(), Plant::follows, radius_);
        set(hybrid.clock(), 1, radius_ / speed_);
        for (int i = 0; i < hybrid.contacts(); ++i) {
            const double s = root_depth_[static_cast<std::size_t>(i)];
            const auto& law = hybrid.law(i);
            set(Plant::root_depths + i, 1, s);
            for (int k = 0; k < law.states(); ++k) {
                double size = law.state_size(k, S(s));
                if (law.sized_by_what_is_seen(k)) size = std::max(size, bristle_seen_[static_cast<std::size_t>(i)]);
                set(hybrid.first_state(i) + k, 1, size);
            }
            set(hybrid.taken(i), taken_channels, energy_);
        }
    }

private:
    static double square(double x) noexcept { return x * x; }
    static double as_double(const S& x) noexcept { return static_cast<double>(value_of(x)); }

    [[nodiscard]] double allowed(double size, const S& value) const {
        // No error can be smaller than the rounding of the number itself.
        const double rounding =
            8 * static_cast<double>(std::numeric_limits<Value>::epsilon() * std::abs(value_of(value)));
        return std::max({tolerance_ * size, rounding, std::numeric_limits<double>::min()});
    }

    void see_energy(const Hybrid& hybrid, double energy) {
        energy_ = energy;
        speed_ = std::sqrt(2 * energy / mass_);
        for (int i = 0; i < hybrid.contacts(); ++i)
            root_depth_[static_cast<std::size_t>(i)] = hybrid.law(i).root_depth_holding(energy);
    }

    double mass_, tolerance_;
    double largest_moment_ = 0, radius_ = 0;
    double static_depth_ = 0;
    double energy_ = 0, speed_ = 1;
    std::vector<double> root_depth_, bristle_seen_;
};

}  // namespace footfall
