// The reference solution of the paper's ball: Taylor series for a contact, closed form for flight.
//
// In contact the independent variable is sigma, dt = s dsigma, and s = sqrt(z) is the state in place of the height:
//   ds/dsigma = zdot/2,   dx/dsigma = s dx/dt,
// which is analytic at touchdown, where f(t) is not.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "paper_sphere.hpp"
#include "taylor.hpp"

namespace oracle {

template <class Real>
struct ReferenceEvent {
    Real time;
    EventKind kind;
    State<Real> state;
};

template <class Real>
struct Reference {
    std::vector<ReferenceEvent<Real>> events;
    State<Real> final;
    Phase phase;
    long steps = 0;
};

template <class Real>
struct ReferenceOptions {
    Real end = 1;
    int order = 26;
    Real tolerance = epsilon<Real>() / 16;  ///< of the last two terms of a series, relative to its scale
};

namespace detail {

/// In contact a state holds s in place of cz, P in place of (33), and the time after the rest.
inline constexpr std::size_t s_at = cz, P_at = tangential_spring, time_at = dimension,
                             contact_dimension = dimension + 1;

template <class Real>
using ContactSeries = std::array<Series<Real>, contact_dimension>;

/// The series of a contact in one phase, from the state `y` (with s in place of cz).
template <class Real>
ContactSeries<Real> expand(const Ball<Real>& ball, Phase phase, const std::array<Real, contact_dimension>& y,
                           int order) {
    const auto n = static_cast<std::size_t>(order) + 1;
    ContactSeries<Real> x;
    for (std::size_t i = 0; i < contact_dimension; ++i) {
        x[i].assign(n, Real(0));
        x[i][0] = y[i];
    }
    const Series<Real> zero(n, Real(0));
    Series<Real> z = zero, f_n = zero, Vx = zero, Vy = zero, fx = zero, fy = zero, square = zero, size = zero,
                 numerator = zero, denominator = zero, share = zero, Fx = zero, Fy = zero, udotx = zero, udoty = zero,
                 slipx = zero, slipy = zero, zdot = zero, zdot2 = zero, udot2 = zero, u2 = zero, power = zero,
                 zz = zero, ax = zero, ay = zero, az = zero;
    const Series<Real>& s = x[s_at];
    const bool touching = phase == Phase::stick || phase == Phase::slip;
    const Real lever = ball.r / ball.inertia();

    for (std::size_t k = 0; k + 1 < n; ++k) {
        zdot[k] = -x[vz][k];
        z[k] = product(s, s, k);
        u2[k] = product(x[ux], x[ux], k) + product(x[uy], x[uy], k);
        zdot2[k] = product(zdot, zdot, k);
        Real damper;  // power of the normal damper, times s
        if (touching) {
            f_n[k] = ball.K_n * z[k] + ball.D_n * zdot[k];
            Vx[k] = x[vx][k] - ball.r * x[wy][k];
            Vy[k] = x[vy][k] + ball.r * x[wx][k];
            fx[k] = -(ball.K_t * x[ux][k] + ball.D_t * Vx[k]);
            fy[k] = -(ball.K_t * x[uy][k] + ball.D_t * Vy[k]);
            if (phase == Phase::slip) {
                square[k] = product(fx, fx, k) + product(fy, fy, k);
                size[k] = root(square, size, k);
                // |F_f| / |f_stick| = (D_t s mu F_n + C_V |f_stick|) / ((D_t s + C_V) |f_stick|)
                if (ball.C_V > 0) {
                    numerator[k] = ball.mu * ball.D_t * product(s, f_n, k) + ball.C_V * size[k];
                    denominator[k] = ball.D_t * product(s, size, k) + ball.C_V * size[k];
                } else {
                    numerator[k] = ball.mu * f_n[k];
                    denominator[k] = size[k];
                }
                share[k] = quotient(numerator, denominator, share, k);
                Fx[k] = product(share, fx, k);
                Fy[k] = product(share, fy, k);
            } else {
                Fx[k] = fx[k];
                Fy[k] = fy[k];
            }
            udotx[k] = -(Fx[k] + ball.K_t * x[ux][k]) / ball.D_t;
            udoty[k] = -(Fy[k] + ball.K_t * x[uy][k]) / ball.D_t;
            damper = ball.D_n * product(z, zdot2, k);
        } else {
            udotx[k] = -ball.K_t / ball.D_t * x[ux][k];
            udoty[k] = -ball.K_t / ball.D_t * x[uy][k];
            zz[k] = product(z, z, k);
            damper = -ball.K_n * product(zz, zdot, k);
        }
        slipx[k] = Vx[k] - udotx[k];
        slipy[k] = Vy[k] - udoty[k];
        udot2[k] = product(udotx, udotx, k) + product(udoty, udoty, k);
        power[k] = product(Fx, slipx, k) + product(Fy, slipy, k);

        ax[k] = product(z, Fx, k);  // force times s, s dv/dsigma = s^2 (F/s)
        ay[k] = product(z, Fy, k);
        az[k] = product(z, f_n, k);

        const Real step(static_cast<double>(k + 1));
        x[time_at][k + 1] = s[k] / step;
        x[s_at][k + 1] = zdot[k] / (2 * step);
        x[cx][k + 1] = product(s, x[vx], k) / step;
        x[cy][k + 1] = product(s, x[vy], k) / step;
        x[vx][k + 1] = ax[k] / ball.m / step;
        x[vy][k + 1] = ay[k] / ball.m / step;
        x[vz][k + 1] = (az[k] / ball.m - ball.g * s[k]) / step;
        x[wx][k + 1] = lever * ay[k] / step;
        x[wy][k + 1] = -lever * ax[k] / step;
        x[ux][k + 1] = product(s, udotx, k) / step;
        x[uy][k + 1] = product(s, udoty, k) / step;
        x[normal_damper][k + 1] = damper / step;
        x[tangential_damper][k + 1] = ball.D_t * product(z, udot2, k) / step;
        x[clutch][k + 1] = -product(z, power, k) / step;
        x[P_at][k + 1] = -ball.K_t * product(zdot, u2, k) / (4 * step);
    }
    return x;
}

}  // namespace detail

/// The run of a ball that starts in flight, to `options.end`.
template <class Real>
Reference<Real> reference_run(const Ball<Real>& ball, const State<Real>& start,
                              const ReferenceOptions<Real>& options = {}) {
    using namespace detail;
    // What an error in each quantity is measured against, in the paper's run.
    const std::array<Real, contact_dimension> scale{
        Real(0.1),  Real(0.1),   Real(0.01),               // centre (s in place of its height)
        Real(0.5),  Real(0.5),   Real(0.5),                // velocity
        Real(20),   Real(20),    Real(20),                 // angular velocity
        Real(1e-4), Real(1e-4),                            // bristle
        Real(0.01), Real(0.001), Real(0.01), Real(0.001),  // energies
        Real(0.01)};                                       // time

    Reference<Real> result;
    State<Real> y = start;
    Real t = 0;
    Phase phase = Phase::flight;
    auto record = [&](EventKind kind) { result.events.push_back({t, kind, y}); };

    while (t < options.end) {
        if (phase == Phase::flight) {
            const Real z = ball.r - y[cz], zdot = -y[vz];
            const Real reach = sqrt(Real(zdot * zdot - 2 * ball.g * z));
            const Real fall = zdot > 0 ? -2 * z / (zdot + reach) : (reach - zdot) / ball.g;
            const bool lands = !(t + fall > options.end);
            const Real dt = lands ? fall : options.end - t;
            const Real decay = exp(Real(-ball.K_t / ball.D_t * dt));
            y[cx] += y[vx] * dt;
            y[cy] += y[vy] * dt;
            y[cz] = lands ? ball.r : y[cz] + (y[vz] - ball.g * dt / 2) * dt;
            y[vz] -= ball.g * dt;
            y[ux] *= decay;
            y[uy] *= decay;
            t += dt;
            if (!lands) break;
            phase = apply(EventKind::touchdown, ball, y, record);
            continue;
        }

        // One visit to the ground, from touchdown to recovery.
        std::array<Real, contact_dimension> x;
        std::copy(y.begin(), y.end(), x.begin());
        x[s_at] = 0;  // so W = 0 too, and P = (33)
        x[time_at] = t;
        auto to_state = [&](const std::array<Real, contact_dimension>& from) {
            State<Real> state;
            std::copy(from.begin(), from.begin() + dimension, state.begin());
            state[cz] = ball.r - from[s_at] * from[s_at];
            state[tangential_spring] =
                from[P_at] + ball.K_t * from[s_at] * (from[ux] * from[ux] + from[uy] * from[uy]) / 2;
            return state;
        };
        while (phase != Phase::flight) {
            const ContactSeries<Real> series = expand(ball, phase, x, options.order);
            Real h = step_size(series, scale, options.tolerance, Real(1));
            ++result.steps;

            // The guards as functions of sigma, without the square roots that would cost digits near zero.
            auto guard = [&](std::size_t which) {
                return [&, which](const Real& sigma) -> Real {
                    const auto at = [&](std::size_t i) { return evaluate(series[i], sigma); };
                    const Real s = at(s_at), f_n = ball.K_n * s * s - ball.D_n * at(vz);
                    if (phase == Phase::recovering) return which == 0 ? s : -f_n;
                    if (which == 0) return f_n;
                    const Real fx = ball.K_t * at(ux) + ball.D_t * (at(vx) - ball.r * at(wy));
                    const Real fy = ball.K_t * at(uy) + ball.D_t * (at(vy) + ball.r * at(wx));
                    const Real cone = ball.mu * f_n - sqrt(Real(fx * fx + fy * fy));
                    return phase == Phase::stick ? cone : -cone;
                };
            };
            std::optional<std::size_t> fired;
            for (std::size_t which : {0u, 1u}) {
                if (const auto fall = first_fall<Real>(guard(which), h)) {
                    h = *fall;
                    fired = which;
                }
            }
            const bool ends =
                first_fall<Real>([&](const Real& sigma) { return options.end - evaluate(series[time_at], sigma); }, h)
                    .has_value();
            if (ends) {
                h = *first_fall<Real>([&](const Real& sigma) { return options.end - evaluate(series[time_at], sigma); },
                                      h);
            }
            x = evaluate(series, h);
            t = x[time_at];
            y = to_state(x);
            if (ends) {
                t = options.end;
                break;
            }
            if (!fired) continue;
            const EventKind kind = event_of(phase, *fired);
            if (kind == EventKind::recovered) {
                x[s_at] = 0;
                y[cz] = ball.r;
            }
            phase = apply(kind, ball, y, record);
        }
    }
    result.final = y;
    result.phase = phase;
    return result;
}

}  // namespace oracle
