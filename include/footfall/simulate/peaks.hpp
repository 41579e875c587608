// How deep and how hard each contact has pressed: at the ends of every step, and between them where a peak may be.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "footfall/math/value_of.hpp"
#include "footfall/simulate/recorder.hpp"
#include "footfall/solve/first_zero.hpp"
#include "footfall/solve/watcher.hpp"

namespace footfall {

/// Tells a recorder the peaks of indentation and normal force of a run, step by step.
template <class Hybrid>
class Peaks final : public Watcher<typename Hybrid::State> {
public:
    using S = typename Hybrid::S;
    using Value = ValueOf<S>;
    using State = typename Hybrid::State;

    Peaks(const Hybrid& hybrid, Recorder& recorder)
        : hybrid_(hybrid), recorder_(recorder), courses_(static_cast<std::size_t>(hybrid.contacts())) {}

    void begin(const State& y, const State& rate, const Value& piece) override { courses_at(y, rate, piece, courses_); }

    void step(const SolverStep<State>& step) override {
        if (hybrid_.in_flight()) return;
        courses_at(step.end(), step.end_rate(), step.piece(), next_);
        for (int i = 0; i < hybrid_.contacts(); ++i) {
            if (!hybrid_.touches(i)) continue;
            const Course &from = courses_[static_cast<std::size_t>(i)], &to = next_[static_cast<std::size_t>(i)];
            const Impact* impact = recorder_.impact(i);
            if (!impact) continue;
            const auto note = [&](const Value& share) { reach(step.at(share), i); };
            if (turns_above(from.force, to.force, step.size(), impact->peak_normal_force)) {
                const Value d(1e-4);  // of the step
                const auto force = [&](const Value& share) { return normal_force(step.at(share), i); };
                at_highest([&](const Value& share) { return force(share + d) - force(share - d); }, note);
            }
            if (turns_above(from.root_depth, to.root_depth, step.size(), std::sqrt(impact->peak_indentation)))
                at_highest([&](const Value& share) { return depth_rate(step.at(share), i); }, note);
        }
        std::swap(courses_, next_);
    }

private:
    struct Course {
        struct Quantity {
            Value value, rate;  // over sigma
        } root_depth, force;
    };

    // Whether a quantity turns from rising to falling in a step of size h, and may have been above `peak` there.
    static bool turns_above(const typename Course::Quantity& from, const typename Course::Quantity& to, const Value& h,
                            double peak) {
        return from.rate > Value(0) && !(to.rate > Value(0)) &&
               std::max(from.value, to.value) + (std::abs(from.rate) + std::abs(to.rate)) * std::abs(h) > Value(peak);
    }

    // How root depth and force of every contact change at y; notes where they are.
    void courses_at(const State& y, const State& rate, const Value& piece, std::vector<Course>& courses) {
        courses.resize(static_cast<std::size_t>(hybrid_.contacts()));
        if (hybrid_.in_flight()) return;
        const auto& plant = hybrid_.plant();
        const State soon = y + rate * S(piece);
        const auto motion = plant.motion(y), motion_soon = plant.motion(soon);
        for (int i = 0; i < hybrid_.contacts(); ++i) {
            if (!hybrid_.touches(i)) continue;
            const int root_depth = Hybrid::PlantType::root_depths + i;
            const Value force = normal_force(y, motion, i);
            courses[static_cast<std::size_t>(i)] = {{value_of(y[root_depth]), value_of(rate[root_depth])},
                                                    {force, (normal_force(soon, motion_soon, i) - force) / piece}};
            reach(value_of(y[root_depth]), force, i);
        }
    }

    void reach(const State& y, int i) { reach(value_of(y[Hybrid::PlantType::root_depths + i]), normal_force(y, i), i); }
    void reach(const Value& root_depth, const Value& force, int i) {
        recorder_.reached(i, static_cast<double>(root_depth * root_depth), static_cast<double>(force));
    }

    [[nodiscard]] Value depth_rate(const State& y, int i) const {
        return value_of(hybrid_.plant().depth_rate(hybrid_.plant().motion(y), i));
    }
    [[nodiscard]] Value normal_force(const State& y, int i) const {
        return normal_force(y, hybrid_.plant().motion(y), i);
    }
    [[nodiscard]] Value normal_force(const State& y, const typename Hybrid::Motion& motion, int i) const {
        if (!hybrid_.mode(i).loaded()) return Value(0);
        return value_of(hybrid_.law(i).normal_force(hybrid_.plant().touch(y, motion, i), hybrid_.states(y, i)));
    }

    // Calls `note` where a rate falls through zero inside the step.
    template <class Rate, class Note>
    static void at_highest(Rate&& rate, Note&& note) {
        const Value at_start = rate(Value(0)), at_end = rate(Value(1));
        if (!(at_start > Value(0)) || !(at_end < Value(0))) return;  // it is at an end, which is noted
        note(zero_between(rate, Value(0), Value(1), at_start, at_end, std::numeric_limits<Value>::digits / 2));
    }

    const Hybrid& hybrid_;
    Recorder& recorder_;
    std::vector<Course> courses_, next_;
};

}  // namespace footfall
