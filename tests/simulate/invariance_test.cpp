// The same scene seen from elsewhere, in other units, or in a mirror, runs the same.
#include <cmath>
#include <cstddef>
#include <functional>
#include <variant>

#include <gtest/gtest.h>

#include "simulate/scenes.hpp"

namespace footfall {
namespace {

using test::heel_first;

const Simulation& original() {
    static const Simulation s = heel_first(0.3);
    return s;
}
const Run& original_run() {
    static const auto run = footfall::run(original());
    return run;
}

/// Turns the body and its motion about the origin.
BodyState turned(const BodyState& b, const Eigen::Quaterniond& R) {
    return {R * b.position, R * b.velocity, (R * b.orientation).normalized(), R * b.angular_velocity};
}

void expect_same_body(const BodyState& a, const BodyState& b, double limit) {
    EXPECT_LE((a.position - b.position).norm(), limit);
    EXPECT_LE((a.velocity - b.velocity).norm(), 100 * limit);
    EXPECT_LE((a.angular_velocity - b.angular_velocity).norm(), 1000 * limit);
    EXPECT_LE(a.orientation.angularDistance(b.orientation), 100 * limit + 3e-8);  // acos(1 - eps) is 1e-8
}

/// The same events at the same times (over `unit`).
void expect_same_events(const Run& a, const Run& b, double limit, double unit = 1) {
    ASSERT_EQ(a.events.size(), b.events.size());
    for (std::size_t i = 0; i < a.events.size(); ++i) {
        EXPECT_EQ(a.events[i].kind, b.events[i].kind) << i;
        EXPECT_EQ(a.events[i].sphere, b.events[i].sphere) << i;
        EXPECT_NEAR(a.events[i].time, b.events[i].time / unit, limit) << i;
    }
}

TEST(Invariance, TheSceneHasEveryKindOfEvent) {
    for (const EventKind kind :
         {EventKind::touchdown, EventKind::stick, EventKind::slip, EventKind::separation, EventKind::recovered}) {
        EXPECT_GT(test::count(original_run(), kind), 0u) << name_of(kind);
    }
}

TEST(Invariance, TurningTheWorldAboutTheGroundsNormalTurnsTheAnswer) {
    const Eigen::Quaterniond R(Eigen::AngleAxisd(2.1, Eigen::Vector3d::UnitZ()));
    Simulation s = original();
    s.initial = turned(s.initial, R);
    const auto run = footfall::run(s);
    expect_same_body(run.final.body, turned(original_run().final.body, R), 1e-10);
    expect_same_events(original_run(), run, 1e-9);
}

TEST(Invariance, TurningEverythingTurnsTheAnswer) {
    const Eigen::Quaterniond R = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.4).normalized();
    Simulation s = original();
    s.initial = turned(s.initial, R);
    s.gravity = R * s.gravity;
    s.ground.normal = (R * s.ground.normal).normalized();
    const auto run = footfall::run(s);
    expect_same_body(run.final.body, turned(original_run().final.body, R), 1e-10);
    expect_same_events(original_run(), run, 1e-9);
}

TEST(Invariance, MovingTheOriginMovesTheAnswer) {
    const Eigen::Vector3d d(3, -2, 0.7);
    Simulation s = original();
    s.initial.position += d;
    s.ground.height += s.ground.normal.dot(d);
    const auto run = footfall::run(s);
    BodyState expected = original_run().final.body;
    expected.position += d;
    expect_same_body(run.final.body, expected, 1e-10);
    expect_same_events(original_run(), run, 1e-9);
}

// A frame that moves along the ground sees the same, but for the ground's own motion: that of a frictionless body.
TEST(Invariance, WithoutFrictionASteadyMotionAlongTheGroundChangesNothingElse) {
    Simulation s = original();
    for (ContactParameters& c : s.contacts) c.friction = NoFriction<>{};
    const auto slow = footfall::run(s);
    const Eigen::Vector3d w(1.5, -0.8, 0);
    s.initial.velocity += w;
    const auto fast = footfall::run(s);
    BodyState expected = slow.final.body;
    expected.position += w * s.options.end_time;
    expected.velocity += w;
    expect_same_body(fast.final.body, expected, 1e-10);
    expect_same_events(slow, fast, 1e-9);
}

/// y to -y.
Eigen::Vector3d mirrored(const Eigen::Vector3d& v) { return {v.x(), -v.y(), v.z()}; }
Eigen::Vector3d mirrored_axial(const Eigen::Vector3d& v) { return {-v.x(), v.y(), -v.z()}; }
BodyState mirrored(const BodyState& b) {
    const Eigen::Quaterniond& q = b.orientation;
    return {
        mirrored(b.position), mirrored(b.velocity), {q.w(), -q.x(), q.y(), -q.z()}, mirrored_axial(b.angular_velocity)};
}

TEST(Invariance, AMirroredSceneMirrors) {
    Simulation s = original();
    s.initial = mirrored(s.initial);
    for (Sphere& sphere : s.body.spheres) sphere.center = mirrored(sphere.center);
    const auto run = footfall::run(s);
    expect_same_body(run.final.body, mirrored(original_run().final.body), 1e-10);
    expect_same_events(original_run(), run, 1e-9);
}

TEST(Invariance, OtherUnitsOfMassLengthAndTimeGiveTheSameNumbers) {
    const double M = 1000, L = 25, T = 0.3;              // one of the original's units in the new ones
    const double per_root = M / (T * T * std::sqrt(L));  // N/m^1.5 is kg s^-2 m^-1/2
    Simulation s = original();
    s.body.mass *= M;
    s.body.inertia *= M * L * L;
    for (Sphere& sphere : s.body.spheres) {
        sphere.center *= L;
        sphere.radius *= L;
    }
    s.gravity *= L / (T * T);
    s.initial.position *= L;
    s.initial.velocity *= L / T;
    s.initial.angular_velocity /= T;
    for (ContactParameters& c : s.contacts) {
        auto& normal = std::get<AzadFeatherstoneNormal<>>(c.normal);
        auto& friction = std::get<AzadFeatherstoneFriction<>>(c.friction);
        normal.stiffness *= per_root;
        normal.damping *= per_root * T;
        friction.stiffness *= per_root;
        friction.damping *= per_root * T;
        friction.viscous *= M / T;
    }
    s.options.end_time *= T;
    const auto run = footfall::run(s);
    BodyState b = run.final.body;
    b.position /= L;
    b.velocity *= T / L;
    b.angular_velocity *= T;
    expect_same_body(b, original_run().final.body, 1e-10);
    expect_same_events(original_run(), run, 1e-9, T);
    ASSERT_EQ(run.impacts.size(), original_run().impacts.size());
    for (std::size_t i = 0; i < run.impacts.size(); ++i) {
        ASSERT_EQ(run.impacts[i].restitution().has_value(), original_run().impacts[i].restitution().has_value());
        if (run.impacts[i].restitution()) {
            EXPECT_NEAR(*run.impacts[i].restitution(), *original_run().impacts[i].restitution(), 1e-8) << i;
        }
    }
    EXPECT_NEAR(run.energy_scale / (M * L * L / (T * T)) / original_run().energy_scale, 1, 1e-9);
}

}  // namespace
}  // namespace footfall
