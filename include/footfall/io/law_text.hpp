// A law in one line, for command lines: "azad-featherstone:stiffness=8.5e6,damping=3.1 kN s/m^1.5".
#pragma once

#include <string>
#include <string_view>

#include "footfall/law/registry.hpp"
#include "footfall/math/error.hpp"

namespace footfall {

/// Reads "NAME:key=value,key=value": a registered law and its parameters, each a number in SI units or with a unit. A
/// parameter with a default may be left out. Throws InvalidInput with the nearest name or key, or the allowed range.
[[nodiscard]] NormalLaw parse_normal_law(std::string_view text);
[[nodiscard]] FrictionLaw parse_friction_law(std::string_view text);

/// The law as those read it, every parameter with enough digits to read back exactly.
[[nodiscard]] std::string law_text(const NormalLaw& law);
[[nodiscard]] std::string law_text(const FrictionLaw& law);

}  // namespace footfall
