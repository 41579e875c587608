// Tsuji, Tanaka & Ishida's normal force: Hertz's spring with the damper that gives every impact the same restitution.
//
//   f = k z^(3/2) + alpha sqrt(m k) z^(1/4) zdot
//
// Units: z m, zdot m/s, k N/m^1.5, m kg, alpha 1, f N.
// Stored energy: (2/5) k z^(5/2). Dissipated power: alpha sqrt(m k) z^(1/4) zdot^2.
// Source: Tsuji, Tanaka & Ishida 1992, who give alpha(e) as a curve only.
//
// alpha(e). With y = z^(5/4), zdot as a function of y obeys
//   zdot zdot' + (4/5) alpha w zdot + (4/5) w^2 y = 0,   w^2 = k/m,
// the phase plane of a linear spring and damper of damping ratio zeta = alpha / sqrt(5). Hence e does not depend on the
// speed. The clamp (14) ends the force where it reaches zero, not where z does, and the linear oscillator then has
//   ln e = -2 zeta acos(zeta) / sqrt(1 - zeta^2)                       (Schwager & Poeschel 2007)
// which is inverted here. The other closed form in use, alpha = -sqrt(5) ln e / sqrt(ln^2 e + pi^2) (Antypov & Elliott
// 2011), lets the ground pull until z = 0; under the clamp it would give a higher restitution than asked for.
//
// The damping knows the mass: m is that of the body, or the reduced mass of a pair, and an effective one for a sphere
// of a foot. It cannot represent a restitution that depends on speed, adhesion, or plasticity.
#pragma once

#include <array>
#include <cmath>

#include "footfall/law/normal/normal_force.hpp"
#include "footfall/law/parameter.hpp"
#include "footfall/math/scalar.hpp"

namespace footfall {

template <class S = double>
struct TsujiNormal {
    using value_type = S;

    S stiffness;    ///< k, normal stiffness [N/m^1.5], > 0. Tsuji et al. 1992.
    S mass;         ///< m, the mass that bounces [kg], > 0. Tsuji et al. 1992.
    S restitution;  ///< e of an impact without gravity, in (0, 1]
    /// damping() [N s/m^1.25], no parameter: prepare keeps it. Below 0 it is computed at every use.
    S kept_damping = S(-1);

    /// Computes once what follows from the parameters. They must not change until the next call.
    void prepare() noexcept { kept_damping = damping(); }

    /// alpha, from e. Tsuji et al. 1992, with the contact ending at zero force.
    [[nodiscard]] S alpha() const noexcept {
        using std::log, std::sqrt;
        return sqrt(S(5)) * damping_ratio(S(0) - S(0.5) * log(restitution));
    }

    /// alpha sqrt(m k) [N s/m^1.25]. Tsuji et al. 1992.
    [[nodiscard]] S damping() const noexcept {
        using std::sqrt;
        return alpha() * sqrt(mass * stiffness);
    }

    /// f / s^Over before the clamp, s = sqrt(z). Over s the damper's part has no limit at touchdown.
    template <int Over = 0>
    [[nodiscard]] NormalForce<S> force(const S& s, const S& z_rate) const noexcept {
        return {.elastic = stiffness * power<3 - Over>(s),
                .dissipative = damping_now() * power<1 - 2 * Over>(root(s)) * z_rate};
    }

    /// The unclamped force over its leading power of s: it changes sign where the force does, also at s = 0.
    [[nodiscard]] S load(const S& s, const S& z_rate) const noexcept {
        return stiffness * s * s * root(s) + damping_now() * z_rate;
    }

    /// Energy in the normal spring [J].
    [[nodiscard]] constexpr S stored_energy(const S& s) const noexcept { return S(2) * stiffness * power<5>(s) / S(5); }

    template <class T>
    [[nodiscard]] constexpr TsujiNormal<T> cast() const noexcept {
        return {T(stiffness), T(mass), T(restitution), T(kept_damping)};
    }

    static constexpr LawDescription description{
        .name = "tsuji",
        .formula = "f = max(k z^1.5 + alpha(e) sqrt(m k) z^0.25 zdot, 0)",
        .source = "Tsuji, Tanaka & Ishida 1992; alpha(e) for a contact that ends at zero force",
        .limits = "the same restitution at every speed; no adhesion, no plasticity"};

    static constexpr auto parameters() noexcept {
        using Law = TsujiNormal<S>;
        return std::array{Parameter<Law>{"stiffness", "k", "N/m^1.5", &Law::stiffness, "normal stiffness", ""},
                          Parameter<Law>{"mass", "m", "kg", &Law::mass, "mass that bounces: the body's", ""},
                          Parameter<Law>{.key = "restitution",
                                         .symbol = "e",
                                         .unit = "1",
                                         .member = &Law::restitution,
                                         .description = "restitution of an impact without gravity",
                                         .when_zero = "",
                                         .at_most_one = true}};
    }

private:
    [[nodiscard]] S damping_now() const noexcept { return kept_damping < S(0) ? damping() : kept_damping; }

    /// z^(1/4) with the sign of s: an event locator looks a little past s = 0.
    [[nodiscard]] static S root(const S& s) noexcept {
        using std::sqrt;
        return s < S(0) ? S(-sqrt(S(-s))) : S(sqrt(s));
    }

    /// zeta from L = -(ln e) / 2 >= 0: with zeta = cos(phi) the relation is phi cot(phi) = L, and phi is imaginary
    /// where the damping is more than critical.
    [[nodiscard]] static S damping_ratio(const S& L) noexcept {
        using std::exp, std::tanh;
        if (L < S(2)) {
            // In w = phi^2 all functions are entire. The polynomial is within 1e-6 of the root, and two steps of
            // Newton's method square that twice. zeta = L sin(phi)/phi keeps its digits for e near 1.
            S w = S(2.4674006037) +
                  L * (S(-1.9999757810) +
                       L * (S(-0.4054739010) +
                            L * (S(-0.0577815470) +
                                 L * (S(-0.0050427799) + L * (S(0.0008053021) + L * S(0.0000681031))))));
            for (int step = 0; step < 2; ++step) {
                const Wave at = wave(w);
                w = w - (at.cosine - L * at.sine) / (S(-0.5) * at.sine - L * at.sine_slope);
            }
            return L * wave(w).sine;
        }
        S h = L;  // phi = i h, h coth(h) = L
        for (int step = 0; step < 5; ++step) {
            const S t = tanh(h);
            h = h - (h - L * t) / (S(1) - L * (S(1) - t * t));
        }
        const S growth = exp(h);
        return S(0.5) * (growth + S(1) / growth);
    }

    /// cos(sqrt(w)), sin(sqrt(w))/sqrt(w) and the slope of the latter, by their series: |w| < 4.
    struct Wave {
        S cosine, sine, sine_slope;
    };
    [[nodiscard]] static Wave wave(const S& w) noexcept {
        constexpr int terms = 13;
        Wave at{S(1), S(1), S(0)};
        for (int k = terms; k > 0; --k) {
            const S c = S(1.0L / ((2 * k - 1) * (2 * k))), s = S(1.0L / ((2 * k) * (2 * k + 1)));
            at.sine_slope = -s * (at.sine + w * at.sine_slope);
            at.sine = S(1) - w * s * at.sine;
            at.cosine = S(1) - w * c * at.cosine;
        }
        return at;
    }
};

}  // namespace footfall
