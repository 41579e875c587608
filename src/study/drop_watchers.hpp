// What looks on at an impact: the force at given times, the force at given depths, and the cost.
//
// A watcher reads a state off the dense output at the place where a component has the number that is asked for. The
// place moves with the inputs of dual numbers; the state is moved along its rate to where the component keeps what is
// asked for.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "footfall/math/value_of.hpp"
#include "footfall/simulate/run.hpp"
#include "footfall/solve/first_zero.hpp"
#include "footfall/solve/watcher.hpp"
#include "study/drop_impact.hpp"

namespace footfall::study {

/// The state at a share of a step, moved to where component c is `wanted`. Where that component stands still its
/// derivatives have no limit; then the state is left without them.
template <class System>
[[nodiscard]] typename System::State read_at(const System& system, const SolverStep<typename System::State>& step,
                                             const typename System::Value& share, int c,
                                             const typename System::S& wanted) {
    using S = typename System::S;
    typename System::State y = step.at(share);
    if constexpr (!std::floating_point<S>) {
        using std::isfinite;
        typename System::State rate = y;
        system.evaluate(y, rate, nullptr);
        const S apart = wanted - y[c], moved = (apart - S(value_of(apart))) / S(value_of(rate[c]));
        if (isfinite(moved)) y += rate * moved;
    }
    return y;
}

/// The force at times since touchdown [s], in order; before touchdown and after the end it stays what it was.
template <class System>
class ForceAtTimes final : public Watcher<typename System::State> {
public:
    using S = typename System::S;
    using State = typename System::State;

    ForceAtTimes(const System& system, std::span<const S> times, std::span<S> forces)
        : system_(system), times_(times), forces_(forces) {
        while (next_ < times.size() && !(times[next_] > S(0))) ++next_;
    }

    void step(const SolverStep<State>& step) override {
        for (; next_ < times_.size() && value_of(times_[next_]) <= step.to(); ++next_) {
            const auto share = step.share_at(value_of(times_[next_]));
            forces_[next_] = system_.force(read_at(system_, step, share, system_.clock(), times_[next_]));
        }
    }

private:
    const System& system_;
    std::span<const S> times_;
    std::span<S> forces_;
    std::size_t next_ = 0;
};

/// The force at depths [m] on the way in or out.
template <class System>
class ForceAtDepths final : public Watcher<typename System::State> {
public:
    using S = typename System::S;
    using State = typename System::State;
    using Value = typename System::Value;

    ForceAtDepths(const System& system, std::span<const double> depths, std::span<const Branch> branches,
                  std::span<S> forces)
        : system_(system), depths_(depths), branches_(branches), forces_(forces) {}

    /// A depth that is deeper than the impact goes has the elastic force, which the others meet at the deepest point.
    void begin(const State& y, const State& /*rate*/, const Value& /*piece*/) override {
        if (begun_) return;
        begun_ = true;
        for (std::size_t i = 0; i < depths_.size(); ++i) forces_[i] = system_.force_at_rest(depths_[i], y);
    }
    void step(const SolverStep<State>& step) override {
        const auto rate = [&](const Value& share) { return step.value_at(share, System::Plant::velocity); };
        const Value first = value_of(step.start()[System::Plant::velocity]),
                    last = value_of(step.end()[System::Plant::velocity]);
        const Value deepest = !(first > Value(0)) ? Value(0)
                              : last >= Value(0)  ? Value(1)
                                                  : zero_between(rate, Value(0), Value(1), first, last);
        if (deepest > Value(0)) fill(step, Value(0), deepest, Branch::loading);
        if (deepest < Value(1)) fill(step, deepest, Value(1), Branch::unloading);
        left_at_ = value_of(step.end()[root]);
    }
    /// After the end of contact there is no force.
    void finish() {
        for (std::size_t i = 0; i < depths_.size(); ++i)
            if (branches_[i] == Branch::unloading && std::sqrt(depths_[i]) < left_at_) forces_[i] = S(0);
    }

private:
    static constexpr int root = System::Plant::root_depths;

    /// Between two shares of a step, where the depth is monotonous.
    void fill(const SolverStep<State>& step, const Value& from, const Value& to, Branch branch) {
        const Value at_from = step.value_at(from, root), at_to = step.value_at(to, root);
        for (std::size_t i = 0; i < depths_.size(); ++i) {
            const Value s = std::sqrt(depths_[i]);
            if (branches_[i] != branch || s < std::min(at_from, at_to) || s > std::max(at_from, at_to)) continue;
            const auto beyond = [&](const Value& share) { return step.value_at(share, root) - s; };
            const Value share = at_from == s ? from
                                : at_to == s ? to
                                             : zero_between(beyond, from, to, at_from - s, at_to - s,
                                                            std::numeric_limits<Value>::digits - 4);
            forces_[i] = system_.force(read_at(system_, step, share, root, S(s)));
        }
    }

    const System& system_;
    std::span<const double> depths_;
    std::span<const Branch> branches_;
    std::span<S> forces_;
    bool begun_ = false;
    Value left_at_{0};
};

/// Ends an impact that takes too many evaluations.
template <class State>
class DropBudget final : public Watcher<State> {
public:
    static constexpr std::int64_t most_evaluations = 65'000;  // 5000 explicit steps
    void look(const SolverCost& cost, const ValueOf<typename State::Scalar>& /*clock*/) override {
        if (cost.evaluations > most_evaluations) throw TooExpensive("the impact takes too many steps");
    }
};

}  // namespace footfall::study
