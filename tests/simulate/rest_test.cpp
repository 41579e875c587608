// Bodies that rest, come to rest, slide and roll on slopes, and contacts that only graze.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <variant>

#include <gtest/gtest.h>

#include "simulate/scenes.hpp"

namespace footfall {
namespace {

using test::ball_mass;
using test::ball_radius;
using test::finite;
using test::gravity;
using test::paper_ball;

/// Where the spring carries the ball's weight [m].
const double static_depth = std::pow(ball_mass * gravity / 8.5e6, 2.0 / 3.0);

TEST(Rest, ABallPutOnTheGroundSinksToWhereTheSpringCarriesIt) {
    const auto run = footfall::run(paper_ball(0, 1));
    EXPECT_NEAR(run.final.contacts[0].depth / static_depth, 1, 1e-9);
    EXPECT_NEAR(run.final.contacts[0].normal_force / (ball_mass * gravity), 1, 1e-9);
    EXPECT_LE(run.final.body.velocity.norm(), 1e-10);
    ASSERT_FALSE(run.events.empty());
    EXPECT_EQ(run.events[0].kind, EventKind::touchdown);
    EXPECT_EQ(run.events[0].time, 0);
    EXPECT_FALSE(run.impacts[0].restitution());
}

TEST(Rest, ABallAtItsDepthOfEquilibriumStaysThere) {
    Simulation s = paper_ball(-static_depth, 1);
    s.options.allow_initial_penetration = true;
    s.options.sample_period = 0.01;
    const auto run = footfall::run(s);
    for (const Snapshot& shot : run.samples) {
        EXPECT_NEAR(shot.contacts[0].depth / static_depth, 1, 1e-10) << shot.time;
        EXPECT_LE(shot.body.velocity.norm(), 1e-12) << shot.time;
    }
    EXPECT_LT(run.cost.evaluations, 20000);
}

TEST(Rest, ABouncingBallComesToRestAfterFinitelyManyImpacts) {
    Simulation s = paper_ball(0.05, 3);
    const auto run = footfall::run(s);
    EXPECT_GT(run.impacts.size(), 5u);
    EXPECT_LT(run.impacts.size(), 200u);
    EXPECT_FALSE(run.impacts.back().recovered) << "the last contact is still on";
    EXPECT_LT(run.impacts.back().touchdown, 1.5);
    EXPECT_NEAR(run.final.contacts[0].depth / static_depth, 1, 1e-9);
    for (std::size_t i = 1; i < run.impacts.size(); ++i)
        EXPECT_LT(run.impacts[i].speed_in, run.impacts[i - 1].speed_in);
}

TEST(Rest, IsCheap) {
    const auto brief = footfall::run(paper_ball(0, 1)), lengthy = footfall::run(paper_ball(0, 100));
    EXPECT_LT(lengthy.cost.evaluations, 20 * brief.cost.evaluations);
    EXPECT_NEAR(lengthy.final.contacts[0].depth / static_depth, 1, 1e-9);
}

/// Tilts the ground about y so that gravity pulls along +x of the slope; the world's frame is the slope's.
Simulation on_slope(Simulation s, double angle) {
    s.gravity = gravity * Eigen::Vector3d(std::sin(angle), 0, -std::cos(angle));
    return s;
}

void take_viscosity_off(Simulation& s) {
    for (ContactParameters& c : s.contacts) std::get<AzadFeatherstoneFriction<>>(c.friction).viscous = 0;
}

constexpr double degree = std::numbers::pi / 180;

/// The mean acceleration along the slope over the last tenth of a run.
double late_acceleration(Simulation s) {
    s.options.sample_period = s.options.end_time / 10;
    const auto run = footfall::run(s);
    const Snapshot &a = run.samples[9], &b = run.samples[10];
    return (b.body.velocity.x() - a.body.velocity.x()) / (b.time - a.time);
}

TEST(Slopes, AFootSticksBelowTheAngleOfFriction) {
    Simulation s = on_slope(test::foot(0, 1), 20 * degree);  // mu = 0.5: 26.6 degrees
    const auto run = footfall::run(s);
    EXPECT_LE(run.final.body.velocity.norm(), 1e-7);
    double friction = 0, normal = 0;
    for (const ContactSnapshot& c : run.final.contacts) {
        EXPECT_EQ(c.phase, Phase::stick);
        friction += c.friction_force.x();
        normal += c.normal_force;
    }
    EXPECT_NEAR(friction / (-1.2 * gravity * std::sin(20 * degree)), 1, 1e-6);
    EXPECT_NEAR(normal / (1.2 * gravity * std::cos(20 * degree)), 1, 1e-6);
}

TEST(Slopes, AFootSlidesAboveTheAngleOfFriction) {
    Simulation s = on_slope(test::foot(0, 1), 35 * degree);
    take_viscosity_off(s);
    const double expected = gravity * (std::sin(35 * degree) - 0.5 * std::cos(35 * degree));
    EXPECT_NEAR(late_acceleration(s) / expected, 1, 1e-6);
}

TEST(Slopes, ABallRollsAtFiveSeventhsWhereItsContactSticks) {
    Simulation s = on_slope(paper_ball(0, 1), 30 * degree);  // atan(7/2 mu) = 35.0 degrees
    take_viscosity_off(s);
    EXPECT_NEAR(late_acceleration(s) / (5.0 / 7.0 * gravity * 0.5), 1, 1e-6);
    EXPECT_EQ(footfall::run(s).final.contacts[0].phase, Phase::stick);
}

TEST(Slopes, ABallSlidesAndSpinsUpWhereItsContactSlips) {
    Simulation s = on_slope(paper_ball(0, 1), 45 * degree);
    take_viscosity_off(s);
    s.options.sample_period = 0.1;
    const auto run = footfall::run(s);
    EXPECT_EQ(run.final.contacts[0].phase, Phase::slip);
    const Snapshot &a = run.samples[9], &b = run.samples[10];
    const double span = b.time - a.time;
    EXPECT_NEAR((b.body.velocity.x() - a.body.velocity.x()) / span / (gravity * 0.8 * std::sqrt(0.5)), 1, 1e-6);
    EXPECT_NEAR((b.body.angular_velocity.y() - a.body.angular_velocity.y()) / span /
                    (2.5 * 0.2 * gravity * std::sqrt(0.5) / ball_radius),
                1, 1e-6);
}

/// A ball that gravity pulls away from the ground: it comes down, turns at a height and goes up again.
Simulation grazing(double lowest) {
    Simulation s = paper_ball(0, 0.2);
    s.gravity = {0, 0, gravity};
    s.initial.velocity = {0.5, 0, -0.9};
    s.initial.position.z() = ball_radius + lowest + 0.9 * 0.9 / (2 * gravity);
    return s;
}

TEST(Grazing, AMissByANanometreIsNoContact) {
    const auto run = footfall::run(grazing(1e-9));
    EXPECT_TRUE(run.events.empty());
    EXPECT_NEAR(run.final.body.velocity.z(), -0.9 + 0.2 * gravity, 1e-13);
}

// Wherever the turning point lies in a step.
TEST(Grazing, ATouchByANanometreIsAContact) {
    for (double end = 0.12; end < 0.3; end += 0.01) {
        SCOPED_TRACE(end);
        Simulation s = grazing(-1e-9);
        s.options.end_time = end;
        const auto run = footfall::run(s);
        EXPECT_TRUE(finite(run.final));
        EXPECT_EQ(run.impacts.size(), 1u);
        if (run.impacts.empty()) continue;
        const double half = std::sqrt(2e-9 / gravity);
        EXPECT_NEAR(run.impacts[0].touchdown, 0.9 / gravity - half, 1e-9);
        ASSERT_TRUE(run.impacts[0].recovered);
        EXPECT_NEAR(*run.impacts[0].recovered, 0.9 / gravity + half, 1e-7);  // its forces are a millionth of the pull
        EXPECT_NEAR(run.impacts[0].peak_indentation, 1e-9, 1e-12);
    }
}

TEST(Grazing, DipsOfEveryDepthAreFound) {
    for (const double depth : {1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3}) {
        for (double end = 0.15; end < 0.3; end += 0.025) {
            Simulation s = grazing(-depth);
            s.options.end_time = end;
            EXPECT_EQ(footfall::run(s).impacts.size(), 1u) << depth << " until " << end;
        }
    }
}

TEST(Grazing, ABallOnTheGroundThatMovesAwayHasNoContact) {
    Simulation s = paper_ball(0, 0.1);
    s.gravity = {0, 0, 0};
    s.initial.velocity = {0.3, 0, 0.2};
    const auto run = footfall::run(s);
    EXPECT_TRUE(run.events.empty());
    EXPECT_LE((run.final.body.velocity - s.initial.velocity).norm(), 1e-15);
}

TEST(Grazing, ABallOnTheGroundThatIsThrownUpLandsAgain) {
    Simulation s = paper_ball(0, 0.1);
    s.initial.velocity = {0.3, 0, 0.2};
    const auto run = footfall::run(s);
    ASSERT_FALSE(run.events.empty());
    EXPECT_EQ(run.events[0].kind, EventKind::touchdown);
    EXPECT_NEAR(run.events[0].time, 2 * 0.2 / gravity, 1e-12);
}

TEST(Grazing, ABallOnTheGroundWithoutGravityStaysUntouched) {
    for (const double along : {0.0, 0.5}) {
        Simulation s = paper_ball(0, 0.1);
        s.gravity = {0, 0, 0};
        s.initial.velocity = {along, 0, 0};
        const auto run = footfall::run(s);
        EXPECT_TRUE(run.events.empty());
        EXPECT_TRUE(finite(run.final));
        EXPECT_EQ(run.final.body.velocity, s.initial.velocity);
        EXPECT_EQ(run.final.contacts[0].normal_force, 0);
    }
}

TEST(Grazing, AFootCanSpinOverTheGroundAndDipAToeIn) {
    Simulation s = test::foot(0, 1, 1e-10);
    s.gravity = {0, 0, 0};
    s.initial.angular_velocity = {0, 12, 0};
    s.initial.position = {0, 0, 0.119};  // the spheres' centres run on a circle of radius sqrt(0.1^2 + 0.03^2)
    const auto run = footfall::run(s);
    EXPECT_GT(std::hypot(0.1, 0.03) + 0.015, 0.119);
    EXPECT_GE(run.impacts.size(), 2u);
    EXPECT_TRUE(finite(run.final));
    EXPECT_LE(run.max_residual, 1e-8);
}

}  // namespace
}  // namespace footfall
