// A friction law that is coupled with load, spin and size of the contact: its limits, and the order of both methods
// across each kind of its events.
#include <numbers>

#include "footfall/law/normal/azad_featherstone.hpp"
#include "laws/contensou.hpp"
#include "simulate/order.hpp"

namespace footfall {
namespace {

using test::order_of, test::Real, test::soft_ball, test::Steps;
using Law = Pair<AzadFeatherstoneNormal<Real>, ContensouFriction<Real>>;

Law law(double normal_stiffness = 20) {
    return {AzadFeatherstoneNormal<>{normal_stiffness, 2}.cast<Real>(), ContensouFriction<>{0.4, 0.5}.cast<Real>()};
}

enum class Friction { measured, idle };

void expect_order(Steps steps, const Simulation& s, const std::vector<EventKind>& events, double coarsest,
                  const Law& over = law(), Friction friction = Friction::measured) {
    const auto measured = test::measured_order<0>(s, over, steps, events, coarsest);
    EXPECT_NEAR(measured.all, order_of(steps), 0.4);
    if (friction == Friction::measured) {
        EXPECT_NEAR(measured.tangential, order_of(steps), 0.4);
    }
}

using enum EventKind;

class OrderOfCoupledFriction : public testing::TestWithParam<Steps> {};
INSTANTIATE_TEST_SUITE_P(, OrderOfCoupledFriction, testing::Values(Steps::explicit_, Steps::implicit),
                         test::name_of_steps);

TEST_P(OrderOfCoupledFriction, IsTheMethodsAcrossTouchdown) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 1.05};
    s.initial.velocity = {1, 0.5, -0.8};
    s.initial.angular_velocity = {0.3, 0, 3};
    s.options.end_time = 0.45;
    expect_order(GetParam(), s, {touchdown}, 0.1);
}

TEST_P(OrderOfCoupledFriction, IsTheMethodsAcrossSeparation) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 0.6};
    s.initial.velocity = {1, 0.5, 0};
    s.initial.angular_velocity = {0.3, 0, 3};
    s.options.end_time = 0.6;
    expect_order(GetParam(), s, {separation}, 0.1);
}

TEST_P(OrderOfCoupledFriction, IsTheMethodsAcrossRecovered) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 0.2};
    s.initial.velocity = {1, 0.5, 1.4};
    s.initial.angular_velocity = {0.3, 0, 3};
    s.options.end_time = 1;
    expect_order(GetParam(), s, {recovered}, 0.4, law(1), Friction::idle);
}

TEST_P(OrderOfCoupledFriction, IsTheMethodsAcrossAWholeImpact) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 1.05};
    s.initial.velocity = {1, 0.5, -0.8};
    s.initial.angular_velocity = {0.3, 0, 3};
    s.options.end_time = 1.9;
    expect_order(GetParam(), s, {touchdown, separation, recovered}, 0.1);
}

// ---- the law ------------------------------------------------------------------------------------------------------

const ContensouFriction<> friction{0.4, 1e-9};
const Touch<double> still{.root_depth = 0.05, .depth_rate = 0, .slip = {0, 0}, .radius = 0.04};  // a = 1 cm

TEST(CoupledFriction, IsCoulombsWhereThePatchOnlySlides) {
    Touch<double> t = still;
    t.slip = {0.3, -0.4};
    const auto r = friction.respond(t, {}, {});
    EXPECT_NEAR(r.traction.x(), -0.4 * 0.6, 1e-8);
    EXPECT_NEAR(r.traction.y(), 0.4 * 0.8, 1e-8);
    EXPECT_EQ(r.spin_arm, 0);
}

// The torque of a Hertzian pressure, summed over rings.
TEST(CoupledFriction, IsTheTorqueOfAHertzianPressureWhereThePatchOnlySpins) {
    Touch<double> t = still;
    t.spin = -3;
    const double a = 0.01;
    double arm = 0;  // over F_n
    constexpr int rings = 100'000;
    for (int k = 0; k < rings; ++k) {
        const double r = a * (k + 0.5) / rings;
        const double pressure = 1.5 / (std::numbers::pi * a * a) * std::sqrt(1 - r * r / (a * a));
        arm += 0.4 * pressure * r * 2 * std::numbers::pi * r * a / rings;
    }
    const auto r = friction.respond(t, {}, {});
    EXPECT_NEAR(r.spin_arm / arm, 1, 1e-6);
    EXPECT_EQ(r.traction.norm(), 0);
}

// The force of a slow slip while it spins, and the torque of a slow spin while it slides, against the sum of Coulomb's
// friction over the patch.
TEST(CoupledFriction, HasTheSlopesOfTheSumOverThePatch) {
    const auto summed = [](double slip, double spin, double a) {
        double force = 0, torque = 0;
        constexpr int rings = 400, sectors = 400;
        for (int k = 0; k < rings; ++k)
            for (int l = 0; l < sectors; ++l) {
                const double r = a * (k + 0.5) / rings, angle = 2 * std::numbers::pi * (l + 0.5) / sectors;
                const double pressure = 1.5 / (std::numbers::pi * a * a) * std::sqrt(1 - r * r / (a * a));
                const double weight = pressure * r * (a / rings) * (2 * std::numbers::pi / sectors);
                const double vx = slip - spin * r * std::sin(angle), vy = spin * r * std::cos(angle);
                const double v = std::hypot(vx, vy);
                force -= 0.4 * weight * vx / v;
                torque -= 0.4 * weight * r * (vy * std::cos(angle) - vx * std::sin(angle)) / v;
            }
        return std::array{force, torque};
    };
    Touch<double> slides = still, spins = still;
    slides.slip = {1, 0};
    slides.spin = 0.5;
    spins.slip = {0.002, 0};
    spins.spin = 50;
    EXPECT_NEAR(friction.respond(slides, {}, {}).spin_arm / summed(1, 0.5, 0.01)[1], 1, 0.01);
    EXPECT_NEAR(friction.respond(spins, {}, {}).traction.x() / summed(0.002, 50, 0.01)[0], 1, 0.01);
}

TEST(CoupledFriction, OfASpinningBallClosesTheLedger) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 1.05};
    s.initial.velocity = {1, 0.5, -0.8};
    s.initial.angular_velocity = {0.3, 0, 3};
    s.options.end_time = 1.9;
    s.options.tolerance = 1e-13;
    const footfall::Run record = SimulationRun<Law, 1, 0>(s, {law()}).run();
    EXPECT_LT(record.max_residual, 1e-12);
    const auto& last = record.samples.empty() ? record.events.back().state : record.samples.back();
    EXPECT_LT(last.body.angular_velocity.z(), 2.9);  // the torque has taken some
    EXPECT_GT(last.ledger.contact.clutch, 0.01);
}

}  // namespace
}  // namespace footfall
