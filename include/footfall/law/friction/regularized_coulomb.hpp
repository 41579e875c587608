// The regularised Coulomb law of most simulators: Coulomb friction rounded off over a small speed.
//
//   F_f = -mu F_n V / sqrt(|V|^2 + v_eps^2)
//
// States: none. Units: mu 1, v_eps m/s.
//
// Source: one of the common roundings of the sign function (beside tanh(|V|/v_eps) V/|V| and piecewise polynomials);
// reviewed by Marques, Flores, Claro & Lankarani 2016, Nonlinear Dynamics 86:1407, and Pennestri, Rossi, Salvini &
// Valentini 2016, Nonlinear Dynamics 83:1785. This one is smooth in the plane at V = 0 with no case for it.
//
// Stored: nothing. Dissipated over F_n: mu |V|^2 / sqrt(|V|^2 + v_eps^2) in the clutch, >= 0.
//
// It cannot represent rest under a force: any force, however small, makes it creep. No pre-sliding, no stiction.
#pragma once

#include "footfall/law/friction/rate_friction.hpp"

namespace footfall {

template <class S = double>
struct RegularizedCoulombFriction {
    using value_type = S;
    static constexpr int states = 0;

    S coefficient;     ///< mu [1], >= 0
    S rounding_speed;  ///< v_eps, speed at which friction is 1/sqrt(2) of the cone [m/s], > 0

    [[nodiscard]] RateResponse<S> respond(const Vector2<S>& V, FrictionStates<S>, std::span<S>) const noexcept {
        using std::sqrt;
        return {V * (-coefficient / sqrt(V.squaredNorm() + rounding_speed * rounding_speed)), S(0), S(0)};
    }

    [[nodiscard]] S stored(FrictionStates<S>) const noexcept { return S(0); }
    [[nodiscard]] double state_size(int) const noexcept { return 1; }

    template <class T>
    [[nodiscard]] constexpr RegularizedCoulombFriction<T> cast() const noexcept {
        return {T(coefficient), T(rounding_speed)};
    }

    static constexpr LawDescription description{
        .name = "regularized-coulomb",
        .formula = "F_f = -mu F_n V / sqrt(|V|^2 + v_eps^2)",
        .source = "common in simulators; reviewed by Marques, Flores, Claro & Lankarani 2016",
        .limits = "creeps under any force, so nothing ever rests on a slope; no pre-sliding, no stiction"};

    static constexpr auto parameters() noexcept {
        using Law = RegularizedCoulombFriction<S>;
        return std::array{Parameter<Law>{"coefficient", "mu", "1", &Law::coefficient, "coefficient of friction",
                                         "no friction at all"},
                          Parameter<Law>{"rounding_speed", "v_eps", "m/s", &Law::rounding_speed,
                                         "speed over which friction is rounded off", ""}};
    }
};

}  // namespace footfall
