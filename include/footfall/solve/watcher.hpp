// What may look on while a Solver works: at its start, after every step, and now and then by the evaluations spent.
#pragma once

#include <cstdint>

#include "footfall/math/value_of.hpp"

namespace footfall {

/// What a solver has spent.
struct SolverCost {
    std::int64_t steps = 0;        ///< accepted
    std::int64_t rejected = 0;     ///< rejected for their error
    std::int64_t evaluations = 0;  ///< of the equations, those for Jacobians included
    std::int64_t stiff_steps = 0;  ///< those of `steps` that the implicit method took
};

/// A step that has been taken, inside one mode: from `start` to `end` as the method has them.
template <class State>
class SolverStep {
public:
    using S = typename State::Scalar;
    using Value = ValueOf<S>;

    virtual ~SolverStep() = default;
    [[nodiscard]] virtual const State& start() const = 0;
    [[nodiscard]] virtual const State& end() const = 0;
    [[nodiscard]] virtual State start_rate() const = 0;
    [[nodiscard]] virtual State end_rate() const = 0;
    /// Of the step, over the independent variable.
    [[nodiscard]] virtual Value size() const = 0;
    /// A small part of the next step.
    [[nodiscard]] virtual Value piece() const = 0;
    /// The state at a share of the step, 0 to 1.
    [[nodiscard]] virtual State at(const Value& share) const = 0;
    /// The number that one component has there.
    [[nodiscard]] virtual Value value_at(const Value& share, int component) const = 0;
    /// The share of the step at which the clock shows a time within it.
    [[nodiscard]] virtual Value share_at(const Value& time) const = 0;
    /// The clock at the step's ends.
    [[nodiscard]] virtual Value from() const = 0;
    [[nodiscard]] virtual Value to() const = 0;
};

template <class State>
class Watcher {
public:
    virtual ~Watcher() = default;
    /// Steps in new modes begin at y, whose rate is given; `piece` is a small part of the next step.
    virtual void begin(const State& /*y*/, const State& /*rate*/, const ValueOf<typename State::Scalar>& /*piece*/) {}
    virtual void step(const SolverStep<State>& /*step*/) {}
    /// The step's end as it is kept, and as the next begins.
    virtual void reach(const State& /*y*/) {}
    /// Now and then, by evaluations. May throw, which ends the work.
    virtual void look(const SolverCost& /*cost*/, const ValueOf<typename State::Scalar>& /*clock*/) {}
};

}  // namespace footfall
