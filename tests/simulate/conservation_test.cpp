// What a run must keep, and the motions that are known in closed form.
#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "simulate/scenes.hpp"

namespace footfall {
namespace {

using test::paper_ball;

/// A body that turns freely, far above the ground and without gravity.
Simulation spinning(const Eigen::Vector3d& moments, const Eigen::Vector3d& angular_velocity, double end_time) {
    Simulation s;
    s.body.mass = 2;
    s.body.inertia = moments.asDiagonal();
    s.body.spheres = {{.center = {0.1, 0.05, -0.2}, .radius = 0.02}};
    s.gravity = {0, 0, 0};
    s.initial.position = {0, 0, 10};
    s.initial.orientation = Eigen::Quaterniond(0.8, 0.1, -0.5, 0.3).normalized();
    s.initial.angular_velocity = angular_velocity;
    s.contacts = {{test::paper_normal(), test::paper_friction()}};
    s.options.end_time = end_time;
    s.options.sample_period = end_time / 50;
    s.options.tolerance = 1e-13;
    return s;
}

TEST(FreeFlight, KeepsAngularMomentumAndKineticEnergyOfABodyWithThreeMoments) {
    const Simulation s = spinning({0.02, 0.035, 0.05}, {3, 8, -5}, 5);
    const auto run = footfall::run(s);
    const Eigen::Vector3d L = test::angular_momentum(s.body, s.initial);
    Eigen::Vector3d slowest = s.initial.angular_velocity, fastest = slowest;
    for (const Snapshot& shot : run.samples) {
        const Eigen::Vector3d& w = shot.body.angular_velocity;
        EXPECT_LE((test::angular_momentum(s.body, shot.body) - L).norm(), 1e-12 * L.norm()) << shot.time;
        EXPECT_NEAR(w.dot(L) / s.initial.angular_velocity.dot(L), 1, 1e-12) << shot.time;
        EXPECT_NEAR(shot.body.orientation.norm(), 1, 1e-12) << shot.time;
        slowest = slowest.cwiseMin(w);
        fastest = fastest.cwiseMax(w);
    }
    EXPECT_GT((fastest - slowest).minCoeff(), 1);  // it tumbles
}

// Euler: a symmetric top turns steadily about its axis e, and its axis steadily about L, at |L|/I_1.
TEST(FreeFlight, PrecessesASymmetricTopAtItsAnalyticRate) {
    const double across = 0.03, along = 0.05;
    const Simulation s = spinning({across, across, along}, {3, 8, -5}, 4);
    const auto run = footfall::run(s);
    const Eigen::Quaterniond q0 = s.initial.orientation;
    const Eigen::Vector3d L = test::angular_momentum(s.body, s.initial);
    const double spin = (q0.conjugate() * s.initial.angular_velocity).z() * (1 - along / across);
    for (const Snapshot& shot : run.samples) {
        const Eigen::Quaterniond precession(Eigen::AngleAxisd(L.norm() / across * shot.time, L.normalized()));
        const Eigen::Quaterniond own(Eigen::AngleAxisd(spin * shot.time, Eigen::Vector3d::UnitZ()));
        const Eigen::Matrix3d expected = (precession * q0 * own).toRotationMatrix();
        EXPECT_LE((shot.body.orientation.toRotationMatrix() - expected).norm(), 1e-10) << shot.time;
    }
    EXPECT_GT(L.norm() / across * s.options.end_time, 30);  // several turns
}

TEST(FreeFlight, IsAParabola) {
    Simulation s = paper_ball(3, 0.7);
    s.initial.velocity = {0.4, -1.1, 2};
    const auto run = footfall::run(s);
    const double t = 0.7;
    EXPECT_LE((run.final.body.position - (s.initial.position + t * s.initial.velocity + t * t / 2 * s.gravity)).norm(),
              1e-14);
    EXPECT_LE((run.final.body.velocity - (s.initial.velocity + t * s.gravity)).norm(), 1e-14);
    EXPECT_TRUE(run.events.empty());
}

std::vector<NormalLaw> elastic_laws() {
    return {AzadFeatherstoneNormal<>{8.5e6, 0}, HuntCrossleyNormal<>{8.5e6, 0},
            HuntCrossleyNormal<>{1e5, 0, 1.2, 0.7, 1}, LinearNormal<>{1e5, 0}};
}

TEST(ElasticImpact, ReturnsTheSpeed) {
    for (const NormalLaw& law : elastic_laws()) {
        Simulation s = paper_ball(1e-4, 0.1, 1e-13);
        s.gravity = {0, 0, 0};
        s.initial.velocity = {0, 0, -1};
        s.contacts = {{law, NoFriction<>{}}};
        const auto run = footfall::run(s);
        ASSERT_EQ(run.impacts.size(), 1u) << name_of(law);
        ASSERT_TRUE(run.impacts[0].restitution()) << name_of(law);
        EXPECT_NEAR(*run.impacts[0].restitution(), 1, 1e-12) << name_of(law);
        EXPECT_NEAR(run.impacts[0].separation.value_or(-1), run.impacts[0].recovered.value_or(-2), 1e-9)
            << name_of(law);
        EXPECT_EQ(run.final.ledger.contact.dissipated(), 0) << name_of(law);
    }
}

// The time that a linear spring holds a mass is half its period; that of Hertz's is 2.9432751 z_max / v, with
// z_max = (5 m v^2 / 4 K)^(2/5) (Johnson, Contact Mechanics, section 11.4).
TEST(ElasticImpact, LastsAsLongAsTheoryHasIt) {
    Simulation s = paper_ball(1e-4, 0.1, 1e-13);
    s.gravity = {0, 0, 0};
    s.initial.velocity = {0, 0, -1};
    s.contacts = {{LinearNormal<>{1e5, 0}, NoFriction<>{}}};
    const auto linear = footfall::run(s);
    EXPECT_NEAR(*linear.impacts[0].recovered - linear.impacts[0].touchdown, M_PI * std::sqrt(test::ball_mass / 1e5),
                1e-13);
    EXPECT_NEAR(linear.impacts[0].peak_indentation, std::sqrt(test::ball_mass / 1e5), 1e-13);
    s.contacts = {{AzadFeatherstoneNormal<>{8.5e6, 0}, NoFriction<>{}}};
    const auto hertz = footfall::run(s);
    const double deepest = std::pow(5 * test::ball_mass / (4 * 8.5e6), 0.4);
    const double lasts = 2 * std::sqrt(M_PI) / 5 * 2 * std::tgamma(0.4) / std::tgamma(0.9) * deepest;  // beta function
    EXPECT_NEAR(lasts / deepest, 2.9432751, 1e-7);
    EXPECT_NEAR((*hertz.impacts[0].recovered - hertz.impacts[0].touchdown) / lasts, 1, 1e-9);
    EXPECT_NEAR(hertz.impacts[0].peak_indentation / deepest, 1, 1e-12);
}

TEST(FrictionlessImpact, LeavesTangentialVelocityAndSpinAlone) {
    Simulation s = paper_ball(0.01, 0.3);
    s.initial.velocity = {0.7, -0.4, 0};
    s.initial.angular_velocity = {5, 6, 7};
    s.contacts[0].friction = NoFriction<>{};
    const auto run = footfall::run(s);
    ASSERT_GE(run.impacts.size(), 2u);
    for (const Eigen::Index axis : {0, 1}) EXPECT_EQ(run.final.body.velocity[axis], s.initial.velocity[axis]);
    EXPECT_LE((run.final.body.angular_velocity - s.initial.angular_velocity).norm(), 1e-14);
}

TEST(FrictionlessImpact, IsWhatTheFrictionLawsBecomeWithoutTheirCoefficients) {
    Simulation s = paper_ball(0.01, 0.3);
    s.initial.velocity = {0.7, -0.4, 0};
    s.contacts[0].friction = AzadFeatherstoneFriction<>{{12.75e6, 3.1e3, 0, 0}};
    const auto run = footfall::run(s);
    EXPECT_LE((run.final.body.velocity.head<2>() - s.initial.velocity.head<2>()).norm(), 1e-14);
    EXPECT_LE(run.final.body.angular_velocity.norm(), 1e-12);
}

TEST(VerticalDrop, NeverMovesSideways) {
    Simulation s = paper_ball(0.1, 1);
    s.options.sample_period = 1e-3;
    for (const Snapshot& shot : footfall::run(s).samples) {
        EXPECT_EQ(shot.body.position.head<2>().norm(), 0) << shot.time;
        EXPECT_EQ(shot.body.velocity.head<2>().norm(), 0) << shot.time;
        EXPECT_EQ(shot.body.angular_velocity.norm(), 0) << shot.time;
        EXPECT_EQ(shot.contacts[0].friction_force.norm(), 0) << shot.time;
    }
}

// A contact that pushes at one point has no torque about its normal.
TEST(SpinAboutTheNormal, IsKeptByABall) {
    Simulation s = paper_ball(0.02, 0.5);
    s.initial.velocity = {0.3, 0, 0};
    s.initial.angular_velocity = {4, -20, 13};
    EXPECT_NEAR(footfall::run(s).final.body.angular_velocity.z(), 13, 1e-12);
}

TEST(ElasticBouncing, KeepsItsHeightForFiftyBounces) {
    Simulation s = paper_ball(0.1, 1, 1e-12);
    s.contacts = {{AzadFeatherstoneNormal<>{8.5e6, 0}, NoFriction<>{}}};
    const double period = 2 * std::sqrt(2 * 0.1 / test::gravity);
    s.options.end_time = 50.5 * period;
    const auto run = footfall::run(s);
    ASSERT_GE(run.impacts.size(), 50u);
    const double speed = std::sqrt(2 * test::gravity * 0.1);
    for (std::size_t i = 0; i < 50; ++i) {
        EXPECT_NEAR(run.impacts[i].speed_in, speed, 1e-10) << i;
        EXPECT_NEAR(run.impacts[i].speed_out.value_or(0), speed, 1e-10) << i;
    }
    EXPECT_LE(run.max_residual, 1e-11);
}

}  // namespace
}  // namespace footfall
