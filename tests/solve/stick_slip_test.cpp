// A mass on a spring, on a belt that drags it along: it sticks, slips back and sticks again, all in closed form.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solve/followed.hpp"

namespace footfall {
namespace {

using test::follow, test::Followed, test::from;
using Real = long double;

/// Mass and stiffness are 1. Components: the mass's position and velocity. Guards: it breaks away, it is caught.
template <class S>
struct StickSlip {
    static constexpr int motion = 2, guards = 2;
    static constexpr int sticks = 0, slips = 1;
    S belt, static_friction, kinetic_friction;

    template <class T>
    void flow(int mode, const T* y, T* rate) const {
        rate[0] = y[1];
        rate[1] = mode == sticks ? T(0) : T(kinetic_friction) - y[0];
    }
    template <class T>
    void look(int mode, const T* y, T* out) const {
        out[0] = mode == sticks ? T(static_friction) - y[0] : T(1);
        out[1] = mode == slips ? T(belt) - y[1] : T(1);
    }
    int jump(int, int mode, S* y) const {
        y[1] = belt;
        return mode == sticks ? slips : sticks;
    }
    template <class T>
    [[nodiscard]] StickSlip<T> over() const {
        return {T(value_of(belt)), T(value_of(static_friction)), T(value_of(kinetic_friction))};
    }

    // The closed form of the cycle that starts with the mass caught, at the time 0.
    [[nodiscard]] S drop() const { return static_friction - kinetic_friction; }
    [[nodiscard]] S caught_at() const { return kinetic_friction - drop(); }
    [[nodiscard]] S sticks_for() const { return S(2) * drop() / belt; }
    [[nodiscard]] S period() const {
        using std::atan;
        return sticks_for() + S(2) * (std::numbers::pi_v<S> - atan(drop() / belt));
    }
    [[nodiscard]] std::array<S, 2> at(S time) const {
        while (time > period()) time -= period();
        const S t = time - sticks_for();
        if (t < S(0)) return {caught_at() + belt * time, belt};
        return {kinetic_friction + drop() * std::cos(t) + belt * std::sin(t),
                belt * std::cos(t) - drop() * std::sin(t)};
    }
};

template <class S>
const StickSlip<S> model{S(0.25L), S(1), S(0.5L)};

TEST(StickSlip, HasItsEventsAtTheTimesOfTheClosedForm) {
    Followed<StickSlip, double> mass(model<double>);
    const auto& m = mass.model;
    const double end = 10.2 * m.period();
    const auto y = follow(mass, {m.caught_at(), m.belt}, end);
    ASSERT_EQ(mass.events.size(), 20u);
    for (std::size_t k = 0; k < mass.events.size(); ++k) {
        const double cycle = static_cast<double>(k / 2);
        EXPECT_EQ(mass.events[k].guard, static_cast<int>(k % 2));
        EXPECT_NEAR(mass.events[k].time, k % 2 == 0 ? cycle * m.period() + m.sticks_for() : (cycle + 1) * m.period(),
                    1e-10);
    }
    const auto wanted = m.at(end);
    EXPECT_NEAR(y[0], wanted[0], 1e-10);
    EXPECT_NEAR(y[1], wanted[1], 1e-10);
}

class OrderAcrossEvents : public testing::TestWithParam<bool> {};  // whether the implicit method takes every step
INSTANTIATE_TEST_SUITE_P(, OrderAcrossEvents, testing::Bool(),
                         [](const auto& which) { return std::string(which.param ? "Implicit" : "Explicit"); });

TEST_P(OrderAcrossEvents, IsTheMethods) {
    const auto error = [&](Real step) {
        Followed<StickSlip, Real> mass(model<Real>);
        mass.tolerance = 1e-16L;  // where the implicit method's iteration ends
        const auto& m = mass.model;
        const Real end = 1.7L * m.period();
        Solver<Followed<StickSlip, Real>> solver(mass);
        solver.fix_step(step);
        if (GetParam()) solver.stay_implicit();
        solver.run(from<Followed<StickSlip, Real>>({m.caught_at(), m.belt}), end);
        EXPECT_EQ(mass.events.size(), 3u);
        const auto wanted = m.at(end);
        return static_cast<double>(
            std::max(std::abs(solver.state()[0] - wanted[0]), std::abs(solver.state()[1] - wanted[1])));
    };
    constexpr double rounding = 1e-17;
    double last = 0, slope = 0;
    for (const Real step : {0.8L, 0.4L, 0.2L, 0.1L}) {
        const double now = error(step);
        if (last > 0 && now > rounding) slope = std::log2(last / now);
        std::printf("  step %-5.3Lg error %-9.3g slope %.2f\n", step, now, last > 0 ? std::log2(last / now) : 0);
        last = now;
    }
    EXPECT_NEAR(slope, GetParam() ? 9 : 8, 0.3);
}

}  // namespace
}  // namespace footfall
