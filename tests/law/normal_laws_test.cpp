// The normal laws of the literature: values by hand, and which of them are which.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "footfall/law/registry.hpp"
#include "footfall/math/dual.hpp"
#include "law/laws.hpp"
#include "math/property.hpp"

namespace footfall {
namespace {

using namespace test;

/// The same force and the same energy, to rounding.
template <class A, class B>
bool same(const A& a, const B& b, const ContactState& at) {
    const auto f = a.force(at.s(), at.rate), g = b.force(at.s(), at.rate);
    const double energy = b.stored_energy(at.s());
    return near(f.elastic, g.elastic, 1e-13 * g.elastic) &&
           near(f.dissipative, g.dissipative, 1e-13 * std::abs(g.dissipative)) &&
           near(a.stored_energy(at.s()), energy, 1e-13 * energy);
}

RC_GTEST_PROP(KuwabaraKonoNormal, IsThePapersLawWithThreeHalvesOfTheirParameter, ()) {
    const double K_n = *decades(1, 1e8), A = *decades(1e-7, 1e-2);
    const ContactState at;
    RC_ASSERT(same(KuwabaraKonoNormal<>{K_n, A}, AzadFeatherstoneNormal<>{K_n, 1.5 * A * K_n}, at));
}

RC_GTEST_PROP(KuwabaraKonoNormal, DampsByTheirParameterTimesTheRateOfTheElasticForce, ()) {
    // Brilliantov et al. 1996: f = f_el + A d(f_el)/dt.
    const double K_n = *decades(1, 1e8), A = *decades(1e-7, 1e-2);
    const ContactState at;
    const KuwabaraKonoNormal<> law{K_n, A};
    using D = Dual<double, 1>;
    const D elastic = K_n * pow(D(at.depth, {at.rate}), 1.5);
    const double damper = A * elastic.gradient[0];
    RC_ASSERT(near(law.force(at.s(), at.rate).dissipative, damper, 1e-12 * std::abs(damper)));
}

RC_GTEST_PROP(HertzNormal, IsThePapersLawWithoutDamping, ()) {
    const double K_n = *decades(1, 1e8);
    const ContactState at;
    RC_ASSERT(same(HertzNormal<>{K_n}, AzadFeatherstoneNormal<>{K_n, 0}, at));
}

RC_GTEST_PROP(MarhefkaOrinNormal, IsHuntAndCrossleysWithThreeHalvesOfAlphaK, ()) {
    const double k = *decades(1, 1e8), alpha = *decades(1e-3, 10), n = coin() ? 1.5 : *uniform(0.5, 3);
    const ContactState at;
    RC_ASSERT(same(MarhefkaOrinNormal<>{k, alpha, n}, HuntCrossleyNormal<>{k, 1.5 * alpha * k, n, n, 1}, at));
}

RC_GTEST_PROP(FalconNormal, IsThePapersLawForTheSquareRootAndHuntAndCrossleysForThreeHalves, ()) {
    const double K_n = *decades(1, 1e8), D = *decades(1, 1e8);
    const ContactState at;
    RC_ASSERT(same(FalconNormal<>{K_n, D, 0.5}, AzadFeatherstoneNormal<>{K_n, D}, at));
    RC_ASSERT(same(FalconNormal<>{K_n, D, 1.5}, HuntCrossleyNormal<>{K_n, D}, at));
}

RC_GTEST_PROP(TsujiNormal, IsFalconsLawForAQuarterOfAPower, ()) {
    const TsujiNormal<> law{*decades(1, 1e8), *decades(1e-3, 1e3), *uniform(0.05, 0.99)};
    const ContactState at;
    RC_ASSERT(same(law, FalconNormal<>{law.stiffness, law.damping(), 0.25}, at));
}

TEST(HertzNormal, GivesTheForceComputedByHand) {
    EXPECT_NEAR(HertzNormal<>{8.5e6}.force(0.01, 0.5).elastic, 8.5, 1e-14);
    EXPECT_EQ(HertzNormal<>{8.5e6}.force(0.01, 0.5).dissipative, 0);
}

TEST(KuwabaraKonoNormal, GivesTheForceComputedByHand) {
    // K_n = 2e6, A = 0.1 ms, z = 0.1 mm, zdot = 0.5 m/s: 2e6 * 1e-6 and 1.5 * 1e-4 * 2e6 * 1e-2 * 0.5.
    const KuwabaraKonoNormal<> law{2e6, 1e-4};
    EXPECT_NEAR(law.force(0.01, 0.5).elastic, 2, 1e-14);
    EXPECT_NEAR(law.force(0.01, 0.5).dissipative, 1.5, 1e-14);
}

TEST(MarhefkaOrinNormal, GivesTheForceComputedByHand) {
    // k = 2e6, alpha = 0.2 s/m, z = 1e-4 m, zdot = -0.5 m/s: 2 N and 1.5 * 0.2 * 2 * (-0.5).
    const MarhefkaOrinNormal<> law{2e6, 0.2};
    EXPECT_NEAR(law.force(0.01, -0.5).elastic, 2, 1e-14);
    EXPECT_NEAR(law.force(0.01, -0.5).dissipative, -0.3, 1e-14);
}

TEST(FalconNormal, GivesTheForceComputedByHand) {
    // K_n = 2e6, D = 30, z = 1e-4 m, zdot = 0.5 m/s: 2 N and 30 * 0.1 * 0.5 for the quarter, 30 * 0.5 for no power.
    EXPECT_NEAR((FalconNormal<>{2e6, 30}.force(0.01, 0.5).elastic), 2, 1e-14);
    EXPECT_NEAR((FalconNormal<>{2e6, 30}.force(0.01, 0.5).dissipative), 1.5, 1e-14);
    EXPECT_NEAR((FalconNormal<>{2e6, 30, 0}.force(0.01, 0.5).dissipative), 15, 1e-14);
}

TEST(LankaraniNikraveshNormal, GivesTheForceComputedByHand) {
    // K = 2e6, e = 0.6, z = 1e-4 m, zdot = 0.5 m/s in an impact at 4 m/s: 2 N, and 2 * 0.75 * 0.64 * 0.5 / 4.
    LankaraniNikraveshNormal<> law{2e6, 0.6};
    law.begin_impact(4.0);
    EXPECT_NEAR(law.force(0.01, 0.5).elastic, 2, 1e-14);
    EXPECT_NEAR(law.force(0.01, 0.5).dissipative, 0.12, 1e-14);
    EXPECT_NEAR((LankaraniNikraveshNormal<>{2e6, 1}.force(0.01, 0.5).dissipative), 0, 0);
}

TEST(FloresNormal, GivesTheForceComputedByHand) {
    // K = 2e6, e = 0.8, z = 1e-4 m, zdot = 0.5 m/s in an impact at 4 m/s: 2 N, and 2 * 1.6 * 0.25 * 0.5 / 4.
    FloresNormal<> law{2e6, 0.8};
    law.begin_impact(4.0);
    EXPECT_NEAR(law.force(0.01, 0.5).elastic, 2, 1e-14);
    EXPECT_NEAR(law.force(0.01, 0.5).dissipative, 0.1, 1e-14);
    // n = 1: K z and the same factor.
    FloresNormal<> linear{2e6, 0.8, 1};
    linear.begin_impact(4.0);
    EXPECT_NEAR(linear.force(0.01, 0.5).elastic, 200, 1e-11);
    EXPECT_NEAR(linear.force(0.01, 0.5).dissipative, 10, 1e-12);
}

template <class Law>
class ImpactSpeedTest : public ::testing::Test {};
using ImpactSpeedLaws = ::testing::Types<LankaraniNikraveshNormal<>, FloresNormal<>>;
TYPED_TEST_SUITE(ImpactSpeedTest, ImpactSpeedLaws, LawNames);

TYPED_TEST(ImpactSpeedTest, DampingIsInverselyProportionalToTheSpeedOfTheImpact) {
    TypeParam law{2e6, 0.7};
    law.begin_impact(0.5);
    const double slow = law.force(0.01, 0.3).dissipative;
    law.begin_impact(2.0);
    EXPECT_NEAR(law.force(0.01, 0.3).dissipative, slow / 4, 1e-14);
    EXPECT_EQ(law.template cast<long double>().impact_speed, 2.0L);
}

TYPED_TEST(ImpactSpeedTest, ImpactsBelowTheSlowestAreDampedLikeIt) {
    TypeParam law{2e6, 0.7};
    law.slowest_impact = 0.02;
    law.begin_impact(0.02);
    const double bound = law.force(0.01, 0.3).dissipative;
    EXPECT_GT(bound, 0);
    EXPECT_EQ((TypeParam{2e6, 0.7, 1.5, 0.02}.force(0.01, 0.3).dissipative), bound);  // before any impact
    for (const double speed : {0.0, 1e-9, 0.0199, -3.0}) {
        law.begin_impact(speed);
        EXPECT_EQ(law.force(0.01, 0.3).dissipative, bound) << speed;
    }
    law.begin_impact(0.04);
    EXPECT_NEAR(law.force(0.01, 0.3).dissipative, bound / 2, 1e-15);
}

/// Restitution under m zdd = -k z^(3/2) - c z^(1/4) zdot at unit mass, stiffness and speed, from z = 0 to zero force:
/// the classical Runge-Kutta method in y = z^(5/4), with a time dtau = (5/4) z^(1/4) dt in which the equations are
/// smooth. (In tests/simulate the force itself is integrated.)
double restitution_by_integration(double c) {
    // dy/dtau = v, dv/dtau = -(4/5) (c v + y).
    const auto rate = [&](const std::array<double, 2>& x) {
        return std::array<double, 2>{x[1], -0.8 * (c * x[1] + x[0])};
    };
    const auto along = [](const std::array<double, 2>& x, const std::array<double, 2>& k, double h) {
        return std::array<double, 2>{x[0] + h * k[0], x[1] + h * k[1]};
    };
    std::array<double, 2> x{0, 1};
    double h = 1e-3 / (1 + c);
    // The force is c v + y; where it has fallen through zero the step is cut to end on it.
    while (h > 1e-13) {
        const auto k1 = rate(x), k2 = rate(along(x, k1, h / 2)), k3 = rate(along(x, k2, h / 2)),
                   k4 = rate(along(x, k3, h));
        std::array<double, 2> next{};
        for (std::size_t i = 0; i < 2; ++i) next[i] = x[i] + h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
        if (c * next[1] + next[0] < 0) {
            h /= 2;
        } else {
            x = next;
        }
    }
    return -x[1];
}

TEST(TsujiNormal, DampingGivesTheRestitutionAskedForInAnIntegration) {
    // Less and more than critical, which is alpha = sqrt(5), e = exp(-2) = 0.135, and on both sides of e = exp(-4).
    for (const double e : {0.99, 0.9, 0.7, 0.5, 0.3, 0.14, 0.13, 0.05, 0.019, 0.018, 0.01}) {
        EXPECT_NEAR(restitution_by_integration(TsujiNormal<>{1, 1, e}.alpha()), e, 1e-11) << e;
    }
    EXPECT_NEAR((TsujiNormal<>{1, 1, std::exp(-2.0)}.alpha()), std::sqrt(5.0), 1e-14);
    EXPECT_EQ((TsujiNormal<>{1, 1, 1}.alpha()), 0);
}

TEST(TsujiNormal, WeakDampingIsThatOfTheContactThatEndsAtZeroDepth) {
    // Antypov & Elliott 2011: alpha = -sqrt(5) ln e / sqrt(ln^2 e + pi^2). What the clamp changes is of second order.
    const double pi = std::acos(-1.0);
    for (const double e : {0.9999, 0.999, 0.99}) {
        const double L = std::log(e), unclamped = -std::sqrt(5.0) * L / std::hypot(L, pi);
        EXPECT_NEAR((TsujiNormal<>{1, 1, e}.alpha()) / unclamped, 1, 1.1 * (1 - e)) << e;
        EXPECT_GT((TsujiNormal<>{1, 1, e}.alpha()), unclamped);
    }
}

RC_GTEST_PROP(TsujiNormal, LessRestitutionIsMoreDamping, ()) {
    const double e = *uniform(1e-3, 1), less = e * *uniform(0.5, 0.9999);
    RC_ASSERT((TsujiNormal<>{1, 1, less}.alpha() > TsujiNormal<>{1, 1, e}.alpha()));
}

RC_GTEST_PROP(TsujiNormal, ItsDampingHasTheSlopeOfDifferencesInItsRestitution, ()) {
    const double e = *uniform(0.01, 0.98);
    using D = Dual<double, 1>;
    const D alpha = TsujiNormal<D>{D(1), D(1), D::variable(e, 0)}.alpha();
    const auto slope = static_cast<double>(difference(
        [](long double x) {
            return TsujiNormal<long double>{1, 1, x}.alpha();
        },
        e));
    RC_ASSERT(near(alpha.gradient[0], slope, 1e-9 * std::abs(slope)));
}

TEST(TsujiNormal, PreparingItChangesNothing) {
    TsujiNormal<> law{2e6, 0.2, 0.6};
    const double before = law.force(0.01, 0.5).dissipative;
    law.prepare();
    EXPECT_EQ(law.force(0.01, 0.5).dissipative, before);
    // alpha sqrt(m k) z^(1/4) zdot with sqrt(m k) = sqrt(4e5), z^(1/4) = 0.1.
    EXPECT_NEAR(before, law.alpha() * std::sqrt(4e5) * 0.1 * 0.5, 1e-13);
}

/// A number that counts the logarithms taken of it: the damping needs one, and nothing else in the law does.
struct Counted : Dual<double, 1> {
    using Dual<double, 1>::Dual;
    Counted(const Dual<double, 1>& x) : Dual<double, 1>(x) {}
    inline static int logarithms = 0;
    friend Counted log(const Counted& x) {
        ++logarithms;
        return Counted(log(static_cast<const Dual<double, 1>&>(x)));
    }
};

TEST(TsujiNormal, ItsDampingIsComputedOnceHoweverOftenItIsCast) {
    const Pair<NormalLawOver<Counted>, NoFriction<Counted>> law(
        TsujiNormal<Counted>{Counted(2e6), Counted(0.2), Counted(0.6)}, {});
    const Touch<Counted> touch{Counted(0.01), Counted(0.5), Vector2<Counted>::Zero()};
    EXPECT_EQ(Counted::logarithms, 1);
    for (int use = 0; use < 5; ++use) {
        const auto cast = law.cast<Counted>();
        EXPECT_GT(cast.normal_parts(touch, {}).dissipative.value, 0);
        EXPECT_GT(law.load_at(touch, {}).over_scale.value, 0);
    }
    EXPECT_EQ(Counted::logarithms, 1);
}

TEST(TsujiNormal, ItsPreparedForceHasTheSlopesOfDifferencesInItsParameters) {
    using D = Dual<double, 3>;
    const D k = D::variable(2e6, 0), m = D::variable(0.2, 1), e = D::variable(0.6, 2);
    const Pair<NormalLawOver<D>, NoFriction<D>> law(TsujiNormal<D>{k, m, e}, {});
    // Over duals of duals, as a Jacobian inside of a derivative is: the slopes are carried along.
    const Touch<Dual<D, 1>> touch{D(0.01), D(0.5), Vector2<Dual<D, 1>>::Zero()};
    const D force = law.cast<Dual<D, 1>>().normal_parts(touch, {}).dissipative.value;
    const auto slope = [&](int parameter) {
        return static_cast<double>(difference(
            [&](long double x) {
                TsujiNormal<long double> at{2e6L, 0.2L, 0.6L};
                (parameter == 0 ? at.stiffness : parameter == 1 ? at.mass : at.restitution) = x;
                return at.force(0.01L, 0.5L).dissipative;
            },
            parameter == 0   ? 2e6L
            : parameter == 1 ? 0.2L
                             : 0.6L));
    };
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(force.gradient[static_cast<std::size_t>(i)], slope(i), 1e-9 * std::abs(slope(i))) << i;
}

}  // namespace
}  // namespace footfall
