// Haessig & Friedland's bristle model: many bonds that stretch with the motion, snap, and form anew a random way on.
//
//   F_f = -F_n (sigma_0/N) sum u_i,   udot_i = V
//   where |u_i| reaches delta_s the bond snaps, and the new one has u_i = rho u_i, rho drawn from [0, 1)
//
// States: u_i (2 N) [m], how many bonds have snapped (1). Units: sigma_0 1/m, delta_s m. N = 20.
//
// Source: Haessig & Friedland 1991, On the modeling and simulation of friction, ASME J. Dynamic Systems, Measurement,
// and Control 113:354: N of 20 to 25 serves best. Over the load; sigma_0 is the stiffness of all bonds together.
//
// Choices. The source draws the place of the new bond between the old one and the sphere; here rho comes from a fixed
// generator (SplitMix64, Steele, Lea & Flood 2014, of the number of bonds that have snapped), so that a run repeats
// exactly. A new contact has all bonds without stretch. In the plane a new bond keeps the direction of the old one.
// Then friction breaks away at sigma_0 delta_s, when all snap together, and slides at (2/3) sigma_0 delta_s on average:
// a bond that starts at rho lasts 1 - rho and pulls with (1 + rho)/2, in units of delta_s.
//
// Stored: w = (1/2) (sigma_0/N) sum |u_i|^2. Dissipated: what a bond gives up as it snaps, in the clutch, at once. No
// damper.
//
// The force is rough, as it is meant to be. Every snap is an event, N of them for about half of delta_s of
// sliding: the source itself calls the model inefficient, and offers its reset integrator in place of it. Fit for a
// test rig or for short slips.
//
// It cannot represent viscous friction or a Stribeck curve.
#pragma once

#include <algorithm>
#include <cstdint>

#include "footfall/law/friction/rate_friction.hpp"
#include "footfall/math/value_of.hpp"

namespace footfall {

template <class S = double>
struct HaessigFriedlandFriction {
    using value_type = S;
    static constexpr int bonds = 20;  // N
    static constexpr int states = 2 * bonds + 1;
    static constexpr int vector_states = bonds;  ///< of the plane (law/turn.hpp)
    static constexpr Phase first_phase = Phase::slip;

    S stiffness;  ///< sigma_0, stiffness of all bonds together over the load [1/m], > 0
    S reach;      ///< delta_s, stretch at which a bond snaps [m], > 0

    [[nodiscard]] RateResponse<S> respond(Phase, const Vector2<S>& V, FrictionStates<S> x,
                                          std::span<S> rate) const noexcept {
        for (int i = 0; i < bonds; ++i) put_vector(rate, at(i), V);
        rate[counter] = S(0);
        const Vector2<S> pull = stiffness * bristle(x);
        return {-pull, pull.dot(V), S(0)};
    }

    [[nodiscard]] S stored(Phase, FrictionStates<S> x) const noexcept {
        S sum(0);
        for (int i = 0; i < bonds; ++i) sum += vector_at<S>(x, at(i)).squaredNorm();
        return S(0.5) * stiffness / S(bonds) * sum;
    }

    /// The mean stretch.
    [[nodiscard]] Vector2<S> bristle(FrictionStates<S> x) const noexcept {
        Vector2<S> sum = Vector2<S>::Zero();
        for (int i = 0; i < bonds; ++i) sum += vector_at<S>(x, at(i));
        return sum / S(bonds);
    }

    [[nodiscard]] S margin(Phase, const Vector2<S>&, FrictionStates<S> x) const noexcept { return reach - longest(x); }

    /// Every bond that is at its reach, or nearer to it than rounding tells, snaps.
    [[nodiscard]] Phase jump(Phase phase, const Vector2<S>&, std::span<S> x) const noexcept {
        const S greatest = longest(x);
        for (int i = 0; i < bonds; ++i) {
            const Vector2<S> u = vector_at<S>(x, at(i));
            const S length = length_of(u);
            if (length < greatest * S(1 - 1e-9)) continue;
            put_vector(x, at(i), Vector2<S>(u * (reach / length * S(drawn(x[counter])))));
            x[counter] += S(1);
        }
        return phase;
    }

    [[nodiscard]] double state_size(int i) const noexcept {
        return i == static_cast<int>(counter) ? 1 : static_cast<double>(value_of(reach));
    }

    template <class T>
    [[nodiscard]] constexpr HaessigFriedlandFriction<T> cast() const noexcept {
        return {T(stiffness), T(reach)};
    }

    static constexpr LawDescription description{
        .name = "haessig-friedland",
        .formula =
            "F_f = -F_n (sigma_0/20) sum u_i; udot_i = V; a bond that reaches |u_i| = delta_s snaps, and begins "
            "anew at a random share of it",
        .source = "Haessig & Friedland 1991, bristle model with 20 bonds, over the load",
        .limits =
            "every snap is an event: slow for long slips (reset-integrator is its substitute); a rough force; no "
            "Stribeck curve"};

    static constexpr auto parameters() noexcept {
        using Law = HaessigFriedlandFriction<S>;
        return std::array{
            Parameter<Law>{"stiffness", "sigma_0", "1/m", &Law::stiffness, "stiffness of all bonds over the load", ""},
            Parameter<Law>{"reach", "delta_s", "m", &Law::reach, "stretch at which a bond snaps", ""}};
    }

private:
    static constexpr std::size_t counter = 2 * bonds;
    static constexpr std::size_t at(int bond) noexcept { return 2 * static_cast<std::size_t>(bond); }

    /// The stretch of the bond that is stretched most [m].
    [[nodiscard]] static S longest(FrictionStates<S> x) noexcept {
        S length(0);
        for (int i = 0; i < bonds; ++i) length = std::max(length, length_of(vector_at<S>(x, at(i))));
        return length;
    }

    /// The number in [0, 1) for the n-th bond that snaps.
    [[nodiscard]] static double drawn(const S& n) noexcept {
        std::uint64_t z = (count_of(n) + 1) * 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }
    template <class T>
    [[nodiscard]] static std::uint64_t count_of(const T& n) noexcept {
        if constexpr (requires { n.value; }) {
            return count_of(n.value);
        } else {
            return static_cast<std::uint64_t>(n + T(0.5));
        }
    }
};

}  // namespace footfall
