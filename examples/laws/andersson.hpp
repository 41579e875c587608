// Andersson, Soderberg & Bjorklund's friction: Coulomb's with a Stribeck curve, rounded off by a hyperbolic tangent. A
// friction law without states.
//
//   F_f = -F_n ((mu_k + (mu_s - mu_k) exp(-(|V|/v_s)^2)) tanh(|V|/v_eps) V/|V| + c V)
//
// Units: mu_s and mu_k 1, v_s and v_eps m/s, c s/m. States: none. Stored: nothing. Dissipated: all of -F_f.V, >= 0, in
// the clutch.
//
// Source: Andersson, Soderberg & Bjorklund 2007, Friction models for sliding dry, boundary and mixed lubricated
// contacts, Tribology International 40:580, with the exponent 2; over the load.
//
// It cannot represent rest under a force: any force, however small, makes it creep. No pre-sliding.
#pragma once

#include <array>
#include <cmath>
#include <span>

#include "footfall/law/friction/rate_friction.hpp"

namespace footfall {

template <class S = double>
struct AnderssonFriction {
    using value_type = S;
    static constexpr int states = 0;

    S static_coefficient;   ///< mu_s [1], > 0
    S kinetic_coefficient;  ///< mu_k [1], > 0
    S stribeck_velocity;    ///< v_s [m/s], > 0
    S rounding_speed;       ///< v_eps [m/s], > 0
    S viscous = S(0);       ///< c [s/m], >= 0

    [[nodiscard]] RateResponse<S> respond(const Vector2<S>& V, FrictionStates<S>, std::span<S>) const noexcept {
        using std::exp;
        const S square = V.squaredNorm();
        const S curve = kinetic_coefficient + (static_coefficient - kinetic_coefficient) *
                                                  exp(-square / (stribeck_velocity * stribeck_velocity));
        return {V * (-(curve * rounding(length_of(V)) + viscous)), S(0), S(0)};
    }
    [[nodiscard]] S stored(FrictionStates<S>) const noexcept { return S(0); }
    [[nodiscard]] double state_size(int) const noexcept { return 1; }

    template <class T>
    [[nodiscard]] constexpr AnderssonFriction<T> cast() const noexcept {
        return {T(static_coefficient), T(kinetic_coefficient), T(stribeck_velocity), T(rounding_speed), T(viscous)};
    }

    static constexpr LawDescription description{
        .name = "andersson",
        .formula = "F_f = -F_n ((mu_k + (mu_s - mu_k) exp(-(|V|/v_s)^2)) tanh(|V|/v_eps) V/|V| + c V)",
        .source = "Andersson, Soderberg & Bjorklund 2007, over the load",
        .limits = "creeps under any force; no pre-sliding"};

    static constexpr auto parameters() noexcept {
        using Law = AnderssonFriction<S>;
        return std::array{Parameter<Law>{"static_coefficient", "mu_s", "1", &Law::static_coefficient,
                                         "coefficient of friction at low speed", ""},
                          Parameter<Law>{"kinetic_coefficient", "mu_k", "1", &Law::kinetic_coefficient,
                                         "coefficient of friction at high speed", ""},
                          Parameter<Law>{"stribeck_velocity", "v_s", "m/s", &Law::stribeck_velocity,
                                         "speed over which the one falls to the other", ""},
                          Parameter<Law>{"rounding_speed", "v_eps", "m/s", &Law::rounding_speed,
                                         "speed over which friction is rounded off", ""},
                          Parameter<Law>{"viscous", "c", "s/m", &Law::viscous, "viscous friction over the load",
                                         "no viscous friction", 0.0}};
    }

private:
    /// tanh(v/v_eps)/v, and its limit at rest.
    [[nodiscard]] S rounding(const S& v) const noexcept {
        using std::tanh;
        return v > S(0) ? S(tanh(v / rounding_speed) / v) : S(S(1) / rounding_speed);
    }
};

static_assert(RateFriction<AnderssonFriction<>>);

}  // namespace footfall
