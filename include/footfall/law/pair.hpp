// A normal law and a friction law, composed: the whole law of one contact, as an automaton.
//
// Modes. In stick and slip the ground presses with the force of the normal law and friction is computed from it. Where
// that force would pull, the contact recovers: the clamp (14) holds F_n at zero, the damper takes what the spring
// gives, and the bristle is free. A recovering contact that drags goes along F_n = 0 (Mode).
//
// States: those of the normal law, then those of the friction law.
//
// A law answers in two rounds. `respond` gives the forces, and all else that follows from how the contact stands. Where
// it asks for its load's rate, `complete` gives the rest once the forces of all contacts have told that.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <type_traits>
#include <utility>

#include "footfall/law/contact_response.hpp"
#include "footfall/law/erased.hpp"
#include "footfall/law/friction/friction_part.hpp"
#include "footfall/law/jump.hpp"
#include "footfall/law/mode.hpp"
#include "footfall/law/normal/normal_part.hpp"
#include "footfall/law/pair_parts.hpp"
#include "footfall/law/push.hpp"
#include "footfall/law/touch.hpp"
#include "footfall/math/dual.hpp"
#include "footfall/math/scalar.hpp"
#include "footfall/math/value_of.hpp"

namespace footfall {

/// `Normal` and `Friction` are laws over the same scalar, or variants of laws.
template <class Normal, class Friction>
class Pair : public PairParts<Normal, Friction> {
    using Parts = PairParts<Normal, Friction>;
    using Parts::count, Parts::elastic_force, Parts::friction_states, Parts::normal_states, Parts::of_friction,
        Parts::of_normal, Parts::scale_power;

public:
    using S = typename Parts::S;
    using value_type = S;
    using States = typename Parts::States;
    using Parts::normal, Parts::friction, Parts::normal_state_count, Parts::normal_parts, Parts::normal_force;

    /// Guards: positive while the mode lasts.
    static constexpr int guards = 3;
    static constexpr int load_guard = 0;    ///< F_n reaches zero, or comes back
    static constexpr int clutch_guard = 1;  ///< (26), or what ends a phase of a friction law with states of its own
    static constexpr int depth_guard = 2;   ///< s reaches zero

    Pair(Normal n, Friction f) : Parts(prepared(std::move(n)), prepared(std::move(f))) {}

    // ---- states -----------------------------------------------------------------------------------------------

    /// The natural size of state i in its own unit, for a contact that reaches the root depth s [m^0.5].
    [[nodiscard]] double state_size(int i, const S& s) const noexcept {
        if (i < normal_state_count()) return of_normal([&](const auto& part) { return part.state_size(i, s); });
        const S elastic = elastic_force(s);
        return of_friction([&](const auto& part) { return part.state_size(i - normal_state_count(), s, elastic); });
    }
    /// Whether the states of friction are measured by the largest that has been seen, where that is more.
    [[nodiscard]] bool sized_by_what_is_seen(int i) const noexcept {
        return i >= normal_state_count() && of_friction([](const auto& part) { return part.sized_by_what_is_seen; });
    }
    /// How long the states of friction lag behind where they slip at the root depth s, where that alone tells slip from
    /// stick; else 0 [s].
    [[nodiscard]] double slip_lag(const S& s) const noexcept {
        return of_friction([&](const auto& part) { return part.slip_lag(s); });
    }
    /// u, or what a friction law has to show in its place [m].
    [[nodiscard]] Vector2<S> bristle(States x) const noexcept {
        return of_friction([&](const auto& part) { return part.bristle(friction_states(x)); });
    }

    // ---- how the contact stands ----------------------------------------------------------------------------------

    /// The answer in a mode, as a smooth function of its arguments: s may be a little below zero, F_n a little
    /// negative. Writes r and the rates of the states. Not for flight, nor for a contact that drags.
    [[gnu::always_inline]] void respond(Mode mode, const Touch<S>& t, States x, std::span<S> rates,
                                        Response<S>& r) const noexcept {
        const S scale = scale_at(t.root_depth);
        const NormalForce<S> phi = normal_over_scale(t, x);
        if (normal_state_count() > 0) put_normal_rates(t, x, rates);
        r = {};
        const std::span<S> own = rates.subspan(count(normal_state_count()));
        if (mode.loaded()) {
            const Load<S> load{scale, phi.total()};
            r.push.normal = load.force();                                        // (13)
            r.power[by_normal_damper] = scale * phi.dissipative * t.depth_rate;  // (16)
            of_friction([&](const auto& part) __attribute__((always_inline)) {
                part.respond(mode.phase, t, load, friction_states(x), own, r);
            });
        } else {
            r.power[by_normal_damper] = -(scale * phi.elastic) * t.depth_rate;  // (14): it takes what the spring gives
            of_friction([&](const auto& part) { part.idle(t, scale, friction_states(x), own, r); });
        }
        if (normal_state_count() > 0) r.power[by_normal_damper] += scale * phi.relaxation;
    }

    /// What follows from d(F_n / s^p)/dt, where the law asks for it.
    void complete(Mode mode, const Touch<S>& t, States x, const S& load_rate, std::span<S> rates,
                  Response<S>& r) const noexcept {
        const Load<S> load = load_at(t, x);
        of_friction([&](const auto& part) {
            part.complete(mode.phase, t, load, load_rate, friction_states(x),
                          rates.subspan(count(normal_state_count())), r);
        });
    }

    /// d(F_n / s^p)/dt under a depth acceleration [m/s^2].
    [[nodiscard]] S load_rate(const Touch<S>& t, States x, const S& depth_acceleration) const noexcept {
        const int over = scale_power();
        return along_motion(t, x, depth_acceleration, [over](const auto& part, const auto& s, const auto& v, auto y) {
            return part.force(over, s, v, y).total();
        });
    }

    /// What the contact holds [J].
    [[nodiscard, gnu::always_inline]] Held<S> held(Mode mode, const Touch<S>& t, States x) const noexcept {
        Held<S> h;
        if (mode.touches())
            h.normal_spring =
                of_normal([&](const auto& part) { return part.stored_energy(t.root_depth, normal_states(x)); });
        const Load<S> load = mode.touches() ? load_at(t, x) : Load<S>{scale_at(S(0)), S(0)};
        h.tangential_spring =
            of_friction([&](const auto& part) { return part.stored(mode.phase, load, friction_states(x)); });
        return h;
    }

    /// s^p, the scale that friction is computed over.
    [[nodiscard]] S scale_at(const S& s) const noexcept { return scale_power() == 0 ? S(1) : s; }
    /// The load as friction sees it.
    [[nodiscard, gnu::always_inline]] Load<S> load_at(const Touch<S>& t, States x) const noexcept {
        return {scale_at(t.root_depth), normal_over_scale(t, x).total()};
    }

    /// Writes the states once the depth of a host's contact, held at t for dt, has changed as its rate says.
    void deepen(const Touch<S>& t, const S& dt, std::span<S> x) const noexcept {
        of_friction([&](const auto& part) { part.deepen(t, dt, friction_states(x)); });
    }

    // ---- a contact that is found, not followed ----------------------------------------------------------------------

    /// The mode of a contact in these states: by the forces, or, where friction remembers its phase, by the mode it was
    /// in. (14), (26)
    [[nodiscard, gnu::always_inline]] Mode mode_at(Mode was, const Touch<S>& t, States x) const noexcept {
        if (!(t.root_depth > S(0))) return {};
        const Load<S> now = load_at(t, x);
        if (!(now.over_scale > S(0))) return {Phase::recovering};
        return {of_friction([&](const auto& part) __attribute__((always_inline)) {
            return part.found(was.phase, t, now, friction_states(x));
        })};
    }

    /// The mode that follows from one that `mode_at` has given, where that has ended already; writes the states that
    /// follow.
    [[nodiscard, gnu::always_inline]] Mode settled(Mode mode, const Touch<S>& t, std::span<S> x) const noexcept {
        if (!mode.loaded()) return mode;
        return {of_friction([&](const auto& part) __attribute__((always_inline)) {
            return part.settled(mode.phase, t, friction_states(x));
        })};
    }

    /// All that the contact does, in any mode but one that drags; writes the rates of the states. What depends on how
    /// fast the load changes takes it as constant.
    [[nodiscard, gnu::always_inline]] ContactResponse<S> evaluate(Mode mode, const Touch<S>& t, States x,
                                                                  std::span<S> rates) const noexcept {
        Response<S> r;
        answer(mode, t, x, rates, r);
        return gathered(mode, t, x, rates, r);
    }
    /// The same under a load that changes: `load_rate` is d(F_n / s^p)/dt.
    [[nodiscard]] ContactResponse<S> evaluate(Mode mode, const Touch<S>& t, States x, std::span<S> rates,
                                              const S& load_rate) const noexcept {
        Response<S> r;
        answer(mode, t, x, rates, r);
        if (r.asks_for_load_rate) complete(mode, t, x, load_rate, rates, r);
        return gathered(mode, t, x, rates, r);
    }

    /// The same from a depth z [m], its rate [m/s], the slip velocity V [m/s] and the bristle u [m], for laws that are
    /// known and have no other states; the mode is decided here.
    [[nodiscard, gnu::always_inline]] ContactResponse<S> evaluate(const S& depth, const S& depth_rate,
                                                                  const Vector2<S>& V,
                                                                  const Vector2<S>& u) const noexcept
        requires(!is_erased<Normal> && !is_erased<Friction>)
    {
        static_assert(NormalPart<Normal>::states() == 0 && FrictionPart<Friction>::states() <= 2);
        constexpr auto n = count(FrictionPart<Friction>::states());
        const States x(u.data(), n);
        Vector2<S> rates = Vector2<S>::Zero();
        const Touch<S> t{root_of_depth(depth), depth_rate, V};
        return evaluate(mode_at({}, t, x), t, x, std::span<S>(rates.data(), n));
    }

    // ---- guards --------------------------------------------------------------------------------------------------

    /// The guards in a mode; not for flight, nor for a contact that drags. `load_rate` matters where the law asks.
    [[gnu::always_inline]] void fill_guards(Mode mode, const Touch<S>& t, States x, const S& load_rate,
                                            std::span<S, guards> out) const noexcept {
        const S load = load_over_leading_power(t, x);
        out[depth_guard] = t.root_depth;
        out[load_guard] = mode.loaded() ? load : S(-load);
        out[clutch_guard] = mode.loaded() ? margin(mode.phase, t, x, load_rate) : S(1);
    }

    /// d(load guard of a loaded contact)/dt under a depth acceleration.
    [[nodiscard]] S load_guard_rate(const Touch<S>& t, States x, const S& depth_acceleration) const noexcept {
        return along_motion(t, x, depth_acceleration,
                            [](const auto& part, const auto& s, const auto& v, auto y) { return part.load(s, v, y); });
    }

    /// Whether a crossed guard may be crossed again at once, time and again, as part of the law.
    [[nodiscard]] bool quick(int guard) const noexcept {
        return guard == clutch_guard && of_friction([](const auto& part) { return part.quick; });
    }

    /// Whether a contact that holds is in Phase::stick.
    [[nodiscard]] bool knows_stick() const noexcept {
        return of_friction([](const auto& part) { return part.knows_stick; });
    }
    /// Whether the rates have a kink, inside a phase, where the slip velocity is zero.
    [[nodiscard]] bool has_kink_at_rest() const noexcept {
        return of_friction([](const auto& part) { return part.has_kink_at_rest; });
    }

    // ---- dragging ------------------------------------------------------------------------------------------------

    [[nodiscard]] bool may_drag() const noexcept {
        return of_friction([](const auto& part) { return part.may_drag(); });
    }
    /// The depth rate at which there is no load, near the one given [m/s].
    [[nodiscard]] S unloading_rate(const Touch<S>& t, States x) const noexcept {
        using D = Dual<S, 1>;
        const std::array<D, most_normal_states> y = constants<D>(x);
        const D load = with_law(normal, [&](const auto& law) {
            const auto over_dual = law_over<D>(law);
            return part_of(over_dual).load(D(t.root_depth), D::variable(t.depth_rate, 0), cut(y));
        });
        return load.gradient[0] > S(0) ? S(t.depth_rate - load.value / load.gradient[0]) : t.depth_rate;
    }

    // ---- jumps ---------------------------------------------------------------------------------------------------

    /// An impact begins: writes the states of a normal law that depends on how.
    void land(const Touch<S>& t, std::span<S> x) const noexcept {
        const S speed = t.depth_rate > S(0) ? t.depth_rate : S(0);
        of_normal([&](const auto& part) { part.land(speed, normal_states(x)); });
    }

    /// The contact begins in the ground, at the start of a run; after `land`.
    [[nodiscard]] Jump<S> start(const Touch<S>& t, std::span<S> x) const noexcept {
        Jump<S> j;
        j.mode.phase = phase_at(t, x, S(0));
        j.report(EventKind::touchdown);
        finish_loading(t, x, j);
        return j;
    }

    /// The sphere touches down at t, a little inside the ground. `later` is a root depth of a moment later [m^0.5]: at
    /// touchdown itself both sides of (26) may be zero.
    [[nodiscard]] Jump<S> touch_down(const Touch<S>& t, const S& later, std::span<S> x) const noexcept {
        land(t, x);
        Jump<S> j;
        j.taken[unpaid] -=
            of_friction([&](const auto& part) { return part.stiffen(t.root_depth, friction_states(x)); });
        load(t, later, x, j);
        return j;
    }

    /// A guard has reached zero; a loaded contact loses its load before its depth. `on_border`: with friction the
    /// contact would lift off, without it would press again.
    [[nodiscard]] Jump<S> cross(int guard, Mode mode, const Touch<S>& t, const S& later, bool on_border,
                                std::span<S> x) const noexcept {
        Jump<S> j{mode};
        if (guard == depth_guard) {
            if (normal_state_count() > 0) let_go(t, x, j);
            j.mode = {Phase::flight};
            of_friction([&](const auto& part) { part.part(friction_states(x)); });
            j.report(EventKind::recovered);
        } else if (mode.drags) {
            j.mode.drags = false;
            if (guard == load_guard) load(t, later, x, j);
        } else if (guard == load_guard) {
            if (mode.loaded())
                unload(t, x, j);
            else if (!on_border)
                load(t, later, x, j);
            j.mode.drags = on_border;
        } else {
            const Load<S> now = load_at(t, x);
            const FrictionChange<S> change =
                of_friction([&](const auto& part) { return part.cross(mode.phase, t, now, friction_states(x)); });
            j.mode.phase = change.phase;
            j.taken[by_clutch] += change.clutch;
            if (change.phase != mode.phase) j.report(change.phase == Phase::stick ? EventKind::stick : EventKind::slip);
        }
        return j;
    }

    /// What is prescribed for a contact that touches has jumped, at one depth: how it stands was `before` and is
    /// `after`, and with that its load or what moves it. `presses`: there is a load from here on. No force pays for
    /// what a jump of the load does to a spring in proportion to it.
    [[nodiscard]] Jump<S> kink(Mode mode, bool presses, const Touch<S>& before, const Touch<S>& after,
                               const S& depth_acceleration, std::span<S> x) const noexcept {
        Jump<S> j{mode};
        if (!mode.loaded()) {
            if (presses) load(after, after, S(0), x, j);
            return j;
        }
        const Mode next = presses ? mode : Mode{Phase::recovering};
        j.taken[unpaid] += held(mode, before, x).tangential_spring - held(next, after, x).tangential_spring;
        if (!presses) {
            unload(after, x, j);
            return j;
        }
        const Load<S> now = load_at(after, x);
        const S rate = load_rate(after, x, depth_acceleration);
        j.mode.phase =
            of_friction([&](const auto& part) { return part.again(mode.phase, after, now, rate, friction_states(x)); });
        if (j.mode.phase != mode.phase) j.report(j.mode.phase == Phase::stick ? EventKind::stick : EventKind::slip);
        if (j.mode.phase == Phase::slip)
            j.taken[by_clutch] +=
                of_friction([&](const auto& part) { return part.enter_slip(after, now, friction_states(x)); });
        return j;
    }

    /// The states after dt in flight, in closed form; returns what the tangential damper takes [J].
    [[nodiscard]] S relax(const S& dt, std::span<S> x) const noexcept {
        return of_friction([&](const auto& part) { return part.relax(dt, scale_at(S(0)), friction_states(x)); });
    }

    template <class T>
    [[nodiscard]] auto cast() const {
        using Other = footfall::Pair<decltype(law_over<T>(normal)), decltype(law_over<T>(friction))>;
        return Other(law_over<T>(normal), law_over<T>(friction), typename Other::Prepared{});
    }

private:
    template <class, class>
    friend class Pair;

    struct Prepared {};  // what the laws keep of their parameters they have already
    Pair(Normal n, Friction f, Prepared /*tag*/) : Parts(std::move(n), std::move(f)) {}
    template <class Law>
    [[nodiscard]] static Law prepared(Law law) {
        prepare_law(law);
        return law;
    }

    template <class Law>
    [[nodiscard]] static constexpr NormalPart<Law> part_of(const Law& law) noexcept {
        return {law};
    }
    [[nodiscard, gnu::always_inline]] NormalForce<S> normal_over_scale(const Touch<S>& t, States x) const noexcept {
        return of_normal([&](const auto& part) __attribute__((always_inline)) {
            return part.force(scale_power(), t.root_depth, t.depth_rate, normal_states(x));
        });
    }
    void put_normal_rates(const Touch<S>& t, States x, std::span<S> rates) const noexcept {
        of_normal(
            [&](const auto& part) { part.rates(t.root_depth, t.depth_rate, normal_states(x), normal_states(rates)); });
    }
    [[nodiscard]] S load_over_leading_power(const Touch<S>& t, States x) const noexcept {
        return of_normal([&](const auto& part) { return part.load(t.root_depth, t.depth_rate, normal_states(x)); });
    }
    [[nodiscard]] S margin(Phase phase, const Touch<S>& t, States x, const S& load_rate) const noexcept {
        const Load<S> load = load_at(t, x);
        return of_friction(
            [&](const auto& part) { return part.margin(phase, t, load, load_rate, friction_states(x)); });
    }
    /// In any mode but one that drags.
    [[gnu::always_inline]] void answer(Mode mode, const Touch<S>& t, States x, std::span<S> rates,
                                       Response<S>& r) const noexcept {
        if (mode.touches()) {
            respond(mode, t, x, rates, r);
        } else {
            fly(t, x, rates, r);
        }
    }
    /// In flight the bristle recovers.
    [[gnu::always_inline]] void fly(const Touch<S>& t, States x, std::span<S> rates, Response<S>& r) const noexcept {
        for (S& rate : rates.first(count(normal_state_count()))) rate = S(0);
        const std::span<S> own = rates.subspan(count(normal_state_count()));
        r = {};
        of_friction([&](const auto& part) { part.idle(t, scale_at(S(0)), friction_states(x), own, r); });
        r.power[unpaid] = S(0);  // there is no depth that could change
    }
    [[nodiscard, gnu::always_inline]] ContactResponse<S> gathered(Mode mode, const Touch<S>& t, States x,
                                                                  std::span<const S> rates,
                                                                  const Response<S>& r) const noexcept {
        const Held<S> h = held(mode, t, x);
        return {.phase = mode.phase,
                .normal_force = r.push.normal,
                .friction_force = r.push.friction,
                .bristle_rate = bristle(rates),  // linear in the states
                .normal_spring = h.normal_spring,
                .tangential_spring = h.tangential_spring,
                .normal_damper_power = r.power[by_normal_damper],
                .tangential_damper_power = r.power[by_tangential_damper],
                .clutch_power = r.power[by_clutch],
                .stiffness_change_power = r.power[unpaid]};
    }

    // Steps of the automaton ------------------------------------------------------------------------------------------

    /// The phase that the forces at t ask for, after a time dt of the slip.
    [[nodiscard]] Phase phase_at(const Touch<S>& t, States x, const S& dt) const noexcept {
        const Load<S> now = load_at(t, x);
        if (!(now.over_scale > S(0))) return Phase::recovering;
        return of_friction([&](const auto& part) { return part.first(t, now, friction_states(x), dt); });
    }

    /// The load begins, or comes back.
    void load(const Touch<S>& t, const S& later, std::span<S> x, Jump<S>& j) const noexcept {
        Touch<S> then = t;
        if (later > then.root_depth) then.root_depth = later;
        load(t, then, t.depth_rate > S(0) ? S(then.root_depth * then.root_depth / t.depth_rate) : S(0), x, j);
    }
    /// Stick or slip as at `then`, after a time dt of the slip.
    void load(const Touch<S>& t, const Touch<S>& then, const S& dt, std::span<S> x, Jump<S>& j) const noexcept {
        Phase phase = phase_at(then, x, dt);
        if (phase == Phase::recovering) phase = of_friction([](const auto& part) { return part.begin(); });
        j.mode.phase = phase;
        j.report(EventKind::touchdown);
        finish_loading(t, x, j);
    }

    void finish_loading(const Touch<S>& t, std::span<S> x, Jump<S>& j) const noexcept {
        if (j.mode.phase == Phase::stick) j.report(EventKind::stick);
        if (j.mode.phase != Phase::slip) return;
        const Load<S> now = load_at(t, x);
        j.taken[by_clutch] +=
            of_friction([&](const auto& part) { return part.enter_slip(t, now, friction_states(x)); });
    }

    /// What the states of the normal law still hold where the depth has ended is lost in the law itself.
    void let_go(const Touch<S>& t, States x, Jump<S>& j) const noexcept {
        j.taken[by_normal_damper] +=
            of_normal([&](const auto& part) { return part.stored_energy(t.root_depth, normal_states(x)); });
    }

    void unload(const Touch<S>& t, std::span<S> x, Jump<S>& j) const noexcept {
        j.taken[by_tangential_damper] +=
            of_friction([&](const auto& part) { return part.release(scale_at(t.root_depth), friction_states(x)); });
        j.mode.phase = Phase::recovering;
        j.report(EventKind::separation);
    }

    // Derivatives along the motion ------------------------------------------------------------------------------------

    template <class D>
    [[nodiscard]] std::array<D, most_normal_states> constants(States x) const noexcept {
        std::array<D, most_normal_states> y{};
        for (std::size_t k = 0; k < count(normal_state_count()); ++k) y[k] = D(x[k]);
        return y;
    }
    template <class D>
    [[nodiscard]] std::span<const D> cut(const std::array<D, most_normal_states>& y) const noexcept {
        return std::span<const D>(y).first(count(normal_state_count()));
    }

    /// d/dt of a function of s, zdot and the normal law's states, the law over dual numbers.
    template <class Quantity>
    [[nodiscard]] S along_motion(const Touch<S>& t, States x, const S& depth_acceleration,
                                 Quantity&& quantity) const noexcept {
        using D = Dual<S, 1>;
        std::array<D, most_normal_states> y = constants<D>(x);
        if (normal_state_count() > 0) {
            std::array<S, most_normal_states> rates{};
            put_normal_rates(t, x, rates);
            for (std::size_t k = 0; k < count(normal_state_count()); ++k) y[k].gradient[0] = rates[k];
        }
        const D s(t.root_depth, {t.depth_rate / (S(2) * t.root_depth)}), v(t.depth_rate, {depth_acceleration});
        return with_law(normal, [&](const auto& law) {
            const auto over_dual = law_over<D>(law);
            return quantity(part_of(over_dual), s, v, cut(y)).gradient[0];
        });
    }
};

/// visit(pair), where the types of both laws are known: for loops over many contacts.
template <class Normal, class Friction, class Visit>
void with_known_parts(const Pair<Normal, Friction>& pair, Visit&& visit) {
    with_law(pair.normal, [&](const auto& normal) {
        with_law(pair.friction, [&](const auto& friction) { visit(Pair(normal, friction)); });
    });
}

}  // namespace footfall
