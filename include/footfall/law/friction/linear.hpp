// The linear twin of the paper's friction: constant stiffness and damping, the same clutch.
//
//   f_stick = -k_t u - b_t V                                                                        (19)
//
// Units: u m, V m/s, k_t N/m, b_t N s/m, C_V N s/m. Stored energy: (1/2) k_t |u|^2.
// Dissipated power: b_t |udot|^2 in the damper, -F_f . V_clutch in the clutch.
// Source: Featherstone 2008, Rigid Body Dynamics Algorithms, section 11.8.
// It cannot represent the growth of the contact area.
#pragma once

#include "footfall/law/friction/spring_damper_clutch.hpp"

namespace footfall {

template <class S = double>
struct LinearFriction : SpringDamperClutch<S, 0> {
    /// The stiffness does not change.
    [[nodiscard]] S stiffening_power(const S&, const S&, const Vector2<S>&) const noexcept { return S(0); }

    template <class T>
    [[nodiscard]] constexpr LinearFriction<T> cast() const noexcept {
        return {{T(this->stiffness), T(this->damping), T(this->coefficient), T(this->viscous)}};
    }

    static constexpr LawDescription description{
        .name = "linear",
        .formula = "f_stick = -k_t u - b_t V; on the cone: mu F_n f_stick/|f_stick| - C_V V_clutch",
        .source = "Featherstone 2008, section 11.8; Azad & Featherstone 2010, (19)",
        .limits = "stiffness and damping do not grow with the contact area"};

    static constexpr auto parameters() noexcept {
        return SpringDamperClutch<S, 0>::template parameters_of<SpringDamperClutch<S, 0>>("k_t", "N/m", "b_t", "N s/m");
    }
};

}  // namespace footfall
