// Haessig & Friedland's reset integrator: a spring that stops winding up at its break-away deflection.
//
//   stick  |u| < z_0 :  udot = V,                 F_f = -F_n ((1 + a) sigma_0 u + sigma_1 V)
//   slip   |u| = z_0 :  udot = V - u^ (u^.V),     F_f = -F_n (sigma_0 u + sigma_1 udot)
//   it lets go where |u| reaches z_0, and takes hold where u^.V falls to 0;   u^ = u/|u|
//
// States: u (2) [m]. Units: sigma_0 1/m, sigma_1 s/m, z_0 m, a 1. The kinetic coefficient is sigma_0 z_0, the static
// one (1 + a) sigma_0 z_0.
//
// Source: Haessig & Friedland 1991, On the modeling and simulation of friction, ASME J. Dynamic Systems, Measurement,
// and Control 113:354, as restated by Olsson, Astrom, Canudas de Wit, Gafvert & Lischinsky 1998, European J. Control
// 4:176. sigma_0 is constant here (the source lets it depend on the speed). Over the load.
//
// Choice: in one direction u stands still while it slips; in the plane what V has across u still turns it, so that
// friction comes to oppose the motion.
//
// Stored: w = (1/2) (1 + a) sigma_0 |u|^2 sticking, (1/2) sigma_0 |u|^2 slipping. Dissipated over F_n: sigma_1 |udot|^2
// in the damper, sigma_0 z_0 (u^.V)_+ in the clutch, and (1/2) a sigma_0 z_0^2 at once where it lets go. The same
// amount comes back where it takes hold again, so that with a > 0 the channel of the clutch falls there: the law is not
// passive. It holds exactly, without creep.
//
// It cannot represent a Stribeck curve (here), nor a gradual break-away.
#pragma once

#include "footfall/law/friction/rate_friction.hpp"
#include "footfall/math/value_of.hpp"

namespace footfall {

template <class S = double>
struct ResetIntegratorFriction {
    using value_type = S;
    static constexpr int states = 2;
    static constexpr Phase first_phase = Phase::stick;

    S stiffness;        ///< sigma_0, stiffness over the load [1/m], > 0
    S damping;          ///< sigma_1, damping over the load [s/m], >= 0
    S reach;            ///< z_0, break-away deflection [m], > 0
    S stiction = S(0);  ///< a, static over kinetic coefficient less 1 [1], >= 0

    [[nodiscard]] RateResponse<S> respond(Phase phase, const Vector2<S>& V, FrictionStates<S> x,
                                          std::span<S> rate) const noexcept {
        const Vector2<S> u = vector_at<S>(x);
        Vector2<S> u_rate = V;
        if (phase == Phase::slip) u_rate -= u * (u.dot(V) / u.squaredNorm());
        put_vector(rate, 0, u_rate);
        const S K = spring(phase);
        return {-(K * u + damping * u_rate), K * u.dot(u_rate), damping * u_rate.squaredNorm()};
    }

    [[nodiscard]] S stored(Phase phase, FrictionStates<S> x) const noexcept {
        return S(0.5) * spring(phase) * vector_at<S>(x).squaredNorm();
    }

    [[nodiscard]] S margin(Phase phase, const Vector2<S>& V, FrictionStates<S> x) const noexcept {
        const Vector2<S> u = vector_at<S>(x);
        return phase == Phase::slip ? S(u.dot(V)) : S(reach - length_of(u));
    }

    [[nodiscard]] Phase jump(Phase phase, const Vector2<S>&, std::span<S> x) const noexcept {
        if (phase == Phase::slip) return Phase::stick;
        const Vector2<S> u = vector_at<S>(x);
        put_vector(x, 0, Vector2<S>(u * (reach / length_of(u))));  // on the circle to rounding
        return Phase::slip;
    }

    [[nodiscard]] double state_size(int) const noexcept { return static_cast<double>(value_of(reach)); }

    /// With stiction it gives back what it let go with, where it takes hold again.
    [[nodiscard]] bool clutch_only_takes() const noexcept { return !(stiction > S(0)); }

    template <class T>
    [[nodiscard]] constexpr ResetIntegratorFriction<T> cast() const noexcept {
        return {T(stiffness), T(damping), T(reach), T(stiction)};
    }

    static constexpr LawDescription description{
        .name = "reset-integrator",
        .formula =
            "stick: udot = V, F_f = -F_n ((1 + a) sigma_0 u + sigma_1 V); from |u| = z_0 slip: u turns with V, "
            "F_f = -F_n (sigma_0 u + sigma_1 udot)",
        .source = "Haessig & Friedland 1991, reset integrator, over the load",
        .limits =
            "force jumps at break-away where a > 0, and back at the reversal, which makes energy; no Stribeck curve"};

    static constexpr auto parameters() noexcept {
        using Law = ResetIntegratorFriction<S>;
        return std::array{Parameter<Law>{"stiffness", "sigma_0", "1/m", &Law::stiffness, "stiffness over the load", ""},
                          Parameter<Law>{"damping", "sigma_1", "s/m", &Law::damping, "damping over the load",
                                         "no loss before sliding"},
                          Parameter<Law>{"reach", "z_0", "m", &Law::reach, "deflection at which it lets go", ""},
                          Parameter<Law>{"stiction", "a", "1", &Law::stiction,
                                         "static over kinetic coefficient, less 1", "no stiction", 0.0}};
    }

private:
    [[nodiscard]] S spring(Phase phase) const noexcept {
        return phase == Phase::slip ? stiffness : S((S(1) + stiction) * stiffness);
    }
};

}  // namespace footfall
