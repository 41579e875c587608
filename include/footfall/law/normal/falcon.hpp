// Hertz's spring with a damper of a free power of the depth.
//
//   f = K_n z^(3/2) + D z^b zdot
//
// Units: K_n N/m^1.5, D N s/m^(1+b), b 1. Stored energy: (2/5) K_n z^(5/2). Dissipated power: D z^b zdot^2.
// Source: Falcon, Laroche, Fauve & Coste 1998, Behavior of one inelastic ball bouncing repeatedly off the ground,
// Eur. Phys. J. B 3, 45. Azad & Featherstone 2010 cite it for Hertz's spring with another type of damping.
// Choice: the exponent b has not been checked against that text, so it is a parameter. By dimensions 1 - e goes as
// v^((4b - 1)/5): b = 1/4, the default, is the exponent with which restitution does not depend on the speed; b = 1/2 is
// the viscoelastic sphere, b = 3/2 Hunt & Crossley's law (2), b = 0 a plain dashpot.
// It is Hunt & Crossley's (1) with n = 3/2, p = b, q = 1, and computed there.
// It cannot represent adhesion or plasticity; for b = 0 the force jumps to D zdot at touchdown. For b < 1/2 the force
// over s has no limit there.
#pragma once

#include <array>

#include "footfall/law/normal/hunt_crossley.hpp"
#include "footfall/law/normal/restated.hpp"

namespace footfall {

/// The parameters of FalconNormal.
template <class S>
struct FalconParameters {
    using value_type = S;

    S stiffness;           ///< K_n, normal stiffness [N/m^1.5], > 0
    S damping;             ///< D, normal damping [N s/m^(1+b)], >= 0
    S exponent = S(0.25);  ///< b, exponent of the depth in the damper, >= 0

    /// The same law in Hunt & Crossley's parameters.
    [[nodiscard]] constexpr HuntCrossleyNormal<S> restated() const noexcept {
        return {stiffness, damping, S(1.5), exponent, S(1)};
    }

    template <class T>
    [[nodiscard]] constexpr RestatedNormal<FalconParameters<T>> cast() const noexcept {
        return {{T(stiffness), T(damping), T(exponent)}};
    }

    static constexpr LawDescription description{
        .name = "falcon",
        .formula = "f = max(K_n z^1.5 + D z^b zdot, 0); by default b = 0.25",
        .source = "Falcon, Laroche, Fauve & Coste 1998; the exponent b is a choice, left free",
        .limits = "no adhesion, no plasticity; 1 - e goes as v^((4b-1)/5), for b = 0.25 not with the speed"};

    static constexpr auto parameters() noexcept {
        using Law = RestatedNormal<FalconParameters<S>>;
        return std::array{
            Parameter<Law>{"stiffness", "K_n", "N/m^1.5", &Law::stiffness, "normal stiffness", ""},
            Parameter<Law>{
                "damping", "D", "N s/m^(1+b)", &Law::damping, "normal damping", "elastic, restitution 1", {}, true},
            Parameter<Law>{"exponent", "b", "1", &Law::exponent, "exponent of the depth in the damper",
                           "the damper acts at full strength from touchdown on", 0.25}};
    }
};

template <class S = double>
using FalconNormal = RestatedNormal<FalconParameters<S>>;

}  // namespace footfall
