// What every system of moving bodies in contact answers a Solver in the same way: the equations of its Hybrid, the
// guards of its contacts, and the order of events where they are crossed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "footfall/law/jump.hpp"
#include "footfall/law/mode.hpp"
#include "footfall/law/touch.hpp"
#include "footfall/math/value_of.hpp"
#include "footfall/simulate/derivatives.hpp"
#include "footfall/simulate/hybrid.hpp"
#include "footfall/solve/goes_on.hpp"

namespace footfall {

/// The base of `System`, which follows a `HybridType` and says the rest:
///
///   comes_down(y, i)          whether contact i moves into the ground, or stands and is about to
///   add_pressed(landing, y)   adds the contacts that are on the ground to rounding, and not about to leave it
///   touch_down(landing, y)    these contacts begin
///   cross_one(kind, i, on_border, y)   a guard of contact i has been crossed (Pair::cross)
///   left_ground(i, y)         contact i has ended
///   first_step(), flight_step()   the next step in sigma, after a touchdown and where nothing touches any more
template <class System, class HybridType>
class ContactGuards {
public:
    using S = typename HybridType::S;
    using Value = ValueOf<S>;
    using State = typename HybridType::State;
    using Guards = typename HybridType::Guards;
    using Law = typename HybridType::LawType;
    using Plant = typename HybridType::PlantType;

    static constexpr int guards_per_group = HybridType::guards_per_contact;
    static constexpr int longest_visit = 5;  ///< events without time: touchdown, stick, slip, separation, recovered

    [[nodiscard]] const HybridType& hybrid() const noexcept { return hybrid_; }

    // ---- the equations -------------------------------------------------------------------------------------------

    [[nodiscard]] int motion_size() const noexcept { return hybrid_.motion_size(); }
    [[nodiscard]] int guard_count() const noexcept { return guards_per_group * hybrid_.contacts(); }
    [[nodiscard]] int clock() const noexcept { return hybrid_.clock(); }

    void evaluate(const State& y, State& rate, Guards* guards) const noexcept { hybrid_.evaluate(y, rate, guards); }

    /// d(rate)/dy of the motion, and its product with a vector; what they cost, in evaluations.
    template <class Values, class Matrix>
    std::int64_t jacobian(const Values& y, Matrix& J) {
        return derivatives_.jacobian(hybrid_, y, J);
    }
    template <class Values, class Product>
    std::int64_t along(const Values& y, const Product& v, Product& Jv) {
        return derivatives_.along(hybrid_, y, v, Jv);
    }

    /// What the states of contacts in flight have become after dt.
    void relax(State& y, const Value& dt) const {
        for (int i = 0; i < hybrid_.contacts(); ++i)
            if (!hybrid_.touches(i))
                y[hybrid_.taken(i) + by_tangential_damper] += hybrid_.law(i).relax(S(dt), hybrid_.states(y, i));
    }

    // ---- guards ----------------------------------------------------------------------------------------------------

    /// Touchdown follows from what no stage knows: the position, or the impulses.
    [[nodiscard]] bool blind(int guard) const noexcept { return !hybrid_.touches(contact(guard)); }
    [[nodiscard]] Value approach(int guard, const State& y) const { return depth_rate(y, contact(guard)); }
    [[nodiscard]] bool approaches(int guard, const State& y) const { return self().comes_down(y, contact(guard)); }

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
            self().add_pressed(landing, y);
            self().touch_down(landing, y);
            next.step = self().first_step();
        }
        return next;
    }

protected:
    explicit ContactGuards(HybridType hybrid) : hybrid_(std::move(hybrid)), derivatives_(hybrid_) {}

    static Value eps() { return std::numeric_limits<Value>::epsilon(); }
    static std::size_t at(int i, int guard) { return static_cast<std::size_t>(i * guards_per_group + guard); }
    static int contact(int guard) noexcept { return guard / guards_per_group; }
    static int kind(int guard) noexcept { return guard % guards_per_group; }

    [[nodiscard]] Value depth_rate(const State& y, int i) const {
        return value_of(hybrid_.plant().depth_rate(hybrid_.plant().motion(y), i));
    }

    /// What decays for long is set to zero before it is denormal, which would be slow.
    static void end_decay(State& y) {
        constexpr double nothing = 1e-150;
        for (S& x : y)
            if (std::abs(value_of(x)) < Value(nothing)) x -= S(value_of(x));  // what it carries besides stays
    }

    /// Adds the contacts in flight for which `about_to_touch(i)`, but for those that are there already.
    template <class AboutToTouch>
    void add_those(std::vector<int>& contacts, AboutToTouch&& about_to_touch) const {
        for (int i = 0; i < hybrid_.contacts(); ++i)
            if (!hybrid_.touches(i) && std::find(contacts.begin(), contacts.end(), i) == contacts.end() &&
                about_to_touch(i))
                contacts.push_back(i);
    }

    HybridType hybrid_;
    Derivatives<HybridType> derivatives_;

private:
    [[nodiscard]] System& self() noexcept { return static_cast<System&>(*this); }
    [[nodiscard]] const System& self() const noexcept { return static_cast<const System&>(*this); }

    void cross(int guard, State& y, std::vector<bool>& armed, GoesOn<Value>& next) {
        const int i = contact(guard);
        const bool dragged = hybrid_.mode(i).drags;
        const S scale_before = hybrid_.time_rate(y);
        if (kind(guard) == Law::depth_guard) {
            if (hybrid_.mode(i).loaded()) self().cross_one(Law::load_guard, i, false, y);
            y[hybrid_.plant().root_depth_component(i)] = S(0);
            self().cross_one(Law::depth_guard, i, false, y);
            armed[at(i, Law::load_guard)] = false;
            self().left_ground(i, y);
            if (hybrid_.in_flight()) {
                next.step = self().flight_step();
                next.calm = true;
            }
            return;
        }
        const bool on_border = kind(guard) == Law::load_guard && !dragged && has_border_motion(y, i);
        self().cross_one(kind(guard), i, on_border, y);
        armed[static_cast<std::size_t>(guard)] = false;
        if (dragged && kind(guard) == Law::clutch_guard) armed[at(i, Law::load_guard)] = false;
        // A contact that drags does not count in g: the next step stays as long in time.
        if (hybrid_.mode(i).drags != dragged) next.stretch *= value_of(scale_before) / value_of(hybrid_.time_rate(y));
    }

    /// Whether either mode at F_n = 0 pushes the motion into the other at once: then it goes along the border.
    [[nodiscard]] bool has_border_motion(const State& y, int i) {
        if (!hybrid_.law(i).may_drag()) return false;
        return hybrid_.load_guard_rate(y, i, {Phase::slip}) < S(0) &&
               hybrid_.load_guard_rate(y, i, {Phase::recovering}) > S(0);
    }
};

}  // namespace footfall
