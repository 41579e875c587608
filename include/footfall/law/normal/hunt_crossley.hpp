// Hunt & Crossley's general normal force; with its default exponents, the classical law of the field.
//
//   f = k z^n + lambda z^p zdot^q                                                                  (1)
//   f = k z^(3/2) + lambda z^(3/2) zdot               n = p = 3/2, q = 1                           (2)
//
// zdot^q is read as sign(zdot) |zdot|^q, so that the damper opposes the motion for every q.
// Units: k N/m^n, lambda N s^q/m^(p+q), f N.
// Stored energy: k z^(n+1) / (n+1). Dissipated power: lambda z^p |zdot|^(q+1).
// It cannot represent adhesion; in (2) contact ends only at z = 0 unless zdot < -k/lambda.
#pragma once

#include <array>

#include "footfall/law/normal/normal_force.hpp"
#include "footfall/law/parameter.hpp"
#include "footfall/math/scalar.hpp"

namespace footfall {

template <class S = double>
struct HuntCrossleyNormal {
    using value_type = S;

    S stiffness;   ///< k [N/m^n], > 0. Azad & Featherstone 2010, (1).
    S damping;     ///< lambda [N s^q/m^(p+q)], >= 0. Azad & Featherstone 2010, (1).
    S n = S(1.5);  ///< exponent of the depth in the spring, > 0
    S p = S(1.5);  ///< exponent of the depth in the damper, >= 0
    S q = S(1);    ///< exponent of the rate in the damper, > 0

    /// f / s^Over before the clamp, s = sqrt(z).
    template <int Over = 0>
    [[nodiscard]] constexpr NormalForce<S> force(const S& s, const S& z_rate) const noexcept {
        const S &k = stiffness, &lambda = damping;
        if (classical()) {
            const S z = power<3 - Over>(s);
            return {k * z, lambda * z * z_rate};  // (2)
        }
        return {k * depth_power(s, S(2) * n - S(Over)),  // (1)
                lambda * depth_power(s, S(2) * p - S(Over)) * rate_power(z_rate)};
    }

    /// The unclamped force over its leading power of s: it changes sign where the force does, also at s = 0.
    [[nodiscard]] constexpr S load(const S& s, const S& z_rate) const noexcept {
        const S &k = stiffness, &lambda = damping;
        if (classical()) return k + lambda * z_rate;
        const S spread = S(2) * (n - p);
        if (spread < S(0)) return k + lambda * depth_power(s, -spread) * rate_power(z_rate);
        return k * depth_power(s, spread) + lambda * rate_power(z_rate);
    }

    /// Energy in the normal spring [J].
    [[nodiscard]] constexpr S stored_energy(const S& s) const noexcept {
        if (classical()) return S(2.0 / 5.0) * stiffness * power<5>(s);
        return stiffness * depth_power(s, S(2) * (n + S(1))) / (n + S(1));
    }

    template <class T>
    [[nodiscard]] constexpr HuntCrossleyNormal<T> cast() const noexcept {
        return {T(stiffness), T(damping), T(n), T(p), T(q)};
    }

    static constexpr LawDescription description{
        .name = "hunt-crossley",
        .formula = "f = max(k z^n + lambda z^p zdot^q, 0); by default n = p = 1.5, q = 1",
        .source = "Hunt & Crossley 1975; Azad & Featherstone 2010, (1), (2)",
        .limits = "no adhesion, no plasticity; zdot^q is sign(zdot) |zdot|^q"};

    static constexpr auto parameters() noexcept {
        using Law = HuntCrossleyNormal<S>;
        return std::array{Parameter<Law>{"stiffness", "k", "N/m^n", &Law::stiffness, "normal stiffness", "", {}, true},
                          Parameter<Law>{"damping",
                                         "lambda",
                                         "N s^q/m^(p+q)",
                                         &Law::damping,
                                         "normal damping",
                                         "elastic, restitution 1",
                                         {},
                                         true},
                          Parameter<Law>{"n", "n", "1", &Law::n, "exponent of the depth in the spring", "", 1.5},
                          Parameter<Law>{"p", "p", "1", &Law::p, "exponent of the depth in the damper",
                                         "the damper acts at full strength from touchdown on", 1.5},
                          Parameter<Law>{"q", "q", "1", &Law::q, "exponent of the rate in the damper", "", 1.0}};
    }

private:
    [[nodiscard]] constexpr bool classical() const noexcept { return n == S(1.5) && p == S(1.5) && q == S(1); }

    /// |s|^e with the sign of s: an event locator looks a little past s = 0, where nothing may jump.
    static constexpr S depth_power(const S& s, const S& e) noexcept {
        using std::pow;
        if (e == S(0)) return S(1);
        return s < S(0) ? S(-pow(S(-s), e)) : S(pow(s, e));
    }
    [[nodiscard]] constexpr S rate_power(const S& v) const noexcept {
        using std::pow;
        if (q == S(1)) return v;
        return v < S(0) ? S(-pow(S(-v), q)) : S(pow(v, q));
    }
};

}  // namespace footfall
