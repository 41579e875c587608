// Drives one body from its start to the end of the run: takes steps, finds the events that end a phase, switches.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "footfall/simulate/account.hpp"
#include "footfall/simulate/budget.hpp"
#include "footfall/simulate/peaks.hpp"
#include "footfall/simulate/recorder.hpp"
#include "footfall/simulate/scales.hpp"
#include "footfall/simulate/system.hpp"
#include "footfall/solve/first_zero.hpp"
#include "footfall/solve/method.hpp"

namespace footfall {

/// One run. Between events every phase is frozen and the right-hand side smooth; a guard that crosses zero ends the
/// step there, at a point found on the interpolant and then reached by a step of the method itself.
template <class Law, int Spheres>
class Simulator {
public:
    using SystemType = System<Law, Spheres>;
    using S = typename SystemType::S;
    using StateVector = typename SystemType::StateVector;
    using Guards = typename SystemType::Guards;

    Simulator(const Simulation& simulation, std::vector<Law> laws)
        : options_(simulation.options),
          frame_(simulation.ground.normal),
          system_(simulation.body, simulation.ground, simulation.gravity, std::move(laws)),
          scales_(system_, simulation.body, simulation.gravity, simulation.options.tolerance),
          recorder_(simulation.options),
          end_time_(simulation.options.end_time),
          dual_system_(system_.template cast<Direction>()),
          method_({this}, {this}, system_.layout().motion_size()) {
        place(simulation);
    }

    /// Takes every step with this size in sigma, whatever its error: for measuring the order of the method.
    void fix_step(const S& size) { fixed_step_ = size; }

    [[nodiscard]] Run run() {
        const auto started = std::chrono::steady_clock::now();
        refuse_the_hopeless();
        begin_on_ground();
        while (y_[system_.layout().time()] < end_time_) {
            if (!handle_broken_guards()) advance();
        }
        cost_.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
        recorder_.end(snapshot(y_), cost_);
        return std::move(recorder_.run());
    }

    [[nodiscard]] const StateVector& state() const noexcept { return y_; }
    [[nodiscard]] const SystemType& system() const noexcept { return system_; }

private:
    using Layout = typename SystemType::LayoutType;
    using Kinematics = typename SystemType::Kinematics;
    using Motion = typename SystemType::Motion;
    static constexpr int per_contact = SystemType::guards_per_contact;
    static constexpr int load_guard = SystemType::load_guard;
    static constexpr int clutch_guard = SystemType::clutch_guard;
    static constexpr int depth_guard = SystemType::depth_guard;

    // Derivatives are taken in this many directions at a time.
    static constexpr int directions = 8;
    using Direction = Dual<S, directions>;
    using DualSystem = decltype(std::declval<SystemType>().template cast<Direction>());
    struct RightHandSide {
        Simulator* simulator;
        void operator()(const StateVector& y, StateVector& rate, bool look) const {
            simulator->evaluate(y, rate, look);
        }
    };
    struct JacobianMatrix {
        Simulator* simulator;
        template <class Vector, class Matrix>
        void operator()(const Vector& y, Matrix& J) const {
            simulator->differentiate(y, J);
        }
    };

    static S eps() { return std::numeric_limits<S>::epsilon(); }
    static std::size_t index(int i) { return static_cast<std::size_t>(i); }

    // ---- the start --------------------------------------------------------------------------------------------

    void place(const Simulation& simulation) {
        const auto& layout = system_.layout();
        const BodyState& b = simulation.initial;
        const Eigen::Matrix3d R = b.orientation.toRotationMatrix();
        const Eigen::Vector3d momentum = R * simulation.body.inertia * R.transpose() * b.angular_velocity;
        y_ = StateVector::Zero(layout.size());
        y_.template segment<3>(layout.position()) = frame_.to_ground(b.position).array();
        y_.template segment<3>(Layout::velocity) = frame_.to_ground(b.velocity).array();
        y_.template segment<3>(Layout::momentum) = frame_.to_ground(momentum).array();
        y_.template segment<4>(Layout::orientation) = frame_.to_ground(b.orientation).coeffs().array();
        const int guards = per_contact * layout.spheres;
        guards_ = lowest_ = scratch_guards_ = Guards::Ones(guards);
        armed_.assign(index(guards), true);
        stalls_.resize(index(layout.spheres));
        silent_until_.assign(index(guards), S(-1));
        scratch_ = y_;
        extent_ = std::abs(simulation.ground.height);
        for (const Sphere& s : simulation.body.spheres) extent_ = std::max(extent_, s.center.norm() + s.radius);
    }

    // Spheres that start in the ground, on it and pressed, or on it and moving into it.
    void begin_on_ground() {
        const Motion m = system_.motion(y_);
        std::vector<int> pressed;
        for (int i = 0; i < system_.spheres(); ++i) {
            const Kinematics k = system_.kinematics(m, i);
            const S z = system_.geometric_depth(m, k, i);
            if (z > touching()) {
                const S s = std::sqrt(z);
                y_[system_.layout().root_depth(i)] = s;
                begin_impact(i, k.depth_rate);
                system_.set_phase(i, phase_at(i, s, k, system_.bristle(y_, i)));
            }
        }
        for (int i = 0; i < system_.spheres(); ++i)
            if (!system_.touches(i) && about_to_touch(y_, i)) pressed.push_back(i);
        see(ledger_of(system_, y_));
        recorder_.begin(snapshot(y_));
        for (int i = 0; i < system_.spheres(); ++i) {
            if (!system_.touches(i)) continue;
            recorder_.event(EventKind::touchdown, i, snapshot(y_));
            if (system_.phase(i) == Phase::stick) recorder_.event(EventKind::stick, i, snapshot(y_));
            if (system_.phase(i) == Phase::slip) enter_slip(i);
        }
        if (!pressed.empty()) touch_down(pressed);
        step_ = first_step();
        begin_phase();
    }

    // On the ground to rounding, and not about to leave it.
    [[nodiscard]] bool about_to_touch(const StateVector& y, int i) {
        const Motion m = system_.motion(y);
        const Kinematics k = system_.kinematics(m, i);
        return std::abs(system_.geometric_depth(m, k, i)) <= touching() && approaches(y, i);
    }

    // Whether sphere i moves into the ground, or stands and is about to.
    [[nodiscard]] bool approaches(const StateVector& y, int i) {
        const Motion m = system_.motion(y);
        const S rate = system_.kinematics(m, i).depth_rate;
        const S standing = S(16) * eps() * (m.velocity.norm() + m.angular_velocity.norm() * S(extent_));
        return std::abs(rate) > standing ? rate > S(0) : depth_acceleration(y, i) > S(0);
    }

    // d(zdot)/dt, by a difference along the motion.
    [[nodiscard]] S depth_acceleration(const StateVector& y, int i) {
        StateVector rate = y;
        evaluate(y, rate, false);
        const S g = system_.time_rate(y);
        const S small = std::sqrt(eps()) * S(scales_.depth() / scales_.speed());
        const StateVector later = y + rate * (small / g);
        return (depth_rate(later, i) - depth_rate(y, i)) / small;
    }

    [[nodiscard]] S depth_rate(const StateVector& y, int i) const {
        return system_.kinematics(system_.motion(y), i).depth_rate;
    }

    /// Distances below this are rounding [m].
    [[nodiscard]] S touching() const {
        const S far = y_.template segment<3>(system_.layout().position()).matrix().norm();
        return S(64) * eps() * (far + S(extent_));
    }

    // ---- one step ---------------------------------------------------------------------------------------------

    void evaluate(const StateVector& y, StateVector& rate, bool look) {
        ++cost_.evaluations;
        system_.evaluate(y, rate, look ? &scratch_guards_ : nullptr);
        if (look) lowest_ = lowest_.min(scratch_guards_);
    }

    // d(rate)/dy of the components of the motion, exact, by dual numbers.
    template <class Vector, class Matrix>
    void differentiate(const Vector& y, Matrix& J) {
        using DualVector = typename DualSystem::StateVector;
        const int n = system_.layout().motion_size();
        if (const double needed = recorder_.bytes() + implicit_bytes(n); needed > options_.max_memory)
            stop_for_stiffness(needed, index(system_.spheres()), static_cast<double>(y_[system_.layout().time()]),
                               options_);
        for (int i = 0; i < system_.spheres(); ++i) {
            dual_system_.set_phase(i, system_.phase(i));
            dual_system_.set_drags(i, system_.drags(i));
        }
        J.resize(n, n);
        DualVector point = y.template cast<Direction>(), rate = point;
        for (int first = 0; first < n; first += directions) {
            const int last = std::min(first + directions, n);
            for (int c = first; c < last; ++c) point[c] = Direction::variable(y[c], c - first);
            dual_system_.evaluate(point, rate);
            for (int c = first; c < last; ++c) {
                for (int r = 0; r < n; ++r) J(r, c) = rate[r].gradient[index(c - first)];
                point[c] = Direction(y[c]);
            }
            cost_.evaluations += directions;
        }
    }

    // The phases have changed, or the run begins: everything that a step starts from is computed anew.
    void begin_phase() {
        lowest_ = Guards::Constant(lowest_.size(), std::numeric_limits<S>::max());
        method_.begin(y_);
        guards_ = scratch_guards_;
        scales_.weights(y_, weight_);
        peaks_.begin(system_, y_, method_.start_rate(), piece_of_step(), recorder_);
    }

    void advance() {
        const S h = accepted_step();
        Guards end_guards = scratch_guards_;  // those of finish()
        Crossing<S> crossing = find_crossing(end_guards);
        const bool whole = !crossing;
        StateVector y = method_.end();
        if (crossing && !locate(crossing, h, y)) {  // the shorter step did not converge: look again from nearer
            step_ = S(0.5) * crossing.theta * h;
            return;
        }
        const S from = y_[system_.layout().time()];
        // An event at the end of the run is there to rounding.
        const S to = crossing.guard == end_of_run() ? end_time_ : std::min(y[system_.layout().time()], end_time_);
        record_inside(from, to);
        y[system_.layout().time()] = to;
        tidy(y, to - from);
        y_ = y;
        ++cost_.steps;
        if (method_.implicit()) ++cost_.stiff_steps;
        account();
        if (!whole) {
            if (crossing.guard != end_of_run()) handle(crossing.guard);
            begin_phase();
        } else {
            guards_ = end_guards;
            rearm();
            method_.advance(y_, weight_);
            lowest_ = Guards::Constant(lowest_.size(), std::numeric_limits<S>::max());
            if (cost_.steps % 8 == 0) scales_.weights(y_, weight_);
        }
        if (cost_.steps % 512 == 0) watch();
    }

    // Steps until one is accurate enough; leaves the method finished at its end. Returns the size of that step.
    S accepted_step() {
        const S start_time = y_[system_.layout().time()];
        bool refused = false;
        for (;;) {
            S h = fixed_step_ > S(0) ? fixed_step_ : std::min(step_, longest_step());
            const bool clipped = h < step_;
            if (system_.in_flight()) h = std::min(h, end_time_ - start_time);
            method_.step(h, weight_);
            S error = method_.error(weight_);
            // Past the end of one of several contacts g has a pole, and time may seem to run backwards.
            if (Spheres != 1 && !(method_.end()[system_.layout().time()] >= start_time))
                error = std::numeric_limits<S>::infinity();
            if (fixed_step_ > S(0) || error <= S(1)) {
                method_.finish();
                const S factor = method_.growth(error, refused);
                if (!clipped && h == step_)
                    step_ = h * factor;
                else if (factor < S(1))
                    step_ = h;
                if (first_contact_step_pending_) {
                    first_contact_step_ = h;
                    first_contact_step_pending_ = false;
                }
                return h;
            }
            ++cost_.rejected;
            refused = true;
            step_ = method_.gives_up(error) ? first_step() : h * method_.growth(error, true);
            watch();
        }
    }

    // Turning spheres dip into the ground and out again: half a radian at most between looks.
    [[nodiscard]] S longest_step() const {
        const S spin = system_.oriented() ? system_.motion(y_).angular_velocity.norm() : S(0);
        if (!(spin > S(0))) return std::numeric_limits<S>::max();
        return S(0.5) / (spin * system_.time_rate(y_));
    }

    // A guess at the step after a touchdown: a fiftieth of the way to the full depth, or what served the last time.
    [[nodiscard]] S first_step() const {
        if (system_.in_flight()) return S(scales_.depth() / scales_.speed());
        if (first_contact_step_ > S(0)) return first_contact_step_;
        return S(0.02 * scales_.root_depth() / scales_.speed());
    }

    // ---- events -----------------------------------------------------------------------------------------------

    [[nodiscard]] int end_of_run() const { return per_contact * system_.spheres(); }

    // The first guard to fall through zero inside the step, if any.
    [[nodiscard]] Crossing<S> find_crossing(const Guards& at_end) {
        Crossing<S> first;
        const bool past_end = !system_.in_flight() && method_.end()[system_.layout().time()] > end_time_;
        bool dense = false;
        const auto prepare = [&] {
            if (!dense) method_.prepare_dense();
            dense = true;
        };
        if (past_end) {
            prepare();
            const auto remaining = [&](S theta) { return end_time_ - method_.at(theta, system_.layout().time()); };
            first.guard = end_of_run();
            first.theta = first_zero<S>(remaining, end_time_ - y_[system_.layout().time()]);
            first.slope = slope(remaining, first.theta);
        } else if (system_.in_flight() &&
                   !(method_.end()[system_.layout().time()] < end_time_ * (S(1) - S(4) * eps()))) {
            first.guard = end_of_run();  // the step was cut to end there
        }
        const Guards lowest = lowest_;
        for (int j = 0; j < at_end.size(); ++j) {
            if (silent(j)) continue;
            const S start = armed_[index(j)] ? guards_[j] : S(0);
            const bool near = lowest[j] < S(0.1) * std::min(guards_[j], at_end[j]) || turns_round(j);
            if (!(at_end[j] < S(0)) && !near) continue;
            prepare();
            const auto value = [&](S theta) { return guard_at(theta, j); };
            S theta = first_zero<S>(value, start);
            const auto lands = [&] {
                return system_.touches(j / per_contact) || approaches(method_.at(theta), j / per_contact);
            };
            // Rounding has put a sphere that is leaving on the wrong side: it may land later in the step.
            if (theta >= S(0) && !lands()) theta = first_zero<S>(value, S(0));
            if (theta < S(0)) continue;
            if (!lands() && at_end[j] < S(0)) theta = turning_point(j / per_contact);
            if (!lands()) {
                armed_[index(j)] = false;
                continue;
            }
            if (!first || theta < first.theta - coincidence ||
                (theta < first.theta + coincidence && outranks(j, first.guard)))
                first = {j, theta, slope(value, theta)};
        }
        return first;
    }

    // Where sphere i, which leaves the ground at the step's start, turns back to it: the landing of a hop too small to
    // see.
    [[nodiscard]] S turning_point(int i) const {
        const auto rate = [&](S theta) { return depth_rate(method_.at(theta), i); };
        const S at_start = rate(S(0)), at_end = rate(S(1));
        if (!(at_start < S(0)) || !(at_end > S(0))) return S(0);
        std::uintmax_t iterations = 60;
        return boost::math::tools::toms748_solve(rate, S(0), S(1), at_start, at_end,
                                                 boost::math::tools::eps_tolerance<S>(), iterations)
            .second;
    }

    // A sphere in flight that turns round within the step may have been in the ground and out again. (The stages do not
    // know the position.)
    [[nodiscard]] bool turns_round(int guard) const {
        const int i = guard / per_contact;
        if (guard % per_contact != load_guard || system_.touches(i)) return false;
        return depth_rate(method_.start(), i) > S(0) && depth_rate(method_.end(), i) < S(0);
    }

    // Of events at the same moment: what ends the contact goes before what ends its stick or slip.
    [[nodiscard]] bool outranks(int j, int other) const {
        if (other == end_of_run() || j / per_contact != other / per_contact) return false;
        return j % per_contact == depth_guard || other % per_contact == clutch_guard;
    }

    [[nodiscard]] S guard_at(const S& theta, int j) {
        system_.evaluate(method_.at(theta), scratch_, &scratch_guards_);
        ++cost_.evaluations;
        return scratch_guards_[j];
    }

    template <class F>
    [[nodiscard]] static S slope(F&& f, const S& theta) {
        const S d(1e-4);
        return (f(theta + d) - f(theta - d)) / (S(2) * d);
    }

    // Takes the step again so that it ends on the crossing, and sets y to that end. The last correction, once it is so
    // small that its square is rounding, follows the tangent.
    [[nodiscard]] bool locate(const Crossing<S>& crossing, const S& whole, StateVector& y) {
        if (crossing.guard == end_of_run() && crossing.theta == S(1)) return true;
        const S linear = std::sqrt(eps());
        S theta = crossing.theta;
        for (int attempt = 0; attempt < 6; ++attempt) {
            theta = std::clamp(theta, S(0), S(1.5));
            method_.step(theta * whole, weight_);
            method_.finish();
            y = method_.end();
            const S value = crossing.guard == end_of_run() ? end_time_ - y[system_.layout().time()]
                                                           : scratch_guards_[crossing.guard];
            if (!y.allFinite() || (method_.implicit() && !(method_.error(weight_) < S(1e9)))) return false;
            if (!(crossing.slope < S(0))) return true;
            const S correction = -value / crossing.slope;
            if (!(std::abs(correction) > linear)) {
                y += method_.end_rate() * (correction * whole);
                return true;
            }
            theta += correction;
        }
        return true;
    }

    // Guards that are already broken where a step starts: events that coincide with the last one.
    bool handle_broken_guards() {
        for (int j = 0; j < guards_.size(); ++j) {
            if (!armed_[index(j)] || !(guards_[j] < S(0)) || silent(j)) continue;
            const int i = j / per_contact;
            if (!system_.touches(i) && !approaches(y_, i)) {
                armed_[index(j)] = false;
                continue;
            }
            handle(j);
            begin_phase();
            return true;
        }
        return false;
    }

    void handle(int guard) {
        const int i = guard / per_contact;
        if (chatters(guard)) return;
        for (int g = 0; g < per_contact; ++g) armed_[index(i * per_contact + g)] = true;
        const Phase phase = system_.phase(i);
        switch (guard % per_contact) {
            case load_guard:
                if (phase == Phase::flight) {
                    std::vector<int> together{i};
                    for (int k = 0; k < system_.spheres(); ++k)
                        if (k != i && !system_.touches(k) && about_to_touch(y_, k)) together.push_back(k);
                    touch_down(together);
                    break;
                }
                armed_[index(guard)] = false;
                if (system_.drags(i)) {
                    set_drags(i, false);
                    enter_contact(i);
                } else {
                    const bool drags = has_border_motion(i);
                    if (phase != Phase::recovering) {
                        enter_recovering(i);
                    } else if (!drags) {
                        enter_contact(i);
                    }
                    set_drags(i, drags);
                }
                break;
            case clutch_guard:
                if (system_.drags(i)) {
                    set_drags(i, false);
                    armed_[index(i * per_contact + load_guard)] = false;
                } else if (Law::has_states) {
                    jump(i);
                } else if (phase == Phase::stick) {
                    system_.set_phase(i, Phase::slip);
                    enter_slip(i);
                    recorder_.event(EventKind::slip, i, snapshot(y_));
                } else {
                    system_.set_phase(i, Phase::stick);
                    recorder_.event(EventKind::stick, i, snapshot(y_));
                }
                armed_[index(guard)] = false;
                break;
            case depth_guard:
                lift_off(i);
                armed_[index(i * per_contact + load_guard)] = false;
                break;
        }
    }

    // A contact that drags does not count in g: the next step stays as long in time.
    void set_drags(int i, bool drags) {
        if (system_.drags(i) == drags) return;
        const S before = system_.time_rate(y_);
        system_.set_drags(i, drags);
        step_ *= before / system_.time_rate(y_);
    }

    // A viscous clutch loses its hold at F_n = 0, so that friction jumps there. Whether either phase pushes the motion
    // into the other at once: then it goes along the border between them.
    [[nodiscard]] bool has_border_motion(int i) {
        if constexpr (Law::has_clutch) {
            const auto& friction = system_.law(i).friction;
            if (!(friction.viscous > S(0)) || !(friction.damping > S(0))) return false;
            const Phase phase = system_.phase(i);
            system_.set_phase(i, Phase::slip);
            const bool slip_unloads = system_.load_rate(y_, i) < S(0);
            system_.set_phase(i, Phase::recovering);
            const bool freedom_loads = system_.load_rate(y_, i) > S(0);
            system_.set_phase(i, phase);
            return slip_unloads && freedom_loads;
        }
        return false;
    }

    // Where the phases change without time going on, a contact is left as it is and not looked at for a moment that is
    // short beside an impact; then it may decide again.
    [[nodiscard]] bool chatters(int guard) {
        if (Law::has_states && guard % per_contact == clutch_guard) return false;  // bonds may snap in quick succession
        const S now = y_[system_.layout().time()];
        const S moment(1e-3 * scales_.depth() / scales_.speed());
        const int i = guard / per_contact;
        Stall& stall = stalls_[index(i)];
        stall.events = now > stall.since + S(0.1) * moment ? 0 : stall.events + 1;
        stall.since = now;
        if (stall.events < longest_visit) return false;
        if (guard % per_contact == load_guard && system_.phase(i) != Phase::recovering) return false;
        if (guard % per_contact == clutch_guard && system_.phase(i) != Phase::stick) return false;
        if (guard % per_contact == depth_guard) return false;
        silent_until_[index(guard)] = now + moment;
        armed_[index(guard)] = false;
        stall.events = 0;
        return true;
    }
    [[nodiscard]] bool silent(int guard) const { return y_[system_.layout().time()] < silent_until_[index(guard)]; }

    // The spheres begin to touch. A root depth of exactly zero would say nothing of their ratio, so they start a
    // little inside, far below rounding: with s_i as sqrt(z_i) is going to be.
    void touch_down(const std::vector<int>& spheres) {
        const Motion m = system_.motion(y_);
        std::vector<S> depth_rate;
        for (const int i : spheres) {
            depth_rate.push_back(system_.kinematics(m, i).depth_rate);
            begin_impact(i, depth_rate.back());
        }
        if (!(*std::max_element(depth_rate.begin(), depth_rate.end()) > S(0)))
            for (std::size_t k = 0; k < spheres.size(); ++k) depth_rate[k] = depth_acceleration(y_, spheres[k]);
        const S fastest = *std::max_element(depth_rate.begin(), depth_rate.end());
        for (std::size_t k = 0; k < spheres.size(); ++k) {
            const int i = spheres[k];
            const S share = std::max(depth_rate[k] / fastest, eps());
            const S s = S(1e-2) * std::sqrt(eps() * system_.radius(i) * share);
            y_[system_.layout().root_depth(i)] = s;
            // A bristle that has not recovered is stretched as the stiffness rises from zero to what it is at s.
            if constexpr (Law::ScalePower > 0)
                y_[system_.layout().ledger(i) + Layout::stiffness_change] -=
                    system_.law(i).friction.stored_energy(system_.law(i).friction.scale(s), system_.bristle(y_, i));
        }
        for (const int i : spheres) enter_contact(i);
        first_contact_step_pending_ = true;
        step_ = first_step();
    }

    void begin_impact(int i, const S& depth_rate) {
        const S speed = std::max(depth_rate, S(0));
        system_.begin_impact(i, speed);
        dual_system_.begin_impact(i, Direction(speed));
    }

    // Stick or slip, by the force a moment later: at touchdown itself both sides of (26) may be zero.
    void enter_contact(int i) {
        const Kinematics k = system_.kinematics(system_.motion(y_), i);
        const S later = std::max(y_[system_.layout().root_depth(i)], S(1e-6 * scales_.root_depth()));
        const S dt = k.depth_rate > S(0) ? S(later * later / k.depth_rate) : S(0);
        const Vector2<S> u = system_.bristle(y_, i);
        Phase phase = phase_at(i, later, k, Vector2<S>(u + k.slip * dt));
        if (phase == Phase::recovering) phase = without_hold(i);
        system_.set_phase(i, phase);
        recorder_.event(EventKind::touchdown, i, snapshot(y_));
        if (phase == Phase::stick) recorder_.event(EventKind::stick, i, snapshot(y_));
        if (phase == Phase::slip) enter_slip(i);
    }

    // The phase that the forces at s, or a new contact's internal states, ask for.
    [[nodiscard]] Phase phase_at(int i, const S& s, const Kinematics& k, [[maybe_unused]] const Vector2<S>& u) const {
        if constexpr (Law::has_states) {
            return system_.law(i).first_phase(s, k.depth_rate);
        } else {
            return system_.law(i).phase_of(s, k.depth_rate, k.slip, u);
        }
    }
    // The phase of a contact whose load is about to begin.
    [[nodiscard]] Phase without_hold([[maybe_unused]] int i) const {
        if constexpr (Law::has_states) {
            return system_.law(i).friction.first_phase();
        } else {
            return Phase::slip;
        }
    }

    // A friction law with internal states changes its phase, or its states jump. What they held goes through the
    // clutch.
    void jump(int i) {
        if constexpr (Law::has_states) {
            const auto& friction = system_.law(i).friction;
            const Kinematics k = system_.kinematics(system_.motion(y_), i);
            const std::span<S> x = system_.friction_states(y_, i);
            const Phase before = system_.phase(i);
            const S held = friction.stored(before, x);
            const Phase after = friction.jump(before, k.slip, x);
            const S F_n = system_.law(i).normal.force(system_.root_depth(y_, i), k.depth_rate).total();
            y_[system_.layout().ledger(i) + Layout::clutch] += F_n * (held - friction.stored(after, x));
            system_.set_phase(i, after);
            if (after != before)
                recorder_.event(after == Phase::stick ? EventKind::stick : EventKind::slip, i, snapshot(y_));
        }
    }

    void enter_slip(int i) {
        if constexpr (Law::has_clutch) {
            const Law& law = system_.law(i);
            if (!law.friction.plastic()) return;
            const Kinematics k = system_.kinematics(system_.motion(y_), i);
            const S phi_n = law.normal.template force<Law::ScalePower>(system_.root_depth(y_, i), k.depth_rate).total();
            const Vector2<S> before = system_.bristle(y_, i);
            const Vector2<S> after = law.friction.enter_slip(phi_n, k.slip, before);
            y_.template segment<2>(system_.layout().bristle(i)) = after.array();
            // A bristle that was beyond the cone springs back onto it through the clutch.
            const S scale = law.friction.scale(system_.root_depth(y_, i));
            y_[system_.layout().ledger(i) + Layout::clutch] +=
                law.friction.stored_energy(scale, before) - law.friction.stored_energy(scale, after);
        }
    }

    void enter_recovering(int i) {
        system_.set_phase(i, Phase::recovering);
        release_undamped_bristle(i);
        forget_friction(i);
        recorder_.event(EventKind::separation, i, snapshot(y_));
    }

    void lift_off(int i) {
        if (system_.phase(i) != Phase::recovering) enter_recovering(i);
        set_drags(i, false);
        system_.set_phase(i, Phase::flight);
        y_[system_.layout().root_depth(i)] = S(0);
        recorder_.event(EventKind::recovered, i, snapshot(y_));
        if (system_.in_flight()) {
            step_ = std::max(flight_step_, first_step());
            method_.return_to_explicit();
        }
    }

    // Without damping a bristle that nothing holds is back at once; what it stored goes where a damper, however
    // weak, would have taken it.
    void release_undamped_bristle(int i) {
        if constexpr (Law::has_clutch) {
            const auto& friction = system_.law(i).friction;
            if (friction.damping > S(0)) return;
            const S scale = friction.scale(system_.root_depth(y_, i));
            y_[system_.layout().ledger(i) + Layout::tangential_damper] +=
                friction.stored_energy(scale, system_.bristle(y_, i));
            y_.template segment<2>(system_.layout().bristle(i)).setZero();
        }
    }

    // The asperities have parted. Nothing is stored in them at F_n = 0.
    void forget_friction([[maybe_unused]] int i) {
        if constexpr (Law::has_states)
            for (S& x : system_.friction_states(y_, i)) x = S(0);
    }

    void rearm() {
        for (int j = 0; j < guards_.size(); ++j)
            if (guards_[j] > S(0)) armed_[index(j)] = true;
    }

    // ---- bookkeeping ------------------------------------------------------------------------------------------

    // What the method leaves to do at the end of a step of length dt.
    void tidy(StateVector& y, const S& dt) {
        const auto& layout = system_.layout();
        auto q = y.template segment<4>(Layout::orientation);
        q /= std::sqrt(q.square().sum());
        recover_in_flight(y, dt);
        if (system_.in_flight()) {
            flight_step_ = step_;
        } else {
            align_position(y);
        }
        // Numbers on their way to nothing become nothing, before they are denormal and slow.
        for (int c = 0; c < layout.size(); ++c)
            if (std::abs(y[c]) < S(1e-150)) y[c] = S(0);
    }

    // In flight udot = -(K_t/D_t) u, whose solution needs no method. (31) with F_f = 0. Where the tangential spring
    // has a stiffness at z = 0, as the linear one does, its damper takes what it held. (28)
    void recover_in_flight(StateVector& y, const S& dt) const {
        if constexpr (Law::has_clutch) {
            for (int i = 0; i < system_.spheres(); ++i) {
                const auto& friction = system_.law(i).friction;
                if (system_.touches(i) || !(friction.damping > S(0))) continue;
                const S scale = friction.scale(S(0));
                const Vector2<S> before = system_.bristle(y, i);
                const Vector2<S> after = before * S(std::exp(-friction.recovery_rate() * dt));
                y.template segment<2>(system_.layout().bristle(i)) = after.array();
                y[system_.layout().ledger(i) + Layout::tangential_damper] +=
                    friction.stored_energy(scale, before) - friction.stored_energy(scale, after);
            }
        }
    }

    // s^2 and the depth that the body's position gives are one number kept twice. The forces follow s, so the position
    // is moved to it: by the mean over the spheres that touch.
    void align_position(StateVector& y) const {
        const Motion m = system_.motion(y);
        S apart(0);
        int touching = 0;
        for (int i = 0; i < system_.spheres(); ++i) {
            if (!system_.touches(i)) continue;
            const S s = y[system_.layout().root_depth(i)];
            apart += system_.geometric_depth(m, system_.kinematics(m, i), i) - s * s;
            ++touching;
        }
        y[system_.layout().position() + 2] += apart / S(touching);
    }

    void account() {
        const Ledger ledger = ledger_of(system_, y_);
        if (!std::isfinite(ledger.total())) stop_for_overflow(static_cast<double>(y_[system_.layout().time()]));
        recorder_.account(ledger);
        see(ledger);
    }
    void see(const Ledger& ledger) { scales_.see(y_, ledger.kinetic + ledger.contact.stored()); }

    [[nodiscard]] Snapshot snapshot(const StateVector& y) const { return snapshot_of(system_, frame_, y); }

    // Samples and peaks inside the step just taken, which reaches from one time to another.
    void record_inside(const S& from, const S& to) {
        bool dense = false;
        const auto prepare = [&] {
            if (!dense) method_.prepare_dense();
            dense = true;
        };
        while (recorder_.next_sample() <= static_cast<double>(to)) {
            prepare();
            const S due(recorder_.next_sample());
            StateVector y = method_.at(theta_of(due, from, to));
            recover_in_flight(y, due - from);
            recorder_.sample(snapshot(y));
        }
        peaks_.pass(system_, method_, piece_of_step(), recorder_, prepare);
    }

    [[nodiscard]] S theta_of(const S& time, const S& from, const S& to) const {
        if (system_.in_flight()) return (time - from) / (to - from);
        const auto late = [&](S theta) { return method_.at(theta, system_.layout().time()) - time; };
        if (!(from < time)) return S(0);
        if (!(time < to)) return S(1);
        std::uintmax_t iterations = 50;
        const auto r = boost::math::tools::toms748_solve(
            late, S(0), S(1), from - time, to - time,
            boost::math::tools::eps_tolerance<S>(std::numeric_limits<S>::digits - 4), iterations);
        return (r.first + r.second) / S(2);
    }

    [[nodiscard]] S piece_of_step() const { return S(1e-4) * step_; }

    // A body that comes to lie on the ground swings on its contact at about sqrt(g / static depth), and a radian of
    // that costs one step. It may never come to lie, or come to rest so fully that the implicit method strides over it,
    // so only a run that is out of reach by far is refused before it starts.
    void refuse_the_hopeless() const {
        const double pressing = -static_cast<double>(system_.gravity().z());
        if (!(pressing > 0)) return;
        const double rate = std::sqrt(pressing / scales_.static_depth());
        const double estimate = method_.stages * rate * options_.end_time;
        constexpr double far = 100;
        if (estimate > far * options_.max_evaluations) refuse_cost(estimate, rate, options_);
    }

    // Stops a run that its caller or its budget no longer wants.
    void watch() {
        const double now = static_cast<double>(y_[system_.layout().time()]);
        if (options_.progress && !options_.progress(now)) throw Interrupted("the run was interrupted");
        if (static_cast<double>(cost_.evaluations) > options_.max_evaluations) stop_for_cost(now, options_);
    }

    static constexpr int longest_visit = 5;      // touchdown, stick, slip, separation, recovered
    static constexpr double coincidence = 1e-9;  // of a step: crossings nearer than this are one

    RunOptions options_;
    GroundFrame<S> frame_;
    SystemType system_;
    Scales<SystemType> scales_;
    Recorder recorder_;
    S end_time_;
    double extent_ = 0;  // size of body and ground's height [m]
    Cost cost_;

    StateVector y_, weight_, scratch_;
    Guards guards_, lowest_, scratch_guards_;  // at the step's start; the least over its stages; of the last evaluation
    // A guard that has just been handled starts on its zero; it is looked at again once it has been positive.
    std::vector<bool> armed_;
    std::vector<S> silent_until_;
    Peaks<SystemType> peaks_;
    DualSystem dual_system_;
    Method<StateVector, Layout::motion_at_compile_time, RightHandSide, JacobianMatrix> method_;

    S step_{0}, fixed_step_{0};
    S flight_step_{0}, first_contact_step_{0};
    bool first_contact_step_pending_ = false;
    struct Stall {
        S since{-1};     // time of the contact's last event
        int events = 0;  // those in a row that it had without time going on
    };
    std::vector<Stall> stalls_;
};

}  // namespace footfall
