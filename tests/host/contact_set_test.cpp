// A contact set in the loop of a host: against the library's own runs, and by what must hold for any step.
#include "footfall/host/contact_set.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "footfall/io/scenario.hpp"
#include "footfall/math/error.hpp"
#include "footfall/simulate/run.hpp"
#include "host/random_host.hpp"

namespace footfall::test {
namespace {

constexpr double gravity = 9.81, mass = 0.154, radius = 0.0165, inertia = 0.4 * mass * radius * radius;

ContactParameters paper() {
    return {AzadFeatherstoneNormal<>{8.5e6, 3.1e3}, AzadFeatherstoneFriction<>{12.75e6, 3.1e3, 0.2, 0.1}};
}

/// The paper's ball: x, y, z, and the angular velocities about x and y. What its contact point does is linear in them.
LinearHost paper_ball() {
    const double w = 1 / mass, turn = 1 / inertia;
    return {{w, w, w, turn, turn},
            {1, 0, 0, 0, -radius,  // V_x = v_x - r omega_y
             0, 1, 0, radius, 0,   // V_y = v_y + r omega_x
             0, 0, 1, 0, 0},
            {0, 0, 0.1 - radius},
            {0.5, 0.5, 0, 0, 0},
            {0, 0, -mass * gravity, 0, 0}};
}

struct HostRun {
    ContactEnergy energy;
    double apex = 0;  // of the first bounce, of the lowest point [m]
    std::vector<HostEvent> events;
    double largest_residual = 0;
};
HostRun run_host(LinearHost host, ContactSet set, double dt, double end) {
    HostRun run;
    bool bounced = false, over = false;
    const int steps = static_cast<int>(std::lround(end / dt));
    for (int k = 0; k < steps; ++k) {
        const ContactSetStep& step = set.step(host.given(dt));
        for (const HostEvent& e : step.events) run.events.push_back({k * dt + e.time, e.contact, e.kind});
        ContactEnergy now = step.energy[0];
        now.normal_damper += run.energy.normal_damper;
        now.tangential_damper += run.energy.tangential_damper;
        now.clutch += run.energy.clutch;
        now.stiffness_change += run.energy.stiffness_change;
        run.energy = now;
        run.largest_residual = std::max(run.largest_residual, std::abs(step.residual));
        host.move(dt, step.impulse, step.double_impulse);
        bounced = bounced || host.coordinate_velocity(2) > 0;
        // From where it flies up the apex is known to any digits.
        const double v = host.coordinate_velocity(2);
        if (bounced && !over && host.position(2) > 1e-3 && v > 0)
            run.apex = host.position(2) + 0.5 * v * v / gravity, over = true;
    }
    return run;
}

class PaperBall : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(HostSteps, PaperBall, ::testing::Values(1e-4, 5e-4, 1e-3, 2e-3, 5e-3));

TEST_P(PaperBall, HasTheEnergiesTheEventsAndTheRestitutionOfTheLibrarysOwnRun) {
    Simulation simulation =
        load_scenario(std::string(FOOTFALL_SOURCE_DIR) + "/scenarios/rolling-sphere.toml").simulation;
    const footfall::Run exact = footfall::run(simulation);
    const HostRun host = run_host(paper_ball(), ContactSet({paper()}), GetParam(), 1.0);

    const double restitution = std::sqrt(host.apex / (0.1 - radius));
    EXPECT_NEAR(restitution, exact.impacts[0].restitution().value(), 1e-5);
    const ContactEnergy& theirs = exact.final.ledger.contact;
    for (const auto& channel : contact_channels) {
        if (channel.kind == ChannelKind::held) continue;
        EXPECT_NEAR(host.energy.*channel.member, theirs.*channel.member, 1e-5 * std::abs(theirs.*channel.member))
            << channel.name;
    }
    EXPECT_LT(host.largest_residual, 1e-6 * 0.19);
    // Stick and slip may be told twice where a step ends inside an impact; touchdowns may not.
    std::vector<double> host_touchdowns, touchdowns;
    for (const HostEvent& e : host.events)
        if (e.kind == EventKind::touchdown) host_touchdowns.push_back(e.time);
    for (const Event& e : exact.events)
        if (e.kind == EventKind::touchdown) touchdowns.push_back(e.time);
    ASSERT_EQ(host_touchdowns.size(), touchdowns.size());
    for (std::size_t k = 0; k < touchdowns.size(); ++k) EXPECT_NEAR(host_touchdowns[k], touchdowns[k], 1e-6);
}

TEST(ContactSet, GivesBackTheSameBitsFromRestoredStates) {
    Draw draw(7);
    const std::size_t contacts = 4;
    std::vector<ContactParameters> laws;
    for (std::size_t i = 0; i < contacts; ++i) laws.push_back(random_contact(draw));
    LinearHost host(draw, contacts, 6);
    ContactSet set(laws), other(laws);
    for (int k = 0; k < 40; ++k) {
        other.restore(set.states(), set.phases());
        ContactSet copy = set;
        const ContactSetStep a = set.step(host.given(1e-3));
        const ContactSetStep b = other.step(host.given(1e-3)), c = copy.step(host.given(1e-3));
        EXPECT_EQ(a.impulse, b.impulse) << k;
        EXPECT_EQ(a.impulse, c.impulse) << k;
        EXPECT_EQ(a.double_impulse, b.double_impulse) << k;
        EXPECT_TRUE(std::equal(set.states().begin(), set.states().end(), other.states().begin())) << k;
        EXPECT_EQ(a.events.size(), b.events.size());
        host.move(1e-3, a.impulse, a.double_impulse);
    }
}

/// A slab on four feet: D, 12 x 12, has rank six.
LinearHost table(double height, double speed) {
    const double m = 4, half = 0.2, I = 0.05;
    std::vector<double> J;
    for (const double x : {-half, half})
        for (const double y : {-half, half}) {
            const double z = -0.1;  // of the feet against the centre; velocity = v + omega x r
            J.insert(J.end(), {1, 0, 0, 0, z, -y});
            J.insert(J.end(), {0, 1, 0, -z, 0, x});
            J.insert(J.end(), {0, 0, 1, y, -x, 0});
        }
    std::vector<double> position;
    for (int i = 0; i < 4; ++i) position.insert(position.end(), {0, 0, height});
    return {
        {1 / m, 1 / m, 1 / m, 1 / I, 1 / I, 1 / I}, J, position, {speed, 0, 0, 0, 0, 0}, {0, 0, -m * gravity, 0, 0, 0}};
}

TEST(ContactSet, CarriesATableOnFourFeet) {
    LinearHost host = table(0.01, 0.3);
    ContactSet set(std::vector<ContactParameters>(
        4, {AzadFeatherstoneNormal<>{1e6, 4e3}, AzadFeatherstoneFriction<>{1.5e6, 4e3, 0.6, 0.1}}));
    const double energy = host.energy(), dt = 1e-3;
    double taken = 0, held = 0;
    std::vector<double> impulse;
    for (int k = 0; k < 1500; ++k) {
        const ContactSetStep& step = set.step(host.given(dt));
        EXPECT_EQ(step.unresolved_time, 0);
        held = 0;
        for (const ContactEnergy& e : step.energy) taken += e.dissipated() + e.unpaid(), held += e.stored();
        impulse = step.impulse;
        host.move(dt, step.impulse, step.double_impulse);
    }
    double carried = 0;
    for (std::size_t i = 0; i < 4; ++i) carried += impulse[3 * i + 2] / dt;
    EXPECT_NEAR(carried, 4 * gravity, 1e-4);
    for (const Phase phase : set.phases()) EXPECT_EQ(phase, Phase::stick);
    // The host is linear, so that nothing is lost between the steps either.
    EXPECT_NEAR(host.energy() + taken + held, energy, 1e-5 * energy);
}

TEST(ContactSet, TurnsTheBristleAgainstAFrameThatTurns) {
    // One contact that slides along the world's x, seen from a frame that turns.
    const double spin = 3, dt = 1e-3, speed = 0.2;
    ContactSet still({paper()}), turning({paper()});
    const std::vector<double> depth{1e-4}, D{0, 0, 0, 0, 0, 0, 0, 0, 0};  // held by a mass without end
    std::vector<double> none{0, 0, 0}, spins{spin};
    double angle = 0, taken_still = 0, taken_turning = 0;
    Vector2<double> impulse_still(0, 0), impulse_turning(0, 0);
    for (int k = 0; k < 200; ++k) {
        std::vector<double> v{speed, 0, 0};
        HostStep a{dt, depth, v, none, D};
        const ContactSetStep& s = still.step(a);
        taken_still += s.energy[0].dissipated();
        impulse_still = {s.impulse[0], s.impulse[1]};
        const double c = std::cos(angle), n = std::sin(angle), c1 = std::cos(angle + spin * dt),
                     n1 = std::sin(angle + spin * dt);
        // The components of the velocity change as the frame turns: that is in the free acceleration.
        std::vector<double> seen{speed * c, -speed * n, 0}, change{speed * (c1 - c) / dt, -speed * (n1 - n) / dt, 0};
        HostStep b{dt, depth, seen, change, D};
        b.frame_spin = spins;
        const ContactSetStep& t = turning.step(b);
        EXPECT_LT(std::abs(t.residual), 1e-6 * t.energy_scale);
        taken_turning += t.energy[0].dissipated();
        const double mc = std::cos(angle + 0.5 * spin * dt), mn = std::sin(angle + 0.5 * spin * dt);
        impulse_turning = {t.impulse[0] * mc - t.impulse[1] * mn, t.impulse[0] * mn + t.impulse[1] * mc};
        angle += spin * dt;
    }
    EXPECT_NEAR(taken_turning, taken_still, 1e-5 * taken_still);
    EXPECT_NEAR((impulse_turning - impulse_still).norm(), 0, 1e-5 * impulse_still.norm());
    EXPECT_NEAR(turning.bristle(0).norm(), still.bristle(0).norm(), 1e-5 * still.bristle(0).norm());
    const double seen = std::atan2(still.bristle(0).y(), still.bristle(0).x()) - angle;
    const double apart = std::atan2(turning.bristle(0).y(), turning.bristle(0).x()) - seen;
    constexpr double pi = 3.141592653589793;
    EXPECT_NEAR(std::remainder(apart, 2 * pi), 0, 0.5 * spin * dt);  // half of what the frame turns by in a step
}

TEST(ContactSet, BooksTheWorkOfAGroundThatMoves) {
    ContactSet set({paper()});
    const std::vector<double> depth{1e-4}, v{0.2, 0, 0}, a{0, 0, 0}, D{0, 0, 0, 0, 0, 0, 0, 0, 0}, ground{0.1, 0, 0.5};
    HostStep host{1e-3, depth, v, a, D};
    host.ground_velocity = ground;
    const ContactSetStep& step = set.step(host);
    EXPECT_DOUBLE_EQ(step.ground_work, 0.1 * step.impulse[0] + 0.5 * step.impulse[2]);
    EXPECT_LT(step.impulse[0], 0);
}

TEST(ContactSet, SaysWhatItCouldNotResolveAndEndsAllTheSame) {
    ContactSetOptions few;
    few.max_evaluations = 30;
    LinearHost host = table(1e-5, 0.3);
    ContactSet set(std::vector<ContactParameters>(
                       4, {AzadFeatherstoneNormal<>{1e11, 4e3}, AzadFeatherstoneFriction<>{1.5e11, 4e3, 0.6, 0.1}}),
                   few);
    const double energy = host.energy() + 4 * gravity * 1e-5 + 1;
    int unresolved = 0;
    for (int k = 0; k < 200; ++k) {
        const ContactSetStep& step = set.step(host.given(5e-3));
        if (step.unresolved_time > 0) ++unresolved;
        host.move(5e-3, step.impulse, step.double_impulse);
        for (const double v : host.velocity) ASSERT_LT(std::abs(v), 1.0) << k;
    }
    EXPECT_GT(unresolved, 0);
    EXPECT_LT(host.energy(), energy);
}

TEST(ContactSet, EvaluatesNothingInFlight) {
    LinearHost host = paper_ball();
    ContactSet set({paper()});
    const ContactSetStep& step = set.step(host.given(1e-3));
    EXPECT_EQ(step.evaluations, 0);
    EXPECT_EQ(step.impulse, std::vector<double>(3, 0.0));
    const double far = -std::numeric_limits<double>::infinity();
    std::vector<double> depth{far}, v{0, 0, -1}, a{0, 0, 0}, D{1, 0, 0, 0, 1, 0, 0, 0, 1};
    EXPECT_EQ(set.step({1e-3, depth, v, a, D}).evaluations, 0);
}

TEST(ContactSet, SaysWhatItCannotUse) {
    const auto message = [](const std::function<void(HostStep&, std::vector<std::vector<double>>&)>& spoil) {
        ContactSet set({paper(), paper()});
        std::vector<std::vector<double>> given{std::vector<double>(2, 1e-4), std::vector<double>(6, 0.1),
                                               std::vector<double>(6, 0.0), std::vector<double>(36, 0.0),
                                               std::vector<double>(6, 0.0)};
        for (std::size_t k = 0; k < 6; ++k) given[3][7 * k] = 1;
        HostStep step;
        step.dt = 1e-3;
        spoil(step, given);
        step.depth = given[0];
        step.velocity = given[1];
        step.free_acceleration = given[2];
        step.delassus = given[3];
        step.ground_velocity = given[4];
        const std::vector<double> before(set.states().begin(), set.states().end());
        try {
            set.step(step);
        } catch (const InvalidInput& error) {
            EXPECT_TRUE(std::equal(before.begin(), before.end(), set.states().begin()));
            return std::string(error.what());
        }
        return std::string("nothing");
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    using Given = std::vector<std::vector<double>>;
    EXPECT_EQ(message([](HostStep& s, Given&) { s.dt = -1; }), "dt is -1 s; must be >= 0 and finite");
    EXPECT_EQ(message([](HostStep&, Given& g) { g[0].pop_back(); }),
              "depth: has 1 numbers; must have 2, 1 for each contact");
    EXPECT_EQ(message([](HostStep&, Given& g) { g[0][1] = nan; }),
              "depth[1] is nan m; must be finite, or minus infinity far above the ground");
    EXPECT_EQ(message([](HostStep&, Given& g) { g[1][4] = nan; }), "velocity[1][1] is nan m/s; must be finite");
    EXPECT_EQ(message([](HostStep&, Given& g) { g[2].clear(); }),
              "free_acceleration: has 0 numbers; must have 6, 3 for each of 2 contacts");
    EXPECT_EQ(message([](HostStep&, Given& g) { g[3][1] = 0.1; }),
              "delassus[1][0] is 0 and [0][1] is 0.1 1/kg; J M^-1 J^T is symmetric");
    EXPECT_EQ(message([](HostStep&, Given& g) { g[3][7] = -1; }),
              "delassus[1][1] is -1 1/kg; the diagonal of J M^-1 J^T is >= 0");
    EXPECT_EQ(message([](HostStep&, Given& g) { g[3][1] = g[3][6] = 2; }),
              "delassus[1][0] is 2 1/kg, more than the root of 1 [1][1] times 1 [0][0]; J M^-1 J^T of masses > 0 has "
              "none such");
    EXPECT_EQ(message([](HostStep&, Given& g) { g[4].pop_back(); }),
              "ground_velocity: has 5 numbers; must have 6, 3 for each of 2 contacts");
    EXPECT_EQ(message([](HostStep&, Given&) {}), "nothing");
    EXPECT_THROW(ContactSet({}), InvalidInput);
    EXPECT_THROW(ContactSet({{AzadFeatherstoneNormal<>{-1, 0}, NoFriction<>{}}}), InvalidInput);
    EXPECT_THROW(ContactSet({paper()}, {.tolerance = 0.5}), InvalidInput);
    ContactSet set({paper()});
    EXPECT_THROW(set.restore({}, set.phases()), InvalidInput);
}

}  // namespace
}  // namespace footfall::test
