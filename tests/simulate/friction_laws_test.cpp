// Every friction law with internal states in whole runs: the ledger closes, and bodies rest, creep, slide and stop as
// mechanics says that they must.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "footfall/law/registry.hpp"
#include "simulate/scenes.hpp"
#include "simulate/tried_laws.hpp"

namespace footfall {
namespace {

using test::finite;

// At the depths of the paper's ball a stiffness of about K_t/(K_n z) over the load.
constexpr double sigma = 1.5e4;

struct Named {
    FrictionLaw law;
    bool passive = true;  // at constant load, for the parameters here
    bool known = true;    // has numbers of its own here, by which it slides at a coefficient of about 0.2
};
std::vector<Named> laws() {
    std::vector<Named> all{{RegularizedCoulombFriction<>{0.2, 1e-3}},
                           {DahlFriction<>{sigma, 0.2}},
                           {LuGreFriction<>{sigma, 5, 0.3, 0.2, 0.01, 0.1}, false},
                           {ElastoPlasticFriction<>{sigma, 5, 0.3, 0.2, 0.01, 0.1, 0.7}, false},
                           {BlimanSorineFriction<>{0.2, 0.3, 5e-5, 0.2}},
                           {SevenParameterFriction<>{sigma, 0.2, 0.1, 0.01, 1e-3, 0.1, 0.1}},
                           {ResetIntegratorFriction<>{sigma, 5, 1.3e-5, 0.3}, false},
                           {HaessigFriedlandFriction<>{sigma, 2e-5}}};
    // Those with a clutch are tried everywhere else.
    const auto is_known = [&](const FrictionLaw& law) {
        return std::visit([]<class Law>(const Law&) { return requires { Law::has_bristle; }; }, law) ||
               std::any_of(all.begin(), all.end(), [&](const Named& n) { return n.law.index() == law.index(); });
    };
    for (const FrictionLaw& law : test::tried_friction_laws())
        if (!is_known(law)) all.push_back({law, clutch_only_takes(law), false});
    return all;
}

void give(Simulation& s, const FrictionLaw& law) {
    for (ContactParameters& c : s.contacts) c.friction = law;
}

class FrictionLaws : public testing::TestWithParam<std::size_t> {
protected:
    Named named() const { return laws()[GetParam()]; }
};
INSTANTIATE_TEST_SUITE_P(Each, FrictionLaws, testing::Range<std::size_t>(0, laws().size()), [](const auto& each) {
    std::string name(name_of(laws()[each.param].law));
    for (char& c : name)
        if (c == '-') c = '_';
    return name;
});

template <class... Laws>
constexpr std::size_t clutched(const std::variant<Laws...>*) {
    return (std::size_t{ClutchFriction<Laws>} + ...);
}

TEST(FrictionLawsTested, AreAllButThoseWithAClutch) {
    constexpr std::size_t clutched_or_none = clutched(static_cast<const FrictionLaw*>(nullptr)) + 1;
    std::set<std::size_t> tried;
    for (const Named& named : laws()) tried.insert(named.law.index());
    EXPECT_EQ(tried.size(), std::variant_size_v<FrictionLaw> - clutched_or_none);
}

void expect_sound(const Run& run, double residual, bool passive) {
    EXPECT_LE(run.max_residual, residual);
    EXPECT_TRUE(finite(run.final));
    ContactEnergy before;
    for (const Snapshot& shot : run.samples) {
        const double slack = 1e-12 * run.energy_scale;
        const ContactEnergy& e = shot.ledger.contact;
        EXPECT_GE(e.tangential_damper, before.tangential_damper - slack) << shot.time;
        if (passive) {
            EXPECT_GE(e.clutch, before.clutch - slack) << shot.time;
        }
        before = e;
        for (const ContactSnapshot& c : shot.contacts) {
            EXPECT_GE(c.energy.tangential_spring, 0) << shot.time;
            if (c.normal_force > 0) continue;
            EXPECT_EQ(c.bristle.norm(), 0) << shot.time;  // the states are those of a new contact
            EXPECT_EQ(c.friction_force.norm(), 0) << shot.time;
        }
    }
    EXPECT_GT(run.final.ledger.contact.clutch, 0);
}

TEST_P(FrictionLaws, CloseTheLedgerOfABouncingSpinningBall) {
    Simulation s = test::paper_ball(0.03, 0.25, 1e-11);
    s.initial.velocity = {0.5, -0.2, 0};
    s.initial.angular_velocity = {3, 10, 2};
    s.options.sample_period = 1e-4;
    give(s, named().law);
    const auto run = footfall::run(s);
    expect_sound(run, 3e-10, named().passive);
    EXPECT_GE(run.impacts.size(), 2u);
}

TEST_P(FrictionLaws, CloseTheLedgerOfAFootThatLandsOnItsHeel) {
    Simulation s = test::heel_first(0.06, 1e-10);
    s.options.sample_period = 1e-4;
    give(s, named().law);
    expect_sound(footfall::run(s), 3e-9, named().passive);
}

/// The foot that stands on the ground, with its springs loaded.
Simulation standing_foot(double end_time, double tolerance) {
    Simulation s = test::foot(0, end_time, tolerance);
    const double load = s.body.mass * test::gravity / 4, K_n = 2e6;
    s.initial.position.z() -= std::pow(load / K_n, 2.0 / 3);
    s.options.allow_initial_penetration = true;
    return s;
}

void tilt(Simulation& s, double angle) {
    s.gravity = test::gravity * Eigen::Vector3d(std::sin(angle), 0, -std::cos(angle));
}

/// The same laws with a kinetic coefficient of 0.2 at all speeds above the lowest; of bonds few, so that few snap.
FrictionLaw sliding_at_a_fifth(const FrictionLaw& law) {
    if (std::holds_alternative<LuGreFriction<>>(law)) return LuGreFriction<>{sigma, 5, 0.3, 0.2, 0.01, 0};
    if (std::holds_alternative<ElastoPlasticFriction<>>(law))
        return ElastoPlasticFriction<>{sigma, 5, 0.3, 0.2, 0.01, 0, 0.7};
    if (std::holds_alternative<SevenParameterFriction<>>(law))
        return SevenParameterFriction<>{sigma, 0.2, 0.1, 0.01, 1e-3, 0.1, 0};
    if (std::holds_alternative<ResetIntegratorFriction<>>(law))
        return ResetIntegratorFriction<>{sigma, 5, 0.2 / sigma, 0.3};
    if (std::holds_alternative<HaessigFriedlandFriction<>>(law))
        return HaessigFriedlandFriction<>{1.5 * 0.2 / 1e-2, 1e-2};
    return law;
}

// A foot that slides steadily loses mu g in speed every second.
TEST_P(FrictionLaws, BrakeASlidingFootAsTheKineticCoefficientSays) {
    if (!named().known) GTEST_SKIP() << "its kinetic coefficient is not known here";
    const FrictionLaw law = sliding_at_a_fifth(named().law);
    const bool rough = std::holds_alternative<HaessigFriedlandFriction<>>(law);
    Simulation s = standing_foot(0.15, rough ? 1e-6 : 1e-8);
    give(s, law);
    s.initial.velocity = {1, 0, 0};
    s.options.sample_period = 0.05;
    const auto run = footfall::run(s);
    const double lost = run.samples[1].body.velocity.x() - run.final.body.velocity.x();
    EXPECT_NEAR(lost / (0.2 * test::gravity * 0.1), 1, rough ? 0.15 : 0.01) << lost;
    EXPECT_LE(run.max_residual, 30 * s.options.tolerance);
}

// Where mu V/sqrt(V^2 + v_eps^2) = tan(slope) it goes on at V = v_eps tan/sqrt(mu^2 - tan^2).
TEST(RegularizedCoulombFriction, CreepsDownASlopeAtTheSpeedThatBalancesIt) {
    const double mu = 0.4, v_eps = 0.01, slope = std::atan(0.2);
    Simulation s = standing_foot(0.6, 1e-9);
    give(s, RegularizedCoulombFriction<>{mu, v_eps});
    tilt(s, slope);
    const auto run = footfall::run(s);
    EXPECT_NEAR(run.final.body.velocity.x(), v_eps * 0.2 / std::sqrt(mu * mu - 0.04), 1e-4 * v_eps);
}

/// How far the foot still moves along a slope of 0.2, well below every coefficient, in the second half of a second.
double crept(const FrictionLaw& law) {
    Simulation s = standing_foot(1, 1e-9);
    give(s, law);
    tilt(s, std::atan(0.2));
    s.options.sample_period = 0.5;
    const auto run = footfall::run(s);
    EXPECT_LE(run.max_residual, 1e-7);
    return run.final.body.position.x() - run.samples[1].body.position.x();
}

TEST(ResetIntegratorFriction, HoldsAFootOnASlope) {
    EXPECT_NEAR(crept(ResetIntegratorFriction<>{sigma, 5, 0.4 / sigma, 0.3}), 0, 1e-9);
}

TEST(ElastoPlasticFriction, HoldsAFootOnASlope) {
    EXPECT_NEAR(crept(ElastoPlasticFriction<>{sigma, 5, 0.5, 0.4, 0.01, 0, 0.7}), 0, 1e-9);
}

/// The shortest time from a stick to the slip that ends it, of any sphere [s].
double shortest_stick(const Run& run) {
    double shortest = std::numeric_limits<double>::infinity();
    std::vector<double> since(run.final.contacts.size(), -1);
    for (const Event& event : run.events) {
        double& held = since[static_cast<std::size_t>(event.sphere)];
        if (event.kind == EventKind::slip && held >= 0) shortest = std::min(shortest, event.time - held);
        held = event.kind == EventKind::stick ? event.time : -1;
    }
    return shortest;
}

TEST(SevenParameterFriction, SticksForSomeTimeWheneverItSticks) {
    constexpr double some_time = 1e-7;
    for (const double stribeck_velocity : {1e-3, 0.01}) {
        const FrictionLaw law = SevenParameterFriction<>{sigma, 0.2, 0.1, stribeck_velocity, 1e-3, 0.1, 0};
        Simulation ball = test::paper_ball(0.03, 0.25, 1e-11), braking = standing_foot(0.3, 1e-10),
                   stepping = test::heel_first(0.1, 1e-10);
        ball.initial.velocity = {0.5, -0.2, 0};
        ball.initial.angular_velocity = {3, 10, 2};
        braking.initial.velocity = {0.1, 0.03, 0};
        tilt(braking, std::atan(0.15));
        for (Simulation* s : {&ball, &braking, &stepping}) {
            give(*s, law);
            const auto run = footfall::run(*s);
            EXPECT_GT(test::count(run, EventKind::stick), 1u);
            EXPECT_GT(shortest_stick(run), some_time);
            EXPECT_LE(run.max_residual, 3e-9);
        }
    }
}

// The border where the bristle gives way is an event, so it costs no accuracy and no steps where it is sharp.
TEST(ElastoPlasticFriction, IsAsRightWhereItsBorderIsSharp) {
    const auto bounced = [](double elastic_share, double static_coefficient, double tolerance) {
        Simulation s = test::paper_ball(0.03, 0.25, tolerance);
        s.initial.velocity = {0.5, -0.2, 0};
        s.initial.angular_velocity = {3, 10, 2};
        s.options.sample_period = 1e-4;
        give(s, ElastoPlasticFriction<>{sigma, 5, static_coefficient, 0.2, 0.01, 0.1, elastic_share});
        return footfall::run(s);
    };
    for (const double static_coefficient : {0.2, 0.3}) {
        const auto usual = bounced(0.7, static_coefficient, 1e-9);
        for (const double elastic_share : {0.7, 0.99, 1.0}) {
            const auto run = bounced(elastic_share, static_coefficient, 1e-9),
                       exact = bounced(elastic_share, static_coefficient, 1e-13);
            EXPECT_LE(run.cost.steps, 2 * usual.cost.steps) << elastic_share;
            EXPECT_EQ(run.events.size(), exact.events.size());
            double largest = 0;
            for (const Snapshot& shot : exact.samples)
                largest = std::max(largest, shot.contacts[0].friction_force.norm());
            ASSERT_EQ(run.samples.size(), exact.samples.size());
            for (std::size_t k = 0; k < run.samples.size(); ++k) {
                const Snapshot &a = run.samples[k], &b = exact.samples[k];
                EXPECT_LE((a.contacts[0].friction_force - b.contacts[0].friction_force).norm(), 1e-6 * largest)
                    << a.time;
                EXPECT_LE((a.body.velocity - b.body.velocity).norm(), 1e-8) << a.time;
            }
        }
    }
}

// A load that comes and goes lets nothing be stored unseen: P is what the changing load has done to the spring.
TEST_P(FrictionLaws, BookWhatTheChangingLoadDoesToWhatIsStored) {
    Simulation s = test::paper_ball(0.03, 0.1, 1e-11);
    s.initial.velocity = {0.3, 0, 0};
    give(s, named().law);
    const auto run = footfall::run(s);
    const bool stores = std::visit(
        []<class Law>(const Law&) {
            if constexpr (requires { Law::states; }) return Law::states > 0;
            return false;
        },
        named().law);
    if (stores) {
        EXPECT_GT(std::abs(run.final.ledger.contact.stiffness_change), 1e-9 * run.energy_scale);
    } else {
        EXPECT_EQ(run.final.ledger.contact.stiffness_change, 0);
    }
    EXPECT_LE(run.max_residual, 3e-10);
}

}  // namespace
}  // namespace footfall
