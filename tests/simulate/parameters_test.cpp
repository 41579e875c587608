// Every pair of laws, parameters that are zero, and parameters that make the equations stiff.
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "simulate/scenes.hpp"

namespace footfall {
namespace {

using test::finite;
using test::paper_ball;

/// The paper's ball thrown sideways with spin: it slips, sticks, leaves and comes back.
Simulation thrown(double end_time = 0.4, double tolerance = 1e-12) {
    Simulation s = paper_ball(0.03, end_time, tolerance);
    s.initial.velocity = {0.5, -0.2, 0};
    s.initial.angular_velocity = {3, 10, 2};
    return s;
}

void expect_sound(const Run& run, double residual) {
    EXPECT_LE(run.max_residual, residual);
    EXPECT_TRUE(finite(run.final));
    ContactEnergy before;
    for (const Snapshot& shot : run.samples) {
        const ContactEnergy& e = shot.ledger.contact;
        const double slack = 1e-13 * run.energy_scale;
        EXPECT_GE(e.normal_damper, before.normal_damper - slack) << shot.time;
        EXPECT_GE(e.tangential_damper, before.tangential_damper - slack) << shot.time;
        EXPECT_GE(e.clutch, before.clutch - slack) << shot.time;
        before = e;
    }
}

TEST(Laws, EveryNormalLawRunsWithEveryFrictionLaw) {
    const std::vector<NormalLaw> normals{test::paper_normal(), HuntCrossleyNormal<>{8.5e6, 3.1e6},
                                         LinearNormal<>{2e5, 30}};
    const std::vector<FrictionLaw> frictions{NoFriction<>{}, test::paper_friction(),
                                             LinearFriction<>{{3e5, 60, 0.2, 0.1}}};
    for (const NormalLaw& normal : normals) {
        for (const FrictionLaw& friction : frictions) {
            SCOPED_TRACE(std::string(name_of(normal)) + " with " + std::string(name_of(friction)));
            for (const std::size_t spheres : {1u, 4u}) {
                Simulation s = spheres == 1 ? thrown() : test::heel_first(0.3);
                s.contacts.assign(spheres, {normal, friction});
                s.options.sample_period = 1e-3;
                const auto run = footfall::run(s);
                expect_sound(run, 1e-10);
                EXPECT_GE(run.impacts.size(), spheres);
                if (name_of(friction) == "none") {
                    EXPECT_EQ(run.final.ledger.contact.clutch, 0);
                } else {
                    EXPECT_GT(run.final.ledger.contact.clutch, 0);
                }
            }
        }
    }
}

TEST(Laws, GeneralExponentsOfHuntAndCrossleyRun) {
    for (const auto& [n, p, q] :
         {std::array{1.5, 0.5, 1.0}, {1.0, 0.0, 1.0}, {1.2, 0.25, 1.0}, {2.0, 1.0, 1.0}, {1.5, 1.5, 2.0}}) {
        SCOPED_TRACE(std::to_string(n) + " " + std::to_string(p) + " " + std::to_string(q));
        Simulation s = thrown(0.2);
        const double k = 1e6 * std::pow(1e-4, 1.5 - n);
        s.contacts[0].normal = HuntCrossleyNormal<>{k, 1e-3 * k * std::pow(1e-4, n - p), n, p, q};
        s.options.sample_period = 1e-3;
        expect_sound(footfall::run(s), 1e-10);
    }
}

// (1) with n = 3/2, p = 1/2, q = 1 is (13).
TEST(Laws, TheGeneralLawWithThePapersExponentsIsThePapersLaw) {
    Simulation s = thrown(0.2);
    const auto a = footfall::run(s);
    s.contacts[0].normal = HuntCrossleyNormal<>{8.5e6, 3.1e3, 1.5, 0.5, 1};
    const auto b = footfall::run(s);
    EXPECT_LE((a.final.body.position - b.final.body.position).norm(), 1e-11);
    EXPECT_LE((a.final.body.velocity - b.final.body.velocity).norm(), 1e-10);
    EXPECT_EQ(a.events.size(), b.events.size());
}

struct Zeroed {
    const char* name;
    double D_n, D_t, mu, C_V;
};
class ZeroParameters : public testing::TestWithParam<Zeroed> {};

TEST_P(ZeroParameters, RunAndCloseTheLedger) {
    const Zeroed& z = GetParam();
    for (const bool foot : {false, true}) {
        SCOPED_TRACE(foot ? "foot" : "ball");
        Simulation s = foot ? test::heel_first(0.3) : thrown();
        const auto& normal = std::get<AzadFeatherstoneNormal<>>(s.contacts[0].normal);
        const auto& friction = std::get<AzadFeatherstoneFriction<>>(s.contacts[0].friction);
        const ContactParameters paper{
            AzadFeatherstoneNormal<>{normal.stiffness, z.D_n * normal.damping},
            AzadFeatherstoneFriction<>{
                {friction.stiffness, z.D_t * friction.damping, z.mu * friction.coefficient, z.C_V * friction.viscous}}};
        const ContactParameters linear{LinearNormal<>{2e5, z.D_n * 30},
                                       LinearFriction<>{{3e5, z.D_t * 60, z.mu * 0.2, z.C_V * 0.1}}};
        for (const ContactParameters& law : {paper, linear}) {
            SCOPED_TRACE(name_of(law.normal));
            s.contacts.assign(s.body.spheres.size(), law);
            s.options.sample_period = 1e-3;
            s.options.max_evaluations = 2e6;
            const auto run = footfall::run(s);
            expect_sound(run, 1e-10);
            const ContactEnergy& e = run.final.ledger.contact;
            EXPECT_EQ(e.normal_damper > 0, z.D_n > 0);
            EXPECT_EQ(e.clutch > 0, z.mu > 0 || z.C_V > 0);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Each, ZeroParameters,
    testing::Values(Zeroed{"NoNormalDamping", 0, 1, 1, 1}, Zeroed{"NoTangentialDamping", 1, 0, 1, 1},
                    Zeroed{"NoCoulombFriction", 1, 1, 0, 1}, Zeroed{"NoViscousFriction", 1, 1, 1, 0},
                    Zeroed{"ElasticPlasticBristle", 1, 0, 1, 0}, Zeroed{"NoFrictionAtAll", 1, 1, 0, 0},
                    Zeroed{"NoDampingAnywhere", 0, 0, 1, 0}, Zeroed{"OnlySprings", 0, 0, 0, 0}),
    [](const auto& each) { return std::string(each.param.name); });

// The case that has equations of its own is where the others go.
TEST(ZeroParameter, TangentialDampingOfZeroIsTheLimitOfSmallDamping) {
    const auto final_velocity = [](double damping) {
        Simulation s = thrown(0.1);  // one impact
        auto& friction = std::get<AzadFeatherstoneFriction<>>(s.contacts[0].friction);
        friction.damping *= damping;
        friction.viscous = 0;
        return footfall::run(s).final.body.velocity;
    };
    const Eigen::Vector3d limit = final_velocity(0);
    const double at2 = (final_velocity(1e-2) - limit).norm(), at3 = (final_velocity(1e-3) - limit).norm();
    const double at4 = (final_velocity(1e-4) - limit).norm();
    EXPECT_GT((final_velocity(1) - limit).norm(), 1e-5);  // the damping matters
    EXPECT_NEAR(at2 / at3, 10, 2);
    EXPECT_NEAR(at3 / at4, 10, 2);
}

TEST(ZeroParameter, ViscousFrictionOfZeroIsTheLimitOfSmallViscosity) {
    const auto final_velocity = [](double viscous) {
        Simulation s = thrown(0.1);
        std::get<AzadFeatherstoneFriction<>>(s.contacts[0].friction).viscous = viscous;
        return footfall::run(s).final.body.velocity;
    };
    const Eigen::Vector3d limit = final_velocity(0);
    const double at2 = (final_velocity(1e-2) - limit).norm(), at4 = (final_velocity(1e-4) - limit).norm();
    EXPECT_GT(at2, 1e-6);
    EXPECT_NEAR(at2 / at4, 100, 30);
}

Simulation with_fast_bristle(double rate, double end_time = 0.2, double tolerance = 1e-10) {
    Simulation s = thrown(end_time, tolerance);
    auto& friction = std::get<AzadFeatherstoneFriction<>>(s.contacts[0].friction);
    friction.damping = friction.stiffness / rate;
    friction.viscous = 0;
    return s;
}

TEST(StiffParameters, AVeryFastBristleIsSolvedImplicitly) {
    for (const double viscous : {0.0, 0.1}) {
        Simulation s = with_fast_bristle(1e9);
        std::get<AzadFeatherstoneFriction<>>(s.contacts[0].friction).viscous = viscous;
        const auto run = footfall::run(s);
        EXPECT_GT(run.cost.stiff_steps, 0);
        EXPECT_LT(run.cost.evaluations, 3000000);
        EXPECT_LE(run.max_residual, 1e-8);
        EXPECT_GE(run.impacts.size(), 2u);
    }
}

TEST(StiffParameters, AVeryFastBristleIsNearlyOneWithoutDamping) {
    Simulation s = with_fast_bristle(1e9, 0.1, 1e-12);
    const auto fast = footfall::run(s);
    std::get<AzadFeatherstoneFriction<>>(s.contacts[0].friction).damping = 0;
    const auto undamped = footfall::run(s);
    EXPECT_LE((fast.final.body.velocity - undamped.final.body.velocity).norm(), 1e-5);
    EXPECT_GT((fast.final.body.velocity - undamped.final.body.velocity).norm(), 0);
}

// Overdamped ten thousand times: the ball creeps into the ground.
TEST(StiffParameters, HeavyNormalDampingIsSolvedImplicitly) {
    Simulation s = paper_ball(0, 1, 1e-10);
    const double depth = std::pow(test::ball_mass * test::gravity / 8.5e6, 2.0 / 3.0), root = std::sqrt(depth);
    const double critical = 2 * std::sqrt(test::ball_mass * 1.5 * 8.5e6 * root) / root;  // of the swing about rest
    s.contacts[0].normal = AzadFeatherstoneNormal<>{8.5e6, 1e4 * critical};
    s.initial.velocity = {0, 0, -0.1};
    const auto run = footfall::run(s);
    EXPECT_GT(run.cost.stiff_steps, 0);
    EXPECT_LT(run.cost.evaluations, 1000000);
    EXPECT_LE(run.max_residual, 1e-8);
    // Without inertia: root(z) (K_n z + D_n zdot) = m g, and z has not reached its place yet.
    const ContactSnapshot& c = run.final.contacts[0];
    EXPECT_NEAR(c.normal_force / (test::ball_mass * test::gravity), 1, 1e-3);
    EXPECT_LT(c.depth, depth);
    EXPECT_GT(c.depth, 0);
}

// Mildly stiff: the one method and the other must agree. A tight tolerance keeps the steps explicit.
TEST(StiffParameters, BothMethodsGiveTheSameAnswer) {
    Simulation s = with_fast_bristle(3e6, 0.1, 1e-8);
    const auto loose = footfall::run(s);
    s.options.tolerance = 1e-13;
    const auto tight = footfall::run(s);
    EXPECT_GT(loose.cost.stiff_steps, 0);
    EXPECT_LT(tight.cost.stiff_steps, tight.cost.steps / 10);
    EXPECT_LE((loose.final.body.velocity - tight.final.body.velocity).norm(), 1e-6);
    EXPECT_LE((loose.final.body.position - tight.final.body.position).norm(), 1e-7);
    ASSERT_EQ(loose.events.size(), tight.events.size());
    for (std::size_t i = 0; i < loose.events.size(); ++i)
        EXPECT_NEAR(loose.events[i].time, tight.events[i].time, 1e-7) << i << " " << name_of(tight.events[i].kind);
}

TEST(StiffParameters, TheSamplesOfAnImplicitRunAreConsistent) {
    Simulation s = with_fast_bristle(1e9);
    s.options.sample_period = 1e-5;
    const auto run = footfall::run(s);
    expect_sound(run, 1e-8);
    for (const Snapshot& shot : run.samples) {
        EXPECT_NEAR((shot.ledger.total() - run.initial.ledger.total()) / run.energy_scale, 0, 1e-7) << shot.time;
        const double mu = 0.2;
        EXPECT_LE(shot.contacts[0].friction_force.norm(), mu * shot.contacts[0].normal_force * (1 + 1e-6) + 1e-6)
            << shot.time;
    }
}

}  // namespace
}  // namespace footfall
