// A linear spring and damper under the sphere.
//
//   f = k z + d zdot
//
// Units: k N/m, d N s/m, f N. Stored energy: k z^2 / 2. Dissipated power: d zdot^2.
// Source: Featherstone 2008, Rigid Body Dynamics Algorithms, section 11.8.
// It cannot represent the growth of the contact area: the force jumps to d zdot at touchdown.
#pragma once

#include <array>

#include "footfall/law/normal/normal_force.hpp"
#include "footfall/law/parameter.hpp"
#include "footfall/math/scalar.hpp"

namespace footfall {

template <class S = double>
struct LinearNormal {
    using value_type = S;

    S stiffness;  ///< k, normal stiffness [N/m], > 0. Featherstone 2008, section 11.8.
    S damping;    ///< d, normal damping [N s/m], >= 0. Featherstone 2008, section 11.8.

    /// f / s^Over before the clamp, s = sqrt(z).
    template <int Over = 0>
    [[nodiscard]] constexpr NormalForce<S> force(const S& s, const S& z_rate) const noexcept {
        return {stiffness * power<2 - Over>(s), damping * z_rate * power<-Over>(s)};
    }

    /// The unclamped force: it starts at d zdot.
    [[nodiscard]] constexpr S load(const S& s, const S& z_rate) const noexcept {
        return stiffness * s * s + damping * z_rate;
    }

    /// Energy in the normal spring [J].
    [[nodiscard]] constexpr S stored_energy(const S& s) const noexcept { return S(0.5) * stiffness * power<4>(s); }

    template <class T>
    [[nodiscard]] constexpr LinearNormal<T> cast() const noexcept {
        return {T(stiffness), T(damping)};
    }

    static constexpr LawDescription description{.name = "linear",
                                                .formula = "f = max(k z + d zdot, 0)",
                                                .source = "Featherstone 2008, section 11.8",
                                                .limits = "the force jumps to d zdot at touchdown"};

    static constexpr auto parameters() noexcept {
        using Law = LinearNormal<S>;
        return std::array{
            Parameter<Law>{"stiffness", "k", "N/m", &Law::stiffness, "normal stiffness", ""},
            Parameter<Law>{"damping", "d", "N s/m", &Law::damping, "normal damping", "elastic, restitution 1"}};
    }
};

}  // namespace footfall
