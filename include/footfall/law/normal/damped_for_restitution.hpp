// What Lankarani & Nikravesh's and Flores et al.'s laws share: Hunt & Crossley's force, whose damping is made anew at
// every touchdown for a restitution that is asked for.
//
//   f = K z^n + chi z^n zdot,   chi from K, e and zdot_in: the law's own file
//
// Units: K N/m^n, e 1, chi N s/m^(n+1), zdot_in m/s: the speed at which this impact began, a state of the contact, not
// of the ground. Stored energy: K z^(n+1) / (n+1). Dissipated power: chi z^n zdot^2.
// Choice: the damping of an impact that begins without speed would be infinite. It is bounded with `slowest_impact`,
// which the sources do not have.
// They cannot represent a restitution that falls with speed, adhesion, or long contact: a ball at rest on the ground
// keeps the damping of its last impact.
#pragma once

#include <array>
#include <span>

#include "footfall/law/normal/hunt_crossley.hpp"
#include "footfall/law/normal/restated.hpp"
#include "footfall/math/value_of.hpp"

namespace footfall {

/// The parameters of such a law. `Damping` has its chi(K, e, zdot_in) and its description.
template <class Damping, class S>
struct DampedForRestitution {
    using value_type = S;

    S stiffness;    ///< K [N/m^n], > 0
    S restitution;  ///< e, the restitution asked for [1], in (0, 1]
    S n = S(1.5);   ///< exponent of the depth, > 0
    /// v_min [m/s], > 0: impacts slower than this, and contacts that begin without speed, are damped as one at v_min.
    S slowest_impact = S(1e-3);
    /// zdot at touchdown [m/s], no parameter: begin_impact sets it. 0 where the contact began without speed.
    S impact_speed = S(0);

    /// To be called at every touchdown with zdot [m/s].
    constexpr void begin_impact(const S& speed) noexcept { impact_speed = speed; }

    /// chi, damping of an impact that began at `speed` [N s/m^(n+1)].
    [[nodiscard]] constexpr S damping(const S& speed) const noexcept {
        return Damping::chi(stiffness, restitution, select(speed > slowest_impact, speed, slowest_impact));
    }
    [[nodiscard]] constexpr S damping() const noexcept { return damping(impact_speed); }

    /// This impact under Hunt & Crossley's law.
    [[nodiscard]] constexpr HuntCrossleyNormal<S> restated() const noexcept { return restated({&impact_speed, 1}); }

    // The speed of impact as a state of the contact (normal_part.hpp).
    static constexpr int states = 1;
    [[nodiscard]] constexpr HuntCrossleyNormal<S> restated(std::span<const S> x) const noexcept {
        return {stiffness, damping(x[0]), n, n, S(1)};
    }
    static constexpr void land(const S& speed, std::span<S> x) noexcept { x[0] = speed; }
    [[nodiscard]] double state_size(int) const noexcept { return static_cast<double>(value_of(slowest_impact)); }

    template <class T>
    [[nodiscard]] constexpr RestatedNormal<DampedForRestitution<Damping, T>> cast() const noexcept {
        return {{T(stiffness), T(restitution), T(n), T(slowest_impact), T(impact_speed)}};
    }

    static constexpr LawDescription description = Damping::description;

    static constexpr auto parameters() noexcept {
        using Law = RestatedNormal<DampedForRestitution<Damping, S>>;
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
