// The step of a friction law's states inside another simulator, against closed forms.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "footfall/law/contact_step.hpp"
#include "footfall/law/registry.hpp"

namespace footfall::test {
namespace {

constexpr double load = 10, dt = 1e-3;

/// Steps of a friction law under a load: that of a spring of 1 N/m that is as deep.
template <class Friction>
class FrictionStateStepper {
public:
    explicit FrictionStateStepper(const Friction& friction, double tolerance = 1e-4)
        : stepper_({{1, 0}, friction}, tolerance) {}

    ContactStep operator()(Phase was, double F_n, const Vector2<double>& V, std::span<double> x, double time) const {
        return stepper_(was, F_n, 0, V, x, time);
    }

private:
    ContactStepper<Pair<LinearNormal<>, Friction>> stepper_;
};

// Dahl 1968 in one direction, exponent 1: x = (mu/sigma)(1 - exp(-sigma V t / mu)), F_f = -sigma x F_n.
TEST(FrictionStateStep, FollowsDahlsExponential) {
    const double sigma = 1e4, mu = 0.4, V = 0.5;
    const auto law = DahlFriction<>{.stiffness = sigma, .coefficient = mu};
    std::array<double, 2> x{};
    const ContactStep step = FrictionStateStepper(law, 1e-8)(Phase::flight, load, {V, 0}, x, dt);
    const double decay = sigma * V * dt / mu;
    EXPECT_NEAR(x[0], mu / sigma * -std::expm1(-decay), 1e-7 * mu / sigma);
    // The mean of 1 - exp(-decay t/dt).
    EXPECT_NEAR(step.mean_friction_force.x(), -load * mu * (1 + std::expm1(-decay) / decay), 1e-6 * load * mu);
}

// A stiff one: the state settles in a hundredth of the step, or a hundred-thousandth.
TEST(FrictionStateStep, IsStableWhereAnExplicitStepIsNot) {
    for (const double sigma : {1e6, 1e9}) {
        const auto law = DahlFriction<>{.stiffness = sigma, .coefficient = 0.4};
        std::array<double, 2> x{};
        const FrictionStateStepper stepper(law);
        ContactStep step;
        for (int i = 0; i < 10; ++i) step = stepper(step.phase, load, {0.03, 0.04}, x, dt);
        EXPECT_NEAR(step.mean_friction_force.x(), -0.4 * load * 0.6, 1e-3 * load);
        EXPECT_NEAR(step.mean_friction_force.y(), -0.4 * load * 0.8, 1e-3 * load);
    }
}

// Haessig & Friedland's reset integrator: a spring up to its reach, then a constant force, dragged to and fro.
TEST(FrictionStateStep, JumpsWhereTheLawDoes) {
    const double sigma = 1e4, reach = 4e-5, V = 0.1;
    const auto law = ResetIntegratorFriction<>{.stiffness = sigma, .damping = 0, .reach = reach, .stiction = 0};
    std::array<double, 2> x{};
    const FrictionStateStepper stepper(law, 1e-9);
    // It breaks away after reach / V = 0.4 ms of the 1 ms: the mean force is that of a ramp and a plateau.
    ContactStep step = stepper(Phase::flight, load, {V, 0}, x, dt);
    EXPECT_EQ(step.phase, Phase::slip);
    EXPECT_NEAR(x[0], reach, 1e-8 * reach);
    EXPECT_NEAR(step.mean_friction_force.x(), -load * sigma * reach * (0.4 * 0.5 + 0.6), 1e-6 * load * sigma * reach);
    // Turned round it sticks, crosses the middle after 0.4 ms and breaks away on the other side after 0.8 ms.
    step = stepper(step.phase, load, {-V, 0}, x, dt);
    EXPECT_EQ(step.phase, Phase::slip);
    EXPECT_NEAR(x[0], -reach, 1e-8 * reach);
    EXPECT_NEAR(step.mean_friction_force.x(), load * sigma * reach * 0.2, 1e-6 * load * sigma * reach);
}

// The same spring and end, as the elasto-plastic law without a rise between.
TEST(FrictionStateStep, ChangesThePhaseWhereAnElastoPlasticBristleGivesWay) {
    const double sigma = 1e4, mu = 0.4, V = 0.1;
    const ElastoPlasticFriction<> law{sigma, 0, mu, mu, 0.01, 0, 1};
    std::array<double, 2> x{};
    const FrictionStateStepper stepper(law, 1e-9);
    ContactStep step = stepper(Phase::flight, load, {V, 0}, x, dt);
    EXPECT_EQ(step.phase, Phase::slip);
    EXPECT_NEAR(step.mean_friction_force.x(), -load * mu * (0.4 * 0.5 + 0.6), 1e-6 * load * mu);
    EXPECT_NEAR(step.clutch, load * mu * V * 0.6e-3, 1e-6 * load * mu * V * dt);
    step = stepper(step.phase, load, {-0.1 * V, 0}, x, dt);
    EXPECT_EQ(step.phase, Phase::stick);
    EXPECT_NEAR(step.clutch, 0, 1e-12 * load * mu * V * dt);
    // Where the phase is not told, it follows from the bristle.
    std::array<double, 2> stretched{mu / sigma, 0};
    EXPECT_EQ(stepper(Phase::flight, load, {V, 0}, stretched, dt).phase, Phase::slip);
}

TEST(FrictionStateStep, WorkIsStoredOrTaken) {
    const auto law = LuGreFriction<>{.stiffness = 1e4,
                                     .damping = 10,
                                     .static_coefficient = 0.5,
                                     .kinetic_coefficient = 0.4,
                                     .stribeck_velocity = 0.05};
    std::array<double, 2> x{1e-5, -2e-5};
    const Vector2<double> V(0.01, 0.02);
    const double before = load * law.stored(x);
    const ContactStep step = FrictionStateStepper(law, 1e-9)(Phase::slip, load, V, x, dt);
    const double after = load * law.stored(x);
    EXPECT_NEAR(-step.mean_friction_force.dot(V) * dt, after - before + step.tangential_damper + step.clutch,
                1e-6 * (before + after));
}

// With stiction the reset integrator's bond snaps: what it held beyond the sliding force goes through the clutch.
TEST(FrictionStateStep, WhatASnappingBondHeldGoesThroughTheClutch) {
    const double reach = 4e-5, V = 0.1;
    const ResetIntegratorFriction<> law{.stiffness = 1e4, .damping = 0, .reach = reach, .stiction = 0.5};
    std::array<double, 2> x{};
    const ContactStep step = FrictionStateStepper(law, 1e-9)(Phase::flight, load, {V, 0}, x, dt);
    ASSERT_EQ(step.phase, Phase::slip);
    const double work = -step.mean_friction_force.x() * V * dt, held = load * law.stored(step.phase, x);
    EXPECT_NEAR(work, held + step.tangential_damper + step.clutch, 1e-6 * work);
}

TEST(FrictionStateStep, WithoutALoadTheContactIsNewAgain) {
    const auto law = DahlFriction<>{.stiffness = 1e4, .coefficient = 0.4};
    std::array<double, 2> x{1e-5, 1e-5};
    const ContactStep step = FrictionStateStepper(law)(Phase::slip, 0, {1, 0}, x, dt);
    EXPECT_EQ(step.phase, Phase::flight);
    EXPECT_EQ(x[0], 0);
    EXPECT_EQ(step.mean_friction_force.norm(), 0);
}

TEST(FrictionStateStep, SaysWhatIsLeftWhereItTakesTooManySubSteps) {
    const auto law = DahlFriction<>{.stiffness = 1e4, .coefficient = 0.4};
    const FrictionStateStepper stepper(law);
    const auto left_at = [&](double speed) {
        std::array<double, 2> x{};
        return stepper(Phase::flight, load, {speed, 0}, x, dt).left;
    };
    EXPECT_EQ(left_at(1), 0);
    // The sub-steps are bounded by 2.5 mu / (sigma V) or so, where they are stable.
    EXPECT_GT(left_at(1e9), 0.5 * dt);
    EXPECT_LT(left_at(1e9), dt);
}

}  // namespace
}  // namespace footfall::test
