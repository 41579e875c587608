// The first guards that fall through zero inside a step.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <boost/math/tools/toms748_solve.hpp>

#include "footfall/math/value_of.hpp"
#include "footfall/solve/dip.hpp"
#include "footfall/solve/first_zero.hpp"

namespace footfall {

/// The guards that fall through zero together, at a share theta of a step.
template <class Value>
struct CrossedGuards {
    std::vector<int> guards;
    Value theta = Value(1);
    Value slope = Value(-1);  ///< d(first guard)/d(theta) there
    explicit operator bool() const noexcept { return !guards.empty(); }
    [[nodiscard]] int first() const noexcept { return guards.front(); }
};

/// Searches on the interpolant of a solver's step, all guards by one evaluation at a point.
template <class Solver>
class CrossingSearch {
public:
    using S = typename Solver::S;
    using Value = typename Solver::Value;
    using Guards = typename Solver::Guards;
    using Crossing = CrossedGuards<Value>;

    explicit CrossingSearch(Solver& solver) : solver_(solver) {}

    /// In the step that the method has just taken, whose end has these guards.
    [[nodiscard]] Crossing find(const Guards& at_end) {
        sampled_.fill(false);
        Crossing first = end_of_clock();
        candidates_.clear();
        for (int j = 0; j < solver_.guard_count(); ++j) {
            if (solver_.silent(j)) continue;
            if (at_end[j] < S(0) || comes_near(j, at_end) || turns(j)) candidates_.push_back(j);
        }
        if (!candidates_.empty()) find_first_of_candidates(at_end, first);
        return first;
    }

private:
    static constexpr std::size_t index(int i) { return static_cast<std::size_t>(i); }
    static Value eps() { return std::numeric_limits<Value>::epsilon(); }

    /// Crossings nearer than this share of a step are one.
    static constexpr double coincidence = 1e-11;

    // Whether a guard that is positive at the step's ends may have been below zero between them.
    [[nodiscard]] bool comes_near(int j, const Guards& at_end) const {
        const Value start = value_of(solver_.guards_[j]), end = value_of(at_end[j]);
        const Value near = Value(0.1) * std::min(start, end);
        if (value_of(solver_.lowest_[j]) < near) return true;
        // The implicit method looks where its iterations lead.
        return !solver_.method_.implicit() &&
               least_between(start, value_of(solver_.looked_[0][j]), value_of(solver_.looked_[1][j]), end, near) < near;
    }

    // Whether the clock reaches its end inside the step.
    [[nodiscard]] Crossing end_of_clock() {
        Crossing at_end_time;
        if (solver_.system_.uniform()) {  // then the step was cut to end there
            if (!(solver_.clock(solver_.method_.end()) < solver_.end_ * (Value(1) - Value(4) * eps())))
                at_end_time.guards = {solver_.end_of_run()};
            return at_end_time;
        }
        if (!(solver_.clock(solver_.method_.end()) > solver_.end_)) return at_end_time;
        const auto remaining = [&](Value theta) { return solver_.end_ - solver_.clock_at(theta); };
        at_end_time.theta = first_zero<Value>(remaining, solver_.end_ - solver_.now());
        at_end_time.slope = slope(remaining, at_end_time.theta);
        at_end_time.guards = {solver_.end_of_run()};
        return at_end_time;
    }

    // Of many guards that may cross, few need to be followed. The one that seems to come first is; then one evaluation
    // of all, a little before and a little after its crossing, tells which others are earlier, which coincide and which
    // are later.
    void find_first_of_candidates(const Guards& at_end, Crossing& first) {
        falls_.clear();
        for (const int j : candidates_) {
            const Bracket<Value> in = fall_of(j, at_end);
            if (in) falls_.push_back({j, in});
        }
        std::stable_sort(falls_.begin(), falls_.end(),
                         [](const Fall& a, const Fall& b) { return a.seems() < b.seems(); });
        Value known_at(-1);  // where before_ and after_ are
        for (auto& [j, in] : falls_) {
            if (first && in.from > first.theta + Value(coincidence)) continue;
            if (first && in.from < first.theta && in.to > first.theta) {
                if (known_at != first.theta) {
                    before_ = solver_.guards_at(std::max(first.theta - Value(coincidence), Value(0)));
                    after_ = solver_.guards_at(first.theta + Value(coincidence));
                    known_at = first.theta;
                }
                if (value_of(after_[j]) > Value(0)) continue;
                if (value_of(before_[j]) > Value(0)) {
                    coincide(j, first);
                    continue;
                }
                in.to = std::max(first.theta - Value(coincidence), Value(0));
                in.at_to = value_of(before_[j]);
                if (!(in.to > in.from)) in.to = in.from, in.at_to = Value(0);
            }
            const auto value = [&, guard = j](Value theta) { return guard_at(theta, guard); };
            const Value theta = zero_in(in, value);
            if (first && std::abs(theta - first.theta) < Value(coincidence)) {
                coincide(j, first);
            } else if (!first || theta < first.theta) {
                first.guards = {j};
                first.theta = theta;
            }
        }
        if (first && first.first() != solver_.end_of_run())
            first.slope = slope([&](Value theta) { return guard_at(theta, first.first()); }, first.theta);
    }

    // Guard j falls through zero where the first ones do.
    void coincide(int j, Crossing& first) const {
        if (first.first() == solver_.end_of_run()) {
            first.guards = {j};  // what happens at the end has happened
            return;
        }
        for (int& k : first.guards) {
            if (solver_.group(k) != solver_.group(j)) continue;
            if (solver_.system_.outranks(j, k)) k = j;
            return;
        }
        first.guards.push_back(j);
    }

    // Where guard j first falls through zero in the step, if it does.
    [[nodiscard]] Bracket<Value> fall_of(int j, const Guards& at_end) {
        const auto value = [&](Value theta) { return guard_at(theta, j); };
        const auto sample = [&](int k) { return guard_sample(k, j); };
        const auto counts = [&](const Bracket<Value>& in) {
            return !solver_.system_.blind(j) || solver_.system_.approaches(j, solver_.interpolated(zero_in(in, value)));
        };
        Bracket<Value> in =
            first_fall<Value>(value, sample, solver_.armed_[index(j)] ? value_of(solver_.guards_[j]) : Value(0));
        if (!solver_.system_.blind(j) || (!in && !(at_end[j] < S(0)))) return in;
        // Rounding has put a guard that rises on the wrong side: it may fall later in the step.
        if (in && !counts(in)) in = first_fall<Value>(value, sample, Value(0));
        if (in && counts(in)) return in;
        if (at_end[j] < S(0)) {
            const Value turn = turning_point(j);
            if (solver_.system_.approaches(j, solver_.interpolated(turn))) return {turn, Value(0), turn, Value(0)};
        }
        if (in) solver_.armed_[index(j)] = false;
        return {};
    }

    // Where a blind guard that rises at the step's start turns: the end of a rise too small to see.
    [[nodiscard]] Value turning_point(int j) {
        const auto fall = [&](Value theta) { return solver_.system_.approach(j, solver_.interpolated(theta)); };
        const Value at_start = fall(Value(0)), at_end = fall(Value(1));
        if (!(at_start < Value(0)) || !(at_end > Value(0))) return Value(0);
        std::uintmax_t iterations = 60;
        return boost::math::tools::toms748_solve(fall, Value(0), Value(1), at_start, at_end,
                                                 boost::math::tools::eps_tolerance<Value>(), iterations)
            .second;
    }

    // A blind guard that turns round within the step may have been below zero and back.
    [[nodiscard]] bool turns(int j) const {
        return solver_.system_.blind(j) && solver_.system_.approach(j, solver_.method_.start()) > Value(0) &&
               solver_.system_.approach(j, solver_.method_.end()) < Value(0);
    }

    [[nodiscard]] Value guard_at(const Value& theta, int j) { return value_of(solver_.guards_at(theta)[j]); }
    [[nodiscard]] Value guard_sample(int k, int j) {
        Guards& kept = samples_[index(k)];
        if (!sampled_[index(k)]) {
            kept = solver_.guards_at(Value(k) / Value(first_zero_samples));
            sampled_[index(k)] = true;
        }
        return value_of(kept[j]);
    }

    template <class F>
    [[nodiscard]] static Value slope(F&& f, const Value& theta) {
        const Value d(1e-4);
        return (f(theta + d) - f(theta - d)) / (Value(2) * d);
    }

    Solver& solver_;
    Guards before_, after_;  // a little before and a little after the first crossing known
    std::array<Guards, first_zero_samples + 1> samples_;
    std::array<bool, first_zero_samples + 1> sampled_{};
    std::vector<int> candidates_;
    struct Fall {
        int guard;
        Bracket<Value> in;
        /// Where its zero is, about.
        [[nodiscard]] Value seems() const {
            return in.at_to < Value(0) ? in.from + (in.to - in.from) * in.at_from / (in.at_from - in.at_to) : in.to;
        }
    };
    std::vector<Fall> falls_;
};

}  // namespace footfall
