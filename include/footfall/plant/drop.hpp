// One sphere that meets the ground along its normal: no gravity, no friction, no rotation. What a law makes of an
// impact, and nothing else.
//
// Components:  zdot  s
//              \- the motion
//
// zdot is the speed into the ground, s = sqrt(z) the root of the depth. While the contact lasts dt = s dsigma, so that
// touchdown, s = 0, is a regular point (docs/theory.md, "The onset of contact"). Before and after, nothing moves that
// a law could see: the plant keeps no height.
#pragma once

#include "footfall/law/push.hpp"
#include "footfall/law/touch.hpp"
#include "footfall/math/vector.hpp"

namespace footfall {

/// Over a scalar S: with dual numbers, derivatives with respect to the mass come out.
template <class S>
class Drop {
public:
    using value_type = S;
    static constexpr int contacts_at_compile_time = 1;
    static constexpr int velocity = 0, root_depths = 1;
    static constexpr int motion_at_compile_time = 2;
    static constexpr int follows = 0;
    static constexpr bool keeps_account = false;  ///< of what the contact takes: it is what the motion has lost

    /// Mass [kg], > 0.
    explicit Drop(const S& mass) : mass_(mass), inverse_mass_(S(1) / mass) {}

    [[nodiscard]] static constexpr int contacts() noexcept { return contacts_at_compile_time; }
    [[nodiscard]] static constexpr int motion_size() noexcept { return motion_at_compile_time; }

    struct Motion {
        S depth_rate;  ///< zdot [m/s]
    };
    template <class State>
    [[nodiscard, gnu::always_inline]] static Motion motion(const State& y) noexcept {
        return {y[velocity]};
    }
    template <class State>
    [[nodiscard, gnu::always_inline]] static Touch<S> touch(const State& y, const Motion& m, int /*i*/) noexcept {
        return {y[root_depths], m.depth_rate, Vector2<S>::Zero()};
    }

    /// The force on the sphere, out of the ground.
    struct Action {
        S normal = S(0);
    };
    [[gnu::always_inline]] static void push(Action& total, const Motion& /*m*/, int /*i*/, const Push<S>& p) noexcept {
        total.normal += p.normal;
    }
    /// d(zdot)/dt.
    [[nodiscard, gnu::always_inline]] S depth_acceleration(const Motion& /*m*/, const Action& total,
                                                           int /*i*/) const noexcept {
        return -total.normal * inverse_mass_;
    }
    /// How a push changes it.
    [[nodiscard]] S depth_response(const Motion& /*m*/, int /*i*/, int /*j*/, const Push<S>& p) const noexcept {
        return -p.normal * inverse_mass_;
    }

    /// g = dt/dsigma. `counts(i)`: contact i touches and does not drag.
    template <class State, class Counts>
    [[nodiscard, gnu::always_inline]] static S time_rate(const State& y, Counts&& counts) noexcept {
        return counts(0) ? y[root_depths] : S(1);
    }

    template <class State>
    [[gnu::always_inline]] void rates(const State& /*y*/, const Motion& m, const Action& total, const S& g,
                                      int /*follow*/, State& rate) const noexcept {
        rate[velocity] = depth_acceleration(m, total, 0) * g;
    }
    /// ds/dsigma of the contact, zdot g/(2 s): here g = s.
    template <class State>
    [[gnu::always_inline]] static void root_depth_rate(const State& /*y*/, int /*i*/, const S& depth_rate,
                                                       const S& /*g*/, bool /*alone*/, State& rate) noexcept {
        rate[root_depths] = depth_rate * S(0.5);
    }
    template <class State>
    [[nodiscard]] static S geometric_depth(const State& y, const Motion& /*m*/, int /*follow*/, int /*i*/) noexcept {
        return y[root_depths] * y[root_depths];
    }

    template <class T>
    [[nodiscard]] Drop<T> cast() const {
        return Drop<T>(T(mass_));
    }

private:
    S mass_, inverse_mass_;
};

}  // namespace footfall
