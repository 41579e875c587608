// What every normal law owes the ledger, and what each is known to give.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <gtest/gtest.h>

#include "footfall/law/registry.hpp"
#include "footfall/math/dual.hpp"
#include "law/laws.hpp"
#include "math/property.hpp"

namespace footfall {
namespace {

using namespace test;

template <class Law>
class NormalLawTest : public ::testing::Test {};
TYPED_TEST_SUITE(NormalLawTest, NormalLaws, LawNames);

/// Powers in long double, so that differences keep their digits.
template <class Law>
long double stored_at_depth(const Law& law, long double z) {
    return law.template cast<long double>().stored_energy(std::sqrt(z));
}

TYPED_TEST(NormalLawTest, ElasticForceIsTheSlopeOfTheStoredEnergy) {
    check_property([] {
        const auto law = random_landed_law<TypeParam>();
        const ContactState at;
        const double elastic = law.force(at.s(), at.rate).elastic;

        const double slope =
            static_cast<double>(difference([&](long double z) { return stored_at_depth(law, z); }, at.depth));
        RC_ASSERT(near(elastic, slope, 1e-9 * elastic));

        // The same with dual numbers, all the way from z.
        using D = Dual<double, 1>;
        const D energy = law.template cast<D>().stored_energy(sqrt(D::variable(at.depth, 0)));
        RC_ASSERT(near(elastic, energy.gradient[0], 1e-12 * elastic));
    });
}

TYPED_TEST(NormalLawTest, StoredEnergyIsZeroAtTouchdownAndGrowsWithDepth) {
    check_property([] {
        const auto law = random_landed_law<TypeParam>();
        const double s = *decades(1e-4, 0.1);
        RC_ASSERT(law.stored_energy(0.0) == 0);
        RC_ASSERT(law.stored_energy(s) > 0);
        RC_ASSERT(law.stored_energy(1.01 * s) > law.stored_energy(s));
    });
}

TYPED_TEST(NormalLawTest, DamperTakesEnergyInBothDirections) {
    check_property([] {
        const auto law = random_landed_law<TypeParam>();
        const ContactState at;
        const double power = law.force(at.s(), at.rate).dissipative * at.rate;
        RC_ASSERT((is_elastic(law.law) ? power == 0 : power > 0));
        RC_ASSERT(law.force(at.s(), 0.0).dissipative == 0);
    });
}

TYPED_TEST(NormalLawTest, ElasticPartDoesNotSeeTheRate) {
    check_property([] {
        const auto law = random_landed_law<TypeParam>();
        const ContactState at;
        RC_ASSERT(law.force(at.s(), at.rate).elastic == law.force(at.s(), -3 * at.rate).elastic);
    });
}

TYPED_TEST(NormalLawTest, AnErasedPairIsTheLawItHolds) {
    check_property([] {
        Landed<TypeParam> law{random_law<TypeParam>()};
        const Pair<NormalLaw, NoFriction<>> any(law.law, {});
        const ContactState at;
        const Touch<double> touch{at.s(), at.rate, Vector2<double>::Zero()};
        // An impact that begins is told to the law inside.
        const double speed = *decades(1e-2, 1e1);
        std::array<double, most_normal_states> states{};
        any.land({0, speed, Vector2<double>::Zero()}, std::span(states));
        NormalPart<TypeParam>{law.law}.land(speed, law.x);
        RC_ASSERT(any.normal_parts(touch, states).elastic == law.force(at.s(), at.rate).elastic);
        RC_ASSERT(any.normal_parts(touch, states).dissipative == law.force(at.s(), at.rate).dissipative);
        RC_ASSERT(any.held({Phase::slip}, touch, states).normal_spring == law.stored_energy(at.s()));
        std::array<double, 3> guards{};
        any.fill_guards({Phase::slip}, touch, states, 0.0, guards);
        RC_ASSERT(guards[0] == law.load(at.s(), at.rate));
        // The law inside a pair that is cast is the law cast.
        const auto cast = any.template cast<long double>();
        std::array<long double, most_normal_states> long_states{};
        std::copy(states.begin(), states.end(), long_states.begin());
        const Touch<long double> long_touch{at.s(), at.rate, Vector2<long double>::Zero()};
        RC_ASSERT(near(static_cast<double>(cast.normal_parts(long_touch, long_states).dissipative),
                       law.force(at.s(), at.rate).dissipative,
                       1e-13 * std::abs(law.force(at.s(), at.rate).dissipative)));
    });
}

TYPED_TEST(NormalLawTest, TheLawOfAnImpactComputesItsForce) {
    if constexpr (NormalPart<TypeParam>::moving_states() == 0) {  // else its force is not of depth and rate alone
        check_property([] {
            auto law = random_law<TypeParam>();
            const ContactState at;
            const double speed = *decades(1e-2, 1e1);
            const auto computed = law_of_impact(law, speed);
            if constexpr (requires { law.begin_impact(speed); }) law.begin_impact(speed);
            RC_ASSERT(computed.force(at.s(), at.rate).elastic == law.force(at.s(), at.rate).elastic);
            RC_ASSERT(computed.force(at.s(), at.rate).dissipative == law.force(at.s(), at.rate).dissipative);
        });
    }
}

// A law may be told of an impact by a member of its own, and by the states that it declares.
TYPED_TEST(NormalLawTest, IsTheSameInTheStatesOfAnImpactAsWhereItKeepsThatItself) {
    if constexpr (requires(TypeParam law) { law.begin_impact(1.0); }) {
        check_property([] {
            auto law = random_law<TypeParam>();
            const ContactState at;
            const double speed = *decades(1e-2, 1e1);
            Landed<TypeParam> landed{law};
            NormalPart<TypeParam>{law}.land(speed, landed.x);
            law.begin_impact(speed);
            RC_ASSERT(landed.force(at.s(), at.rate).total() == law.force(at.s(), at.rate).total());
            RC_ASSERT(landed.load(at.s(), at.rate) == law.load(at.s(), at.rate));
        });
    }
}

// What its states take out of what is stored is what the depth has put in beyond the growth, whatever the states
// are.
TYPED_TEST(NormalLawTest, TheLedgerClosesWhereItsStatesMove) {
    if constexpr (NormalPart<TypeParam>::moving_states() > 0) {
        check_property([] {
            const auto landed = random_landed_law<TypeParam>();
            const NormalPart<TypeParam> part{landed.law};
            const ContactState at;
            const double s = at.s();
            auto x = landed.x, rates = x;
            for (std::size_t k = 0; k < x.size(); ++k) x[k] = *uniform(-2, 2) * part.state_size(static_cast<int>(k), s);
            part.rates(s, at.rate, x, rates);
            using D = Dual<double, 1>;
            const auto over = landed.law.template cast<D>();
            std::array<D, Landed<TypeParam>::states> moving;
            for (std::size_t k = 0; k < x.size(); ++k) moving[k] = D(x[k], {rates[k]});
            const D root = sqrt(D(at.depth, {at.rate}));
            const double growth = NormalPart<decltype(over)>{over}.stored_energy(root, moving).gradient[0];
            const auto f = part.force(0, s, at.rate, x);
            const double size = std::abs(f.elastic * at.rate) + std::abs(f.relaxation);
            RC_ASSERT(near(growth, f.elastic * at.rate - f.relaxation, 1e-11 * size));
            RC_ASSERT(part.stored_energy(s, x) >= 0);
            RC_ASSERT(f.dissipative * at.rate + f.relaxation >= -1e-12 * size);
            const auto scaled = part.force(1, s, at.rate, x);
            RC_ASSERT(near(scaled.total() * s, f.total(), 1e-13 * (std::abs(f.elastic) + std::abs(f.dissipative))));
            RC_ASSERT(near(scaled.relaxation * s, f.relaxation, 1e-13 * std::abs(f.relaxation)));
        });
    }
}

TYPED_TEST(NormalLawTest, IsFiniteAndContinuousALittlePastTheEndOfContact) {
    // An event locator looks there: whatever is not zero at the end shrinks on the way to it, however slowly.
    check_property([] {
        const auto law = random_landed_law<TypeParam>();
        const double rate = (coin() ? 1 : -1) * *decades(1e-4, 1e1);
        const auto load_jump = [&](double s) { return std::abs(law.load(s, rate) - law.load(-s, rate)); };
        const auto force_jump = [&](double s) {
            const auto f = law.force(s, rate), g = law.force(-s, rate);
            return std::abs(f.elastic - g.elastic) + std::abs(f.dissipative - g.dissipative);
        };
        RC_ASSERT(std::isfinite(load_jump(1e-3)));
        RC_ASSERT(std::isfinite(force_jump(1e-3)));
        RC_ASSERT(std::isfinite(law.stored_energy(-1e-3)));
        RC_ASSERT((load_jump(1e-300) < load_jump(1e-3) || load_jump(1e-300) == 0));
        RC_ASSERT((force_jump(1e-300) < force_jump(1e-3) || force_jump(1e-300) == 0));
    });
}

TYPED_TEST(NormalLawTest, ScaledForceTimesItsScaleIsTheForce) {
    check_property([] {
        const auto law = random_landed_law<TypeParam>();
        const ContactState at;
        const auto force = law.force(at.s(), at.rate), scaled = law.template force<1>(at.s(), at.rate);
        RC_ASSERT(near(scaled.elastic * at.s(), force.elastic, 1e-13 * force.elastic));
        RC_ASSERT(near(scaled.dissipative * at.s(), force.dissipative, 1e-13 * std::abs(force.dissipative)));
    });
}

TYPED_TEST(NormalLawTest, LoadHasTheSignOfTheForce) {
    check_property([] {
        const auto law = random_landed_law<TypeParam>();
        const ContactState at;
        const auto f = law.force(at.s(), at.rate);
        // Where the parts nearly cancel, rounding decides the sign of either.
        RC_PRE(std::abs(f.total()) > 1e-12 * f.elastic);
        RC_ASSERT((law.load(at.s(), at.rate) > 0) == (f.total() > 0));
    });
}

TYPED_TEST(NormalLawTest, LoadIsFiniteAtTouchdownAndPositiveOnTheWayIn) {
    check_property([] {
        const auto law = random_landed_law<TypeParam>();
        const double rate = *decades(1e-4, 1e1);
        RC_ASSERT(std::isfinite(law.load(0.0, rate)));
        RC_ASSERT(law.load(0.0, rate) >= 0);
        RC_ASSERT(std::isfinite(law.load(0.0, -rate)));
    });
}

TYPED_TEST(NormalLawTest, DualDerivativesAreThoseOfDifferences) {
    check_property([] {
        const auto law = random_landed_law<TypeParam>();
        const ContactState at;
        using D = Dual<double, 2>;
        const auto f = law.template cast<D>().force(D::variable(at.s(), 0), D::variable(at.rate, 1)).total();
        const auto exact = law.template cast<long double>();
        const long double s = at.s(), rate = at.rate;
        const auto by_s =
            static_cast<double>(difference([&](long double x) { return exact.force(x, rate).total(); }, s));
        const auto by_rate =
            static_cast<double>(difference([&](long double v) { return exact.force(s, v).total(); }, rate));
        const auto parts = law.force(at.s(), at.rate);
        const double size = parts.elastic + std::abs(parts.dissipative);
        RC_ASSERT(near(f.value, parts.total(), 1e-12 * size));
        RC_ASSERT(near(f.gradient[0], by_s, 1e-8 * size / at.s()));
        RC_ASSERT(near(f.gradient[1], by_rate, 1e-8 * size / std::abs(at.rate)));
    });
}

TEST(AzadFeatherstoneNormal, GivesTheForceComputedByHand) {
    // K_n = 8.5e6, D_n = 3.1e3, z = 0.1 mm, zdot = 0.5 m/s: 8.5e6 * 1e-6 and 3.1e3 * 1e-2 * 0.5.
    const AzadFeatherstoneNormal<> law{8.5e6, 3.1e3};
    EXPECT_NEAR(law.force(0.01, 0.5).elastic, 8.5, 1e-14);
    EXPECT_NEAR(law.force(0.01, 0.5).dissipative, 15.5, 1e-14);
    EXPECT_NEAR(law.force(0.01, -0.5).dissipative, -15.5, 1e-14);
}

TEST(AzadFeatherstoneNormal, StoresTheKineticEnergyOfAHertzianImpactAtItsDeepest) {
    // Johnson, Contact Mechanics, section 11.4: without damping a ball is stopped at delta = (15 m V^2 / (16
    // sqrt(R) E*))^(2/5). A steel ball, R = 1 cm, m = 32.88 g, V = 2 m/s, on steel (E* = 210/1.82 GPa): delta
    // = 40.88 um; m V^2/2 = 65.76 mJ.
    const AzadFeatherstoneNormal<> hertz{4.0 / 3.0 * 210e9 / 1.82 * 0.1, 0};
    EXPECT_NEAR(hertz.stored_energy(std::sqrt(4.088142898993885e-5)), 65.76e-3, 1e-12);
}

TEST(HuntCrossleyNormal, GivesTheForceComputedByHand) {
    // Figure 6: k = 8.5e6, lambda = 3.1e6, z = 0.1 mm, zdot = 0.5 m/s: 8.5e6 * 1e-6 and 3.1e6 * 1e-6 * 0.5.
    const HuntCrossleyNormal<> classical{8.5e6, 3.1e6};
    EXPECT_NEAR(classical.force(0.01, 0.5).elastic, 8.5, 1e-14);
    EXPECT_NEAR(classical.force(0.01, 0.5).dissipative, 1.55, 1e-14);
    // 2 z^2 + 3 z zdot^2 at z = 4, zdot = 1.5; on the way out the damper pulls.
    const HuntCrossleyNormal<> general{2, 3, 2, 1, 2};
    EXPECT_NEAR(general.force(2.0, 1.5).elastic, 32, 1e-13);
    EXPECT_NEAR(general.force(2.0, 1.5).dissipative, 27, 1e-13);
    EXPECT_NEAR(general.force(2.0, -1.5).dissipative, -27, 1e-13);
    EXPECT_NEAR(general.stored_energy(2.0), 2 * 64 / 3.0, 1e-12);
}

RC_GTEST_PROP(HuntCrossleyNormal, GeneralFormReachesTheClassicalOne, ()) {
    // Exponents one rounding away from 3/2 take the general branch.
    const double k = *decades(1, 1e8), lambda = *decades(1, 1e8), off = std::nextafter(1.5, 2);
    const ContactState at;
    const HuntCrossleyNormal<> classical{k, lambda}, general{k, lambda, off, off, 1};
    const auto a = classical.force(at.s(), at.rate), b = general.force(at.s(), at.rate);
    RC_ASSERT(near(a.elastic, b.elastic, 1e-13 * a.elastic));
    RC_ASSERT(near(a.dissipative, b.dissipative, 1e-13 * std::abs(a.dissipative)));
    RC_ASSERT(
        near(classical.stored_energy(at.s()), general.stored_energy(at.s()), 1e-13 * classical.stored_energy(at.s())));
    const double a_load = classical.load(at.s(), at.rate);
    RC_ASSERT(near(a_load, general.load(at.s(), at.rate), 1e-12 * (k + lambda * std::abs(at.rate))));
}

RC_GTEST_PROP(HuntCrossleyNormal, WithThePapersExponentsIsThePapersLaw, ()) {
    const double k = *decades(1, 1e8), lambda = *decades(1, 1e8);
    const ContactState at;
    const HuntCrossleyNormal<> general{k, lambda, 1.5, 0.5, 1};
    const AzadFeatherstoneNormal<> paper{k, lambda};
    const auto a = general.force(at.s(), at.rate), b = paper.force(at.s(), at.rate);
    RC_ASSERT(near(a.elastic, b.elastic, 1e-13 * b.elastic));
    RC_ASSERT(near(a.dissipative, b.dissipative, 1e-13 * std::abs(b.dissipative)));
}

RC_GTEST_PROP(HuntCrossleyNormal, WithExponentsOneAndNoneIsTheLinearLaw, ()) {
    const double k = *decades(1, 1e8), d = *decades(1, 1e8);
    const ContactState at;
    const HuntCrossleyNormal<> general{k, d, 1, 0, 1};
    const LinearNormal<> linear{k, d};
    const auto a = general.force(at.s(), at.rate), b = linear.force(at.s(), at.rate);
    RC_ASSERT(near(a.elastic, b.elastic, 1e-13 * b.elastic));
    RC_ASSERT(near(a.dissipative, b.dissipative, 1e-13 * std::abs(b.dissipative)));
    RC_ASSERT(near(general.stored_energy(at.s()), linear.stored_energy(at.s()), 1e-13 * linear.stored_energy(at.s())));
}

TEST(LinearNormal, GivesTheForceComputedByHand) {
    // k = 1000 N/m, d = 20 N s/m, z = 9 cm, zdot = -2 m/s.
    const LinearNormal<> law{1000, 20};
    EXPECT_NEAR(law.force(0.3, -2.0).elastic, 90, 1e-12);
    EXPECT_NEAR(law.force(0.3, -2.0).dissipative, -40, 1e-12);
    EXPECT_NEAR(law.stored_energy(0.3), 4.05, 1e-13);
}

}  // namespace
}  // namespace footfall
