// The order of both methods across each kind of event of the paper's laws.
#include "simulate/order.hpp"

namespace footfall {
namespace {

using test::order_of, test::Real, test::soft_ball, test::Steps;
using PaperLaw = Pair<AzadFeatherstoneNormal<Real>, AzadFeatherstoneFriction<Real>>;

PaperLaw paper_law(double normal_stiffness = 20) {
    return {AzadFeatherstoneNormal<>{normal_stiffness, 2}.cast<Real>(),
            AzadFeatherstoneFriction<>{{15, 3, 0.3, 0.5}}.cast<Real>()};
}

enum class Friction { measured, idle };

/// Expects the order of the method over a scene with exactly these events after its start.
void expect_order(Steps steps, const Simulation& s, const std::vector<EventKind>& events, double coarsest,
                  const PaperLaw& law = paper_law(), Friction friction = Friction::measured) {
    const auto measured = test::measured_order<2>(s, law, steps, events, coarsest);
    if (steps == Steps::explicit_) {
        EXPECT_NEAR(measured.overall, order_of(steps), 0.3);
        if (friction == Friction::measured) {
            EXPECT_NEAR(measured.overall_tangential, order_of(steps), 0.3);
        }
        return;
    }
    // The implicit method comes to rounding sooner: its last pair of steps above it counts.
    EXPECT_NEAR(measured.all, order_of(steps), 0.4);
    if (friction == Friction::measured) {
        EXPECT_NEAR(measured.tangential, order_of(steps), 0.4);
    }
}

using enum EventKind;

class Order : public testing::TestWithParam<Steps> {};
INSTANTIATE_TEST_SUITE_P(, Order, testing::Values(Steps::explicit_, Steps::implicit), test::name_of_steps);

TEST_P(Order, IsTheMethodsWhileAContactSticks) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 0.8};
    s.initial.velocity = {0.01, 0, -0.2};
    s.options.end_time = 0.6;
    expect_order(GetParam(), s, {}, 0.2);
}

TEST_P(Order, IsTheMethodsWhileAContactSlips) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 0.8};
    s.initial.velocity = {2, 0.5, -0.2};
    s.options.end_time = 0.6;
    expect_order(GetParam(), s, {}, 0.2);
}

TEST_P(Order, IsTheMethodsAcrossTouchdownIntoSlip) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 1.05};
    s.initial.velocity = {2, 0.5, -0.8};
    s.options.end_time = 0.45;
    expect_order(GetParam(), s, {touchdown}, 0.2);
}

TEST_P(Order, IsTheMethodsAcrossTouchdownIntoStick) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 1.05};
    s.initial.velocity = {0.01, 0, -0.8};
    s.options.end_time = 0.5;
    expect_order(GetParam(), s, {touchdown, stick}, 0.2);
}

TEST_P(Order, IsTheMethodsAcrossStick) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 0.8};
    s.initial.velocity = {0.6, 0.2, -0.2};
    s.options.end_time = 0.6;
    expect_order(GetParam(), s, {stick}, 0.2);
}

TEST_P(Order, IsTheMethodsAcrossSlip) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 0.8};
    s.initial.velocity = {0.1, 0, 0.2};
    s.gravity = {1.2, 0.3, -1};
    s.options.end_time = 0.8;
    expect_order(GetParam(), s, {slip}, 0.3);
}

TEST_P(Order, IsTheMethodsAcrossSeparation) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 0.6};
    s.initial.velocity = {2, 0.5, 0};
    s.options.end_time = 0.6;
    expect_order(GetParam(), s, {separation}, 0.2);
}

// Only the damper knows of this contact, which gets what the spring gives.
TEST_P(Order, IsTheMethodsAcrossRecovered) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 0.2};
    s.initial.velocity = {2, 0.5, 1.4};
    s.options.end_time = 1;
    expect_order(GetParam(), s, {recovered}, 0.4, paper_law(1), Friction::idle);
}

TEST_P(Order, IsTheMethodsAcrossAWholeImpactWithEveryKindOfEvent) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 1.05};
    s.initial.velocity = {0.6, 0.2, -0.8};
    s.options.end_time = 1.9;
    expect_order(GetParam(), s, {touchdown, stick, slip, separation, recovered}, 0.15);
}

}  // namespace
}  // namespace footfall
