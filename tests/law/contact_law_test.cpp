// Every normal law with every friction law: phases, what is felt in each, and where the energy goes.
#include "footfall/law/contact_law.hpp"

#include <cmath>
#include <limits>
#include <span>
#include <type_traits>

#include <gtest/gtest.h>

#include "footfall/eigen/interop.hpp"
#include "footfall/math/dual.hpp"
#include "law/laws.hpp"
#include "law/turn.hpp"
#include "math/property.hpp"

namespace footfall {
namespace {

using namespace test;
using Vector = Vector2<double>;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// All that a contact does in a phase.
template <class Law, class S>
ContactResponse<S> respond(const Law& law, Phase phase, const S& s, const S& z_rate,
                           const std::type_identity_t<Vector2<S>>& V, const std::type_identity_t<Vector2<S>>& u) {
    const auto n = static_cast<std::size_t>(law.states());
    Vector2<S> rates;
    return law.evaluate(Mode{phase}, Touch<S>{s, z_rate, V}, std::span<const S>(u.data(), n),
                        std::span<S>(rates.data(), n));
}

/// A random law and state, and the response. Half of the states have a load and a stretch of the size of the cone, so
/// that stick, slip and recovery all come up.
template <class Law>
struct Case {
    static constexpr bool has_bristle = decltype(Law::friction)::has_bristle;
    static constexpr bool joins_unstrained = [] {
        if constexpr (has_bristle) return decltype(Law::friction)::joins_unstrained;
        return false;
    }();

    Law law = random_contact_law<Law>();
    ContactState at;

    Case() {
        if constexpr (has_bristle) {
            const double F_n = law.normal.force(at.s(), at.rate).total();
            if (coin() && F_n > 0) {
                const double cone = law.friction.coefficient * F_n / law.friction.scale(at.s());
                at.u *= *uniform(0, 2) * cone / (law.friction.stiffness * at.u.norm());
                if (law.friction.damping > 0) at.V *= *uniform(0, 2) * cone / (law.friction.damping * at.V.norm());
            }
            // An elastic-plastic bristle slips only on its cone and outwards.
            if (law.friction.plastic() && F_n > 0 && slips()) {
                at.u = on_cone(F_n);
                if (at.u.dot(at.V) < 0) at.V = -at.V;
                while (at.u.dot(at.V + joining()) < 0) at.V *= 2;  // faster than new ground slackens it
            }
        }
    }

    ContactResponse<double> response() const { return law.evaluate(at.depth, at.rate, at.V, at.u); }
    bool slips() const { return response().phase == Phase::slip; }
    /// What a patch that grows does to the bristle of a law whose new ground joins unstrained: it keeps z^(1/2) u.
    Vector joining() const {
        if (!joins_unstrained || at.rate < 0) return Vector::Zero();
        return -at.u * (at.rate / (2 * at.depth));
    }
    Vector on_cone(double F_n) const {
        return at.u.normalized() *
               (law.friction.coefficient * F_n / law.friction.scale(at.s()) / law.friction.stiffness);
    }
    /// What friction forces are made of, before they cancel [N].
    double tangential_size() const {
        if constexpr (has_bristle) {
            return law.friction.scale(at.s()) *
                   (law.friction.stiffness * at.u.norm() + law.friction.damping * at.V.norm());
        } else {
            return 0;
        }
    }
    double normal_size() const {
        const auto f = law.normal.force(at.s(), at.rate);
        return std::abs(f.elastic) + std::abs(f.dissipative);
    }
};

template <class Law>
class ContactLawTest : public ::testing::Test {};
TYPED_TEST_SUITE(ContactLawTest, ContactLaws, LawNames);

TYPED_TEST(ContactLawTest, NothingIsFeltAboveTheGround) {
    check_property([] {
        const Case<TypeParam> c;
        for (const double depth : {0.0, -c.at.depth}) {
            const auto r = c.law.evaluate(depth, c.at.rate, c.at.V, c.at.u);
            RC_ASSERT(r.phase == Phase::flight);
            RC_ASSERT(r.normal_force == 0);
            RC_ASSERT(r.friction_force.norm() == 0);
            for (const double energy :
                 {r.normal_spring, r.normal_damper_power, r.clutch_power, r.stiffness_change_power})
                RC_ASSERT(energy == 0);
            // The paper's tangential spring is slack without a depth. The linear one stays stretched, and what it holds
            // goes into its damper.
            if (decltype(TypeParam::friction)::ScalePower == 1 || !Case<TypeParam>::has_bristle)
                RC_ASSERT(r.tangential_spring == 0);
            using D = Dual<double, 1>;
            const Vector2<D> u(D(c.at.u[0], {r.bristle_rate[0]}), D(c.at.u[1], {r.bristle_rate[1]}));
            const Vector2<D> V = c.at.V.template cast<D>();
            const D spring = c.law.template cast<D>().evaluate(D(depth), D(c.at.rate), V, u).tangential_spring;
            RC_ASSERT(near(r.tangential_damper_power, -spring.gradient[0], 1e-13 * r.tangential_damper_power));
        }
    });
}

TYPED_TEST(ContactLawTest, AFreeBristleRecoversWithItsOwnTimeConstant) {
    check_property([] {
        const Case<TypeParam> c;
        const auto flying = c.law.evaluate(-c.at.depth, c.at.rate, c.at.V, c.at.u);
        const auto recovering = respond(c.law, Phase::recovering, c.at.s(), c.at.rate, c.at.V, c.at.u);
        Vector expected = Vector::Zero();
        if constexpr (Case<TypeParam>::has_bristle) {
            // (31) with no friction force, whatever the depth; without damping nothing times the recovery.
            const double K_t = c.law.friction.stiffness, D_t = c.law.friction.damping;
            if (D_t > 0) expected = -(K_t / D_t) * c.at.u;
        }
        RC_ASSERT((flying.bristle_rate - expected).norm() <= 4 * epsilon * expected.norm());
        const double size = expected.norm() + c.joining().norm();
        RC_ASSERT((recovering.bristle_rate - expected - c.joining()).norm() <= 8 * epsilon * size);
    });
}

TYPED_TEST(ContactLawTest, TheGroundNeverPulls) {
    check_property([] {
        const Case<TypeParam> c;
        const double unclamped = c.law.normal.force(c.at.s(), c.at.rate).total();
        const auto r = c.response();
        RC_ASSERT(r.normal_force >= 0);
        RC_ASSERT(near(r.normal_force, std::max(unclamped, 0.0), 4 * epsilon * c.normal_size()));
    });
}

TYPED_TEST(ContactLawTest, WithoutNormalForceThereIsNoFrictionAndTheDamperTakesWhatTheSpringGives) {
    check_property([] {
        Case<TypeParam> c;
        c.law.normal.damping = *decades(1e-2, 1e6);
        c.at.rate = -std::abs(c.at.rate);
        // Out fast enough for the damper to pull harder than the spring pushes, in every law.
        while (c.law.normal.force(c.at.s(), c.at.rate).total() > 0) c.at.rate *= 2;
        const auto r = c.response();
        RC_ASSERT(r.phase == Phase::recovering);
        RC_ASSERT(r.normal_force == 0);
        RC_ASSERT(r.friction_force.norm() == 0);
        RC_ASSERT(r.clutch_power == 0);
        using D = Dual<double, 1>;
        const D spring = c.law.normal.template cast<D>().stored_energy(sqrt(D(c.at.depth, {c.at.rate})));
        RC_ASSERT(near(r.normal_damper_power, -spring.gradient[0], 1e-12 * r.normal_damper_power));
    });
}

TYPED_TEST(ContactLawTest, NormalWorkIsStoredOrDissipated) {
    check_property([] {
        const Case<TypeParam> c;
        const auto r = c.response();
        using D = Dual<double, 1>;
        const D spring = c.law.normal.template cast<D>().stored_energy(sqrt(D(c.at.depth, {c.at.rate})));
        RC_ASSERT(near(r.normal_force * c.at.rate, spring.gradient[0] + r.normal_damper_power,
                       1e-12 * c.normal_size() * std::abs(c.at.rate)));
        RC_ASSERT(near(r.normal_spring, spring.value, 1e-13 * spring.value));
    });
}

TYPED_TEST(ContactLawTest, TangentialWorkIsStoredDissipatedOrBookedAsStiffnessChange) {
    check_property([] {
        const Case<TypeParam> c;
        const auto r = c.response();
        // The growth of the stored energy along the motion, by differences of the response itself.
        RC_PRE(c.at.u.norm() > 0);
        const double h = 1e-5 / (std::abs(c.at.rate) / c.at.depth + r.bristle_rate.norm() / c.at.u.norm());
        const auto stored = [&](double t) {
            const double s = std::sqrt(c.at.depth + c.at.rate * t);
            return respond(c.law, r.phase, s, c.at.rate, c.at.V, c.at.u + r.bristle_rate * t).tangential_spring;
        };
        const double growth = (stored(h) - stored(-h)) / (2 * h);
        const double given = -r.friction_force.dot(c.at.V);
        const double booked = growth + r.stiffness_change_power + r.tangential_damper_power + r.clutch_power;
        const double size = c.tangential_size() * (c.at.V.norm() + r.bristle_rate.norm()) + std::abs(growth) +
                            r.tangential_spring * std::abs(c.at.rate) / c.at.depth;
        RC_ASSERT(near(given, booked, 1e-8 * size));
    });
}

TYPED_TEST(ContactLawTest, StiffnessChangeIsWhatTheDepthAloneDoesToTheTangentialSpring) {
    check_property([] {
        const Case<TypeParam> c;
        const auto r = c.response();
        const double h = 1e-5 * c.at.depth / std::abs(c.at.rate);
        const auto stored = [&](double t) {
            const double z = c.at.depth + c.at.rate * t;
            const bool keeps_tension = c.joins_unstrained && c.at.rate > 0;
            const Vector u = keeps_tension ? Vector(c.at.u * std::sqrt(c.at.depth / z)) : c.at.u;
            return respond(c.law, r.phase, std::sqrt(z), c.at.rate, c.at.V, u).tangential_spring;
        };
        const double growth = (stored(h) - stored(-h)) / (2 * h);
        RC_ASSERT(
            near(r.stiffness_change_power, -growth, 1e-8 * r.tangential_spring * std::abs(c.at.rate) / c.at.depth));
    });
}

TYPED_TEST(ContactLawTest, NoChannelGivesEnergyBack) {
    check_property([] {
        const Case<TypeParam> c;
        const auto r = c.response();
        RC_ASSERT(r.normal_damper_power >= 0);
        RC_ASSERT(r.tangential_damper_power >= 0);
        RC_ASSERT(r.clutch_power >= 0);
        if (c.joins_unstrained) RC_ASSERT(r.stiffness_change_power >= 0);
        if (r.phase == Phase::stick) RC_ASSERT(r.clutch_power == 0);
        RC_ASSERT(r.normal_spring >= 0);
        RC_ASSERT(r.tangential_spring >= 0);
    });
}

TYPED_TEST(ContactLawTest, FrictionWithoutViscosityStaysInTheCone) {
    check_property([] {
        Case<TypeParam> c;
        if constexpr (Case<TypeParam>::has_bristle) {
            RC_PRE(c.law.friction.viscous == 0);
            const auto r = c.response();
            RC_ASSERT(r.friction_force.norm() <=
                      c.law.friction.coefficient * (r.normal_force + 8 * epsilon * c.normal_size()));
        } else {
            RC_ASSERT(c.response().friction_force.norm() == 0);
        }
    });
}

TYPED_TEST(ContactLawTest, PhaseFollowsFromTheForces) {
    check_property([] {
        const Case<TypeParam> c;
        const auto r = c.response();
        const double unclamped = c.law.normal.force(c.at.s(), c.at.rate).total();
        RC_PRE(std::abs(unclamped) > 1e-12 * c.normal_size());
        RC_ASSERT((r.phase == Phase::recovering) == (unclamped < 0));
        RC_ASSERT(r.phase != Phase::flight);
        if constexpr (Case<TypeParam>::has_bristle) {
            const auto& f = c.law.friction;
            const double f_stick = f.scale(c.at.s()) * (f.stiffness * c.at.u + f.damping * c.at.V).norm();
            const double cone = f.coefficient * r.normal_force;
            const double rounding = 8 * epsilon * (c.tangential_size() + f.coefficient * c.normal_size());
            if (r.phase == Phase::stick) {
                RC_ASSERT(f_stick <= cone + rounding);
                RC_ASSERT(near(r.friction_force.norm(), f_stick, rounding));
                const double rates = c.at.V.norm() + c.joining().norm();
                RC_ASSERT((r.bristle_rate - c.at.V - c.joining()).norm() <= 8 * epsilon * rates);  // (32)
            } else if (r.phase == Phase::slip) {
                RC_ASSERT(f_stick >= cone - rounding);
            }
        } else {
            RC_ASSERT(r.phase != Phase::stick);
        }
    });
}

TYPED_TEST(ContactLawTest, NormalForceDoesNotSeeTheFriction) {
    check_property([] {
        const Case<TypeParam> c;
        const ContactLaw<decltype(c.law.normal), NoFriction<>> alone{c.law.normal, {}};
        const auto with = c.response(), without = alone.evaluate(c.at.depth, c.at.rate, c.at.V, c.at.u);
        RC_ASSERT(near(with.normal_force, without.normal_force, 8 * epsilon * c.normal_size()));
        RC_ASSERT(with.normal_spring == without.normal_spring);
        RC_ASSERT(near(with.normal_damper_power, without.normal_damper_power,
                       8 * epsilon * c.normal_size() * std::abs(c.at.rate)));
    });
}

TYPED_TEST(ContactLawTest, TurningTheGroundTurnsTheAnswer) {
    check_property([] {
        const Case<TypeParam> c;
        const test::Turn turn(*uniform(0, 6.283185307179586));
        const auto here = c.response();
        // In the same phase: on the very edge of the cone rounding may choose another.
        const auto there = respond(c.law, here.phase, c.at.s(), c.at.rate, turn * c.at.V, turn * c.at.u);
        const double force = std::max(c.tangential_size(), here.friction_force.norm());
        RC_ASSERT((turn * here.friction_force - there.friction_force).norm() <= 64 * epsilon * force);
        RC_ASSERT(there.normal_force == here.normal_force);
        RC_ASSERT(near(here.tangential_spring, there.tangential_spring, 16 * epsilon * here.tangential_spring));
    });
}

template <class Law>
class ClutchedContactLawTest : public ::testing::Test {};
TYPED_TEST_SUITE(ClutchedContactLawTest, ClutchedContactLaws, LawNames);

TYPED_TEST(ClutchedContactLawTest, ForceIsContinuousWhereTheClutchLetsGo) {
    check_property([] {
        Case<TypeParam> c;
        c.law.friction.damping = *decades(1e-2, 1e6);
        c.law.friction.coefficient = *uniform(0.1, 2);
        const double F_n = c.law.normal.force(c.at.s(), c.at.rate).total();
        RC_PRE(F_n > 0);
        // Scale the motion onto the edge of the cone.
        const double f_stick = c.law.friction.scale(c.at.s()) *
                               (c.law.friction.stiffness * c.at.u + c.law.friction.damping * c.at.V).norm();
        RC_PRE(f_stick > 1e-6 * c.tangential_size());
        const double to_edge = c.law.friction.coefficient * F_n / f_stick;
        const auto near_edge = [&](double factor) {
            return c.law.evaluate(c.at.depth, c.at.rate, factor * to_edge * c.at.V, factor * to_edge * c.at.u);
        };
        const auto inside = near_edge(1 - 1e-9), outside = near_edge(1 + 1e-9);
        RC_ASSERT(inside.phase == Phase::stick);
        RC_ASSERT(outside.phase == Phase::slip);
        RC_ASSERT((inside.friction_force - outside.friction_force).norm() <= 3e-9 * inside.friction_force.norm());
    });
}

TYPED_TEST(ContactLawTest, DualDerivativesAreThoseOfDifferences) {
    check_property([] {
        const Case<TypeParam> c;
        const auto at_once = c.response();
        using D = Dual<double, 6>;
        const std::array<double, 6> x{c.at.depth, c.at.rate, c.at.V[0], c.at.V[1], c.at.u[0], c.at.u[1]};
        const auto forces = [&](const auto& law, const auto& y) {
            using S = std::decay_t<decltype(y[0])>;
            using std::sqrt;
            const auto r =
                respond(law, at_once.phase, sqrt(y[0]), y[1], Vector2<S>(y[2], y[3]), Vector2<S>(y[4], y[5]));
            return Eigen::Matrix<S, 3, 1>(r.normal_force, r.friction_force[0], r.friction_force[1]);
        };
        std::array<D, 6> dual;
        std::array<long double, 6> exact;
        for (std::size_t k = 0; k < 6; ++k) {
            dual[k] = D::variable(x[k], static_cast<int>(k));
            exact[k] = x[k];
        }
        const auto f = forces(c.law.template cast<D>(), dual);
        const auto reference = c.law.template cast<long double>();
        // Away from where opposing spring and damper make the stick force turn quickly.
        double room = 1;
        if constexpr (Case<TypeParam>::has_bristle) {
            const double scale = c.law.friction.scale(c.at.s());
            room = scale * c.law.friction.stick_force(c.at.V, c.at.u).norm() / c.tangential_size();
            RC_PRE(room > 1e-2);
        }
        for (std::size_t k = 0; k < 6; ++k) {
            RC_PRE(x[k] != 0);
            const auto slope = difference(
                [&](long double v) {
                    auto y = exact;
                    y[k] = v;
                    return forces(reference, y);
                },
                x[k]);
            for (int out = 0; out < 3; ++out) {
                const double size = c.normal_size() + c.tangential_size();
                RC_ASSERT(
                    near(f[out].gradient[k], static_cast<double>(slope[out]), 1e-6 * size / std::abs(x[k]) / room));
            }
        }
    });
}

TEST(ContactLaw, GivesThePapersBallInMidImpactComputedByHand) {
    // Section 4 at z = 0.1 mm, zdot = 0.5 m/s, u = 10 um and V = 0.3 m/s along x:
    //   F_n = 8.5 + 15.5 = 24 N, the cone at 4.8 N; f_stick = -10.575 N: it slips.
    //   |F_f| = (31 * 4.8 + 0.1 * 10.575) / 31.1 N = 4.818569 N
    //   udot = (|F_f| - 0.01 * 127.5) / 31; the damper takes 31 udot^2, the clutch |F_f| (V - udot).
    const ContactLaw<AzadFeatherstoneNormal<>, AzadFeatherstoneFriction<>> law{{8.5e6, 3.1e3},
                                                                               {{12.75e6, 3.1e3, 0.2, 0.1}}};
    const auto r = law.evaluate(1e-4, 0.5, {0.3, 0}, {1e-5, 0});
    const double F = 149.8575 / 31.1, udot = (F - 1.275) / 31;
    EXPECT_EQ(r.phase, Phase::slip);
    EXPECT_NEAR(r.normal_force, 24, 1e-13);
    EXPECT_NEAR(r.friction_force.x(), -F, 1e-13);
    EXPECT_EQ(r.friction_force.y(), 0);
    EXPECT_NEAR(r.bristle_rate.x(), udot, 1e-14);
    EXPECT_NEAR(r.normal_spring, 0.4 * 8.5e-4, 1e-18);
    EXPECT_NEAR(r.tangential_spring, 6.375e-6, 1e-19);
    EXPECT_NEAR(r.normal_damper_power, 7.75, 1e-13);
    EXPECT_NEAR(r.tangential_damper_power, 31 * udot * udot, 1e-14);
    EXPECT_NEAR(r.clutch_power, F * (0.3 - udot), 1e-13);
    EXPECT_NEAR(r.stiffness_change_power, -0.25 * 12.75e6 * 0.5 * 1e-10 / 0.01, 1e-16);
}

TEST(ContactLaw, TheClampActsInMidReboundComputedByHand) {
    // The same ball on the way out at 2 m/s: 8.5 N from the spring, -62 N from the damper, so the ground lets go and
    // the damper takes the spring's 17 W.
    const ContactLaw<AzadFeatherstoneNormal<>, AzadFeatherstoneFriction<>> law{{8.5e6, 3.1e3},
                                                                               {{12.75e6, 3.1e3, 0.2, 0.1}}};
    const auto r = law.evaluate(1e-4, -2, {0.3, 0}, {1e-5, 0});
    EXPECT_EQ(r.phase, Phase::recovering);
    EXPECT_EQ(r.normal_force, 0);
    EXPECT_NEAR(r.normal_damper_power, 17, 1e-13);
    EXPECT_NEAR(r.bristle_rate.x(), -12.75e6 / 3.1e3 * 1e-5, 1e-15);
    EXPECT_NEAR(r.tangential_damper_power, 31 * std::pow(127.5 / 3.1e3, 2), 1e-14);
}

TEST(ContactLaw, TangentialStiffnessFollowsTheRootOfTheDepthInThePapersLawOnly) {
    const AzadFeatherstoneNormal<> normal{1e6, 0};
    const ContactLaw<AzadFeatherstoneNormal<>, AzadFeatherstoneFriction<>> paper{normal, {{1e6, 0, 10, 0}}};
    const ContactLaw<AzadFeatherstoneNormal<>, LinearFriction<>> linear{normal, {{1e6, 0, 10, 0}}};
    const Vector u(1e-6, 0), V = Vector::Zero();
    EXPECT_NEAR(paper.evaluate(4e-4, 0, V, u).friction_force.x(), 2 * paper.evaluate(1e-4, 0, V, u).friction_force.x(),
                1e-15);
    EXPECT_EQ(linear.evaluate(4e-4, 0, V, u).friction_force.x(), linear.evaluate(1e-4, 0, V, u).friction_force.x());
}

}  // namespace
}  // namespace footfall
