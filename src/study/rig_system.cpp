#include "study/rig_system.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace footfall {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

Vector2<double> pair_at(const RigSystem::State& y, int first) { return {y[first], y[first + 1]}; }

}  // namespace

RigSystem::RigSystem(const Rig& rig, const Timeline& timeline, const RigLaw& law)
    : rig_(rig),
      timeline_(timeline),
      interval_(timeline.intervals().front()),
      hybrid_(Plant(rig_, timeline_, interval_), {law}),
      derivatives_(hybrid_),
      all_guards_(HybridType::Guards::Ones(HybridType::guards_per_contact)),
      seen_(State::Zero(hybrid_.size())) {
    set_floors();
}

// ---- the equations -----------------------------------------------------------------------------------------------

void RigSystem::evaluate(const State& y, State& rate, Guards* guards) {
    if (!guards) {
        hybrid_.evaluate(y, rate);
        return;
    }
    hybrid_.evaluate(y, rate, &all_guards_);
    (*guards)[clutch_guard] = mode().loaded() ? all_guards_[Law::clutch_guard] : 1;
    const bool looks = mode().loaded() && !direction_.isZero();
    (*guards)[turn_guard] = looks ? hybrid_.touch(y, 0).slip.dot(direction_) + turning_noise() : 1;
}

/// A slip velocity below this is nothing but rounding, and turns all the time [m/s].
double RigSystem::turning_noise() const {
    constexpr double steps = 1e3;  // whose errors it may have gathered
    return steps * rig_.tolerance * std::max(seen_[Plant::velocity], floor_[Plant::velocity]);
}

void RigSystem::look_along(const State& y) {
    if (!law().has_kink_at_rest()) return;
    const Vector2<double> V = hybrid_.touch(y, 0).slip;
    direction_ = V.norm() > 0 ? V / V.norm() : Vector2<double>();
}

RigState RigSystem::measure(const State& y) const {
    const Instant now = instant(y);
    const Contact c = contact(y);
    const int follow = hybrid_.follow();
    RigState s;
    s.time = now.time;
    s.phase = mode().phase;
    s.depth = now.depth;
    s.depth_rate = now.depth_rate;
    // At the surface itself the depth is kept from being exactly zero.
    constexpr double nothing = 1e-90;
    s.normal_force = c.response.push.normal > nothing ? c.response.push.normal : 0;
    s.friction_force = to_eigen(c.response.push.friction);
    s.slip_displacement = to_eigen(pair_at(y, follow + Plant::displacement));
    s.slip_velocity = to_eigen(c.touch.slip);
    s.bristle = to_eigen(law().bristle(hybrid_.states(y, 0)));
    s.energy = energy(y);
    if (plant().carries()) {
        const Plant::Motion m = plant().motion(y);
        s.position = to_eigen(m.position);
        s.velocity = to_eigen(m.velocity);
        s.holding_force = to_eigen(plant().holding_force(m));
    }
    return s;
}

RigEnergy RigSystem::energy(const State& y) const {
    const Plant::Motion m = plant().motion(y);
    const Held<double> held = hybrid_.held(y, Plant::touch(y, m, 0), 0);
    RigEnergy energy;
    energy.contact.normal_spring = held.normal_spring;
    energy.contact.tangential_spring = held.tangential_spring;
    read_integrals(energy.contact, contact_channels, y, hybrid_.taken(0));
    read_integrals(energy, rig_channels, y, hybrid_.follow() + Plant::integrals);
    if (plant().carries()) {
        energy.kinetic = 0.5 * rig_.mass.mass * m.velocity.squaredNorm();
        energy.holding_spring = 0.5 * rig_.mass.stiffness * (m.support - m.position).squaredNorm();
    }
    return energy;
}

// ---- sizes of steps and errors -----------------------------------------------------------------------------------

double RigSystem::largest_depth() const noexcept {
    return timeline_.largest_depth() > 0 ? timeline_.largest_depth() : 1e-6;
}

/// The least size that a component is measured by: what it may become, times a number that is small enough for what it
/// does become. From then on the largest that has been seen counts.
void RigSystem::set_floors() {
    constexpr double little = 1e-6;
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
    if (plant().carries() && !(speed > 0)) {
        const double stiffness = std::max(rig_.mass.stiffness, timeline_.largest_load() / largest_depth());
        way = std::max(way, force / stiffness);
        speed = way * std::sqrt(stiffness / rig_.mass.mass);
    }
    if (!(way > 0)) way = largest_depth();
    if (!(speed > 0)) speed = way / rig_.end_time;
    const double root_depth = std::sqrt(largest_depth());
    // What tells slip from stick has to be known to this share.
    constexpr double known = 1e-3;
    largest_bristle_error_ = known * speed * law().slip_lag(root_depth);
    floor_ = State::Zero(hybrid_.size());
    floor_.segment(Plant::position, 2).setConstant(little * way);
    floor_.segment(Plant::velocity, 2).setConstant(little * speed);
    for (int i = 0; i < law().states(); ++i) {
        constexpr double share = 1e-2;  // of the natural size of a state
        floor_[hybrid_.first_state(0) + i] = law().sized_by_what_is_seen(i) ? little * std::min(way, largest_depth())
                                                                            : share * law().state_size(i, root_depth);
    }
    const int follow = hybrid_.follow();
    floor_.segment(follow + Plant::displacement, 2).setConstant(little * way);
    const double energy = force * std::max(largest_depth(), little * way);
    floor_.segment(follow + Plant::integrals, Plant::follows - Plant::integrals).setConstant(little * energy);
    floor_.segment(hybrid_.taken(0), taken_channels).setConstant(little * energy);
    floor_[hybrid_.clock()] = rig_.end_time;
    floor_[Plant::theta] = 1;
}

void RigSystem::see(const State& y) {
    const auto pair = [&](int at) {
        const double size = std::max({std::hypot(y[at], y[at + 1]), seen_[at], seen_[at + 1]});
        seen_[at] = seen_[at + 1] = size;
    };
    pair(Plant::position);
    pair(Plant::velocity);
    pair(hybrid_.follow() + Plant::displacement);
    double states = 0;  // one size for the components of a vector
    for (int i = 0; i < law().states(); ++i)
        if (law().sized_by_what_is_seen(i)) states = std::hypot(states, y[hybrid_.first_state(0) + i]);
    for (int i = 0; i < law().states(); ++i) {
        double& size = seen_[hybrid_.first_state(0) + i];
        size = std::max(size, law().sized_by_what_is_seen(i) ? states : std::abs(y[hybrid_.first_state(0) + i]));
    }
    seen_.segment(hybrid_.follow() + Plant::integrals, Plant::follows - Plant::integrals).setConstant(energy_scale_);
    seen_.segment(hybrid_.taken(0), taken_channels).setConstant(energy_scale_);
}

void RigSystem::weights(const State& y, State& weight) {
    see(y);
    State error = rig_.tolerance * seen_.max(floor_);
    if (largest_bristle_error_ > 0) {
        auto states = error.segment(hybrid_.first_state(0), law().states());
        states = states.min(largest_bristle_error_);
    }
    weight.resize(y.size());
    for (Eigen::Index c = 0; c < weight.size(); ++c)
        weight[c] = 1 / std::max({error[c], 8 * eps * std::abs(y[c]), 1e-300});
    weight[Plant::theta] = 1;  // its rate is 1: it has no error
}

/// As long in time as the last of the interval before.
double RigSystem::first_step() const {
    constexpr double small = 1e-4, longest = 0.05;  // of an interval
    const double step = std::min(last_step_ / interval_.length(), longest);
    return step > 0 ? step : small;
}

void RigSystem::tidy(State& y, double from, double to) {
    relax(y, from, to);
    // A velocity that was zero where its direction was asked for.
    if (direction_.isZero()) look_along(y);
}

void RigSystem::relax(State& y, double from, double to) const {
    if (hybrid_.touches(0)) return;
    y[hybrid_.taken(0) + by_tangential_damper] += law().relax(time_at(to) - time_at(from), hybrid_.states(y, 0));
}

/// Short beside all that is prescribed.
double RigSystem::moment() const noexcept {
    constexpr double share = 1e-11;  // of the run
    return share * rig_.end_time / interval_.length();
}

// ---- jumps -------------------------------------------------------------------------------------------------------

void RigSystem::enter(const Interval& interval, const State& y) {
    if (mode().touches()) before_ = hybrid_.touch(y, 0);
    interval_ = interval;
}

void RigSystem::start(State& y, std::vector<bool>&) {
    y[Plant::theta] = 0;
    begin_contact(y);
    before_.reset();
    look_along(y);
}

/// What the interval's beginning does to the contact: it touches down, is loaded or unloaded, lifts off, or sees a kink
/// of what is prescribed.
void RigSystem::begin_contact(State& y) {
    const bool touches = interval_.normal != Phase::flight, presses = interval_.normal == Phase::slip;
    const std::span<double> x = hybrid_.states(y, 0);
    const Touch<double> now = hybrid_.touch(y, 0);
    if (mode().touches()) {
        const double acceleration = plant().motion(y).depth_acceleration;
        apply(law().kink(mode(), presses, before_.value_or(now), now, acceleration, x), y);
        if (!touches) apply(law().cross(Law::depth_guard, mode(), now, 0, false, x), y);
    } else if (touches && !presses) {
        law().land(now, x);
        hybrid_.set_mode(0, {Phase::recovering});
    } else if (presses && interval_.from_surface) {
        constexpr double soon = 1e-6;  // of the largest
        apply(law().touch_down(now, soon * std::sqrt(largest_depth()), x), y);
    } else if (presses) {
        law().land(now, x);
        apply(law().kink({Phase::recovering}, true, now, now, 0, x), y);
    }
}

GoesOn<double> RigSystem::jump(std::span<const int> guards, State& y, std::vector<bool>& armed) {
    for (const int guard : guards) {
        armed[static_cast<std::size_t>(guard)] = false;
        if (guard == turn_guard) {
            direction_ = -direction_;
            continue;
        }
        const double now = time_at(y[Plant::theta]);
        constexpr double no_time = 1e-12;  // of the run
        constexpr int often = 2 * longest_visit;
        switches_ = now > last_switch_ + no_time * rig_.end_time ? 0 : switches_ + 1;
        last_switch_ = now;
        if (switches_ > often)
            throw TooExpensive(fmt::format("stopped at {:.6g} s: the clutch lets go and takes hold without end", now));
        apply(law().cross(Law::clutch_guard, mode(), hybrid_.touch(y, 0), 0, false, hybrid_.states(y, 0)), y);
    }
    return {};
}

void RigSystem::apply(const Jump<double>& jump, State& y) {
    hybrid_.set_mode(0, jump.mode);
    hybrid_.book(y, 0, jump.taken);
    for (int k = 0; k < jump.event_count; ++k) listener_(jump.events[static_cast<std::size_t>(k)], y);
}

}  // namespace footfall
