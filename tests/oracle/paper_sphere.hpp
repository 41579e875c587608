// The ball of Azad & Featherstone (2010), section 4, on the plane z = 0: the equations written from the paper, for
// the oracles and the baselines. It shares nothing with the library.
//
// The phase of the contact is an argument, never decided here: in one phase the equations are smooth.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "real_math.hpp"

namespace oracle {

enum class Phase { flight, slip, stick, recovering };
enum class EventKind { touchdown, stick, slip, separation, recovered };

inline std::string_view name_of(EventKind kind) {
    constexpr std::array<std::string_view, 5> names{"touchdown", "stick", "slip", "separation", "recovered"};
    return names[static_cast<std::size_t>(kind)];
}

/// A homogeneous ball and the ground under it, in SI units and the paper's symbols.
template <class Real>
struct Ball {
    Real m, r;      // kg, m
    Real K_n, D_n;  // N/m^1.5, N s/m^1.5
    Real K_t, D_t;  // N/m^1.5, N s/m^1.5
    Real mu, C_V;   // 1, N s/m
    Real g;         // m/s^2, downwards

    Real inertia() const { return 2 * m * r * r / 5; }

    template <class Other>
    Ball<Other> cast() const {
        return {Other(m), Other(r), Other(K_n), Other(D_n), Other(K_t), Other(D_t), Other(mu), Other(C_V), Other(g)};
    }
};

/// The ball of section 4. The values are the doubles nearest to the paper's decimals, for every real type.
inline Ball<double> paper_ball() {
    return {.m = 0.154,
            .r = 0.0165,
            .K_n = 8.5e6,
            .D_n = 3.1e3,
            .K_t = 12.75e6,
            .D_t = 3.1e3,
            .mu = 0.2,
            .C_V = 0.1,
            .g = 9.81};
}

/// Where each quantity stands in a state.
enum : std::size_t {
    cx,
    cy,
    cz,  // centre, m
    vx,
    vy,
    vz,  // its velocity, m/s
    wx,
    wy,
    wz,  // angular velocity, rad/s
    ux,
    uy,                 // bristle, m
    normal_damper,      // (16) with the clamp (14), J
    tangential_damper,  // (28), J
    clutch,             // minus (29), J
    tangential_spring,  // (33) as printed, J: its rate is regular at z = 0, that of P is not
    dimension
};

template <class Real>
using State = std::array<Real, dimension>;

/// Section 4: centre 10 cm high, 0.5 m/s along x and along y.
inline State<double> paper_start() {
    State<double> y{};
    y[cz] = 0.10;
    y[vx] = 0.5;
    y[vy] = 0.5;
    return y;
}

template <class To, class From, std::size_t N>
std::array<To, N> cast(const std::array<From, N>& from) {
    std::array<To, N> to;
    for (std::size_t i = 0; i < N; ++i) to[i] = To(from[i]);
    return to;
}

/// What decides the phase. Forces are divided by s = sqrt(z), so that they are regular at touchdown.
template <class Real>
struct Contact {
    Real z, zdot, s;
    Real Vx, Vy;  // velocity of the ball's lowest point
    Real f_n;     // F_n / s without the clamp: K_n z + D_n zdot
    Real fx, fy;  // f_stick / s: -(K_t u + D_t V)

    Real f_stick() const { return sqrt(Real(fx * fx + fy * fy)); }
    /// > 0 inside the friction cone.
    Real cone(const Ball<Real>& ball) const { return ball.mu * f_n - f_stick(); }
};

template <class Real>
inline Contact<Real> contact_of(const Ball<Real>& ball, const State<Real>& y) {
    Contact<Real> c;
    c.z = ball.r - y[cz];
    c.zdot = -y[vz];
    c.s = c.z > 0 ? sqrt(c.z) : Real(0);
    c.Vx = y[vx] - ball.r * y[wy];  // (36) with CP = (0, 0, -r)
    c.Vy = y[vy] + ball.r * y[wx];
    c.f_n = ball.K_n * c.z + ball.D_n * c.zdot;
    c.fx = -(ball.K_t * y[ux] + ball.D_t * c.Vx);
    c.fy = -(ball.K_t * y[uy] + ball.D_t * c.Vy);
    return c;
}

/// dy/dt in a given phase.
template <class Real>
inline State<Real> derivative(const Ball<Real>& ball, Phase phase, const State<Real>& y) {
    const Contact<Real> c = contact_of(ball, y);
    Real F_n = 0, Fx = 0, Fy = 0, f_D = 0;
    Real udotx = -ball.K_t / ball.D_t * y[ux];  // (31) with F_f = 0
    Real udoty = -ball.K_t / ball.D_t * y[uy];
    if (phase == Phase::stick || phase == Phase::slip) {
        F_n = c.s * c.f_n;              // (3), (10), (12)
        f_D = ball.D_n * c.s * c.zdot;  // (12)
        // Along f_stick, (27), (30) and (31) give |F_f| (C_V + D_t s) = mu F_n D_t s + C_V |f_stick|.
        Real share = 1;
        if (phase == Phase::slip) {
            share = ball.mu * c.f_n / c.f_stick();
            if (ball.C_V > 0) {
                const Real D_ts = ball.D_t * c.s;
                share = (share * D_ts + ball.C_V) / (D_ts + ball.C_V);
            }
        }
        Fx = share * c.s * c.fx;
        Fy = share * c.s * c.fy;
        udotx = -(share * c.fx + ball.K_t * y[ux]) / ball.D_t;  // (31)
        udoty = -(share * c.fy + ball.K_t * y[uy]) / ball.D_t;
    } else if (phase == Phase::recovering) {
        f_D = -ball.K_n * c.z * c.s;  // (14)
    }

    const Real lever = ball.r / ball.inertia();
    State<Real> dy;
    dy[cx] = y[vx];
    dy[cy] = y[vy];
    dy[cz] = y[vz];
    dy[vx] = Fx / ball.m;  // (34)
    dy[vy] = Fy / ball.m;
    dy[vz] = F_n / ball.m - ball.g;
    dy[wx] = lever * Fy;  // (35): CP x F, the inertia being isotropic
    dy[wy] = -lever * Fx;
    dy[wz] = 0;
    dy[ux] = udotx;
    dy[uy] = udoty;
    dy[normal_damper] = f_D * c.zdot;
    dy[tangential_damper] = ball.D_t * c.s * (udotx * udotx + udoty * udoty);
    dy[clutch] = -(Fx * (c.Vx - udotx) + Fy * (c.Vy - udoty));                 // (29), (30)
    dy[tangential_spring] = ball.K_t * c.s * (y[ux] * udotx + y[uy] * udoty);  // (33)
    return dy;
}

/// The guards of a phase: positive in it; the first to fall through zero ends it. A phase with one guard has the
/// second at 1.
template <class Real>
inline std::array<Real, 2> guards(const Ball<Real>& ball, Phase phase, const State<Real>& y) {
    const Contact<Real> c = contact_of(ball, y);
    switch (phase) {
        case Phase::flight:
            return {-c.z, Real(1)};
        case Phase::slip:
            return {c.f_n, -c.cone(ball)};
        case Phase::stick:
            return {c.f_n, c.cone(ball)};
        case Phase::recovering:
            break;
    }
    return {c.z, -c.f_n};
}

inline EventKind event_of(Phase phase, std::size_t guard) {
    switch (phase) {
        case Phase::flight:
            return EventKind::touchdown;
        case Phase::slip:
            return guard == 0 ? EventKind::separation : EventKind::stick;
        case Phase::stick:
            return guard == 0 ? EventKind::separation : EventKind::slip;
        case Phase::recovering:
            break;
    }
    return guard == 0 ? EventKind::recovered : EventKind::touchdown;
}

/// The phase that an event begins.
inline Phase phase_after(EventKind kind) {
    switch (kind) {
        case EventKind::stick:
            return Phase::stick;
        case EventKind::touchdown:
        case EventKind::slip:
            return Phase::slip;
        case EventKind::separation:
            return Phase::recovering;
        case EventKind::recovered:
            break;
    }
    return Phase::flight;
}

/// Passes an event to `record`, and returns the phase that follows. A clutch that can hold at touchdown takes hold
/// there: `stick` at the same time.
template <class Real, class Record>
Phase apply(EventKind kind, const Ball<Real>& ball, const State<Real>& y, Record&& record) {
    record(kind);
    if (kind != EventKind::touchdown || contact_of(ball, y).cone(ball) < 0) return phase_after(kind);
    record(EventKind::stick);
    return Phase::stick;
}

/// W = (1/2) K_t sqrt(z) |u|^2, what the tangential spring holds [J].
template <class Real>
inline Real stored_in_bristle(const Ball<Real>& ball, const State<Real>& y) {
    return ball.K_t * contact_of(ball, y).s * (y[ux] * y[ux] + y[uy] * y[uy]) / 2;
}

/// P = (33) - W = -integral of (1/4) K_t zdot |u|^2 / sqrt(z) dt [J].
template <class Real>
inline Real stiffness_change(const Ball<Real>& ball, const State<Real>& y) {
    return y[tangential_spring] - stored_in_bristle(ball, y);
}

/// What is constant: body, springs and losses, with zero potential at z = 0. (15), (17), (33), (37)
template <class Real>
inline Real total_energy(const Ball<Real>& ball, const State<Real>& y) {
    const Contact<Real> c = contact_of(ball, y);
    const Real kinetic = (ball.m * (y[vx] * y[vx] + y[vy] * y[vy] + y[vz] * y[vz]) +
                          ball.inertia() * (y[wx] * y[wx] + y[wy] * y[wy] + y[wz] * y[wz])) /
                         2;
    const Real normal_spring = 2 * ball.K_n * c.s * c.s * c.s * c.s * c.s / 5;
    return kinetic + ball.m * ball.g * y[cz] + normal_spring + y[tangential_spring] + y[normal_damper] +
           y[tangential_damper] + y[clutch];
}

}  // namespace oracle
