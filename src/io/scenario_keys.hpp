// The keys of a scenario file.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "footfall/law/registry.hpp"
#include "io/keys.hpp"

namespace footfall::io {

/// What a file has chosen that other keys depend on.
struct Choices {
    std::optional<std::string> normal_law;    ///< of all spheres, as the file names it
    std::optional<std::string> friction_law;  ///< of all spheres, as the file names it
    bool materials = false;                   ///< [contact.material] gives the stiffness and damping
};

/// The whole file.
[[nodiscard]] Table scenario_table(const Choices& choices);

/// Which coefficients of a law [contact.material] gives; none for the laws that materials do not know.
template <class Law>
struct FromMaterial {
    static constexpr bool known = false;
};
template <>
struct FromMaterial<AzadFeatherstoneNormal<double>> {
    static constexpr bool known = true;
};
template <>
struct FromMaterial<AzadFeatherstoneFriction<double>> {
    static constexpr bool known = true;
};
template <>
struct FromMaterial<AzadFeatherstonePassiveFriction<double>> {
    static constexpr bool known = true;
};

/// This parameter is one that [contact.material] gives.
template <class Law, class Owner>
[[nodiscard]] bool from_material(const Parameter<Owner>& parameter) {
    if constexpr (FromMaterial<Law>::known) {
        return parameter.member == &Law::stiffness || parameter.member == &Law::damping;
    } else {
        return false;
    }
}

}  // namespace footfall::io
