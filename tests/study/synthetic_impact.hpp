// Synthetic force traces of one impact under Azad & Featherstone's law (13), written afresh: it shares nothing with the
// library. Classical Runge-Kutta in sigma, where the equations are polynomial (docs/theory.md, "The onset of contact").
#pragma once

#include <array>
#include <cmath>
#include <vector>

namespace synthetic {

struct Impact {
    double stiffness, damping, mass, speed;  ///< K_n [N/m^1.5], D_n [N s/m^1.5], m [kg], v [m/s]

    using State = std::array<double, 3>;  ///< s = sqrt(z), zdot, t

    [[nodiscard]] State step(const State& y, double h) const {
        const auto rate = [this](const State& x) {
            const double s = x[0], w = x[1];
            return State{w / 2, -s * s * (stiffness * s * s + damping * w) / mass, s};
        };
        const auto moved = [&](const State& k, double by) {
            return State{y[0] + by * k[0], y[1] + by * k[1], y[2] + by * k[2]};
        };
        const State a = rate(y), b = rate(moved(a, h / 2)), c = rate(moved(b, h / 2)), d = rate(moved(c, h));
        State out = y;
        for (std::size_t i = 0; i < 3; ++i) out[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
        return out;
    }
    [[nodiscard]] double force(const State& y) const {
        return std::fmax(y[0] * (stiffness * y[0] * y[0] + damping * y[1]), 0);
    }
    [[nodiscard]] bool over(const State& y) const {
        return y[2] > 0 && (y[0] <= 0 || stiffness * y[0] * y[0] + damping * y[1] <= 0);
    }
    /// How far in sigma a step goes.
    [[nodiscard]] double step_size() const {
        return 2 * std::pow(mass * speed * speed / stiffness, 0.2) / speed / 1000;
    }

    /// The force at `times` since touchdown, in order; 0 after contact.
    [[nodiscard]] std::vector<double> force_at(const std::vector<double>& times) const {
        std::vector<double> forces;
        State y{0, speed, 0};
        const double h = step_size();
        for (const double t : times) {
            State next = step(y, h);
            while (!over(y) && next[2] < t) y = next, next = step(y, h);
            State at = y;  // by Newton's method to the time within the step
            for (int i = 0; i < 8 && !over(y); ++i) {
                const double slope = std::fmax(at[0], 1e-3 * h * speed);
                at = step(at, (t - at[2]) / slope);
            }
            forces.push_back(over(y) || over(at) || t <= 0 ? 0 : force(at));
        }
        return forces;
    }

    /// When contact ends.
    [[nodiscard]] double duration() const {
        State y{0, speed, 0};
        while (!over(y)) y = step(y, step_size());
        return y[2];
    }
};

}  // namespace synthetic
