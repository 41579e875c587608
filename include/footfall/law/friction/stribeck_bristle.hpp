// What LuGre and the elasto-plastic law share: a bristle with a damper, a viscous term beside it, and a Stribeck curve
// that says where the bristle stands while it slides steadily. Their own is how the bristle moves, udot.
//
//   g(V) = mu_k + (mu_s - mu_k) exp(-(|V|/v_s)^2)
//   F_f  = -F_n (sigma_0 u + sigma_1 udot + sigma_2 V)
//
// Numbers: Canudas de Wit, Olsson, Astrom & Lischinsky 1995, (4) and (5). Everything is over the load.
#pragma once

#include <array>
#include <cmath>

#include "footfall/law/friction/rate_friction.hpp"

namespace footfall {

/// g, by which friction falls from its static to its kinetic coefficient as the speed grows [1]. (5)
template <class Law, class S = typename Law::value_type>
[[nodiscard]] S stribeck_curve(const Law& law, const Vector2<S>& V) noexcept {
    using std::exp;
    const S &mu_s = law.static_coefficient, &mu_k = law.kinetic_coefficient, &v_s = law.stribeck_velocity;
    return mu_k + (mu_s - mu_k) * exp(-V.squaredNorm() / (v_s * v_s));
}

/// The response of a bristle u that moves at u_rate. (4)
template <class Law, class S = typename Law::value_type>
[[nodiscard]] RateResponse<S> bristle_response(const Law& law, const Vector2<S>& V, const Vector2<S>& u,
                                               const Vector2<S>& u_rate) noexcept {
    return {-(law.stiffness * u + law.damping * u_rate + law.viscous * V), law.stiffness * u.dot(u_rate),
            law.damping * u_rate.squaredNorm()};
}

/// The parameters of such a law, with its `own` behind those that both have.
template <class Law, class... Own>
[[nodiscard]] constexpr auto stribeck_bristle_parameters(const Own&... own) noexcept {
    return std::array{
        Parameter<Law>{"stiffness", "sigma_0", "1/m", &Law::stiffness, "stiffness of the bristle over the load", ""},
        Parameter<Law>{"damping", "sigma_1", "s/m", &Law::damping, "damping of the bristle over the load",
                       "an undamped bristle"},
        Parameter<Law>{"static_coefficient", "mu_s", "1", &Law::static_coefficient,
                       "coefficient of friction at no speed", ""},
        Parameter<Law>{"kinetic_coefficient", "mu_k", "1", &Law::kinetic_coefficient,
                       "coefficient of friction at high speed", ""},
        Parameter<Law>{"stribeck_velocity", "v_s", "m/s", &Law::stribeck_velocity,
                       "speed over which the one falls to the other", ""},
        Parameter<Law>{"viscous", "sigma_2", "s/m", &Law::viscous, "viscous friction over the load",
                       "no viscous friction", 0.0},
        own...};
}

}  // namespace footfall
