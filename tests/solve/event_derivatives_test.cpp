// Derivatives with respect to parameters and start, through events, against closed forms: the time of each event moves
// with the parameters, and what comes after it as well.
#include <array>
#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "solve/followed.hpp"

namespace footfall {
namespace {

using test::bounce_time, test::BouncingPoint, test::Followed, test::from;

using Slopes = Dual<double, 3>;

/// Inputs: gravity, restitution, height.
const std::array<Slopes, 3> inputs{Slopes::variable(9.81, 0), Slopes::variable(0.7, 1), Slopes::variable(2, 2)};

/// The closed form at a time between two bounces: height and velocity.
std::array<Slopes, 2> closed_form(double time) {
    using std::sqrt;
    const auto& [g, e, h] = inputs;
    int bounces = 0;
    while (bounce_time(g, e, h, bounces).value < time) ++bounces;
    if (bounces == 0) return {h - 0.5 * g * time * time, -g * time};
    Slopes leaves = sqrt(2.0 * g * h);
    for (int k = 0; k < bounces; ++k) leaves *= e;
    const Slopes since = time - bounce_time(g, e, h, bounces - 1);
    return {leaves * since - 0.5 * g * since * since, leaves - g * since};
}

class EventDerivatives : public testing::TestWithParam<bool> {};  // whether the implicit method takes every step
INSTANTIATE_TEST_SUITE_P(, EventDerivatives, testing::Bool(),
                         [](const auto& which) { return std::string(which.param ? "Implicit" : "Explicit"); });

template <class System>
typename System::State follow(System& system, const std::vector<typename System::S>& motion, double end,
                              bool implicit) {
    Solver<System> solver(system);
    if (implicit) solver.stay_implicit();
    solver.run(from<System>(motion), end);
    return solver.state();
}

void expect_near(const Slopes& x, const Slopes& wanted, const char* what) {
    EXPECT_NEAR(x.value, wanted.value, 1e-12) << what;
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(x.gradient[i], wanted.gradient[i], 1e-11 * (1 + std::abs(wanted.gradient[i])))
            << what << ", input " << i;
}

TEST_P(EventDerivatives, OfEachEventsTimeAndSpeedAreThoseOfTheClosedForm) {
    Followed<BouncingPoint, Slopes> point({inputs[0], inputs[1]});
    follow(point, {inputs[2], Slopes(0)}, 3, GetParam());
    ASSERT_EQ(point.events.size(), 5u);
    for (int k = 0; k < 5; ++k) {
        const auto& event = point.events[static_cast<std::size_t>(k)];
        expect_near(event.time, bounce_time(inputs[0], inputs[1], inputs[2], k), "time");
        expect_near(event.state[0], Slopes(0), "height");
    }
}

TEST_P(EventDerivatives, AtTheEndAreThoseAtThatTime) {
    for (const double end : {0.3, 0.9, 3.0}) {
        Followed<BouncingPoint, Slopes> point({inputs[0], inputs[1]});
        const auto y = follow(point, {inputs[2], Slopes(0)}, end, GetParam());
        const auto wanted = closed_form(end);
        expect_near(y[0], wanted[0], "height");
        expect_near(y[1], wanted[1], "velocity");
        EXPECT_EQ(y[2].value, end);
        for (const double slope : y[2].gradient) EXPECT_EQ(slope, 0);
    }
}

TEST_P(EventDerivatives, DoNotChangeTheWay) {
    Followed<BouncingPoint, Slopes> dual({inputs[0], inputs[1]});
    Followed<BouncingPoint, double> plain({inputs[0].value, inputs[1].value});
    const auto y = follow(dual, {inputs[2], Slopes(0)}, 3, GetParam());
    const auto x = follow(plain, {inputs[2].value, 0}, 3, GetParam());
    for (Eigen::Index c = 0; c < x.size(); ++c) EXPECT_EQ(x[c], y[c].value) << c;
}

/// A pendulum of length 1 that a wall at an angle throws back. Components: angle, angular velocity.
template <class S>
struct Pendulum {
    static constexpr int motion = 2, guards = 1;
    S gravity, restitution, wall;

    template <class T>
    void flow(int, const T* y, T* rate) const {
        using std::sin;
        rate[0] = y[1];
        rate[1] = -T(gravity) * sin(y[0]);
    }
    template <class T>
    void look(int, const T* y, T* out) const {
        using std::sin;
        out[0] = sin(T(wall)) - sin(y[0]);
    }
    int jump(int, int mode, S* y) const {
        y[0] = wall;
        y[1] = -restitution * y[1];
        return mode;
    }
    template <class T>
    [[nodiscard]] Pendulum<T> over() const {
        return {T(value_of(gravity)), T(value_of(restitution)), T(value_of(wall))};
    }
};

/// Energy over mass.
template <class S>
S energy(const S& gravity, const S& angle, const S& velocity) {
    using std::cos;
    return S(0.5) * velocity * velocity - gravity * cos(angle);
}

// No closed form for the times: the energy after two impacts is one, with its derivatives. The rates turn within the
// last correction of an event's place, and the guard is not linear.
TEST_P(EventDerivatives, OfANonlinearMotionKeepItsEnergyAfterTwoImpacts) {
    const auto [g, e, wall] = std::array{Slopes::variable(1.3, 0), Slopes::variable(0.8, 1), Slopes::variable(0.3, 2)};
    Followed<Pendulum, Slopes> pendulum({g, e, wall});
    const auto y = follow(pendulum, {Slopes(-1), Slopes(0.2)}, 8, GetParam());
    ASSERT_EQ(pendulum.events.size(), 2u);
    const Slopes at_wall = -g * cos(wall);
    Slopes moving = energy(g, Slopes(-1), Slopes(0.2)) - at_wall;
    for (int k = 0; k < 2; ++k) moving *= e * e;
    expect_near(energy(g, y[0], y[1]), moving + at_wall, "energy");
}

}  // namespace
}  // namespace footfall
