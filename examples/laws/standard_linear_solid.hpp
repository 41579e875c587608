// The standard linear solid: a spring beside a spring and a damper in a row. A normal law with a state that moves.
//
//   f = K_1 z + K_2 (z - d),   ddot = (z - d)/tau
//
// State: d [m], how far the damper has gone; zero at touchdown. Units: K_1 and K_2 N/m, tau s, f N. The damper's
// constant is K_2 tau.
//
// Stored: K_1 z^2/2 + K_2 (z - d)^2/2. Dissipated power: K_2 (z - d)^2/tau. What the second spring still holds where
// the ground is left is lost in the damper.
//
// Source: Zener 1948, Elasticity and Anelasticity of Metals; for impacts Butcher & Segalman 2000, Characterizing
// damping and restitution in compliant impacts via modified K-V and higher-order linear viscoelastic models, J. Appl.
// Mech. 67:831. Unlike the linear law's, its force begins at zero. Restitution does not depend on the speed; it is 1
// where tau is far shorter or far longer than the impact.
//
// It cannot represent a stiffness that grows with the depth, adhesion, or ground that is still dented at the next
// impact.
#pragma once

#include <array>
#include <span>

#include "footfall/law/normal/normal_force.hpp"
#include "footfall/law/parameter.hpp"
#include "footfall/math/scalar.hpp"
#include "footfall/math/value_of.hpp"

namespace footfall {

template <class S = double>
struct StandardLinearSolidNormal {
    using value_type = S;
    static constexpr int states = 1;

    S stiffness;         ///< K_1, stiffness that lasts [N/m], > 0
    S fading_stiffness;  ///< K_2, stiffness that fades [N/m], >= 0
    S relaxation_time;   ///< tau, over which it fades [s], > 0

    /// f / s^Over before the clamp, s = sqrt(z). All of it is elastic: the damper sits behind the second spring.
    template <int Over = 0>
    [[nodiscard]] constexpr NormalForce<S> force(const S& s, const S& /*z_rate*/, std::span<const S> x) const noexcept {
        const S z = power<2 - Over>(s), stretch = z - over<Over>(x[0], s);
        return {.elastic = stiffness * z + fading_stiffness * stretch,
                .dissipative = S(0),
                .relaxation = fading_stiffness * stretch * (power<2>(s) - x[0]) / relaxation_time};
    }

    /// The unclamped force: over a power of s the state has no limit at s = 0.
    [[nodiscard]] constexpr S load(const S& s, const S& z_rate, std::span<const S> x) const noexcept {
        return force(s, z_rate, x).total();
    }

    /// Energy in both springs [J].
    [[nodiscard]] constexpr S stored_energy(const S& s, std::span<const S> x) const noexcept {
        const S z = power<2>(s), stretch = z - x[0];
        return S(0.5) * (stiffness * z * z + fading_stiffness * stretch * stretch);
    }

    static constexpr void land(const S& /*z_rate*/, std::span<S> x) noexcept { x[0] = S(0); }
    constexpr void rates(const S& s, const S& /*z_rate*/, std::span<const S> x, std::span<S> out) const noexcept {
        out[0] = (power<2>(s) - x[0]) / relaxation_time;
    }
    [[nodiscard]] static double state_size(int, const S& s) noexcept { return static_cast<double>(value_of(s * s)); }

    template <class T>
    [[nodiscard]] constexpr StandardLinearSolidNormal<T> cast() const noexcept {
        return {T(stiffness), T(fading_stiffness), T(relaxation_time)};
    }

    static constexpr LawDescription description{.name = "standard-linear-solid",
                                                .formula = "f = max(K_1 z + K_2 (z - d), 0); ddot = (z - d)/tau",
                                                .source = "Zener 1948; Butcher & Segalman 2000",
                                                .limits = "no dent is left for the next impact; no adhesion"};

    static constexpr auto parameters() noexcept {
        using Law = StandardLinearSolidNormal<S>;
        return std::array{
            Parameter<Law>{"stiffness", "K_1", "N/m", &Law::stiffness, "stiffness that lasts", ""},
            Parameter<Law>{"fading_stiffness", "K_2", "N/m", &Law::fading_stiffness, "stiffness that fades",
                           "a spring alone, restitution 1"},
            Parameter<Law>{"relaxation_time", "tau", "s", &Law::relaxation_time, "time over which it fades", ""}};
    }

private:
    /// d / s^Over, and 0 at s = 0, where the contact has begun and d is still zero, or has ended.
    template <int Over>
    static constexpr S over(const S& d, const S& s) noexcept {
        if constexpr (Over == 0) {
            return d;
        } else {
            return s == S(0) ? S(0) : S(d / power<Over>(s));
        }
    }
};

}  // namespace footfall
