// Flores et al.'s force: Hunt & Crossley's with the damping that a given restitution asks for, also far from 1.
//
//   f = K z^n (1 + (8/5) (1 - e)/e zdot / zdot_in),   that is   chi = 8 K (1 - e) / (5 e zdot_in)
//
// Units: K N/m^n, e 1, zdot_in m/s: the speed at which this impact began, a state of the contact, not of the ground.
// Stored energy: K z^(n+1) / (n+1). Dissipated power: chi z^n zdot^2.
// Source: Flores, Machado, Silva & Martins 2011.
// chi is derived from approximate losses of the two phases, so e is met to 0.05: e = 0.9 gives 0.894,
// e = 0.5 gives 0.470, e = 0.2 gives 0.156, whatever n is. Restitution does not depend on the speed. The damping of an
// impact that begins without speed would be infinite: it is bounded with `slowest_impact`, which the source does not
// have. It cannot represent a restitution that falls with speed, adhesion, or long contact: a ball at rest on the
// ground keeps the damping of its last impact.
#pragma once

#include <array>

#include "footfall/law/normal/hunt_crossley.hpp"

namespace footfall {

template <class S = double>
struct FloresNormal {
    using value_type = S;

    S stiffness;    ///< K [N/m^n], > 0
    S restitution;  ///< e, the restitution asked for, in (0, 1]. Flores et al. 2011.
    S n = S(1.5);   ///< exponent of the depth, > 0
    /// v_min [m/s], > 0: impacts slower than this, and contacts that begin without speed, are damped as one at v_min.
    S slowest_impact = S(1e-3);
    /// zdot at touchdown [m/s], no parameter: begin_impact sets it. 0 where the contact began without speed.
    S impact_speed = S(0);

    /// To be called at every touchdown with zdot [m/s].
    constexpr void begin_impact(const S& speed) noexcept { impact_speed = speed; }

    /// chi, damping of this impact [N s/m^(n+1)]. Flores et al. 2011.
    [[nodiscard]] constexpr S damping() const noexcept {
        const S& speed = select(impact_speed > slowest_impact, impact_speed, slowest_impact);
        return S(8) * stiffness * (S(1) - restitution) / (S(5) * restitution * speed);
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
    [[nodiscard]] constexpr FloresNormal<T> cast() const noexcept {
        return {T(stiffness), T(restitution), T(n), T(slowest_impact), T(impact_speed)};
    }

    static constexpr LawDescription description{
        .name = "flores",
        .formula = "f = max(K z^n (1 + 1.6 (1 - e)/e zdot/zdot_in), 0); by default n = 1.5",
        .source = "Flores, Machado, Silva & Martins 2011",
        .limits = "meets e to 0.05; the same restitution at every speed"};

    static constexpr auto parameters() noexcept {
        using Law = FloresNormal<double>;
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
