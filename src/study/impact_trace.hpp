// One impact along the normal without gravity, over any scalar: with dual numbers, its derivatives with respect to the
// law's parameters, the mass and the speed come out of the same integration.
//
//   ds/dsigma = w/2,   dw/dsigma = -s F(s, w, x)/m,   dx/dsigma = s xdot(s, w, x),   dt/dsigma = s
//
// with s = sqrt(z), w = zdot and the states x of the law, where it has some that change while the impact lasts; which
// is regular at touchdown (docs/theory.md, "The onset of contact"). Contact ends where the force does (14).
//
// Steps are chosen by the values alone; the derivatives then have an error of the same order as the values, times how
// fast they grow. The end of contact moves with the parameters too, but the speed there does not notice to first order:
// the force is zero.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include <Eigen/Core>
#include <boost/math/tools/toms748_solve.hpp>

#include "footfall/law/any_normal.hpp"
#include "footfall/math/value_of.hpp"
#include "footfall/solve/dormand_prince_853.hpp"

namespace footfall::study {

/// Where a function that is `true` at `low` and `false` at `high` turns, to rounding.
template <class Predicate>
double turning_point(double low, double high, const Predicate& holds) {
    for (int i = 0; i < 100; ++i) {
        const double middle = (low + high) / 2;
        if (!(middle > low && middle < high)) break;
        (holds(middle) ? low : high) = middle;
    }
    return low;
}

/// A place in a sample of which the force is wanted.
enum class Branch { loading, unloading };

/// An impact, computed as it is asked for.
template <class S>
class ImpactTrace {
public:
    /// A law with its parameters over S, mass [kg] and speed into the ground [m/s], both > 0.
    ImpactTrace(const AnyNormal<S>& law, const S& mass, const S& speed, double tolerance = 1e-11)
        : law_(law), mass_(mass), speed_(speed), tolerance_(tolerance) {
        law_.begin_impact(speed);
    }

    /// -zdot where contact ends [m/s]; empty where it takes too many steps to get there.
    [[nodiscard]] std::optional<S> speed_out() const {
        return follow([](const Stepper&, double, double) {}, false);
    }

    /// The force [N] at times since touchdown [s], in order; before touchdown and after the end it is 0. False where
    /// the impact takes too many steps.
    [[nodiscard]] bool force_at_times(std::span<const S> times, std::span<S> forces) const {
        std::fill(forces.begin(), forces.end(), S(0));
        std::size_t next = 0;
        while (next < times.size() && value_of(times[next]) < 0) ++next;
        const auto visit = [&](const Stepper& step, double h, double end) {
            const double last = value_of(step.at(end, time));
            for (; next < times.size() && value_of(times[next]) <= last; ++next) {
                forces[next] = force_at(step, solve(step, h, 0, end, time, times[next]));
            }
        };
        return follow(visit, true).has_value();
    }

    /// The force [N] at indentations [m], on the way in or out. Deeper than the impact goes, it is the elastic force,
    /// which the others meet at the deepest point. False where the impact takes too many steps.
    [[nodiscard]] bool force_at_depths(std::span<const double> depths, std::span<const Branch> branches,
                                       std::span<S> forces) const {
        for (std::size_t i = 0; i < depths.size(); ++i) {
            forces[i] = clamped(law_.template force<0>(S(std::sqrt(depths[i])), S(0)).total());
        }
        const auto fill = [&](const Stepper& step, double h, double from, double to, Branch branch) {
            const double a = value_of(step.at(from, root)), b = value_of(step.at(to, root));
            for (std::size_t i = 0; i < depths.size(); ++i) {
                const double s = std::sqrt(depths[i]);
                if (branches[i] != branch || s < std::min(a, b) || s > std::max(a, b)) continue;
                forces[i] = force_at(step, solve(step, h, from, to, root, S(s)));
            }
        };
        double separation = 0;
        const auto visit = [&](const Stepper& step, double h, double end) {
            const auto sinks = [&](double theta) { return value_of(step.at(theta, rate)) > 0; };
            const double deepest = !sinks(0) ? 0 : sinks(end) ? end : turning_point(0, end, sinks);
            if (deepest > 0) fill(step, h, 0, deepest, Branch::loading);
            if (deepest < end) fill(step, h, deepest, end, Branch::unloading);
            separation = value_of(step.at(end, root));
        };
        if (!follow(visit, true)) return false;
        for (std::size_t i = 0; i < depths.size(); ++i) {
            if (branches[i] == Branch::unloading && std::sqrt(depths[i]) < separation) forces[i] = S(0);
        }
        return true;
    }

private:
    // Room for the law that has the most states that move; those that this law has not stay zero.
    static constexpr int moving = AnyNormal<S>::most_moving_states;
    using State = Eigen::Array<S, 3 + moving, 1>;
    static constexpr Eigen::Index root = 0, rate = 1, first_state = 2, time = 2 + moving;
    using Stepper = DormandPrince853<State, 2 + moving>;

    static S clamped(const S& force) { return force > S(0) ? force : S(0); }

    /// A depth of the order of the deepest point, as its root: where the law's force has done the work m v^2.
    [[nodiscard]] double depth_scale() const {
        const double energy = value_of(mass_) * std::pow(value_of(speed_), 2);
        const auto shallow = [&](double log_s) {
            const double s = std::exp(log_s);
            return s * s * value_of(law_.template force<0>(S(s), speed_).total()) < energy;
        };
        return std::exp(turning_point(std::log(1e-15), std::log(1e15), shallow));
    }

    /// Integrates to the end of contact. `visit(step, h, theta)` sees each step, of size h, with dense output from 0
    /// to theta if asked.
    template <class Visit>
    std::optional<S> follow(const Visit& visit, bool dense) const {
        using std::abs, std::pow;
        constexpr int most_steps = 5000;
        const double s_scale = depth_scale(), v = value_of(speed_), sigma_scale = 2 * s_scale / v;
        if (!(s_scale > 0) || !std::isfinite(sigma_scale) || !(v > 0)) return std::nullopt;
        const auto f = [&](const State& y, State& out, bool) {
            out[root] = S(0.5) * y[rate];
            out[rate] = -y[root] * force(y) / mass_;
            put_state_rates(y, out);
            out[time] = y[root];
        };
        typename Stepper::Values weight;
        weight.setZero();
        weight[root] = 1 / (tolerance_ * s_scale);
        weight[rate] = 1 / (tolerance_ * v);
        for (int k = 0; k < law_.moving_states(); ++k)
            weight[first_state + k] = 1 / (tolerance_ * law_.state_size(k, S(s_scale)));
        weight[time] = 1 / (tolerance_ * s_scale * sigma_scale);

        Stepper step;
        State y;
        y.setConstant(S(0));
        y[rate] = speed_;
        for (int k = 0; k < law_.moving_states(); ++k) y[first_state + k] = law_.begun()[static_cast<std::size_t>(k)];
        step.begin(f, y);
        double h = 1e-2 * sigma_scale;
        for (int i = 0; i < most_steps; ++i) {
            step.step(f, h);
            const double error = step.error(weight);
            const double factor = error > 0 ? 0.9 * pow(error, -1.0 / Stepper::order) : 5;
            if (!(error <= 1)) {
                h *= error > 1 ? std::max(0.2, factor) : 0.2;  // a NaN came from a step that was far too long
                continue;
            }
            step.finish(f);
            const bool ended = !presses(step.end());
            if (dense || ended) step.prepare_dense(f);
            if (ended) {
                const auto presses_at = [&](double theta) { return theta <= 0 || presses(moving_at(step, theta)); };
                const double end = turning_point(0, 1, presses_at);
                visit(step, h, end);
                return -step.at(end, rate);
            }
            visit(step, h, 1.0);
            const State end = step.end();
            step.advance(end);
            h *= std::clamp(factor, 0.2, 5.0);
        }
        return std::nullopt;
    }

    /// The place in the step of size h, between `from` and `to`, where a component that is monotonous there has the
    /// value `wanted`, with its derivatives: one step of Newton's method in dual numbers.
    [[nodiscard]] S solve(const Stepper& step, double h, double from, double to, Eigen::Index component,
                          const S& wanted) const {
        const auto excess = [&](double theta) { return value_of(step.at(theta, component)) - value_of(wanted); };
        const double first = excess(from), last = excess(to);
        double theta = std::abs(first) < std::abs(last) ? from : to;
        if (first * last < 0) {
            std::uintmax_t most = 60;
            const auto bracket = boost::math::tools::toms748_solve(excess, from, to, first, last,
                                                                   boost::math::tools::eps_tolerance<double>(50), most);
            theta = (bracket.first + bracket.second) / 2;
        }
        const S at_theta = step.at(theta, component);
        const double slope =
            h * (component == time ? value_of(step.at(theta, root)) : 0.5 * value_of(step.at(theta, rate)));
        const S place = S(theta) - (at_theta - wanted) / S(slope);
        using std::isfinite;
        return isfinite(place) && std::abs(value_of(place) - theta) < 1e-6 ? place : S(theta);
    }

    [[nodiscard]] S force_at(const Stepper& step, const S& theta) const {
        return clamped(force(moving_at(step, theta)));
    }

    /// All but the time.
    template <class Theta>
    [[nodiscard]] static State moving_at(const Stepper& step, const Theta& theta) {
        State y;
        for (Eigen::Index k = 0; k < time; ++k) y[k] = step.at(theta, k);
        y[time] = S(0);
        return y;
    }

    // The law in the states of y. Where no law has states that move, nothing is asked.

    [[nodiscard]] std::span<const S> states_in(const State& y) const {
        return {y.data() + first_state, static_cast<std::size_t>(law_.moving_states())};
    }
    [[nodiscard]] bool states_move() const { return moving > 0 && law_.moving_states() > 0; }
    [[nodiscard]] S force(const State& y) const {
        return (states_move() ? law_.template force<0>(y[root], y[rate], states_in(y))
                              : law_.template force<0>(y[root], y[rate]))
            .total();
    }
    [[nodiscard]] bool presses(const State& y) const {
        if (!(y[root] > S(0))) return false;
        return (states_move() ? law_.load(y[root], y[rate], states_in(y)) : law_.load(y[root], y[rate])) > S(0);
    }
    void put_state_rates(const State& y, State& out) const {
        if (moving == 0) return;
        out.template segment<moving>(first_state).setConstant(S(0));
        const auto n = states_in(y).size();
        law_.rates(y[root], y[rate], states_in(y), std::span<S>(out.data() + first_state, n));
        for (std::size_t k = 0; k < n; ++k) out[first_state + static_cast<Eigen::Index>(k)] *= y[root];
    }

    AnyNormal<S> law_;
    S mass_, speed_;
    double tolerance_;
};

}  // namespace footfall::study
