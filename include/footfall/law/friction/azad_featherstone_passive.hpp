// The paper's friction, made passive: ground that joins the patch joins unstrained.
//
//   f_stick = -K_t z^(1/2) u - D_t z^(1/2) V                                                        (22)
//   F_f     = f_stick inside the friction cone, else on it, less C_V V_clutch                 (26), (27)
//   udot    = udot_0 - u zdot/(2z)  while z grows,    udot = udot_0  while it shrinks
//
// with udot_0 from (31), or (32) in stick: what damper and clutch see. The tension of the spring is K_t q with
// q = z^(1/2) u: while z grows only the sphere's motion changes it, qdot = z^(1/2) udot_0, for new ground carries
// nothing yet; while z shrinks ground leaves with its share of it, qdot = z^(1/2) udot_0 + q zdot/(2z). At z = 0 there
// is no tension, and no stretch is carried into the next contact. docs/theory.md derives it.
//
// Units: u m, V m/s, K_t N/m^1.5, D_t N s/m^1.5, C_V N s/m. How it is solved: spring_damper_clutch.hpp.
// Stored energy: W = (1/2) K_t z^(1/2) |u|^2 = K_t |q|^2 / (2 z^(1/2)). In both directions the changing patch takes
// (1/4) K_t |zdot| |u|^2 / z^(1/2) of it: strain that is shared with new ground, or leaves with the old.
// Dissipated power: D_t z^(1/2) |udot_0|^2 in the damper (28), -F_f . V_clutch in the clutch.
// It cannot represent the Stribeck effect or a static friction above the kinetic one.
// Departs from its source in udot alone: the paper's own law, whose stiffening makes energy, is azad_featherstone.hpp.
//
// u is the state, not q. q has no quotient at touchdown, but u has none where the ground recovers, and needs no word of
// which way z goes. docs/numerics.md has what that costs, and what a guard at zdot = 0 would.
#pragma once

#include "footfall/law/friction/spring_damper_clutch.hpp"

namespace footfall {

template <class S = double>
struct AzadFeatherstonePassiveFriction : SpringDamperClutch<S, 1> {
    static constexpr bool joins_unstrained = true;

    /// udot - udot_0, the stretch that new ground takes up: -u zdot/(2z) while z grows [m/s].
    [[nodiscard]] Vector2<S> joining_rate(const S& s, const S& z_rate, const Vector2<S>& u) const noexcept {
        if (!(z_rate > S(0)) || !(s > S(0))) return Vector2<S>::Zero();
        return u * S(-z_rate / (S(2) * s * s));
    }

    /// u after dt at this zdot, from this depth, where all the while udot_0 = 0: while z grows q stays, else u does; in
    /// flight nothing is left.
    [[nodiscard]] Vector2<S> joined(const S& s, const S& z_rate, const S& dt, const Vector2<S>& u) const noexcept {
        using std::sqrt;
        const S z = s * s;
        if (!(z > S(0))) return Vector2<S>::Zero();
        if (!(z_rate > S(0))) return u;
        return u * S(sqrt(z / (z + z_rate * dt)));
    }

    /// u after a short time dt of stick: from a touchdown, as z grows from zero, q = integral of z^(1/2) V dt.
    [[nodiscard]] Vector2<S> stretched(const Vector2<S>& u, const Vector2<S>& V, const S& dt) const noexcept {
        return u + V * S(dt * S(2) / S(3));
    }

    /// dW/dt at udot_0 = 0: -(1/4) K_t |zdot| |u|^2 / s. The ledger books P as minus this.
    [[nodiscard]] S stiffening_power(const S& s, const S& z_rate, const Vector2<S>& u) const noexcept {
        const S speed = z_rate < S(0) ? S(-z_rate) : z_rate;
        return S(-0.25) * this->stiffness * speed * u.squaredNorm() / s;
    }

    template <class T>
    [[nodiscard]] constexpr AzadFeatherstonePassiveFriction<T> cast() const noexcept {
        return {{T(this->stiffness), T(this->damping), T(this->coefficient), T(this->viscous)}};
    }

    static constexpr LawDescription description{
        .name = "azad-featherstone-passive",
        .formula =
            "f_stick = -z^0.5 (K_t u + D_t V); on the cone: mu F_n f_stick/|f_stick| - C_V V_clutch; "
            "udot less u zdot/(2z) while z grows",
        .source = "Azad & Featherstone 2010, (22)-(31), with ground that joins the patch unstrained",
        .limits = "no Stribeck effect; the rate of the bristle has a kink at zdot = 0"};

    static constexpr auto parameters() noexcept {
        return SpringDamperClutch<S, 1>::template parameters_of<SpringDamperClutch<S, 1>>("K_t", "N/m^1.5", "D_t",
                                                                                          "N s/m^1.5");
    }
};

}  // namespace footfall
