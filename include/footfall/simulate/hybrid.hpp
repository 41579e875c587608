// A plant and contact laws in one state vector: the only file that knows both.
//
//   the plant's motion | the states of every contact's law | what follows of the plant | t | taken, for each contact
//   (4)
//   \------------------ the motion ----------------------/  \--------------- what follows from it -------------------/
//
// In the modes that the contacts are in, dy/dsigma is smooth. What stands behind the motion follows from it, so the
// methods integrate that part as plain integrals: no stage needs it, and no Jacobian.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include "footfall/eigen/interop.hpp"
#include "footfall/law/mode.hpp"
#include "footfall/law/push.hpp"
#include "footfall/law/touch.hpp"
#include "footfall/math/scalar.hpp"
#include "footfall/math/vector.hpp"

namespace footfall {

/// `Law` is a contact law (law/pair.hpp). `States` is how many states the laws of all contacts have together, where
/// that is known at compile time, as the number of contacts has to be then.
template <class Plant, class Law, int States = Eigen::Dynamic>
class Hybrid {
public:
    using S = typename Law::value_type;
    using PlantType = Plant;
    using LawType = Law;

    static constexpr int contacts_at_compile_time = Plant::contacts_at_compile_time;
    static constexpr bool fixed = contacts_at_compile_time != Eigen::Dynamic && States != Eigen::Dynamic;
    static constexpr int motion_at_compile_time = fixed ? Plant::motion_at_compile_time + States : Eigen::Dynamic;
    /// Of what each contact has taken: all, or none where the plant says that it keeps no account.
    static constexpr int kept_channels = [] {
        if constexpr (requires { requires !Plant::keeps_account; }) return 0;
        return static_cast<int>(taken_channels);
    }();
    static constexpr int size_at_compile_time =
        fixed ? motion_at_compile_time + Plant::follows + 1 + kept_channels * contacts_at_compile_time : Eigen::Dynamic;
    static constexpr int guards_per_contact = Law::guards;
    static constexpr int guards_at_compile_time =
        fixed ? guards_per_contact * contacts_at_compile_time : Eigen::Dynamic;

    using State = Eigen::Array<S, size_at_compile_time, 1>;
    using Guards = Eigen::Array<S, guards_at_compile_time, 1>;
    using Motion = typename Plant::Motion;

    /// One law for each contact of the plant.
    Hybrid(Plant plant, std::vector<Law> laws) : plant_(std::move(plant)), laws_(std::move(laws)) {
        first_state_.push_back(plant_.motion_size());
        for (const Law& law : laws_) first_state_.push_back(first_state_.back() + law.states());
        if constexpr (!fixed) {
            modes_.resize(laws_.size());
            scratch_.resize(laws_.size());
        }
    }

    [[nodiscard]] const Plant& plant() const noexcept { return plant_; }
    [[nodiscard]] const Law& law(int i) const noexcept { return laws_[index(i)]; }
    [[nodiscard]] constexpr int contacts() const noexcept {
        return contacts_at_compile_time == Eigen::Dynamic ? static_cast<int>(laws_.size()) : contacts_at_compile_time;
    }
    [[nodiscard]] Mode mode(int i) const noexcept { return modes_[index(i)]; }
    void set_mode(int i, Mode mode) noexcept { modes_[index(i)] = mode; }
    template <class Other>
    void take_modes(const Other& other) noexcept {
        for (int i = 0; i < contacts(); ++i) set_mode(i, other.mode(i));
    }
    [[nodiscard]] bool touches(int i) const noexcept { return mode(i).touches(); }
    [[nodiscard]] bool in_flight() const noexcept {
        for (const Mode& m : modes_)
            if (m.touches()) return false;
        return true;
    }

    // ---- the state -------------------------------------------------------------------------------------------------

    [[nodiscard]] constexpr int motion_size() const noexcept {
        return fixed ? motion_at_compile_time : first_state_.back();
    }
    /// Where the plant's own part of what follows begins.
    [[nodiscard]] constexpr int follow() const noexcept { return motion_size(); }
    [[nodiscard]] constexpr int clock() const noexcept {
        if constexpr (Plant::follows == Eigen::Dynamic) {
            return follow() + plant_.follow_size();
        } else {
            return follow() + Plant::follows;
        }
    }
    /// Where what contact i has taken begins.
    [[nodiscard]] constexpr int taken(int i) const noexcept { return clock() + 1 + kept_channels * i; }
    [[nodiscard]] constexpr int size() const noexcept { return taken(contacts()); }

    /// The states of the law of contact i, and where they begin.
    [[nodiscard]] constexpr int first_state(int i) const noexcept {
        return single ? Plant::motion_at_compile_time : first_state_[index(i)];
    }
    [[nodiscard]] constexpr std::size_t state_count(int i) const noexcept {
        return index(single ? States : first_state_[index(i) + 1] - first_state_[index(i)]);
    }
    [[nodiscard]] std::span<const S> states(const State& y, int i) const noexcept {
        return {y.data() + first_state(i), state_count(i)};
    }
    [[nodiscard]] std::span<S> states(State& y, int i) const noexcept {
        return {y.data() + first_state(i), state_count(i)};
    }
    void book(State& y, int i, const Taken<S>& energy) const noexcept {
        for (int k = 0; k < kept_channels; ++k) y[taken(i) + k] += energy[index(k)];
    }

    // ---- the equations
    // -----------------------------------------------------------------------------------------------

    /// One contact at one moment.
    struct Contact {
        Touch<S> touch;
        Response<S> response;
        S load_rate = S(0);  ///< d(F_n / s^p)/dt, where the law asks for it
        S share = S(0);      ///< of the friction in slip, where the contact drags
    };

    /// dy/dsigma and, where `guards` is given, every guard.
    void evaluate(const State& y, State& rate, Guards* guards = nullptr) const noexcept {
        if constexpr (fixed) {
            std::array<Contact, index(contacts_at_compile_time)> contacts;
            evaluate_with(contacts, y, rate, guards);
        } else {
            evaluate_with(scratch_, y, rate, guards);
        }
    }

    /// All contacts at y. Those in flight have their touch alone.
    [[nodiscard]] std::vector<Contact> contacts_at(const State& y) const {
        std::vector<Contact> all(index(contacts()));
        act(all, y, plant_.motion(y));
        return all;
    }

    /// Contact i at y.
    [[nodiscard]] Touch<S> touch(const State& y, int i) const noexcept { return plant_.touch(y, plant_.motion(y), i); }

    /// d(zdot)/dt of every contact at y.
    [[nodiscard]] std::vector<S> depth_accelerations(const State& y) const {
        std::vector<Contact> all(index(contacts()));
        const Motion m = plant_.motion(y);
        const Action total = act(all, y, m);
        std::vector<S> accelerations;
        for (int i = 0; i < contacts(); ++i) accelerations.push_back(plant_.depth_acceleration(m, total, i));
        return accelerations;
    }

    /// d(load guard)/dt of contact i at y, were it in another mode.
    [[nodiscard]] S load_guard_rate(const State& y, int i, Mode mode) {
        const Mode kept = this->mode(i);
        set_mode(i, mode);
        std::vector<Contact> all(index(contacts()));
        const Motion m = plant_.motion(y);
        const Action total = act(all, y, m);
        set_mode(i, kept);
        return law(i).load_guard_rate(all[index(i)].touch, states(y, i), plant_.depth_acceleration(m, total, i));
    }

    /// g = dt/dsigma.
    [[nodiscard, gnu::always_inline]] S time_rate(const State& y) const noexcept {
        return plant_.time_rate(y, [this](int i) { return counts(i); });
    }

    /// What contact i holds at y [J].
    [[nodiscard]] Held<S> held(const State& y, const Touch<S>& t, int i) const noexcept {
        return law(i).held(mode(i), t, states(y, i));
    }

    template <class T>
    [[nodiscard]] auto cast() const {
        std::vector<decltype(std::declval<Law>().template cast<T>())> laws;
        laws.reserve(laws_.size());
        for (const Law& l : laws_) laws.push_back(l.template cast<T>());
        using CastPlant = decltype(plant_.template cast<T>());
        Hybrid<CastPlant, typename decltype(laws)::value_type, States> other(plant_.template cast<T>(),
                                                                             std::move(laws));
        other.take_modes(*this);
        return other;
    }

private:
    using Action = typename Plant::Action;
    static constexpr bool single = fixed && contacts_at_compile_time == 1;
    static constexpr std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }
    template <class T>
    using PerContact =
        std::conditional_t<fixed, std::array<T, static_cast<std::size_t>(fixed ? contacts_at_compile_time : 0)>,
                           std::vector<T>>;

    /// Contact i takes part in the scale of time.
    [[nodiscard]] bool counts(int i) const noexcept { return touches(i) && !mode(i).drags; }

    /// The rates of the laws' states over time: a few numbers where their count is fixed, else in place, in dy/dsigma.
    using FewRates = std::array<S, index(std::max(States, 0))>;  // Eigen::Dynamic is below zero
    [[nodiscard]] std::span<S> rates_of(FewRates& few, int i) const noexcept {
        return std::span<S>(few).subspan(index(first_state(i) - first_state(0)), state_count(i));
    }
    [[nodiscard]] std::span<S> rates_of(State& rate, int i) const noexcept { return states(rate, i); }

    template <class Contacts>
    [[gnu::always_inline]] void evaluate_with(Contacts& contacts, const State& y, State& rate,
                                              Guards* guards) const noexcept {
        const Motion m = plant_.motion(y);
        const S g = time_rate(y);
        Action total;
        if constexpr (fixed) {
            FewRates few;
            total = act(contacts, y, m, few);
            for (int i = 0; i < this->contacts(); ++i) {
                const std::span<S> own = rates_of(few, i);
                for (std::size_t k = 0; k < own.size(); ++k)
                    rate[first_state(i) + static_cast<int>(k)] = touches(i) ? S(own[k] * g) : S(0);
            }
        } else {
            total = act(contacts, y, m, rate);
            for (int i = 0; i < this->contacts(); ++i)
                for (S& r : states(rate, i)) r = touches(i) ? S(r * g) : S(0);
        }
        plant_.rates(y, m, total, g, follow(), rate);
        rate[clock()] = g;
        each_contact([&](int i) __attribute__((always_inline)) { contact_rates(contacts[index(i)], y, i, g, rate); });
        if (guards) fill_guards(contacts, y, m, *guards);
    }

    /// f(i) for every contact. Where their count is known no loop runs, so that what is kept of them needs no memory.
    template <class F>
    [[gnu::always_inline]] void each_contact(F&& f) const noexcept {
        if constexpr (fixed) {
            unrolled<contacts_at_compile_time>(f);
        } else {
            for (int i = 0; i < contacts(); ++i) f(i);
        }
    }

    /// What every contact does, and what that adds up to. Writes the rates of the laws' states over time.
    template <class Contacts, class Rates>
    [[gnu::always_inline]] Action act(Contacts& contacts, const State& y, const Motion& m,
                                      Rates& rates) const noexcept {
        Action total = no_action();
        bool special = false;  // some contact asks for its load's rate, or drags
        each_contact([&](int i) __attribute__((always_inline)) {
            special = respond_one(contacts, y, m, rates, i, total) || special;
        });
        if (special) [[unlikely]] {
            if constexpr (fixed) {  // on copies: what has an address stays in memory
                Contacts copies = contacts;
                Rates own = rates;
                total = second_round(copies, y, m, total, own);
                contacts = copies;
                rates = own;
            } else {
                total = second_round(contacts, y, m, total, rates);
            }
        }
        return total;
    }
    [[nodiscard, gnu::always_inline]] Action no_action() const noexcept {
        if constexpr (requires { plant_.no_action(); }) {
            return plant_.no_action();
        } else {
            return {};
        }
    }
    /// What contact i does; whether that waits for a second round.
    template <class Contacts, class Rates>
    [[gnu::always_inline]] bool respond_one(Contacts& contacts, const State& y, const Motion& m, Rates& rates, int i,
                                            Action& total) const noexcept {
        Contact& c = contacts[index(i)];
        c.touch = plant_.touch(y, m, i);
        if (!touches(i)) return false;
        // The depth of a contact that drags follows from F_n = 0, not from the body's velocity, whose rounding would be
        // all that is left of it.
        if (mode(i).drags) [[unlikely]]
            c.touch.depth_rate = law(i).unloading_rate(c.touch, states(y, i));
        law(i).respond(mode(i), c.touch, states(y, i), rates_of(rates, i), c.response);
        plant_.push(total, m, i, c.response.push);
        return c.response.asks_for_load_rate || mode(i).drags;
    }
    /// The same where nobody wants the rates.
    Action act(std::vector<Contact>& contacts, const State& y, const Motion& m) const {
        State rate(y.size());
        return act(contacts, y, m, rate);
    }

    template <class Contacts, class Rates>
    [[gnu::noinline]] Action second_round(Contacts& contacts, const State& y, const Motion& m, Action total,
                                          Rates& rates) const noexcept {
        bool drag = false;
        for (int i = 0; i < this->contacts(); ++i) drag = drag || mode(i).drags;
        if (drag) drag_along(contacts, y, m, total, rates);
        complete(contacts, y, m, total, rates);
        return total;
    }

    template <class Contacts, class Rates>
    void complete(Contacts& contacts, const State& y, const Motion& m, const Action& total,
                  Rates& rates) const noexcept {
        for (int i = 0; i < this->contacts(); ++i) {
            Contact& c = contacts[index(i)];
            if (!mode(i).loaded() || !c.response.asks_for_load_rate) continue;
            c.load_rate = law(i).load_rate(c.touch, states(y, i), plant_.depth_acceleration(m, total, i));
            law(i).complete(mode(i), c.touch, states(y, i), c.load_rate, rates_of(rates, i), c.response);
        }
    }

    /// The shares of the friction in slip that keep the loads of all contacts that drag at zero: the loads' rates are
    /// linear in the shares. Every power is as well, so the ledger closes.
    template <class Contacts, class Rates>
    void drag_along(Contacts& contacts, const State& y, const Motion& m, Action& total, Rates& rates) const noexcept {
        std::vector<int> dragging;
        std::vector<Response<S>> slipping;
        Rates slipping_rates = rates;
        for (int i = 0; i < this->contacts(); ++i) {
            if (!mode(i).drags) continue;
            dragging.push_back(i);
            law(i).respond({Phase::slip}, contacts[index(i)].touch, states(y, i), rates_of(slipping_rates, i),
                           slipping.emplace_back());
        }
        const auto n = static_cast<Eigen::Index>(dragging.size());
        Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> effect(n, n);
        Eigen::Matrix<S, Eigen::Dynamic, 1> without(n);
        for (Eigen::Index a = 0; a < n; ++a) {
            const int i = dragging[static_cast<std::size_t>(a)];
            const auto guard_rate = [&](const S& acceleration) {
                return law(i).load_guard_rate(contacts[index(i)].touch, states(y, i), acceleration);
            };
            const S acceleration = plant_.depth_acceleration(m, total, i);
            without[a] = guard_rate(acceleration);
            for (Eigen::Index b = 0; b < n; ++b) {
                const auto at = static_cast<std::size_t>(b);
                const S response = plant_.depth_response(m, i, dragging[at], slipping[at].push);
                effect(a, b) = guard_rate(S(acceleration + response)) - without[a];
            }
        }
        const Eigen::Matrix<S, Eigen::Dynamic, 1> shares = effect.partialPivLu().solve(-without);
        for (Eigen::Index a = 0; a < n; ++a) {
            const auto at = static_cast<std::size_t>(a);
            const int i = dragging[at];
            Contact& c = contacts[index(i)];
            c.share = shares[a];
            const auto mix = [&](auto& of, const auto& with) { of += c.share * (with - of); };
            mix(c.response.push.normal, slipping[at].push.normal);
            c.response.push.friction = c.share * slipping[at].push.friction;
            for (std::size_t k = 0; k < c.response.power.size(); ++k) mix(c.response.power[k], slipping[at].power[k]);
            const std::span<S> free = rates_of(rates, i), slips = rates_of(slipping_rates, i);
            for (std::size_t k = 0; k < free.size(); ++k) mix(free[k], slips[k]);
            plant_.push(total, m, i, c.response.push);
        }
    }

    [[gnu::always_inline]] void contact_rates(const Contact& c, const State& y, int i, const S& g,
                                              State& rate) const noexcept {
        if (!touches(i)) {
            // s stays 0. What the states do in flight is known in closed form (relax).
            plant_.root_depth_rate(y, i, S(0), g, true, rate);
            unrolled<kept_channels>([&](int k) { rate[taken(i) + k] = S(0); });
            return;
        }
        plant_.root_depth_rate(y, i, c.touch.depth_rate, g, contacts_at_compile_time == 1 && !mode(i).drags, rate);
        unrolled<kept_channels>([&](int k) { rate[taken(i) + k] = c.response.power[index(k)] * g; });
    }

    template <class Contacts>
    [[gnu::always_inline]] void fill_guards(const Contacts& contacts, const State& y, const Motion& m,
                                            Guards& guards) const noexcept {
        each_contact([&](int i) __attribute__((always_inline)) {
            const Contact& c = contacts[index(i)];
            const std::span<S, guards_per_contact> own(&guards[guards_per_contact * i], guards_per_contact);
            if (!touches(i)) {
                for (S& guard : own) guard = S(1);
                own[Law::load_guard] = -plant_.geometric_depth(y, m, follow(), i);
            } else if (mode(i).drags) {  // to slip, to no friction, to flight
                own[Law::load_guard] = S(1) - c.share;
                own[Law::clutch_guard] = c.share;
                own[Law::depth_guard] = c.touch.root_depth;
            } else {
                law(i).fill_guards(mode(i), c.touch, states(y, i), c.load_rate, own);
            }
        });
    }

    Plant plant_;
    std::vector<Law> laws_;
    std::vector<int> first_state_;  // of each contact, and where the motion ends
    PerContact<Mode> modes_{};
    mutable PerContact<Contact> scratch_{};
};

}  // namespace footfall
