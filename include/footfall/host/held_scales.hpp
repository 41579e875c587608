// How large each quantity of a host's step is: what its error is relative to.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "footfall/math/value_of.hpp"
#include "footfall/plant/held.hpp"

namespace footfall {

/// The root depth at which a contact's spring holds an energy, looked up: between the knots of the table it is a power
/// of the energy, which is exact for most laws.
class RootDepthTable {
public:
    template <class Law>
    explicit RootDepthTable(const Law& law) {
        for (std::size_t k = 0; k < knots; ++k)
            log_root_depth_[k] = std::log(law.root_depth_holding(std::exp(lowest + spacing * static_cast<double>(k))));
    }
    [[nodiscard]] double operator()(double energy) const noexcept {
        if (!(energy > 0)) return 0;
        const double at = std::clamp((std::log(energy) - lowest) / spacing, 0.0, static_cast<double>(knots - 1));
        const auto k = std::min(static_cast<std::size_t>(at), knots - 2);
        const double share = at - static_cast<double>(k);
        return std::exp((1 - share) * log_root_depth_[k] + share * log_root_depth_[k + 1]);
    }

private:
    static constexpr std::size_t knots = 25;
    static constexpr double lowest = -60, spacing = 4;  // of the logarithm of an energy in J: 1e-26 to 4e15
    std::array<double, knots> log_root_depth_{};
};

/// From the energy E that motion and springs have at the step's start: for each contact the velocity that E would give
/// it, and the root depth that its spring would hold E at, or that it can reach within the step where that is less.
/// What a host gives decides, nothing that was before: the same step has the same result.
class HeldScales {
public:
    explicit HeldScales(std::size_t contacts) : compliance_(contacts), speed_(contacts), root_depth_(contacts) {}

    /// `held_normal(i, s)` is what the spring of contact i holds at s [J], `holding(i, E)` the root depth that it holds
    /// E at; dt in [s].
    template <class Given, class HeldNormal, class Holding>
    void measure(const HeldStep<Given>& step, double dt, HeldNormal&& held_normal, Holding&& holding) {
        dt_ = dt;
        const std::size_t n = speed_.size();
        const auto size_of = [](const std::vector<Given>& of, std::size_t i) {
            const auto x = [&](std::size_t k) { return static_cast<double>(value_of(of[3 * i + k])); };
            return std::sqrt(x(0) * x(0) + x(1) * x(1) + x(2) * x(2));
        };
        energy_ = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const auto diagonal = [&](std::size_t k) {
                return static_cast<double>(value_of(step.delassus[(3 * i + k) * 3 * n + 3 * i + k]));
            };
            compliance_[i] = std::max({diagonal(0), diagonal(1), diagonal(2)});
            const double gained = size_of(step.acceleration, i) * dt;
            speed_[i] = size_of(step.velocity, i) + gained;
            if (depth(step, i) > 0) energy_ += held_normal(i, std::sqrt(depth(step, i)));
            if (compliance_[i] > 0) energy_ += 0.5 * speed_[i] * speed_[i] / compliance_[i];
        }
        double most = 0;
        for (std::size_t i = 0; i < n; ++i) {
            speed_[i] = std::max(speed_[i], std::sqrt(2 * compliance_[i] * energy_));
            const double deep = std::max(depth(step, i), 0.0), reach = std::sqrt(deep + speed_[i] * dt);
            root_depth_[i] = compliance_[i] > 0 ? std::min(holding(i, energy_), reach) : reach;
            root_depth_[i] = std::max({root_depth_[i], std::sqrt(deep), least});
            most = std::max(most, held_normal(i, root_depth_[i]));
            speed_[i] = std::max(speed_[i], least);
        }
        if (!(energy_ > 0)) energy_ = std::max(most, least);  // prescribed motions
    }

    [[nodiscard]] double energy() const noexcept { return energy_; }
    [[nodiscard]] double speed(int i) const noexcept { return speed_[static_cast<std::size_t>(i)]; }
    [[nodiscard]] double root_depth(int i) const noexcept { return root_depth_[static_cast<std::size_t>(i)]; }
    [[nodiscard]] double impulse(int i) const noexcept { return energy_ / speed(i); }
    [[nodiscard]] double dt() const noexcept { return dt_; }
    /// The largest of D's diagonal for contact i [1/kg].
    [[nodiscard]] double compliance(int i) const noexcept { return compliance_[static_cast<std::size_t>(i)]; }

private:
    static constexpr double least = 1e-100;  // so that nothing is divided by zero
    template <class Given>
    [[nodiscard]] static double depth(const HeldStep<Given>& step, std::size_t i) {
        return static_cast<double>(value_of(step.depth[i]));
    }

    double dt_ = 0, energy_ = 0;
    std::vector<double> compliance_, speed_, root_depth_;
};

}  // namespace footfall
