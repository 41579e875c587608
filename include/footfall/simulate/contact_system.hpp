// Bodies in contact as a Solver sees them: a Hybrid, with its sizes, its derivatives and its jumps.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "footfall/math/value_of.hpp"
#include "footfall/simulate/account.hpp"
#include "footfall/simulate/derivatives.hpp"
#include "footfall/simulate/scales.hpp"
#include "footfall/solve/solver.hpp"

namespace footfall {

/// What happens to a body over the ground, from any start. `HybridType` is a Hybrid of a FreeBody.
template <class HybridType>
class ContactSystem {
public:
    using S = typename HybridType::S;
    using Value = ValueOf<S>;
    using State = typename HybridType::State;
    using Guards = typename HybridType::Guards;
    using Law = typename HybridType::LawType;
    using Plant = typename HybridType::PlantType;

    static constexpr int motion_at_compile_time = HybridType::motion_at_compile_time;
    static constexpr int guards_per_group = HybridType::guards_per_contact;
    /// A derivative along one vector is worth it where the whole Jacobian takes many.
    static constexpr bool differentiates_along = !HybridType::fixed;
    static constexpr int longest_visit = 5;  ///< events without time: touchdown, stick, slip, separation, recovered

    /// What hears of the start and of every event, in its new mode.
    struct Listener {
        std::function<void(const State&)> begin = [](const State&) {};
        std::function<void(EventKind, int, const State&)> event = [](EventKind, int, const State&) {};
        /// Before an n x n Jacobian is made; may throw.
        std::function<void(int, const State&)> jacobian = [](int, const State&) {};
    };

    ContactSystem(HybridType hybrid, const Body& body, const Ground& ground, const Eigen::Vector3d& gravity,
                  double tolerance)
        : hybrid_(std::move(hybrid)),
          derivatives_(hybrid_),
          scales_(hybrid_, body, gravity, tolerance),
          extent_(std::abs(ground.height)) {
        for (const Sphere& s : body.spheres) extent_ = std::max(extent_, s.center.norm() + s.radius);
    }

    void listen(Listener listener) { listener_ = std::move(listener); }
    [[nodiscard]] const HybridType& hybrid() const noexcept { return hybrid_; }
    [[nodiscard]] const Scales<HybridType>& scales() const noexcept { return scales_; }

    // ---- the equations -------------------------------------------------------------------------------------------

    [[nodiscard]] int motion_size() const noexcept { return hybrid_.motion_size(); }
    [[nodiscard]] int guard_count() const noexcept { return guards_per_group * hybrid_.contacts(); }
    [[nodiscard]] int clock() const noexcept { return hybrid_.clock(); }
    [[nodiscard]] bool uniform() const noexcept { return hybrid_.in_flight(); }

    void evaluate(const State& y, State& rate, Guards* guards) const noexcept { hybrid_.evaluate(y, rate, guards); }

    /// d(rate)/dy of the motion, and its product with a vector; what they cost, in evaluations.
    template <class Values, class Matrix>
    std::int64_t jacobian(const Values& y, Matrix& J) {
        listener_.jacobian(motion_size(), State(y));
        return derivatives_.jacobian(hybrid_, y, J);
    }
    template <class Values, class Product>
    std::int64_t along(const Values& y, const Product& v, Product& Jv) {
        return derivatives_.along(hybrid_, y, v, Jv);
    }

    // ---- sizes of steps and errors -------------------------------------------------------------------------------

    template <class Weights>
    void weights(const State& y, Weights& weight) const {
        scales_.weights(hybrid_, y, weight);
    }

    /// Turning spheres dip into the ground and out again: half a radian at most between looks.
    [[nodiscard]] Value longest_step(const State& y) const {
        if (!hybrid_.plant().oriented()) return std::numeric_limits<Value>::max();
        const Value spin = value_of(hybrid_.plant().motion(y).angular_velocity.norm());
        if (!(spin > Value(0))) return std::numeric_limits<Value>::max();
        return Value(0.5) / (spin * value_of(hybrid_.time_rate(y)));
    }

    /// A guess at the step after a touchdown: a fiftieth of the way to the full depth, or what served the last time.
    [[nodiscard]] Value first_step() const {
        if (hybrid_.in_flight()) return Value(scales_.depth() / scales_.speed());
        if (first_contact_step_ > Value(0)) return first_contact_step_;
        return Value(0.02 * scales_.root_depth() / scales_.speed());
    }
    void accepted(const Value& h) noexcept {
        if (!first_contact_step_pending_) return;
        first_contact_step_ = h;
        first_contact_step_pending_ = false;
    }
    void stepped(const Value& next) noexcept {
        if (hybrid_.in_flight()) flight_step_ = next;
    }

    /// Takes note of the account at y.
    void see(const State& y, const Ledger& ledger) {
        scales_.see(hybrid_, y, ledger.kinetic + ledger.contact.stored());
    }

    void tidy(State& y, const Value& from, const Value& to) const {
        Plant::normalize(y);
        relax(y, to - from);
        if (!hybrid_.in_flight())
            hybrid_.plant().align(y, hybrid_.follow(), [this](int i) { return hybrid_.touches(i); });
        // What decays for long is set to zero before it is denormal, which would be slow.
        constexpr double nothing = 1e-150;
        for (S& x : y)
            if (std::abs(value_of(x)) < Value(nothing)) x -= S(value_of(x));  // what it carries besides stays
    }

    /// What the states of contacts in flight have become after dt.
    void relax(State& y, const Value& dt) const {
        for (int i = 0; i < hybrid_.contacts(); ++i)
            if (!hybrid_.touches(i))
                y[hybrid_.taken(i) + by_tangential_damper] += hybrid_.law(i).relax(S(dt), hybrid_.states(y, i));
    }

    // ---- guards ----------------------------------------------------------------------------------------------------

    /// Touchdown follows from the position, which no stage knows.
    [[nodiscard]] bool blind(int guard) const noexcept { return !hybrid_.touches(contact(guard)); }
    [[nodiscard]] Value approach(int guard, const State& y) const { return depth_rate(y, contact(guard)); }
    /// Whether the sphere moves into the ground, or stands and is about to.
    [[nodiscard]] bool approaches(int guard, const State& y) const { return comes_down(y, contact(guard)); }

    /// What ends the contact goes before what ends its stick or slip.
    [[nodiscard]] bool outranks(int j, int other) const noexcept {
        return kind(j) == Law::depth_guard || kind(other) == Law::clutch_guard;
    }
    [[nodiscard]] bool quick(int guard) const { return hybrid_.law(contact(guard)).quick(kind(guard)); }
    /// A contact may be left recovering, or sticking.
    [[nodiscard]] bool may_wait(int guard) const noexcept {
        const Phase phase = hybrid_.mode(contact(guard)).phase;
        return (kind(guard) == Law::load_guard && phase == Phase::recovering) ||
               (kind(guard) == Law::clutch_guard && phase == Phase::stick);
    }
    /// Short beside an impact.
    [[nodiscard]] Value moment() const noexcept { return Value(1e-3 * scales_.depth() / scales_.speed()); }

    // ---- jumps -----------------------------------------------------------------------------------------------------

    /// Spheres that start in the ground, on it and pressed, or on it and moving into it.
    void start(State& y, std::vector<bool>&) {
        const auto& plant = hybrid_.plant();
        std::vector<int> in_ground, pressed;
        {
            const auto m = plant.motion(y);
            for (int i = 0; i < hybrid_.contacts(); ++i) {
                const S z = plant.geometric_depth(y, m, hybrid_.follow(), i);
                if (!(value_of(z) > touching(y))) continue;
                using std::sqrt;
                y[Plant::root_depths + i] = sqrt(z);
                in_ground.push_back(i);
            }
        }
        std::vector<Jump<S>> jumps;
        State begun = y;
        for (const int i : in_ground) {
            const Touch<S> t = hybrid_.touch(y, i);
            hybrid_.law(i).land(t, hybrid_.states(y, i));
            hybrid_.law(i).land(t, hybrid_.states(begun, i));
            jumps.push_back(hybrid_.law(i).start(t, hybrid_.states(begun, i)));
        }
        for (std::size_t k = 0; k < in_ground.size(); ++k) hybrid_.set_mode(in_ground[k], jumps[k].mode);
        const std::vector<Value> pull = depth_accelerations(y);
        for (int i = 0; i < hybrid_.contacts(); ++i)
            if (!hybrid_.touches(i) && about_to_touch(y, i, pull)) pressed.push_back(i);
        see(y, ledger_of(hybrid_, y));
        listener_.begin(y);
        for (std::size_t k = 0; k < in_ground.size(); ++k) {
            const int i = in_ground[k];
            const auto from = hybrid_.states(std::as_const(begun), i);
            std::copy(from.begin(), from.end(), hybrid_.states(y, i).begin());
            apply(i, jumps[k], y);
        }
        if (!pressed.empty()) touch_down(pressed, y);
    }

    /// Guards have reached zero at y.
    GoesOn<Value> jump(std::span<const int> guards, State& y, std::vector<bool>& armed) {
        GoesOn<Value> next;
        std::vector<int> landing;
        for (const int guard : guards)
            if (!hybrid_.touches(contact(guard))) landing.push_back(contact(guard));
        for (const int guard : guards) {
            const int i = contact(guard);
            for (int k = 0; k < guards_per_group; ++k) armed[at(i, k)] = true;
            if (hybrid_.touches(i)) cross(guard, y, armed, next);
        }
        if (!landing.empty()) {
            const std::vector<Value> pull = depth_accelerations(y);
            for (int k = 0; k < hybrid_.contacts(); ++k)
                if (!hybrid_.touches(k) && std::find(landing.begin(), landing.end(), k) == landing.end() &&
                    about_to_touch(y, k, pull))
                    landing.push_back(k);
            touch_down(landing, y);
            next.step = first_step();
        }
        return next;
    }

private:
    static Value eps() { return std::numeric_limits<Value>::epsilon(); }
    static std::size_t at(int i, int guard) { return static_cast<std::size_t>(i * guards_per_group + guard); }
    static int contact(int guard) noexcept { return guard / guards_per_group; }
    static int kind(int guard) noexcept { return guard % guards_per_group; }

    [[nodiscard]] Value depth_rate(const State& y, int i) const {
        return value_of(hybrid_.plant().depth_rate(hybrid_.plant().motion(y), i));
    }

    /// Distances below this are rounding [m].
    [[nodiscard]] Value touching(const State& y) const {
        return Value(64) * eps() * (value_of(Plant::position(y, hybrid_.follow()).norm()) + Value(extent_));
    }
    /// On the ground to rounding, and not about to leave it. `pull` is d(zdot)/dt of each contact.
    [[nodiscard]] bool about_to_touch(const State& y, int i, const std::vector<Value>& pull) const {
        const auto& plant = hybrid_.plant();
        const S z = plant.geometric_depth(y, plant.motion(y), hybrid_.follow(), i);
        if (std::abs(value_of(z)) > touching(y)) return false;
        const Value rate = depth_rate(y, i);
        return std::abs(rate) > standing(y) ? rate > Value(0) : pull[static_cast<std::size_t>(i)] > Value(0);
    }
    [[nodiscard]] bool comes_down(const State& y, int i) const {
        const Value rate = depth_rate(y, i);
        if (std::abs(rate) > standing(y)) return rate > Value(0);
        return depth_accelerations(y)[static_cast<std::size_t>(i)] > Value(0);
    }
    /// Depth rates below this are rounding [m/s].
    [[nodiscard]] Value standing(const State& y) const {
        const auto m = hybrid_.plant().motion(y);
        return Value(16) * eps() * value_of(m.velocity.norm() + m.angular_velocity.norm() * S(extent_));
    }
    [[nodiscard]] std::vector<Value> depth_accelerations(const State& y) const {
        std::vector<Value> all;
        for (const S& a : hybrid_.depth_accelerations(y)) all.push_back(value_of(a));
        return all;
    }

    /// The spheres begin to touch. A root depth of exactly zero would say nothing of their ratio, so they start a
    /// little inside, far below rounding: with s_i as sqrt(z_i) is going to be.
    void touch_down(const std::vector<int>& spheres, State& y) {
        using std::sqrt;
        std::vector<Value> rate;
        for (const int i : spheres) rate.push_back(depth_rate(y, i));
        if (!(*std::max_element(rate.begin(), rate.end()) > Value(0))) {
            const std::vector<Value> pull = depth_accelerations(y);
            for (std::size_t k = 0; k < spheres.size(); ++k) rate[k] = pull[static_cast<std::size_t>(spheres[k])];
        }
        const Value fastest = *std::max_element(rate.begin(), rate.end());
        for (std::size_t k = 0; k < spheres.size(); ++k) {
            const int i = spheres[k];
            const Value share = std::max(rate[k] / fastest, eps());
            y[Plant::root_depths + i] = S(Value(1e-2) * sqrt(eps() * value_of(hybrid_.plant().radius(i)) * share));
        }
        for (const int i : spheres) {
            const Touch<S> t = hybrid_.touch(y, i);
            apply(i, hybrid_.law(i).touch_down(t, later(), hybrid_.states(y, i)), y);
        }
        first_contact_step_pending_ = true;
    }
    /// A root depth soon after touchdown, at which stick or slip can be told.
    [[nodiscard]] S later() const { return S(1e-6 * scales_.root_depth()); }

    void cross(int guard, State& y, std::vector<bool>& armed, GoesOn<Value>& next) {
        const int i = contact(guard);
        const bool dragged = hybrid_.mode(i).drags;
        const S scale_before = hybrid_.time_rate(y);
        if (kind(guard) == Law::depth_guard) {
            if (hybrid_.mode(i).loaded()) cross_one(Law::load_guard, i, false, y);
            y[Plant::root_depths + i] = S(0);
            cross_one(Law::depth_guard, i, false, y);
            armed[at(i, Law::load_guard)] = false;
            if (hybrid_.in_flight()) {
                next.step = std::max(flight_step_, first_step());
                next.calm = true;
            }
            return;
        }
        const bool on_border = kind(guard) == Law::load_guard && !dragged && has_border_motion(y, i);
        cross_one(kind(guard), i, on_border, y);
        armed[static_cast<std::size_t>(guard)] = false;
        if (dragged && kind(guard) == Law::clutch_guard) armed[at(i, Law::load_guard)] = false;
        // A contact that drags does not count in g: the next step stays as long in time.
        if (hybrid_.mode(i).drags != dragged) next.stretch *= value_of(scale_before) / value_of(hybrid_.time_rate(y));
    }
    void cross_one(int kind, int i, bool on_border, State& y) {
        const Touch<S> t = hybrid_.touch(y, i);
        apply(i, hybrid_.law(i).cross(kind, hybrid_.mode(i), t, later(), on_border, hybrid_.states(y, i)), y);
    }

    /// Whether either mode at F_n = 0 pushes the motion into the other at once: then it goes along the border.
    [[nodiscard]] bool has_border_motion(const State& y, int i) {
        if (!hybrid_.law(i).may_drag()) return false;
        return hybrid_.load_guard_rate(y, i, {Phase::slip}) < S(0) &&
               hybrid_.load_guard_rate(y, i, {Phase::recovering}) > S(0);
    }

    void apply(int i, const Jump<S>& jump, State& y) {
        hybrid_.set_mode(i, jump.mode);
        hybrid_.book(y, i, jump.taken);
        for (int k = 0; k < jump.event_count; ++k) listener_.event(jump.events[static_cast<std::size_t>(k)], i, y);
    }

    HybridType hybrid_;
    Derivatives<HybridType> derivatives_;
    Scales<HybridType> scales_;
    Listener listener_;
    double extent_;  // size of body and ground's height [m]
    Value flight_step_{0}, first_contact_step_{0};
    bool first_contact_step_pending_ = false;
};

}  // namespace footfall
