// Stiff systems with events: the solver turns to the implicit method, and finds each event as before.
#include <array>
#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "solve/followed.hpp"

namespace footfall {
namespace {

using test::follow, test::Followed;

/// adot = -rate (a - cos t); a falls through a threshold, which takes it down by one at once and lowers the threshold
/// by one. Components: a, cos t, sin t. The mode counts the events.
template <class S>
struct Relaxation {
    static constexpr int motion = 3, guards = 1;
    S rate, threshold;

    template <class T>
    void flow(int, const T* y, T* out) const {
        out[0] = -T(rate) * (y[0] - y[1]);
        out[1] = -y[2];
        out[2] = y[1];
    }
    template <class T>
    void look(int mode, const T* y, T* out) const {
        out[0] = mode < 2 ? y[0] - (T(threshold) - mode) : T(1);
    }
    int jump(int, int mode, S* y) const {
        y[0] += S(0.125);  // a kick that the relaxation takes back in no time
        return mode + 1;
    }
    template <class T>
    [[nodiscard]] Relaxation<T> over() const {
        return {T(value_of(rate)), T(value_of(threshold))};
    }
};

/// cos x = c.
double arccosine(double c) { return std::acos(c); }
template <int N>
Dual<double, N> arccosine(const Dual<double, N>& c) {
    Dual<double, N> x(std::acos(c.value));
    for (std::size_t i = 0; i < N; ++i) x.gradient[i] = -c.gradient[i] / std::sqrt(1 - c.value * c.value);
    return x;
}

/// Where the slow motion, cos(t - lag) rate / sqrt(1 + rate^2) with tan lag = 1/rate, falls to a height.
template <class S>
S crossing(const S& rate, const S& height) {
    using std::sqrt;
    const S size = rate / sqrt(S(1) + rate * rate);
    const S lag = arccosine(size);  // cos lag = size
    return lag + arccosine(S(height / size));
}

constexpr double fast = 1e5, threshold = 0.5, end = 3;

TEST(StiffEvents, AreFoundByTheImplicitMethodWhereTheyAre) {
    Followed<Relaxation, double> system({fast, threshold});
    system.tolerance = 1e-10;
    system.first = 1e-7;
    SolverCost cost;
    const auto y = follow(system, {1, 1, 0}, end, &cost);
    ASSERT_EQ(system.events.size(), 2u);
    EXPECT_NEAR(system.events[0].time, crossing(fast, threshold), 1e-9);
    EXPECT_NEAR(system.events[1].time, crossing(fast, threshold - 1), 1e-9);
    EXPECT_NEAR(y[0], fast / std::sqrt(1 + fast * fast) * std::cos(end - std::atan(1 / fast)), 1e-9);
    EXPECT_GT(cost.stiff_steps, 0);
    // The explicit method is bound by h rate < 6: 12 evaluations each.
    EXPECT_LT(static_cast<double>(cost.evaluations), 0.1 * end * fast / 6 * 12);
}

TEST(StiffEvents, HaveTheDerivativesOfTheClosedForm) {
    using Slopes = Dual<double, 2>;
    const Slopes rate = Slopes::variable(fast, 0), height = Slopes::variable(threshold, 1);
    Followed<Relaxation, Slopes> system({rate, height});
    system.tolerance = 1e-10;
    system.first = 1e-7;
    SolverCost cost;
    const auto y = follow(system, {Slopes(1), Slopes(1), Slopes(0)}, end, &cost);
    ASSERT_EQ(system.events.size(), 2u);
    EXPECT_GT(cost.stiff_steps, 0);
    for (std::size_t k = 0; k < 2; ++k) {
        const Slopes wanted = crossing(rate, Slopes(height - static_cast<double>(k)));
        EXPECT_NEAR(system.events[k].time.value, wanted.value, 1e-9);
        EXPECT_NEAR(system.events[k].time.gradient[0], wanted.gradient[0], 1e-14);  // about 1e-10
        EXPECT_NEAR(system.events[k].time.gradient[1], wanted.gradient[1], 1e-8);
    }
    EXPECT_NEAR(y[0].gradient[1], 0, 1e-8);
}

// The fast component has come to its rest and goes on being stiff: forced, so that the first step is implicit too.
TEST(StiffEvents, AreFoundWhereTheImplicitMethodIsForcedFromTheStart) {
    using System = Followed<Relaxation, double>;
    System system({fast, threshold});
    system.tolerance = 1e-10;
    system.first = 1e-7;
    Solver<System> solver(system);
    solver.stay_implicit();
    solver.run(test::from<System>({1, 1, 0}), end);
    ASSERT_EQ(system.events.size(), 2u);
    EXPECT_NEAR(system.events[0].time, crossing(fast, threshold), 1e-9);
    EXPECT_EQ(solver.cost().stiff_steps, solver.cost().steps);
    EXPECT_LT(solver.cost().evaluations, 20'000);
}

}  // namespace
}  // namespace footfall
