// What the friction laws with internal states have in common: rates that follow from the slip velocity, and a force
// proportional to the load.
//
//   xdot = h(V, x),   F_f = F_n tau(V, x)
//
// Dahl, LuGre, elasto-plastic, Bliman & Sorine, the seven-parameter law, Haessig & Friedland's two and the regularised
// Coulomb law have this form. Their sources give forces at one fixed load. Here every coefficient of a source is given
// over the load: a friction force F_C of a source is a coefficient of friction mu, a stiffness sigma_0 in N/m is one
// in 1/m. This is how LuGre is used for tyres, F = (sigma_0 z + sigma_1 zdot + sigma_2 v) F_n (Canudas de Wit &
// Tsiotras 1999, Dynamic tire friction models for vehicle traction control). In the plane x, V and tau are vectors, and
// |V| and |x| take the place of absolute values: every law is isotropic.
//
// Where F_n = 0 the asperities have parted: the states are those of a new contact, which is zero for each of them, and
// nothing is stored, since what is stored is proportional to F_n.
//
// Energy. W = F_n w(x) is stored. The load changes and no force pays for what that does to W, so
//
//   -F_f . V = dW/dt + (damper) + (clutch) + dP/dt,   dP/dt = -w dF_n/dt
//
// A law gives w, dw/dt and what its damper takes; what is left goes to the clutch, so that the ledger closes for any
// law. Where a law is not passive, the clutch's channel can fall. Each law's file says whether it can.
//
// Phases. A smooth law is in Phase::slip wherever there is a load. A law whose rates or states jump has a `margin`,
// positive while its phase lasts; where that reaches zero, `jump` says what becomes of the states and the phase.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>

#include "footfall/law/parameter.hpp"
#include "footfall/law/phase.hpp"
#include "footfall/math/scalar.hpp"
#include "footfall/math/vector.hpp"

namespace footfall {

/// What such a law gives at one moment, all over the load F_n.
template <class S>
struct RateResponse {
    Vector2<S> traction;    ///< tau = F_f / F_n [1], on the body
    S stored_rate = S(0);   ///< dw/dt [m/s]
    S damper_power = S(0);  ///< what the damper takes [m/s], >= 0
};

/// The internal states of one contact, in the order that the law's file gives; as many as the law has.
template <class S>
using FrictionStates = std::span<const S>;

/// A law of this kind without jumps.
///   states                how many internal states it has
///   respond(V, x, xdot)   the response; writes the rates
///   stored(x)             w [m], >= 0
///   state_size(i)         the natural size of state i in its own unit, > 0: what its error is relative to
///   bristle(x)            optional: the deflection to show a person [m]; without it states 0 and 1
template <class F, class S = typename F::value_type>
concept SmoothRateFriction = requires(const F law, const Vector2<S>& V, FrictionStates<S> x, std::span<S> rate) {
    { F::states } -> std::convertible_to<int>;
    { law.respond(V, x, rate) } -> std::same_as<RateResponse<S>>;
    { law.stored(x) } -> std::same_as<S>;
    { law.state_size(0) } -> std::same_as<double>;
};

/// A law whose rates or states jump. The phase, stick or slip, comes first in `respond` and `stored`.
///   first_phase           of a new contact
///   margin(phase, V, x)   positive while the phase lasts
///   jump(phase, V, x)     where the margin is zero: writes the states that follow, returns the phase that follows
template <class F, class S = typename F::value_type>
concept JumpingRateFriction =
    requires(const F law, Phase phase, const Vector2<S>& V, FrictionStates<S> x, std::span<S> out) {
        { F::states } -> std::convertible_to<int>;
        { F::first_phase } -> std::convertible_to<Phase>;
        { law.respond(phase, V, x, out) } -> std::same_as<RateResponse<S>>;
        { law.stored(phase, x) } -> std::same_as<S>;
        { law.margin(phase, V, x) } -> std::same_as<S>;
        { law.jump(phase, V, out) } -> std::same_as<Phase>;
        { law.state_size(0) } -> std::same_as<double>;
    };

/// A friction law with internal states. `FrictionPart` (friction_part.hpp) gives it the face that all share.
template <class F>
concept RateFriction = SmoothRateFriction<F> || JumpingRateFriction<F>;

/// The most states that a law has.
inline constexpr int max_friction_states = 41;

/// States i and i + 1 as a vector of the plane.
template <class S>
[[nodiscard]] constexpr Vector2<S> vector_at(std::type_identity_t<std::span<const S>> x, std::size_t i = 0) noexcept {
    return {x[i], x[i + 1]};
}
template <class S>
constexpr void put_vector(std::span<S> x, std::size_t i, const Vector2<S>& v) noexcept {
    x[i] = v.x();
    x[i + 1] = v.y();
}

/// |v|, with slope 0 at v = 0.
template <class S>
[[nodiscard]] S length_of(const Vector2<S>& v) noexcept {
    using std::sqrt;
    const S square = v.squaredNorm();
    return square > S(0) ? S(sqrt(square)) : S(0);
}

}  // namespace footfall
