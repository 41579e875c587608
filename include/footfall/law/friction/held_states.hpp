// The internal states of a friction law with a force in proportion to the load, while load and velocities are held.
//
// The states obey xdot = h(V, x), which is integrated by the pair of order 3(2) of Bogacki & Shampine 1989 (Applied
// Mathematics Letters 2:321), with sub-steps as its error asks: stable for every step of the host, since the error
// grows before an instability does. Where the margin of a law that jumps falls to zero, a sub-step is made to end
// there, and the law jumps.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "footfall/law/friction/held_friction.hpp"
#include "footfall/law/friction/rate_friction.hpp"

namespace footfall {

/// A friction law with a force in proportion to the load.
template <class Law>
    requires(RateFriction<Law> || CoupledFriction<Law>)
class HeldFriction<Law> {
public:
    /// `tolerance` is relative to the law's own sizes of its states.
    HeldFriction(const Law& law, double tolerance) : law_(law), tolerance_(tolerance) {}

    /// Without a load the states become those of a new contact.
    void advance(const Load<double>& load, const Touch<double>& touch, double dt, std::span<double> states,
                 ContactStep& step) const noexcept {
        const std::span<double> x = states.first(Law::states);
        if (step.phase != Phase::stick && step.phase != Phase::slip) {
            std::fill(x.begin(), x.end(), 0.0);
            return;
        }
        Integrals total{};
        double left = dt, proposed = dt;
        bool entered = false;  // the phase has just begun, where the margin is often zero
        for (int n = 0; left > 0 && n < most_sub_steps; ++n) {
            if (!entered && !(margin(step.phase, touch, x) > 0)) {
                const FrictionChange<double> change = part().cross(step.phase, touch, one_newton, x);
                entered = change.phase != step.phase;
                step.phase = change.phase;
                total[3] += change.clutch;
            }
            const double h = sub_step(step.phase, touch, x, std::min(left, proposed), dt, total, proposed);
            entered = false;
            left = h < left ? left - h : 0;
        }
        const double F_n = load.force();
        step.mean_friction_force = F_n / dt * Vector2<double>(total[0], total[1]);
        step.tangential_damper = F_n * total[2];
        step.clutch = F_n * total[3];
        step.left = left;
    }

private:
    using States = std::array<double, max_friction_states>;
    using Integrals = std::array<double, 4>;  // of tau, of what the damper takes, of what is left for the clutch

    struct Rates {
        States x;
        Integrals rest;
    };

    /// All is in proportion to the load: it is followed under this one.
    static constexpr Load<double> one_newton{1, 1};

    [[nodiscard]] FrictionPart<Law> part() const noexcept { return {law_}; }
    [[nodiscard]] double margin(Phase phase, const Touch<double>& touch, std::span<const double> x) const noexcept {
        return part().margin(phase, touch, one_newton, 0, x);
    }
    [[nodiscard]] Rates rates(Phase phase, const Touch<double>& touch, std::span<const double> x) const noexcept {
        Rates r;
        Response<double> t;
        part().respond(phase, touch, one_newton, x, std::span(r.x).first(x.size()), t);
        r.rest = {t.push.friction.x(), t.push.friction.y(), t.power[by_tangential_damper], t.power[by_clutch]};
        return r;
    }

    /// One accepted sub-step of at most `h`, returned; `proposed` becomes the next.
    double sub_step(Phase phase, const Touch<double>& touch, std::span<double> x, double h, double dt, Integrals& total,
                    double& proposed) const noexcept {
        const std::size_t n = x.size();
        const double shortest = 1e-12 * dt, before = margin(phase, touch, x);
        const Rates k1 = rates(phase, touch, x);
        States at{};
        const auto moved = [&](double a, const Rates& r) {
            for (std::size_t i = 0; i < n; ++i) at[i] = x[i] + h * a * r.x[i];
            return rates(phase, touch, std::span<const double>(at).first(n));
        };
        while (true) {
            const Rates k2 = moved(0.5, k1), k3 = moved(0.75, k2);
            for (std::size_t i = 0; i < n; ++i)
                at[i] = x[i] + h * (2.0 / 9 * k1.x[i] + 1.0 / 3 * k2.x[i] + 4.0 / 9 * k3.x[i]);
            const std::span<const double> end = std::span<const double>(at).first(n);
            const Rates k4 = rates(phase, touch, end);
            double wrong = 0;
            for (std::size_t i = 0; i < n; ++i) {
                const double error =
                    h * (-5.0 / 72 * k1.x[i] + 1.0 / 12 * k2.x[i] + 1.0 / 9 * k3.x[i] - 1.0 / 8 * k4.x[i]);
                // A NaN counts as wrong.
                const double relative = std::abs(error) / (tolerance_ * law_.state_size(static_cast<int>(i)));
                wrong = relative <= wrong ? wrong : relative;
            }
            const double factor = 0.9 / std::cbrt(std::max(wrong, 1e-3));
            if (!(wrong <= 1) && h > shortest) {
                h *= std::isfinite(wrong) ? std::clamp(factor, 0.1, 0.9) : 0.1;
                continue;
            }
            const double after = margin(phase, touch, end);
            if (after < -tolerance_ * std::abs(before) && after < before && h > shortest) {
                // A secant to where the phase ends; one that ends as it begins ends soon.
                h *= before > 0 ? std::clamp(before / (before - after), 0.05, 0.95) : 0.05;
                continue;
            }
            for (std::size_t j = 0; j < total.size(); ++j) {
                total[j] += h * (2.0 / 9 * k1.rest[j] + 1.0 / 3 * k2.rest[j] + 4.0 / 9 * k3.rest[j]);
            }
            std::copy(end.begin(), end.end(), x.begin());
            proposed = h * std::clamp(factor, 0.2, 5.0);
            return h;
        }
    }

    /// About a second of work for each contact. More are not taken.
    static constexpr int most_sub_steps = 1'000'000;

    Law law_;
    double tolerance_;
};

}  // namespace footfall
