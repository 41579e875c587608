// Elastic constants and densities of common materials, each with its source.
//
// They are typical values at room temperature. Alloys, fillers and heat treatment move them by several per cent,
// polymers, rubber and cork by much more: measure where it matters.
#pragma once

#include <span>
#include <string_view>

#include "footfall/material/material.hpp"

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

/// Every preset, in order of name.
[[nodiscard]] std::span<const MaterialPreset> material_presets() noexcept;

/// The preset of that name. Throws InvalidInput, listing the names.
[[nodiscard]] const MaterialPreset& material_preset(std::string_view name);

}  // namespace footfall
