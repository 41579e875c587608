// How deep and how hard each contact has pressed: at the ends of every step, and between them where a peak may be.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <boost/math/tools/toms748_solve.hpp>

#include "footfall/simulate/recorder.hpp"

namespace footfall {

/// Tells a recorder the peaks of indentation and normal force of a run, step by step.
template <class System>
class Peaks {
public:
    using S = typename System::S;
    using StateVector = typename System::StateVector;

    /// The steps that follow start at y, whose rate over sigma is given; `small` is a piece of a step.
    void begin(const System& system, const StateVector& y, const StateVector& rate, const S& small,
               Recorder& recorder) {
        courses_.resize(static_cast<std::size_t>(system.spheres()));
        for (int i = 0; i < system.spheres(); ++i)
            if (system.touches(i)) go_on(system, y, rate, small, i, recorder);
    }

    /// The method has taken a step. `prepare` readies its interpolant.
    template <class Method, class Prepare>
    void pass(const System& system, const Method& method, const S& small, Recorder& recorder, Prepare&& prepare) {
        for (int i = 0; i < system.spheres(); ++i) {
            if (!system.touches(i)) continue;
            const Course from = courses_[static_cast<std::size_t>(i)];
            const Course to = go_on(system, method.end(), method.end_rate(), small, i, recorder);
            const Impact* impact = recorder.impact(i);
            if (!impact) continue;
            const auto note = [&](const S& theta) { reach(system, method.at(theta), i, recorder); };
            if (turns_above(from.force, to.force, method.size(), impact->peak_normal_force)) {
                prepare();
                const S d(1e-4);  // of the step
                const auto force = [&](const S& theta) { return normal_force(system, method.at(theta), i); };
                at_highest([&](const S& theta) { return force(theta + d) - force(theta - d); }, note);
            }
            if (turns_above(from.root_depth, to.root_depth, method.size(), std::sqrt(impact->peak_indentation))) {
                prepare();
                at_highest([&](const S& theta) { return depth_rate(system, method.at(theta), i); }, note);
            }
        }
    }

private:
    struct Course {
        struct Quantity {
            S value, rate;  // over sigma
        } root_depth, force;
    };

    // Whether a quantity turns from rising to falling in a step of size h, and may have been above `peak` there.
    static bool turns_above(const typename Course::Quantity& from, const typename Course::Quantity& to, const S& h,
                            double peak) {
        using std::abs;
        return from.rate > S(0) && !(to.rate > S(0)) &&
               std::max(from.value, to.value) + (abs(from.rate) + abs(to.rate)) * abs(h) > S(peak);
    }

    Course go_on(const System& system, const StateVector& y, const StateVector& rate, const S& small, int i,
                 Recorder& recorder) {
        Course& course = courses_[static_cast<std::size_t>(i)];
        const int root_depth = system.layout().root_depth(i);
        const S force = normal_force(system, y, i);
        course = {{y[root_depth], rate[root_depth]},
                  {force, (normal_force(system, y + rate * small, i) - force) / small}};
        reach(y[root_depth], force, i, recorder);
        return course;
    }

    static void reach(const System& system, const StateVector& y, int i, Recorder& recorder) {
        reach(y[system.layout().root_depth(i)], normal_force(system, y, i), i, recorder);
    }
    static void reach(const S& root_depth, const S& force, int i, Recorder& recorder) {
        recorder.reached(i, static_cast<double>(root_depth * root_depth), static_cast<double>(force));
    }

    [[nodiscard]] static S depth_rate(const System& system, const StateVector& y, int i) {
        return system.kinematics(system.motion(y), i).depth_rate;
    }
    [[nodiscard]] static S normal_force(const System& system, const StateVector& y, int i) {
        if (system.phase(i) == Phase::recovering) return S(0);
        return system.law(i).normal.force(y[system.layout().root_depth(i)], depth_rate(system, y, i)).total();
    }

    // Calls `note` where a rate falls through zero inside the step.
    template <class Rate, class Note>
    static void at_highest(Rate&& rate, Note&& note) {
        const S at_start = rate(S(0)), at_end = rate(S(1));
        if (!(at_start > S(0)) || !(at_end < S(0))) return;  // it is at an end, which is noted
        std::uintmax_t iterations = 50;
        const auto zero = boost::math::tools::toms748_solve(
            rate, S(0), S(1), at_start, at_end,
            boost::math::tools::eps_tolerance<S>(std::numeric_limits<S>::digits / 2), iterations);
        note((zero.first + zero.second) / S(2));
    }

    std::vector<Course> courses_;
};

}  // namespace footfall
