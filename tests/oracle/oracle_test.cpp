// The oracles against each other: what is used to judge the library must first agree with itself.
#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "oracle/arkode_sphere.hpp"
#include "oracle/cvode_sphere.hpp"
#include "oracle/impact.hpp"
#include "oracle/reference.hpp"

namespace {

using oracle::Ball;
using oracle::Quad;
using oracle::Reference;
using oracle::State;
using oracle::TimedRun;

template <class Real>
Reference<Real> paper_reference(int order) {
    oracle::ReferenceOptions<Real> options;
    options.order = order;
    return oracle::reference_run<Real>(oracle::paper_ball().cast<Real>(), oracle::cast<Real>(oracle::paper_start()),
                                       options);
}

const Reference<long double>& reference() {
    static const Reference<long double> run = paper_reference<long double>(26);
    return run;
}

template <class A, class B>
void expect_same(const Reference<A>& a, const Reference<B>& b, double limit) {
    ASSERT_EQ(a.events.size(), b.events.size());
    for (std::size_t i = 0; i < a.events.size(); ++i) {
        EXPECT_EQ(a.events[i].kind, b.events[i].kind) << i;
        EXPECT_LE(static_cast<double>(oracle::magnitude(Quad(a.events[i].time) - Quad(b.events[i].time))), limit) << i;
    }
    for (std::size_t i = 0; i < oracle::dimension; ++i) {
        EXPECT_LE(static_cast<double>(oracle::magnitude(Quad(a.final[i]) - Quad(b.final[i]))),
                  limit * oracle::paper_scale[i])
            << i;
    }
}

// Order and step differ, the precision does not: what is left is rounding.
TEST(TaylorReference, DoesNotDependOnItsOrder) { expect_same(reference(), paper_reference<long double>(34), 1e-16); }

// 113 bits against 64, at another order: the long double run is right to 1e-16.
TEST(TaylorReference, DoesNotDependOnItsPrecision) {
    if (!oracle::has_quad) GTEST_SKIP() << "no wider type than long double";
    expect_same(reference(), paper_reference<Quad>(44), 1e-16);
}

// The energy is not used by the integrator: each channel is an integral of its own.
TEST(TaylorReference, KeepsTheTotalEnergyAtEveryEvent) {
    const Ball<long double> ball = oracle::paper_ball().cast<long double>();
    const long double start = oracle::total_energy(ball, oracle::cast<long double>(oracle::paper_start()));
    for (const auto& event : reference().events) {
        EXPECT_NEAR(static_cast<double>(oracle::total_energy(ball, event.state) / start - 1), 0, 1e-16);
    }
    EXPECT_NEAR(static_cast<double>(oracle::total_energy(ball, reference().final) / start - 1), 0, 1e-16);
}

// The x and y axes are alike, and nothing spins about the vertical.
TEST(TaylorReference, TreatsBothHorizontalAxesAlike) {
    const auto& y = reference().final;
    EXPECT_EQ(y[oracle::cx], y[oracle::cy]);
    EXPECT_EQ(y[oracle::vx], y[oracle::vy]);
    EXPECT_EQ(y[oracle::wx], -y[oracle::wy]);
    EXPECT_EQ(y[oracle::wz], 0);
}

void expect_agreement(const TimedRun& run, double time_limit, double state_limit) {
    ASSERT_EQ(run.events.size(), reference().events.size());
    for (std::size_t i = 0; i < run.events.size(); ++i) {
        EXPECT_EQ(run.events[i].kind, reference().events[i].kind) << i;
        EXPECT_NEAR(run.events[i].time, static_cast<double>(reference().events[i].time), time_limit) << i;
    }
    for (std::size_t i = 0; i < oracle::dimension; ++i) {
        EXPECT_NEAR(run.final[i], static_cast<double>(reference().final[i]), state_limit * oracle::paper_scale[i]) << i;
    }
}

// Measured: event times within 2e-13 s, the final state within 2e-11 of its scale (the tangential damper's channel; the
// motion is within 1e-13).
TEST(Sundials, ArkodeAgreesWithTheTaylorReference) {
    oracle::ArkodeSphere solver(oracle::paper_ball(), 1e-14);
    expect_agreement(solver.run(oracle::paper_start(), 1), 1e-12, 1e-10);
}

// Measured: event times within 9e-13 s, the final state within 2e-10 of its scale (the normal damper's channel; the
// motion is within 1e-13).
TEST(Sundials, CvodeAgreesWithTheTaylorReference) {
    oracle::CvodeSphere solver(oracle::paper_ball(), 1e-14);
    expect_agreement(solver.run(oracle::paper_start(), 1), 1e-11, 1e-9);
}

// The paper's other example and the heavy end of the scale, each in two precisions.
TEST(ImpactOracle, DoesNotDependOnItsPrecision) {
    if (!oracle::has_quad) GTEST_SKIP() << "no wider type than long double";
    struct {
        oracle::ImpactLaw law;
        double stiffness, damping;
    } const cases[] = {{oracle::ImpactLaw::azad_featherstone, 8.5e6, 3.1e3},
                       {oracle::ImpactLaw::azad_featherstone, 8.5e6, 3.1e4},
                       {oracle::ImpactLaw::hunt_crossley, 8.5e6, 3.1e6},
                       {oracle::ImpactLaw::linear, 2.5e5, 60}};
    for (const auto& c : cases) {
        for (double v : {1e-3, 0.1, 10.0}) {
            const auto a = oracle::impact<long double>(c.law, 0.154, c.stiffness, c.damping, v);
            const auto b = oracle::impact<Quad>(c.law, 0.154, c.stiffness, c.damping, v, 44);
            EXPECT_NEAR(static_cast<double>((a.speed_out - static_cast<long double>(b.speed_out)) / v), 0, 1e-15);
            EXPECT_NEAR(static_cast<double>(a.separation / static_cast<long double>(b.separation)), 1, 1e-15);
            EXPECT_NEAR(static_cast<double>(a.peak_force / static_cast<long double>(b.peak_force)), 1, 1e-15);
        }
    }
}

TEST(ImpactOracle, MeetsTheClosedFormOfTheLinearLaw) {
    for (double damping : {0.0, 1.0, 60.0, 277.0, 278.0, 390.0, 400.0, 2000.0}) {  // critical at 392.4
        const auto hit = oracle::impact<long double>(oracle::ImpactLaw::linear, 0.154L, 2.5e5L, damping, 0.5L);
        EXPECT_NEAR(static_cast<double>(hit.speed_out / 0.5L - oracle::linear_restitution(0.154L, 2.5e5L, damping)), 0,
                    1e-17);
    }
}

TEST(ImpactOracle, MeetsTheClosedFormOfHuntAndCrossley) {
    for (double speed : {1e-3, 1e-2, 0.1, 1.0, 10.0}) {
        const auto hit = oracle::impact<long double>(oracle::ImpactLaw::hunt_crossley, 0.154L, 8.5e6L, 3.1e6L, speed);
        EXPECT_NEAR(
            static_cast<double>(hit.speed_out / speed - oracle::hunt_crossley_restitution(8.5e6L, 3.1e6L, speed)), 0,
            1e-15);
    }
}

// The next term is of the order of the first squared: here a few times 1e-4 of the first.
TEST(ImpactOracle, MeetsTheViscoelasticLimitOfSlowImpacts) {
    const long double m = 0.154L, K = 8.5e6L, D = 3.1e3L, v = 1e-20L;
    const auto hit = oracle::impact<long double>(oracle::ImpactLaw::azad_featherstone, m, K, D, v);
    const long double small = D / K * std::pow(K / m, 0.4L) * std::pow(v, 0.2L);
    EXPECT_NEAR(static_cast<double>((1 - hit.speed_out / v) / small / oracle::viscoelastic_slope()), 1, 1e-4);
}

// Hertz without damping: depth (5 m v^2 / 4 K)^(2/5), contact time 2.9432... z/v.
TEST(ImpactOracle, IsHertzWithoutDamping) {
    const long double m = 0.154L, K = 8.5e6L, v = 0.3L;
    const auto hit = oracle::impact<long double>(oracle::ImpactLaw::azad_featherstone, m, K, 0, v);
    const long double depth = std::pow(5 * m * v * v / (4 * K), 0.4L);
    EXPECT_NEAR(static_cast<double>(hit.speed_out / v), 1, 1e-16);
    EXPECT_NEAR(static_cast<double>(hit.peak_depth / depth), 1, 1e-16);
    EXPECT_NEAR(static_cast<double>(hit.peak_force / (K * std::pow(depth, 1.5L))), 1, 1e-16);
    const long double pi = std::acos(-1.0L);
    const long double period = 0.8L * std::sqrt(pi) * std::tgamma(0.4L) / std::tgamma(0.9L);  // 2.9432...
    EXPECT_NEAR(static_cast<double>(hit.recovered * v / depth / period), 1, 1e-15);
}

}  // namespace
