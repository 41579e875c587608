// One impact of a ball that slides along a line, without gravity, under the paper's normal law and the passive friction
// law: its equations written afresh, and integrated slowly. It shares nothing with the library.
//
// With s = sqrt(z), w = zdot and dt = s dsigma the state of the bristle is q = s u while z grows and u while it
// shrinks:
//   q' = s^2 udot_0,   u' = s udot_0,   ' = d/dsigma
// so that every sub-phase is smooth, and w = 0 ends one. udot_0 is that of (31), of which damper and clutch know.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "paper_sphere.hpp"
#include "real_math.hpp"

namespace oracle {

template <class Real>
struct PassiveImpact {
    struct Event {
        EventKind kind;
        Real time;  // from touchdown, s
    };
    std::vector<Event> events;                         // after the touchdown
    Real peak_stretch;                                 // u where the depth is largest, m
    Real slip_velocity;                                // of the lowest point, after the impact, m/s
    Real tangential_damper, clutch, stiffness_change;  // J
};

/// `ball.g` does not matter. `speed` > 0 is that of the impact, `slip` that of the ball's lowest point, m/s; `step` is
/// that of sigma, s/m^0.5.
template <class Real>
PassiveImpact<Real> passive_impact(const Ball<Real>& ball, Real speed, Real slip, Real step) {
    enum : std::size_t { s_at, w_at, V_at, stretch_at, time_at, damper_at, clutch_at, change_at, count };
    using Point = std::array<Real, count>;
    bool grows = true;
    Phase phase = Phase::slip;

    struct Forces {
        Real f_n, phi;  // F_n / s, f_stick / s
        Real u;
    };
    const auto forces = [&](const Point& y) {
        const Real s = y[s_at], u = grows ? (s > 0 ? Real(y[stretch_at] / s) : Real(0)) : y[stretch_at];
        return Forces{ball.K_n * s * s + ball.D_n * y[w_at], -(ball.K_t * u + ball.D_t * y[V_at]), u};
    };
    const auto rates = [&](const Point& y) {
        const Forces at = forces(y);
        const Real s = y[s_at], w = y[w_at];
        const bool presses = phase != Phase::recovering;
        Real F = 0;  // over s
        if (phase == Phase::stick) F = at.phi;
        if (phase == Phase::slip) {
            const Real size = at.phi < 0 ? Real(-at.phi) : at.phi;
            Real all = ball.mu * at.f_n;
            if (ball.C_V > 0) all = (ball.D_t * s * all + ball.C_V * size) / (ball.D_t * s + ball.C_V);
            F = at.phi < 0 ? Real(-all) : all;
        }
        const Real udot_0 = -(F + ball.K_t * at.u) / ball.D_t;
        Point rate;
        rate[s_at] = w / 2;
        rate[w_at] = presses ? Real(-s * s * at.f_n / ball.m) : Real(0);
        rate[V_at] = s * s * F * (1 / ball.m + ball.r * ball.r / ball.inertia());
        rate[stretch_at] = grows ? Real(s * s * udot_0) : Real(s * udot_0);
        rate[time_at] = s;
        rate[damper_at] = s * s * ball.D_t * udot_0 * udot_0;
        rate[clutch_at] = presses ? Real(-s * s * F * (y[V_at] - udot_0)) : Real(0);
        rate[change_at] = ball.K_t * (w < 0 ? Real(-w) : w) * at.u * at.u / 4;
        return rate;
    };
    const auto stepped = [&](const Point& y, const Real& h) {  // Runge and Kutta, order 4
        const auto along = [&](const Point& k, const Real& part) {
            Point p;
            for (std::size_t i = 0; i < count; ++i) p[i] = y[i] + part * k[i];
            return p;
        };
        const Point k1 = rates(y), k2 = rates(along(k1, h / 2)), k3 = rates(along(k2, h / 2)), k4 = rates(along(k3, h));
        Point end;
        for (std::size_t i = 0; i < count; ++i) end[i] = y[i] + h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
        return end;
    };
    // Positive while the sub-phase lasts: what ends the contact's phase, what ends its stick or slip, the turn.
    const auto guards = [&](const Point& y) {
        const Forces at = forces(y);
        if (phase == Phase::recovering) return std::array<Real, 3>{y[s_at], 1, 1};
        const Real inside = ball.mu * at.f_n - (at.phi < 0 ? Real(-at.phi) : at.phi);
        return std::array<Real, 3>{at.f_n, phase == Phase::stick ? inside : Real(-inside), grows ? y[w_at] : Real(1)};
    };

    PassiveImpact<Real> impact{};
    Point y{};
    y[w_at] = speed;
    y[V_at] = slip;
    if (guards(y)[1] < 0) phase = Phase::stick;
    for (;;) {
        const Point whole = stepped(y, step);
        const auto after = guards(whole);
        std::size_t ends = after.size();
        Real first = step;
        for (std::size_t k = 0; k < after.size(); ++k) {
            if (!(after[k] < 0)) continue;
            Real low = 0, high = step;
            for (;;) {
                const Real middle = (low + high) / 2;
                if (!(middle > low && middle < high)) break;
                (guards(stepped(y, middle))[k] < 0 ? high : low) = middle;
            }
            if (!(high < first) && ends < after.size()) continue;
            ends = k;
            first = high;
        }
        y = ends < after.size() ? stepped(y, first) : whole;
        if (ends == after.size()) continue;
        if (ends == 2) {
            y[stretch_at] = impact.peak_stretch = forces(y).u;
            grows = false;
            continue;
        }
        const EventKind kind = event_of(phase, ends);
        impact.events.push_back({kind, y[time_at]});
        if (kind == EventKind::recovered) break;
        phase = phase_after(kind);
    }
    impact.slip_velocity = y[V_at];
    impact.tangential_damper = y[damper_at];
    impact.clutch = y[clutch_at];
    impact.stiffness_change = y[change_at];
    return impact;
}

}  // namespace oracle
