// Oblique impact against rigid-body mechanics, conservation, similarity, and an integration that shares no code.
#include "footfall/study/oblique.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace footfall::test {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double mass = 2.618e-4, radius = 2.5e-3;  // Kharaz's alumina sphere of 5 mm
constexpr double K_n = 2.675e10;

/// kappa is K_t over (3/2) K_n.
ObliqueSphere sphere(double mu, double kappa = 1, double D_n = 0, double D_t = 0) {
    ObliqueSphere s;
    s.mass = mass;
    s.radius = radius;
    s.contact = {AzadFeatherstoneNormal<>{K_n, D_n}, AzadFeatherstoneFriction<>{{1.5 * kappa * K_n, D_t, mu, 0}}};
    s.tolerance = 1e-12;
    return s;
}

/// The approach with a given psi_1 = V/(mu V_n), without spin.
Approach approach_of_psi1(double psi1, double mu, double normal_speed) {
    return {.normal_speed = normal_speed, .tangential_velocity = psi1 * mu * normal_speed, .spin = 0};
}

const std::vector<double>& column(const Table& table, const std::string& name) {
    for (const Column& c : table.columns) {
        if (c.name == name) return c.values;
    }
    throw std::out_of_range(name);
}

bool has_column(const Table& table, const std::string& name) {
    for (const Column& c : table.columns) {
        if (c.name == name) return true;
    }
    return false;
}

void expect_message(const std::function<void()>& f, const std::string& words) {
    try {
        f();
        ADD_FAILURE() << "nothing was thrown; expected: " << words;
    } catch (const InvalidInput& error) {
        EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
}

// Rigid-body limits ---------------------------------------------------------------------------------------------------

TEST(ObliqueImpact, WithoutFrictionNothingTangentialChanges) {
    ObliqueSphere s = sphere(0.1, 1, 800);
    s.contact.friction = NoFriction<>{};
    const ObliqueImpact o = oblique_impact(s, approach_at_speed(3.9, 40 * degree, 120));
    EXPECT_NEAR(o.tangential_restitution(), 1, 1e-12);
    EXPECT_NEAR(o.contact_restitution(), -1, 1e-12);
    EXPECT_NEAR(o.spin, 120, 1e-9);
    EXPECT_NEAR(o.impulse_ratio, 0, 1e-12);
}

// Where it slides throughout, the impulse of friction is mu times the normal one: v_x' = v_x - mu (1 + e) V_n and
// omega' = mu (1 + e) V_n m r / I, whatever the loss in the normal direction. (Where the normal force starts with a
// jump, as the linear law's, the contact sticks before it slides.)
TEST(ObliqueImpact, SlidingThroughoutIsTheRigidBodysClosedForm) {
    const double mu = 0.092;
    for (const double share : {2.0 / 5.0, 2.0 / 3.0}) {
        for (const double angle : {45.0, 60.0, 85.0}) {
            for (const NormalLaw& normal :
                 {NormalLaw{AzadFeatherstoneNormal<>{K_n, 900}}, NormalLaw{HuntCrossleyNormal<>{K_n, 4e9}}}) {
                ObliqueSphere s = sphere(mu, 1, 0, 900);
                s.inertia = share * mass * radius * radius;
                s.contact.normal = normal;
                const ObliqueImpact o = oblique_impact(s, approach_at_speed(3.9, angle * degree));
                const double e = o.normal_restitution();
                ASSERT_GT(e, 0.5);
                ASSERT_LT(e, 0.999);
                EXPECT_NEAR(o.tangential_restitution(), 1 - mu * (1 + e) / std::tan(angle * degree), 1e-9);
                EXPECT_NEAR(o.spin, mu * (1 + e) * o.in.normal_speed / (share * radius), 1e-6);
                EXPECT_NEAR(o.impulse_ratio, mu, 1e-9);
                EXPECT_NEAR(std::tan(o.rebound_angle()), std::tan(angle * degree) / e - mu * (1 + e) / e, 1e-8);
            }
        }
    }
}

// A contact that can neither slide nor give ends rolling: of a solid sphere 5/7 of the speed is left, of a hollow one
// 3/5.
TEST(ObliqueImpact, AContactThatCannotGiveEndsRolling) {
    for (const auto& [share, left] : {std::pair{2.0 / 5.0, 5.0 / 7.0}, {2.0 / 3.0, 3.0 / 5.0}}) {
        double last = 1;
        for (const double D_t : {3e5, 3e6}) {
            ObliqueSphere s = sphere(100, 1e-3, 0, D_t);
            s.inertia = share * mass * radius * radius;
            const ObliqueImpact o = oblique_impact(s, approach_at_speed(3.9, 20 * degree));
            const double departure = std::abs(o.tangential_restitution() - left);
            EXPECT_LT(departure, 0.3 * last);
            last = departure;
        }
        EXPECT_LT(last, 2e-3);
    }
}

TEST(ObliqueImpact, ARollingSphereStaysRolling) {
    const double v = 1.3;
    const ObliqueImpact o = oblique_impact(sphere(0.3, 0.8, 500, 500), {2, v, v / radius});
    EXPECT_NEAR(o.tangential_velocity, v, 1e-10);
    EXPECT_NEAR(o.spin, v / radius, 1e-7);
    EXPECT_TRUE(std::isnan(o.contact_restitution()));
}

// Conservation and symmetry -------------------------------------------------------------------------------------------

class ObliqueSweep : public ::testing::TestWithParam<double> {
protected:
    double angle = GetParam() * degree;
};
INSTANTIATE_TEST_SUITE_P(Angles, ObliqueSweep, ::testing::Values(2.0, 8.0, 17.0, 26.0, 31.0, 50.0));

TEST_P(ObliqueSweep, AngularMomentumAboutTheContactPointIsConserved) {
    const ObliqueImpact o = oblique_impact(sphere(0.092, 0.87, 900, 900), approach_at_speed(3.9, angle, 77));
    const double I = 2.0 / 5.0 * mass * radius * radius;
    const double before = mass * radius * o.in.tangential_velocity + I * o.in.spin;
    EXPECT_NEAR(mass * radius * o.tangential_velocity + I * o.spin, before, 1e-11 * before);
}

TEST_P(ObliqueSweep, WhatTheMotionLosesIsInTheLedger) {
    const ObliqueImpact o = oblique_impact(sphere(0.092, 0.87, 900, 900), approach_at_speed(3.9, angle, 77));
    const auto energy = [](double vn, double vt, double w) {
        return 0.5 * mass * (vn * vn + vt * vt) + 0.5 * (2.0 / 5.0) * mass * radius * radius * w * w;
    };
    const double before = energy(o.in.normal_speed, o.in.tangential_velocity, o.in.spin);
    const double after = energy(o.normal_speed, o.tangential_velocity, o.spin);
    EXPECT_NEAR(1 - after / before, o.dissipated + o.energy.unpaid(), 1e-10);
    EXPECT_GT(o.dissipated, 0);
    EXPECT_LT(o.residual, 1e-10);
}

TEST_P(ObliqueSweep, MirroringTheApproachMirrorsTheRebound) {
    const ObliqueSphere s = sphere(0.092, 0.87, 900, 900);
    const Approach in = approach_at_speed(3.9, angle, 130);
    const ObliqueImpact a = oblique_impact(s, in);
    const ObliqueImpact b = oblique_impact(s, {in.normal_speed, -in.tangential_velocity, -in.spin});
    EXPECT_NEAR(a.tangential_velocity, -b.tangential_velocity, 1e-11);
    EXPECT_NEAR(a.spin, -b.spin, 1e-7);
    EXPECT_NEAR(a.rebound_angle(), -b.rebound_angle(), 1e-10);
    EXPECT_NEAR(a.normal_speed, b.normal_speed, 1e-11);
}

// Without gravity the contact knows only the velocity of its point.
TEST_P(ObliqueSweep, SpinAndTranslationOfTheSameContactVelocityAreTheSameToTheContact) {
    const ObliqueSphere s = sphere(0.092, 0.87, 900, 900);
    const Approach in = approach_at_speed(3.9, angle);
    const ObliqueImpact moved = oblique_impact(s, in);
    const ObliqueImpact spun = oblique_impact(s, {in.normal_speed, 0, -in.tangential_velocity / radius});
    EXPECT_NEAR(moved.contact_velocity(), spun.contact_velocity(), 1e-10);
    EXPECT_NEAR(moved.impulse_ratio, spun.impulse_ratio, 1e-10);
    EXPECT_NEAR(moved.contact_restitution(), spun.contact_restitution(), 1e-9);
}

TEST_P(ObliqueSweep, ThePhasesFillTheImpact) {
    const ObliqueImpact o = oblique_impact(sphere(0.092, 0.87, 900, 900), approach_at_speed(3.9, angle));
    ASSERT_FALSE(o.history.empty());
    double time = 0;
    for (std::size_t i = 0; i < o.history.size(); ++i) {
        EXPECT_NEAR(o.history[i].start, time, 1e-15);
        EXPECT_GT(o.history[i].duration, 0);
        if (i > 0) {
            EXPECT_NE(o.history[i].phase, o.history[i - 1].phase);
        }
        time += o.history[i].duration;
    }
    EXPECT_EQ(o.history.back().phase, Phase::recovering);  // with damping the force ends before the indentation does
    EXPECT_NEAR(o.time_in(Phase::slip) + o.time_in(Phase::stick), o.duration, 1e-15);
}

// The map psi_2(psi_1) ------------------------------------------------------------------------------------------------

/// psi_2 of the elastic, undamped law by a leapfrog: K_n = m = V_n = 1, V scaled by 7/2 of a solid sphere. It shares
/// nothing with the library but the formula of the paper: F = -K_t sqrt(z) u within the cone, u set back on its edge.
double leapfrog_psi2(double psi1, double kappa) {
    constexpr double mu = 0.3, dt = 2e-5;
    double z = 0, rate = 1, V = psi1 * mu, u = 0;
    for (;;) {
        const double half = rate - 0.5 * dt * std::pow(z, 1.5);
        z += dt * half;
        if (z <= 0) return V / mu;
        const double F_n = std::pow(z, 1.5), stiffness = 1.5 * kappa * std::sqrt(z);
        rate = half - 0.5 * dt * F_n;
        u += V * dt;
        double F = -stiffness * u;
        if (std::abs(F) > mu * F_n) {
            F = std::copysign(mu * F_n, F);
            u = -F / stiffness;
        }
        V += 3.5 * F * dt;
    }
}

TEST(MawMap, IsThatOfAnIndependentIntegration) {
    for (const double kappa : {1.0, 0.8235}) {
        for (const double psi1 : {0.3, 1.0, 1.7, 2.4, 3.5, 5.0, 6.5, 9.0}) {
            const ObliqueImpact o = oblique_impact(sphere(0.3, kappa), approach_of_psi1(psi1, 0.3, 2));
            EXPECT_NEAR(o.contact_velocity() / (0.3 * 2), leapfrog_psi2(psi1, kappa), 1e-3) << psi1 << ' ' << kappa;
        }
    }
}

TEST(MawMap, DoesNotDependOnSizeSpeedOrStiffness) {
    for (const double psi1 : {0.5, 2.0, 4.0, 5.5}) {
        const double reference =
            oblique_impact(sphere(0.3, 0.82), approach_of_psi1(psi1, 0.3, 2)).contact_velocity() / (0.3 * 2);
        ObliqueSphere s = sphere(0.05, 0.82);
        s.mass = 12;
        s.radius = 0.4;
        const double K = 3e6;
        s.contact = {AzadFeatherstoneNormal<>{K, 0}, AzadFeatherstoneFriction<>{{1.5 * 0.82 * K, 0, 0.05, 0}}};
        const double v = 0.03;
        EXPECT_NEAR(oblique_impact(s, approach_of_psi1(psi1, 0.05, v)).contact_velocity() / (0.05 * v), reference,
                    1e-8);
    }
}

// At touchdown u = V t and z = V_n t, so that the spring is inside the cone while K_t V < mu K_n V_n.
TEST(MawMap, ItSticksFromTouchdownBelowTwoThirdsOfOneOverKappa) {
    for (const double kappa : {1.0, 0.7}) {
        const double limit = 2 / (3 * kappa);
        const auto first = [&](double psi1) {
            return oblique_impact(sphere(0.3, kappa), approach_of_psi1(psi1, 0.3, 2)).history.front().phase;
        };
        EXPECT_EQ(first(0.98 * limit), Phase::stick);
        EXPECT_EQ(first(1.02 * limit), Phase::slip);
    }
}

TEST(MawMap, SlipsSticksAndSlipsAgainInBetween) {
    const auto phases = [](double psi1) {
        std::vector<Phase> list;
        for (const ObliquePhase& p : oblique_impact(sphere(0.3), approach_of_psi1(psi1, 0.3, 2)).history)
            list.push_back(p.phase);
        return list;
    };
    EXPECT_EQ(phases(3), (std::vector{Phase::slip, Phase::stick, Phase::slip}));
    EXPECT_EQ(phases(8), (std::vector{Phase::slip}));
}

TEST(MawMap, InTheirVariablesSlidingIsShiftedByFourChi) {
    const double nu = 0.3, chi = (1 - nu) * (1 + 5.0 / 2.0) / (2 - nu);  // Maw, Barber & Fawcett 1976; K^2 = 2/5
    const std::vector<ObliqueImpact> impacts{oblique_impact(sphere(0.3), approach_of_psi1(10, 0.3, 2))};
    const Table table = oblique_table(impacts, 0.3, nu);
    EXPECT_NEAR(column(table, "psi1")[0], 10, 1e-12);
    EXPECT_NEAR(column(table, "psi2")[0], 3, 1e-8);
    EXPECT_NEAR(column(table, "psi2_maw")[0], column(table, "psi1_maw")[0] - 4 * chi, 1e-8);
}

TEST(MawMap, NeedsACoefficientAndForTheirVariablesPoissonsRatio) {
    const std::vector<ObliqueImpact> impacts{oblique_impact(sphere(0.3), approach_of_psi1(1, 0.3, 2))};
    EXPECT_FALSE(has_column(oblique_table(impacts, std::nullopt, 0.3), "psi1"));
    EXPECT_TRUE(has_column(oblique_table(impacts, 0.3, std::nullopt), "psi2"));
    EXPECT_FALSE(has_column(oblique_table(impacts, 0.3, std::nullopt), "psi2_maw"));
    EXPECT_EQ(friction_coefficient(AzadFeatherstoneFriction<>{{1, 1, 0.25, 0}}), 0.25);
    EXPECT_EQ(friction_coefficient(NoFriction<>{}), std::nullopt);
}

TEST(MindlinRatio, IsOneWithoutPoissonEffectAndTwoThirdsWhereNothingIsCompressed) {
    EXPECT_EQ(mindlin_ratio(0), 1);
    EXPECT_DOUBLE_EQ(mindlin_ratio(0.5), 2.0 / 3.0);
    expect_message([] { (void)mindlin_ratio(0.6); }, "Poisson");
}

// Gravity -------------------------------------------------------------------------------------------------------------

TEST(ObliqueImpact, GravityThatHoldsTheSphereLeavesNoRebound) {
    ObliqueSphere s;
    s.mass = 0.154;
    s.radius = 0.0165;
    s.contact = {AzadFeatherstoneNormal<>{8.5e6, 3e5}, AzadFeatherstoneFriction<>{{12.75e6, 3e5, 0.2, 0}}};
    s.gravity = 9.81;
    const ObliqueImpact o = oblique_impact(s, {1e-4, 1e-4, 0});
    EXPECT_TRUE(std::isnan(o.normal_restitution()));
    EXPECT_TRUE(std::isnan(o.rebound_angle()));
    EXPECT_TRUE(std::isnan(o.impulse_ratio));
    s.gravity = 0;
    EXPECT_GT(oblique_impact(s, {1e-4, 1e-4, 0}).normal_restitution(), 0);
}

// Fitting -------------------------------------------------------------------------------------------------------------

TEST(ObliqueFit, FindsTheCoefficientOfTheClosedForm) {
    const double mu = 0.137;
    ObliqueMeasurement measured{"tangential_restitution", {}, {}};
    for (const double angle : {60.0, 65.0, 70.0, 80.0}) {
        measured.approaches.push_back(approach_at_speed(2, angle * degree));
        measured.values.push_back(1 - 2 * mu / std::tan(angle * degree));
    }
    const ObliqueFit fit = fit_oblique(sphere(0.11), measured, std::vector<std::string>{"friction.coefficient"});
    EXPECT_NEAR(fit.result.estimates[0].value, mu, 1e-7);
    EXPECT_NEAR(std::get<AzadFeatherstoneFriction<>>(fit.contact.friction).coefficient, mu, 1e-7);
    EXPECT_NEAR(fit.model[2], measured.values[2], 1e-7);
}

TEST(ObliqueFit, FindsCoefficientAndStiffnessTogether) {
    ObliqueMeasurement measured{"spin_after", {}, {}};
    for (double angle = 5; angle < 60; angle += 5) {
        measured.approaches.push_back(approach_at_speed(3.9, angle * degree));
        measured.values.push_back(oblique_impact(sphere(0.092, 0.83), measured.approaches.back()).spin);
    }
    const ObliqueFit fit =
        fit_oblique(sphere(0.11, 1), measured, std::vector<std::string>{"friction.coefficient", "friction.stiffness"});
    EXPECT_NEAR(fit.result.estimates[0].value, 0.092, 1e-5);
    EXPECT_NEAR(fit.result.estimates[1].value / (1.5 * K_n), 0.83, 1e-4);
}

// Wrong input ---------------------------------------------------------------------------------------------------------

TEST(ObliqueImpact, WrongInputIsRefusedByName) {
    const ObliqueSphere good = sphere(0.1);
    const Approach in{1, 1, 0};
    ObliqueSphere s = good;
    s.mass = 0;
    expect_message([&] { (void)oblique_impact(s, in); }, "mass");
    s = good;
    s.radius = -1;
    expect_message([&] { (void)oblique_impact(s, in); }, "radius");
    s = good;
    s.inertia = 0;
    expect_message([&] { (void)oblique_impact(s, in); }, "inertia");
    s = good;
    s.gravity = -9.81;
    expect_message([&] { (void)oblique_impact(s, in); }, "gravity");
    expect_message([&] { (void)oblique_impact(good, {0, 1, 0}); }, "normal speed");
    expect_message([] { (void)approach_at_speed(1, 90 * degree); }, "below 90");
    expect_message([] { (void)approach_at_normal_speed(1, -0.1); }, "angle of incidence");

    const ObliqueMeasurement measured{"colour", {in}, {1}};
    const std::vector<std::string> key{"friction.coefficient"};
    expect_message([&] { (void)fit_oblique(good, measured, key); }, "spin_after");
    const ObliqueMeasurement spin{"spin_after", {in}, {1}};
    expect_message([&] { (void)fit_oblique(good, spin, std::vector<std::string>{"friction.colour"}); },
                   "friction.stiffness");
    expect_message([&] { (void)fit_oblique(good, spin, std::vector<std::string>{"normal.damping"}); }, "above 0");
}

}  // namespace
}  // namespace footfall::test
