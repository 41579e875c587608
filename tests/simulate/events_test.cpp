// What is true of the state at every kind of event, and of the order in which they come.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "simulate/scenes.hpp"

namespace footfall {
namespace {

using test::ball_mass;
using test::ball_radius;
using test::foot;
using test::heel_first;
using test::paper_ball;

struct Scene {
    std::string name;
    Simulation simulation;
    Run run = footfall::run(simulation);
};

/// Every kind of event, on one sphere and on four.
const std::vector<Scene>& scenes() {
    static const std::vector<Scene> all = [] {
        Simulation thrown = paper_ball(0.05, 0.6);
        thrown.initial.velocity = {0.5, 0.3, 0};
        Simulation spinning = paper_ball(0.02, 0.5);
        spinning.initial.angular_velocity = {0, 60, 30};
        return std::vector<Scene>{{"thrown ball", thrown}, {"spinning ball", spinning}, {"foot", heel_first(0.4)}};
    }();
    return all;
}

/// z from where the body stands, not from what the contact says of itself [m].
double geometric_depth(const Simulation& s, const Snapshot& shot, std::size_t sphere) {
    const Sphere& p = s.body.spheres[sphere];
    return p.radius + s.ground.height - s.ground.normal.dot(shot.body.position + shot.body.orientation * p.center);
}

/// How large forces and depths get on this sphere in this run.
double peak_force(const Run& run) {
    double peak = 0;
    for (const Impact& impact : run.impacts) peak = std::max(peak, impact.peak_normal_force);
    return peak;
}

template <class Check>
void at_every(EventKind kind, Check&& check) {
    for (const Scene& scene : scenes()) {
        SCOPED_TRACE(scene.name);
        std::size_t seen = 0;
        for (const Event& event : scene.run.events) {
            if (event.kind != kind) continue;
            ++seen;
            const auto i = static_cast<std::size_t>(event.sphere);
            SCOPED_TRACE(std::string(name_of(kind)) + " of sphere " + std::to_string(i) + " at " +
                         std::to_string(event.time));
            check(scene, event, event.state.contacts[i]);
        }
        EXPECT_GT(seen, 0u) << "the scene shows nothing of this";
    }
}

TEST(Events, TouchdownIsWhereTheDepthIsZero) {
    at_every(EventKind::touchdown, [](const Scene& scene, const Event& event, const ContactSnapshot& c) {
        EXPECT_NEAR(geometric_depth(scene.simulation, event.state, static_cast<std::size_t>(event.sphere)), 0, 1e-14);
        EXPECT_GT(c.depth_rate, 0);
        EXPECT_LE(c.normal_force, 1e-6 * peak_force(scene.run));
        EXPECT_TRUE(c.phase == Phase::stick || c.phase == Phase::slip);
    });
}

TEST(Events, StickAndSlipAreWhereTheFrictionIsOnItsCone) {
    for (const EventKind kind : {EventKind::stick, EventKind::slip}) {
        at_every(kind, [&](const Scene& scene, const Event& event, const ContactSnapshot& c) {
            EXPECT_EQ(c.phase, kind == EventKind::stick ? Phase::stick : Phase::slip);
            EXPECT_GT(c.depth, 0);
            for (const Event& other : scene.run.events)  // a contact that sticks at once begins inside the cone
                if (other.sphere == event.sphere && other.time == event.time && other.kind == EventKind::touchdown)
                    return;
            const auto i = static_cast<std::size_t>(event.sphere);
            const double mu = std::get<AzadFeatherstoneFriction<>>(scene.simulation.contacts[i].friction).coefficient;
            EXPECT_NEAR(c.friction_force.norm(), mu * c.normal_force, 1e-9 * peak_force(scene.run));
        });
    }
}

TEST(Events, SeparationIsWhereTheForceEndsBeforeTheDepthDoes) {
    at_every(EventKind::separation, [](const Scene& scene, const Event& event, const ContactSnapshot& c) {
        const auto i = static_cast<std::size_t>(event.sphere);
        const auto& law = std::get<AzadFeatherstoneNormal<>>(scene.simulation.contacts[i].normal);
        EXPECT_EQ(c.phase, Phase::recovering);
        EXPECT_EQ(c.normal_force, 0);
        EXPECT_EQ(c.friction_force.norm(), 0);
        EXPECT_GT(c.depth, 0);
        // (13) is zero where K_n z = -D_n zdot.
        EXPECT_NEAR(law.stiffness * c.depth / (-law.damping * c.depth_rate), 1, 1e-9);
    });
}

TEST(Events, RecoveredIsWhereTheDepthIsZeroAgain) {
    at_every(EventKind::recovered, [](const Scene& scene, const Event& event, const ContactSnapshot& c) {
        EXPECT_NEAR(geometric_depth(scene.simulation, event.state, static_cast<std::size_t>(event.sphere)), 0, 1e-13);
        EXPECT_LT(c.depth_rate, 0);
        EXPECT_EQ(c.phase, Phase::flight);
        EXPECT_EQ(c.normal_force, 0);
        EXPECT_EQ(c.energy.normal_spring, 0);
    });
}

TEST(Events, ComeInOrderOfTime) {
    for (const Scene& scene : scenes()) {
        const auto earlier = [](const Event& a, const Event& b) { return a.time < b.time; };
        EXPECT_TRUE(std::is_sorted(scene.run.events.begin(), scene.run.events.end(), earlier)) << scene.name;
        for (const Event& event : scene.run.events) EXPECT_EQ(event.time, event.state.time) << scene.name;
    }
}

TEST(Events, LeadEachSphereThroughItsPhasesInAnOrderThatExists) {
    for (const Scene& scene : scenes()) {
        SCOPED_TRACE(scene.name);
        std::vector<Phase> phase(scene.simulation.body.spheres.size(), Phase::flight);
        for (const Event& event : scene.run.events) {
            Phase& now = phase[static_cast<std::size_t>(event.sphere)];
            const Phase next = event.state.contacts[static_cast<std::size_t>(event.sphere)].phase;
            SCOPED_TRACE(std::string(name_of(event.kind)) + " at " + std::to_string(event.time));
            switch (event.kind) {
                case EventKind::touchdown:
                    EXPECT_TRUE(now == Phase::flight || now == Phase::recovering);
                    break;
                case EventKind::stick:
                    EXPECT_TRUE(now == Phase::slip || now == Phase::stick);  // stick: at once at touchdown
                    break;
                case EventKind::slip:
                    EXPECT_EQ(now, Phase::stick);
                    break;
                case EventKind::separation:
                    EXPECT_TRUE(now == Phase::stick || now == Phase::slip);
                    break;
                case EventKind::recovered:
                    EXPECT_EQ(now, Phase::recovering);
                    break;
            }
            now = next;
        }
        for (std::size_t i = 0; i < phase.size(); ++i) EXPECT_EQ(scene.run.final.contacts[i].phase, phase[i]);
    }
}

TEST(Events, BelongToTheImpactsThatTheRunLists) {
    for (const Scene& scene : scenes()) {
        SCOPED_TRACE(scene.name);
        EXPECT_LE(scene.run.impacts.size(), test::count(scene.run, EventKind::touchdown));
        std::size_t over = 0;
        for (const Impact& impact : scene.run.impacts) {
            EXPECT_GT(impact.speed_in, 0);
            EXPECT_GT(impact.peak_indentation, 0);
            EXPECT_GT(impact.peak_normal_force, 0);
            if (!impact.recovered) continue;
            ++over;
            ASSERT_TRUE(impact.separation);
            EXPECT_LT(impact.touchdown, *impact.separation);
            EXPECT_LT(*impact.separation, *impact.recovered);
            EXPECT_LE(impact.stick_time, *impact.separation - impact.touchdown);
            EXPECT_GT(*impact.restitution(), 0);
        }
        EXPECT_EQ(over, test::count(scene.run, EventKind::recovered));
    }
}

// A peak that is searched between steps is at least what any sample shows, and no more than a little above the largest
// of many.
TEST(Impacts, PeaksAreThoseOfAFineSampling) {
    Simulation s = paper_ball(0.05, 0.11);
    s.initial.velocity = {0.5, 0.3, 0};
    s.options.sample_period = 1e-7;
    const auto run = footfall::run(s);
    ASSERT_EQ(run.impacts.size(), 1u);
    double force = 0, depth = 0;
    for (const Snapshot& shot : run.samples) {
        force = std::max(force, shot.contacts[0].normal_force);
        depth = std::max(depth, shot.contacts[0].depth);
    }
    EXPECT_NEAR(run.impacts[0].peak_normal_force / force, 1, 1e-7);
    EXPECT_NEAR(run.impacts[0].peak_indentation / depth, 1, 1e-7);
}

TEST(Samples, ComeAtEveryPeriodAndAtTheEnd) {
    Simulation s = paper_ball(0.01, 0.0955);
    s.options.sample_period = 1e-3;
    const auto run = footfall::run(s);
    ASSERT_EQ(run.samples.size(), 97u);  // 0, 1, ... 95 ms, and 95.5 ms
    for (std::size_t i = 0; i < 96; ++i) EXPECT_DOUBLE_EQ(run.samples[i].time, 1e-3 * static_cast<double>(i));
    EXPECT_EQ(run.samples.back().time, 0.0955);
    EXPECT_EQ(run.final.time, 0.0955);
}

TEST(Samples, DoNotChangeTheRun) {
    Simulation s = heel_first(0.3);
    const auto without = footfall::run(s);
    s.options.sample_period = 1e-3;
    const auto with = footfall::run(s);
    EXPECT_EQ(with.final.body.position, without.final.body.position);
    EXPECT_EQ(with.final.body.velocity, without.final.body.velocity);
    EXPECT_EQ(with.events.size(), without.events.size());
    EXPECT_EQ(with.cost.steps, without.cost.steps);
}

}  // namespace
}  // namespace footfall
