// Lankarani & Nikravesh's force: Hunt & Crossley's with the damping that a given restitution asks for.
//
//   f = K z^n (1 + (3/4) (1 - e^2) zdot / zdot_in),   that is   chi = 3 K (1 - e^2) / (4 zdot_in)
//
// Units: K N/m^n, e 1, zdot_in m/s: the speed at which this impact began, a state of the contact, not of the ground.
// Stored energy: K z^(n+1) / (n+1). Dissipated power: chi z^n zdot^2.
// Source: Lankarani & Nikravesh 1990.
// e is met for e near 1 only, since chi is made from the loss of an impact that loses nothing: e = 0.9 gives 0.913,
// e = 0.5 gives 0.725, and no e gives less than 0.663, whatever n is. Restitution does not depend on the speed. The
// damping of an impact that begins without speed would be infinite: it is bounded with `slowest_impact`, which the
// source does not have. It cannot represent a restitution that falls with speed, adhesion, or long contact: a ball at
// rest on the ground keeps the damping of its last impact.
#pragma once

#include <array>

#include "footfall/law/normal/hunt_crossley.hpp"

namespace footfall {

template <class S = double>
struct LankaraniNikraveshNormal {
    using value_type = S;

    S stiffness;    ///< K [N/m^n], > 0
    S restitution;  ///< e, the restitution asked for, in (0, 1]. Lankarani & Nikravesh 1990.
    S n = S(1.5);   ///< exponent of the depth, > 0
    /// v_min [m/s], > 0: impacts slower than this, and contacts that begin without speed, are damped as one at v_min.
    S slowest_impact = S(1e-3);
    /// zdot at touchdown [m/s], no parameter: begin_impact sets it. 0 where the contact began without speed.
    S impact_speed = S(0);

    /// To be called at every touchdown with zdot [m/s].
    constexpr void begin_impact(const S& speed) noexcept { impact_speed = speed; }

    /// chi, damping of this impact [N s/m^(n+1)]. Lankarani & Nikravesh 1990.
    [[nodiscard]] constexpr S damping() const noexcept {
        const S& speed = select(impact_speed > slowest_impact, impact_speed, slowest_impact);
        return S(0.75) * stiffness * (S(1) - restitution * restitution) / speed;
    }

    /// The same law in Hunt & Crossley's parameters.
    [[nodiscard]] constexpr HuntCrossleyNormal<S> hunt_crossley() const noexcept {
        return {stiffness, damping(), n, n, S(1)};
    }

    /// f / s^Over before the clamp, s = sqrt(z).
    template <int Over = 0>
    [[nodiscard]] constexpr NormalForce<S> force(const S& s, const S& z_rate) const noexcept {
        return hunt_crossley().template force<Over>(s, z_rate);
    }

    /// The unclamped force over its leading power of s.
    [[nodiscard]] constexpr S load(const S& s, const S& z_rate) const noexcept {
        return hunt_crossley().load(s, z_rate);
    }

    /// Energy in the normal spring [J].
    [[nodiscard]] constexpr S stored_energy(const S& s) const noexcept { return hunt_crossley().stored_energy(s); }

    template <class T>
    [[nodiscard]] constexpr LankaraniNikraveshNormal<T> cast() const noexcept {
        return {T(stiffness), T(restitution), T(n), T(slowest_impact), T(impact_speed)};
    }

    static constexpr LawDescription description{
        .name = "lankarani-nikravesh",
        .formula = "f = max(K z^n (1 + 0.75 (1 - e^2) zdot/zdot_in), 0); by default n = 1.5",
        .source = "Lankarani & Nikravesh 1990",
        .limits =
            "meets e only near 1: e = 0.5 gives 0.725, none less than 0.663; the same restitution at every speed"};

    static constexpr auto parameters() noexcept {
        using Law = LankaraniNikraveshNormal<double>;
        return std::array{Parameter<Law>{"stiffness", "K", "N/m^n", &Law::stiffness, "normal stiffness", "", {}, true},
                          Parameter<Law>{.key = "restitution",
                                         .symbol = "e",
                                         .unit = "1",
                                         .member = &Law::restitution,
                                         .description = "restitution that the damping is made for",
                                         .when_zero = "",
                                         .at_most_one = true},
                          Parameter<Law>{"n", "n", "1", &Law::n, "exponent of the depth in spring and damper", "", 1.5},
                          Parameter<Law>{"slowest_impact", "v_min", "m/s", &Law::slowest_impact,
                                         "slower impacts are damped as at this speed", "", 1e-3}};
    }
};

}  // namespace footfall
