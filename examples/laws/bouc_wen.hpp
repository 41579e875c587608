// Bouc & Wen's hysteresis: a bristle that gives way as its stretch nears its end. A friction law with states of its
// own.
//
//   udot = V - (beta |V.u| + gamma V.u) u / u_C^2,   beta = (1 + p)/2,  gamma = (1 - p)/2,  u_C = mu/sigma
//   F_f  = -F_n sigma u
//
// States: u (2) [m]. Units: sigma 1/m, mu and p 1.
//
// Source: Bouc 1967, Forced vibration of mechanical systems with hysteresis; Wen 1976, Method for random vibration of
// hysteretic systems, ASCE J. Eng. Mech. Div. 102:249, (3) with n = 2 and A = 1, where beta + gamma is 1/u_C^2; over
// the load. In the plane |V.u| takes the place of |v| |u|, so that the law is isotropic; on a line its loops are those
// of the source. gamma < 0 is left out, as is beta < gamma, which would make energy.
//
// Stored: w = (1/2) sigma |u|^2. Dissipated over F_n: sigma (beta |V.u| + gamma V.u) |u|^2/u_C^2, in the clutch, >= 0.
// No damper.
//
// It cannot represent a limit below which nothing creeps, a Stribeck curve, or any effect of the speed.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "footfall/law/friction/rate_friction.hpp"
#include "footfall/math/value_of.hpp"

namespace footfall {

template <class S = double>
struct BoucWenFriction {
    using value_type = S;
    static constexpr int states = 2;

    S stiffness;             ///< sigma, stiffness of the bristle over the load [1/m], > 0
    S kinetic_coefficient;   ///< mu, coefficient of friction of steady sliding [1], > 0
    S reversal_loss = S(0);  ///< p, loss on the way back over that on the way out [1], from 0 to 1

    [[nodiscard]] RateResponse<S> respond(const Vector2<S>& V, FrictionStates<S> x, std::span<S> rate) const noexcept {
        using std::abs;
        const Vector2<S> u = vector_at<S>(x);
        const S along = V.dot(u), end = kinetic_coefficient / stiffness;
        const S beta = S(0.5) * (S(1) + reversal_loss);
        const Vector2<S> u_rate = V - u * ((beta * abs(along) + (S(1) - beta) * along) / (end * end));
        put_vector(rate, 0, u_rate);
        return {u * -stiffness, stiffness * u.dot(u_rate), S(0)};
    }
    [[nodiscard]] S stored(FrictionStates<S> x) const noexcept {
        return S(0.5) * stiffness * vector_at<S>(x).squaredNorm();
    }
    [[nodiscard]] double state_size(int) const noexcept {
        return static_cast<double>(value_of(kinetic_coefficient / stiffness));
    }

    template <class T>
    [[nodiscard]] constexpr BoucWenFriction<T> cast() const noexcept {
        return {T(stiffness), T(kinetic_coefficient), T(reversal_loss)};
    }

    static constexpr LawDescription description{
        .name = "bouc-wen",
        .formula = "F_f = -F_n sigma u; udot = V - ((1 + p) |V.u| + (1 - p) V.u) u sigma^2/(2 mu^2)",
        .source = "Bouc 1967; Wen 1976, n = 2, over the load",
        .limits = "drifts under small oscillating forces; no Stribeck curve, no effect of the speed"};

    static constexpr auto parameters() noexcept {
        using Law = BoucWenFriction<S>;
        return std::array{
            Parameter<Law>{"stiffness", "sigma", "1/m", &Law::stiffness, "stiffness of the bristle over the load", ""},
            Parameter<Law>{"kinetic_coefficient", "mu", "1", &Law::kinetic_coefficient,
                           "coefficient of friction of steady sliding", ""},
            Parameter<Law>{"reversal_loss", "p", "1", &Law::reversal_loss,
                           "loss on the way back over that on the way out", "elastic on the way back", 0.0, false,
                           true}};
    }
};

static_assert(RateFriction<BoucWenFriction<>>);

}  // namespace footfall
