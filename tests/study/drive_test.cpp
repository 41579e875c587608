// The test rig against closed forms, an independent integration, and itself turned round.
#include "footfall/study/drive.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include "simulate/tried_laws.hpp"

namespace footfall::test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double load = 10;  // N, of every rig here that prescribes one
constexpr AzadFeatherstoneNormal<> normal_law{8.5e6, 3.1e3};

double static_depth() { return std::pow(load / 8.5e6, 2.0 / 3.0); }

Rig pressed(double end_time, double sample_period = 0) {
    Rig rig;
    rig.end_time = end_time;
    rig.sample_period = sample_period;
    rig.tolerance = 1e-11;
    rig.press = Press::load;
    rig.pressing.add(ConstantPart{load});
    return rig;
}

Rig indented(double end_time, PathPart path) {
    Rig rig;
    rig.end_time = end_time;
    rig.tolerance = 1e-11;
    rig.press = Press::indentation;
    rig.pressing.add(std::move(path));
    return rig;
}

int count(const Drive& run, EventKind kind) {
    int n = 0;
    for (const RigEvent& event : run.events) n += event.kind == kind;
    return n;
}

double time_of(const Drive& run, EventKind kind, int which = 0) {
    for (const RigEvent& event : run.events)
        if (event.kind == kind && which-- == 0) return event.time;
    ADD_FAILURE() << "no such event";
    return -1;
}

/// The sample nearest to a time.
const RigState& at(const Drive& run, double time) {
    const RigState* nearest = &run.samples.front();
    for (const RigState& s : run.samples)
        if (std::abs(s.time - time) < std::abs(nearest->time - time)) nearest = &s;
    EXPECT_NEAR(nearest->time, time, 1e-9);
    return *nearest;
}

double dissipated(const Drive& run, double from, double to) {
    return at(run, to).energy.contact.dissipated() - at(run, from).energy.contact.dissipated();
}

/// The friction laws with numbers that suit the load: stiffness 1e5 N/m, coefficient of friction 0.4, or 0.6 before
/// sliding where a law knows the difference.
std::vector<FrictionLaw> all_friction_laws() {
    const double k = 1e5 / load;
    const double root = std::sqrt(static_depth());
    const std::vector<FrictionLaw> all{NoFriction<>{},
                                       AzadFeatherstoneFriction<>{{1e5 / root, 50 / root, 0.4, 0.5}},
                                       LinearFriction<>{{1e5, 50, 0.4, 0}},
                                       LinearFriction<>{{1e5, 0, 0.4, 0}},
                                       RegularizedCoulombFriction<>{0.4, 1e-4},
                                       DahlFriction<>{k, 0.4},
                                       LuGreFriction<>{k, 5, 0.6, 0.4, 1e-3, 0.5},
                                       ElastoPlasticFriction<>{k, 5, 0.6, 0.4, 1e-3, 0.5, 0.7},
                                       BlimanSorineFriction<>{0.4, 0.3, 4e-5, 0.25},
                                       SevenParameterFriction<>{k, 0.4, 0.2, 1e-3, 1e-3, 0.1, 0.5},
                                       ResetIntegratorFriction<>{k, 5, 4e-5, 0.5},
                                       HaessigFriedlandFriction<>{k, 6e-5}};
    // A path of 0.2 mm at 2 Hz under the load.
    const Scale scale{.mass = load * 0.5 * 0.5 / 4e-5, .length = 4e-5, .time = 0.5, .number = 0.4};
    return completed<FrictionLaw>(all, scale);
}

std::string_view name(const FrictionLaw& law) { return name_of(law); }

TEST(Drive, SpringAndDamperAnswerASineWithTheirComplexStiffness) {
    const double A = 2e-6, f = 20, w = 2 * pi * f, k = 1e5, b = 300;
    Rig rig = pressed(0.2, 1e-3);
    rig.dragging[0].add(SinePart{A, f});
    const Drive run = drive(rig, {normal_law, LinearFriction<>{{k, b, 10, 0}}});
    for (const RigState& s : run.samples)
        EXPECT_NEAR(s.friction_force.x(), -k * A * std::sin(w * s.time) - b * A * w * std::cos(w * s.time), 1e-11);
    // Per cycle pi b w A^2, the imaginary part of the stiffness.
    EXPECT_NEAR(dissipated(run, 0.1, 0.15) / (pi * b * w * A * A), 1, 1e-9);
    EXPECT_NEAR(at(run, 0.15).energy.dragging_work - at(run, 0.1).energy.dragging_work, pi * b * w * A * A, 1e-15);
    EXPECT_LT(run.max_residual, 1e-10);
    EXPECT_EQ(count(run, EventKind::slip), 0);
}

TEST(Drive, PapersStiffnessUnderALoadIsThatOfTheStaticDepth) {
    Rig rig = pressed(1);
    rig.dragging[0].add(RampPart{2e-6, 0, 1});
    const Drive run = drive(rig, {normal_law, AzadFeatherstoneFriction<>{{12.75e6, 0, 10, 0}}});
    EXPECT_NEAR(run.samples.back().depth, static_depth(), 1e-12 * static_depth());
    EXPECT_NEAR(run.samples.back().friction_force.x(), -12.75e6 * std::sqrt(static_depth()) * 2e-6, 1e-10);
    EXPECT_NEAR(run.samples.back().normal_force, load, 1e-12);
}

TEST(Drive, CoulombsLoopTakesFourMuNTimesTheSlidingPath) {
    const double A = 1e-4, k = 1e5, mu = 0.4, x_b = mu * load / k;
    for (const double angle : {0.0, 0.7}) {
        Rig rig = pressed(4, 0.5);
        rig.dragging[0].add(SinePart{A * std::cos(angle), 1});
        rig.dragging[1].add(SinePart{A * std::sin(angle), 1});
        const Drive run = drive(rig, {normal_law, LinearFriction<>{{k, 0, mu, 0}}});
        EXPECT_NEAR(dissipated(run, 2, 3) / (4 * mu * load * (A - x_b)), 1, 1e-9) << angle;
        EXPECT_NEAR(run.largest_friction_force, mu * load, 1e-9);
        // It lets go where it has gone x_b from rest, and 2 x_b from each reversal.
        EXPECT_NEAR(time_of(run, EventKind::slip), std::asin(x_b / A) / (2 * pi), 1e-9);
        EXPECT_NEAR(time_of(run, EventKind::stick, 1), 0.25, 1e-9);
        EXPECT_NEAR(time_of(run, EventKind::slip, 1), 0.25 + std::acos(1 - 2 * x_b / A) / (2 * pi), 1e-9);
        EXPECT_LT(run.max_residual, 1e-9);
    }
}

TEST(Drive, DahlsLoopTakesItsClosedForm) {
    // du/dx = 1 -+ u/u_C between +-A closes on u = +-u_C tanh(A/u_C), whatever the speed, and encloses
    // 4 mu F_n (A - u_C tanh(A/u_C)).
    const double A = 5e-5, sigma = 1e4, mu = 0.4, u_C = mu / sigma;
    Rig rig = pressed(8, 0.25);
    rig.dragging[0].add(SinePart{A, 1});
    const Drive run = drive(rig, {normal_law, DahlFriction<>{sigma, mu}});
    EXPECT_NEAR(dissipated(run, 6, 7) / (4 * mu * load * (A - u_C * std::tanh(A / u_C))), 1, 1e-8);
    EXPECT_NEAR(at(run, 7.25).bristle.x(), u_C * std::tanh(A / u_C), 1e-8 * u_C);
    EXPECT_LT(run.max_residual, 1e-9);
}

TEST(Drive, ForceIndentationLoopAtConstantSpeedTakesItsClosedForm) {
    // f = K z^1.5 +- D v z^0.5, on the way back until it would pull, at z = D v / K.
    const double A = 1e-4, K = 8.5e6, D = 3.1e3, v = 2 * A / 0.01;
    Rig rig = indented(0.01, TrianglePart{A, 50, 0, 0.5});
    const Drive run = drive(rig, {normal_law, NoFriction<>{}});
    const auto spring = [&](double z) { return 0.4 * K * std::pow(z, 2.5); };
    const auto damper = [&](double z) { return 2.0 / 3.0 * D * v * std::pow(z, 1.5); };
    const double z_c = D * v / K;
    ASSERT_LT(z_c, A);
    const double taken = spring(A) + damper(A) - (spring(A) - spring(z_c) - damper(A) + damper(z_c));
    EXPECT_NEAR(run.samples.back().energy.contact.normal_damper / taken, 1, 1e-10);
    EXPECT_NEAR(run.samples.back().energy.pressing_work / taken, 1, 1e-10);
    EXPECT_NEAR(time_of(run, EventKind::separation), 0.01 - z_c / v, 1e-13);
    EXPECT_EQ(count(run, EventKind::touchdown), 1);
    EXPECT_LT(run.max_residual, 1e-11);
}

TEST(Drive, ContactComesAndGoesWithThePath) {
    // z = A sin: in the ground for half of each cycle. The damper is faster than the spring where tan < ... F_n = 0.
    const double A = 5e-5, w = 2 * pi * 50;
    Rig rig = indented(0.06, SinePart{A, 50});
    rig.drag = Drag::velocity;
    rig.dragging[0].add(ConstantPart{0.01});
    const Drive run = drive(rig, {normal_law, AzadFeatherstoneFriction<>{{12.75e6, 3.1e3, 0.3, 0}}});
    ASSERT_EQ(count(run, EventKind::touchdown), 3);
    ASSERT_EQ(count(run, EventKind::recovered), 3);
    EXPECT_NEAR(time_of(run, EventKind::touchdown, 1), 0.02, 1e-14);
    EXPECT_NEAR(time_of(run, EventKind::touchdown, 2), 0.04, 1e-14);
    // K sin + D w cos = 0
    const double separation = (pi - std::atan(3.1e3 * w / 8.5e6)) / w;
    EXPECT_NEAR(time_of(run, EventKind::separation), separation, 1e-13);
    EXPECT_NEAR(time_of(run, EventKind::separation, 1), 0.02 + separation, 1e-13);
    EXPECT_LT(run.max_residual, 1e-10);
    for (const RigState& s : run.samples) {
        EXPECT_LE(s.friction_force.norm(), 0.3 * s.normal_force + 1e-9);
        EXPECT_GE(s.normal_force, 0);
    }
}

TEST(Drive, LawsThatAskForTheSpeedOfImpactGetThatOfThePath) {
    // e = 1 makes Lankarani & Nikravesh elastic, whatever the speed; e < 1 takes more at twice the stroke.
    const auto taken = [](double e) {
        const Rig rig = indented(0.01, SinePart{5e-5, 50});
        LankaraniNikraveshNormal<> law{};
        law.stiffness = 8.5e6;
        law.restitution = e;
        return drive(rig, {law, NoFriction<>{}}).samples.back().energy.contact.normal_damper;
    };
    EXPECT_NEAR(taken(1), 0, 1e-15);
    // The classical law with lambda = 3 K (1 - e^2) / (4 v): the integral of lambda z^1.5 zdot^2 dt, z = A sin, is
    // lambda A^3.5 w times the integral of sin^1.5 cos^2 over half a turn, B(5/4, 3/2).
    const double A = 5e-5, w = 2 * pi * 50, e = 0.9;
    const double lambda = 0.75 * 8.5e6 * (1 - e * e) / (A * w);
    EXPECT_NEAR(taken(e) / (lambda * std::pow(A, 3.5) * w * std::beta(1.25, 1.5)), 1, 1e-8);
}

TEST(Drive, FrictionHoldsStillWhereTheDriveDoes) {
    Rig rig = pressed(2);
    rig.dragging[0].add(RampPart{3e-4, 0, 1});
    for (const FrictionLaw& law :
         {FrictionLaw(AzadFeatherstoneFriction<>{{12.75e6, 3.1e3, 0.3, 0}}),
          FrictionLaw(LinearFriction<>{{1e5, 0, 0.3, 0}}), FrictionLaw(DahlFriction<>{1e4, 0.3})}) {
        const Drive run = drive(rig, {normal_law, law});
        EXPECT_NEAR(at(run, 1.002).friction_force.x(), -0.3 * load, 0.3 * load * 1e-3) << name(law);
        EXPECT_NEAR(at(run, 2).friction_force.x(), at(run, 1.002).friction_force.x(), 1e-9) << name(law);
    }
}

TEST(Drive, SlowVelocityRampTracesTheStribeckCurve) {
    Rig rig = pressed(10, 0.1);
    rig.drag = Drag::velocity;
    rig.dragging[0].add(RampPart{0.01, 0, 10});
    const LuGreFriction<> law{1e5, 10, 0.6, 0.4, 1e-3, 2};
    const Drive run = drive(rig, {normal_law, law});
    for (const double V : {1e-3, 2e-3, 5e-3, 9e-3}) {
        const double curve = 0.4 + 0.2 * std::exp(-(V / 1e-3) * (V / 1e-3)) + 2 * V;
        EXPECT_NEAR(-at(run, V * 1000).friction_force.x() / load, curve, 2e-3 * curve) << V;
    }
}

// A path that leaves the ground's force behind, so that the clamp acts in mid-contact, and comes back to it.
TEST(Drive, AContactThatIsUnloadedAndLoadedAgainHasTheForceOfTheClamp) {
    const double mean = 1e-5, A = 9e-6, f = 500, w = 2 * pi * f;
    for (const FrictionLaw& law : all_friction_laws()) {
        Rig rig = indented(0.02, SinePart{A, f});
        rig.pressing.add(ConstantPart{mean});
        rig.sample_period = 1e-5;
        rig.drag = Drag::velocity;
        rig.dragging[0].add(ConstantPart{1e-3});
        const Drive run = drive(rig, {normal_law, law});
        for (const RigState& s : run.samples) {
            const double z = mean + A * std::sin(w * s.time), rate = A * w * std::cos(w * s.time);
            const double force = 8.5e6 * std::pow(z, 1.5) + 3.1e3 * std::sqrt(z) * rate;
            EXPECT_NEAR(s.normal_force, std::max(force, 0.0), 1e-9) << name(law) << s.time;
        }
        EXPECT_EQ(count(run, EventKind::separation), 10) << name(law);
        EXPECT_EQ(count(run, EventKind::touchdown), 11) << name(law);
        EXPECT_LT(run.max_residual, 1e-9) << name(law);
    }
}

// ---- the largest forces
// ----------------------------------------------------------------------------------------------

TEST(Drive, LargestForcesStandBetweenTheSamplesAsWell) {
    // Spring and damper under a sine: A |k + i b w|. The load: its mean and its amplitude.
    const double A = 2e-6, f = 20, w = 2 * pi * f, k = 1e5, b = 300;
    for (const double sample_period : {1e-4, 0.2}) {
        Rig rig = pressed(0.2, sample_period);
        rig.pressing.add(SinePart{3, 7, 0.3});
        rig.dragging[0].add(SinePart{A, f});
        const Drive run = drive(rig, {normal_law, LinearFriction<>{{k, b, 10, 0}}});
        EXPECT_NEAR(run.largest_friction_force / (A * std::hypot(k, b * w)), 1, 1e-9) << sample_period;
        EXPECT_NEAR(run.largest_normal_force / (load + 3), 1, 1e-12) << sample_period;
    }
}

TEST(Drive, LargestForceOfAPressIsThatOfSpringAndDamper) {
    // z = A sin wt: K z^1.5 + D z^0.5 zdot, by golden section in long double.
    const long double A = 5e-5L, w = 2 * std::numbers::pi_v<long double> * 50;
    const auto force = [&](long double t) {
        const long double z = A * std::sin(w * t);
        return 8.5e6L * std::pow(z, 1.5L) + 3.1e3L * std::sqrt(z) * A * w * std::cos(w * t);
    };
    const long double golden = std::numbers::phi_v<long double> - 1;
    long double low = 1e-4L, high = 0.009L;
    while (high - low > 1e-12L) {
        const long double a = high - golden * (high - low), c = low + golden * (high - low);
        (force(a) < force(c) ? low : high) = force(a) < force(c) ? a : c;
    }
    for (const double sample_period : {1e-5, 0.01}) {
        Rig rig = indented(0.01, SinePart{5e-5, 50});
        rig.sample_period = sample_period;
        const double largest = drive(rig, {normal_law, NoFriction<>{}}).largest_normal_force;
        EXPECT_NEAR(largest / static_cast<double>(force(low)), 1, 1e-12) << sample_period;
    }
}

TEST(Drive, LargestForcesDoNotDependOnTheSamplePeriodUnderAnyLaw) {
    for (const FrictionLaw& law : all_friction_laws()) {
        const auto run = [&](double sample_period) {
            Rig rig = pressed(0.6, sample_period);
            rig.pressing.add(SinePart{4, 3});
            rig.dragging[0].add(SinePart{2e-4, 2});
            rig.dragging[1].add(SinePart{1e-4, 3});
            return drive(rig, {normal_law, law});
        };
        const Drive coarse = run(0.6), fine = run(1e-4);
        EXPECT_EQ(coarse.largest_normal_force, fine.largest_normal_force) << name(law);
        EXPECT_EQ(coarse.largest_friction_force, fine.largest_friction_force) << name(law);
        for (const RigState& s : fine.samples) {
            EXPECT_LE(s.normal_force, coarse.largest_normal_force * (1 + 1e-9)) << name(law);
            EXPECT_LE(s.friction_force.norm(), coarse.largest_friction_force * (1 + 1e-9)) << name(law) << s.time;
        }
    }
}

// ---- a mass on a belt
// --------------------------------------------------------------------------------------------------

Rig belt(double end_time, double mass, double stiffness, double speed) {
    Rig rig = pressed(end_time);
    rig.drag = Drag::mass;
    rig.mass.mass = mass;
    rig.mass.stiffness = stiffness;
    rig.mass.belt[0].add(ConstantPart{speed});
    return rig;
}

/// The linear clutch law on a belt, from (19), (25), (26) and (31) with C_V = 0, by classical Runge-Kutta steps in long
/// double that end on the switches by bisection. Shares nothing with the library.
struct BeltOracle {
    using Real = long double;
    struct State {
        Real t, x, v, u;
    };
    Real m, k, k_t, b_t, cone;
    bool slips = false;
    State y{0, 0, 0, 0};
    std::vector<Real> switches;

    /// The belt runs at 5 cm/s and slows down to 1 cm/s from 0.1 s to 0.2 s.
    static Real v_b(const State& s) { return s.t < 0.1L ? 0.05L : s.t < 0.2L ? 0.05L - 0.4L * (s.t - 0.1L) : 0.01L; }
    Real f_stick(const State& s) const { return -(k_t * s.u + b_t * (s.v - v_b(s))); }
    State rate(const State& s) const {
        Real F = f_stick(s), u_rate = s.v - v_b(s);
        if (slips) {
            F = F > 0 ? cone : -cone;
            u_rate = -(F + k_t * s.u) / b_t;
        }
        return {1, s.v, (F - k * s.x) / m, u_rate};
    }
    State step(const State& s, Real h) const {
        const auto plus = [](const State& a, const State& d, Real c) {
            return State{a.t + c, a.x + c * d.x, a.v + c * d.v, a.u + c * d.u};
        };
        const State a = rate(s), b = rate(plus(s, a, h / 2)), c = rate(plus(s, b, h / 2)), d = rate(plus(s, c, h));
        return {s.t + h, s.x + h / 6 * (a.x + 2 * b.x + 2 * c.x + d.x), s.v + h / 6 * (a.v + 2 * b.v + 2 * c.v + d.v),
                s.u + h / 6 * (a.u + 2 * b.u + 2 * c.u + d.u)};
    }
    Real margin(const State& s) const {
        const Real inside = cone - std::abs(f_stick(s));
        return slips ? -inside : inside;
    }
    void run(Real end, int steps) {
        slips = std::abs(f_stick(y)) > cone;
        const Real h = end / steps;
        for (int i = 0; i < steps; ++i) {
            Real left = h;
            while (left > 0) {
                const State next = step(y, left);
                if (margin(next) >= 0) {
                    y = next;
                    break;
                }
                Real low = 0, high = left;
                for (int b = 0; b < 70; ++b) {
                    const Real middle = (low + high) / 2;
                    (margin(step(y, middle)) >= 0 ? low : high) = middle;
                }
                y = step(y, high);
                left -= high;
                slips = !slips;
                switches.push_back(y.t);
            }
        }
    }
};

TEST(Drive, PapersLawOnABeltFollowsAnIndependentIntegration) {
    const double m = 0.1, k = 2000, mu = 0.4, root = std::sqrt(static_depth());
    const double K_t = 1e4 / root, D_t = 2 / root;
    BeltOracle oracle{m, k, 1e4, 2, mu * load, false, {0, 0, 0, 0}, {}};
    oracle.run(0.5L, 100000);
    Rig rig = belt(0.5, m, k, 0.05);
    rig.mass.belt[0].add(RampPart{-0.04, 0.1, 0.1});
    rig.tolerance = 1e-12;
    const Drive run = drive(rig, {normal_law, AzadFeatherstoneFriction<>{{K_t, D_t, mu, 0}}});
    const Drive linear = drive(rig, {normal_law, LinearFriction<>{{1e4, 2, mu, 0}}});
    std::vector<double> switches;
    for (const RigEvent& event : run.events)
        if (event.time > 0 && event.kind != EventKind::touchdown) switches.push_back(event.time);
    ASSERT_GE(oracle.switches.size(), 3u);
    ASSERT_EQ(switches.size(), oracle.switches.size());
    for (std::size_t i = 0; i < switches.size(); ++i)
        EXPECT_NEAR(switches[i], static_cast<double>(oracle.switches[i]), 1e-9) << i;
    EXPECT_NEAR(run.samples.back().position.x(), static_cast<double>(oracle.y.x), 1e-11);
    EXPECT_NEAR(run.samples.back().velocity.x(), static_cast<double>(oracle.y.v), 1e-9);
    EXPECT_NEAR(linear.samples.back().position.x(), run.samples.back().position.x(), 1e-11);
    EXPECT_LT(run.max_residual, 1e-10);
}

TEST(Drive, StickSlipHasTheClassicalPeriodOfStaticAndKineticFriction) {
    // Friction F_s until it slides, F_k while it does, a rigid contact: from v = v_b and x = F_s/k the mass swings
    // about F_k/k until it is as fast as the belt again, at 2 F_k/k - F_s/k, and is carried back.
    const double m = 1, k = 1000, v_b = 0.01, mu_k = 0.4, stiction = 0.5;
    const double delta = stiction * mu_k * load / k, w = std::sqrt(k / m);
    const double period = 2 * delta / v_b + (2 * pi - 2 * std::atan(delta * w / v_b)) / w;
    Rig rig = belt(8, m, k, v_b);
    rig.tolerance = 1e-9;
    const double sigma = 1e6;  // the contact is 1e4 times as stiff as the spring
    const Drive run = drive(rig, {normal_law, ResetIntegratorFriction<>{sigma, 200, mu_k / sigma, stiction}});
    ASSERT_TRUE(run.stick_slip.has_value());
    EXPECT_GE(run.stick_slip->cycles, 5);
    EXPECT_NEAR(run.stick_slip->period / period, 1, 3e-3);
    // The greatest deflection lies a little past F_s/k, since the mass has the belt's speed as it lets go.
    const double swing = std::hypot(delta, v_b / w);
    EXPECT_NEAR(run.stick_slip->greatest / (mu_k * load / k + swing), 1, 3e-3);
    EXPECT_NEAR(run.stick_slip->amplitude / swing, 1, 3e-3);
    EXPECT_NEAR(run.stick_slip->sticking, 2 * delta / v_b / period, 3e-3);
    rig.sample_period = 8;
    const Drive coarse = drive(rig, {normal_law, ResetIntegratorFriction<>{sigma, 200, mu_k / sigma, stiction}});
    ASSERT_TRUE(coarse.stick_slip.has_value());
    EXPECT_EQ(coarse.stick_slip->sticking, run.stick_slip->sticking);
}

TEST(Drive, TheTimeWithTheBeltIsMeasuredUnderALawThatDoesNotSayWhenItSticks) {
    // Without friction the mass swings under a force that is there from the start: v = a sin wt. It is within 1 % of
    // the belt's speed a/2 while sin is between 0.495 and 0.505, up and down.
    const double m = 1, k = 1000, w = std::sqrt(k / m), a = 0.02;
    for (const double sample_period : {1e-3, 3.0}) {
        Rig rig = belt(3, m, k, a / 2);
        rig.sample_period = sample_period;
        rig.mass.force[0].add(ConstantPart{a * w * m});
        const Drive run = drive(rig, {normal_law, NoFriction<>{}});
        ASSERT_TRUE(run.stick_slip.has_value());
        EXPECT_NEAR(run.stick_slip->period, 2 * pi / w, 1e-9);
        EXPECT_NEAR(run.stick_slip->sticking, (std::asin(0.505) - std::asin(0.495)) / pi, 1e-9) << sample_period;
    }
}

TEST(Drive, SteadySlidingIsNoStickSlip) {
    // Viscous friction damps the swing away.
    const Drive run = drive(belt(20, 0.1, 1000, 0.05), {normal_law, LinearFriction<>{{1e5, 50, 0.4, 5}}});
    EXPECT_NEAR(run.samples.back().velocity.x(), 0, 1e-9);
    EXPECT_TRUE(!run.stick_slip || run.stick_slip->amplitude < 1e-6);
}

// ---- drift
// ---------------------------------------------------------------------------------------------------------------

/// How far a mass under a constant force of 60 % and an oscillation of 20 % of break-away creeps in a cycle, in units
/// of what the contact gives way elastically.
double drift(const FrictionLaw& law) {
    const double F_C = 0.4 * load;
    Rig rig = pressed(3, 0.1);
    rig.tolerance = 1e-10;
    rig.drag = Drag::mass;
    rig.mass.mass = 1;
    rig.mass.force[0].add(RampPart{0.6 * F_C, 0, 0.5});
    rig.mass.force[0].add(SinePart{0.2 * F_C, 10, 0, 0.5});
    const Drive run = drive(rig, {normal_law, law});
    EXPECT_LT(run.max_residual, 1e-7) << name(law);
    return (at(run, 3).position.x() - at(run, 2).position.x()) / 10 / (F_C / 1e5);
}

TEST(Drive, DahlAndLuGreDriftUnderASmallLoadWhereElastoPlasticAndThePapersLawDoNot) {
    const double k = 1e5 / load, root = std::sqrt(static_depth());
    EXPECT_GT(drift(DahlFriction<>{k, 0.4}), 0.01);
    EXPECT_GT(drift(LuGreFriction<>{k, 50, 0.4, 0.4, 1e-3, 0}), 0.01);
    EXPECT_LT(std::abs(drift(ElastoPlasticFriction<>{k, 50, 0.4, 0.4, 1e-3, 0, 0.9})), 1e-5);
    EXPECT_LT(std::abs(drift(AzadFeatherstoneFriction<>{{1e5 / root, 500 / root, 0.4, 0}})), 1e-5);
}

// ---- what the steps cost
// -------------------------------------------------------------------------------------------------

TEST(Drive, TakesAsManyStepsAsTheMotionAsksForHoweverStiffTheBristleIs) {
    // As D_t goes to 0 the bristle is drawn to its cone in D_t/K_t, below 1e-9 s here, and the motion goes to that
    // without damping by an error in proportion to D_t. In the plane the direction in which it is drawn turns.
    for (const bool planar : {false, true}) {
        for (const double tolerance : {1e-6, 1e-9, 1e-11}) {
            Rig rig = pressed(1, 0.1);
            rig.tolerance = tolerance;
            rig.max_evaluations = 1e6;
            rig.pressing.add(SinePart{5, 1.3});
            rig.dragging[0].add(SinePart{4e-5, 2});
            if (planar) rig.dragging[1].add(SinePart{2.5e-5, 3, 0.7});
            const auto run = [&](double damping) {
                return drive(rig, {normal_law, AzadFeatherstoneFriction<>{{12.75e6, damping, 0.2, 0}}});
            };
            const Drive without = run(0);
            for (const double damping : {0.01, 0.1, 1.0, 10.0, 100.0, 1000.0, 3100.0, 3e4}) {
                const Drive with = run(damping);
                EXPECT_LE(with.cost.steps, 12 * without.cost.steps) << damping << ", " << tolerance << ", " << planar;
                EXPECT_LT(with.max_residual, 1e-8) << damping << ", " << tolerance << ", " << planar;
                EXPECT_EQ(with.events.size(), without.events.size()) << damping << ", " << tolerance << ", " << planar;
                const double apart =
                    (with.samples.back().friction_force - without.samples.back().friction_force).norm();
                EXPECT_LT(apart, 3e-7 * damping + 10 * tolerance) << damping << ", " << tolerance << ", " << planar;
            }
        }
    }
}

TEST(Drive, TakesAsManyStepsAsTheMotionAsksForUnderLawsWithTheSizeOfTheSpeedInThem) {
    // A cycle takes 30 to 150 steps; a bristle a thousand times as stiff moves the contact no differently.
    for (const double stiffness : {1e3, 1e4, 1e5, 1e6, 1e7}) {
        for (const FrictionLaw& law : {FrictionLaw(DahlFriction<>{stiffness, 0.2}),
                                       FrictionLaw(LuGreFriction<>{stiffness, 5, 0.3, 0.2, 1e-3, 0})}) {
            Rig rig = pressed(1, 0.1);
            rig.tolerance = 1e-9;
            rig.pressing.add(SinePart{5, 1.3});
            rig.dragging[0].add(SinePart{4e-5, 2});
            rig.dragging[1].add(SinePart{2.5e-5, 3, 0.7});
            const Drive run = drive(rig, {normal_law, law});
            EXPECT_LT(run.cost.steps, 800) << name(law) << ", " << stiffness;
            EXPECT_LT(run.max_residual, 1e-9) << name(law) << ", " << stiffness;
        }
    }
}

// ---- all laws
// ---------------------------------------------------------------------------------------------------------------

TEST(Drive, EveryLawIsTried) {
    std::vector<bool> tried(std::variant_size_v<FrictionLaw>);
    for (const FrictionLaw& law : all_friction_laws()) tried[law.index()] = true;
    for (std::size_t i = 0; i < tried.size(); ++i) EXPECT_TRUE(tried[i]) << "friction law " << i;
}

TEST(Drive, ClosesTheAccountUnderEveryLaw) {
    Rig loop = pressed(1);
    loop.tolerance = 1e-9;
    loop.pressing.add(SinePart{4, 3});  // the load changes as well
    loop.dragging[0].add(SinePart{2e-4, 2});
    loop.dragging[1].add(SinePart{1e-4, 3});
    Rig presses = indented(0.06, TrianglePart{5e-5, 50});
    presses.tolerance = 1e-9;
    presses.drag = Drag::velocity;
    presses.dragging[0].add(ConstantPart{2e-3});
    presses.dragging[1].add(SinePart{2e-3, 70});
    Rig held = belt(0.5, 0.2, 2000, 0.01);
    held.tolerance = 1e-9;
    held.mass.damping = 1;
    held.mass.support[1].add(RampPart{1e-3, 0.1, 0.3});
    held.mass.force[1].add(SinePart{1, 5});
    for (const FrictionLaw& law : all_friction_laws()) {
        EXPECT_LT(drive(loop, {normal_law, law}).max_residual, 1e-7) << name(law);
        EXPECT_LT(drive(presses, {normal_law, law}).max_residual, 1e-7) << name(law);
        EXPECT_LT(drive(held, {normal_law, law}).max_residual, 1e-7) << name(law);
    }
}

TEST(Drive, ASevenParameterContactSticksForSomeTimeWheneverItSticks) {
    for (const double stribeck_velocity : {1e-3, 0.01}) {
        Rig rig = belt(4, 1, 1000, 2e-3);
        rig.tolerance = 1e-9;
        const Drive run =
            drive(rig, {normal_law, SevenParameterFriction<>{1.346e4, 0.2, 0.1, stribeck_velocity, 1e-3, 0.1, 0.5}});
        double held = -1;
        for (const RigEvent& event : run.events) {
            if (event.kind == EventKind::slip && held >= 0) {
                EXPECT_GT(event.time - held, 1e-6) << event.time;
            }
            held = event.kind == EventKind::stick ? event.time : -1;
        }
        EXPECT_GT(count(run, EventKind::stick), 10);
        EXPECT_LT(run.max_residual, 1e-8);
    }
}

// Without a rise of alpha between elastic and plastic, and without a Stribeck curve, it is a spring that ends:
// Coulomb's loop.
TEST(Drive, AnElastoPlasticContactWithASharpBorderTakesCoulombsLoop) {
    const double A = 1e-4, k = 1e5, mu = 0.4, x_b = mu * load / k;
    Rig rig = pressed(4, 0.5);
    rig.dragging[0].add(SinePart{A, 1});
    const Drive run = drive(rig, {normal_law, ElastoPlasticFriction<>{k / load, 0, mu, mu, 1e-3, 0, 1}});
    EXPECT_NEAR(dissipated(run, 2, 3) / (4 * mu * load * (A - x_b)), 1, 1e-8);
    EXPECT_NEAR(time_of(run, EventKind::slip), std::asin(x_b / A) / (2 * pi), 1e-9);
    EXPECT_NEAR(time_of(run, EventKind::stick, 1), 0.25, 1e-8);
    EXPECT_NEAR(time_of(run, EventKind::slip, 1), 0.25 + std::acos(1 - 2 * x_b / A) / (2 * pi), 1e-9);
    EXPECT_LT(run.max_residual, 1e-9);
}

TEST(Drive, AnElastoPlasticContactIsAsRightWhereItsBorderIsSharp) {
    const auto looped = [](double elastic_share, double static_coefficient, double tolerance) {
        Rig rig = pressed(1, 1e-2);
        rig.tolerance = tolerance;
        rig.dragging[0].add(SinePart{1e-4, 1});
        rig.dragging[1].add(SinePart{3e-5, 2.3});
        return drive(rig,
                     {normal_law, ElastoPlasticFriction<>{1e4, 5, static_coefficient, 0.4, 1e-3, 0.5, elastic_share}});
    };
    for (const double static_coefficient : {0.4, 0.6}) {
        const Drive usual = looped(0.7, static_coefficient, 1e-9);
        for (const double elastic_share : {0.7, 0.99, 1.0}) {
            const Drive run = looped(elastic_share, static_coefficient, 1e-9),
                        exact = looped(elastic_share, static_coefficient, 1e-13);
            EXPECT_LE(run.cost.steps, 2 * usual.cost.steps) << elastic_share;
            for (std::size_t i = 0; i < run.samples.size(); ++i)
                EXPECT_LE((run.samples[i].friction_force - exact.samples[i].friction_force).norm(), 1e-6 * load)
                    << elastic_share << " " << run.samples[i].time;
        }
    }
}

TEST(Drive, TurningTheDriveTurnsTheAnswer) {
    const double angle = 0.9;
    const Eigen::Rotation2Dd turn(angle);
    Rig rig = pressed(0.5, 0.05), turned = rig;
    const Path x{{SinePart{1e-4, 4}}}, y{{SinePart{5e-5, 6}}};
    rig.dragging = {x, y};
    turned.dragging[0] = x.scaled(std::cos(angle));
    turned.dragging[0].add(y.scaled(-std::sin(angle)).parts().front());
    turned.dragging[1] = x.scaled(std::sin(angle));
    turned.dragging[1].add(y.scaled(std::cos(angle)).parts().front());
    for (const FrictionLaw& law : all_friction_laws()) {
        const Drive a = drive(rig, {normal_law, law}), b = drive(turned, {normal_law, law});
        ASSERT_EQ(a.samples.size(), b.samples.size());
        for (std::size_t i = 0; i < a.samples.size(); ++i)
            EXPECT_LT((turn * a.samples[i].friction_force - b.samples[i].friction_force).norm(), 1e-5) << name(law);
    }
}

TEST(Drive, ATighterToleranceIsNearerToTheTruth) {
    Rig rig = belt(0.5, 0.1, 2000, 0.02);
    const ContactParameters laws{normal_law, LinearFriction<>{{1e4, 2, 0.4, 0.3}}};
    const auto end = [&](double tolerance) {
        rig.tolerance = tolerance;
        return drive(rig, laws).samples.back().position.x();
    };
    const double truth = end(1e-13);
    EXPECT_LT(std::abs(end(1e-11) - truth), 1e-11);
    EXPECT_LT(std::abs(end(1e-8) - truth), 1e-8);
    EXPECT_GT(std::abs(end(1e-4) - truth), std::abs(end(1e-8) - truth));
}

TEST(Drive, SamplesStandAtMultiplesOfTheirPeriodAndAtTheEnd) {
    Rig rig = pressed(0.35, 0.1);
    rig.dragging[0].add(RampPart{1e-6, 0.05, 0.2});
    const Drive run = drive(rig, {normal_law, LinearFriction<>{{1e5, 0, 0.4, 0}}});
    ASSERT_EQ(run.samples.size(), 5u);
    const double times[] = {0, 0.1, 0.2, 0.3, 0.35};
    for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(run.samples[i].time, times[i], 1e-15);
    EXPECT_NEAR(run.samples[2].slip_displacement.x(), 1e-6 * 0.75, 1e-16);
    const Table table = drive_table(rig, {{"one", run}, {"two", run}});
    for (const Column& column : table.columns) EXPECT_EQ(column.values.size(), 5u) << column.name;
}

// ---- what cannot be driven
// ------------------------------------------------------------------------------------------------

std::string refusal(const Rig& rig) {
    try {
        (void)drive(rig, {normal_law, NoFriction<>{}});
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "";
}

TEST(Drive, RefusesALoadThatLifts) {
    Rig rig = pressed(1);
    rig.pressing.add(SinePart{12, 3});
    EXPECT_NE(refusal(rig).find("must be > 0 all the time"), std::string::npos) << refusal(rig);
}

TEST(Drive, RefusesPathsThatAreNoPaths) {
    const auto with = [](PathPart part) {
        Rig rig = pressed(1);
        rig.dragging[1].add(std::move(part));
        return refusal(rig);
    };
    EXPECT_NE(with(RampPart{1, 0, 0}).find("displacement: duration: 0 is not allowed"), std::string::npos);
    EXPECT_NE(with(SinePart{1, -2}).find("displacement: frequency: -2 is not allowed"), std::string::npos);
    EXPECT_NE(with(TablePart{{0, 1, 1}, {0, 1, 2}}).find("displacement: time: 1 is not allowed"), std::string::npos);
    EXPECT_NE(with(TablePart{{0, 1}, {0}}).find("2 times and 1 values"), std::string::npos);
    EXPECT_NE(with(ConstantPart{std::nan("")}).find("displacement: value: nan"), std::string::npos);
}

TEST(Path, IsTheSumOfItsParts) {
    const Path path{{ConstantPart{1}, RampPart{2, 1, 2}, SinePart{3, 0.5, 0, 1, 2}, TrianglePart{4, 1, 0, 1},
                     TablePart{{0, 4}, {0, 8}}}};
    // At 0.1: 1 + 0 + 0 + 4 * 4 * 0.1 + 0.2
    EXPECT_NEAR(path.at(0.1).value, 1 + 1.6 + 0.2, 1e-15);
    EXPECT_NEAR(path.at(0.1).rate, 16 + 2, 1e-13);
    // At 1.5: 1 + 0.5 + 3 sin(pi/2) + 0 + 3
    EXPECT_NEAR(path.at(1.5).value, 1 + 0.5 + 3 + 3, 1e-14);
    EXPECT_NEAR(path.at(1.5).acceleration, -3 * pi * pi, 1e-12);
    // After all: 1 + 2 + 0 + 0 + 8
    EXPECT_NEAR(path.at(9).value, 11, 1e-14);
    EXPECT_NEAR(path.at(9).rate, 0, 0);
    // A triangle turns at a quarter and three quarters.
    EXPECT_NEAR((Path{{TrianglePart{2, 1}}}).at(0.25).value, 2, 1e-15);
    EXPECT_NEAR((Path{{TrianglePart{2, 1}}}).at(0.75).value, -2, 1e-15);
    EXPECT_NEAR((Path{{TrianglePart{2, 1}}}).at(0.6).rate, -8, 1e-13);
}

}  // namespace
}  // namespace footfall::test
