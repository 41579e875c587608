// The largest normal and friction force of a drive: at the ends of every step, and between them where one may be.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/rig_watchers.hpp"

namespace footfall {

class ForcePeaks final : public RigWatcher {
public:
    using State = RigSystem::State;

    explicit ForcePeaks(const RigSystem& system) : system_(system) {}

    void begin(const State& y, const State& rate, const double& piece) override {
        const double inside = std::min(piece, (1 - y[RigSystem::clock()]) / 2);  // of the interval
        if (!(inside > 0)) return;
        const Forces now = reached(y);
        start_ = {now, slope(now, forces(y + rate * inside), inside)};
    }

    void step(const RigStep& step) override {
        const double size = step.size(), piece = piece_of_step * size;
        if (!(size > 0)) return;
        const Course from = start_;
        const Forces now = reached(step.end());
        start_ = {now, slope(forces(step.end() - step.end_rate() * piece), now, piece)};
        look(step, from, &Forces::normal);
        look(step, from, &Forces::friction);
    }

    [[nodiscard]] double largest_normal() const noexcept { return largest_.normal; }      ///< [N]
    [[nodiscard]] double largest_friction() const noexcept { return largest_.friction; }  ///< [N]

private:
    struct Forces {
        double normal = 0, friction = 0;
    };
    struct Course {
        Forces value, rate;
    };
    static constexpr double piece_of_step = 1e-4;

    [[nodiscard]] Forces forces(const State& y) const {
        const Push<double> push = system_.contact(y).response.push;
        return {push.normal, push.friction.norm()};
    }
    Forces reached(const State& y) {
        const Forces f = forces(y);
        // Below this a force is what is left of one at the surface itself, where the depth is kept from being zero.
        constexpr double nothing = 1e-90;
        if (f.normal > nothing) largest_.normal = std::max(largest_.normal, f.normal);
        largest_.friction = std::max(largest_.friction, f.friction);
        return f;
    }
    static Forces slope(const Forces& before, const Forces& after, double over) {
        return {(after.normal - before.normal) / over, (after.friction - before.friction) / over};
    }

    // Where a force turns from rising to falling inside the step and may have been above the largest so far.
    void look(const RigStep& step, const Course& from, double Forces::*which) {
        const Course& to = start_;
        if (!(from.rate.*which > 0) || to.rate.*which > 0) return;
        const double reachable = std::max(from.value.*which, to.value.*which) +
                                 (std::abs(from.rate.*which) + std::abs(to.rate.*which)) * step.size();
        if (!(reachable > largest_.*which)) return;
        const auto force = [&](double share) { return forces(step.at(std::clamp(share, 0.0, 1.0))).*which; };
        const auto rise = [&](double share) { return force(share + piece_of_step) - force(share - piece_of_step); };
        const double at_start = rise(0), at_end = rise(1);
        if (!(at_start > 0) || !(at_end < 0)) return;                    // it is at an end, which has been seen
        constexpr int digits = std::numeric_limits<double>::digits / 2;  // a maximum's place is known to no more
        (void)reached(step.at(zero_between(rise, 0.0, 1.0, at_start, at_end, digits)));
    }

    const RigSystem& system_;
    Course start_;
    Forces largest_;
};

}  // namespace footfall
