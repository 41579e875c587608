// The bristle and its clutch: the paper's implicit equations, their limits, and the laws' symmetries.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "footfall/eigen/interop.hpp"
#include "footfall/law/registry.hpp"
#include "footfall/math/dual.hpp"
#include "law/laws.hpp"
#include "law/turn.hpp"
#include "math/property.hpp"

namespace footfall {
namespace {

using namespace test;
using Vector = Vector2<double>;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// A law that can slip and a state in which it does.
template <class Law>
struct Slipping {
    Law law = random_law<Law>();
    ContactState at;
    double scale = law.scale(at.s());
    double phi_n = 0;
    double F_n = 0;

    /// `adjust` sets the parameters that the test is about, before the load is chosen.
    template <class Adjust>
    explicit Slipping(const Adjust& adjust) {
        adjust(law);
        const double stick = law.stick_force(at.V, at.u).norm(), reach = law.coefficient > 0 ? law.coefficient : 1;
        phi_n = *uniform(0.01, 0.99) * stick / reach;
        F_n = scale * phi_n;
    }

    FrictionResponse<double> response() const { return law.slip(scale, phi_n, 0, at.V, at.u); }
    Vector force() const { return scale * response().force; }
};

constexpr auto any = [](auto&) {};
constexpr auto damped = [](auto& law) { law.damping = *decades(1e-2, 1e6); };

template <class Law>
class BristleTest : public ::testing::Test {};
TYPED_TEST_SUITE(BristleTest, BristleLaws, LawNames);

TYPED_TEST(BristleTest, StickForceIsThatOfTheSpringAndTheDamperAndTheClutchStandsStill) {
    check_property([] {
        const auto law = random_law<TypeParam>();
        const ContactState at;
        const auto r = law.stick(at.V, at.u);
        for (int i : {0, 1}) {
            const double spring = law.stiffness * at.u[i], damper = law.damping * at.V[i];
            RC_ASSERT(near(r.force[i], -spring - damper, 4 * epsilon * (std::abs(spring) + std::abs(damper))));
            RC_ASSERT(r.bristle_rate[i] == at.V[i]);  // (32)
        }
    });
}

TYPED_TEST(BristleTest, SlipSolvesTheThreeImplicitEquationsTogether) {
    check_property([] {
        const Slipping<TypeParam> slip(damped);
        const auto& [law, at, scale, phi_n, F_n] = slip;
        const double K_t = law.stiffness, D_t = law.damping, mu = law.coefficient, C_V = law.viscous;
        const Vector F = slip.force(), udot = slip.response().bristle_rate;
        const Vector f_stick = -scale * (K_t * at.u + D_t * at.V);

        const Vector V_clutch = at.V - udot;                                              // (30)
        const Vector by_bristle = -scale * (K_t * at.u + D_t * udot);                     // (31)
        const Vector by_clutch = f_stick * (mu * F_n / f_stick.norm()) - C_V * V_clutch;  // (27)

        // Rounding in udot is that of a force over scale * D_t.
        const double forces = scale * (K_t * at.u.norm() + D_t * at.V.norm());
        RC_ASSERT((F - by_bristle).norm() <= 16 * epsilon * forces);
        RC_ASSERT((F - by_clutch).norm() <= 16 * epsilon * forces * (1 + C_V / (scale * D_t)));
    });
}

TYPED_TEST(BristleTest, SlipWithoutDampingSolvesTheClutchEquationWithTheSpringAlone) {
    check_property([] {
        const Slipping<TypeParam> slip([](auto& l) {
            l.damping = 0;
            l.viscous = *decades(1e-2, 1e6);
        });
        const auto& [law, at, scale, phi_n, F_n] = slip;
        const Vector F = slip.force(), V_clutch = at.V - slip.response().bristle_rate;
        const double spring = scale * law.stiffness * at.u.norm();
        RC_ASSERT((F + scale * law.stiffness * at.u).norm() <= 4 * epsilon * spring);
        // (27), along the spring's force.
        const Vector by_clutch = -at.u.normalized() * law.coefficient * F_n - law.viscous * V_clutch;
        RC_ASSERT((F - by_clutch).norm() <=
                  16 * epsilon * (spring + law.coefficient * F_n + law.viscous * at.V.norm()));
    });
}

TYPED_TEST(BristleTest, SlippingForceLiesAlongTheStickForceBetweenTheConeAndIt) {
    check_property([] {
        const Slipping<TypeParam> slip(damped);
        const Vector phi = slip.law.stick_force(slip.at.V, slip.at.u), force = slip.response().force;
        const double size = phi.norm(), cone = slip.law.coefficient * slip.phi_n;
        RC_PRE(force.norm() > 0);
        RC_ASSERT(force.dot(phi) >= (1 - 1e-14) * force.norm() * size);
        RC_ASSERT(force.norm() >= cone * (1 - 1e-14));
        RC_ASSERT(force.norm() <= size * (1 + 1e-14));
        if (slip.law.viscous == 0) RC_ASSERT(near(force.norm(), cone, 1e-14 * cone));
    });
}

TYPED_TEST(BristleTest, ClutchAndDamperTakeWhatTheMotionGivesBeyondTheSpring) {
    check_property([] {
        const Slipping<TypeParam> slip(damped);
        const auto& [law, at, scale, phi_n, F_n] = slip;
        const Vector F = slip.force(), udot = slip.response().bristle_rate;
        const double clutch = -F.dot(at.V - udot), damper = scale * law.damping * udot.squaredNorm();
        const double spring = scale * law.stiffness * at.u.dot(udot);  // the integrand of (33)
        const double size = F.norm() * (at.V.norm() + udot.norm()) + damper + std::abs(spring);
        RC_ASSERT(clutch >= -16 * epsilon * size);
        RC_ASSERT(near(-F.dot(at.V), spring + damper + clutch, 64 * epsilon * size));
    });
}

TYPED_TEST(BristleTest, ClutchTurnsTheWayTheSphereSlips) {
    check_property([] {
        // With no stretch the sphere can only drag the clutch along with it.
        Slipping<TypeParam> slip(damped);
        slip.at.u = {};
        slip.phi_n *= 1e-3;
        RC_PRE(slip.law.cone_margin(slip.phi_n, slip.at.V, slip.at.u) < 0);
        const Vector V_clutch = slip.at.V - slip.response().bristle_rate;
        RC_ASSERT(V_clutch.dot(slip.at.V) > 0);
        RC_ASSERT(slip.force().dot(slip.at.V) <= 0);
    });
}

TYPED_TEST(BristleTest, StickAndSlipAgreeOnTheEdgeOfTheCone) {
    check_property([] {
        const Slipping<TypeParam> slip(damped);
        const auto& [law, at, scale, phi_n, F_n] = slip;
        RC_PRE(law.coefficient > 0);
        const double size = law.stick_force(at.V, at.u).norm();
        const auto stick = law.stick(at.V, at.u), edge = law.slip(scale, size / law.coefficient, 0, at.V, at.u);
        RC_ASSERT((stick.force - edge.force).norm() <= 16 * epsilon * size);
        RC_ASSERT((stick.bristle_rate - edge.bristle_rate).norm() <=
                  64 * epsilon * (law.stiffness * at.u.norm() / law.damping + at.V.norm()));
        RC_ASSERT(near(law.cone_margin(size / law.coefficient, at.V, at.u), 0, 4 * epsilon * size));
    });
}

TYPED_TEST(BristleTest, GuardsOfStickAndSlipChangeSignTogether) {
    check_property([] {
        const Slipping<TypeParam> slip(damped);
        const auto& [law, at, scale, phi_n, F_n] = slip;
        RC_ASSERT(law.slip_margin(scale, phi_n, 0, at.V, at.u) > 0);
        RC_ASSERT(law.cone_margin(phi_n, at.V, at.u) < 0);
        RC_PRE(law.coefficient > 0);
        RC_ASSERT(law.slip_margin(scale, 101 * phi_n, 0, at.V, at.u) < 0);
        RC_ASSERT(law.cone_margin(101 * phi_n, at.V, at.u) > 0);
    });
}

TYPED_TEST(BristleTest, TurningTheGroundTurnsTheAnswer) {
    check_property([] {
        const Slipping<TypeParam> slip(any);
        const auto& [law, at, scale, phi_n, F_n] = slip;
        const test::Turn turn(*uniform(0, 6.283185307179586));
        const auto here = law.slip(scale, phi_n, 0, at.V, at.u);
        const auto there = law.slip(scale, phi_n, 0, turn * at.V, turn * at.u);
        const double forces = law.stiffness * at.u.norm() + law.damping * at.V.norm();
        const double resistance = law.damping > 0 ? law.damping : law.viscous / scale;
        const double rates = at.V.norm() + (resistance > 0 ? forces / resistance : 0);
        RC_ASSERT((turn * here.force - there.force).norm() <= 64 * epsilon * forces);
        RC_ASSERT((turn * here.bristle_rate - there.bristle_rate).norm() <= 64 * epsilon * rates);
        const auto stick = law.stick(turn * at.V, turn * at.u);
        RC_ASSERT((turn * law.stick(at.V, at.u).force - stick.force).norm() <= 64 * epsilon * forces);
    });
}

TYPED_TEST(BristleTest, LittleDampingIsNearlyNone) {
    check_property([] {
        Slipping<TypeParam> slip([](auto& l) {
            l.damping = 0;
            l.viscous = *decades(1e-1, 1e3);
        });
        const auto none = slip.response();
        const double first = slip.law.stiffness * slip.at.u.norm() / slip.at.V.norm();  // D_t |V| = K_t |u|
        const double viscous_rate = slip.law.viscous / slip.scale;
        slip.law.damping = 1e-6 * std::min(first, viscous_rate);
        const auto little = slip.response();
        const double force = none.force.norm(), rate = slip.at.V.norm() + force / viscous_rate;
        RC_ASSERT((little.force - none.force).norm() <= 1e-5 * force);
        RC_ASSERT((little.bristle_rate - none.bristle_rate).norm() <= 1e-5 * rate);
    });
}

TYPED_TEST(BristleTest, LittleViscousFrictionIsNearlyNone) {
    check_property([] {
        Slipping<TypeParam> slip(damped);
        slip.law.viscous = 0;
        const auto none = slip.response();
        slip.law.viscous = 1e-9 * slip.scale * slip.law.damping;
        const auto little = slip.response();
        const double size = slip.law.stick_force(slip.at.V, slip.at.u).norm();
        RC_ASSERT((little.force - none.force).norm() <= 2e-9 * size);
        RC_ASSERT((little.bristle_rate - none.bristle_rate).norm() <= 3e-9 * size / slip.law.damping);
    });
}

TYPED_TEST(BristleTest, WithoutCoulombAndViscousFrictionNothingHolds) {
    check_property([] {
        const Slipping<TypeParam> slip([](auto& l) {
            damped(l);
            l.coefficient = l.viscous = 0;
        });
        const auto r = slip.response();
        RC_ASSERT(r.force.norm() == 0);
        // The bristle then recovers as a free one does.
        const Vector free = -slip.law.recovery_rate() * slip.at.u;
        RC_ASSERT((r.bristle_rate - free).norm() <= 4 * epsilon * free.norm());
    });
}

TYPED_TEST(BristleTest, WithoutCoulombFrictionTheForceIsThatOfTwoDampersAndASpring) {
    check_property([] {
        // mu = 0: the clutch is a damper C_V in series with the bristle, F = -C_V (V - udot).
        Slipping<TypeParam> slip(damped);
        slip.law.coefficient = 0;
        slip.law.viscous = slip.scale * slip.law.damping * *decades(1e-3, 1e3);
        const Vector F = slip.force(), V_clutch = slip.at.V - slip.response().bristle_rate;
        const double rates = slip.at.V.norm() + slip.law.stiffness * slip.at.u.norm() / slip.law.damping;
        RC_ASSERT((F + slip.law.viscous * V_clutch).norm() <= 64 * epsilon * slip.law.viscous * rates);
    });
}

TYPED_TEST(BristleTest, ElasticPlasticBristleStaysOnTheConeAsItsLoadChanges) {
    check_property([] {
        // D_t = C_V = 0: |u| = mu phi_n / K_t at all times, so u . udot = |u| mu phi_n' / K_t.
        const Slipping<TypeParam> slip([](auto& l) {
            l.damping = l.viscous = 0;
            l.coefficient = *uniform(0.1, 2);
        });
        const auto& law = slip.law;
        const double phi_n = slip.phi_n, phi_n_rate = *uniform(-10, 10) * phi_n;
        const Vector u = law.enter_slip(phi_n, slip.at.V, slip.at.u);
        RC_ASSERT(near(law.stiffness * u.norm(), law.coefficient * phi_n, 8 * epsilon * law.coefficient * phi_n));
        RC_ASSERT(u.dot(slip.at.u) >= (1 - 1e-14) * u.norm() * slip.at.u.norm());

        const auto r = law.slip(slip.scale, phi_n, phi_n_rate, slip.at.V, u);
        RC_ASSERT((r.force + law.stiffness * u).norm() <= 8 * epsilon * law.stiffness * u.norm());
        const double expected = u.norm() * law.coefficient * phi_n_rate / law.stiffness;
        const double size = u.norm() * (slip.at.V.norm() + r.bristle_rate.norm()) + std::abs(expected);
        RC_ASSERT(near(u.dot(r.bristle_rate), expected, 64 * epsilon * size));

        // The clutch turns along the force alone, and it slips as long as it turns against it.
        const Vector V_clutch = slip.at.V - r.bristle_rate;
        const double across = V_clutch.x() * u.y() - V_clutch.y() * u.x();
        RC_ASSERT(near(across, 0, 64 * epsilon * size));
        const double margin = law.slip_margin(slip.scale, phi_n, phi_n_rate, slip.at.V, u);
        RC_ASSERT(near(margin, V_clutch.dot(u.normalized()), 64 * epsilon * size / u.norm()));
    });
}

TYPED_TEST(BristleTest, ABristleWithDampingIsUnchangedAsSlipBegins) {
    check_property([] {
        const Slipping<TypeParam> slip(damped);
        RC_ASSERT(slip.law.enter_slip(slip.phi_n, slip.at.V, slip.at.u) == slip.at.u);
    });
}

TYPED_TEST(BristleTest, DualDerivativesAreThoseOfDifferences) {
    check_property([] {
        const Slipping<TypeParam> slip(damped);
        const auto& [law, at, scale, phi_n, F_n] = slip;
        using D = Dual<double, 6>;
        const std::array<double, 6> x{scale, phi_n, at.V[0], at.V[1], at.u[0], at.u[1]};
        const auto response = [](const auto& l, const auto& y) {
            using S = std::decay_t<decltype(y[0])>;
            const auto r = l.slip(y[0], y[1], S(0), Vector2<S>(y[2], y[3]), Vector2<S>(y[4], y[5]));
            return Eigen::Matrix<S, 4, 1>(r.force[0], r.force[1], r.bristle_rate[0], r.bristle_rate[1]);
        };
        std::array<D, 6> dual;
        std::array<long double, 6> exact;
        for (int i = 0; i < 6; ++i) {
            const auto k = static_cast<std::size_t>(i);
            dual[k] = D::variable(x[k], i);
            exact[k] = x[k];
        }
        const auto r = response(law.template cast<D>(), dual);
        const auto reference = law.template cast<long double>();
        const double force = law.stick_force(at.V, at.u).norm();
        // How far an input may move without turning the stick force: the slopes vary over that length.
        const double room = force / (law.stiffness * at.u.norm() + law.damping * at.V.norm());
        RC_PRE(room > 1e-2);
        for (std::size_t k = 0; k < 6; ++k) {
            const auto slope = difference(
                [&](long double v) {
                    auto y = exact;
                    y[k] = v;
                    return response(reference, y);
                },
                x[k]);
            for (int out = 0; out < 4; ++out) {
                const double size = out < 2 ? force : at.V.norm() + force / law.damping;
                const double rough = (size / std::abs(x[k]) + std::abs(static_cast<double>(slope[out]))) / room;
                RC_ASSERT(near(r[out].gradient[k], static_cast<double>(slope[out]), 1e-6 * rough));
            }
        }
    });
}

TYPED_TEST(BristleTest, StoredEnergyIsTheWorkAgainstTheSpringAtAFixedDepth) {
    check_property([] {
        const auto law = random_law<TypeParam>();
        const ContactState at;
        const double scale = law.scale(at.s()), h = 1e-3;
        // Stretching from (1-h) u to (1+h) u; the spring's force is linear, so its mean is the force at u.
        const double work = law.stored_energy(scale, (1 + h) * at.u) - law.stored_energy(scale, (1 - h) * at.u);
        const double force = -scale * law.stick(Vector::Zero(), at.u).force.dot(at.u.normalized());
        RC_ASSERT(near(work, force * 2 * h * at.u.norm(), 1e-12 * law.stored_energy(scale, at.u)));
    });
}

TYPED_TEST(BristleTest, StiffeningPowerIsTheGrowthOfTheStoredEnergyUnderASphereThatDoesNotSlip) {
    check_property([] {
        const auto law = random_law<TypeParam>();
        const ContactState at;
        using D = Dual<double, 1>;
        const auto dual = law.template cast<D>();
        const D depth(at.depth, {at.rate});  // the derivative with respect to time
        D share(1);  // of the stretch: ground that joins unstrained leaves the tension z^(1/2) u as it is
        if (TypeParam::joins_unstrained && at.rate > 0) share = sqrt(D(at.depth) / depth);
        const Vector2<D> u(D(at.u[0]) * share, D(at.u[1]) * share);
        const D energy = dual.stored_energy(dual.scale(sqrt(depth)), u);
        RC_ASSERT(near(law.stiffening_power(at.s(), at.rate, at.u), energy.gradient[0],
                       1e-13 * std::abs(energy.gradient[0])));
    });
}

TEST(AzadFeatherstoneFriction, GivesTheForceComputedByHand) {
    // K_t = 12.75e6, D_t = 3.1e3, mu = 0.2, C_V = 0.1; z = 0.1 mm, so sqrt(z) = 0.01. Along one line, u = 10 um,
    // V = 0.3 m/s: f_stick = -0.01 (127.5 + 930) = -10.575 N. With F_n = 100 N it sticks; with F_n = 10 N the cone is
    // at 2 N and |F_f| = (31 * 2 + 0.1 * 10.575) / 31.1 N.
    const AzadFeatherstoneFriction<> law{{12.75e6, 3.1e3, 0.2, 0.1}};
    const Vector V(0.3, 0), u(1e-5, 0);
    EXPECT_NEAR(0.01 * law.stick(V, u).force.x(), -10.575, 1e-13);
    EXPECT_GT(law.cone_margin(100 / 0.01, V, u), 0);
    EXPECT_LT(law.cone_margin(10 / 0.01, V, u), 0);
    const auto slip = law.slip(0.01, 10 / 0.01, 0, V, u);
    EXPECT_NEAR(0.01 * slip.force.x(), -(62 + 1.0575) / 31.1, 1e-13);
    // The clutch carries mu F_n and C_V V_clutch: V_clutch = (|F_f| - 2 N) / 0.1 N s/m.
    EXPECT_NEAR(V.x() - slip.bristle_rate.x(), ((62 + 1.0575) / 31.1 - 2) / 0.1, 1e-12);
    EXPECT_NEAR(law.stored_energy(law.scale(0.01), u), 0.5 * 12.75e6 * 0.01 * 1e-10, 1e-18);
    EXPECT_NEAR(law.recovery_rate(), 12.75e6 / 3.1e3, 1e-9);
}

TEST(LinearFriction, GivesTheForceComputedByHandAtAnyDepth) {
    // k_t = 1e5 N/m, b_t = 20 N s/m, mu = 0.5, C_V = 0: f_stick = -(1 + 6) N; with F_n = 4 N the cone is at 2 N.
    const LinearFriction<> law{{1e5, 20, 0.5, 0}};
    const Vector V(0, 0.3), u(0, 1e-5);
    for (const double s : {1e-4, 0.1}) {
        EXPECT_EQ(law.scale(s), 1);
        EXPECT_NEAR(law.stick(V, u).force.y(), -7, 1e-14);
        EXPECT_NEAR(law.slip(law.scale(s), 4, 0, V, u).force.y(), -2, 1e-14);
        // The damper takes up what the spring leaves of 2 N: 20 udot = 2 - 1.
        EXPECT_NEAR(law.slip(law.scale(s), 4, 0, V, u).bristle_rate.y(), 0.05, 1e-14);
        EXPECT_EQ(law.stiffening_power(s, 2, u), 0);
    }
}

}  // namespace
}  // namespace footfall
