// Hertz's elastic force between a sphere and a plane.
//
//   f = K_n z^(3/2)
//
// Units: z m, K_n N/m^1.5, f N. Stored energy: (2/5) K_n z^(5/2). Nothing is dissipated: restitution 1.
// Source: Hertz 1882; Johnson 1985, Contact Mechanics, section 4.2. K_n = (4/3) E* sqrt(r), (10).
// It cannot represent any loss, adhesion, plasticity, or z comparable with the radius.
#pragma once

#include <array>

#include "footfall/law/normal/normal_force.hpp"
#include "footfall/law/parameter.hpp"
#include "footfall/math/scalar.hpp"

namespace footfall {

template <class S = double>
struct HertzNormal {
    using value_type = S;

    S stiffness;  ///< K_n, normal stiffness [N/m^1.5], > 0. Johnson 1985, section 4.2.

    /// f / s^Over, s = sqrt(z).
    template <int Over = 0>
    [[nodiscard]] constexpr NormalForce<S> force(const S& s, const S& /*z_rate*/) const noexcept {
        return {stiffness * power<3 - Over>(s), S(0)};
    }

    /// The force over its leading power of s: it never changes sign, so contact ends at z = 0.
    [[nodiscard]] constexpr S load(const S& /*s*/, const S& /*z_rate*/) const noexcept { return stiffness; }

    /// Energy in the normal spring [J].
    [[nodiscard]] constexpr S stored_energy(const S& s) const noexcept { return S(2) * stiffness * power<5>(s) / S(5); }

    template <class T>
    [[nodiscard]] constexpr HertzNormal<T> cast() const noexcept {
        return {T(stiffness)};
    }

    static constexpr LawDescription description{.name = "hertz",
                                                .formula = "f = K_n z^1.5",
                                                .source = "Hertz 1882; Johnson 1985, section 4.2",
                                                .limits = "elastic: no loss at all; depth small beside the radius"};

    static constexpr auto parameters() noexcept {
        using Law = HertzNormal<S>;
        return std::array{Parameter<Law>{"stiffness", "K_n", "N/m^1.5", &Law::stiffness, "normal stiffness", ""}};
    }
};

}  // namespace footfall
