// Whole runs under the passive friction law, beside the paper's.
#include <map>

#include <gtest/gtest.h>

#include "footfall/io/scenario.hpp"
#include "footfall/simulate/run.hpp"
#include "simulate/scenes.hpp"

namespace footfall {
namespace {

Simulation shipped(const std::string& name) {
    return load_scenario(FOOTFALL_SOURCE_DIR "/scenarios/" + name + ".toml").simulation;
}

Simulation passive(Simulation s) {
    for (ContactParameters& c : s.contacts) {
        const auto& paper = std::get<AzadFeatherstoneFriction<>>(c.friction);
        c.friction =
            AzadFeatherstonePassiveFriction<>{{paper.stiffness, paper.damping, paper.coefficient, paper.viscous}};
    }
    return s;
}

std::map<EventKind, int> kinds_of(const Run& run) {
    std::map<EventKind, int> kinds;
    for (const Event& e : run.events) ++kinds[e.kind];
    return kinds;
}

/// Whether no contact ever gets anything back from its changing stiffness, but for what the tolerance allows.
void expect_only_taken(const Run& run, double tolerance) {
    const double slack = 10 * tolerance * run.energy_scale;
    for (std::size_t k = 1; k < run.samples.size(); ++k)
        for (std::size_t i = 0; i < run.samples[k].contacts.size(); ++i)
            ASSERT_GE(run.samples[k].contacts[i].energy.stiffness_change,
                      run.samples[k - 1].contacts[i].energy.stiffness_change - slack)
                << "sample " << k << " of sphere " << i;
}

TEST(PassiveRun, OfThePapersRollingSphereTakesWhereThePapersLawMakes) {
    const Simulation s = shipped("rolling-sphere");
    const auto paper = footfall::run(s), passive_run = footfall::run(passive(s));
    EXPECT_NEAR(passive_run.final.ledger.contact.stiffness_change, 0.6044e-3, 0.00005e-3);
    EXPECT_NEAR(passive_run.final.body.position.x(), 0.374533, 0.5e-6);
    EXPECT_NEAR(paper.final.ledger.contact.stiffness_change, -0.6702e-3, 0.00005e-3);
    EXPECT_NEAR(paper.final.body.position.x(), 0.374038, 0.5e-6);
    // It bounces and ends as it did: normal forces do not see the friction, and 5/7 holds for any.
    EXPECT_EQ(kinds_of(passive_run), kinds_of(paper));
    EXPECT_NEAR(passive_run.final.ledger.contact.normal_damper, paper.final.ledger.contact.normal_damper, 1e-12);
    EXPECT_NEAR(passive_run.final.body.velocity.x(), 5.0 / 14.0, 1e-11);
    EXPECT_LE(passive_run.max_residual, 1e-13);
    expect_only_taken(passive_run, s.options.tolerance);
}

// The depth rate of a ball that comes to rest changes its sign without end.
TEST(PassiveRun, ComesToRestWithoutMoreEventsOrMuchMoreWork) {
    for (const char* name : {"resting-ball", "rolling-sphere", "spinning-ball"}) {
        SCOPED_TRACE(name);
        Simulation s = shipped(name);
        s.options.end_time = std::max(s.options.end_time, 2.0);
        s.options.sample_period = 0;
        const auto paper = footfall::run(s), passive_run = footfall::run(passive(s));
        EXPECT_LE(passive_run.events.size(), paper.events.size());
        EXPECT_LT(passive_run.cost.evaluations, 1.5 * static_cast<double>(paper.cost.evaluations));
    }
}

TEST(PassiveRun, OfAFootThatLandsHeelFirstMakesNoEnergy) {
    const Simulation s = shipped("foot-heel-first");
    const auto one = footfall::run(passive(s));
    EXPECT_GT(one.final.ledger.contact.stiffness_change, 0);
    EXPECT_LE(one.max_residual, 30 * s.options.tolerance);
    expect_only_taken(one, s.options.tolerance);
}

}  // namespace
}  // namespace footfall
