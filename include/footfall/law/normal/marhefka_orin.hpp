// Marhefka & Orin's form of Hunt & Crossley's force: the damping is a multiple of the stiffness.
//
//   f = k z^n (1 + (3/2) alpha zdot),   that is   lambda = (3/2) alpha k
//
// Units: k N/m^n, alpha s/m. Stored energy: k z^(n+1) / (n+1). Dissipated power: (3/2) alpha k z^n zdot^2.
// Source: Marhefka & Orin 1999. The force is Hunt & Crossley's with p = n, q = 1. What is theirs is alpha, the slope of
// restitution against speed, e = 1 - alpha zdot_in for slow impacts, and the solution in the phase plane for any speed,
// which shows that e depends on alpha zdot_in alone, not on k, n or the mass, and that an impact never pulls.
// It cannot represent e(v) that falls more slowly than linearly (as measured, as v^(1/5)), adhesion, or plasticity.
#pragma once

#include <array>

#include "footfall/law/normal/hunt_crossley.hpp"
#include "footfall/law/normal/restated.hpp"

namespace footfall {

/// The parameters of MarhefkaOrinNormal.
template <class S>
struct MarhefkaOrinParameters {
    using value_type = S;

    S stiffness;   ///< k [N/m^n], > 0
    S alpha;       ///< -de/dv for slow impacts [s/m], >= 0. Marhefka & Orin 1999.
    S n = S(1.5);  ///< exponent of the depth, > 0

    /// lambda [N s/m^(n+1)]. Marhefka & Orin 1999.
    [[nodiscard]] constexpr S damping() const noexcept { return S(1.5) * alpha * stiffness; }

    /// The same law in Hunt & Crossley's parameters.
    [[nodiscard]] constexpr HuntCrossleyNormal<S> restated() const noexcept {
        return {stiffness, damping(), n, n, S(1)};
    }

    template <class T>
    [[nodiscard]] constexpr RestatedNormal<MarhefkaOrinParameters<T>> cast() const noexcept {
        return {{T(stiffness), T(alpha), T(n)}};
    }

    static constexpr LawDescription description{
        .name = "marhefka-orin",
        .formula = "f = max(k z^n (1 + 1.5 alpha zdot), 0); by default n = 1.5",
        .source = "Marhefka & Orin 1999; hunt-crossley with lambda = 1.5 alpha k, p = n, q = 1",
        .limits = "restitution falls linearly with speed from rest on; no adhesion, no plasticity"};

    static constexpr auto parameters() noexcept {
        using Law = RestatedNormal<MarhefkaOrinParameters<S>>;
        return std::array{
            Parameter<Law>{"stiffness", "k", "N/m^n", &Law::stiffness, "normal stiffness", "", {}, true},
            Parameter<Law>{"alpha", "alpha", "s/m", &Law::alpha, "slope of restitution, e = 1 - alpha v",
                           "elastic, restitution 1"},
            Parameter<Law>{"n", "n", "1", &Law::n, "exponent of the depth in spring and damper", "", 1.5}};
    }
};

template <class S = double>
using MarhefkaOrinNormal = RestatedNormal<MarhefkaOrinParameters<S>>;

}  // namespace footfall
