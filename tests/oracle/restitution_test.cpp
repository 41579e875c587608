// Restitution of a single impact without gravity: the library against an independent integration in long double, and
// against what is known in closed form, for the three normal laws, from 1 mm/s to 10 m/s.
#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "footfall/simulate/run.hpp"
#include "oracle/impact.hpp"

namespace {

using oracle::ImpactLaw;

constexpr double mass = 0.154, radius = 0.0165;  // section 2.2

struct Case {
    const char* name;
    ImpactLaw law;
    double stiffness, damping;
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

footfall::NormalLaw law_of(const Case& c) {
    switch (c.law) {
        case ImpactLaw::azad_featherstone:
            return footfall::AzadFeatherstoneNormal<>{c.stiffness, c.damping};
        case ImpactLaw::hunt_crossley:
            return footfall::HuntCrossleyNormal<>{c.stiffness, c.damping};
        case ImpactLaw::linear:
            break;
    }
    return footfall::LinearNormal<>{c.stiffness, c.damping};
}

/// The ball reaches the ground after 1 ms and is watched until it is well away.
footfall::Run run_impact(const Case& c, double speed, double duration) {
    footfall::Simulation simulation;
    simulation.body.mass = mass;
    simulation.body.inertia = footfall::solid_sphere_inertia(mass, radius);
    simulation.body.spheres = {{.radius = radius}};
    simulation.gravity.setZero();
    simulation.initial.position = {0, 0, radius + 1e-3 * speed};
    simulation.initial.velocity = {0, 0, -speed};
    simulation.contacts = {{law_of(c), footfall::NoFriction<>{}}};
    simulation.options.end_time = 1e-3 + 1.5 * duration;
    simulation.options.tolerance = 1e-12;
    return footfall::run(simulation);
}

std::array<double, 9> speeds() {
    std::array<double, 9> v;
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = std::pow(10.0, -3 + 0.5 * static_cast<double>(i));
    return v;
}

class SingleImpact : public testing::TestWithParam<Case> {};

TEST_P(SingleImpact, AgreesWithAnIndependentIntegrationFromOneMillimetreToTenMetresPerSecond) {
    const Case& c = GetParam();
    for (double speed : speeds()) {
        SCOPED_TRACE(speed);
        const auto expected = oracle::impact<long double>(c.law, mass, c.stiffness, c.damping, speed);
        const footfall::Run run = run_impact(c, speed, static_cast<double>(expected.recovered));
        ASSERT_EQ(run.impacts.size(), 1u);
        const footfall::Impact& hit = run.impacts[0];
        ASSERT_TRUE(hit.restitution().has_value());
        ASSERT_TRUE(hit.separation.has_value());
        EXPECT_NEAR(*hit.restitution(), static_cast<double>(expected.speed_out / speed), 1e-9);
        EXPECT_NEAR((*hit.separation - hit.touchdown) / static_cast<double>(expected.separation), 1, 1e-9);
        EXPECT_NEAR((*hit.recovered - hit.touchdown) / static_cast<double>(expected.recovered), 1, 1e-9);
        EXPECT_NEAR(hit.peak_indentation / static_cast<double>(expected.peak_depth), 1, 1e-9);
        EXPECT_NEAR(hit.peak_normal_force / static_cast<double>(expected.peak_force), 1, 1e-9);
        EXPECT_LE(run.max_residual, 1e-11);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Laws, SingleImpact,
    testing::Values(Case{"azad featherstone of section 2.2", ImpactLaw::azad_featherstone, 8.5e6, 3.1e3},
                    Case{"azad featherstone heavily damped", ImpactLaw::azad_featherstone, 8.5e6, 3.1e4},
                    Case{"azad featherstone elastic", ImpactLaw::azad_featherstone, 8.5e6, 0},
                    Case{"hunt crossley of section 2.2", ImpactLaw::hunt_crossley, 8.5e6, 3.1e6},
                    Case{"hunt crossley heavily damped", ImpactLaw::hunt_crossley, 8.5e6, 3.1e7},
                    Case{"hunt crossley elastic", ImpactLaw::hunt_crossley, 8.5e6, 0},
                    Case{"linear", ImpactLaw::linear, 2.5e5, 60},
                    Case{"linear overdamped", ImpactLaw::linear, 2.5e5, 1000},
                    Case{"linear elastic", ImpactLaw::linear, 2.5e5, 0}),
    [](const auto& instance) {
        std::string name = instance.param.name;
        std::replace_if(
            name.begin(), name.end(), [](char ch) { return ch == ' ' || ch == '.'; }, '_');
        return name;
    });

TEST(Restitution, OfTheLinearLawIsTheClosedFormAtEverySpeed) {
    for (double damping : {20.0, 60.0, 280.0, 390.0, 1000.0}) {
        const double expected = static_cast<double>(oracle::linear_restitution(mass, 2.5e5, damping));
        for (double speed : {1e-3, 0.1, 10.0}) {
            const footfall::Run run = run_impact({"", ImpactLaw::linear, 2.5e5, damping}, speed, 0.2);
            ASSERT_EQ(run.impacts.size(), 1u);
            EXPECT_NEAR(run.impacts[0].restitution().value_or(-1), expected, 1e-10) << damping << " " << speed;
        }
    }
}

TEST(Restitution, OfHuntAndCrossleyIsTheirImplicitClosedForm) {
    for (double speed : speeds()) {
        const double expected = static_cast<double>(oracle::hunt_crossley_restitution(8.5e6, 3.1e6, speed));
        const footfall::Run run = run_impact({"", ImpactLaw::hunt_crossley, 8.5e6, 3.1e6}, speed, 0.05);
        ASSERT_EQ(run.impacts.size(), 1u);
        EXPECT_NEAR(run.impacts[0].restitution().value_or(-1), expected, 1e-10) << speed;
    }
}

}  // namespace
