// The paper's rolling ball as a competent user would write it by hand: Dormand & Prince's pair of order 5(4) with PI
// step control over a plain array, in plain time. Two of them: one that decides the phase inside the right-hand side,
// as codes of the gcontact kind do, and a stronger one that freezes the phase and locates the events.
//
// The equations are the oracle's, in double; nothing here is the library's.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "tests/oracle/paper_sphere.hpp"
#include "tests/oracle/timed_run.hpp"

namespace bench {

using oracle::Ball;
using oracle::Phase;
using oracle::State;
using oracle::TimedRun;

/// The right-hand side, with everything that is constant computed once.
class Rate {
public:
    explicit Rate(const Ball<double>& ball)
        : ball_(ball),
          per_m_(1 / ball.m),
          lever_(ball.r / ball.inertia()),
          per_D_t_(1 / ball.D_t),
          recovery_(ball.K_t / ball.D_t) {}

    /// In a given phase.
    State<double> operator()(Phase phase, const State<double>& y) const {
        const Geometry c = geometry(y);
        return rate(phase, y, c, phase == Phase::slip ? std::sqrt(c.fx * c.fx + c.fy * c.fy) : 0);
    }

    /// In the phase that the state itself tells.
    State<double> operator()(const State<double>& y) const {
        const Geometry c = geometry(y);
        if (!(c.z > 0)) return rate(Phase::flight, y, c, 0);
        if (!(c.f_n > 0)) return rate(Phase::recovering, y, c, 0);
        const double f_stick = std::sqrt(c.fx * c.fx + c.fy * c.fy);
        return rate(f_stick > ball_.mu * c.f_n ? Phase::slip : Phase::stick, y, c, f_stick);
    }

    const Ball<double>& ball() const { return ball_; }

private:
    struct Geometry {
        double z, zdot, s, Vx, Vy, f_n, fx, fy;
    };

    Geometry geometry(const State<double>& y) const {
        using namespace oracle;
        Geometry c;
        c.z = ball_.r - y[cz];
        c.zdot = -y[vz];
        c.s = c.z > 0 ? std::sqrt(c.z) : 0;
        c.Vx = y[vx] - ball_.r * y[wy];
        c.Vy = y[vy] + ball_.r * y[wx];
        c.f_n = ball_.K_n * c.z + ball_.D_n * c.zdot;
        c.fx = -(ball_.K_t * y[ux] + ball_.D_t * c.Vx);
        c.fy = -(ball_.K_t * y[uy] + ball_.D_t * c.Vy);
        return c;
    }

    State<double> rate(Phase phase, const State<double>& y, const Geometry& c, double f_stick) const {
        using namespace oracle;
        State<double> dy{};
        dy[cx] = y[vx];
        dy[cy] = y[vy];
        dy[cz] = y[vz];
        dy[vz] = -ball_.g;
        if (phase == Phase::flight || phase == Phase::recovering) {
            dy[ux] = -recovery_ * y[ux];
            dy[uy] = -recovery_ * y[uy];
            if (phase == Phase::recovering) dy[normal_damper] = -ball_.K_n * c.z * c.s * c.zdot;
        } else {
            double share = c.s;
            if (phase == Phase::slip) {
                const double D_ts = ball_.D_t * c.s;
                share *= (ball_.mu * c.f_n * D_ts + ball_.C_V * f_stick) / ((D_ts + ball_.C_V) * f_stick);
            }
            const double Fx = share * c.fx, Fy = share * c.fy;
            dy[vx] = Fx * per_m_;
            dy[vy] = Fy * per_m_;
            dy[vz] += c.s * c.f_n * per_m_;
            dy[wx] = lever_ * Fy;
            dy[wy] = -lever_ * Fx;
            if (phase == Phase::slip) {
                const double per_s = share / c.s;
                dy[ux] = c.s > 0 ? -(per_s * c.fx + ball_.K_t * y[ux]) * per_D_t_ : c.Vx;
                dy[uy] = c.s > 0 ? -(per_s * c.fy + ball_.K_t * y[uy]) * per_D_t_ : c.Vy;
                dy[clutch] = -(Fx * (c.Vx - dy[ux]) + Fy * (c.Vy - dy[uy]));
            } else {
                dy[ux] = c.Vx;
                dy[uy] = c.Vy;
            }
            dy[normal_damper] = ball_.D_n * c.s * c.zdot * c.zdot;
        }
        dy[tangential_damper] = ball_.D_t * c.s * (dy[ux] * dy[ux] + dy[uy] * dy[uy]);
        dy[tangential_spring] = ball_.K_t * c.s * (y[ux] * dy[ux] + y[uy] * dy[uy]);
        return dy;
    }

    Ball<double> ball_;
    double per_m_, lever_, per_D_t_, recovery_;
};

/// One step of the pair, its error estimate, and its dense output.
class DormandPrince {
public:
    explicit DormandPrince(double tolerance) : tolerance_(tolerance) {}

    /// The factor to the next step from the error of this one, by PI control; `accepted` remembers the error.
    double factor(double error, bool accepted) {
        constexpr double beta = 0.04, alpha = 0.2 - 0.75 * beta;
        double f = 0.9 * std::pow(std::max(error, 1e-10), -alpha);
        if (!accepted) return std::max(f, 0.2);
        f *= std::pow(previous_error_, beta);
        previous_error_ = std::max(error, 1e-4);
        return std::clamp(f, 0.2, 10.0);
    }

    /// Stages 2 to 7 from y with step h; the first stage, k(0), must be set. Returns the error in units of the
    /// tolerance: an error of 1 is just acceptable. `to` is the state at the end of the step.
    template <class Rate>
    double try_step(const State<double>& y, double h, Rate&& rate, State<double>& to) {
        auto stage = [&]<std::size_t N>(const double(&a)[N]) {
            State<double> x;
            for (std::size_t i = 0; i < x.size(); ++i) {
                double sum = 0;
                for (std::size_t j = 0; j < N; ++j) sum += a[j] * k_[j][i];
                x[i] = y[i] + h * sum;
            }
            return x;
        };
        k_[1] = rate(stage({1. / 5}));
        k_[2] = rate(stage({3. / 40, 9. / 40}));
        k_[3] = rate(stage({44. / 45, -56. / 15, 32. / 9}));
        k_[4] = rate(stage({19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729}));
        k_[5] = rate(stage({9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656}));
        to = stage({35. / 384, 0., 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84});
        k_[6] = rate(to);
        double sum = 0;
        for (std::size_t i = 0; i < y.size(); ++i) {
            const double error = h * (71. / 57600 * k_[0][i] - 71. / 16695 * k_[2][i] + 71. / 1920 * k_[3][i] -
                                      17253. / 339200 * k_[4][i] + 22. / 525 * k_[5][i] - 1. / 40 * k_[6][i]);
            const double scale = oracle::paper_scale[i] + std::max(std::abs(y[i]), std::abs(to[i]));
            sum += error * error / (scale * scale);
        }
        return std::sqrt(sum / static_cast<double>(y.size())) / tolerance_;
    }

    /// The state at y(t + x h) of the last step, to fourth order.
    State<double> dense(const State<double>& y, double h, double x) const {
        const double b[] = {x * (1 + x * (-1337. / 480 + x * (1039. / 360 + x * (-1163. / 1152)))),
                            100 * x * x * (1054. / 9275 + x * (-4682. / 27825 + x * (379. / 5565))) / 3,
                            -5 * x * x * (27. / 40 + x * (-9. / 5 + x * (83. / 96))) / 2,
                            18225 * x * x * (-3. / 250 + x * (22. / 375 + x * (-37. / 600))) / 848,
                            -22 * x * x * (-3. / 10 + x * (29. / 30 + x * (-17. / 24))) / 7};
        State<double> at;
        for (std::size_t i = 0; i < y.size(); ++i) {
            at[i] =
                y[i] + h * (b[0] * k_[0][i] + b[1] * k_[2][i] + b[2] * k_[3][i] + b[3] * k_[4][i] + b[4] * k_[5][i]);
        }
        return at;
    }

    State<double>& first() { return k_[0]; }
    const State<double>& last() const { return k_[6]; }

private:
    double tolerance_;
    double previous_error_ = 1e-4;
    std::array<State<double>, 7> k_{};
};

/// Phases decided inside the right-hand side: the steps run over the events.
class PlainLoop {
public:
    PlainLoop(const Ball<double>& ball, double tolerance) : rate_(ball), tolerance_(tolerance) {}

    TimedRun run(const State<double>& start, double end) const {
        TimedRun result;
        DormandPrince method(tolerance_);
        State<double> y = start, next;
        double t = 0, h = 1e-4;
        method.first() = rate_(y);
        result.evaluations = 1;
        while (t < end) {
            const bool last = t + h >= end;
            if (last) h = end - t;
            const double error = method.try_step(y, h, rate_, next);
            result.evaluations += 6;
            const bool accepted = error <= 1;
            const double factor = method.factor(error, accepted);
            if (accepted) {
                ++result.steps;
                t = last ? end : t + h;
                y = next;
                method.first() = method.last();
            }
            h *= factor;
        }
        result.final = y;
        return result;
    }

private:
    Rate rate_;
    double tolerance_;
};

/// Phases frozen during a step; the event that ends one is bracketed by bisection of the dense output, a step is taken
/// to it, and corrected once.
class FrozenLoop {
public:
    FrozenLoop(const Ball<double>& ball, double tolerance) : rate_(ball), tolerance_(tolerance) {}

    TimedRun run(const State<double>& start, double end) const {
        TimedRun result;
        DormandPrince method(tolerance_);
        State<double> y = start, next{};
        double t = 0, h = 1e-4;
        Phase phase = Phase::flight;
        auto rate = [&](const State<double>& x) { return rate_(phase, x); };
        auto guards = [&](const State<double>& x) { return oracle::guards(rate_.ball(), phase, x); };
        method.first() = rate(y);
        result.evaluations = 1;
        while (t < end) {
            const bool last = t + h >= end;
            if (last) h = end - t;
            const double error = method.try_step(y, h, rate, next);
            result.evaluations += 6;
            const bool accepted = error <= 1;
            const double proposed = h * method.factor(error, accepted);
            if (!accepted) {
                h = proposed;
                continue;
            }
            ++result.steps;
            const auto g = guards(next);
            if (g[0] > 0 && g[1] > 0) {
                t = last ? end : t + h;
                y = next;
                method.first() = method.last();
                h = proposed;
                continue;
            }

            double low = 0, high = 1;
            std::size_t fired = g[0] > 0 ? 1 : 0;
            while (high - low > 1e-15) {
                const double middle = (low + high) / 2;
                if (!(middle > low && middle < high)) break;
                const auto at = guards(method.dense(y, h, middle));
                if (at[0] > 0 && at[1] > 0) {
                    low = middle;
                } else {
                    high = middle;
                    fired = at[0] > 0 ? 1 : 0;
                }
            }
            // A secant through a step to the bracket and one a little beside it.
            const State<double> from = y, from_rate = method.first();
            double to = high * h;
            method.try_step(from, to, rate, next);
            const double value = guards(next)[fired];
            const State<double> slope_at = method.last();
            State<double> ahead = next;
            const double probe = 1e-7 * h;
            for (std::size_t i = 0; i < ahead.size(); ++i) ahead[i] += probe * slope_at[i];
            const double slope = (guards(ahead)[fired] - value) / probe;
            if (slope < 0) to = std::clamp(to - value / slope, 0.0, h);
            method.first() = from_rate;
            method.try_step(from, to, rate, y);
            result.evaluations += 12;
            t += to;
            phase = oracle::apply(oracle::event_of(phase, fired), rate_.ball(), y, [&](oracle::EventKind kind) {
                result.events.push_back({t, kind});
            });
            method.first() = rate(y);
            ++result.evaluations;
            h = 1e-6 * proposed;  // what follows an event may start as the square root of time
        }
        result.final = y;
        return result;
    }

private:
    Rate rate_;
    double tolerance_;
};

}  // namespace bench
