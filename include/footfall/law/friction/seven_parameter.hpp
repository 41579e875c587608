// The seven-parameter law: a spring before sliding; then Coulomb, viscous and Stribeck friction with memory, and a
// static friction that grows with the time of rest.
//
//   stick:  F_f = -F_n sigma_0 u,                         udot = V,    |u| < level/sigma_0
//   slip:   F_f = -F_n (sigma_0 u + sigma_2 V_clutch),    |u| = level/sigma_0,
//                                                         V_clutch = V - udot = u^ (u^.V - d|u|/dt)
//
//   level = mu_k + f_s/(1 + (v_l/v_s)^2),                 tau_L dv_l/dt = |V| - v_l,   u^ = u/|u|
//   f_s = f_a + (f_inf - f_a) t_2/(t_2 + gamma)
//
// States: u (2) [m], v_l (the lagged speed) [m/s], f_a [1], t_2 (the time of rest) [s]. Units: sigma_0 1/m, mu_k and
// f_inf 1, sigma_2 s/m, v_s m/s, tau_L and gamma s.
//
// Source: Armstrong-Helouvry, Dupont & Canudas de Wit 1994, A survey of models, analysis tools and compensation methods
// for the control of machines with friction, Automatica 30:1083, its seven parameters: k_t, F_C, F_v, F_s,inf, v_s,
// tau_L, gamma, in that order sigma_0, mu_k, sigma_2, f_inf, v_s, tau_L, gamma over the load.
//
// Choices, where the source leaves the switching open (Olsson et al. 1998, European J. Control 4:176, say so):
//
//  - Frictional memory is a pure delay of the speed by tau_L in the source, which no ordinary differential equation
//    has. Here it is a first-order lag with the time constant tau_L: the same delay for slow changes.
//  - It lets go where the spring reaches the level, and takes hold where the clutch comes to a stop. The spring still
//    stretches then, as fast as the lag lets the level rise, and the lag goes on: forgotten at once, it would leave the
//    spring at a level that no longer rises, and the clutch would let go in the moment in which it took hold.
//  - It is at rest from where the spring stops stretching, u^.V = 0. Then t_2 = v_l = 0, and f_a is the Stribeck
//  friction
//    of that moment, f_s/(1 + (v_l/v_s)^2): the level is the same, and grows with the rest. A new contact has not
//    rested: f_a = 0.
//  - In the plane, and to join the two parts without a jump, the sliding force is that of a spring held on the circle
//    of radius level/sigma_0, in series with the clutch: in steady sliding it is opposite to V.
//
// Stored: w = (1/2) sigma_0 |u|^2. Dissipated over F_n: (level u^ + sigma_2 V).V_clutch in the clutch, >= 0 as long as
// the viscous force is below the level. No damper.
//
// It cannot represent a loss before sliding: a body at rest swings on the spring for ever, but for other losses.
#pragma once

#include <algorithm>
#include <limits>

#include "footfall/law/friction/rate_friction.hpp"
#include "footfall/math/value_of.hpp"

namespace footfall {

template <class S = double>
struct SevenParameterFriction {
    using value_type = S;
    static constexpr int states = 5;
    static constexpr int vector_states = 1;  ///< of the plane (law/turn.hpp)
    static constexpr Phase first_phase = Phase::stick;
    /// The speed below which the spring counts as standing, over v_s [1]: far above rounding, far below what tells.
    static constexpr double resting_share = 1e-9;

    S stiffness;             ///< sigma_0, stiffness before sliding over the load [1/m], > 0
    S kinetic_coefficient;   ///< mu_k, Coulomb friction [1], > 0
    S stribeck_coefficient;  ///< f_inf, static above Coulomb friction after a long rest [1], >= 0
    S stribeck_velocity;     ///< v_s [m/s], > 0
    S memory_time;           ///< tau_L, lag of the Stribeck friction behind the speed [s], > 0
    S rise_time;             ///< gamma, time of rest after which half of the static friction has come back [s], > 0
    S viscous = S(0);        ///< sigma_2, viscous friction over the load [s/m], >= 0

    [[nodiscard]] RateResponse<S> respond(Phase phase, const Vector2<S>& V, FrictionStates<S> x,
                                          std::span<S> rate) const noexcept {
        const Vector2<S> u = vector_at<S>(x);
        Vector2<S> V_clutch = Vector2<S>::Zero();
        rate[at_hold] = S(0);
        rate[lagged_speed] = at_rest(phase, x) ? S(0) : lag_rate(V, x);
        rate[rest] = at_rest(phase, x) ? S(1) : S(0);
        if (phase == Phase::slip) V_clutch = u / length_of(u) * clutch_speed(V, x);
        const Vector2<S> u_rate = V - V_clutch;
        put_vector(rate, 0, u_rate);
        return {-(stiffness * u + viscous * V_clutch), stiffness * u.dot(u_rate), S(0)};
    }

    [[nodiscard]] S stored(Phase, FrictionStates<S> x) const noexcept {
        return S(0.5) * stiffness * vector_at<S>(x).squaredNorm();
    }

    /// What the spring bears, over the load [1].
    [[nodiscard]] S level(FrictionStates<S> x) const noexcept { return kinetic_coefficient + static_part(x) / fall(x); }

    /// While it sticks a length [m], while it slips a speed [m/s].
    [[nodiscard]] S margin(Phase phase, const Vector2<S>& V, FrictionStates<S> x) const noexcept {
        if (phase == Phase::slip) return clutch_speed(V, x);
        const S below_level = below(x);
        return at_rest(phase, x) ? below_level : std::min(below_level, S(memory_time * stretching(V, x)));
    }

    [[nodiscard]] Phase jump(Phase phase, const Vector2<S>& V, std::span<S> x) const noexcept {
        if (phase == Phase::slip) {
            // On the level, but for what the integration has lost, and not beyond it by rounding.
            constexpr double inside = 1 - 8 * std::numeric_limits<double>::epsilon();
            put_on_level(x, S(inside));
            if (stands(V, x)) come_to_rest(x);
            return Phase::stick;
        }
        if (!at_rest(phase, x) && stands(V, x)) {
            come_to_rest(x);
            return Phase::stick;
        }
        put_on_level(x, S(1));
        return Phase::slip;
    }

    [[nodiscard]] double state_size(int i) const noexcept {
        switch (static_cast<std::size_t>(i)) {
            case lagged_speed:
                return static_cast<double>(value_of(stribeck_velocity));
            case at_hold:
                return static_cast<double>(value_of(kinetic_coefficient));
            case rest:
                return static_cast<double>(value_of(rise_time));
            default:
                return static_cast<double>(value_of(kinetic_coefficient / stiffness));
        }
    }

    /// A viscous force above the level may push on while the level falls.
    [[nodiscard]] bool clutch_only_takes() const noexcept { return !(viscous > S(0)); }

    template <class T>
    [[nodiscard]] constexpr SevenParameterFriction<T> cast() const noexcept {
        return {T(stiffness),
                T(kinetic_coefficient),
                T(stribeck_coefficient),
                T(stribeck_velocity),
                T(memory_time),
                T(rise_time),
                T(viscous)};
    }

    static constexpr LawDescription description{
        .name = "seven-parameter",
        .formula =
            "stick: F_f = -F_n sigma_0 u up to mu_k + f_s; slip: mu_k + f_s/(1 + (v_l/v_s)^2) + sigma_2 V; "
            "f_s = f_a + (f_inf - f_a) t/(t + gamma) with the time of rest; v_l lags |V| by tau_L",
        .source = "Armstrong-Helouvry, Dupont & Canudas de Wit 1994, over the load; a first-order lag for its delay",
        .limits = "no loss before sliding, so that a body swings on the spring for ever"};

    static constexpr auto parameters() noexcept {
        using Law = SevenParameterFriction<S>;
        return std::array{
            Parameter<Law>{"stiffness", "sigma_0", "1/m", &Law::stiffness, "stiffness before sliding over the load",
                           ""},
            Parameter<Law>{"kinetic_coefficient", "mu_k", "1", &Law::kinetic_coefficient,
                           "coefficient of Coulomb friction", ""},
            Parameter<Law>{"stribeck_coefficient", "f_inf", "1", &Law::stribeck_coefficient,
                           "static above Coulomb friction after a long rest", "no static friction above Coulomb's"},
            Parameter<Law>{"stribeck_velocity", "v_s", "m/s", &Law::stribeck_velocity,
                           "speed at which half of the static friction has gone", ""},
            Parameter<Law>{"memory_time", "tau_L", "s", &Law::memory_time, "lag of friction behind the speed", ""},
            Parameter<Law>{"rise_time", "gamma", "s", &Law::rise_time,
                           "time of rest in which half of the static friction comes back", ""},
            Parameter<Law>{"viscous", "sigma_2", "s/m", &Law::viscous, "viscous friction over the load",
                           "no viscous friction", 0.0}};
    }

private:
    static constexpr std::size_t lagged_speed = 2, at_hold = 3, rest = 4;

    /// Whether it sticks and the lag is over. Before, the lagged speed is above zero; at rest it is none.
    [[nodiscard]] static bool at_rest(Phase phase, FrictionStates<S> x) noexcept {
        return phase != Phase::slip && !(x[lagged_speed] > S(0));
    }
    void put_on_level(std::span<S> x, const S& share) const noexcept {
        const Vector2<S> u = vector_at<S>(x);
        put_vector(x, 0, Vector2<S>(u * (share * level(x) / (stiffness * length_of(u)))));
    }
    void come_to_rest(std::span<S> x) const noexcept {
        x[at_hold] = static_part(x) / fall(x);
        x[rest] = x[lagged_speed] = S(0);
    }
    /// u^.V [m/s].
    [[nodiscard]] static S stretching(const Vector2<S>& V, FrictionStates<S> x) noexcept {
        const Vector2<S> u = vector_at<S>(x);
        return u.dot(V) / length_of(u);
    }
    [[nodiscard]] bool stands(const Vector2<S>& V, FrictionStates<S> x) const noexcept {
        return !(stretching(V, x) > S(resting_share) * stribeck_velocity);
    }
    /// By how much the spring is shorter than what the level stretches it to [m].
    [[nodiscard]] S below(FrictionStates<S> x) const noexcept {
        return level(x) / stiffness - length_of(vector_at<S>(x));
    }
    /// f_s.
    [[nodiscard]] S static_part(FrictionStates<S> x) const noexcept {
        return x[at_hold] + (stribeck_coefficient - x[at_hold]) * x[rest] / (x[rest] + rise_time);
    }
    /// 1 + (v_l/v_s)^2, by which the static part falls while it slides.
    [[nodiscard]] S fall(FrictionStates<S> x) const noexcept {
        const S ratio = x[lagged_speed] / stribeck_velocity;
        return S(1) + ratio * ratio;
    }
    [[nodiscard]] S lag_rate(const Vector2<S>& V, FrictionStates<S> x) const noexcept {
        return (length_of(V) - x[lagged_speed]) / memory_time;
    }
    /// u^.V - d|u|/dt while |u| = level/sigma_0.
    [[nodiscard]] S clutch_speed(const Vector2<S>& V, FrictionStates<S> x) const noexcept {
        const S f = fall(x);
        const S level_rate = -static_part(x) / (f * f) * S(2) * x[lagged_speed] * lag_rate(V, x) /
                             (stribeck_velocity * stribeck_velocity);
        return stretching(V, x) - level_rate / stiffness;
    }
};

}  // namespace footfall
