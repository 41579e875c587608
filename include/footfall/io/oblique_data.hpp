// A measured curve of oblique impacts from a table: docs/tables.md.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "footfall/io/table_input.hpp"
#include "footfall/study/oblique.hpp"

namespace footfall {

struct ObliqueData {
    ObliqueMeasurement measured;
    /// The table has the speeds or spins in units of the coefficient of friction, that of the sphere's law: it cannot
    /// be fitted to them.
    bool needs_coefficient = false;
    TableRemarks remarks;
};

/// How the angle [rad] and the spin [rad/s] of a row become an approach.
using MakeApproach = std::function<Approach(double angle, double spin)>;

/// Reads how spheres came in, and one thing that was measured of each. They came in at an angle (in degrees where the
/// table has no unit), with a spin [rad/s], or both; or as psi1 = V/(mu V_n) says; or, with a spin alone, as
/// spin_ratio = 3.5 mu (1 + e) V_n/V says. Measured is one column of oblique_table, psi2 = V'/(mu V_n), or
/// scaled_spin_after = r omega'/(mu V_n). Throws ScenarioError with every problem at its line and column (BadRows where
/// only rows are bad), InvalidInput, or std::system_error where the file cannot be read.
[[nodiscard]] ObliqueData load_oblique_data(const std::filesystem::path& file, const ObliqueSphere& sphere,
                                            const MakeApproach& approach, const TableInput& input = {});

}  // namespace footfall
