// The paper's normal force: a uniform distribution of nonlinear spring-damper pairs under a sphere.
//
//   f = K_n z^(3/2) + D_n z^(1/2) zdot                                                            (13)
//
// Units: z m, zdot m/s, K_n N/m^1.5, D_n N s/m^1.5, f N.
// Stored energy: (2/5) K_n z^(5/2)                                                                (17)
// Dissipated power: f_D zdot, f_D the second term                                                 (16)
// The clamp f >= 0 of (14) is applied by Pair, for every normal law alike.
// It cannot represent adhesion, plasticity, or z comparable with the radius (area (7), not (6)).
// The same law as Kuwabara & Kono (1987) and Brilliantov et al. (1996), with D_n = (3/2) A K_n.
#pragma once

#include <array>

#include "footfall/law/normal/normal_force.hpp"
#include "footfall/law/parameter.hpp"
#include "footfall/math/scalar.hpp"

namespace footfall {

template <class S = double>
struct AzadFeatherstoneNormal {
    using value_type = S;

    S stiffness;  ///< K_n, normal stiffness [N/m^1.5], > 0. Azad & Featherstone 2010, (10).
    S damping;    ///< D_n, normal damping [N s/m^1.5], >= 0. Azad & Featherstone 2010, (12).

    /// f / s^Over before the clamp, s = sqrt(z) the root of the depth: regular at touchdown for Over = 1.
    template <int Over = 0>
    [[nodiscard]] constexpr NormalForce<S> force(const S& s, const S& z_rate) const noexcept {
        const S &K_n = stiffness, &D_n = damping;
        return {.elastic = K_n * power<3 - Over>(s),                // (10)
                .dissipative = D_n * power<1 - Over>(s) * z_rate};  // (12)
    }

    /// The unclamped force over its leading power of s: it changes sign where the force does, also at s = 0.
    [[nodiscard]] constexpr S load(const S& s, const S& z_rate) const noexcept {
        return stiffness * s * s + damping * z_rate;
    }

    /// Energy in the normal spring [J]. (17)
    [[nodiscard]] constexpr S stored_energy(const S& s) const noexcept {
        return S(2.0 / 5.0) * stiffness * power<5>(s);
    }

    template <class T>
    [[nodiscard]] constexpr AzadFeatherstoneNormal<T> cast() const noexcept {
        return {T(stiffness), T(damping)};
    }

    static constexpr LawDescription description{.name = "azad-featherstone",
                                                .formula = "f = max(K_n z^1.5 + D_n z^0.5 zdot, 0)",
                                                .source = "Azad & Featherstone 2010, (13), (14)",
                                                .limits = "no adhesion, no plasticity; depth small beside the radius"};

    static constexpr auto parameters() noexcept {
        using Law = AzadFeatherstoneNormal<S>;
        return std::array{Parameter<Law>{"stiffness", "K_n", "N/m^1.5", &Law::stiffness, "normal stiffness", ""},
                          Parameter<Law>{"damping", "D_n", "N s/m^1.5", &Law::damping, "normal damping",
                                         "elastic: Hertz's law, restitution 1"}};
    }
};

}  // namespace footfall
