// The collision of viscoelastic spheres: the paper's law with its damping given as a time.
//
//   f = K_n (z^(3/2) + (3/2) A z^(1/2) zdot)
//
// Units: z m, zdot m/s, K_n N/m^1.5, A s, f N. Stored energy and dissipated power: azad_featherstone.hpp.
// Source: Kuwabara & Kono 1987; Brilliantov, Spahn, Hertzsch & Poeschel 1996, whose A this is: the ratio of the
// viscous to the elastic moduli. Azad & Featherstone found the same force in another way; (13) is this law with
// D_n = (3/2) A K_n, so it is computed there and not a second time here.
// The sources let the spheres pull on each other at the end; here the clamp (14) ends the contact at zero force, as in
// Schwager & Poeschel 2008.
// It cannot represent adhesion or plasticity, nor impacts so fast that stress waves matter (quasi-static material).
#pragma once

#include <array>

#include "footfall/law/normal/azad_featherstone.hpp"
#include "footfall/law/normal/restated.hpp"

namespace footfall {

/// The parameters of KuwabaraKonoNormal.
template <class S>
struct KuwabaraKonoParameters {
    using value_type = S;

    S stiffness;     ///< K_n, normal stiffness [N/m^1.5], > 0. Brilliantov et al. 1996.
    S damping_time;  ///< A, dissipative parameter [s], >= 0. Brilliantov et al. 1996.

    /// The same law in the paper's parameters.
    [[nodiscard]] constexpr AzadFeatherstoneNormal<S> restated() const noexcept {
        return {stiffness, S(1.5) * damping_time * stiffness};
    }

    template <class T>
    [[nodiscard]] constexpr RestatedNormal<KuwabaraKonoParameters<T>> cast() const noexcept {
        return {{T(stiffness), T(damping_time)}};
    }

    static constexpr LawDescription description{
        .name = "kuwabara-kono",
        .formula = "f = max(K_n (z^1.5 + 1.5 A z^0.5 zdot), 0)",
        .source = "Kuwabara & Kono 1987; Brilliantov et al. 1996; azad-featherstone with D_n = 1.5 A K_n",
        .limits = "no adhesion, no plasticity; depth small beside the radius"};

    static constexpr auto parameters() noexcept {
        using Law = RestatedNormal<KuwabaraKonoParameters<S>>;
        return std::array{Parameter<Law>{"stiffness", "K_n", "N/m^1.5", &Law::stiffness, "normal stiffness", ""},
                          Parameter<Law>{"damping_time", "A", "s", &Law::damping_time,
                                         "dissipative parameter of the material, D_n = 1.5 A K_n",
                                         "elastic: Hertz's law, restitution 1"}};
    }
};

template <class S = double>
using KuwabaraKonoNormal = RestatedNormal<KuwabaraKonoParameters<S>>;

}  // namespace footfall
