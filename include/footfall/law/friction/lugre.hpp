// LuGre: Dahl's bristle with a Stribeck curve, a damper and a viscous term.
//
//   udot = V - sigma_0 |V| u / g(V),   g(V) = mu_k + (mu_s - mu_k) exp(-(|V|/v_s)^2)                (3), (5)
//   F_f  = -F_n (sigma_0 u + sigma_1 udot + sigma_2 V)                                                   (4)
//
// States: u (2) [m]. Units: sigma_0 1/m, sigma_1 and sigma_2 s/m, mu_s and mu_k 1, v_s m/s.
//
// Source: Canudas de Wit, Olsson, Astrom & Lischinsky 1995, A new model for control of systems with friction, IEEE
// Trans. Automatic Control 40:419. Over the load as for tyres (Canudas de Wit & Tsiotras 1999), in the plane as in the
// isotropic case of Velenis, Tsiotras, Canudas de Wit & Sorine 2005, Vehicle System Dynamics 43:3.
//
// Stored: w = (1/2) sigma_0 |u|^2. Dissipated over F_n: sigma_1 |udot|^2 in the damper, and in the clutch
//
//   sigma_0 u.(V - udot) + sigma_1 udot.(V - udot) + sigma_2 |V|^2
//
// of which the second term can be negative, so that the channel of the clutch alone may fall at times. Damper and
// clutch together take, and the law is passive at constant load, where sigma_2 >= sigma_1 (mu_s/mu_k - 1) (Barahanov &
// Ortega 2000, IEEE Trans. Automatic Control 45:830); where that does not hold it makes energy at times.
//
// It cannot represent a limit below which nothing creeps: under a small oscillating force it drifts.
#pragma once

#include "footfall/law/friction/stribeck_bristle.hpp"
#include "footfall/math/value_of.hpp"

namespace footfall {

template <class S = double>
struct LuGreFriction {
    using value_type = S;
    static constexpr int states = 2;

    S stiffness;            ///< sigma_0, stiffness of the bristle over the load [1/m], > 0
    S damping;              ///< sigma_1, damping of the bristle over the load [s/m], >= 0
    S static_coefficient;   ///< mu_s [1], > 0
    S kinetic_coefficient;  ///< mu_k [1], > 0
    S stribeck_velocity;    ///< v_s [m/s], > 0
    S viscous = S(0);       ///< sigma_2, viscous friction over the load [s/m], >= 0

    /// g: the coefficient of friction of steady sliding, without the viscous term. (5)
    [[nodiscard]] S steady(const Vector2<S>& V) const noexcept { return stribeck_curve(*this, V); }

    [[nodiscard]] RateResponse<S> respond(const Vector2<S>& V, FrictionStates<S> x, std::span<S> rate) const noexcept {
        const Vector2<S> u = vector_at<S>(x);
        const Vector2<S> u_rate = V - u * (stiffness * length_of(V) / steady(V));  // (3)
        put_vector(rate, 0, u_rate);
        return bristle_response(*this, V, u, u_rate);  // (4)
    }

    [[nodiscard]] S stored(FrictionStates<S> x) const noexcept {
        return S(0.5) * stiffness * vector_at<S>(x).squaredNorm();
    }

    [[nodiscard]] double state_size(int) const noexcept {
        return static_cast<double>(value_of(kinetic_coefficient / stiffness));
    }

    /// The term of sigma_1 in the clutch has no sign.
    [[nodiscard]] bool clutch_only_takes() const noexcept { return !(damping > S(0)); }

    template <class T>
    [[nodiscard]] constexpr LuGreFriction<T> cast() const noexcept {
        return {T(stiffness),           T(damping),           T(static_coefficient),
                T(kinetic_coefficient), T(stribeck_velocity), T(viscous)};
    }

    static constexpr LawDescription description{
        .name = "lugre",
        .formula =
            "F_f = -F_n (sigma_0 u + sigma_1 udot + sigma_2 V); udot = V - sigma_0 |V| u / g(V); "
            "g = mu_k + (mu_s - mu_k) exp(-(|V|/v_s)^2)",
        .source = "Canudas de Wit, Olsson, Astrom & Lischinsky 1995, (3)-(5), over the load",
        .limits = "drifts under small oscillating forces; not passive for large sigma_1"};

    static constexpr auto parameters() noexcept { return stribeck_bristle_parameters<LuGreFriction>(); }
};

}  // namespace footfall
