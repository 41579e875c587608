// Dahl's law: a bristle that creeps towards the deflection at which friction is Coulomb's.
//
//   udot  = V - |V| u / u_C,   u_C = mu / sigma_0
//   F_f   = -F_n sigma_0 u
//
// States: u (2) [m]. Units: sigma_0 1/m, mu 1.
//
// Source: Dahl 1968, A solid friction model, Aerospace Corporation TOR-0158(3107-18)-1: dF/dx = sigma (1 - sgn(v)
// F/F_C)^i, with the exponent i = 1 that nearly every use of it has. Over the load: F_C = mu F_n, sigma = sigma_0 F_n.
//
// Stored: w = (1/2) sigma_0 |u|^2. Dissipated over F_n: sigma_0 |V| |u|^2 / u_C in the clutch, >= 0. No damper.
//
// It cannot represent the Stribeck effect, a static friction above the kinetic one, or a limit below which nothing
// creeps: under a small oscillating force it drifts.
#pragma once

#include "footfall/law/friction/rate_friction.hpp"
#include "footfall/math/value_of.hpp"

namespace footfall {

template <class S = double>
struct DahlFriction {
    using value_type = S;
    static constexpr int states = 2;

    S stiffness;    ///< sigma_0, rest stiffness over the load [1/m], > 0
    S coefficient;  ///< mu [1], >= 0

    [[nodiscard]] RateResponse<S> respond(const Vector2<S>& V, FrictionStates<S> x, std::span<S> rate) const noexcept {
        const Vector2<S> u = vector_at<S>(x);
        Vector2<S> u_rate = Vector2<S>::Zero();  // with mu = 0 the bristle never leaves u = 0
        if (coefficient > S(0)) u_rate = V - u * (length_of(V) * stiffness / coefficient);
        put_vector(rate, 0, u_rate);
        return {-stiffness * u, stiffness * u.dot(u_rate), S(0)};
    }

    [[nodiscard]] S stored(FrictionStates<S> x) const noexcept {
        return S(0.5) * stiffness * vector_at<S>(x).squaredNorm();
    }

    [[nodiscard]] double state_size(int) const noexcept {
        const double reach = static_cast<double>(value_of(coefficient / stiffness));
        return reach > 0 ? reach : 1 / static_cast<double>(value_of(stiffness));
    }

    template <class T>
    [[nodiscard]] constexpr DahlFriction<T> cast() const noexcept {
        return {T(stiffness), T(coefficient)};
    }

    static constexpr LawDescription description{
        .name = "dahl",
        .formula = "F_f = -F_n sigma_0 u; udot = V - |V| sigma_0 u / mu",
        .source = "Dahl 1968, exponent 1, over the load",
        .limits =
            "no Stribeck effect, no static friction above the kinetic one; drifts under small oscillating forces"};

    static constexpr auto parameters() noexcept {
        using Law = DahlFriction<S>;
        return std::array{
            Parameter<Law>{"stiffness", "sigma_0", "1/m", &Law::stiffness, "stiffness at rest over the load", ""},
            Parameter<Law>{"coefficient", "mu", "1", &Law::coefficient, "coefficient of friction",
                           "no friction at all"}};
    }
};

}  // namespace footfall
