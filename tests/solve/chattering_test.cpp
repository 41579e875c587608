// Events that come ever faster, or on the spot: the solver finds each where it can, and never hangs.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "solve/followed.hpp"

namespace footfall {
namespace {

using test::bounce_time, test::BouncingPoint, test::follow, test::Followed;

constexpr double gravity = 9.81, restitution = 0.5, height = 1;

/// When the bounces come to an end: their times are a geometric series.
double zeno_time() { return std::sqrt(2 * height / gravity) * (1 + restitution) / (1 - restitution); }

TEST(Chattering, BouncesUpToJustBeforeTheirEndAreAllAtTheirTimes) {
    Followed<BouncingPoint, double> point({gravity, restitution});
    const double end = zeno_time() * (1 - 1e-10);
    SolverCost cost;
    follow(point, {height, 0}, end, &cost);
    int bounces = 0;
    while (bounce_time(gravity, restitution, height, bounces) < end) ++bounces;
    EXPECT_EQ(static_cast<int>(point.events.size()), bounces);
    EXPECT_GT(bounces, 30);
    for (int k = 0; k < std::min(bounces, static_cast<int>(point.events.size())); ++k)
        EXPECT_NEAR(point.events[static_cast<std::size_t>(k)].time, bounce_time(gravity, restitution, height, k), 2e-14)
            << "bounce " << k;
    EXPECT_LT(cost.evaluations, 100 * bounces);
}

// A mode that lasts no longer than the moment is left alone for a moment; the point falls through the floor by as much
// as it does in that.
TEST(Chattering, BouncesThatHaveComeToAnEndStallAndTimeGoesOn) {
    Followed<BouncingPoint, double> point({gravity, restitution});
    point.short_time = 1e-6;
    const double end = zeno_time() + 1e-3;
    const auto y = follow(point, {height, 0}, end);
    EXPECT_EQ(y[point.clock()], end);
    EXPECT_LT(std::abs(y[0]), 1e-10);
    EXPECT_LT(std::abs(y[1]), 1e-4);
    EXPECT_LT(point.events.size(), 20'000u);
}

/// A component that a relay pulls to zero. The mode is the relay's, +1 or -1; it switches `hysteresis` beyond zero.
template <class S>
struct Relay {
    static constexpr int motion = 1, guards = 1;
    S hysteresis;

    template <class T>
    void flow(int mode, const T*, T* rate) const {
        rate[0] = T(-mode);
    }
    template <class T>
    void look(int mode, const T* y, T* out) const {
        out[0] = mode * y[0] + T(hysteresis);
    }
    int jump(int, int mode, S*) const { return -mode; }
    template <class T>
    [[nodiscard]] Relay<T> over() const {
        return {T(value_of(hysteresis))};
    }
};

TEST(Chattering, ARelayWithHysteresisSwitchesAtItsTimes) {
    Followed<Relay, double> relay({0.1});
    relay.mode = 1;
    const auto y = follow(relay, {1}, 10);
    // At 1.1 for the first time, then every 0.2.
    ASSERT_EQ(relay.events.size(), 45u);
    for (std::size_t k = 0; k < relay.events.size(); ++k)
        EXPECT_NEAR(relay.events[k].time, 1.1 + 0.2 * static_cast<double>(k), 1e-14 * static_cast<double>(k + 2)) << k;
    EXPECT_NEAR(y[0], relay.mode == 1 ? 0.1 - (10 - 9.9) : -0.1 + (10 - 9.9), 1e-12);
}

TEST(Chattering, ARelayWithoutHysteresisStaysAtItsBorderAndEnds) {
    Followed<Relay, double> relay({0});
    relay.mode = 1;
    relay.short_time = 1e-3;
    SolverCost cost;
    const auto y = follow(relay, {1}, 3, &cost);
    EXPECT_EQ(y[relay.clock()], 3);
    EXPECT_NEAR(relay.events.front().time, 1, 1e-15);
    for (const auto& event : relay.events) EXPECT_LT(std::abs(event.state[0]), 2e-3);
    EXPECT_LT(std::abs(y[0]), 2e-3);
    EXPECT_GT(relay.events.size(), 1000u);  // it does look again after each wait
    EXPECT_LT(cost.evaluations, 2'000'000);
}

// An event where a step starts leaves that step no length, which the implicit method divides by.
TEST(Chattering, EndsUnderTheImplicitMethodAsWell) {
    using System = Followed<Relay, double>;
    System relay({0});
    relay.mode = 1;
    relay.short_time = 1e-3;
    Solver<System> solver(relay);
    solver.stay_implicit();
    solver.run(test::from<System>({1}), 3);
    EXPECT_EQ(solver.state()[relay.clock()], 3);
    for (const auto& event : relay.events) EXPECT_LT(std::abs(event.state[0]), 2e-3);
    EXPECT_LT(solver.cost().evaluations, 4'000'000);
}

// A guard may be left alone for a moment only: the step that is taken without it must not go on for longer.
TEST(Chattering, AGuardThatWaitsIsLookedAtAgainWithinItsMoment) {
    Followed<Relay, double> relay({0});
    relay.mode = 1;
    relay.short_time = 1e-3;
    relay.first = 10;  // a step that would reach the end
    follow(relay, {1}, 5);
    for (std::size_t k = 1; k < relay.events.size(); ++k)
        ASSERT_LT(relay.events[k].time - relay.events[k - 1].time, 2.1e-3) << k;
}

}  // namespace
}  // namespace footfall
