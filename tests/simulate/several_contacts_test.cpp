// Several spheres on one body: each contact keeps its own force and its own bristle, and together they move the body.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <variant>

#include <gtest/gtest.h>

#include "simulate/scenes.hpp"

namespace footfall {
namespace {

using test::foot;
using test::heel_first;

TEST(SeveralContacts, AFlatFootLandsOnAllItsSpheresAtOnce) {
    Simulation s = foot(0.01, 0.06);
    s.options.sample_period = 1e-4;
    const auto run = footfall::run(s);
    double landing = -1;
    for (int i = 0; i < 4; ++i) {
        const Event* touchdown = test::first(run, EventKind::touchdown, i);
        ASSERT_NE(touchdown, nullptr);
        if (i == 0) landing = touchdown->time;
        EXPECT_EQ(touchdown->time, landing);
    }
    EXPECT_NEAR(landing, std::sqrt(2 * 0.01 / 9.81), 1e-12);
    double largest = 0;
    for (const Snapshot& shot : run.samples) {
        const double force = shot.contacts[0].normal_force;
        largest = std::max(largest, force);
        for (int i = 1; i < 4; ++i)
            EXPECT_NEAR(shot.contacts[static_cast<std::size_t>(i)].normal_force, force, 1e-6 * (1 + force))
                << shot.time;
    }
    EXPECT_GT(largest, 10);
    EXPECT_LE(run.final.body.angular_velocity.norm(), 1e-8);
}

TEST(SeveralContacts, AFootPutDownHeelFirstLandsHeelThenToe) {
    const auto run = footfall::run(heel_first(0.4));
    std::array<double, 4> landing{};
    for (int i = 0; i < 4; ++i) {
        const Event* touchdown = test::first(run, EventKind::touchdown, i);
        ASSERT_NE(touchdown, nullptr);
        landing[static_cast<std::size_t>(i)] = touchdown->time;
    }
    EXPECT_LT(std::max(landing[0], landing[1]), std::min(landing[2], landing[3]));
}

// The heel lifts while the toe presses, and the other way round: each books the work of its own force, and of no other.
TEST(SeveralContacts, OneSphereSeparatesWhileAnotherPresses) {
    Simulation s = heel_first(0.12);
    const double period = 1e-6;
    s.options.sample_period = period;
    const auto run = footfall::run(s);
    const auto& shots = run.samples;
    std::size_t mixed = 0, looked_at = 0;
    for (std::size_t k = 2; k + 2 < shots.size(); k += 13) {
        const bool smooth = test::smooth_around(run, k, period);
        bool pressed = false, lifted = false;
        for (std::size_t i = 0; i < 4; ++i) {
            const ContactSnapshot& c = shots[k].contacts[i];
            const bool presses = c.phase == Phase::stick || c.phase == Phase::slip;
            pressed = pressed || presses;
            lifted = lifted || !presses;
            if (!presses) {
                EXPECT_EQ(c.normal_force, 0);
                EXPECT_EQ(c.friction_force.norm(), 0);
            }
            if (!presses || !smooth) continue;
            const auto booked = [&](std::size_t at) {
                const ContactEnergy& e = shots[at].contacts[i].energy;
                return e.stored() + e.dissipated() + e.stiffness_change;
            };
            const double power = c.normal_force * c.depth_rate - c.friction_force.dot(c.slip_velocity);
            EXPECT_NEAR(test::rate_at(booked, k, period), power, 1e-6 * (10 + std::abs(power))) << shots[k].time;
            ++looked_at;
        }
        mixed += pressed && lifted ? 1u : 0u;
    }
    EXPECT_GT(mixed, 100u);
    EXPECT_GT(looked_at, 500u);
}

// A push at one end of a body whose moment of inertia is m a^2 does not move the other end, 2 a away: each end is a
// ball of half the mass, but for the square of the angle.
TEST(SeveralContacts, TheEndsOfABodyThatDoNotFeelEachOtherBounceAsBallsOfHalfTheMass) {
    const double a = 0.1, mass = 2 * test::ball_mass, speed = 0.3, apart = 1e-4;
    const auto ball = [&](double gap) {
        Simulation s = test::paper_ball(gap, 4e-3, 1e-11);
        s.initial.velocity = {0, 0, -speed};
        s.contacts[0].friction = NoFriction<>{};
        s.options.sample_period = 1e-5;
        return s;
    };
    Simulation both = ball(apart);
    both.body.mass = mass;
    both.body.inertia = Eigen::Vector3d(0.6, 1, 1).asDiagonal() * (mass * a * a);
    both.body.spheres = {{{-a, 0, 0}, test::ball_radius}, {{a, 0, 0}, test::ball_radius}};
    both.contacts.assign(2, both.contacts[0]);
    // Turned about y, +x goes down: by `apart`, and -x up.
    both.initial.orientation = Eigen::AngleAxisd(std::asin(apart / a), Eigen::Vector3d::UnitY());
    const auto run = footfall::run(both), late = footfall::run(ball(2 * apart)), early = footfall::run(ball(0));
    ASSERT_EQ(run.samples.size(), late.samples.size());
    double largest = 0;
    std::size_t together = 0, alone = 0;
    for (std::size_t k = 0; k < run.samples.size(); ++k) {
        const ContactSnapshot &first = run.samples[k].contacts[1], &second = run.samples[k].contacts[0];
        const double early_force = early.samples[k].contacts[0].normal_force,
                     late_force = late.samples[k].contacts[0].normal_force;
        EXPECT_NEAR(first.normal_force, early_force, 1e-2) << run.samples[k].time;
        EXPECT_NEAR(second.normal_force, late_force, 1e-2) << run.samples[k].time;
        largest = std::max(largest, early_force);
        together += early_force > 0 && late_force > 0 ? 1u : 0u;
        alone += early_force == 0 && late_force > 0 ? 1u : 0u;  // one has separated while the other presses
    }
    EXPECT_GT(largest, 10);
    EXPECT_GT(together, 10u);
    EXPECT_GT(alone, 10u);
}

TEST(SeveralContacts, TheSumOfTheirForcesMovesTheBody) {
    Simulation s = heel_first(0.12);
    const double period = 1e-6;
    s.options.sample_period = period;
    const auto run = footfall::run(s);
    const auto& shots = run.samples;
    std::size_t looked_at = 0, mixed = 0;
    double largest = 0;
    for (std::size_t i = 2; i + 2 < shots.size(); i += 97) {
        if (!test::smooth_around(run, i, period)) continue;
        Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = force;
        int pressed = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const ContactSnapshot& c = shots[i].contacts[k];
            const Eigen::Vector3d f = c.friction_force + c.normal_force * s.ground.normal;
            const Eigen::Vector3d arm =
                shots[i].body.orientation * s.body.spheres[k].center - s.body.spheres[k].radius * s.ground.normal;
            force += f;
            moment += arm.cross(f);
            pressed += c.normal_force > 0 ? 1 : 0;
        }
        const Eigen::Vector3d acceleration =
            test::rate_at([&](std::size_t j) { return shots[j].body.velocity; }, i, period);
        const Eigen::Vector3d turning =
            test::rate_at([&](std::size_t j) { return test::angular_momentum(s.body, shots[j].body); }, i, period);
        EXPECT_LE((s.body.mass * (acceleration - s.gravity) - force).norm(), 1e-6 * (10 + force.norm()))
            << shots[i].time;
        EXPECT_LE((turning - moment).norm(), 1e-6 * (1 + moment.norm())) << shots[i].time;
        largest = std::max(largest, force.norm());
        ++looked_at;
        mixed += pressed > 0 && pressed < 4 ? 1u : 0u;
    }
    EXPECT_GT(looked_at, 500u);
    EXPECT_GT(mixed, 50u);
    EXPECT_GT(largest, 50);
}

TEST(SeveralContacts, ASphereListedTwiceAtHalfStrengthIsOneSphere) {
    Simulation one = test::paper_ball(0.02, 0.3);
    one.initial.velocity = {0.4, -0.2, 0};
    Simulation two = one;
    two.body.spheres.push_back(two.body.spheres[0]);
    two.contacts.assign(
        2, {AzadFeatherstoneNormal<>{4.25e6, 1.55e3}, AzadFeatherstoneFriction<>{{6.375e6, 1.55e3, 0.2, 0.05}}});
    const auto a = footfall::run(one), b = footfall::run(two);
    EXPECT_LE((a.final.body.position - b.final.body.position).norm(), 1e-10);
    EXPECT_LE((a.final.body.velocity - b.final.body.velocity).norm(), 1e-9);
    EXPECT_LE((a.final.body.angular_velocity - b.final.body.angular_velocity).norm(), 1e-7);
    ASSERT_EQ(b.events.size(), 2 * a.events.size());
    for (const int sphere : {0, 1}) {
        std::size_t k = 0;
        for (const Event& event : b.events) {
            if (event.sphere != sphere) continue;
            EXPECT_EQ(event.kind, a.events[k].kind);
            EXPECT_NEAR(event.time, a.events[k].time, 1e-9);
            ++k;
        }
    }
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_NEAR(b.final.contacts[i].energy.normal_damper, a.final.contacts[0].energy.normal_damper / 2, 1e-9);
}

// Each sphere has parameters of its own.
TEST(SeveralContacts, ASphereOnIceSlidesWhileTheOtherHolds) {
    Simulation s = foot(0, 0.3, 1e-10);
    for (const std::size_t i : {0u, 1u}) std::get<AzadFeatherstoneFriction<>>(s.contacts[i].friction).coefficient = 0;
    for (const std::size_t i : {0u, 1u}) std::get<AzadFeatherstoneFriction<>>(s.contacts[i].friction).viscous = 0;
    s.gravity = {1.5, 0, -9.81};
    const auto run = footfall::run(s);
    EXPECT_EQ(run.final.contacts[0].phase, Phase::slip);
    EXPECT_EQ(run.final.contacts[2].phase, Phase::stick);
    EXPECT_LE(run.final.contacts[0].friction_force.norm(), 1e-9);
    // At rest the two toes carry the whole pull.
    EXPECT_NEAR(run.final.contacts[2].friction_force.x() + run.final.contacts[3].friction_force.x(), -1.2 * 1.5, 1e-3);
}

}  // namespace
}  // namespace footfall
