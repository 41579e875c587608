// Bliman & Sorine's second-order law: a fast bristle of Dahl's less a slow one, which leaves a peak at break-away.
//
//   udot_1 = V - |V| u_1 / (eta eps),   udot_2 = V - |V| u_2 / eps
//   F_f    = -F_n (f_1/(eta eps) u_1 - f_2/eps u_2)
//
// States: u_1 (2), u_2 (2) [m]. Units: eps m, the rest 1.
//
// Source: Bliman & Sorine 1995, Easy-to-use realistic dry friction models for automatic control, Proc. European Control
// Conf., 3788. There dx/ds = A x + B sgn(v), F = C x over the path s, with A = -diag(1/(eta eps), 1/eps), B = (f_1/(eta
// eps), -f_2/eps), C = (1, 1): x_1 = f_1 u_1/(eta eps), x_2 = -f_2 u_2/eps. Over the load, f_1 and f_2 are coefficients
// of friction. Given are mu = f_1 - f_2, of steady sliding, and f_2; f_2 = 0 is the first-order law, which is Dahl's.
// In the plane V/|V| takes the place of sgn(v). The law knows the path alone, not the speed.
//
// From rest, over the path s, F(s) = F_n (f_1 (1 - exp(-s/(eta eps))) - f_2 (1 - exp(-s/eps))), with its peak at
// s_p = eps eta/(1 - eta) ln(f_1/(eta f_2)).
//
// Stored: the source calls the law dissipative without naming a stored energy, and that of two springs, one of them of
// negative stiffness, would be negative. The law is the passive linear system above, so there is an available storage,
// more than which no path gives back at a constant load (Willems 1972, Arch. Rational Mech. Anal. 45:321):
//
//   w = (1/2) (p_1 x_1^2 - 2 q x_1.x_2 + p_2 x_2^2),  p_1 = (1 + q b f_2)/(a f_1),  p_2 = (q a f_1 - 1)/(b f_2),
//
// a = 1/(eta eps), b = 1/eps, x_2 = f_2 u_2/eps without its sign, q the smaller root of (a - b)^2 f_1 f_2 q^2 - 4 (a
// f_1 - b f_2) q + 4 = 0. Dissipated: the rest, in the clutch, >= 0. No damper.
//
// It cannot represent stiction after a reversal to the full (the peak is lower than from rest), nor any effect of the
// speed; under a small oscillating force it drifts.
#pragma once

#include "footfall/law/friction/rate_friction.hpp"
#include "footfall/math/value_of.hpp"

namespace footfall {

template <class S = double>
struct BlimanSorineFriction {
    using value_type = S;
    static constexpr int states = 4;

    S coefficient;       ///< mu = f_1 - f_2, coefficient of friction of steady sliding [1], >= 0
    S slow_coefficient;  ///< f_2, what the slow bristle takes back [1], >= 0
    S slow_length;       ///< eps, the path over which the slow bristle settles [m], > 0
    S fast_share;        ///< eta, the fast bristle's path over the slow one's [1], > 0 and <= 1

    [[nodiscard]] RateResponse<S> respond(const Vector2<S>& V, FrictionStates<S> x, std::span<S> rate) const noexcept {
        const Vector2<S> u_1 = vector_at<S>(x), u_2 = vector_at<S>(x, 2);
        const S speed = length_of(V), fast_length = fast_share * slow_length;
        const Vector2<S> rate_1 = V - u_1 * (speed / fast_length), rate_2 = V - u_2 * (speed / slow_length);
        put_vector(rate, 0, rate_1);
        put_vector(rate, 2, rate_2);
        const Storage k = storage();
        return {fast_coefficient() / fast_length * -u_1 + slow_coefficient / slow_length * u_2,
                k.fast * u_1.dot(rate_1) - k.both * (u_1.dot(rate_2) + rate_1.dot(u_2)) + k.slow * u_2.dot(rate_2),
                S(0)};
    }

    [[nodiscard]] S stored(FrictionStates<S> x) const noexcept {
        const Vector2<S> u_1 = vector_at<S>(x), u_2 = vector_at<S>(x, 2);
        const Storage k = storage();
        return S(0.5) * (k.fast * u_1.squaredNorm() + k.slow * u_2.squaredNorm()) - k.both * u_1.dot(u_2);
    }

    [[nodiscard]] double state_size(int i) const noexcept {
        return static_cast<double>(value_of(i < 2 ? fast_share * slow_length : slow_length));
    }

    template <class T>
    [[nodiscard]] constexpr BlimanSorineFriction<T> cast() const noexcept {
        return {T(coefficient), T(slow_coefficient), T(slow_length), T(fast_share)};
    }

    static constexpr LawDescription description{
        .name = "bliman-sorine",
        .formula =
            "F_f = -F_n ((mu + f_2) u_1/(eta eps) - f_2 u_2/eps); udot_1 = V - |V| u_1/(eta eps), "
            "udot_2 = V - |V| u_2/eps",
        .source = "Bliman & Sorine 1995, second order, over the load; f_1 = mu + f_2",
        .limits =
            "no effect of the speed; a lower peak after a reversal than from rest; drifts under small oscillating "
            "forces"};

    static constexpr auto parameters() noexcept {
        using Law = BlimanSorineFriction<S>;
        return std::array{
            Parameter<Law>{"coefficient", "mu", "1", &Law::coefficient, "coefficient of friction of steady sliding",
                           "no friction in steady sliding"},
            Parameter<Law>{"slow_coefficient", "f_2", "1", &Law::slow_coefficient,
                           "what the slow bristle takes back after break-away", "the first-order law, which is Dahl's"},
            Parameter<Law>{"slow_length", "eps", "m", &Law::slow_length, "path over which the slow bristle settles",
                           ""},
            Parameter<Law>{"fast_share", "eta", "1", &Law::fast_share,
                           "path of the fast bristle over that of the slow one", "", std::nullopt, false, true}};
    }

private:
    /// f_1.
    [[nodiscard]] S fast_coefficient() const noexcept { return coefficient + slow_coefficient; }

    /// The available storage in u_1 and u_2: (fast |u_1|^2 + slow |u_2|^2)/2 - both u_1.u_2 [1/m].
    struct Storage {
        S fast, slow, both;
    };
    [[nodiscard]] Storage storage() const noexcept {
        using std::sqrt;
        const S f_1 = fast_coefficient(), f_2 = slow_coefficient;
        const S b = S(1) / slow_length, a = b / fast_share;
        const S slope = a * f_1 - b * f_2;
        if (!(slope > S(0))) return {S(0), S(0), S(0)};  // then there is no force
        const S root = sqrt((f_1 - f_2) * (a * a * f_1 - b * b * f_2));
        const S q = S(2) / (slope + root);
        return {a * f_1 * (S(1) + q * b * f_2), b * f_2 * (q * a * f_1 - S(1)), q * a * f_1 * b * f_2};
    }
};

}  // namespace footfall
