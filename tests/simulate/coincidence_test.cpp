// Events that happen together, or nearly so, and bodies that start in awkward places.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "simulate/scenes.hpp"

namespace footfall {
namespace {

using test::finite;
using test::foot;

void expect_sound(const Run& run, double residual = 1e-9) {
    EXPECT_TRUE(finite(run.final));
    EXPECT_LE(run.max_residual, residual);
    for (const Event& event : run.events) {
        EXPECT_LE(event.time, run.final.time) << name_of(event.kind);
        const ContactSnapshot& c = event.state.contacts[static_cast<std::size_t>(event.sphere)];
        // One that was recovering may be loaded again on its way up.
        if (event.kind == EventKind::touchdown && event.time > 0 && c.depth < 1e-15) {
            EXPECT_GE(c.depth_rate, 0) << "touchdown of sphere " << event.sphere << " at " << event.time;
        }
    }
}

/// Runs within a budget that is generous for the scenes here, so that a run that goes nowhere ends as a failure.
Run run_within_budget(Simulation s) {
    s.options.max_evaluations = 300000;
    return footfall::run(s);
}

class NearlyFlatFoot : public testing::TestWithParam<double> {};

// A tilt that puts the landings of heel and toe, and all that follows, 1e-17 to 1e-3 s apart.
TEST_P(NearlyFlatFoot, LandsAndLeavesInOrder) {
    const double tilt = GetParam();
    const double speed = std::sqrt(2 * 0.01 * test::gravity);
    for (const double tolerance : {1e-8, 1e-10, 1e-12}) {
        SCOPED_TRACE(tolerance);
        Simulation s = foot(0.01, 0.1, tolerance);
        s.initial.orientation = Eigen::AngleAxisd(-tilt, Eigen::Vector3d::UnitY());
        const auto run = run_within_budget(s);
        expect_sound(run);
        EXPECT_GE(test::count(run, EventKind::recovered), 4u);
        double landing[4];
        for (int i = 0; i < 4; ++i) {
            const Event* down = test::first(run, EventKind::touchdown, i);
            ASSERT_NE(down, nullptr);
            landing[i] = down->time;
        }
        EXPECT_NEAR(landing[0], landing[1], 1e-13);
        // The toe is 0.2 m times the tilt higher.
        const double late = std::max(landing[2], landing[3]) - landing[0];
        EXPECT_NEAR(late, 0.2 * tilt / speed, 0.05 * tilt / speed + 1e-13);
    }
}

INSTANTIATE_TEST_SUITE_P(Tilts, NearlyFlatFoot,
                         testing::Values(0.0, 1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6,
                                         1e-5, 1e-4, 1e-3));

// Two spheres on one spot do everything together; what rounding parts must not count as another touch.
TEST(Coincidence, NothingTouchesDownWhileItMovesAway) {
    Simulation s = test::paper_ball(0.02, 0.3);
    s.body.spheres.push_back(s.body.spheres[0]);
    s.contacts.push_back(s.contacts[0]);
    for (int k = 0; k < 20; ++k) {
        s.initial.velocity = {0.4, -0.02 * k, 0};
        const auto run = run_within_budget(s);
        expect_sound(run);
        EXPECT_GE(run.impacts.size(), 2u);
    }
}

TEST(Coincidence, ALandingAtTheEndOfTheRunIsSeenOrNotButNothingBreaks) {
    const double landing = std::sqrt(2 * 0.01 / test::gravity);
    for (const double off : {-1e-9, -1e-15, -1e-16, 0.0, 1e-16, 1e-15, 1e-9}) {
        const auto run = run_within_budget(test::paper_ball(0.01, landing + off));
        EXPECT_TRUE(finite(run.final)) << off;
        EXPECT_DOUBLE_EQ(run.final.time, landing + off) << off;
        if (off < -1e-12) {
            EXPECT_TRUE(run.events.empty());
        }
        if (off > 1e-12) {
            EXPECT_EQ(test::count(run, EventKind::touchdown), 1u);
        }
    }
}

TEST(Coincidence, RunsThatEndAtAnEventEndThere) {
    Simulation s = test::paper_ball(0.02, 0.2);
    s.initial.velocity = {0.5, 0.3, 0};
    const auto whole = footfall::run(s);
    for (const Event& event : whole.events) {
        s.options.end_time = event.time;
        const auto part = footfall::run(s);
        EXPECT_TRUE(finite(part.final));
        EXPECT_DOUBLE_EQ(part.final.time, event.time);
        EXPECT_LE((part.final.body.velocity - event.state.body.velocity).norm(), 1e-9) << name_of(event.kind);
        EXPECT_LE((part.final.body.position - event.state.body.position).norm(), 1e-11) << name_of(event.kind);
    }
}

// A run that is cut in two ends where the whole run ends, but for the bristle, which a run starts without.
TEST(Coincidence, ARunCutInFlightGoesOnAsTheWhole) {
    Simulation s = test::heel_first(0.3);
    for (ContactParameters& c : s.contacts) c.friction = NoFriction<>{};
    const auto whole = footfall::run(s);
    double cut = 0;
    for (std::size_t i = 0; i + 1 < whole.events.size(); ++i) {
        const Snapshot& shot = whole.events[i].state;
        const bool flies = std::all_of(shot.contacts.begin(), shot.contacts.end(),
                                       [](const ContactSnapshot& c) { return c.phase == Phase::flight; });
        if (flies && whole.events[i + 1].time > shot.time + 1e-4) cut = (shot.time + whole.events[i + 1].time) / 2;
    }
    ASSERT_GT(cut, 0);
    s.options.end_time = cut;
    s.initial = footfall::run(s).final.body;
    s.initial.orientation.normalize();
    s.options.end_time = 0.3 - cut;
    const auto rest = footfall::run(s);
    EXPECT_LE((rest.final.body.position - whole.final.body.position).norm(), 1e-9);
    EXPECT_LE((rest.final.body.velocity - whole.final.body.velocity).norm(), 1e-7);
}

TEST(Starts, AFootThatRestsOnAllItsSpheresStaysLevel) {
    const auto run = run_within_budget(foot(0, 1));
    expect_sound(run);
    for (const ContactSnapshot& c : run.final.contacts)
        EXPECT_NEAR(c.normal_force / (1.2 * test::gravity / 4), 1, 1e-6);
    EXPECT_LE(run.final.body.velocity.norm(), 1e-8);
}

TEST(Starts, AFootWithOneSphereOnTheGroundTipsOver) {
    Simulation s = foot(0, 1);
    const Eigen::Quaterniond q(Eigen::AngleAxisd(-0.1, Eigen::Vector3d::UnitY()) *
                               Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitX()));
    s.initial.orientation = q;
    double lowest = 1;
    for (const Sphere& sphere : s.body.spheres) lowest = std::min(lowest, (q * sphere.center).z());
    s.initial.position.z() = 0.015 - lowest;
    const auto run = run_within_budget(s);
    expect_sound(run);
    EXPECT_EQ(run.events[0].time, 0);
    EXPECT_EQ(run.events[0].kind, EventKind::touchdown);
    for (const ContactSnapshot& c : run.final.contacts) EXPECT_GT(c.normal_force, 0);
}

TEST(Starts, APenetrationMayMoveInAnyDirection) {
    for (const double depth : {1e-9, 1e-6, 1e-4, 1e-3})
        for (const double vertical : {-3.0, -0.1, 0.0, 0.1, 3.0})
            for (const double along : {0.0, 1e-6, 2.0}) {
                Simulation s = test::paper_ball(-depth, 0.1, 1e-10);
                s.options.allow_initial_penetration = true;
                s.initial.velocity = {along, 0, vertical};
                const auto run = run_within_budget(s);
                SCOPED_TRACE(std::to_string(depth) + " " + std::to_string(vertical) + " " + std::to_string(along));
                expect_sound(run);
                ASSERT_FALSE(run.events.empty());
                EXPECT_EQ(run.events[0].kind, EventKind::touchdown);
                EXPECT_EQ(run.events[0].time, 0);
                EXPECT_EQ(run.impacts[0].touchdown, 0);
            }
}

// Where both sides of (26) are zero, at a touchdown straight down, the contact sticks: there is nothing to slip.
TEST(Starts, ABallThatLandsStraightSticks) {
    const auto run = run_within_budget(test::paper_ball(0.01, 0.0455));
    ASSERT_GE(run.events.size(), 2u);
    EXPECT_EQ(run.events[1].kind, EventKind::stick);
    EXPECT_EQ(run.final.ledger.contact.clutch, 0);
    EXPECT_EQ(run.final.ledger.contact.stiffness_change, 0);
}

// A grain, a boulder, a planet: the tolerance is relative to what the run itself shows.
TEST(Scales, GrainsAndBouldersRunAsAccurately) {
    for (const double size : {1e-5, 1e-3, 1.0, 1e2}) {
        SCOPED_TRACE(size);
        const double mass = 2500 * 4.19 * size * size * size;
        Simulation s;
        s.body.mass = mass;
        s.body.inertia = solid_sphere_inertia(mass, size);
        s.body.spheres = {{.radius = size}};
        s.gravity = {0, 0, -1 / size};
        s.initial.position = {0, 0, 1.1 * size};
        s.initial.velocity = {1, 0, -1};
        const double stiffness = 1e10 * std::sqrt(size);  // E sqrt(r)
        s.contacts = {{AzadFeatherstoneNormal<>{stiffness, 1e-4 * size * stiffness},
                       AzadFeatherstoneFriction<>{{stiffness, 1e-4 * size * stiffness, 0.3, 0}}}};
        s.options.end_time = 0.3 * size;
        s.options.tolerance = 1e-12;
        const auto run = run_within_budget(s);
        expect_sound(run, 1e-11);
        EXPECT_EQ(run.impacts.size(), 1u);
        EXPECT_TRUE(run.impacts[0].recovered);
    }
}

}  // namespace
}  // namespace footfall
