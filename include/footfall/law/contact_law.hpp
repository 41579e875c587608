// A normal law and a friction law, composed: the whole contact law of one sphere.
#pragma once

#include <concepts>
#include <span>

#include "footfall/law/friction/rate_friction.hpp"
#include "footfall/law/normal/normal_force.hpp"
#include "footfall/law/phase.hpp"
#include "footfall/math/scalar.hpp"
#include "footfall/math/vector.hpp"

namespace footfall {

/// What one contact does at one moment. Forces act on the body; tangential vectors are in the ground's plane.
template <class S>
struct ContactResponse {
    Phase phase = Phase::flight;
    S normal_force = S(0);                           ///< F_n [N], >= 0. (13), (14)
    Vector2<S> friction_force = Vector2<S>::Zero();  ///< F_f [N]. (26), (27)
    Vector2<S> bristle_rate = Vector2<S>::Zero();    ///< udot [m/s]. (31)
    S normal_spring = S(0);                          ///< stored [J]. (17)
    S tangential_spring = S(0);                      ///< W, stored [J]
    S normal_damper_power = S(0);                    ///< dissipated [W]. (16)
    S tangential_damper_power = S(0);                ///< dissipated [W]. (28)
    S clutch_power = S(0);                           ///< dissipated [W]. (29), sign mended
    S stiffness_change_power = S(0);                 ///< dP/dt [W]
};

/// The contact law of one sphere. `Normal` and `Friction` are laws over the same scalar.
///
/// It holds no state: the bristle u belongs to the caller, who integrates `bristle_rate` in every phase.
template <class Normal, class Friction>
struct ContactLaw {
    using S = typename Normal::value_type;
    using value_type = S;
    /// Friction is computed over s^ScalePower, which keeps it regular at touchdown.
    static constexpr int ScalePower = Friction::ScalePower;
    /// Whether the phases stick and slip differ.
    static constexpr bool has_clutch = Friction::has_bristle;
    /// Whether friction has states of its own in place of the bristle.
    static constexpr bool has_states = false;

    Normal normal;
    Friction friction;

    /// The response to a depth z [m], its rate [m/s], the slip velocity V [m/s] and the bristle u [m]; the phase is
    /// decided here. Where D_t = C_V = 0 and the contact slips, `bristle_rate` takes the load as constant.
    [[nodiscard, gnu::always_inline]] ContactResponse<S> evaluate(const S& depth, const S& depth_rate,
                                                                  const Vector2<S>& V,
                                                                  const Vector2<S>& u) const noexcept {
        using std::sqrt;
        if (!(depth > S(0))) return respond(Phase::flight, S(0), depth_rate, V, u);
        const S s = sqrt(depth);
        return respond(phase_of(s, depth_rate, V, u), s, depth_rate, V, u);
    }

    /// The phase of a contact with z = s^2 > 0. (14), (26)
    [[nodiscard, gnu::always_inline]] Phase phase_of(const S& s, const S& z_rate, const Vector2<S>& V,
                                                     const Vector2<S>& u) const noexcept {
        const S phi_n = normal.template force<ScalePower>(s, z_rate).total();
        if (!(phi_n > S(0))) return Phase::recovering;
        if constexpr (Friction::has_bristle) {
            return friction.holds(phi_n, V, u) ? Phase::stick : Phase::slip;
        } else {
            return Phase::slip;
        }
    }

    /// The response in a phase that is known, as a smooth function of its arguments: s = sqrt(z) may be a little below
    /// zero, the force a little negative. `phi_n_rate` is d(F_n / s^ScalePower)/dt.
    [[nodiscard, gnu::always_inline]] ContactResponse<S> respond(
        Phase phase, const S& s, const S& z_rate, const Vector2<S>& V, const Vector2<S>& u,
        [[maybe_unused]] const S& phi_n_rate = S(0)) const noexcept {
        ContactResponse<S> r;
        r.phase = phase;
        if (phase == Phase::flight) {
            if constexpr (Friction::has_bristle) {
                const S scale = friction.scale(S(0));
                r.bristle_rate = recovery(u);
                r.tangential_spring = friction.stored_energy(scale, u);
                r.tangential_damper_power = scale * friction.damping * r.bristle_rate.squaredNorm();
            }
            return r;
        }
        const S scale = power<ScalePower>(s);
        const NormalForce<S> phi = normal.template force<ScalePower>(s, z_rate);
        r.normal_spring = normal.stored_energy(s);
        if (phase == Phase::recovering) {
            r.normal_damper_power = -(scale * phi.elastic) * z_rate;  // (14): the damper takes what the spring gives
        } else {
            r.normal_force = scale * phi.total();                      // (13)
            r.normal_damper_power = scale * phi.dissipative * z_rate;  // (16)
        }
        if constexpr (Friction::has_bristle) {
            r.tangential_spring = friction.stored_energy(scale, u);
            r.stiffness_change_power = -friction.stiffening_power(s, z_rate, u);
            if (phase == Phase::recovering) {
                r.bristle_rate = recovery(u);
            } else {
                const auto t =
                    phase == Phase::stick ? friction.stick(V, u) : friction.slip(scale, phi.total(), phi_n_rate, V, u);
                r.friction_force = scale * t.force;
                r.bristle_rate = t.bristle_rate;
                r.clutch_power = -r.friction_force.dot(t.clutch_velocity);  // (29), (30)
            }
            r.tangential_damper_power = scale * friction.damping * r.bristle_rate.squaredNorm();  // (28)
        }
        return r;
    }

    template <class T>
    [[nodiscard]] constexpr auto cast() const noexcept {
        auto n = normal.template cast<T>();
        auto f = friction.template cast<T>();
        return ContactLaw<decltype(n), decltype(f)>{n, f};
    }

private:
    /// A bristle with no force on it; one without damping has no memory of its own. (31) with F_f = 0.
    [[nodiscard]] Vector2<S> recovery(const Vector2<S>& u) const noexcept {
        return (friction.damping > S(0) ? S(-friction.recovery_rate()) : S(0)) * u;
    }
};

/// A friction law with internal states (rate_friction.hpp), as AnyRateFriction is: it knows how many when the program
/// runs.
template <class F>
concept HasFrictionStates = requires(const F law) {
    { law.state_count() } -> std::convertible_to<int>;
};

/// The contact law of one sphere under a friction law with internal states.
///
/// It holds no state: the friction's states x belong to the caller, who integrates the rates and makes them jump.
template <class Normal, HasFrictionStates Friction>
struct ContactLaw<Normal, Friction> {
    using S = typename Normal::value_type;
    using value_type = S;
    static constexpr int ScalePower = 0;
    static constexpr bool has_clutch = false;
    static constexpr bool has_states = true;

    Normal normal;
    Friction friction;

    /// The phase of a new contact, or recovering where it has no load. (14)
    [[nodiscard]] Phase first_phase(const S& s, const S& z_rate) const noexcept {
        return normal.force(s, z_rate).total() > S(0) ? friction.first_phase() : Phase::recovering;
    }

    /// The response in a phase that is known, as a smooth function of its arguments; writes the rates of the states.
    /// Where there is no load the states stand still. `load_rate` is dF_n/dt [N/s]; only `stiffness_change_power` needs
    /// it.
    [[nodiscard]] ContactResponse<S> respond(Phase phase, const S& s, const S& z_rate, const Vector2<S>& V,
                                             FrictionStates<S> x, std::span<S> rate,
                                             const S& load_rate = S(0)) const noexcept {
        ContactResponse<S> r;
        r.phase = phase;
        if (phase == Phase::flight || phase == Phase::recovering)
            for (S& value : rate) value = S(0);
        if (phase == Phase::flight) return r;
        const NormalForce<S> f = normal.force(s, z_rate);
        r.normal_spring = normal.stored_energy(s);
        if (phase == Phase::recovering) {
            r.normal_damper_power = -f.elastic * z_rate;  // (14)
            return r;
        }
        const S F_n = f.total();
        r.normal_force = F_n;
        r.normal_damper_power = f.dissipative * z_rate;  // (16)
        const RateResponse<S> t = friction.respond(phase, V, x, rate);
        const S stored = friction.stored(phase, x);
        r.friction_force = F_n * t.traction;
        r.tangential_spring = F_n * stored;
        r.tangential_damper_power = F_n * t.damper_power;
        r.clutch_power = F_n * (-t.traction.dot(V) - t.stored_rate - t.damper_power);
        r.stiffness_change_power = -stored * load_rate;
        r.bristle_rate = friction.bristle(FrictionStates<S>(rate));  // linear in the states
        return r;
    }

    template <class T>
    [[nodiscard]] constexpr auto cast() const noexcept {
        auto n = normal.template cast<T>();
        auto f = friction.template cast<T>();
        return ContactLaw<decltype(n), decltype(f)>{n, f};
    }
};

}  // namespace footfall
