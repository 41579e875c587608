// Coefficients from materials: Mindlin's tangential stiffness, the presets, everything together.
#include "footfall/material/coefficients.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "footfall/material/presets.hpp"
#include "footfall/math/error.hpp"
#include "math/random_real.hpp"

namespace footfall {
namespace {

using test::decades;
using test::uniform;

RC_GTEST_PROP(Mindlin, RatioOfEqualMaterialsIsTwoTimesOneMinusNuOverTwoMinusNu, ()) {
    // Johnson 1985, (7.44): the tangential stiffness of a contact over its normal one, 8 G* a / (2 E* a).
    const double nu = *uniform(-0.9, 0.5);
    const Material m{*decades(1e5, 1e12), nu};
    const double r = *decades(1e-4, 1);
    const double normal_slope = 1.5 * normal_stiffness(effective_modulus(m, m), r);  // d(K_n z^1.5)/dz over sqrt(z)
    const double ratio = mindlin_tangential_stiffness(effective_shear_modulus(m, m), r) / normal_slope;
    RC_ASSERT(std::abs(ratio - 2 * (1 - nu) / (2 - nu)) < 1e-12);
}

TEST(Mindlin, AddsTheCompliancesOfTwoSides) {
    // Steel (G = 80 GPa, nu = 0.3) on a rigid ground: a half-space under a rigid sphere, 1/G* = (2 - nu)/G.
    const Material steel{208e9, 0.3}, rigid{std::numeric_limits<double>::infinity(), 0};
    EXPECT_NEAR(effective_shear_modulus(steel, rigid) / (80e9 / 1.7), 1, 1e-14);
    EXPECT_NEAR(effective_shear_modulus(steel, steel) / (80e9 / 3.4), 1, 1e-14);
    // Rubber (G = 1 MPa, nu = 0.5) on steel: the rubber gives way.
    const double soft = effective_shear_modulus({3e6, 0.5}, steel);
    EXPECT_NEAR(1 / soft, 1.5 / 1e6 + 1.7 / 80e9, 1e-16);
    EXPECT_THROW((void)effective_shear_modulus(rigid, rigid), InvalidInput);
    EXPECT_THROW((void)effective_shear_modulus({-1, 0.3}, steel), InvalidInput);
    EXPECT_THROW((void)mindlin_tangential_stiffness(0, 1), InvalidInput);
    EXPECT_THROW((void)mindlin_tangential_stiffness(1, -1), InvalidInput);
}

TEST(Mindlin, IsThePapersForAPoissonsRatioOfZero) {
    const Material cork{20e6, 0};
    const auto paper = contact_coefficients(cork, cork, 0.0165, 1e-4, TangentialStiffness::paper);
    const auto mindlin = contact_coefficients(cork, cork, 0.0165, 1e-4, TangentialStiffness::mindlin);
    EXPECT_NEAR(mindlin.tangential_stiffness / paper.tangential_stiffness, 1, 1e-14);
    EXPECT_NEAR(mindlin.tangential_damping / paper.tangential_damping, 1, 1e-14);
}

TEST(ContactCoefficients, OfASteelBallOnSteelAreThoseWorkedByHand) {
    // E* = 210 / (2 * 0.91) GPa = 115.385 GPa; K_n = 4/3 E* 0.1; tau = 2 us.
    const Material steel{210e9, 0.3};
    const auto c = contact_coefficients(steel, steel, 0.01, 2e-6, TangentialStiffness::paper);
    EXPECT_NEAR(c.effective_modulus / 115.3846153846154e9, 1, 1e-14);
    EXPECT_NEAR(c.normal_stiffness / 1.538461538461538e10, 1, 1e-14);
    EXPECT_NEAR(c.normal_damping / 4.615384615384615e4, 1, 1e-14);
    EXPECT_NEAR(c.tangential_stiffness / 2.307692307692308e10, 1, 1e-14);
    EXPECT_NEAR(c.tangential_damping / 4.615384615384615e4, 1, 1e-14);  // (24): D_t = D_n
    EXPECT_NEAR(c.alpha / (4.615384615384615e4 / (4 * std::numbers::pi * 0.01)), 1, 1e-14);
    EXPECT_NEAR(damping_time(c.alpha, c.effective_modulus, 0.01) / 2e-6, 1, 1e-14);
    EXPECT_THROW((void)damping_time(-1, 1e9, 0.01), InvalidInput);
    EXPECT_THROW((void)contact_coefficients(steel, steel, 0.01, -1, TangentialStiffness::paper), InvalidInput);
}

TEST(MaterialPresets, HaveASourceForEveryNumberAndCanBeUsed) {
    std::set<std::string_view> names;
    for (const MaterialPreset& preset : material_presets()) {
        names.insert(preset.name);
        for (const std::string_view source :
             {preset.youngs_modulus_source, preset.poisson_ratio_source, preset.density_source}) {
            EXPECT_NE(source.find_first_of("0123456789"), std::string_view::npos) << preset.name;  // a year
        }
        EXPECT_GT(effective_modulus(preset.material, preset.material), 0) << preset.name;
        EXPECT_GT(preset.density, 100) << preset.name;
        EXPECT_LT(preset.density, 20000) << preset.name;
        EXPECT_EQ(&material_preset(preset.name), &preset);
    }
    EXPECT_EQ(names.size(), material_presets().size());
    for (const char* name : {"steel", "cast-iron", "brass", "lead", "cork", "glass", "aluminium", "aluminium-oxide",
                             "rubber", "nylon", "polyethylene"}) {
        EXPECT_TRUE(names.contains(name)) << name;
    }
    EXPECT_THROW((void)material_preset("unobtainium"), InvalidInput);
}

TEST(MaterialPresets, HaveTheSpeedOfSoundOfTheirMaterial) {
    // sqrt(E / rho) of a thin bar, CRC Handbook of Chemistry and Physics: a slip of a power of ten shows.
    struct Known {
        const char* name;
        double speed;  // m/s
    };
    for (const Known& known : {Known{"steel", 5000}, Known{"aluminium", 5000}, Known{"brass", 3480},
                               Known{"lead", 1210}, Known{"glass", 5200}, Known{"cork", 400}}) {
        const MaterialPreset& preset = material_preset(known.name);
        const double ratio = std::sqrt(preset.material.youngs_modulus / preset.density) / known.speed;
        EXPECT_GT(ratio, 0.75) << known.name;
        EXPECT_LT(ratio, 1.35) << known.name;
    }
}

}  // namespace
}  // namespace footfall
