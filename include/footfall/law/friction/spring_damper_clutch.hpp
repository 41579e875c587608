// The spring, damper and clutch in series that the paper's friction law and its linear twin share.
//
// Everything is per unit of a scale: sqrt(z) for the paper's law, 1 for the linear one. With
// phi_n = F_n / scale, phi = f_stick / scale = -(K_t u + D_t V)                              (19), (22)
// the law is regular at touchdown, where sqrt(z) = 0.
//
//   stick  |f_stick| <= mu F_n :  F_f = f_stick,  udot = V                                    (26), (32)
//   slip   |f_stick| >  mu F_n :  F_f = mu F_n f_stick/|f_stick| - C_V V_clutch                     (27)
//          V_clutch = V - udot                                                                      (30)
//          udot = -(F_f + scale K_t u) / (scale D_t)                                                (31)
//
// (27), (30) and (31) are implicit in F_f. F_f lies along f_stick, and eliminating V_clutch gives
//
//   |F_f| = (scale D_t mu F_n + C_V |f_stick|) / (scale D_t + C_V)
//
//   V_clutch = -(|f_stick| - mu F_n) / (scale D_t + C_V) f_stick/|f_stick|
//
// which holds with D_t = 0 < C_V too.
// With D_t = C_V = 0 the bristle is an elastic-plastic element: F_f = -scale K_t u stays on the cone,
// |u| = rho = mu phi_n / K_t, so V_clutch = (u.V/|u| - rhodot) u/|u|.
#pragma once

#include <array>
#include <concepts>
#include <string_view>

#include "footfall/law/parameter.hpp"
#include "footfall/math/scalar.hpp"
#include "footfall/math/vector.hpp"

namespace footfall {

/// What a friction law gives in a known phase.
template <class S>
struct FrictionResponse {
    Vector2<S> force;            ///< F_f over the scale
    Vector2<S> bristle_rate;     ///< udot [m/s]
    Vector2<S> clutch_velocity;  ///< V_clutch = V - udot [m/s]. (30)
};

/// Spring, damper and clutch over a scale that is s^ScalePower, s = sqrt(z).
template <class S, int ScalePower_>
struct SpringDamperClutch {
    using value_type = S;
    static constexpr int ScalePower = ScalePower_;
    static constexpr bool has_bristle = true;
    /// Whether ground that joins the patch joins unstrained, so that a depth that grows slackens the bristle.
    static constexpr bool joins_unstrained = false;

    S stiffness;       ///< K_t, tangential stiffness [N/m^1.5 or N/m], > 0. (23) or (19)
    S damping;         ///< D_t, tangential damping [N s/m^1.5 or N s/m], >= 0. (24) or (19)
    S coefficient;     ///< mu, coefficient of friction [1], >= 0. (25)
    S viscous = S(0);  ///< C_V, viscous friction [N s/m], >= 0. (27)

    [[nodiscard]] constexpr S scale(const S& s) const noexcept { return power<ScalePower>(s); }

    /// f_stick over the scale: what the friction would be if the clutch held. (22)
    [[nodiscard, gnu::always_inline]] Vector2<S> stick_force(const Vector2<S>& V, const Vector2<S>& u) const noexcept {
        return -(stiffness * u + damping * V);
    }

    /// mu phi_n - |phi|: how far f_stick is inside the friction cone, over the scale. (26)
    [[nodiscard, gnu::always_inline]] S cone_margin(const S& phi_n, const Vector2<S>& V,
                                                    const Vector2<S>& u) const noexcept {
        return coefficient * phi_n - norm(stick_force(V, u));
    }

    /// Whether the clutch holds; one without a coefficient of friction never does. (26)
    [[nodiscard, gnu::always_inline]] bool holds(const S& phi_n, const Vector2<S>& V,
                                                 const Vector2<S>& u) const noexcept {
        return !(cone_margin(phi_n, V, u) < S(0)) && coefficient > S(0);
    }

    [[nodiscard, gnu::always_inline]] FrictionResponse<S> stick(const Vector2<S>& V,
                                                                const Vector2<S>& u) const noexcept {
        return {stick_force(V, u), V, Vector2<S>::Zero()};  // (26), (32)
    }

    /// The force and bristle rate while the clutch slips. `phi_n_rate` is d(phi_n)/dt; it matters only
    /// where D_t = C_V = 0.
    [[nodiscard, gnu::always_inline]] FrictionResponse<S> slip(const S& scale, const S& phi_n, const S& phi_n_rate,
                                                               const Vector2<S>& V,
                                                               const Vector2<S>& u) const noexcept {
        const S &K_t = stiffness, &D_t = damping, &mu = coefficient, &C_V = viscous;
        if (plastic()) {
            if (!(mu > S(0))) return {Vector2<S>::Zero(), Vector2<S>::Zero(), V};
            const Vector2<S> V_clutch = plastic_clutch_velocity(phi_n_rate, V, u);
            return {-K_t * u, V - V_clutch, V_clutch};
        }
        const Vector2<S> phi = stick_force(V, u);
        const S size = norm(phi);
        if (!(size > S(0))) return {phi, V, Vector2<S>::Zero()};
        const S D_ts = scale * D_t;
        const S per_size = S(1) / ((D_ts + C_V) * size);
        const Vector2<S> force = phi * ((D_ts * mu * phi_n + C_V * size) * per_size);  // (27), (30), (31)
        const Vector2<S> V_clutch = phi * (-scale * (size - mu * phi_n) * per_size);
        // Of (31) and (30), the one that does not cancel: (31) does where the damper carries little.
        constexpr double little = 1e-5;
        const bool by_30 = D_ts < C_V || D_t * norm(V) < S(little) * mu * phi_n;
        return {force, by_30 ? Vector2<S>(V - V_clutch) : Vector2<S>(-(force + K_t * u) / D_t), V_clutch};
    }

    /// Positive while the clutch slips, and zero where it takes hold again.
    [[nodiscard]] S slip_margin([[maybe_unused]] const S& scale, const S& phi_n, const S& phi_n_rate,
                                const Vector2<S>& V, const Vector2<S>& u) const noexcept {
        if (!(coefficient > S(0))) return S(1);
        if (!plastic()) return -cone_margin(phi_n, V, u);
        return plastic_clutch_velocity(phi_n_rate, V, u).dot(direction(V, u));
    }

    /// The bristle as slip begins: on the cone where nothing damps it, unchanged otherwise.
    [[nodiscard]] Vector2<S> enter_slip(const S& phi_n, const Vector2<S>& V, const Vector2<S>& u) const noexcept {
        if (!plastic()) return u;
        return direction(V, u) * (coefficient * phi_n / stiffness);
    }

    /// 1/s, the rate K_t/D_t at which a free bristle recovers; infinite where D_t = 0. (31) with F_f = 0.
    [[nodiscard]] S recovery_rate() const noexcept { return stiffness / damping; }

    /// Energy in the tangential spring, (1/2) K_t scale |u|^2 [J].
    [[nodiscard]] S stored_energy(const S& scale, const Vector2<S>& u) const noexcept {
        return S(0.5) * scale * stiffness * u.squaredNorm();
    }

    /// D_t = C_V = 0: the bristle stays on the cone while it slips.
    [[nodiscard]] constexpr bool plastic() const noexcept { return !(damping > S(0)) && !(viscous > S(0)); }

    static S norm(const Vector2<S>& v) noexcept {
        using std::sqrt;
        const S square = v.squaredNorm();
        if constexpr (std::floating_point<S>) return sqrt(square);
        return square > S(0) ? S(sqrt(square)) : S(0);  // a dual number's root has no derivative at zero
    }

protected:
    /// The parameters of a law that derives from this, in its own symbols and the units that its scale makes.
    template <class Law>
    static constexpr auto parameters_of(std::string_view stiffness_symbol, std::string_view stiffness_unit,
                                        std::string_view damping_symbol, std::string_view damping_unit) noexcept {
        return std::array{
            Parameter<Law>{"stiffness", stiffness_symbol, stiffness_unit, &Law::stiffness, "tangential stiffness", ""},
            Parameter<Law>{"damping", damping_symbol, damping_unit, &Law::damping, "tangential damping",
                           "no presliding loss; with viscous = 0 an elastic-plastic bristle"},
            Parameter<Law>{"coefficient", "mu", "1", &Law::coefficient, "coefficient of friction",
                           "no Coulomb friction; with viscous = 0 no friction at all"},
            Parameter<Law>{"viscous", "C_V", "N s/m", &Law::viscous, "viscous friction while slipping",
                           "Coulomb friction alone", 0.0}};
    }

private:
    /// The way the bristle is stretched, or is about to be.
    static Vector2<S> direction(const Vector2<S>& V, const Vector2<S>& u) noexcept {
        const S length = norm(u);
        if (length > S(0)) return u / length;
        const S speed = norm(V);
        return speed > S(0) ? Vector2<S>(V / speed) : Vector2<S>(V);
    }

    /// V_clutch where D_t = C_V = 0.
    [[nodiscard]] Vector2<S> plastic_clutch_velocity(const S& phi_n_rate, const Vector2<S>& V,
                                                     const Vector2<S>& u) const noexcept {
        const Vector2<S> along = direction(V, u);
        return along * (along.dot(V) - coefficient * phi_n_rate / stiffness);
    }
};

}  // namespace footfall
