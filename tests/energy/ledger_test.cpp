// The account of a run, read from its samples: every channel against the power that its law says it takes.
#include "footfall/energy/ledger.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

#include <gtest/gtest.h>

#include "simulate/scenes.hpp"

namespace footfall {
namespace {

/// The ledger's entries as plain sums, by hand.
TEST(Ledger, TotalIsWhatIsHeldAndWhatIsTaken) {
    Ledger ledger;
    ledger.kinetic = 1;
    ledger.potential = -2;
    ledger.contact = {.normal_spring = 4,
                      .tangential_spring = 8,
                      .normal_damper = 16,
                      .tangential_damper = 32,
                      .clutch = 64,
                      .stiffness_change = -128};
    EXPECT_EQ(ledger.total(), 1 - 2 + 4 + 8 + 16 + 32 + 64 - 128);
    EXPECT_EQ(ledger.magnitude(), 1 + 2 + 4 + 8 + 16 + 32 + 64 + 128);
    EXPECT_EQ(ledger.contact.stored(), 4 + 8);
    EXPECT_EQ(ledger.contact.dissipated(), 16 + 32 + 64);
    EXPECT_EQ(ledger.contact.tangential_spring_paper(), 8 - 128);
}

TEST(Ledger, ContactEnergiesAddEntryByEntry) {
    ContactEnergy a{1, 2, 3, 4, 5, 6};
    a += {10, 20, 30, 40, 50, 60};
    EXPECT_EQ(a.normal_spring, 11);
    EXPECT_EQ(a.tangential_spring, 22);
    EXPECT_EQ(a.normal_damper, 33);
    EXPECT_EQ(a.tangential_damper, 44);
    EXPECT_EQ(a.clutch, 55);
    EXPECT_EQ(a.stiffness_change, 66);
}

constexpr double period = 1e-6;

struct Recorded {
    Simulation simulation;
    Run run;
};

/// Both contact phases, lift-off and landings of four spheres.
const Recorded& foot() {
    static const Recorded r = [] {
        Simulation s = test::heel_first(0.12);
        s.options.sample_period = period;
        return Recorded{s, footfall::run(s)};
    }();
    return r;
}

const Recorded& ball() {
    static const Recorded r = [] {
        Simulation s = test::paper_ball(0.02, 0.07);
        s.initial.velocity = {0.5, 0.3, 0};
        s.options.sample_period = period;
        return Recorded{s, footfall::run(s)};
    }();
    return r;
}

/// Calls visit(sample, contact) at many samples away from events, for contacts in the ground.
template <class Visit>
std::size_t at_many(const Recorded& r, Visit&& visit) {
    std::size_t seen = 0;
    for (std::size_t i = 2; i + 2 < r.run.samples.size(); i += 53) {
        if (!test::smooth_around(r.run, i, period)) continue;
        for (std::size_t k = 0; k < r.simulation.contacts.size(); ++k) {
            if (r.run.samples[i].contacts[k].phase == Phase::flight) continue;
            visit(i, k);
            ++seen;
        }
    }
    return seen;
}

/// How a quantity of contact k changes at sample i.
template <class Get>
auto rate(const Recorded& r, std::size_t i, std::size_t k, Get&& get) {
    return test::rate_at([&](std::size_t j) { return get(r.run.samples[j].contacts[k]); }, i, period);
}

TEST(LedgerOfARun, TotalIsConstantAtEverySample) {
    for (const Recorded* r : {&foot(), &ball()})
        for (const Snapshot& shot : r->run.samples)
            ASSERT_NEAR((shot.ledger.total() - r->run.initial.ledger.total()) / r->run.energy_scale, 0, 2e-12)
                << shot.time;
}

TEST(LedgerOfARun, IsTheSumOverItsContacts) {
    for (const Snapshot& shot : foot().run.samples) {
        ContactEnergy sum;
        for (const ContactSnapshot& c : shot.contacts) sum += c.energy;
        const ContactEnergy& whole = shot.ledger.contact;
        ASSERT_NEAR(sum.normal_spring, whole.normal_spring, 1e-16);
        ASSERT_NEAR(sum.tangential_spring, whole.tangential_spring, 1e-16);
        ASSERT_NEAR(sum.normal_damper, whole.normal_damper, 1e-16);
        ASSERT_NEAR(sum.tangential_damper, whole.tangential_damper, 1e-16);
        ASSERT_NEAR(sum.clutch, whole.clutch, 1e-16);
        ASSERT_NEAR(sum.stiffness_change, whole.stiffness_change, 1e-16);
    }
}

TEST(LedgerOfARun, HasTheBodysOwnEnergies) {
    const Recorded& r = foot();
    for (std::size_t i = 0; i < r.run.samples.size(); i += 1001) {
        const Snapshot& shot = r.run.samples[i];
        const Eigen::Vector3d& w = shot.body.angular_velocity;
        const Eigen::Vector3d in_body = shot.body.orientation.conjugate() * w;
        const double kinetic = 0.6 * shot.body.velocity.squaredNorm() +
                               0.5 * (1.6e-3 * in_body.x() * in_body.x() + 5.6e-3 * in_body.y() * in_body.y() +
                                      6.5e-3 * in_body.z() * in_body.z());
        EXPECT_NEAR(shot.ledger.kinetic, kinetic, 1e-13);
        EXPECT_NEAR(shot.ledger.potential, 1.2 * 9.81 * shot.body.position.z(), 1e-14);
    }
}

// What a contact has taken from the body, by force times velocity, is what its entries say.
TEST(LedgerOfARun, EachContactsEntriesChangeWithThePowerOfItsForces) {
    for (const Recorded* r : {&foot(), &ball()}) {
        const std::size_t seen = at_many(*r, [&](std::size_t i, std::size_t k) {
            const ContactSnapshot& c = r->run.samples[i].contacts[k];
            const double taken = c.normal_force * c.depth_rate - c.friction_force.dot(c.slip_velocity);
            const double booked = rate(*r, i, k, [](const ContactSnapshot& x) {
                return x.energy.stored() + x.energy.dissipated() + x.energy.stiffness_change;
            });
            EXPECT_NEAR(booked, taken, 1e-6 * (1 + std::abs(taken))) << r->run.samples[i].time;
        });
        EXPECT_GT(seen, 20u);
    }
}

TEST(LedgerOfARun, EachChannelTakesWhatItsLawSays) {
    for (const Recorded* r : {&foot(), &ball()}) {
        double most_clutch = 0, most_damper = 0, most_change = 0;
        at_many(*r, [&](std::size_t i, std::size_t k) {
            const auto& normal = std::get<AzadFeatherstoneNormal<>>(r->simulation.contacts[k].normal);
            const auto& friction = std::get<AzadFeatherstoneFriction<>>(r->simulation.contacts[k].friction);
            const ContactSnapshot& c = r->run.samples[i].contacts[k];
            SCOPED_TRACE(r->run.samples[i].time);
            const double root = std::sqrt(c.depth);
            const Eigen::Vector3d u_rate = rate(*r, i, k, [](const ContactSnapshot& x) { return x.bristle; });
            const auto expect = [](double booked, double power) {
                EXPECT_NEAR(booked, power, 1e-5 * (1 + std::abs(power)));
            };

            EXPECT_NEAR(c.energy.normal_spring, 0.4 * normal.stiffness * std::pow(c.depth, 2.5), 1e-14);  // (17)
            EXPECT_NEAR(c.energy.tangential_spring, 0.5 * friction.stiffness * root * c.bristle.squaredNorm(), 1e-14);
            const double damper = rate(*r, i, k, [](const ContactSnapshot& x) { return x.energy.normal_damper; });
            if (c.phase == Phase::recovering) {
                expect(damper, -normal.stiffness * c.depth * root * c.depth_rate);  // what the spring gives
            } else {
                expect(damper, normal.damping * root * c.depth_rate * c.depth_rate);  // (16)
            }
            const double tangential =
                rate(*r, i, k, [](const ContactSnapshot& x) { return x.energy.tangential_damper; });
            expect(tangential, friction.damping * root * u_rate.squaredNorm());  // (28)
            const double clutch = rate(*r, i, k, [](const ContactSnapshot& x) { return x.energy.clutch; });
            expect(clutch, -c.friction_force.dot(c.slip_velocity - u_rate));  // (29), (30)
            const double change = rate(*r, i, k, [](const ContactSnapshot& x) { return x.energy.stiffness_change; });
            expect(change, -0.25 * friction.stiffness * c.depth_rate * c.bristle.squaredNorm() / root);
            const double paper =
                rate(*r, i, k, [](const ContactSnapshot& x) { return x.energy.tangential_spring_paper(); });
            expect(paper, friction.stiffness * root * c.bristle.dot(u_rate));  // (33)
            most_clutch = std::max(most_clutch, clutch);
            most_damper = std::max(most_damper, tangential);
            most_change = std::max(most_change, std::abs(change));
        });
        EXPECT_GT(most_clutch, 0.1);
        EXPECT_GT(most_damper, 1e-3);
        EXPECT_GT(most_change, 1e-2);
    }
}

TEST(LedgerOfARun, StartsWithTheSpringOfAnInitialPenetration) {
    Simulation s = test::paper_ball(-2e-4, 0.1);
    s.options.allow_initial_penetration = true;
    const auto run = footfall::run(s);
    const double spring = 0.4 * 8.5e6 * std::pow(2e-4, 2.5);
    EXPECT_NEAR(run.initial.ledger.contact.normal_spring / spring, 1, 1e-10);
    EXPECT_NEAR(run.initial.ledger.total(), spring + 0.154 * 9.81 * (0.0165 - 2e-4), 1e-14);
    EXPECT_EQ(run.initial.ledger.contact.dissipated(), 0);
    EXPECT_LE(run.max_residual, 1e-11);
    EXPECT_GT(run.final.body.velocity.z(), 0) << "the spring has thrown the ball up";
}

// A linear bristle still holds energy when its sphere leaves; in flight its own damper takes it.
TEST(LedgerOfARun, GivesTheEnergyOfALinearBristleToItsDamperInFlight) {
    Simulation s = test::paper_ball(0.02, 0.09);
    s.initial.velocity = {0.5, 0.3, 0};
    s.contacts[0].friction = LinearFriction<>{{3e5, 3e3, 0.2, 0.1}};  // recovers at 100 /s
    s.options.sample_period = 1e-4;
    const auto run = footfall::run(s);
    const Event* up = test::first(run, EventKind::recovered);
    ASSERT_NE(up, nullptr);
    const ContactEnergy& at_lift_off = up->state.contacts[0].energy;
    EXPECT_GT(at_lift_off.tangential_spring, 1e-9);
    std::size_t seen = 0;
    for (const Snapshot& shot : run.samples) {
        if (shot.time <= up->time || shot.contacts[0].phase != Phase::flight) continue;
        ++seen;
        const ContactEnergy& e = shot.contacts[0].energy;
        const double left = std::exp(-2 * 100 * (shot.time - up->time));
        EXPECT_NEAR(e.tangential_spring, at_lift_off.tangential_spring * left, 1e-15) << shot.time;
        EXPECT_NEAR(e.tangential_spring + e.tangential_damper,
                    at_lift_off.tangential_spring + at_lift_off.tangential_damper, 1e-15)
            << shot.time;
    }
    EXPECT_GT(seen, 20u);
}

// With D_t = 0 nothing holds it back: it is gone at separation.
TEST(LedgerOfARun, GivesTheEnergyOfAnUndampedBristleAwayAtSeparation) {
    Simulation s = test::paper_ball(0.02, 0.09);
    s.initial.velocity = {0.5, 0.3, 0};
    s.contacts[0].friction = LinearFriction<>{{3e5, 0, 0.2, 0.1}};
    const auto run = footfall::run(s);
    const Event* separation = test::first(run, EventKind::separation);
    ASSERT_NE(separation, nullptr);
    EXPECT_EQ(separation->state.contacts[0].bristle.norm(), 0);
    EXPECT_EQ(separation->state.contacts[0].energy.tangential_spring, 0);
    EXPECT_LE(run.max_residual, 1e-11);
}

}  // namespace
}  // namespace footfall
