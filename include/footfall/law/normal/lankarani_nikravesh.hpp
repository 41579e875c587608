// Lankarani & Nikravesh's force: Hunt & Crossley's with the damping that a given restitution asks for.
//
//   f = K z^n (1 + (3/4) (1 - e^2) zdot / zdot_in),   that is   chi = 3 K (1 - e^2) / (4 zdot_in)
//
// Units, energy, the bound on chi and what it cannot represent: damped_for_restitution.hpp.
// Source: Lankarani & Nikravesh 1990.
// e is met for e near 1 only, since chi is made from the loss of an impact that loses nothing: e = 0.9 gives 0.913,
// e = 0.5 gives 0.725, and no e gives less than 0.663, whatever n is. Restitution does not depend on the speed.
#pragma once

#include "footfall/law/normal/damped_for_restitution.hpp"

namespace footfall {

/// What is Lankarani & Nikravesh's own.
struct LankaraniNikraveshDamping {
    /// chi [N s/m^(n+1)] for K [N/m^n], e and zdot_in [m/s]. Lankarani & Nikravesh 1990.
    template <class S>
    [[nodiscard]] static constexpr S chi(const S& K, const S& e, const S& zdot_in) noexcept {
        return S(0.75) * K * (S(1) - e * e) / zdot_in;
    }

    static constexpr LawDescription description{
        .name = "lankarani-nikravesh",
        .formula = "f = max(K z^n (1 + 0.75 (1 - e^2) zdot/zdot_in), 0); by default n = 1.5",
        .source = "Lankarani & Nikravesh 1990",
        .limits =
            "meets e only near 1: e = 0.5 gives 0.725, none less than 0.663; the same restitution at every speed"};
};

template <class S = double>
using LankaraniNikraveshNormal = RestatedNormal<DampedForRestitution<LankaraniNikraveshDamping, S>>;

}  // namespace footfall
