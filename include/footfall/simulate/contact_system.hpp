// A body in contact as a Solver sees it: a Hybrid, with its sizes, its start and its touchdowns.
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
#include "footfall/simulate/contact_guards.hpp"
#include "footfall/simulate/scales.hpp"
#include "footfall/solve/solver.hpp"

namespace footfall {

/// What happens to a body over the ground, from any start. `HybridType` is a Hybrid of a FreeBody.
template <class HybridType>
class ContactSystem : public ContactGuards<ContactSystem<HybridType>, HybridType> {
    using Base = ContactGuards<ContactSystem<HybridType>, HybridType>;
    friend Base;
    using Base::add_those, Base::depth_rate, Base::eps, Base::hybrid_;

public:
    using Base::motion_size;
    using typename Base::Law, typename Base::Plant, typename Base::S, typename Base::State, typename Base::Value;

    static constexpr int motion_at_compile_time = HybridType::motion_at_compile_time;
    /// A derivative along one vector is worth it where the whole Jacobian takes many.
    static constexpr bool differentiates_along = !HybridType::fixed;

    /// What hears of the start and of every event, in its new mode.
    struct Listener {
        std::function<void(const State&)> begin = [](const State&) {};
        std::function<void(EventKind, int, const State&)> event = [](EventKind, int, const State&) {};
        /// Before an n x n Jacobian is made; may throw.
        std::function<void(int, const State&)> jacobian = [](int, const State&) {};
    };

    ContactSystem(HybridType hybrid, const Body& body, const Ground& ground, const Eigen::Vector3d& gravity,
                  double tolerance)
        : Base(std::move(hybrid)), scales_(hybrid_, body, gravity, tolerance), extent_(std::abs(ground.height)) {
        for (const Sphere& s : body.spheres) extent_ = std::max(extent_, s.center.norm() + s.radius);
    }

    void listen(Listener listener) { listener_ = std::move(listener); }
    [[nodiscard]] const Scales<HybridType>& scales() const noexcept { return scales_; }

    // ---- the equations -------------------------------------------------------------------------------------------

    [[nodiscard]] bool uniform() const noexcept { return hybrid_.in_flight(); }

    template <class Values, class Matrix>
    std::int64_t jacobian(const Values& y, Matrix& J) {
        listener_.jacobian(motion_size(), State(y));
        return Base::jacobian(y, J);
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
        this->relax(y, to - from);
        if (!hybrid_.in_flight())
            hybrid_.plant().align(y, hybrid_.follow(), [this](int i) { return hybrid_.touches(i); });
        Base::end_decay(y);
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
                y[plant.root_depth_component(i)] = sqrt(z);
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
        add_pressed(pressed, y);
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

private:
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
    void add_pressed(std::vector<int>& landing, const State& y) const {
        const std::vector<Value> pull = depth_accelerations(y);
        add_those(landing, [&](int i) { return about_to_touch(y, i, pull); });
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
            y[hybrid_.plant().root_depth_component(i)] =
                S(Value(1e-2) * sqrt(eps() * value_of(hybrid_.plant().radius(i)) * share));
        }
        for (const int i : spheres) {
            const Touch<S> t = hybrid_.touch(y, i);
            apply(i, hybrid_.law(i).touch_down(t, later(), hybrid_.states(y, i)), y);
        }
        first_contact_step_pending_ = true;
    }
    /// A root depth soon after touchdown, at which stick or slip can be told.
    [[nodiscard]] S later() const { return S(1e-6 * scales_.root_depth()); }

    static void left_ground(int /*i*/, const State& /*y*/) noexcept {}
    [[nodiscard]] Value flight_step() const { return std::max(flight_step_, first_step()); }
    void cross_one(int kind, int i, bool on_border, State& y) {
        const Touch<S> t = hybrid_.touch(y, i);
        apply(i, hybrid_.law(i).cross(kind, hybrid_.mode(i), t, later(), on_border, hybrid_.states(y, i)), y);
    }

    void apply(int i, const Jump<S>& jump, State& y) {
        hybrid_.set_mode(i, jump.mode);
        hybrid_.book(y, i, jump.taken);
        for (int k = 0; k < jump.event_count; ++k) listener_.event(jump.events[static_cast<std::size_t>(k)], i, y);
    }

    Scales<HybridType> scales_;
    Listener listener_;
    double extent_;  // size of body and ground's height [m]
    Value flight_step_{0}, first_contact_step_{0};
    bool first_contact_step_pending_ = false;
};

}  // namespace footfall
