// The contacts in one step of a host as a Solver sees them: a Hybrid of a HeldPlant, with its sizes and its jumps.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "footfall/host/held_scales.hpp"
#include "footfall/law/jump.hpp"
#include "footfall/law/mode.hpp"
#include "footfall/math/value_of.hpp"
#include "footfall/plant/held.hpp"
#include "footfall/simulate/contact_guards.hpp"
#include "footfall/simulate/hybrid.hpp"
#include "footfall/solve/solver.hpp"

namespace footfall {

/// `LawType` is a contact law over S (law/pair.hpp).
template <class LawType>
class HeldSystem : public ContactGuards<HeldSystem<LawType>, Hybrid<HeldPlant<typename LawType::value_type>, LawType>> {
    using Base = ContactGuards<HeldSystem<LawType>, Hybrid<HeldPlant<typename LawType::value_type>, LawType>>;
    friend Base;
    using Base::depth_rate, Base::hybrid_;

public:
    using HybridType = Hybrid<HeldPlant<typename LawType::value_type>, LawType>;
    using Base::clock;
    using typename Base::Law, typename Base::Plant, typename Base::S, typename Base::State, typename Base::Value;

    static constexpr int motion_at_compile_time = Eigen::Dynamic;
    static constexpr bool differentiates_along = true;
    /// A step of a host is short: what is stiff in it has to be seen soon.
    static constexpr Switching switching{
        .look = 16, .border = 4, .price = 20, .patience = 4, .gentle = 0.25, .follows_turning = true};

    struct Event {
        Value time;  ///< since the step's start [s]
        int contact;
        EventKind kind;
    };

    /// One law for each contact; `tolerance` is relative. `step` is what the host gives: it outlives the system, and is
    /// filled before `begin`.
    HeldSystem(HeldStep<S>& step, const std::vector<Law>& laws, double tolerance, bool torques)
        : Base(HybridType(Plant(step, torques), laws)),
          step_(step),
          scales_(laws.size()),
          tolerance_(step_share * tolerance),
          held_before_(laws.size()),
          rates_(State::Zero(hybrid_.size())) {
        tables_.reserve(laws.size());
        for (const Law& law : laws) tables_.emplace_back(law);
    }

    [[nodiscard]] const HeldStep<S>& step() const noexcept { return step_; }
    [[nodiscard]] const HeldScales& scales() const noexcept { return scales_; }
    [[nodiscard]] const std::vector<Event>& events() const noexcept { return events_; }
    /// What contact i held at the start, at the depth and the velocity that the host has given [J].
    [[nodiscard]] const Held<S>& held_before(int i) const noexcept { return held_before_[at(i)]; }
    void set_mode(int i, Mode mode) noexcept { hybrid_.set_mode(i, mode); }

    /// A step of dt begins, with every contact in the phase that it was left in.
    void begin(std::span<const Phase> phases, double dt) {
        for (int i = 0; i < hybrid_.contacts(); ++i) hybrid_.set_mode(i, {phases[at(i)]});
        std::fill(step_.depth_offset.begin(), step_.depth_offset.end(), S(0));
        step_.plain_time = false;
        events_.clear();
        scales_.measure(
            step_, dt, [this](std::size_t i, double s) { return held_normal(static_cast<int>(i), s); },
            [this](std::size_t i, double energy) { return tables_[i](energy); });
        after_landing_ = Value(0);
        landed_ = false;
    }

    [[nodiscard]] bool uniform() const noexcept { return step_.plain_time || hybrid_.in_flight(); }

    // ---- sizes of steps and errors -------------------------------------------------------------------------------

    template <class Weights>
    void weights(const State& y, Weights& weight) const {
        weight.resize(y.size());
        const auto set = [&](int first, int count, double size) {
            for (int c = first; c < first + count; ++c) {
                const double value = static_cast<double>(std::abs(value_of(y[c])));
                weight[c] = Value(1 / std::max({tolerance_ * size, 8 * eps() * value, tiny}));
            }
        };
        const Plant& plant = hybrid_.plant();
        for (int i = 0; i < hybrid_.contacts(); ++i) {
            const double s = scales_.root_depth(i);
            set(Plant::velocity + 3 * i, 3, scales_.speed(i));
            set(plant.root_depth_component(i), 1, s);
            const Law& law = hybrid_.law(i);
            const std::span<const S> x = hybrid_.states(y, i);
            for (int k = 0; k < law.states(); ++k) {
                double size = law.state_size(k, S(s));
                if (law.sized_by_what_is_seen(k)) {
                    const Vector2<S> u = law.bristle(x);
                    size = std::max(size, std::hypot(number(u.x()), number(u.y())));
                }
                set(hybrid_.first_state(i) + k, 1, size);
            }
            const int follow = hybrid_.follow();
            set(follow + plant.impulse(i), 3, scales_.impulse(i));
            set(follow + plant.impulse_moment(i), 3, scales_.impulse(i) * scales_.dt());
            if (plant.torques())
                set(follow + plant.angular_impulse(i), 3, scales_.impulse(i) * number(step_.radius[at(i)]));
            set(hybrid_.taken(i), taken_channels, scales_.energy());
        }
        set(plant.clock_component(), 1, scales_.dt());
        set(clock(), 1, scales_.dt());
    }

    [[nodiscard]] static Value longest_step(const State&) noexcept { return std::numeric_limits<Value>::max(); }
    /// Over sigma: the whole of the host's step, or a part of what the fastest contact takes to swing.
    [[nodiscard]] Value first_step() const {
        if (landed_) return after_landing_;
        return first_step_;
    }
    static void accepted(const Value&) noexcept {}
    static void stepped(const Value&) noexcept {}

    void tidy(State& y, const Value& from, const Value& to) const {
        this->relax(y, to - from);
        Base::end_decay(y);
    }

    /// Short beside an impact.
    [[nodiscard]] Value moment() const noexcept {
        Value least = Value(scales_.dt());
        for (int i = 0; i < hybrid_.contacts(); ++i)
            least = std::min(least, Value(scales_.root_depth(i) * scales_.root_depth(i) / scales_.speed(i)));
        constexpr double little = 1e-3;
        return Value(little) * least;
    }

    // ---- jumps -----------------------------------------------------------------------------------------------------

    /// Contacts go on from the last step, or are found in the ground, or above it, at the depth that the host gives.
    void start(State& y, std::vector<bool>&) {
        const Plant& plant = hybrid_.plant();
        for (int i = 0; i < hybrid_.contacts(); ++i) {
            using std::sqrt;
            const S& z = step_.depth[at(i)];
            const bool deep = value_of(z) > touching(i);
            y[plant.root_depth_component(i)] = deep ? S(sqrt(z)) : S(0);
            if (!deep || hybrid_.touches(i)) continue;
            const Touch<S> t = hybrid_.touch(y, i);
            hybrid_.law(i).land(t, hybrid_.states(y, i));
        }
        for (int i = 0; i < hybrid_.contacts(); ++i) begin_contact(i, y);
        hybrid_.evaluate(y, rates_);
        // A contact that has gone on sees a kink: the host has moved it a little, and changed what it is pulled by.
        const S g = hybrid_.time_rate(y);
        for (int i = 0; i < hybrid_.contacts(); ++i) {
            if (!goes_on_[at(i)]) continue;
            const Touch<S> t = hybrid_.touch(y, i);
            const bool presses = hybrid_.law(i).load_at(t, hybrid_.states(y, i)).over_scale > S(0);
            const S pull = -rates_[Plant::velocity + 3 * i + 2] / g;
            apply(i, hybrid_.law(i).kink(hybrid_.mode(i), presses, t, t, pull, hybrid_.states(y, i)), y);
        }
        std::vector<int> pressed;
        add_pressed(pressed, y);
        choose_time(y);
        if (!pressed.empty()) touch_down(pressed, y);
    }

private:
    static constexpr double tiny = 1e-300;
    /// Of the tolerance, for the error of one step of the method: a host's step takes some, and its events.
    static constexpr double step_share = 0.03;
    static constexpr double eps() { return static_cast<double>(std::numeric_limits<Value>::epsilon()); }
    static std::size_t at(int i) { return static_cast<std::size_t>(i); }
    template <class T>
    static double number(const T& x) {
        return static_cast<double>(value_of(x));
    }

    [[nodiscard]] double held_normal(int i, double s) const {
        const std::size_t n = at(hybrid_.law(i).states());
        const Touch<S> t{S(s), S(0), Vector2<S>::Zero()};
        return number(
            hybrid_.law(i).held({Phase::recovering}, t, std::span<const S>(no_states_).first(n)).normal_spring);
    }

    /// Sets the mode that contact i starts in.
    void begin_contact(int i, State& y) {
        const Touch<S> t = hybrid_.touch(y, i);
        const bool deep = value_of(y[hybrid_.plant().root_depth_component(i)]) > Value(0);
        const Mode was = hybrid_.mode(i);
        goes_on_[at(i)] = deep && was.touches();
        if (deep && !was.touches()) {
            // On a copy, as `before` is what the contact held while it was found.
            std::copy_n(hybrid_.states(y, i).begin(), hybrid_.state_count(i), begun_.begin());
            const std::span<S> x = hybrid_.states(y, i);
            const Jump<S> j = hybrid_.law(i).start(t, x);
            held_before_[at(i)] =
                hybrid_.law(i).held(j.mode, t, std::span<const S>(begun_).first(hybrid_.state_count(i)));
            apply(i, j, y);
            return;
        }
        held_before_[at(i)] = hybrid_.law(i).held(was, t, hybrid_.states(y, i));
        if (deep || !was.touches()) return;
        if (was.loaded()) cross_one(Law::load_guard, i, false, y);
        cross_one(Law::depth_guard, i, false, y);
    }

    /// Where no contact comes near its surface the host's time itself will do, and the end of the step need not be
    /// looked for.
    void choose_time(const State& y) {
        const S g = hybrid_.time_rate(y);
        bool plain = true;
        double fastest = 0;
        for (int i = 0; i < hybrid_.contacts(); ++i) {
            if (!hybrid_.touches(i)) continue;
            const Touch<S> t = hybrid_.touch(y, i);
            const double z = number(t.root_depth * t.root_depth), rate = std::abs(number(t.depth_rate));
            const double pull = std::abs(number(rates_[Plant::velocity + 3 * i + 2] / g)), dt = scales_.dt();
            constexpr double near = 0.5;  // of the depth
            plain = plain && rate * dt + pull * dt * dt < near * z;
            const double force = std::max(number(hybrid_.law(i).normal_force(t, hybrid_.states(y, i))), 0.0);
            constexpr double power = 1.5;  // of the depth in most laws
            fastest = std::max({fastest, std::sqrt(power * scales_.compliance(i) * force / z), rate / z});
        }
        step_.plain_time = plain;
        constexpr double turn = 1.5;  // of the fastest swing, in radians
        const double step = fastest * scales_.dt() > turn ? turn / fastest : scales_.dt();
        first_step_ = Value(step / number(hybrid_.time_rate(y)));
    }

    /// Distances below this are rounding [m].
    [[nodiscard]] Value touching(int i) const {
        constexpr double roundings = 64;
        const double depth = std::abs(number(step_.depth[at(i)]));
        return Value(roundings * eps() * (depth + scales_.root_depth(i) * scales_.root_depth(i)));
    }
    /// On the ground to rounding, and not about to leave it.
    [[nodiscard]] bool about_to_touch(const State& y, int i) {
        const Plant& plant = hybrid_.plant();
        const S z = plant.geometric_depth(y, plant.motion(y), hybrid_.follow(), i);
        return std::abs(value_of(z)) <= touching(i) && comes_down(y, i);
    }
    void add_pressed(std::vector<int>& landing, const State& y) {
        Base::add_those(landing, [&](int i) { return about_to_touch(y, i); });
    }
    [[nodiscard]] bool comes_down(const State& y, int i) const {
        const Value rate = depth_rate(y, i);
        constexpr double roundings = 16;
        if (std::abs(rate) > Value(roundings * eps() * scales_.speed(i))) return rate > Value(0);
        return depth_pull(y, i) > Value(0);
    }
    /// d(zdot)/dt of contact i at y.
    [[nodiscard]] Value depth_pull(const State& y, int i) const {
        hybrid_.evaluate(y, rates_);
        return value_of(S(-rates_[Plant::velocity + 3 * i + 2] / hybrid_.time_rate(y)));
    }

    /// The contacts begin, a little inside the ground, far below rounding, with s_i as sqrt(z_i) is going to be.
    void touch_down(const std::vector<int>& contacts, State& y) {
        using std::sqrt;
        step_.plain_time = false;
        const auto rates = [&](auto&& of) {
            Value most(0);
            for (const int i : contacts) most = std::max(most, of(i));
            return most;
        };
        const auto speed = [&](int i) { return depth_rate(y, i); };
        const auto pull = [&](int i) { return depth_pull(y, i); };
        const bool moves = rates(speed) > Value(0);
        const Value fastest = moves ? rates(speed) : rates(pull);
        double step = std::numeric_limits<double>::max();
        for (const int i : contacts) {
            const Value share = std::max(Value((moves ? speed(i) : pull(i)) / fastest), Value(eps()));
            constexpr double inside = 1e-2;
            y[hybrid_.plant().root_depth_component(i)] =
                S(Value(inside * scales_.root_depth(i)) * sqrt(Value(eps()) * share));
            constexpr double part = 0.1;  // of the way to the full depth
            step = std::min(step, part * scales_.root_depth(i) / scales_.speed(i));
        }
        for (const int i : contacts) {
            const Touch<S> t = hybrid_.touch(y, i);
            const S before = hybrid_.held(y, t, i).tangential_spring;
            const Jump<S> jump = hybrid_.law(i).touch_down(t, later(i), hybrid_.states(y, i));
            apply(i, jump, y);
            close(i, t, before, jump, y);
        }
        after_landing_ = Value(step);
        landed_ = true;
    }
    /// A root depth soon after touchdown, at which stick or slip can be told.
    [[nodiscard]] S later(int i) const {
        constexpr double soon = 1e-6;
        return S(soon * scales_.root_depth(i));
    }

    /// By what s has gone astray the depth in flight is off.
    void left_ground(int i, const State& y) {
        const Plant& plant = hybrid_.plant();
        step_.depth_offset[at(i)] += plant.geometric_depth(y, plant.motion(y), hybrid_.follow(), i);
    }
    [[nodiscard]] Value flight_step() const { return Value(scales_.dt()); }
    void cross_one(int kind, int i, bool on_border, State& y) {
        const Touch<S> t = hybrid_.touch(y, i);
        const S before = hybrid_.held(y, t, i).tangential_spring;
        const Jump<S> jump = hybrid_.law(i).cross(kind, hybrid_.mode(i), t, later(i), on_border, hybrid_.states(y, i));
        apply(i, jump, y);
        if (kind == Law::load_guard) close(i, t, before, jump, y);
    }
    /// A spring in proportion to the load loses what it holds with the load. That is zero where the guard is; but a
    /// stiff contact's load is known as its velocity is, and no force pays for what it is off by.
    void close(int i, const Touch<S>& t, const S& before, const Jump<S>& jump, State& y) const {
        S missing = before - hybrid_.held(y, t, i).tangential_spring;
        for (const S& taken : jump.taken) missing -= taken;
        y[hybrid_.taken(i) + unpaid] += missing;
    }
    void apply(int i, const Jump<S>& jump, State& y) {
        hybrid_.set_mode(i, jump.mode);
        hybrid_.book(y, i, jump.taken);
        for (int k = 0; k < jump.event_count; ++k)
            events_.push_back({value_of(y[clock()]), i, jump.events[static_cast<std::size_t>(k)]});
    }

    HeldStep<S>& step_;
    HeldScales scales_;
    std::vector<RootDepthTable> tables_;
    double tolerance_;
    std::vector<Held<S>> held_before_;
    std::vector<bool> goes_on_ = std::vector<bool>(held_before_.size());
    std::vector<Event> events_;
    mutable State rates_;
    std::array<S, static_cast<std::size_t>(Law::most_states)> begun_{}, no_states_{};
    Value first_step_{0}, after_landing_{0};
    bool landed_ = false;
};

}  // namespace footfall
