// Drives a contact through the intervals of its timeline: phases frozen during a step, their ends located, energy
// booked.
#include "footfall/study/drive.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>

#include <boost/math/tools/toms748_solve.hpp>
#include <fmt/format.h>

#include "footfall/simulate/budget.hpp"
#include "footfall/solve/first_zero.hpp"
#include "footfall/solve/method.hpp"
#include "study/driven_contact.hpp"
#include "study/swing.hpp"
#include "study/timeline.hpp"

namespace footfall {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

// A sample is kept, becomes a row of drive_table, and is written as text: as JSON, a number takes some 40 characters,
// and the text is there twice before it is printed.
constexpr double columns_of_table = 28;
constexpr double sample_bytes = sizeof(RigState) + columns_of_table * (sizeof(double) + 2 * 40);
constexpr double event_bytes = 2 * sizeof(RigEvent);  // a full list moves to a larger place

class Driver {
public:
    Driver(const Rig& rig, const ContactParameters& laws)
        : rig_(rig),
          timeline_(rig, std::visit([](const auto& law) { return AnyNormal<>(law); }, laws.normal)),
          contact_(DrivenContact::make(rig, timeline_, laws)),
          swing_(rig, timeline_),
          method_(RightHandSide{this}, Slopes{this}, contact_->layout().motion_size()) {
        const DrivenLayout& layout = contact_->layout();
        y_ = DrivenState::Zero(layout.size());
        weight_ = DrivenState::Ones(layout.size());
        seen_ = DrivenState::Zero(layout.size());
        set_floors();
    }

    Drive run() {
        reserve_samples();
        const auto start = std::chrono::steady_clock::now();
        const std::vector<Interval>& intervals = timeline_.intervals();
        for (std::size_t k = 0; k < intervals.size(); ++k) {
            begin_interval(intervals[k], k == 0);
            while (y_[L::theta] < 1) {
                ask(rig_.go_on);
                advance();
            }
            y_[L::theta] = 1;
        }
        sample_end();
        result_.stick_slip = swing_.result(result_.samples);
        result_.max_residual = result_.energy_scale > 0 ? largest_error_ / result_.energy_scale : 0;
        result_.cost.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return std::move(result_);
    }

private:
    using L = DrivenLayout;
    struct RightHandSide {
        Driver* driver;
        void operator()(const DrivenState& y, DrivenState& rate, bool look) const { driver->evaluate(y, rate, look); }
    };
    struct Slopes {
        Driver* driver;
        template <class Vector, class Matrix>
        void operator()(const Vector& y, Matrix& J) const {
            ++driver->result_.cost.evaluations;
            driver->contact_->differentiate(DrivenState(y), J);
        }
    };

    void evaluate(const DrivenState& y, DrivenState& rate, bool look) {
        ++result_.cost.evaluations;
        contact_->evaluate(y, rate, look ? &guards_ : nullptr);
        if (look) lowest_ = std::min(lowest_, guards_.clutch);
    }

    void reserve_samples() {
        const double samples = sample_count(rig_.period(), rig_.end_time);
        samples_bytes_ = samples * sample_bytes;
        if (samples_bytes_ > rig_.max_memory)
            throw TooExpensive(
                fmt::format("{:.3g} samples would take about {} of memory, more than the {} of max_memory; choose a "
                            "longer sample period or a shorter run, or raise max_memory",
                            samples, bytes_text(samples_bytes_), bytes_text(rig_.max_memory)));
        result_.samples.reserve(static_cast<std::size_t>(samples));
    }

    // ---- sizes ------------------------------------------------------------------------------------------------

    // The least size that a component is measured by: what it may become, times a number that is small enough for what
    // it does become. From then on the largest that has been seen counts.
    void set_floors() {
        constexpr double little = 1e-6;
        const DrivenLayout& layout = contact_->layout();
        double way = 0, speed = 0, force = timeline_.largest_load();
        for (const Interval& interval : timeline_.intervals()) {
            constexpr int looks = 16;
            for (int i = 0; i <= looks; ++i) {
                const Instant now = timeline_.at(interval, i / static_cast<double>(looks));
                speed = std::max({speed, now.slip.norm(), now.belt.norm(), now.support_velocity.norm()});
                way = std::max({way, now.support.norm(), now.slip.norm() * interval.length(),
                                now.belt.norm() * interval.length(),
                                rig_.drag == Drag::displacement ? now.displacement.norm() : 0.0});
                force = std::max(force, now.force.norm());
            }
        }
        if (rig_.drag == Drag::mass && !(speed > 0)) {
            const double stiffness = std::max(rig_.mass.stiffness, timeline_.largest_load() / largest_depth());
            way = std::max(way, force / stiffness);
            speed = way * std::sqrt(stiffness / rig_.mass.mass);
        }
        if (!(way > 0)) way = largest_depth();
        if (!(speed > 0)) speed = way / rig_.end_time;
        floor_ = DrivenState::Zero(layout.size());
        floor_.segment(L::position, 2).setConstant(little * way);
        floor_.segment(L::velocity, 2).setConstant(little * speed);
        for (int i = 0; i < layout.state_count; ++i) {
            const double size = contact_->state_size(i);
            floor_[L::states + i] = size > 0 ? 1e-2 * size : little * std::min(way, largest_depth());
        }
        floor_.segment(layout.displacement(), 2).setConstant(little * way);
        const double energy = force * std::max(largest_depth(), little * way);
        floor_.segment(layout.ledger(), layout.size() - layout.ledger()).setConstant(little * energy);
        floor_[L::theta] = 1;
    }
    [[nodiscard]] double largest_depth() const {
        return timeline_.largest_depth() > 0 ? timeline_.largest_depth() : 1e-6;
    }

    void see() {
        const DrivenLayout& layout = contact_->layout();
        const auto pair = [&](int at) {
            const double size = std::max({std::hypot(y_[at], y_[at + 1]), seen_[at], seen_[at + 1]});
            seen_[at] = seen_[at + 1] = size;
        };
        pair(L::position);
        pair(L::velocity);
        pair(layout.displacement());
        if (layout.state_count >= 2) pair(L::states);
        for (int i = 2; i < layout.state_count; ++i)
            seen_[L::states + i] = std::max(seen_[L::states + i], std::abs(y_[L::states + i]));
        seen_.segment(layout.ledger(), layout.size() - layout.ledger()).setConstant(result_.energy_scale);
        const DrivenState size = seen_.max(floor_);
        for (Eigen::Index c = 0; c < weight_.size(); ++c)
            weight_[c] = 1 / std::max({rig_.tolerance * size[c], 8 * eps * std::abs(y_[c]), 1e-300});
        weight_[L::theta] = 1;  // its rate is 1: it has no error
    }

    // ---- steps ------------------------------------------------------------------------------------------------

    void begin_interval(const Interval& interval, bool first) {
        const Phase before = contact_->phase();
        interval_ = interval;
        contact_->enter(interval, y_);
        if (first) initial_balance_ = state(y_).energy.balance();
        account();
        say_phase(before, first);
        look_along_now();
        begin_phase();
        if (guards_.clutch < 0) {  // what a kink of the paths has changed at once
            switch_clutch();
            begin_phase();
        }
        step_ = std::min(first ? 1e-4 : last_step_ / interval.length(), 0.05);
        if (!(step_ > 0)) step_ = 1e-4;
        if (first) sample_until(interval.from);
    }

    void say_phase(Phase before, bool first) {
        const auto loaded = [](Phase p) { return p == Phase::stick || p == Phase::slip; };
        const Phase now = contact_->phase();
        if (loaded(now) && (first || !loaded(before))) {
            say(EventKind::touchdown);
            if (now == Phase::stick) say(EventKind::stick);
        } else if (loaded(now) && now != before) {
            say(now == Phase::stick ? EventKind::stick : EventKind::slip);
        } else if (!loaded(now)) {
            if (loaded(before) && !first) say(EventKind::separation);
            if (now == Phase::flight && before != Phase::flight && !first) say(EventKind::recovered);
        }
    }
    void say(EventKind kind) {
        const double needed = samples_bytes_ + static_cast<double>(result_.events.size()) * event_bytes;
        if (needed > rig_.max_memory)
            throw TooExpensive(fmt::format(
                "stopped at {:.6g} s: {} events take about {} of memory with the samples, more than the {} of "
                "max_memory; shorten the run, or raise max_memory",
                time_at(y_[L::theta]), result_.events.size(), bytes_text(needed), bytes_text(rig_.max_memory)));
        result_.events.push_back({time_at(y_[L::theta]), kind, state(y_)});
        see_forces(result_.events.back().state);
    }

    void look_along_now() {
        const Eigen::Vector2d V = contact_->moment(y_).slip;
        contact_->look_along(V.norm() > 0 ? Eigen::Vector2d(V.normalized()) : Eigen::Vector2d(0, 0));
    }

    void begin_phase() {
        see();
        method_.begin(y_);
        lowest_ = guards_.clutch;
        start_guards_ = guards_;
    }

    void advance() {
        const double rest = 1 - y_[L::theta];
        const double taken = accepted_step(rest);
        const DrivenGuards end_guards = guards_;
        Crossing<double> crossing = find_crossing(end_guards);
        const bool whole = !crossing;
        if (crossing && !locate(crossing, taken)) {
            step_ = 0.5 * crossing.theta * taken;
            return;
        }
        const double from = y_[L::theta];
        const double to = whole && taken >= rest ? 1 : method_.end()[L::theta];
        record_inside(from, to);
        y_ = method_.end();
        y_[L::theta] = to;
        ++result_.cost.steps;
        if (method_.implicit()) ++result_.cost.stiff_steps;
        last_step_ = step_ * interval_.length();
        account();
        if (crossing) {
            handle(crossing);
            begin_phase();
        } else {
            start_guards_ = end_guards;
            if (end_guards.clutch > 0) armed_ = true;
            if (end_guards.turn > 0) turn_armed_ = true;
            if (contact_->turns() && contact_->direction().isZero(0)) look_along_now();
            see();
            method_.advance(y_, weight_);
            lowest_ = end_guards.clutch;
        }
        if (static_cast<double>(result_.cost.evaluations) > rig_.max_evaluations)
            throw TooExpensive(fmt::format("stopped at {:.6g} s: max_evaluations = {:.3g} is spent",
                                           time_at(y_[L::theta]), rig_.max_evaluations));
    }

    double accepted_step(double rest) {
        bool refused = false;
        for (;;) {
            const double longest = std::min(rest, timeline_.longest_step(interval_));
            const bool cut = step_ >= longest;
            const double h = cut ? longest : step_;
            method_.step(h, weight_);
            const double error = method_.error(weight_);
            if (error <= 1) {
                method_.finish();
                const double factor = method_.growth(error, refused);
                if (!cut) step_ = h * factor;
                if (cut && factor < 1) step_ = h;
                return h;
            }
            ++result_.cost.rejected;
            refused = true;
            step_ = method_.gives_up(error) ? 1e-4 : h * method_.growth(error, true);
            if (!(step_ > 1e-14))
                throw TooExpensive(fmt::format("stopped at {:.6g} s: no step is small enough for the tolerance",
                                               time_at(y_[L::theta])));
        }
    }

    // ---- events -----------------------------------------------------------------------------------------------

    static constexpr int clutch_guard = 0, turn_guard = 1;

    [[nodiscard]] Crossing<double> find_crossing(const DrivenGuards& at_end) {
        Crossing<double> first;
        bool dense = false;
        const auto prepare = [&] {
            if (!dense) method_.prepare_dense();
            dense = true;
        };
        DrivenState scratch_rate = y_;
        const auto course_of = [&](int guard) {
            return [this, guard, &scratch_rate](double theta) {
                DrivenGuards g;
                contact_->evaluate(method_.at(theta), scratch_rate, &g);
                return guard == clutch_guard ? g.clutch : g.turn;
            };
        };
        const auto look = [&](int guard, double at_start, bool armed) {
            const auto value = course_of(guard);
            const double theta = first_zero<double>(value, armed ? at_start : 0.0);
            if (theta < 0 || (first && first.theta <= theta)) return;
            const double d = 1e-6, before = std::max(theta - d, 0.0), after = std::min(theta + d, 1.0);
            first = {guard, theta, (value(after) - value(before)) / (after - before)};
        };
        const bool near = lowest_ < 0.1 * std::min(start_guards_.clutch, at_end.clutch);
        if (at_end.clutch < 0 || near) {
            prepare();
            look(clutch_guard, start_guards_.clutch, armed_);
        }
        // A slip velocity that is nothing but rounding turns all the time.
        const double noise = 1e3 * rig_.tolerance * std::max(seen_[L::velocity], floor_[L::velocity]);
        if (at_end.turn < -noise) {
            prepare();
            look(turn_guard, start_guards_.turn, turn_armed_);
        }
        return first;
    }

    // Ends the step on the guard's zero, by steps of the method itself.
    [[nodiscard]] bool locate(const Crossing<double>& crossing, double whole) {
        double theta = crossing.theta;
        for (int attempt = 0; attempt < 6; ++attempt) {
            theta = std::clamp(theta, 0.0, 1.5);
            method_.step(theta * whole, weight_);
            method_.finish();
            if (!method_.end().allFinite()) return false;
            if (method_.implicit() && !(method_.error(weight_) < 1e9)) return false;
            const double value = crossing.guard == clutch_guard ? guards_.clutch : guards_.turn;
            if (!(crossing.slope < 0)) return true;
            const double correction = -value / crossing.slope;
            if (!(std::abs(correction) > 64 * eps)) return true;
            theta += correction;
        }
        return true;
    }

    void handle(const Crossing<double>& crossing) {
        if (crossing.guard == turn_guard) {
            contact_->look_along(-contact_->direction());
            turn_armed_ = false;
            return;
        }
        const double now = time_at(y_[L::theta]);
        constexpr int often = 50;  // two phases may each push the motion into the other
        switches_ = now > last_switch_ + 1e-12 * rig_.end_time ? 0 : switches_ + 1;
        last_switch_ = now;
        if (switches_ > often)
            throw TooExpensive(fmt::format("stopped at {:.6g} s: the clutch lets go and takes hold without end", now));
        switch_clutch();
    }

    void switch_clutch() {
        const Phase before = contact_->phase();
        contact_->switch_phase(y_);
        armed_ = false;
        if (contact_->phase() != before) say(contact_->phase() == Phase::stick ? EventKind::stick : EventKind::slip);
        account();
    }

    // ---- what is kept -----------------------------------------------------------------------------------------

    [[nodiscard]] double time_at(double theta) const { return timeline_.at(interval_, theta).time; }

    [[nodiscard]] RigState state(const DrivenState& y) const {
        const DrivenLayout& layout = contact_->layout();
        const Instant now = timeline_.at(interval_, y[L::theta]);
        const DrivenMoment m = contact_->moment(y);
        const auto pair = [&y](int at) { return Eigen::Vector2d(y[at], y[at + 1]); };
        RigState s;
        s.time = now.time;
        s.phase = contact_->phase();
        s.depth = now.depth;
        s.depth_rate = now.depth_rate;
        // At the surface itself the depth is kept from being exactly zero.
        constexpr double nothing = 1e-90;
        s.normal_force = m.normal_force > nothing ? m.normal_force : 0;
        s.friction_force = m.friction_force;
        s.slip_displacement = pair(layout.displacement());
        s.slip_velocity = m.slip;
        s.bristle = m.bristle;
        const int e = layout.ledger();
        RigEnergy& energy = s.energy;
        energy.contact.normal_spring = m.normal_spring;
        energy.contact.tangential_spring = m.tangential_spring;
        read_integrals(energy.contact, contact_channels, y, e);
        read_integrals(energy, rig_channels, y, e + static_cast<int>(integral_count(contact_channels)));
        if (rig_.drag == Drag::mass) {
            const HeldMass& h = rig_.mass;
            s.position = pair(L::position);
            s.velocity = pair(L::velocity);
            const Eigen::Vector2d stretch = now.support - s.position;
            s.holding_force = h.stiffness * stretch + h.damping * (now.support_velocity - s.velocity);
            energy.kinetic = 0.5 * h.mass * s.velocity.squaredNorm();
            energy.holding_spring = 0.5 * h.stiffness * stretch.squaredNorm();
        }
        return s;
    }

    void account() {
        const RigEnergy energy = state(y_).energy;
        result_.energy_scale = std::max(result_.energy_scale, energy.magnitude());
        largest_error_ = std::max(largest_error_, std::abs(energy.balance() - initial_balance_));
    }

    void record_inside(double from, double to) {
        bool dense = false;
        const auto prepare = [&] {
            if (!dense) method_.prepare_dense();
            dense = true;
        };
        const double until = time_at(to);
        while (next_sample_ * rig_.period() < until && next_sample_ * rig_.period() < sample_end_time()) {
            prepare();
            const double theta = Timeline::theta_of(interval_, next_sample_ * rig_.period());
            keep(method_.at(std::clamp((theta - from) / (to - from), 0.0, 1.0)));
            ++next_sample_;
        }
        if (swing_.watches()) watch_swing(from, to, prepare);
    }

    template <class Prepare>
    void watch_swing(double from, double to, Prepare&& prepare) {
        const auto rate = [&](const DrivenState& y) { return swing_.rate(y, timeline_.at(interval_, y[L::theta])); };
        const double before = rate(method_.start()), after = rate(method_.end());
        if ((before > 0) == (after > 0) || !(to > from)) return;
        prepare();
        std::uintmax_t iterations = 60;
        const auto r =
            boost::math::tools::toms748_solve([&](double share) { return rate(method_.at(share)); }, 0.0, 1.0, before,
                                              after, boost::math::tools::eps_tolerance<double>(), iterations);
        const DrivenState y = method_.at((r.first + r.second) / 2);
        const Instant now = timeline_.at(interval_, y[L::theta]);
        swing_.turn(now.time, swing_.deflection(y, now), before > 0);
    }

    void sample_until(double time) {
        while (next_sample_ * rig_.period() <= time) {
            keep(y_);
            ++next_sample_;
        }
    }
    /// The last sample is the end itself, so one that rounding puts just before it is left out.
    [[nodiscard]] double sample_end_time() const { return rig_.end_time * (1 - 64 * eps); }
    void sample_end() { keep(y_); }

    void keep(const DrivenState& y) {
        result_.samples.push_back(state(y));
        see_forces(result_.samples.back());
    }
    void see_forces(const RigState& s) {
        result_.largest_normal_force = std::max(result_.largest_normal_force, s.normal_force);
        result_.largest_friction_force = std::max(result_.largest_friction_force, s.friction_force.norm());
    }

    const Rig& rig_;
    Timeline timeline_;
    std::unique_ptr<DrivenContact> contact_;
    Swing swing_;
    Drive result_;

    Interval interval_;
    DrivenState y_, weight_, seen_, floor_;
    DrivenGuards guards_, start_guards_;
    double lowest_ = 0;
    bool armed_ = true, turn_armed_ = true;
    Method<DrivenState, Eigen::Dynamic, RightHandSide, Slopes> method_;
    double step_ = 1e-4, last_step_ = 0;  // in theta; in time
    double next_sample_ = 0;
    double samples_bytes_ = 0;
    double initial_balance_ = 0, largest_error_ = 0;
    double last_switch_ = -1;
    int switches_ = 0;
};

}  // namespace

double RigEnergy::held() const noexcept { return sum_of(*this, rig_channels, ChannelKind::held, contact.stored()); }
double RigEnergy::taken() const noexcept {
    return sum_of(*this, rig_channels, ChannelKind::taken, contact.dissipated());
}
double RigEnergy::worked() const noexcept { return sum_of(*this, rig_channels, ChannelKind::worked, contact.worked()); }

double RigEnergy::balance() const noexcept {
    double sum = contact.stored() + contact.dissipated() + contact.unpaid() - contact.worked();
    for (const auto& channel : rig_channels) {
        const double entry = this->*channel.member;
        sum += channel.kind == ChannelKind::worked ? -entry : entry;
    }
    return sum;
}

double RigEnergy::magnitude() const noexcept {
    double sum = 0;
    for (const auto& channel : contact_channels) sum += std::abs(contact.*channel.member);
    for (const auto& channel : rig_channels) sum += std::abs(this->*channel.member);
    return sum;
}

Drive drive(const Rig& rig, const ContactParameters& laws) {
    check(rig);
    check(laws, "contact");
    return in_own_words([&] { return Driver(rig, laws).run(); });
}

}  // namespace footfall
