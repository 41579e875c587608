// Coulomb friction of a patch that slides and spins: a friction law coupled with load, spin and size of the contact.
//
//   F_f = -mu F_n V / (|V| + (8/(3 pi)) a |w|)
//   M_n = -(3 pi/16) mu F_n a (a w) / (a |w| + (15 pi/16) |V|),   a = sqrt(r z)                          (7)
//
// w is the spin about the normal. A patch that spins slides with less friction than Coulomb's, and one that slides is
// easier to spin: the reason why a spinning ball drifts on an incline. No internal states.
//
// Source: Contensou 1963, Couplage entre frottement de glissement et frottement de pivotement dans la theorie de la
// toupie; the fractions are Zhuravlev 1998, The model of dry friction in the problem of the rolling of rigid bodies,
// J. Appl. Math. Mech. 62:705, for the pressure of a Hertzian contact. They are exact where the patch only slides or
// only spins, and have the right slope for the torque of a slow spin and for the force of a slow slip.
//
// Rounded: |V| and a |w| are sqrt(x^2 + v_eps^2), so that force and torque have slopes where both vanish. The clutch
// takes -F_f.V - M_n w, which is never negative.
//
// It cannot represent sticking: under a small force the contact creeps. The force of a patch that slides falls in
// proportion to a slow spin, and the torque of one that spins to a slow slip, where the sums over the patch fall as the
// square.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "footfall/law/friction/friction_part.hpp"

namespace footfall {

template <class S = double>
struct ContensouFriction {
    using value_type = S;
    static constexpr int states = 0;

    S coefficient;     ///< mu [1], >= 0
    S rounding_speed;  ///< v_eps [m/s], > 0

    [[nodiscard]] CoupledResponse<S> respond(const Touch<S>& t, FrictionStates<S>, std::span<S>) const noexcept {
        using std::sqrt;
        constexpr double pi = std::numbers::pi;
        constexpr double spin_beside_slip = 8 / (3 * pi), slip_beside_spin = 15 * pi / 16, full_torque = 3 * pi / 16;
        const S patch = t.root_depth * sqrt(t.radius);  // a
        const S turning = patch * t.spin;
        const S slip = rounded(t.slip.squaredNorm()), spin = rounded(turning * turning);
        CoupledResponse<S> r;
        r.traction = (-coefficient / (slip + S(spin_beside_slip) * spin)) * t.slip;
        r.spin_arm = -coefficient * S(full_torque) * patch * turning / (spin + S(slip_beside_spin) * slip);
        return r;
    }
    [[nodiscard]] S stored(FrictionStates<S>) const noexcept { return S(0); }
    [[nodiscard]] double state_size(int) const noexcept { return 1; }

    template <class T>
    [[nodiscard]] constexpr ContensouFriction<T> cast() const noexcept {
        return {T(coefficient), T(rounding_speed)};
    }

    static constexpr LawDescription description{
        .name = "contensou",
        .formula =
            "F_f = -mu F_n V/(|V| + (8/(3 pi)) a |w|); "
            "M_n = -(3 pi/16) mu F_n a (a w)/(a |w| + (15 pi/16) |V|); a = sqrt(r z)",
        .source = "Zhuravlev 1998, after Contensou 1963; rounded at v_eps",
        .limits = "no sticking: creeps under a small force"};

    static constexpr auto parameters() noexcept {
        using Law = ContensouFriction<S>;
        return std::array{Parameter<Law>{"coefficient", "mu", "1", &Law::coefficient, "coefficient of friction",
                                         "no friction at all"},
                          Parameter<Law>{"rounding_speed", "v_eps", "m/s", &Law::rounding_speed,
                                         "speed over which friction is rounded off", ""}};
    }

private:
    [[nodiscard]] S rounded(const S& square) const noexcept {
        using std::sqrt;
        return sqrt(square + rounding_speed * rounding_speed);
    }
};

static_assert(CoupledFriction<ContensouFriction<>>);

}  // namespace footfall
