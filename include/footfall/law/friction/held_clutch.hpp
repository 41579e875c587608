// The bristle of a contact while depth, load and slip velocity are held.
//
// It relaxes at the rate K_t/D_t or so, for the paper's numbers within a quarter of a millisecond: an explicit step on
// `bristle_rate` is unstable beyond 2 D_t/K_t. What is done here is stable for every step:
//
//   no load   udot = -(K_t/D_t) u                 an exponential, exact                                  (31)
//   stick     udot = V, until |f_stick| = mu F_n  a straight line to a time that is a root of a quadratic    (32)
//   slip      (27), (30), (31)                    Rodas3: order 3, L-stable, with sub-steps as the error asks
//             with D_t = C_V = 0                  an arc on the cone, exact
//
// With V held, a contact goes at most through slip, stick and slip again. Rodas3 is a Rosenbrock method: Sandu, Verwer,
// Blom, Spee, Carmichael & Potra 1997, Atmospheric Environment 31:3459. Its Jacobian is exact, from dual numbers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "footfall/law/friction/held_friction.hpp"
#include "footfall/math/dual.hpp"
#include "footfall/math/vector.hpp"

namespace footfall {

/// A friction law with a bristle.
template <ClutchFriction Friction>
class HeldFriction<Friction> {
public:
    HeldFriction(const Friction& friction, double tolerance)
        : friction_(friction), dual_(friction.template cast<Slope>()), tolerance_(tolerance) {}

    void advance(const Load<double>& load, const Touch<double>& touch, double dt, std::span<double> x,
                 ContactStep& all) const noexcept {
        const Held held{load.scale, load.over_scale, touch.slip};
        Step step{all, vector_at<double>(x)};
        if (step.phase == Phase::flight || step.phase == Phase::recovering) {
            recover(held, dt, step);
        } else if (friction_.plastic()) {
            follow_plastic(held, dt, step);
        } else {
            follow(held, dt, step);
        }
        put_vector(x, 0, step.bristle);
        all = step.bristle.allFinite() ? ContactStep(step) : ContactStep::nothing(x);  // numbers beyond a double
    }

private:
    /// What does not change during the step: scale = s^ScalePower, s = sqrt(z), phi_n = F_n / scale.
    struct Held {
        double scale, phi_n;
        Vector2<double> V;
    };
    struct Step : ContactStep {
        Vector2<double> bristle;
    };
    using Slope = Dual<double, 2>;
    using DualFriction = decltype(std::declval<const Friction&>().template cast<Slope>());

    /// udot, F_f and the powers of damper and clutch: what is integrated; or what that has come to.
    template <class S>
    struct RatesOf {
        Vector2<S> bristle, force;
        S damper{}, clutch{};

        [[nodiscard]] friend RatesOf operator*(const S& k, const RatesOf& a) noexcept {
            return {k * a.bristle, k * a.force, k * a.damper, k * a.clutch};
        }
        [[nodiscard]] friend RatesOf operator+(const RatesOf& a, const RatesOf& b) noexcept {
            return {a.bristle + b.bristle, a.force + b.force, a.damper + b.damper, a.clutch + b.clutch};
        }
        [[nodiscard]] friend RatesOf operator-(const RatesOf& a, const RatesOf& b) noexcept { return a + S(-1) * b; }
    };
    using Rates = RatesOf<double>;
    using Jacobian = std::array<Rates, 2>;  // by each component of the bristle

    void recover(const Held& held, double dt, Step& step) const noexcept {
        const Friction& friction = friction_;
        const double stored = friction.stored_energy(held.scale, step.bristle);
        if (friction.damping > 0) {
            const double decay = friction.recovery_rate() * dt;
            step.bristle *= std::exp(-decay);
            step.tangential_damper = -stored * std::expm1(-2 * decay);
        } else {  // released at once
            step.bristle = {};
            step.tangential_damper = stored;
        }
    }

    // Damped: stick and slip ------------------------------------------------------------------------------------------

    void follow(const Held& held, double dt, Step& step) const noexcept {
        const Friction& friction = friction_;
        Vector2<double> impulse = Vector2<double>::Zero();
        double left = dt, proposed = dt;
        double size = std::max(step.bristle.norm(), friction.coefficient * held.phi_n / friction.stiffness);
        bool holds = step.phase == Phase::stick;
        for (int n = 0; left > 0 && n < most_sub_steps; ++n) {
            if (holds) {
                const double h = std::min(left, time_to_cone(held, step.bristle));
                const Vector2<double> middle = step.bristle + 0.5 * h * held.V;
                impulse += h * held.scale * friction.stick_force(held.V, middle);
                step.tangential_damper += h * held.scale * friction.damping * held.V.squaredNorm();
                step.bristle += h * held.V;
                step.phase = Phase::stick;
                holds = false;
                left = h < left ? left - h : 0;
                continue;
            }
            step.phase = Phase::slip;
            const auto [h, change] = sub_step(held, step.bristle, std::min(left, proposed), dt, size, proposed);
            step.bristle += change.bristle;
            impulse += change.force;
            step.tangential_damper += change.damper;
            step.clutch += change.clutch;
            size = std::max(size, step.bristle.norm());
            if (!step.bristle.allFinite()) return;
            left = h < left ? left - h : 0;
            holds = friction.coefficient > 0 && friction.cone_margin(held.phi_n, held.V, step.bristle) > 0;
            if (holds) step.phase = Phase::stick;
        }
        step.mean_friction_force = impulse / dt;
        step.left = left;
    }

    /// When a bristle that sticks reaches the cone, |K_t u + D_t V + K_t V t| = mu phi_n [s].
    [[nodiscard]] double time_to_cone(const Held& held, const Vector2<double>& u) const noexcept {
        const Friction& friction = friction_;
        const Vector2<double> w = -friction.stick_force(held.V, u), w_rate = friction.stiffness * held.V;
        const double radius = friction.coefficient * held.phi_n;
        const double a = w_rate.squaredNorm(), b = w.dot(w_rate), c = radius * radius - w.squaredNorm();
        if (!(a > 0)) return std::numeric_limits<double>::infinity();
        if (!(c > 0)) return b > 0 ? 0 : -2 * b / a;  // on the cone: it leaves, or crosses to the other side
        const double root = std::sqrt(b * b + a * c);
        return b > 0 ? c / (b + root) : (root - b) / a;  // of the two forms, the one that does not cancel
    }

    /// udot, forces and powers in slip, a little inside the cone as well. (27)-(31)
    template <class AnyFriction, class S>
    [[nodiscard]] static RatesOf<S> rates(const AnyFriction& friction, const Held& held, const Vector2<S>& u) noexcept {
        const S scale(held.scale);
        const auto t = friction.slip(scale, S(held.phi_n), S(0), held.V.template cast<S>(), u);
        const Vector2<S> force = scale * t.force;
        return {t.bristle_rate, force, scale * friction.damping * t.bristle_rate.squaredNorm(),
                -force.dot(t.clutch_velocity)};
    }

    struct SubStep {
        double h;
        Rates change;
    };

    /// One accepted sub-step of at most `h`; `proposed` becomes the next. It ends where the clutch takes hold.
    [[nodiscard]] SubStep sub_step(const Held& held, const Vector2<double>& u, double h, double dt, double size,
                                   double& proposed) const noexcept {
        const Friction& friction = friction_;
        const RatesOf<Slope> at =
            rates<DualFriction, Slope>(dual_, held, {Slope::variable(u[0], 0), Slope::variable(u[1], 1)});
        const auto part = [&at](auto&& of) -> Rates {
            return {{of(at.bristle[0]), of(at.bristle[1])},
                    {of(at.force[0]), of(at.force[1])},
                    of(at.damper),
                    of(at.clutch)};
        };
        const Rates f = part([](const Slope& x) { return x.value; });
        const Jacobian J{part([](const Slope& x) { return x.gradient[0]; }),
                         part([](const Slope& x) { return x.gradient[1]; })};
        const double margin = friction.cone_margin(held.phi_n, held.V, u);  // <= 0
        const double cone = friction.coefficient * held.phi_n;
        const double shortest = 1e-12 * dt;
        while (true) {
            const auto [change, error] = rodas3(held, u, h, f, J);
            const Vector2<double> end = u + change.bristle;
            const double bristle_size = std::max(size, end.norm());
            const double force_size = std::max(f.force.norm(), change.force.norm() / h);
            // What damper and clutch take is measured by the work of the force: far beyond D_t/K_t the damper's
            // quadrature is worth nothing while bristle and force are right already.
            // At rest nothing does work: what the bristle can hold is the measure then.
            const double work =
                force_size * held.V.norm() * dt + held.scale * friction.stiffness * bristle_size * bristle_size;
            const double taken = std::max(std::abs(error.damper), std::abs(error.clutch));
            const double wrong = std::max({ratio(error.bristle.norm(), bristle_size),
                                           ratio(error.force.norm(), force_size * dt), ratio(taken, work)}) /
                                 tolerance_;
            const double factor = 0.9 / std::cbrt(std::max(wrong, 1e-3));
            if (!(wrong <= 1) && h > shortest) {
                h *= std::isfinite(wrong) ? std::clamp(factor, 0.1, 0.9) : 0.1;
                continue;
            }
            const double overshoot = friction.cone_margin(held.phi_n, held.V, end);
            if (overshoot > tolerance_ * cone && margin < 0 && h > shortest) {
                h *= std::clamp(margin / (margin - overshoot), 0.05, 0.95);  // a secant to the cone
                continue;
            }
            proposed = h * std::clamp(factor, 0.2, 5.0);
            return {h, change};
        }
    }

    static double ratio(double error, double size) noexcept { return error > 0 ? error / size : 0; }

    /// The change of bristle and integrals over a step h, and the estimate of its error.
    [[nodiscard]] std::array<Rates, 2> rodas3(const Held& held, const Vector2<double>& u, double h, const Rates& f,
                                              const Jacobian& J) const noexcept {
        const double per_h = 1 / h, diagonal = 2 * per_h;  // gamma = 1/2
        // diagonal - J of the bristle: [[a, b], [c, d]]
        const double a = diagonal - J[0].bristle[0], b = -J[1].bristle[0], c = -J[0].bristle[1],
                     d = diagonal - J[1].bristle[1], per_determinant = 1 / (a * d - b * c);
        // The integrals follow from the bristle: their columns of the Jacobian are zero.
        const auto solve = [&](const Rates& right) {
            const Vector2<double>& r = right.bristle;
            const Vector2<double> k{(d * r[0] - b * r[1]) * per_determinant, (a * r[1] - c * r[0]) * per_determinant};
            Rates all = (1 / diagonal) * (right + k[0] * J[0] + k[1] * J[1]);
            all.bristle = k;
            return all;
        };
        const auto at = [&](const Rates& change) {
            return rates<Friction, double>(friction_, held, u + change.bristle);
        };
        const Rates k1 = solve(f);
        const Rates k2 = solve(f + 4 * per_h * k1);
        const Rates k3 = solve(at(2.0 * k1) + per_h * (k1 - k2));
        const Rates k4 = solve(at(2.0 * k1 + k3) + per_h * (k1 - k2 - 8.0 / 3.0 * k3));
        return {2.0 * k1 + k3 + k4, k4};
    }

    // D_t = C_V = 0 ---------------------------------------------------------------------------------------------------

    /// The bristle goes straight inside |u| <= rho = mu phi_n / K_t and turns towards V on the rim: with theta the
    /// angle between them, thetadot = -(|V|/rho) sin(theta), so tan(theta/2) decays exponentially.
    void follow_plastic(const Held& held, double dt, Step& step) const noexcept {
        const Friction& friction = friction_;
        const double rho = friction.coefficient * held.phi_n / friction.stiffness;
        const double spring = held.scale * friction.stiffness;
        Vector2<double>& u = step.bristle;
        if (const double beyond = u.norm() - rho; beyond > 0) {  // it comes down to the rim at once, force on the cone
            step.clutch = spring * rho * beyond;
            step.tangential_damper = 0.5 * spring * beyond * beyond;
            u = rho > 0 ? Vector2<double>(u * (rho / u.norm())) : Vector2<double>::Zero();
        }
        const double speed = held.V.norm();
        const double straight = rho > 0 ? std::min(dt, time_to_cone(held, u)) : 0;
        Vector2<double> integral = straight * (u + 0.5 * straight * held.V);  // of u
        u += straight * held.V;
        step.phase = Phase::stick;
        if (straight < dt && speed > 0) {
            step.phase = Phase::slip;
            if (rho > 0) {
                const Vector2<double> ahead = held.V / speed, aside(-ahead.y(), ahead.x());
                const double x = speed * (dt - straight) / rho;
                const double from = std::tan(0.5 * std::atan2(u.dot(aside), u.dot(ahead))), to = from * std::exp(-x);
                const auto sine = [](double t) { return 2 * t / (1 + t * t); };
                const auto cosine = [](double t) { return (1 - t * t) / (1 + t * t); };
                const double along = rho / speed * (x + std::log((1 + to * to) / (1 + from * from)));
                const double across = rho / speed * 2 * (std::atan(from) - std::atan(to));
                integral += rho * (along * ahead + across * aside);
                step.clutch += spring * rho * speed * along;
                u = rho * (cosine(to) * ahead + sine(to) * aside);
            }
        }
        step.mean_friction_force = -spring * integral / dt;
    }

    static constexpr int most_sub_steps = 100'000;

    Friction friction_;
    DualFriction dual_;
    double tolerance_;
};

}  // namespace footfall
