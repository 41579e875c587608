// Follows a system with modes from event to event: steps with error control, guards that end a mode, jumps.
//
// Between events every mode is frozen and the right-hand side smooth. A guard that falls through zero ends the step
// there, at a point found on the interpolant and then reached by a step of the method itself. Decisions are made on
// values, so that everything runs over dual numbers; the last correction to an event's place is made in the scalar
// itself and carries the derivative of its time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "footfall/eigen/interop.hpp"
#include "footfall/math/value_of.hpp"
#include "footfall/solve/crossing_search.hpp"
#include "footfall/solve/first_zero.hpp"
#include "footfall/solve/goes_on.hpp"
#include "footfall/solve/method.hpp"
#include "footfall/solve/secants.hpp"
#include "footfall/solve/watcher.hpp"

namespace footfall {

/// What a Solver asks of the system that it follows (a PlainSystem answers most of it):
///
///   S, State (an Eigen array over S), Guards (likewise)
///   size(), motion_size()         of the state; the rates depend on the first motion_size() components alone
///   evaluate(y, rate, guards)     dy/dsigma and, where guards is not null, every guard: positive while its mode lasts
///   jacobian(y, J)                d(rate)/dy of the motion, over values; returns what it cost, in evaluations
///   differentiates_along          whether along(y, v, product) gives J v without J: for large systems
///   weights(y, w)                 one over the error that is allowed in each component
///   clock()                       the component that never falls and tells when the work is done
///   uniform()                     whether d(clock)/dsigma = 1 in these modes
///   longest_step(y), first_step() over sigma
///   accepted(h), stepped(next)    told of every step's size when it is good, and of the next one's when it is taken
///   tidy(y, from, to)             what a method leaves to do at the end of a step, by the clock
///   guard_count()                 of all guards; they come in groups of guards_per_group, each of one thing with modes
///   blind(j)                      guard j depends on components that no stage sees
///   approach(j, y)                how fast a blind guard falls; approaches(j, y): whether it does, rounding apart
///   outranks(j, k)                of two guards of a group at the same moment, j is handled and k forgotten
///   quick(j), may_wait(j)         crossings of j without time going on are no stall; a stalled group may leave j alone
///   longest_visit                 so many events of a group without time are no stall yet
///   moment()                      a time that is short beside all that matters, by the clock
///   start(y, armed)               the work begins at y: sets modes, as jump does
///   jump(guards, y, armed)        guards have reached zero at y: changes modes and y, says which guards start on zero
///
/// and, where it has them:
///
///   switching                     when the implicit method takes over (Switching)
///   locates_by_secants            whether an event is followed by secants through steps of the method, where no
///                                 interpolant shows how its guard falls
template <class System>
class Solver {
public:
    using S = typename System::S;
    using Value = ValueOf<S>;
    using State = typename System::State;
    using Guards = typename System::Guards;

    explicit Solver(System& system)
        : system_(system),
          crossings_(*this),
          method_({this}, {this}, system.motion_size(), product(), switching()),
          step_view_(*this) {}
    Solver(const Solver&) = delete;
    Solver& operator=(const Solver&) = delete;

    /// Looked on by these, which outlive it.
    void add(Watcher<State>& watcher) { watchers_.push_back(&watcher); }
    /// Evaluations between two looks.
    void look_every(std::int64_t evaluations) { look_every_ = std::max<std::int64_t>(1, evaluations); }
    /// Takes every step with this size in sigma, whatever its error: for measuring the order of the method.
    void fix_step(const Value& size) { fixed_step_ = size; }
    /// Takes every step by the implicit method: for measuring it where nothing is stiff. Before `run`.
    void stay_implicit() { method_.stay_implicit(); }
    /// The next `run` is that of a new solver, whatever was before; what was spent counts anew.
    void forget() {
        method_.forget();
        cost_ = {};
        next_look_ = 0;
        waiting_ = false;
    }

    /// From y, in the modes that the system is in, until the clock shows `end`, or a jump says that the work is done.
    void run(State y, const Value& end) {
        y_ = std::move(y);
        end_ = end;
        guards_ = lowest_ = scratch_guards_ = Guards::Ones(guard_count());
        armed_.assign(index(guard_count()), true);
        stalls_.assign(index(guard_count() / System::guards_per_group), Stall{});
        silent_until_.assign(index(guard_count()), -std::numeric_limits<Value>::infinity());
        scratch_ = y_;
        done_ = false;
        system_.start(y_, armed_);
        step_ = system_.first_step();
        begin_phase();
        while (!done_ && now() < end_)
            if (!handle_broken_guards()) advance();
    }

    [[nodiscard]] const State& state() const noexcept { return y_; }
    [[nodiscard]] const SolverCost& cost() const noexcept { return cost_; }

private:
    friend class CrossingSearch<Solver>;
    using Crossing = CrossedGuards<Value>;

    struct RightHandSide {
        Solver* solver;
        void operator()(const State& y, State& rate, bool look) const { solver->evaluate(y, rate, look); }
    };
    struct JacobianMatrix {
        Solver* solver;
        template <class Vector, class Matrix>
        void operator()(const Vector& y, Matrix& J) const {
            solver->spend(solver->system_.jacobian(y, J));
        }
    };
    struct Along {
        Solver* solver;
        template <class Vector, class Direction>
        Direction operator()(const Vector& y, const Direction& v) const {
            Direction product(v.size());
            solver->spend(solver->system_.along(y, v, product));
            return product;
        }
    };
    using Product = std::conditional_t<System::differentiates_along, Along, ByJacobian>;
    [[nodiscard]] Product product() {
        if constexpr (System::differentiates_along) {
            return {this};
        } else {
            return {};
        }
    }
    [[nodiscard]] static Switching switching() {
        if constexpr (requires { System::switching; }) {
            return System::switching;
        } else {
            return {};
        }
    }
    static constexpr bool by_secants = [] {
        if constexpr (requires { System::locates_by_secants; }) return System::locates_by_secants;
        return false;
    }();
    using MethodType = Method<State, System::motion_at_compile_time, RightHandSide, JacobianMatrix, Product>;

public:
    /// Of the explicit method.
    static constexpr int evaluations_of_a_step = MethodType::stages;

private:
    static constexpr std::size_t index(int i) { return static_cast<std::size_t>(i); }
    static Value eps() { return std::numeric_limits<Value>::epsilon(); }

    [[nodiscard]] Value clock(const State& y) const { return value_of(y[system_.clock()]); }
    [[nodiscard]] Value now() const { return clock(y_); }
    [[nodiscard]] int guard_count() const { return system_.guard_count(); }
    [[nodiscard]] int end_of_run() const { return guard_count(); }
    [[nodiscard]] static int group(int guard) { return guard / System::guards_per_group; }

    // ---- evaluations -------------------------------------------------------------------------------------------

    void evaluate(const State& y, State& rate, bool look) {
        spend(1);
        system_.evaluate(y, rate, look ? &scratch_guards_ : nullptr);
        if (!look) return;
        if (looks_ < looked_.size()) looked_[looks_] = scratch_guards_;
        ++looks_;
        lowest_ = lowest_.min(scratch_guards_);
    }
    void spend(std::int64_t evaluations) {
        cost_.evaluations += evaluations;
        if (cost_.evaluations < next_look_) return;
        next_look_ = cost_.evaluations + look_every_;
        for (Watcher<State>* w : watchers_) w->look(cost_, now());
    }

    // ---- one step ----------------------------------------------------------------------------------------------

    // The modes have changed, or the work begins: everything that a step starts from is computed anew.
    void begin_phase() {
        lowest_ = Guards::Constant(lowest_.size(), std::numeric_limits<Value>::max());
        method_.begin(y_);
        guards_ = scratch_guards_;
        system_.weights(y_, weight_);
        for (Watcher<State>* w : watchers_) w->begin(y_, method_.start_rate(), piece_of_step());
    }
    [[nodiscard]] Value piece_of_step() const { return Value(1e-4) * step_; }

    void advance() {
        const Value h = accepted_step();
        end_guards_ = scratch_guards_;  // those of finish()
        const Crossing crossing = crossings_.find(end_guards_);
        if (crossing && !(crossing.theta > Value(0))) {
            meet_at_start(crossing, h);
            return;
        }
        State& y = next_ = method_.end();
        if (crossing && !locate(crossing, h, y)) {  // the shorter step did not converge: look again from nearer
            if (fixed_step_ > Value(0)) throw std::runtime_error("an event cannot be located in steps of a fixed size");
            step_ = Value(0.5) * crossing.theta * h;
            return;
        }
        const bool ends = crossing && crossing.first() == end_of_run();
        from_ = now();
        to_ = ends ? end_ : std::min(clock(y), end_);
        for (Watcher<State>* w : watchers_) w->step(step_view_);
        set_clock(y, ends);
        system_.stepped(step_);
        system_.tidy(y, from_, to_);
        std::swap(y_, y);
        ++cost_.steps;
        if (method_.implicit()) ++cost_.stiff_steps;
        for (Watcher<State>* w : watchers_) w->reach(y_);
        if (crossing) {
            if (!ends) {
                handle(crossing.guards);
                begin_phase();
            }
            return;
        }
        guards_ = end_guards_;
        rearm();
        method_.advance(y_, weight_);
        lowest_ = Guards::Constant(lowest_.size(), std::numeric_limits<Value>::max());
        constexpr int renewal = 8;  // steps that weights may be old
        if (cost_.steps % renewal == 0) system_.weights(y_, weight_);
    }

    // Where the work ends the clock shows the end whatever the parameters are: its derivative there is none, and all
    // else is moved to that moment.
    void set_clock(State& y, bool ends) {
        S& time = y[system_.clock()];
        if (ends) {
            const S late = (S(to_) - time) / method_.end_rate()[system_.clock()];
            y += method_.end_rate() * late;
        }
        if (ends || !(clock(y) < end_)) y[system_.clock()] = S(to_);
    }

    // Steps until one is accurate enough; leaves the method finished at its end. Returns the size of that step.
    Value accepted_step() {
        const Value start_time = now();
        bool refused = false;
        for (;;) {
            Value h = fixed_step_ > Value(0) ? fixed_step_ : std::min(step_, system_.longest_step(y_));
            if (fixed_step_ == Value(0) && waiting_) h = std::min(h, until_a_guard_is_heard());
            const bool clipped = h < step_;
            if (system_.uniform()) h = std::min(h, end_ - start_time);
            looks_ = 0;
            method_.step(h, weight_);
            forget_interpolant();
            Value error = method_.error(weight_);
            if (fixed_step_ > Value(0) && !std::isfinite(error))
                throw std::runtime_error("the step that was fixed is too long for the method");
            // Where the scale of time has a pole inside the step, the clock may seem to run backwards.
            if (!(clock(method_.end()) >= start_time)) error = std::numeric_limits<Value>::infinity();
            if (fixed_step_ > Value(0) || error <= Value(1)) {
                method_.finish();
                const Value factor = method_.growth(error, refused);
                if (!clipped && h == step_)
                    step_ = h * factor;
                else if (factor < Value(1))
                    step_ = h;
                system_.accepted(h);
                return h;
            }
            ++cost_.rejected;
            refused = true;
            step_ = method_.gives_up(error) ? system_.first_step() : h * method_.growth(error, true);
        }
    }

    // ---- events ------------------------------------------------------------------------------------------------

    [[nodiscard]] const Guards& guards_at(const Value& theta) {
        spend(1);
        system_.evaluate(interpolated(theta), scratch_, &scratch_guards_);
        return scratch_guards_;
    }

    // Takes the step again so that it ends on the crossing, and sets y to that end. The last correction, once it is so
    // small that its square is rounding, follows the tangent; it is made in S, and carries the derivative of the place.
    [[nodiscard]] bool locate(const Crossing& crossing, const Value& whole, State& y) {
        const int guard = crossing.first();
        if (guard == end_of_run() && crossing.theta == Value(1)) return true;
        constexpr int most = by_secants ? 20 : 6;
        const Value linear = std::sqrt(eps());
        Secants<Value> secants;
        Value theta = crossing.theta;
        for (int attempt = 0; attempt < most; ++attempt) {
            theta = std::clamp(theta, Value(0), Value(1.5));
            method_.step(theta * whole, weight_);
            method_.finish();
            forget_interpolant();
            y = method_.end();
            if (!finite(y) || !converged()) return false;
            if (!(crossing.slope < Value(0))) return true;
            const S value = guard == end_of_run() ? S(S(end_) - y[system_.clock()]) : scratch_guards_[guard];
            if constexpr (by_secants) {
                const Value way = secants.see(theta, value_of(value), crossing.slope);
                if (secants.found()) {
                    y += method_.end_rate() * S(moving(S(-value)) / S(secants.slope()) * whole);
                    return true;
                }
                theta += way;
                continue;
            }
            const S correction = -value / S(crossing.slope);
            if (!(std::abs(value_of(correction)) > linear)) {
                const S beyond = correction * whole;
                y += method_.end_rate() * beyond;
                if constexpr (!std::floating_point<S>) complete_derivatives(crossing, whole, beyond, y);
                return true;
            }
            theta += value_of(correction);
        }
        return true;
    }
    // Guards that fall from where the step starts: there is no step. The place moves with the inputs all the same.
    void meet_at_start(const Crossing& crossing, const Value& whole) {
        if (crossing.first() == end_of_run()) {  // nothing but rounding is left
            y_[system_.clock()] = S(end_);
            return;
        }
        if constexpr (!std::floating_point<S>) {
            if (crossing.slope < Value(0))
                y_ += method_.start_rate() * S(moving(S(-guards_[crossing.first()])) / S(crossing.slope) * whole);
        }
        handle(crossing.guards);
        begin_phase();
    }
    /// The part of a number that the inputs move.
    [[nodiscard]] static S moving(const S& x) { return x - S(value_of(x)); }

    // What the tangent leaves to the derivatives at y, which it has reached by going `beyond` the step: the rates have
    // turned by then, and the slope, which is a difference, is not exact. The value of y stays as it is.
    void complete_derivatives(const Crossing& crossing, const Value& whole, const S& beyond, State& y) {
        spend(2);
        system_.evaluate(y, scratch_, nullptr);
        y += (scratch_ - method_.end_rate()) * moving(beyond);
        system_.evaluate(y, scratch_, &scratch_guards_);
        const int guard = crossing.first();
        const S left = guard == end_of_run() ? S(S(end_) - y[system_.clock()]) : scratch_guards_[guard];
        y += scratch_ * S(moving(S(-left)) / S(crossing.slope) * whole);
    }
    // Whether a step that is a part of a good one has come to a solution: its error may be somewhat larger than
    // allowed, since the good one's estimate was lucky, but not wildly so.
    [[nodiscard]] bool converged() const {
        constexpr double wild = 1e9;
        const Value error = method_.error(weight_);
        return !method_.implicit() || (fixed_step_ > Value(0) ? std::isfinite(error) : error < Value(wild));
    }
    [[nodiscard]] static bool finite(const State& y) {
        for (const S& x : y)
            if (!std::isfinite(value_of(x))) return false;
        return true;
    }

    // Guards that are already broken where a step starts: events that coincide with the last one.
    bool handle_broken_guards() {
        for (int j = 0; j < guard_count(); ++j) {
            if (!armed_[index(j)] || !(guards_[j] < S(0)) || silent(j)) continue;
            if (system_.blind(j) && !system_.approaches(j, y_)) {
                armed_[index(j)] = false;
                continue;
            }
            handle({j});
            begin_phase();
            return true;
        }
        return false;
    }

    void handle(std::vector<int> guards) {
        std::erase_if(guards, [&](int j) { return stalls(j); });
        if (guards.empty()) return;
        std::sort(guards.begin(), guards.end());  // the order of what coincides is no matter of rounding
        const GoesOn<Value> next = system_.jump(guards, y_, armed_);
        if (next.step > Value(0)) step_ = next.step;
        step_ *= next.stretch;
        if (next.calm) method_.return_to_explicit();
        done_ = next.done;
    }

    // Where the modes of a group change without time going on, it is left as it is and not looked at for a moment; then
    // it may decide again.
    [[nodiscard]] bool stalls(int guard) {
        if (system_.quick(guard)) return false;
        const Value moment = system_.moment();
        Stall& stall = stalls_[index(group(guard))];
        stall.events = now() > stall.since + Value(0.1) * moment ? 0 : stall.events + 1;
        stall.since = now();
        if (stall.events < System::longest_visit || !system_.may_wait(guard)) return false;
        silent_until_[index(guard)] = now() + moment;
        waiting_ = true;
        armed_[index(guard)] = false;
        stall.events = 0;
        return true;
    }
    [[nodiscard]] bool silent(int guard) const { return now() < silent_until_[index(guard)]; }

    // The sigma until a guard that waits is looked at again: a step that does without it must not go on for longer.
    [[nodiscard]] Value until_a_guard_is_heard() {
        Value wait = std::numeric_limits<Value>::infinity();
        for (const Value& until : silent_until_)
            if (now() < until) wait = std::min(wait, until - now());
        waiting_ = std::isfinite(wait);
        return waiting_ ? wait / value_of(method_.start_rate()[system_.clock()]) : std::numeric_limits<Value>::max();
    }

    void rearm() {
        for (int j = 0; j < guard_count(); ++j)
            if (guards_[j] > S(0)) armed_[index(j)] = true;
    }

    // ---- the step's interpolant ----------------------------------------------------------------------------------

    [[nodiscard]] State interpolated(const Value& theta) {
        ready_interpolant();
        return method_.at(theta);
    }
    [[nodiscard]] Value clock_at(const Value& theta) { return value_at(theta, system_.clock()); }
    [[nodiscard]] Value value_at(const Value& theta, int component) {
        ready_interpolant();
        return value_of(method_.at(theta, component));
    }
    void ready_interpolant() {
        if (!interpolant_ready_) method_.prepare_dense();
        interpolant_ready_ = true;
    }
    void forget_interpolant() { interpolant_ready_ = false; }

    class StepView final : public SolverStep<State> {
    public:
        explicit StepView(Solver& solver) : solver_(solver) {}
        [[nodiscard]] const State& start() const override { return solver_.method_.start(); }
        [[nodiscard]] const State& end() const override { return solver_.method_.end(); }
        [[nodiscard]] State start_rate() const override { return solver_.method_.start_rate(); }
        [[nodiscard]] State end_rate() const override { return solver_.method_.end_rate(); }
        [[nodiscard]] Value size() const override { return solver_.method_.size(); }
        [[nodiscard]] Value piece() const override { return solver_.piece_of_step(); }
        [[nodiscard]] State at(const Value& share) const override { return solver_.interpolated(share); }
        [[nodiscard]] Value value_at(const Value& share, int component) const override {
            return solver_.value_at(share, component);
        }
        [[nodiscard]] Value share_at(const Value& time) const override {
            const Value from = solver_.from_, to = solver_.to_;
            if (solver_.system_.uniform()) return (time - from) / (to - from);
            if (!(from < time)) return Value(0);
            if (!(time < to)) return Value(1);
            const auto late = [&](Value share) { return solver_.clock_at(share) - time; };
            return zero_between(late, Value(0), Value(1), from - time, to - time,
                                std::numeric_limits<Value>::digits - 4);
        }
        [[nodiscard]] Value from() const override { return solver_.from_; }
        [[nodiscard]] Value to() const override { return solver_.to_; }

    private:
        Solver& solver_;
    };

    System& system_;
    std::vector<Watcher<State>*> watchers_;
    Value end_{0}, fixed_step_{0};
    SolverCost cost_;
    std::int64_t look_every_ = 4096, next_look_ = 0;

    State y_, scratch_, next_;
    ValuesOf<State> weight_;
    Guards guards_, lowest_, scratch_guards_,
        end_guards_;                // at the step's start; the least over its stages; of the last evaluation
    std::array<Guards, 2> looked_;  // at the looks inside an explicit step
    std::size_t looks_ = 0;
    CrossingSearch<Solver> crossings_;
    // A guard that has just been handled starts on its zero; it is looked at again once it has been positive.
    std::vector<bool> armed_;
    std::vector<Value> silent_until_;
    bool waiting_ = false;  // some guard may be silent
    struct Stall {
        Value since{-1};  // the clock at the group's last event
        int events = 0;   // those in a row that it had without time going on
    };
    std::vector<Stall> stalls_;
    MethodType method_;
    StepView step_view_;
    Value step_{0}, from_{0}, to_{0};  // the next step; the clock at the ends of the last
    bool interpolant_ready_ = false;
    bool done_ = false;
};

}  // namespace footfall
