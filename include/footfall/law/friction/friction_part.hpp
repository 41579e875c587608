// What a contact law asks of its friction part, for every kind of friction law:
//   none        NoFriction
//   a clutch    SpringDamperClutch: its states are the bristle u
//   over load   RateFriction: states of its own, a force in proportion to the load
//   coupled     CoupledFriction: over the load as well, but it sees spin, rolling and the size of the contact, and may
//               give torques
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "footfall/law/friction/none.hpp"
#include "footfall/law/friction/rate_friction.hpp"
#include "footfall/law/friction/spring_damper_clutch.hpp"
#include "footfall/law/phase.hpp"
#include "footfall/law/push.hpp"
#include "footfall/law/touch.hpp"
#include "footfall/math/value_of.hpp"

namespace footfall {

/// The load as friction sees it: F_n and s^p, the scale that friction is computed over.
template <class S>
struct Load {
    S scale;       ///< s^p
    S over_scale;  ///< phi_n = F_n / s^p

    [[nodiscard]] S force() const noexcept { return scale * over_scale; }
};

/// What follows where a phase of friction ends: the next one, and what the clutch takes at once [J].
template <class S>
struct FrictionChange {
    Phase phase;
    S clutch = S(0);
};

template <class Law>
struct FrictionPart;

/// No friction.
template <class S>
struct FrictionPart<NoFriction<S>> {
    using States = std::span<const S>;
    const NoFriction<S>& law;

    static constexpr int scale_power = 0;
    [[nodiscard]] static constexpr int states() noexcept { return 0; }
    /// The numbers that a caller keeps for a bristle, of which the states are the first. Nothing depends on these two.
    static constexpr int bristle_size = 2;
    /// Whether a crossed margin may be followed by the next at once.
    static constexpr bool quick = false;
    /// Whether the size of the states is that of the largest seen.
    static constexpr bool sized_by_what_is_seen = false;

    /// Whether a contact that holds is in Phase::stick.
    static constexpr bool knows_stick = false;
    /// Whether the rates have a kink, inside a phase, where the slip velocity is zero.
    static constexpr bool has_kink_at_rest = false;

    [[nodiscard]] double state_size(int, const S&, const S&) const noexcept { return 1; }
    /// How long the states lag behind where they slip at the root depth s, where that alone tells slip from stick [s].
    [[nodiscard]] static double slip_lag(const S&) noexcept { return 0; }
    [[nodiscard]] static Vector2<S> bristle(States) noexcept { return Vector2<S>::Zero(); }
    [[nodiscard]] static bool may_drag() noexcept { return false; }
    /// Each adds its part to what a contact does, and writes the rates of its states: under a load, what waits for how
    /// fast that changes, and without one.
    static void respond(Phase, const Touch<S>&, const Load<S>&, States, std::span<S>, Response<S>&) noexcept {}
    static void complete(Phase, const Touch<S>&, const Load<S>&, const S&, States, std::span<S>,
                         Response<S>&) noexcept {}
    static void idle(const Touch<S>&, const S&, States, std::span<S>, Response<S>&) noexcept {}
    [[nodiscard]] static S relax(const S&, const S&, std::span<S>) noexcept { return S(0); }
    [[nodiscard]] static S stored(Phase, const Load<S>&, States) noexcept { return S(0); }
    [[nodiscard]] static Phase first(const Touch<S>&, const Load<S>&, States, const S&) noexcept { return Phase::slip; }
    [[nodiscard]] static Phase begin() noexcept { return Phase::slip; }
    [[nodiscard]] static Phase again(Phase phase, const Touch<S>&, const Load<S>&, const S&, States) noexcept {
        return phase;
    }
    /// The phase of a contact under load that is found in these states and was in that phase.
    [[nodiscard]] static Phase found(Phase, const Touch<S>&, const Load<S>&, States) noexcept { return Phase::slip; }
    /// The phase that follows where the one that was found has ended already; writes the states that follow.
    [[nodiscard]] static Phase settled(Phase phase, const Touch<S>&, std::span<S>) noexcept { return phase; }
    [[nodiscard]] static S margin(Phase, const Touch<S>&, const Load<S>&, const S&, States) noexcept { return S(1); }
    [[nodiscard]] static FrictionChange<S> cross(Phase phase, const Touch<S>&, const Load<S>&, std::span<S>) noexcept {
        return {phase};
    }
    [[nodiscard]] static S enter_slip(const Touch<S>&, const Load<S>&, std::span<S>) noexcept { return S(0); }
    [[nodiscard]] static S release(const S&, std::span<S>) noexcept { return S(0); }
    [[nodiscard]] static S stiffen(const S&, States) noexcept { return S(0); }
    /// The depth is zero: writes the states of a sphere in flight.
    static void part(std::span<S>) noexcept {}
    /// Writes the states after dt in which the depth alone has changed, as its rate says.
    static void deepen(const Touch<S>&, const S&, std::span<S>) noexcept {}
};

template <class Law>
concept ClutchFriction = requires { requires Law::has_bristle; };

/// A bristle in series with a clutch.
template <ClutchFriction Law>
struct FrictionPart<Law> {
    using S = typename Law::value_type;
    using States = std::span<const S>;
    const Law& law;

    static constexpr int scale_power = Law::ScalePower;
    [[nodiscard]] static constexpr int states() noexcept { return 2; }
    static constexpr int bristle_size = 2;
    static constexpr bool quick = false;
    static constexpr bool sized_by_what_is_seen = true;
    static constexpr bool knows_stick = true;
    static constexpr bool has_kink_at_rest = false;

    /// A part of the deflection that friction begins to slip at, at the root depth s under the elastic force.
    [[nodiscard]] double state_size(int, const S& s, const S& elastic) const noexcept {
        const double depth = static_cast<double>(value_of(s * s));
        const double cone = static_cast<double>(value_of(law.coefficient * elastic / (law.stiffness * law.scale(s))));
        const double size = 1e-2 * depth;
        return cone > 0 ? std::min(size, 1e-1 * cone) : size;
    }
    /// By this time times the clutch's speed the bristle is short of its cone.
    [[nodiscard]] double slip_lag(const S& s) const noexcept {
        return static_cast<double>(value_of((law.damping + law.viscous / law.scale(s)) / law.stiffness));
    }
    [[nodiscard]] static Vector2<S> bristle(States x) noexcept { return vector_at<S>(x); }
    /// A viscous clutch loses its hold at F_n = 0, so that friction jumps there.
    [[nodiscard]] bool may_drag() const noexcept { return law.viscous > S(0) && law.damping > S(0); }

    [[gnu::always_inline]] void respond(Phase phase, const Touch<S>& t, const Load<S>& load, States x,
                                        std::span<S> rates, Response<S>& r) const noexcept {
        respond(phase, t, load, S(0), x, rates, r);
    }
    void complete(Phase phase, const Touch<S>& t, const Load<S>& load, const S& load_rate, States x, std::span<S> rates,
                  Response<S>& r) const noexcept {
        respond(phase, t, load, load_rate, x, rates, r);
    }

    /// With no force on it the bristle recovers; one without damping has no memory of its own. (31) with F_f = 0.
    void idle(const Touch<S>& t, const S& scale, States x, std::span<S> rates, Response<S>& r) const noexcept {
        const Vector2<S> u = bristle(x);
        const Vector2<S> u_rate = (law.damping > S(0) ? S(-law.recovery_rate()) : S(0)) * u;
        if constexpr (Law::joins_unstrained) {
            put_vector(rates, 0, u_rate + law.joining_rate(t.root_depth, t.depth_rate, u));
        } else {
            put_vector(rates, 0, u_rate);
        }
        r.power[by_tangential_damper] = scale * law.damping * u_rate.squaredNorm();  // (28)
        r.power[unpaid] = -law.stiffening_power(t.root_depth, t.depth_rate, u);
    }

    /// In flight udot = -(K_t/D_t) u, whose solution needs no method. Where the spring has a stiffness at z = 0, as the
    /// linear one does, its damper takes what it held. (28), (31)
    [[nodiscard]] S relax(const S& dt, const S& scale, std::span<S> x) const noexcept {
        using std::exp;
        if (!(law.damping > S(0))) return S(0);
        const Vector2<S> before = bristle(x);
        const Vector2<S> after = before * S(exp(-law.recovery_rate() * dt));
        put_vector(x, 0, after);
        return law.stored_energy(scale, before) - law.stored_energy(scale, after);
    }

    [[nodiscard]] S stored(Phase, const Load<S>& load, States x) const noexcept {
        return law.stored_energy(load.scale, bristle(x));
    }

    /// Stick or slip, by the force that V makes in dt. (26)
    [[nodiscard]] Phase first(const Touch<S>& t, const Load<S>& load, States x, const S& dt) const noexcept {
        Vector2<S> u = bristle(x);
        if constexpr (Law::joins_unstrained) {
            u = law.stretched(u, t.slip, dt);
        } else {
            u = u + t.slip * dt;
        }
        return law.holds(load.over_scale, t.slip, u) ? Phase::stick : Phase::slip;
    }
    [[nodiscard]] static Phase begin() noexcept { return Phase::slip; }
    /// The forces say it. (26)
    [[nodiscard, gnu::always_inline]] Phase found(Phase, const Touch<S>& t, const Load<S>& load,
                                                  States x) const noexcept {
        return law.holds(load.over_scale, t.slip, bristle(x)) ? Phase::stick : Phase::slip;
    }
    [[nodiscard]] static Phase settled(Phase phase, const Touch<S>&, std::span<S>) noexcept { return phase; }

    /// Stick or slip where what acts on a contact in a phase has jumped. On its cone, to rounding, a bristle without
    /// damping says nothing: whether its clutch goes on does.
    [[nodiscard]] Phase again(Phase phase, const Touch<S>& t, const Load<S>& load, const S& load_rate,
                              States x) const noexcept {
        using std::abs;
        constexpr double rounding = 1e-9;
        const S to_cone = law.cone_margin(load.over_scale, t.slip, bristle(x));
        if (phase == Phase::slip && law.plastic() &&
            abs(value_of(to_cone)) < rounding * value_of(law.coefficient * load.over_scale))
            return margin(phase, t, load, load_rate, x) > S(0) ? Phase::slip : Phase::stick;
        return load.over_scale > S(0) ? first(t, load, x, S(0)) : Phase::slip;
    }

    [[nodiscard]] S margin(Phase phase, const Touch<S>& t, const Load<S>& load, const S& load_rate,
                           States x) const noexcept {
        const Vector2<S> u = bristle(x);
        return phase == Phase::stick
                   ? law.cone_margin(load.over_scale, t.slip, u)
                   : law.slip_margin(load.scale, load.over_scale, load_rate, stretching_velocity(t, u), u);
    }

    [[nodiscard]] FrictionChange<S> cross(Phase phase, const Touch<S>& t, const Load<S>& load,
                                          std::span<S> x) const noexcept {
        if (phase != Phase::stick) return {Phase::stick};
        return {Phase::slip, enter_slip(t, load, x)};
    }

    /// A bristle that nothing damps is on the cone while it slips: one that was beyond it springs back through the
    /// clutch, which takes what is returned.
    [[nodiscard]] S enter_slip(const Touch<S>& t, const Load<S>& load, std::span<S> x) const noexcept {
        if (!law.plastic()) return S(0);
        const Vector2<S> before = bristle(x);
        const Vector2<S> after = law.enter_slip(load.over_scale, t.slip, before);
        put_vector(x, 0, after);
        return law.stored_energy(load.scale, before) - law.stored_energy(load.scale, after);
    }

    /// The load has gone. Without damping a bristle that nothing holds is back at once; what it stored goes where a
    /// damper, however weak, would have taken it.
    [[nodiscard]] S release(const S& scale, std::span<S> x) const noexcept {
        if (law.damping > S(0)) return S(0);
        const S stored = law.stored_energy(scale, bristle(x));
        put_vector(x, 0, Vector2<S>(Vector2<S>::Zero()));
        return stored;
    }

    /// What a bristle that has not recovered holds as the stiffness rises from zero to what it is at s.
    [[nodiscard]] S stiffen(const S& s, States x) const noexcept {
        return scale_power > 0 ? law.stored_energy(law.scale(s), bristle(x)) : S(0);
    }
    /// With no depth there is no ground that could keep a stretch for the next contact.
    static void part([[maybe_unused]] std::span<S> x) noexcept {
        if constexpr (Law::joins_unstrained) put_vector(x, 0, Vector2<S>(Vector2<S>::Zero()));
    }
    void deepen([[maybe_unused]] const Touch<S>& t, [[maybe_unused]] const S& dt,
                [[maybe_unused]] std::span<S> x) const noexcept {
        if constexpr (Law::joins_unstrained) put_vector(x, 0, law.joined(t.root_depth, t.depth_rate, dt, bristle(x)));
    }

private:
    /// What a bristle that slips is stretched by, less its clutch: one that nothing damps stays on its cone, so what
    /// the growing patch slackens its clutch does not have to.
    [[nodiscard, gnu::always_inline]] Vector2<S> stretching_velocity(
        const Touch<S>& t, [[maybe_unused]] const Vector2<S>& u) const noexcept {
        if constexpr (Law::joins_unstrained) {
            if (law.plastic()) return t.slip + law.joining_rate(t.root_depth, t.depth_rate, u);
        }
        return t.slip;
    }
    [[gnu::always_inline]] void respond(Phase phase, const Touch<S>& t, const Load<S>& load, const S& load_rate,
                                        States x, std::span<S> rates, Response<S>& r) const noexcept {
        const Vector2<S> u = bristle(x);
        if constexpr (Law::joins_unstrained) {
            respond_joining(phase, t, load, load_rate, u, rates, r);
        } else if (phase == Phase::stick) {
            put(law.stick(t.slip, u), load, rates, r);
        } else {
            put(law.slip(load.scale, load.over_scale, load_rate, t.slip, u), load, rates, r);
        }
        r.power[unpaid] = -law.stiffening_power(t.root_depth, t.depth_rate, u);
        // Without D_t and C_V the clutch's velocity depends on how fast its load changes.
        r.asks_for_load_rate = phase == Phase::slip && law.plastic();
    }
    /// Out of line: what every law computes stays as short as it is.
    [[gnu::noinline]] void respond_joining(Phase phase, const Touch<S>& t, const Load<S>& load, const S& load_rate,
                                           const Vector2<S>& u, std::span<S> rates, Response<S>& r) const noexcept {
        const bool stick = phase == Phase::stick;
        put(stick ? law.stick(t.slip, u)
                  : law.slip(load.scale, load.over_scale, load_rate, stretching_velocity(t, u), u),
            load, rates, r);
        // For a bristle that slips and that nothing damps, the velocity that was put in says all of its rate.
        if (stick || !law.plastic())
            put_vector(rates, 0, vector_at<S>(rates) + law.joining_rate(t.root_depth, t.depth_rate, u));
    }
    [[gnu::always_inline]] void put(const FrictionResponse<S>& f, const Load<S>& load, std::span<S> rates,
                                    Response<S>& r) const noexcept {
        put_vector(rates, 0, f.bristle_rate);
        r.push.friction = load.scale * f.force;
        r.power[by_tangential_damper] = load.scale * law.damping * f.bristle_rate.squaredNorm();  // (28)
        r.power[by_clutch] = -r.push.friction.dot(f.clutch_velocity);                             // (29), (30)
    }
};

/// A friction law over the load, with spin, rolling and size of the contact before it:
///   respond(touch, x, xdot)   a CoupledResponse; writes the rates
///   stored(x), state_size(i)  as of a RateFriction
template <class S>
struct CoupledResponse : RateResponse<S> {
    S spin_arm = S(0);                            ///< torque about the normal over F_n [m]
    Vector2<S> rolling_arm = Vector2<S>::Zero();  ///< torque in the plane over F_n [m]
};
template <class F, class S = typename F::value_type>
concept CoupledFriction = requires(const F law, const Touch<S>& t, FrictionStates<S> x, std::span<S> rate) {
    { F::states } -> std::convertible_to<int>;
    { law.respond(t, x, rate) } -> std::same_as<CoupledResponse<S>>;
    { law.stored(x) } -> std::same_as<S>;
    { law.state_size(0) } -> std::same_as<double>;
};

/// A law with a force in proportion to the load.
template <class Law>
    requires(RateFriction<Law> || CoupledFriction<Law>)
struct FrictionPart<Law> {
    using S = typename Law::value_type;
    using States = std::span<const S>;
    const Law& law;

    static constexpr int scale_power = 0;
    [[nodiscard]] static constexpr int states() noexcept { return Law::states; }
    static constexpr int bristle_size = Law::states;
    static constexpr bool quick = true;  // bonds may snap in quick succession
    static constexpr bool sized_by_what_is_seen = false;
    static constexpr bool knows_stick = [] {
        if constexpr (JumpingRateFriction<Law>) return Law::first_phase == Phase::stick;
        return false;
    }();
    static constexpr bool has_kink_at_rest = !JumpingRateFriction<Law> && Law::states > 0;  // |V|

    [[nodiscard]] double state_size(int i, const S&, const S&) const noexcept { return law.state_size(i); }
    [[nodiscard]] static double slip_lag(const S&) noexcept { return 0; }
    /// The deflection to show a person [m].
    [[nodiscard]] Vector2<S> bristle(States x) const noexcept {
        if constexpr (requires { law.bristle(x); }) {
            return law.bristle(x);
        } else if constexpr (Law::states >= 2) {
            return vector_at<S>(x);
        } else {
            return Vector2<S>::Zero();
        }
    }
    [[nodiscard]] static bool may_drag() noexcept { return false; }

    [[gnu::always_inline]] void respond(Phase phase, const Touch<S>& t, const Load<S>& load, States x,
                                        std::span<S> rates, Response<S>& r) const noexcept {
        const S F_n = load.force();
        const auto book = [&](const RateResponse<S>& f, const S& torques_power) {
            r.push.friction = F_n * f.traction;
            r.power[by_tangential_damper] = F_n * f.damper_power;
            r.power[by_clutch] = F_n * (-f.traction.dot(t.slip) - torques_power - f.stored_rate - f.damper_power);
        };
        if constexpr (CoupledFriction<Law>) {
            const CoupledResponse<S> f = law.respond(t, x, rates);
            book(f, f.spin_arm * t.spin + f.rolling_arm.dot(t.rolling));
            r.push.spin_torque = F_n * f.spin_arm;
            r.push.rolling_torque = F_n * f.rolling_arm;
        } else if constexpr (JumpingRateFriction<Law>) {
            book(law.respond(phase, t.slip, x, rates), S(0));
        } else {
            book(law.respond(t.slip, x, rates), S(0));
        }
        // What is stored is in proportion to the load, and no force pays for its change.
        if constexpr (Law::states > 0) r.asks_for_load_rate = over_load(phase, x) > S(0);
    }
    void complete(Phase phase, const Touch<S>&, const Load<S>&, const S& load_rate, States x, std::span<S>,
                  Response<S>& r) const noexcept {
        r.power[unpaid] = -over_load(phase, x) * load_rate;
    }
    static void idle(const Touch<S>&, const S&, States, std::span<S> rates, Response<S>&) noexcept {
        for (S& rate : rates) rate = S(0);
    }
    [[nodiscard]] static S relax(const S&, const S&, std::span<S>) noexcept { return S(0); }
    [[nodiscard]] S stored(Phase phase, const Load<S>& load, States x) const noexcept {
        if (phase != Phase::stick && phase != Phase::slip) return S(0);
        return load.force() * over_load(phase, x);
    }
    [[nodiscard]] static Phase first(const Touch<S>&, const Load<S>&, States, const S&) noexcept { return begin(); }
    [[nodiscard]] static Phase begin() noexcept {
        if constexpr (JumpingRateFriction<Law>) {
            return Law::first_phase;
        } else {
            return Phase::slip;
        }
    }
    [[nodiscard]] static Phase again(Phase phase, const Touch<S>&, const Load<S>&, const S&, States) noexcept {
        return phase;
    }
    /// A law that jumps remembers its phase, where it has been loaded.
    [[nodiscard]] static Phase found(Phase was, const Touch<S>&, const Load<S>&, States) noexcept {
        const bool told = JumpingRateFriction<Law> && (was == Phase::stick || was == Phase::slip);
        return told ? was : begin();
    }
    [[nodiscard]] Phase settled(Phase phase, [[maybe_unused]] const Touch<S>& t,
                                [[maybe_unused]] std::span<S> x) const noexcept {
        if constexpr (JumpingRateFriction<Law>) {
            if (law.margin(phase, t.slip, x) < S(0)) return law.jump(phase, t.slip, x);
        }
        return phase;
    }
    [[nodiscard]] S margin(Phase phase, const Touch<S>& t, const Load<S>&, const S&, States x) const noexcept {
        if constexpr (JumpingRateFriction<Law>) {
            return law.margin(phase, t.slip, x);
        } else {
            return S(1);
        }
    }
    /// What the states held goes through the clutch.
    [[nodiscard]] FrictionChange<S> cross(Phase phase, const Touch<S>& t, const Load<S>& load,
                                          std::span<S> x) const noexcept {
        if constexpr (JumpingRateFriction<Law>) {
            const S before = over_load(phase, x);
            const Phase after = law.jump(phase, t.slip, x);
            return {after, load.force() * (before - over_load(after, x))};
        } else {
            return {phase};
        }
    }
    [[nodiscard]] static S enter_slip(const Touch<S>&, const Load<S>&, std::span<S>) noexcept { return S(0); }
    /// The asperities have parted. Nothing is stored in them at F_n = 0.
    [[nodiscard]] static S release(const S&, std::span<S> x) noexcept {
        std::fill(x.begin(), x.end(), S(0));
        return S(0);
    }
    [[nodiscard]] static S stiffen(const S&, States) noexcept { return S(0); }
    static void part(std::span<S>) noexcept {}
    static void deepen(const Touch<S>&, const S&, std::span<S>) noexcept {}

private:
    /// w [m].
    [[nodiscard]] S over_load(Phase phase, States x) const noexcept {
        if constexpr (JumpingRateFriction<Law>) {
            return law.stored(phase, x);
        } else {
            return law.stored(x);
        }
    }
};

}  // namespace footfall
