// The elasto-plastic law: LuGre whose bristle is purely elastic up to a break-away deflection, so that nothing creeps
// below it.
//
//   udot = V - alpha(|u|) (u^.V)_+ u / u_ss(V),   u_ss = g(V) / sigma_0,   u^ = u/|u|
//   F_f  = -F_n (sigma_0 u + sigma_1 udot + sigma_2 V)
//   alpha = 0 for |u| <= u_ba, 1 for |u| >= u_ss, (1 + sin(pi (|u| - (u_ss + u_ba)/2) / (u_ss - u_ba)))/2 between
//
// States: u (2) [m]. Units: sigma_0 1/m, sigma_1 and sigma_2 s/m, mu_s and mu_k 1, v_s m/s, beta 1.
//
// Source: Dupont, Armstrong & Hayward 2000, Elasto-plastic friction model: contact compliance and stiction, Proc.
// American Control Conf.; Dupont, Hayward, Armstrong & Altpeter 2002, Single state elastoplastic friction models, IEEE
// Trans. Automatic Control 47:787. Over the load, as LuGre.
//
// Choices. In one direction alpha = 0 while the bristle relaxes (u V < 0), else u creeps by alpha |V| u/u_ss; in the
// plane this is read as alpha (u^.V)_+ u/u_ss, which is the same in one direction, and continuous where V turns across
// u. u_max = u_ss, as in the source, with LuGre's Stribeck curve g for it. u_ba = beta min(mu_s, mu_k)/sigma_0, so that
// it is never above u_ss. Where the two come together (beta = 1) the rise of alpha between them would be a step, which
// is stiff without end; it is given the width sqrt((u_ss - u_ba)^2 + (w u_ba)^2), w = `narrowest_rise`, up to u_ss, and
// alpha begins above 0 at u_ba. Steady sliding is the same.
//
// Phases. Phase::stick where the bristle is elastic, alpha (u^.V)_+ = 0: below u_ba, or relaxing. Phase::slip where it
// gives way: beyond u_ba, and stretching. Each is smooth up to its end, where |u| reaches u_ba or u^.V changes its
// sign. A bristle that slides steadily stays at u_ss, even where that is u_ba: it slips until it relaxes. A body that
// comes to rest beyond u_ba swings about u^.V = 0 with an amplitude that ends in rounding, so each phase goes on a
// little beyond it, by `resting_share` of v_s.
//
// Stored: w = (1/2) sigma_0 |u|^2. Dissipated over F_n: sigma_1 |udot|^2 in the damper; the rest, as in lugre.hpp, in
// the clutch. What is said there of its sign and of passivity holds here.
//
// It cannot represent the loss of pre-sliding hysteresis below u_ba (but for sigma_1), nor a static friction that grows
// with the time of rest.
#pragma once

#include <algorithm>
#include <numbers>

#include "footfall/law/friction/stribeck_bristle.hpp"
#include "footfall/math/value_of.hpp"

namespace footfall {

template <class S = double>
struct ElastoPlasticFriction {
    using value_type = S;
    static constexpr int states = 2;
    static constexpr Phase first_phase = Phase::stick;
    /// The least width of the rise of alpha over u_ba [1]: what it changes in alpha for the usual beta is below 1e-5.
    static constexpr double narrowest_rise = 1e-3;
    /// The speed below which the bristle counts as standing, over v_s [1]: far above rounding, and far too small to
    /// creep by.
    static constexpr double resting_share = 1e-9;

    S stiffness;               ///< sigma_0, stiffness of the bristle over the load [1/m], > 0
    S damping;                 ///< sigma_1, damping of the bristle over the load [s/m], >= 0
    S static_coefficient;      ///< mu_s [1], > 0
    S kinetic_coefficient;     ///< mu_k [1], > 0
    S stribeck_velocity;       ///< v_s [m/s], > 0
    S viscous = S(0);          ///< sigma_2, viscous friction over the load [s/m], >= 0
    S elastic_share = S(0.7);  ///< beta, u_ba over the deflection of steady sliding [1], > 0 and <= 1

    /// g: the coefficient of friction of steady sliding, without the viscous term.
    [[nodiscard]] S steady(const Vector2<S>& V) const noexcept { return stribeck_curve(*this, V); }
    /// u_ba, the deflection up to which the bristle is elastic [m].
    [[nodiscard]] S breakaway() const noexcept {
        return elastic_share * std::min(static_coefficient, kinetic_coefficient) / stiffness;
    }

    [[nodiscard]] RateResponse<S> respond(Phase phase, const Vector2<S>& V, FrictionStates<S> x,
                                          std::span<S> rate) const noexcept {
        const Vector2<S> u = vector_at<S>(x);
        Vector2<S> u_rate = V;
        if (phase == Phase::slip) {
            const S u_ss = steady(V) / stiffness;
            u_rate -= u * (plastic_share(length_of(u), u_ss) * stretching(V, u) / u_ss);
        }
        put_vector(rate, 0, u_rate);
        return bristle_response(*this, V, u, u_rate);
    }

    [[nodiscard]] S stored(Phase, FrictionStates<S> x) const noexcept {
        return S(0.5) * stiffness * vector_at<S>(x).squaredNorm();
    }

    /// Over v_s or u_ba [1].
    [[nodiscard]] S margin(Phase phase, const Vector2<S>& V, FrictionStates<S> x) const noexcept {
        const Vector2<S> u = vector_at<S>(x);
        const S speed = stretching(V, u) / stribeck_velocity;
        if (phase == Phase::slip) return speed + S(resting_share);
        return std::max(S(S(1) - length_of(u) / breakaway()), S(S(resting_share) - speed));
    }

    [[nodiscard]] Phase jump(Phase phase, const Vector2<S>&, std::span<S>) const noexcept {
        return phase == Phase::slip ? Phase::stick : Phase::slip;
    }

    [[nodiscard]] double state_size(int) const noexcept {
        return static_cast<double>(value_of(kinetic_coefficient / stiffness));
    }

    /// As LuGre's.
    [[nodiscard]] bool clutch_only_takes() const noexcept { return !(damping > S(0)); }

    template <class T>
    [[nodiscard]] constexpr ElastoPlasticFriction<T> cast() const noexcept {
        return {T(stiffness),         T(damping), T(static_coefficient), T(kinetic_coefficient),
                T(stribeck_velocity), T(viscous), T(elastic_share)};
    }

    static constexpr LawDescription description{
        .name = "elasto-plastic",
        .formula =
            "F_f = -F_n (sigma_0 u + sigma_1 udot + sigma_2 V); udot = V - alpha (u.V)_+ u / (|u| u_ss); alpha = 0 "
            "up to |u| = beta mu/sigma_0, 1 from u_ss = g(V)/sigma_0",
        .source = "Dupont, Armstrong & Hayward 2000; Dupont, Hayward, Armstrong & Altpeter 2002, over the load",
        .limits = "no pre-sliding loss below the break-away deflection but for sigma_1; not passive for large sigma_1"};

    static constexpr auto parameters() noexcept {
        using Law = ElastoPlasticFriction<S>;
        return stribeck_bristle_parameters<Law>(Parameter<Law>{"elastic_share", "beta", "1", &Law::elastic_share,
                                                               "break-away deflection over that of steady sliding", "",
                                                               0.7, false, true});
    }

private:
    /// u^.V [m/s]; 0 for a bristle without a direction.
    [[nodiscard]] static S stretching(const Vector2<S>& V, const Vector2<S>& u) noexcept {
        const S length = length_of(u);
        return length > S(0) ? S(u.dot(V) / length) : S(0);
    }

    /// alpha beyond u_ba. (1 + sin(pi (|u| - (u_ss + u_ba)/2) / (u_ss - u_ba)))/2 is the cosine from u_ss down.
    [[nodiscard]] S plastic_share(const S& length, const S& u_ss) const noexcept {
        using std::cos, std::sqrt;
        if (!(length < u_ss)) return S(1);
        const S rise = u_ss - breakaway(), least = S(narrowest_rise) * breakaway();
        const S width = sqrt(rise * rise + least * least);
        return S(0.5) + S(0.5) * cos(S(std::numbers::pi) * (u_ss - length) / width);
    }
};

}  // namespace footfall
