// The paper's friction: a nonlinear spring and damper in series with a clutch that slips on the cone.
//
//   f_stick = -K_t z^(1/2) u - D_t z^(1/2) V                                                        (22)
//   F_f     = f_stick inside the friction cone, else on it, less C_V V_clutch                 (26), (27)
//
// Units: u m, V m/s, K_t N/m^1.5, D_t N s/m^1.5, C_V N s/m. How it is solved: spring_damper_clutch.hpp.
// Stored energy: W = (1/2) K_t z^(1/2) |u|^2. Since the stiffness K_t z^(1/2) changes with the depth while
// no force pays for it, (33) is not W: it is W + P, P = -integral of (1/4) K_t zdot |u|^2 / z^(1/2) dt.
// Dissipated power: D_t z^(1/2) |udot|^2 in the damper (28), -F_f . V_clutch in the clutch
// ((29) as printed has the other sign).
// It cannot represent the Stribeck effect or a static friction above the kinetic one.
#pragma once

#include "footfall/law/friction/spring_damper_clutch.hpp"

namespace footfall {

template <class S = double>
struct AzadFeatherstoneFriction : SpringDamperClutch<S, 1> {
    /// dW/dt at constant u: (1/4) K_t zdot |u|^2 / s. The ledger books P as minus this.
    [[nodiscard]] S stiffening_power(const S& s, const S& z_rate, const Vector2<S>& u) const noexcept {
        return S(0.25) * this->stiffness * z_rate * u.squaredNorm() / s;
    }

    template <class T>
    [[nodiscard]] constexpr AzadFeatherstoneFriction<T> cast() const noexcept {
        return {{T(this->stiffness), T(this->damping), T(this->coefficient), T(this->viscous)}};
    }

    static constexpr LawDescription description{
        .name = "azad-featherstone",
        .formula = "f_stick = -z^0.5 (K_t u + D_t V); on the cone: mu F_n f_stick/|f_stick| - C_V V_clutch",
        .source = "Azad & Featherstone 2010, (22)-(31)",
        .limits = "no Stribeck effect; the changing stiffness does work that no force pays for (P)"};

    static constexpr auto parameters() noexcept {
        return SpringDamperClutch<S, 1>::template parameters_of<SpringDamperClutch<S, 1>>("K_t", "N/m^1.5", "D_t",
                                                                                          "N s/m^1.5");
    }
};

}  // namespace footfall
