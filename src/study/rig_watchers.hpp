// What looks on while a rig is driven: samples and account, the largest forces, the swing of a mass, and its budget.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <fmt/format.h>

#include "footfall/simulate/budget.hpp"
#include "footfall/solve/first_zero.hpp"
#include "footfall/solve/watcher.hpp"
#include "study/rig_system.hpp"
#include "study/swing.hpp"

namespace footfall {

using RigWatcher = Watcher<RigSystem::State>;
using RigStep = SolverStep<RigSystem::State>;

/// Keeps samples, events and the account of a drive.
class RigRecording final : public RigWatcher {
public:
    using State = RigSystem::State;

    RigRecording(const Rig& rig, RigSystem& system) : rig_(rig), system_(system) { reserve_samples(); }

    void event(EventKind kind, const State& y) {
        const double needed = samples_bytes_ + static_cast<double>(result_.events.size()) * event_bytes;
        if (needed > rig_.max_memory)
            throw TooExpensive(fmt::format(
                "stopped at {:.6g} s: {} events take about {} of memory with the samples, more than the {} of "
                "max_memory; shorten the run, or raise max_memory",
                system_.time_at(y[RigSystem::clock()]), result_.events.size(), bytes_text(needed),
                bytes_text(rig_.max_memory)));
        const RigState state = system_.measure(y);
        result_.events.push_back({state.time, kind, state});
    }
    /// The run has ended at y.
    [[nodiscard]] Drive close(const State& y) {
        keep(y);
        result_.max_residual = result_.energy_scale > 0 ? largest_error_ / result_.energy_scale : 0;
        return std::move(result_);
    }

    void begin(const State& y, const State& /*rate*/, const double& /*piece*/) override {
        if (result_.samples.empty()) initial_balance_ = system_.energy(y).balance();
        account(y);
        if (result_.samples.empty()) take_until(system_.time_at(y[RigSystem::clock()]), [&](double) { return y; });
    }
    void step(const RigStep& step) override {
        const double until = std::min(system_.time_at(step.to()), rig_.end_time);
        // The last sample is the end itself, so one that rounding puts just before it is left out.
        const double last = rig_.end_time * (1 - 64 * std::numeric_limits<double>::epsilon());
        take_before(std::min(until, last), [&](double due) {
            const double theta = Timeline::theta_of(system_.interval(), due);
            State y = step.at(std::clamp((theta - step.from()) / (step.to() - step.from()), 0.0, 1.0));
            system_.relax(y, step.from(), theta);
            return y;
        });
    }
    void reach(const State& y) override { account(y); }

private:
    // A sample is kept, becomes a row of drive_table, and is written as text: as JSON, a number takes some 40
    // characters, and the text is there twice before it is printed.
    static constexpr double columns_of_table = 28;
    static constexpr double sample_bytes = sizeof(RigState) + columns_of_table * (sizeof(double) + 2 * 40);
    static constexpr double event_bytes = 2 * sizeof(RigEvent);  // a full list moves to a larger place

    void reserve_samples() {
        const double samples = sample_count(rig_.period(), rig_.end_time);
        samples_bytes_ = samples * sample_bytes;
        if (samples_bytes_ > rig_.max_memory)
            throw TooExpensive(
                fmt::format("{:.3g} samples would take about {} of memory, more than the {} of max_memory; choose a "
                            "longer sample period or a shorter run, or raise max_memory",
                            samples, bytes_text(samples_bytes_), bytes_text(rig_.max_memory)));
        result_.samples.reserve(static_cast<std::size_t>(samples));
    }
    [[nodiscard]] double due() const { return next_sample_ * rig_.period(); }
    template <class At>
    void take_until(double time, At&& at) {
        for (; due() <= time; ++next_sample_) keep(at(due()));
    }
    template <class At>
    void take_before(double time, At&& at) {
        for (; due() < time; ++next_sample_) keep(at(due()));
    }
    void keep(const State& y) { result_.samples.push_back(system_.measure(y)); }

    void account(const State& y) {
        const RigEnergy energy = system_.energy(y);
        result_.energy_scale = std::max(result_.energy_scale, energy.magnitude());
        largest_error_ = std::max(largest_error_, std::abs(energy.balance() - initial_balance_));
        system_.see_energy(result_.energy_scale);
    }

    const Rig& rig_;
    RigSystem& system_;
    Drive result_;
    double next_sample_ = 0;
    double samples_bytes_ = 0;
    double initial_balance_ = 0, largest_error_ = 0;
};

/// Ends a drive that its caller or its budget no longer wants, or that does not come on.
class RigBudget final : public RigWatcher {
public:
    RigBudget(const Rig& rig, const RigSystem& system) : rig_(rig), system_(system) {}

    void look(const SolverCost& cost, const double& clock) override {
        ask(rig_.go_on);
        if (static_cast<double>(cost.evaluations) > rig_.max_evaluations)
            throw TooExpensive(fmt::format("stopped at {:.6g} s: max_evaluations = {:.3g} is spent",
                                           system_.time_at(clock), rig_.max_evaluations));
        if (cost.steps > steps_) {
            steps_ = cost.steps;
            since_ = cost.evaluations;
        }
        constexpr std::int64_t patience = 20'000;  // evaluations, refused steps of all sizes
        if (cost.evaluations > since_ + patience)
            throw TooExpensive(
                fmt::format("stopped at {:.6g} s: no step is small enough for the tolerance", system_.time_at(clock)));
    }

private:
    const Rig& rig_;
    const RigSystem& system_;
    std::int64_t steps_ = 0, since_ = 0;
};

/// Tells the swing of a mass where it turns and when it goes with the belt.
class SwingWatcher final : public RigWatcher {
public:
    using State = RigSystem::State;

    SwingWatcher(const RigSystem& system, Swing& swing) : system_(system), swing_(swing) {}

    void step(const RigStep& step) override {
        if (!swing_.watches() || !(step.to() > step.from())) return;
        look_for_turn(step);
        look_for_stick(step);
    }

private:
    [[nodiscard]] double time_at(const RigStep& step, double share) const {
        return system_.time_at(std::lerp(step.from(), step.to(), share));
    }
    [[nodiscard]] Vector2<double> slip(const State& y) const { return system_.hybrid().touch(y, 0).slip; }

    void look_for_turn(const RigStep& step) {
        const auto rate = [&](const State& y) {
            return swing_.rate(system_.plant().motion(y).velocity, system_.instant(y));
        };
        const double before = rate(step.start()), after = rate(step.end());
        if ((before > 0) == (after > 0)) return;
        const State y =
            step.at(zero_between([&](double share) { return rate(step.at(share)); }, 0.0, 1.0, before, after));
        const Instant now = system_.instant(y);
        swing_.turn(now.time, swing_.deflection(system_.plant().motion(y).position, now), before > 0);
    }

    /// The time with the belt: in the phase stick, or slower than a share of the belt's speed under a law without one.
    void look_for_stick(const RigStep& step) {
        if (system_.law().knows_stick()) {
            if (system_.mode().phase == Phase::stick) swing_.with_belt(time_at(step, 0), time_at(step, 1));
            return;
        }
        const Vector2<double> at_start = slip(step.start()), at_end = slip(step.end());
        const double first = at_start.norm() - swing_.slow(), last = at_end.norm() - swing_.slow();
        if (first < 0 && last < 0) {
            swing_.with_belt(time_at(step, 0), time_at(step, 1));
            return;
        }
        // Slow inside a step that is fast at both ends: where the slip velocity, on its way from one to the other, is
        // nearest to zero.
        const Vector2<double> way = at_end - at_start;
        const bool passes = at_start.dot(way) < 0 && at_end.dot(way) > 0;
        if (first >= 0 && last >= 0 && !passes) return;
        const auto fast = [&](double share) { return slip(step.at(share)).norm() - swing_.slow(); };
        const auto part = [&](double a, double b, double f_a, double f_b) {
            if (f_a >= 0 && f_b >= 0) return;
            if ((f_a < 0) != (f_b < 0)) (f_a < 0 ? b : a) = zero_between(fast, a, b, f_a, f_b);
            swing_.with_belt(time_at(step, a), time_at(step, b));
        };
        if (!passes) return part(0, 1, first, last);
        const double nearest = zero_between([&](double share) { return slip(step.at(share)).dot(way); }, 0.0, 1.0,
                                            at_start.dot(way), at_end.dot(way));
        const double least = fast(nearest);
        part(0, nearest, first, least);
        part(nearest, 1, least, last);
    }

    const RigSystem& system_;
    Swing& swing_;
};

}  // namespace footfall
