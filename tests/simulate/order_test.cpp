// The order of the integrator across each kind of event: the step is halved, the slope of the error measured. The
// scenes have numbers of order one and a soft ground, so that the same step suits flight and contact.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "footfall/simulate/simulator.hpp"

namespace footfall {
namespace {

using Real = long double;
using Law = ContactLaw<AzadFeatherstoneNormal<Real>, AzadFeatherstoneFriction<Real>>;
using Sim = Simulator<Law, 1>;

/// A ball of unit mass on soft ground.
Simulation soft_ball() {
    Simulation s;
    s.body.mass = 1;
    s.body.inertia = solid_sphere_inertia(1, 1);
    s.body.spheres = {{.radius = 1}};
    s.gravity = {0, 0, -1};
    s.contacts = {{AzadFeatherstoneNormal<>{20, 2}, AzadFeatherstoneFriction<>{{15, 3, 0.3, 0.5}}}};
    s.options.tolerance = 1e-14;
    s.options.allow_initial_penetration = true;
    return s;
}

struct Outcome {
    Sim::StateVector state;
    std::vector<EventKind> events;  // those after the start
};

Outcome outcome(const Simulation& s, Real step) {
    const auto& c = s.contacts.front();
    Sim simulator(s, {Law{std::get<0>(c.normal).cast<Real>(), std::get<1>(c.friction).cast<Real>()}});
    simulator.fix_step(step);
    const Run run = simulator.run();
    Outcome out{simulator.state(), {}};
    for (const Event& e : run.events)
        if (e.time > 0) out.events.push_back(e.kind);
    return out;
}

std::string names(const std::vector<EventKind>& events) {
    std::string text;
    for (const EventKind e : events) text += std::string(name_of(e)) + " ";
    return text;
}

/// The largest error of any component, and of those that only friction moves.
struct Errors {
    double all, tangential;
};
Errors errors(const Sim::StateVector& rough, const Sim::StateVector& exact) {
    using L = Layout<1>;
    const Sim::StateVector e = (rough - exact).abs();
    const L layout;
    const Real tangential =
        std::max({e.segment<2>(L::velocity).maxCoeff(), e.segment<3>(L::momentum).maxCoeff(),
                  e.segment<2>(layout.bristle(0)).maxCoeff(), e[layout.ledger(0) + L::tangential_damper],
                  e[layout.ledger(0) + L::clutch], e[layout.ledger(0) + L::stiffness_change]});
    return {static_cast<double>(e.maxCoeff()), static_cast<double>(tangential)};
}

enum class Friction { measured, idle };

/// Runs a scene with ever finer steps and expects exactly these events after its start, and order 8.
void expect_order_eight(const Simulation& s, const std::vector<EventKind>& events, double coarsest,
                        Friction friction = Friction::measured) {
    constexpr int halvings = 3;
    const Outcome exact = outcome(s, coarsest * std::ldexp(1.0L, -halvings - 3));
    ASSERT_EQ(names(exact.events), names(events));
    std::vector<Errors> e;
    for (int k = 0; k <= halvings; ++k) {
        const double step = coarsest * std::ldexp(1.0, -k);
        const Outcome rough = outcome(s, step);
        ASSERT_EQ(names(rough.events), names(events)) << "at step " << step;
        e.push_back(errors(rough.state, exact.state));
        std::printf("  step %-8.4g error %-9.3g friction's %-9.3g", step, e.back().all, e.back().tangential);
        if (k > 0) {
            const Errors& last = e[e.size() - 2];
            std::printf(" slope %.2f %.2f", std::log2(last.all / e.back().all),
                        std::log2(last.tangential / e.back().tangential));
        }
        std::printf("\n");
    }
    EXPECT_NEAR(std::log2(e.front().all / e.back().all) / halvings, 8, 0.3);
    if (friction == Friction::measured) {
        EXPECT_NEAR(std::log2(e.front().tangential / e.back().tangential) / halvings, 8, 0.3);
    }
}

using enum EventKind;

TEST(Order, IsEightWhileAContactSticks) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 0.8};
    s.initial.velocity = {0.01, 0, -0.2};
    s.options.end_time = 0.6;
    expect_order_eight(s, {}, 0.2);
}

TEST(Order, IsEightWhileAContactSlips) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 0.8};
    s.initial.velocity = {2, 0.5, -0.2};
    s.options.end_time = 0.6;
    expect_order_eight(s, {}, 0.2);
}

TEST(Order, IsEightAcrossTouchdownIntoSlip) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 1.05};
    s.initial.velocity = {2, 0.5, -0.8};
    s.options.end_time = 0.45;
    expect_order_eight(s, {touchdown}, 0.2);
}

TEST(Order, IsEightAcrossTouchdownIntoStick) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 1.05};
    s.initial.velocity = {0.01, 0, -0.8};
    s.options.end_time = 0.5;
    expect_order_eight(s, {touchdown, stick}, 0.2);
}

TEST(Order, IsEightAcrossStick) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 0.8};
    s.initial.velocity = {0.6, 0.2, -0.2};
    s.options.end_time = 0.6;
    expect_order_eight(s, {stick}, 0.2);
}

TEST(Order, IsEightAcrossSlip) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 0.8};
    s.initial.velocity = {0.1, 0, 0.2};
    s.gravity = {1.2, 0.3, -1};
    s.options.end_time = 0.8;
    expect_order_eight(s, {slip}, 0.3);
}

TEST(Order, IsEightAcrossSeparation) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 0.6};
    s.initial.velocity = {2, 0.5, 0};
    s.options.end_time = 0.6;
    expect_order_eight(s, {separation}, 0.2);
}

// Only the damper knows of this contact, which gets what the spring gives.
TEST(Order, IsEightAcrossRecovered) {
    Simulation s = soft_ball();
    s.contacts = {{AzadFeatherstoneNormal<>{1, 2}, AzadFeatherstoneFriction<>{{15, 3, 0.3, 0.5}}}};
    s.initial.position = {0, 0, 0.2};
    s.initial.velocity = {2, 0.5, 1.4};
    s.options.end_time = 1;
    expect_order_eight(s, {recovered}, 0.4, Friction::idle);
}

TEST(Order, IsEightAcrossAWholeImpactWithEveryKindOfEvent) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 1.05};
    s.initial.velocity = {0.6, 0.2, -0.8};
    s.options.end_time = 1.9;
    expect_order_eight(s, {touchdown, stick, slip, separation, recovered}, 0.15);
}

}  // namespace
}  // namespace footfall
