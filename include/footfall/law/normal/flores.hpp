// Flores et al.'s force: Hunt & Crossley's with the damping that a given restitution asks for, also far from 1.
//
//   f = K z^n (1 + (8/5) (1 - e)/e zdot / zdot_in),   that is   chi = 8 K (1 - e) / (5 e zdot_in)
//
// Units, energy, the bound on chi and what it cannot represent: damped_for_restitution.hpp.
// Source: Flores, Machado, Silva & Martins 2011.
// chi is derived from approximate losses of the two phases, so e is met to 0.05: e = 0.9 gives 0.894,
// e = 0.5 gives 0.470, e = 0.2 gives 0.156, whatever n is. Restitution does not depend on the speed.
#pragma once

#include "footfall/law/normal/damped_for_restitution.hpp"

namespace footfall {

/// What is Flores et al.'s own.
struct FloresDamping {
    /// chi [N s/m^(n+1)] for K [N/m^n], e and zdot_in [m/s]. Flores et al. 2011.
    template <class S>
    [[nodiscard]] static constexpr S chi(const S& K, const S& e, const S& zdot_in) noexcept {
        return S(8) * K * (S(1) - e) / (S(5) * e * zdot_in);
    }

    static constexpr LawDescription description{
        .name = "flores",
        .formula = "f = max(K z^n (1 + 1.6 (1 - e)/e zdot/zdot_in), 0); by default n = 1.5",
        .source = "Flores, Machado, Silva & Martins 2011",
        .limits = "meets e to 0.05; the same restitution at every speed"};
};

template <class S = double>
using FloresNormal = RestatedNormal<DampedForRestitution<FloresDamping, S>>;

}  // namespace footfall
