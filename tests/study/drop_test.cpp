// One impact along the normal as a plant of its own: against the closed form of the linear law with its derivatives,
// and for laws with states of the normal direction.
#include "footfall/plant/drop.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "footfall/study/viscoelastic_theory.hpp"
#include "study/drop_impact.hpp"

namespace footfall {
namespace {

using study::Branch;
using study::DropImpact;
using study::FitDual;

/// e of the closed form, with its derivatives with respect to damping, stiffness and mass by differences of fourth
/// order.
FitDual linear_restitution_slopes(double m, double k, double d) {
    const auto slope = [&](int which) {
        const auto at = [&](double by) {
            return linear_restitution(m * (which == 2 ? 1 + by : 1), k * (which == 1 ? 1 + by : 1),
                                      d * (which == 0 ? 1 + by : 1));
        };
        constexpr double h = 1e-3;
        return (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
    };
    return {linear_restitution(m, k, d), {slope(0) / d, slope(1) / k, slope(2) / m, 0}};
}

TEST(Drop, UnderTheLinearLawHasTheRestitutionOfTheClosedFormWithItsDerivatives) {
    const double m = 0.154, k = 2.5e5;
    for (const double d : {10.0, 60.0, 200.0}) {
        const FitDual out = DropImpact<FitDual>(LinearNormal<FitDual>{FitDual::variable(k, 1), FitDual::variable(d, 0)},
                                                FitDual::variable(m, 2), FitDual::variable(0.5, 3))
                                .speed_out()
                                .value();
        const FitDual e = linear_restitution_slopes(m, k, d);
        EXPECT_NEAR(out.value / 0.5, e.value, 1e-10) << d;
        const std::array<double, 3> scale{d, k, m};
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(out.gradient[i] * scale[i] / 0.5, e.gradient[i] * scale[i], 1e-8) << d << " " << i;
        EXPECT_NEAR(out.gradient[3], e.value, 1e-9) << d;  // e does not depend on the speed
    }
}

TEST(Drop, EndsHoweverHeavyTheDamping) {
    // e of the overdamped linear law tends to k m / d^2.
    const double m = 0.154, k = 2.5e5, d = 1e6;
    const auto out = DropImpact<double>(LinearNormal<>{k, d}, m, 1).speed_out();
    ASSERT_TRUE(out.has_value());
    EXPECT_NEAR(*out / linear_restitution(m, k, d), 1, 1e-3);
}

TEST(Drop, TellsALawHowFastTheImpactBegan) {
    // Flores et al.'s damping is made for the impact's speed: the restitution is the same at every speed.
    std::array<double, 2> e{};
    std::array<double, 2> speeds{0.1, 3.0};
    for (std::size_t i = 0; i < 2; ++i)
        e[i] = DropImpact<double>(FloresNormal<>{{8.5e6, 0.7}}, 0.154, speeds[i]).speed_out().value() / speeds[i];
    EXPECT_NEAR(e[0], e[1], 1e-9);
    EXPECT_GT(e[0], 0.5);
    EXPECT_LT(e[0], 0.8);
}

TEST(Drop, OverDualNumbersGoesTheWayOfTheirValues) {
    const std::vector<double> depths{1e-6, 5e-5, 5e-5, 1e-3};
    const std::vector<Branch> branches{Branch::loading, Branch::loading, Branch::unloading, Branch::unloading};
    std::vector<double> plain(4);
    std::vector<FitDual> dual(4);
    ASSERT_TRUE(
        DropImpact<double>(KuwabaraKonoNormal<>{{8.5e6, 1e-5}}, 0.154, 1.0).force_at_depths(depths, branches, plain));
    ASSERT_TRUE(DropImpact<FitDual>(KuwabaraKonoNormal<FitDual>{{FitDual::variable(8.5e6, 0), FitDual(1e-5)}},
                                    FitDual(0.154), FitDual(1.0))
                    .force_at_depths(depths, branches, dual));
    for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_EQ(dual[i].value, plain[i]) << i;
    // Deeper than the impact goes, it is the spring's.
    EXPECT_NEAR(plain[3], 8.5e6 * std::pow(1e-3, 1.5), 1e-6);
    EXPECT_NEAR(dual[3].gradient[0] * 8.5e6, plain[3], 1e-6);
}

TEST(Drop, CannotBeFollowedWhereItsNumbersAreTooFarApart) {
    EXPECT_FALSE(DropImpact<double>(HertzNormal<>{1e300}, 1e-200, 1e-200).speed_out().has_value());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(DropImpact<double>(LinearNormal<>{1e5, nan}, 1, 1).speed_out().has_value());
}

}  // namespace
}  // namespace footfall
