// Elastic constants and densities of common materials, each with its source.
//
// They are typical values at room temperature. Alloys, fillers and heat treatment move them by several per cent,
// polymers, rubber and cork by much more: measure where it matters.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "footfall/material/material.hpp"
#include "footfall/math/error.hpp"

namespace footfall {

/// One material of the table.
struct MaterialPreset {
    std::string_view name;         ///< as on the command line, "cast-iron"
    std::string_view description;  ///< which alloy or grade
    Material material;
    double density = 0;  ///< rho [kg/m^3]
    std::string_view youngs_modulus_source;
    std::string_view poisson_ratio_source;
    std::string_view density_source;
};

namespace detail {

// Callister 2007, Materials Science and Engineering: An Introduction, 7th edition, Wiley, appendix B.
inline constexpr std::string_view callister_E = "Callister 2007, table B.2";
inline constexpr std::string_view callister_nu = "Callister 2007, table B.3";
inline constexpr std::string_view callister_rho = "Callister 2007, table B.1";
inline constexpr std::string_view cork = "Gibson, Easterling & Ashby 1981, Proc. R. Soc. Lond. A 377, 99";
inline constexpr std::string_view incompressible =
    "incompressible: Treloar 1975, The Physics of Rubber Elasticity, chapter 4";
inline constexpr double GPa = 1e9, MPa = 1e6;

inline constexpr std::array material_presets{
    MaterialPreset{"aluminium", "alloy 1100", {69 * GPa, 0.33}, 2710, callister_E, callister_nu, callister_rho},
    MaterialPreset{"aluminium-oxide", "99.9 % pure", {380 * GPa, 0.22}, 3980, callister_E, callister_nu, callister_rho},
    MaterialPreset{
        "brass", "cartridge brass, C26000", {110 * GPa, 0.35}, 8530, callister_E, callister_nu, callister_rho},
    MaterialPreset{"cast-iron",
                   "grey, grade G3000",
                   {101.5 * GPa, 0.26},
                   7300,
                   "Callister 2007, table B.2, the middle of 90 to 113 GPa",
                   callister_nu,
                   callister_rho},
    MaterialPreset{"cork",
                   "natural, pressed along the radius of the tree",
                   {20 * MPa, 0.05},
                   170,
                   cork,
                   "Gibson, Easterling & Ashby 1981, Proc. R. Soc. Lond. A 377, 99, the middle of 0 to 0.10",
                   cork},
    MaterialPreset{"glass", "soda-lime", {69 * GPa, 0.23}, 2500, callister_E, callister_nu, callister_rho},
    MaterialPreset{"lead", "chemical lead", {13.5 * GPa, 0.44}, 11340, callister_E, callister_nu, callister_rho},
    MaterialPreset{"nylon",
                   "nylon 6,6",
                   {2.69 * GPa, 0.39},
                   1140,
                   "Callister 2007, table B.2, the middle of 1.59 to 3.79 GPa",
                   callister_nu,
                   callister_rho},
    MaterialPreset{"polyethylene",
                   "high density",
                   {1.08 * GPa, 0.42},
                   959,
                   callister_E,
                   "Dowling 2013, Mechanical Behavior of Materials, 4th edition, table 5.2",
                   callister_rho},
    MaterialPreset{"rubber",
                   "styrene-butadiene",
                   {6 * MPa, 0.5},
                   940,
                   "Callister 2007, table B.2, the middle of 2 to 10 MPa (secant, at 100 % elongation)",
                   incompressible,
                   callister_rho},
    MaterialPreset{
        "steel", "plain carbon, AISI 1020", {207 * GPa, 0.30}, 7850, callister_E, callister_nu, callister_rho},
};

}  // namespace detail

/// Every preset, in order of name.
[[nodiscard]] inline std::span<const MaterialPreset> material_presets() noexcept { return detail::material_presets; }

/// The preset of that name. Throws InvalidInput, listing the names.
[[nodiscard]] inline const MaterialPreset& material_preset(std::string_view name) {
    std::string names;
    for (const MaterialPreset& preset : material_presets()) {
        if (preset.name == name) return preset;
        names += (names.empty() ? "" : ", ") + std::string(preset.name);
    }
    throw InvalidInput("unknown material '" + std::string(name) + "'. There are " + names);
}

}  // namespace footfall
