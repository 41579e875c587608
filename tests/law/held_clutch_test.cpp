// The step of a bristle inside another simulator, against closed forms, small explicit steps and the account of energy.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "footfall/law/contact_law.hpp"
#include "footfall/law/contact_step.hpp"
#include "law/laws.hpp"
#include "math/property.hpp"

namespace footfall::test {
namespace {

using Paper = ContactLaw<AzadFeatherstoneNormal<>, AzadFeatherstoneFriction<>>;

Paper paper(double coefficient = 0.2, double viscous = 0.1) {
    return {{8.5e6, 3.1e3}, {{12.75e6, 3.1e3, coefficient, viscous}}};
}

constexpr double depth = 1e-3, host_step = 1e-3;

/// A step, and where it has left the bristle.
struct BristleStep : ContactStep {
    Vector2<double> bristle = Vector2<double>::Zero();
};

template <class Law>
class BristleStepper {
public:
    explicit BristleStepper(const Law& law, double tolerance = 1e-4) : stepper_(law, tolerance) {}

    BristleStep operator()(double z, double z_rate, const Vector2<double>& V, Vector2<double> u, double dt) const {
        const ContactStep step = stepper_(Phase::flight, z, z_rate, V, std::span<double>(u.data(), 2), dt);
        return {step, u};
    }

private:
    ContactStepper<Law> stepper_;
};

/// The same step by many explicit ones of order 2, by `evaluate` alone.
template <class Law>
BristleStep by_small_steps(const Law& law, double z, double z_rate, const Vector2<double>& V, Vector2<double> u,
                           double dt, int steps) {
    const double h = dt / steps;
    BristleStep all;
    for (int i = 0; i < steps; ++i) {
        const auto start = law.evaluate(z, z_rate, V, u);
        const auto r = law.evaluate(z, z_rate, V, Vector2<double>(u + 0.5 * h * start.bristle_rate));
        all.mean_friction_force += r.friction_force / steps;
        all.tangential_damper += h * r.tangential_damper_power;
        all.clutch += h * r.clutch_power;
        u += h * r.bristle_rate;
    }
    all.bristle = u;
    return all;
}

/// A damped law and a state of the sizes that the paper's run has, in any phase.
struct Case {
    Paper law = paper(*uniform(0.05, 1.0), *uniform(0, 2.0));
    double z = *uniform(-1e-4, 1e-3), z_rate = *uniform(-1, 1);
    Vector2<double> V = random_vector(1e-4, 1), u = random_vector(1e-7, 1e-4);
};

TEST(BristleStep, FollowsTheSphereWhileItSticks) {
    const Vector2<double> V(0.001, -0.002), u(1e-6, 2e-6);
    const BristleStep step = BristleStepper(paper())(depth, 0, V, u, host_step);
    EXPECT_EQ(step.phase, Phase::stick);
    EXPECT_NEAR((step.bristle - (u + host_step * V)).norm(), 0, 1e-20);
    EXPECT_EQ(step.clutch, 0);
}

TEST(BristleStep, RecoversExponentiallyInFlight) {
    const Vector2<double> u(1e-5, -2e-5);
    const BristleStep step = BristleStepper(paper())(-0.1, 1, {0.5, 0}, u, host_step);
    EXPECT_EQ(step.phase, Phase::flight);
    EXPECT_NEAR((step.bristle - u * std::exp(-12.75e6 / 3.1e3 * host_step)).norm(), 0, 1e-19);
    EXPECT_EQ(step.mean_friction_force.norm(), 0);
}

// Sliding straight without viscosity, the size w of f_stick / sqrt(z) obeys wdot = K_t V - (K_t/D_t) (w - mu F_n /
// sqrt(z)).
TEST(BristleStep, SlidesStraightAsTheClosedFormDoes) {
    const double K = 12.75e6, D = 3.1e3, mu = 0.2, R = mu * 8.5e6 * depth, V = 0.5, t = 2e-4;
    const double w_start = 1.5 * R, w_end = R + D * V + (w_start - R - D * V) * std::exp(-K / D * t);
    const BristleStep step = BristleStepper(paper(mu, 0), 1e-8)(depth, 0, {V, 0}, {(w_start - D * V) / K, 0}, t);
    EXPECT_EQ(step.phase, Phase::slip);
    EXPECT_NEAR(step.bristle.x(), (w_end - D * V) / K, 1e-8 * R / K);
    EXPECT_NEAR(step.mean_friction_force.x(), -std::sqrt(depth) * R, 1e-7 * std::sqrt(depth) * R);
}

TEST(BristleStep, LongSlidingEndsOnTheConeAgainstTheMotion) {
    const Vector2<double> V(0.3, -0.4);
    const BristleStep step = BristleStepper(paper(0.2, 0))(depth, 0, V, {5e-5, 5e-5}, 1.0);
    const double force = 0.2 * 8.5e6 * depth * std::sqrt(depth);
    EXPECT_EQ(step.phase, Phase::slip);
    EXPECT_NEAR((step.mean_friction_force + V / V.norm() * force).norm(), 0, 2e-3 * force);
}

TEST(BristleStep, ErrorFallsWithTheTolerance) {
    const Vector2<double> V(0.5, 0.3), u(-5e-5, 1.2e-4);
    const BristleStep exact = BristleStepper(paper(), 1e-11)(depth, -0.1, V, u, host_step);
    for (const double tolerance : {1e-3, 1e-4, 1e-6, 1e-8}) {
        const BristleStep step = BristleStepper(paper(), tolerance)(depth, -0.1, V, u, host_step);
        EXPECT_LT((step.bristle - exact.bristle).norm(), 3 * tolerance * u.norm()) << tolerance;
        EXPECT_LT((step.mean_friction_force - exact.mean_friction_force).norm(),
                  3 * tolerance * exact.mean_friction_force.norm())
            << tolerance;
    }
}

RC_GTEST_PROP(BristleStepProperty, AgreesWithManySmallSteps, ()) {
    const Case c;
    const double dt = *uniform(1e-5, 2e-3);
    const BristleStep step = BristleStepper(c.law, 1e-7)(c.z, c.z_rate, c.V, c.u, dt);
    const BristleStep fine = by_small_steps(c.law, c.z, c.z_rate, c.V, c.u, dt, 4000);
    const double force = std::max(fine.mean_friction_force.norm(), 1e-9);
    RC_ASSERT((step.bristle - fine.bristle).norm() < 1e-4 * (c.u.norm() + dt * c.V.norm()));
    RC_ASSERT((step.mean_friction_force - fine.mean_friction_force).norm() < 1e-4 * force);
    RC_ASSERT(near(step.tangential_damper, fine.tangential_damper, 1e-3 * fine.tangential_damper + 1e-12));
    RC_ASSERT(near(step.clutch, fine.clutch, 1e-3 * fine.clutch + 1e-12));
}

// At a depth that is held nothing is stored or made but in the bristle itself.
RC_GTEST_PROP(BristleStepProperty, WorkIsStoredOrDissipated, ()) {
    const Case c;
    RC_PRE(c.z > 1e-6);
    const double dt = *decades(1e-6, 1e-1);
    const BristleStep step = BristleStepper(c.law, 1e-7)(c.z, c.z_rate, c.V, c.u, dt);
    const double s = std::sqrt(c.z), before = 0.5 * c.law.friction.stiffness * s * c.u.squaredNorm();
    const double after = 0.5 * c.law.friction.stiffness * s * step.bristle.squaredNorm();
    const double work = -step.mean_friction_force.dot(c.V) * dt;
    const double size = before + after + std::abs(work) + step.clutch + step.tangential_damper;
    RC_ASSERT(near(work, after - before + step.tangential_damper + step.clutch, 1e-5 * size));
    RC_ASSERT(step.tangential_damper >= 0);
    RC_ASSERT(step.clutch >= -1e-6 * size);
}

RC_GTEST_PROP(BristleStepProperty, TwoStepsAreOneTwiceAsLong, ()) {
    const Case c;
    const double dt = *decades(1e-6, 1e-2);
    const BristleStepper stepper(c.law, 1e-8);
    const BristleStep half = stepper(c.z, c.z_rate, c.V, c.u, dt / 2);
    const BristleStep second = stepper(c.z, c.z_rate, c.V, half.bristle, dt / 2);
    const BristleStep whole = stepper(c.z, c.z_rate, c.V, c.u, dt);
    RC_ASSERT((second.bristle - whole.bristle).norm() < 1e-5 * (c.u.norm() + whole.bristle.norm()));
}

// Explicit Euler grows without bound here. Whatever the step, the clutch bounds the force: mu F_n, and C_V times a
// velocity that is at most that of the sphere and of a free bristle together.
RC_GTEST_PROP(BristleStepProperty, IsStableForEveryStep, ()) {
    const Case c;
    const double dt = *decades(1e-6, 1e2);
    const auto& friction = c.law.friction;
    const BristleStepper stepper(c.law);
    Vector2<double> u = c.u;
    for (int i = 0; i < 20; ++i) {
        const BristleStep step = stepper(c.z, c.z_rate, c.V, u, dt);
        const double bound = friction.coefficient * step.normal_force +
                             friction.viscous * (c.V.norm() + friction.recovery_rate() * c.u.norm());
        RC_ASSERT(step.mean_friction_force.norm() <= 1.001 * bound + 1e-12);
        RC_ASSERT(step.bristle.allFinite());
        u = step.bristle;
    }
}

// Without D_t and C_V the bristle is elastic-plastic: the limit of little damping, which is integrated, is the arc that
// is not.
TEST(BristleStep, ElasticPlasticBristleIsTheLimitOfLittleDamping) {
    const Vector2<double> V(0.02, 0.01), u(1e-5, -1.2e-5);
    const Paper plastic{{8.5e6, 3.1e3}, {{12.75e6, 0, 0.02, 0}}}, damped{{8.5e6, 3.1e3}, {{12.75e6, 0.1, 0.02, 0}}};
    for (const double dt : {1e-5, 3e-4, 1e-2}) {
        const BristleStep step = BristleStepper(plastic)(depth, 0, V, u, dt);
        const BristleStep limit = BristleStepper(damped, 1e-7)(depth, 0, V, u, dt);
        EXPECT_NEAR((step.bristle - limit.bristle).norm(), 0, 1e-3 * u.norm()) << dt;
        EXPECT_NEAR((step.mean_friction_force - limit.mean_friction_force).norm(), 0,
                    1e-3 * limit.mean_friction_force.norm())
            << dt;
        EXPECT_NEAR(step.clutch, limit.clutch, 2e-3 * limit.clutch + 1e-9) << dt;
    }
}

TEST(BristleStep, WhatDamperAndClutchTakeIsRightHoweverLongTheStep) {
    // Steps from a tenth of D_t/K_t to a million of it, beside a tolerance a million times finer.
    const Vector2<double> V(1, 0), u(0, 0);
    for (const double dt : {3e-5, 1e-3, 1e-2, 0.1, 2.0}) {
        const BristleStep step = BristleStepper(paper())(depth, 0, V, u, dt);
        const BristleStep fine = BristleStepper(paper(), 1e-10)(depth, 0, V, u, dt);
        const double work = fine.mean_friction_force.norm() * V.norm() * dt;
        EXPECT_NEAR(step.tangential_damper, fine.tangential_damper, 1e-3 * work) << dt;
        EXPECT_NEAR(step.clutch, fine.clutch, 1e-3 * work) << dt;
    }
}

TEST(BristleStep, AStretchedBristleAtRestIsNoLongStep) {
    const Paper no_clutch{{8.5e6, 3.1e3}, {{12.75e6, 3.1e3, 0, 0}}};
    for (const double speed : {0.0, 1e-12, 1e-9}) {
        const BristleStep step = BristleStepper(paper())(1e-3, 0, {speed, 0}, {2e-4, 0}, 1e-3);
        EXPECT_EQ(step.left, 0) << speed;
        EXPECT_GE(step.tangential_damper, 0) << speed;
        EXPECT_EQ(BristleStepper(no_clutch)(1e-3, 0, {speed, 0}, {2e-5, 0}, 1e-3).left, 0) << speed;
    }
}

TEST(BristleStep, WithoutFrictionThereIsOnlyTheNormalForce) {
    const ContactLaw<LinearNormal<>, NoFriction<>> law{{1e4, 0}, {}};
    const BristleStep step = BristleStepper(law)(depth, 0, {1, 1}, {0, 0}, host_step);
    EXPECT_DOUBLE_EQ(step.normal_force, 10);
    EXPECT_EQ(step.mean_friction_force.norm(), 0);
}

TEST(BristleStep, WhatIsNotANumberStaysThatWay) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const BristleStep step = BristleStepper(paper())(nan, 0, {1, 1}, {0, 0}, host_step);
    EXPECT_TRUE(std::isnan(step.normal_force));
    EXPECT_TRUE(std::isnan(step.bristle.x()));
}

}  // namespace
}  // namespace footfall::test
