// What a system with nothing special about it answers a Solver: a base that leaves a system to say what is its own.
#pragma once

#include <limits>
#include <vector>

#include "footfall/math/value_of.hpp"

namespace footfall {

/// To derive from; what a system says itself hides what stands here. The clock runs with the independent variable,
/// each guard is a group of its own and is seen by the stages.
template <class Scalar>
struct PlainSystem {
    using S = Scalar;
    using Value = ValueOf<S>;

    static constexpr int guards_per_group = 1;
    static constexpr bool differentiates_along = false;
    static constexpr int longest_visit = 5;

    template <class State>
    void start(State&, std::vector<bool>&) noexcept {}

    [[nodiscard]] static constexpr bool uniform() noexcept { return true; }
    template <class State>
    [[nodiscard]] static constexpr Value longest_step(const State&) noexcept {
        return std::numeric_limits<Value>::max();
    }
    static void accepted(const Value&) noexcept {}
    static void stepped(const Value&) noexcept {}
    template <class State>
    static void tidy(State&, const Value&, const Value&) noexcept {}

    [[nodiscard]] static constexpr bool blind(int) noexcept { return false; }
    template <class State>
    [[nodiscard]] static constexpr Value approach(int, const State&) noexcept {
        return Value(0);
    }
    template <class State>
    [[nodiscard]] static constexpr bool approaches(int, const State&) noexcept {
        return true;
    }
    [[nodiscard]] static constexpr bool outranks(int, int) noexcept { return false; }
    [[nodiscard]] static constexpr bool quick(int) noexcept { return false; }
    [[nodiscard]] static constexpr bool may_wait(int) noexcept { return true; }
};

}  // namespace footfall
