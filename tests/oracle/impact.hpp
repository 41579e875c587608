// A single impact along the normal, without gravity: the equations of the three normal laws written afresh and
// solved with Taylor series, and what is known of them in closed form. It shares nothing with the library.
//
// With s = sqrt(z) and dt = s dsigma, ds/dsigma = w/2, where w = zdot, the two nonlinear laws are polynomial:
//   Azad & Featherstone (13)   m dw/dsigma = -s^2 (K s^2 + D w)
//   Hunt & Crossley (2)        m dw/dsigma = -s^4 (k + lambda w)
// The linear law is polynomial in z and t as it is.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "taylor.hpp"

namespace oracle {

enum class ImpactLaw { azad_featherstone, hunt_crossley, linear };

/// Times from touchdown [s].
template <class Real>
struct ImpactResult {
    Real speed_out;  // m/s
    Real separation, recovered;
    Real peak_depth, peak_force;
};

/// An impact of mass m at speed v, to the precision of Real. Contact ends where the force falls to zero (14); from
/// there the mass flies freely to z = 0.
template <class Real>
ImpactResult<Real> impact(ImpactLaw law, Real m, Real stiffness, Real damping, Real v, int order = 26) {
    enum : std::size_t { depth, rate, time };  // depth: s, or z for the linear law
    using Point = std::array<Real, 3>;
    const bool linear = law == ImpactLaw::linear, classical = law == ImpactLaw::hunt_crossley;

    auto expand = [&](const Point& from) {
        const auto n = static_cast<std::size_t>(order) + 1;
        std::array<Series<Real>, 3> x;
        for (std::size_t i = 0; i < 3; ++i) {
            x[i].assign(n, Real(0));
            x[i][0] = from[i];
        }
        Series<Real> z(n, Real(0)), z2 = z, load = z, acceleration = z;
        for (std::size_t k = 0; k + 1 < n; ++k) {
            const Real step(static_cast<double>(k + 1));
            if (linear) {
                acceleration[k] = -(stiffness * x[depth][k] + damping * x[rate][k]) / m;
                x[depth][k + 1] = x[rate][k] / step;
                x[time][k + 1] = k == 0 ? Real(1) : Real(0);
            } else {
                z[k] = product(x[depth], x[depth], k);
                if (classical) {
                    z2[k] = product(z, z, k);
                    load[k] = damping * x[rate][k] + (k == 0 ? stiffness : Real(0));
                    acceleration[k] = -product(z2, load, k) / m;
                } else {
                    load[k] = stiffness * z[k] + damping * x[rate][k];
                    acceleration[k] = -product(z, load, k) / m;
                }
                x[depth][k + 1] = x[rate][k] / (2 * step);
                x[time][k + 1] = x[depth][k] / step;
            }
            x[rate][k + 1] = acceleration[k] / step;
        }
        return x;
    };
    auto load = [&](const Point& x) {  // the force without its power of s; > 0 while it presses
        // (2) presses until z = 0: k + lambda w > 0 at first, and w stands still where it is 0. So does Hertz.
        if (classical || x[depth] <= 0) return x[depth];
        return (linear ? stiffness * x[depth] : stiffness * x[depth] * x[depth]) + damping * x[rate];
    };
    auto force = [&](const Point& x) {
        const Real s = x[depth], w = x[rate];
        if (linear) return stiffness * s + damping * w;
        return classical ? s * s * s * (stiffness + damping * w) : s * (stiffness * s * s + damping * w);
    };
    auto force_slope = [&](const Point& x) {  // sign of dF/dt
        const Real s = x[depth], w = x[rate];
        if (linear) return stiffness * w - damping * force(x) / m;
        if (classical) {
            const Real k = stiffness + damping * w;
            return 3 * w / 2 * k - damping * s * s * s * s * s * k / m;
        }
        return 3 * stiffness * s * s * w / 2 +
               damping * (w * w / 2 - s * s * s * (stiffness * s * s + damping * w) / m);
    };

    // How far in sigma (or t) an undamped impact would go, for scales.
    const Real guess = linear ? v * sqrt(Real(m / stiffness)) : exp(Real(log(Real(m * v * v / stiffness)) / 5));
    Point x{Real(0), v, Real(0)};
    const std::array<Real, 3> scale{guess, v, linear ? guess / v : guess * guess / v};
    ImpactResult<Real> result{};
    result.peak_force = force(x);
    bool rising = !linear || force_slope(x) > 0, loading = true;
    for (;;) {
        const auto series = expand(x);
        auto at = [&](const Real& sigma) { return evaluate(series, sigma); };
        Real h = step_size(series, scale, epsilon<Real>() / 16, 4 * (linear ? guess : guess * 2) / v);
        const auto end = first_fall<Real>([&](const Real& sigma) { return load(at(sigma)); }, h);
        if (end) h = *end;
        if (loading) {
            if (const auto peak = first_fall<Real>([&](const Real& sigma) { return at(sigma)[rate]; }, h)) {
                const Real deepest = at(*peak)[depth];
                result.peak_depth = linear ? deepest : deepest * deepest;
                loading = false;
            }
        }
        if (rising) {
            if (const auto peak = first_fall<Real>([&](const Real& sigma) { return force_slope(at(sigma)); }, h)) {
                result.peak_force = force(at(*peak));
                rising = false;
            }
        }
        x = at(h);
        if (end) break;
    }
    result.speed_out = -x[rate];
    result.separation = x[time];
    const Real left = classical ? Real(0) : linear ? x[depth] : x[depth] * x[depth];
    result.recovered = x[time] + left / result.speed_out;
    return result;
}

/// Restitution under the linear law with the clamp: contact ends where the force falls to zero. Schwager & Poeschel,
/// Granular Matter 9 (2007) 465, (15)-(17); independent of the speed.
inline long double linear_restitution(long double m, long double k, long double d) {
    const long double beta = d / (2 * m), omega0_squared = k / m;
    const long double square = omega0_squared - beta * beta;
    if (square > 0) {
        const long double omega = std::sqrt(square);
        // omega t in (0, pi) where z'' = 0: its tangent is 2 beta omega / (beta^2 - omega^2).
        return std::exp(-beta / omega * std::atan2(2 * beta * omega, beta * beta - omega * omega));
    }
    const long double Omega = std::sqrt(-square);
    return std::exp(-beta / Omega * std::log((beta + Omega) / (beta - Omega)));
}

/// Restitution under Hunt & Crossley's (2). Separating the variables z and zdot gives, with a = lambda v / k,
///   a (1 + e) = log((1 + a) / (1 - a e)).
inline long double hunt_crossley_restitution(long double k, long double lambda, long double v) {
    const long double a = lambda * v / k;
    if (!(a > 0)) return 1;
    // In y = a e: f(y) = y + log(1 - y) + a - log(1 + a) falls from >= 0 at 0 to -infinity at 1.
    const long double constant = a - std::log1p(a);
    long double low = 0, high = std::fmin(a, 1);
    for (;;) {
        const long double middle = (low + high) / 2;
        if (!(middle > low && middle < high)) return middle / a;
        (middle + std::log1p(-middle) + constant > 0 ? low : high) = middle;
    }
}

/// C in e = 1 - C (D/K) (K/m)^(2/5) v^(1/5) + ..., the limit of slow impacts under Azad & Featherstone's (13).
///
/// To first order in D the loss is that of the damper on Hertz's elastic path, m v^2 (1 - e) = 2 times the integral of
/// D sqrt(z) sqrt(v^2 - (4K/5m) z^(5/2)) dz, which is a Beta function: C = (4/5)^(2/5) B(3/5, 3/2) = 1.15344..., the
/// C_1 of Ramirez, Poeschel, Brilliantov & Schwager, Phys. Rev. E 60 (1999) 4465.
inline long double viscoelastic_slope() {
    return std::pow(0.8L, 0.4L) * std::tgamma(0.6L) * std::tgamma(1.5L) / std::tgamma(2.1L);
}

}  // namespace oracle
