// The contact of a rig as a plant: pressed along its path, and dragged along another or by a mass that it carries.
//
// Components:  theta  x (2) v (2)  |  d (2)  holding damper  pressing work  dragging work
//              \- the motion ----/    \------------ what follows from it --------------/
//
// theta is the clock of the interval that the rig is in (timeline.hpp), dt = g dtheta with a prescribed g. x, v: the
// mass, where there is one. d: the slip displacement, the integral of V_sph. How the contact stands follows from theta,
// but for the slip velocity of a mass.
#pragma once

#include <type_traits>

#include "footfall/law/push.hpp"
#include "footfall/law/touch.hpp"
#include "footfall/math/value_of.hpp"
#include "footfall/math/vector.hpp"
#include "study/timeline.hpp"

namespace footfall {

template <class S>
class RigPlant {
public:
    using value_type = S;
    static constexpr int contacts_at_compile_time = 1;
    static constexpr int theta = 0, position = 1, velocity = 3;
    static constexpr int motion_at_compile_time = 5;
    static constexpr int follows = 5;
    /// In what follows: the slip displacement, and the integrals of the rig's own channels in their order.
    static constexpr int displacement = 0, integrals = 2;

    /// `interval` is the one that the rig is in, whichever that is by then.
    RigPlant(const Rig& rig, const Timeline& timeline, const Interval& interval)
        : rig_(&rig), timeline_(&timeline), interval_(&interval) {}

    [[nodiscard]] static constexpr int motion_size() noexcept { return motion_at_compile_time; }
    [[nodiscard]] bool carries() const noexcept { return rig_->drag == Drag::mass; }

    struct Motion {
        S root_depth, depth, depth_rate, depth_acceleration;
        Vector2<S> slip;                                                        // V_sph
        Vector2<S> position, velocity, support, support_velocity, force, belt;  // of the mass, where there is one
    };

    template <class State>
    [[nodiscard]] Motion motion(const State& y) const noexcept {
        const S& at = y[theta];
        const Instant now = timeline_->at(*interval_, value_of(at));
        Motion m;
        m.root_depth = prescribed(now.s, now.s_rate, now, at);
        m.depth = prescribed(now.depth, now.depth_rate, now, at);
        m.depth_rate = prescribed(now.depth_rate, now.depth_acceleration, now, at);
        m.depth_acceleration = S(now.depth_acceleration);
        if (carries()) {
            m.position = {y[position], y[position + 1]};
            m.velocity = {y[velocity], y[velocity + 1]};
            m.support = prescribed(now.support, now.support_velocity, now, at);
            m.support_velocity = prescribed(now.support_velocity, now.support_acceleration, now, at);
            m.force = prescribed(now.force, now.force_rate, now, at);
            m.belt = prescribed(now.belt, now.belt_rate, now, at);
            m.slip = m.velocity - m.belt;
        } else {
            m.slip = prescribed(now.slip, now.slip_rate, now, at);
        }
        return m;
    }

    template <class State>
    [[nodiscard]] static Touch<S> touch(const State& /*y*/, const Motion& m, int /*i*/) noexcept {
        return {m.root_depth, m.depth_rate, m.slip};
    }

    /// What the contact does to the rig.
    struct Action {
        S normal = S(0);
        Vector2<S> friction = Vector2<S>::Zero();
    };
    static void push(Action& total, const Motion& /*m*/, int /*i*/, const Push<S>& p) noexcept {
        total.normal += p.normal;
        total.friction += p.friction;
    }
    [[nodiscard]] static S depth_acceleration(const Motion& m, const Action& /*total*/, int /*i*/) noexcept {
        return m.depth_acceleration;
    }
    /// The depth does not yield to a push.
    [[nodiscard]] static S depth_response(const Motion&, int, int, const Push<S>&) noexcept { return S(0); }

    /// g = dt/dtheta.
    template <class State, class Counts>
    [[nodiscard]] S time_rate(const State& y, Counts&&) const noexcept {
        const Pace pace = Timeline::pace(*interval_, value_of(y[theta]));
        if constexpr (std::is_same_v<S, double>) {
            return pace.rate;
        } else {
            return S(pace.rate) + (y[theta] - S(value_of(y[theta]))) * S(pace.curvature);
        }
    }

    template <class State>
    void rates(const State& /*y*/, const Motion& m, const Action& total, const S& g, int follow,
               State& rate) const noexcept {
        rate[theta] = S(1);
        S dragging, holding(0);
        if (carries()) {
            const HeldMass& held = rig_->mass;
            const Vector2<S> pull = holding_force(m);
            const Vector2<S> acceleration = (total.friction + pull + m.force) / S(held.mass);
            for (int k = 0; k < 2; ++k) {
                rate[position + k] = m.velocity[k] * g;
                rate[velocity + k] = acceleration[k] * g;
            }
            holding = S(held.damping) * (m.support_velocity - m.velocity).squaredNorm();
            dragging = total.friction.dot(m.belt) + m.force.dot(m.velocity) + pull.dot(m.support_velocity);
        } else {
            for (int k = 0; k < 2; ++k) rate[position + k] = rate[velocity + k] = S(0);
            dragging = -total.friction.dot(m.slip);
        }
        rate[follow + displacement] = m.slip.x() * g;
        rate[follow + displacement + 1] = m.slip.y() * g;
        rate[follow + integrals] = holding * g;
        rate[follow + integrals + 1] = total.normal * m.depth_rate * g;
        rate[follow + integrals + 2] = dragging * g;
    }
    /// The root depth is prescribed, no component.
    template <class State>
    static void root_depth_rate(const State&, int, const S&, const S&, bool, State&) noexcept {}
    template <class State>
    [[nodiscard]] static S geometric_depth(const State&, const Motion& m, int, int) noexcept {
        return m.depth;
    }

    /// Of spring and damper, on the mass [N].
    [[nodiscard]] Vector2<S> holding_force(const Motion& m) const noexcept {
        const HeldMass& held = rig_->mass;
        return S(held.stiffness) * (m.support - m.position) + S(held.damping) * (m.support_velocity - m.velocity);
    }

    /// The same plant over another scalar, in the same interval at any time.
    template <class T>
    [[nodiscard]] RigPlant<T> cast() const {
        return {*rig_, *timeline_, *interval_};
    }

private:
    /// A value that is prescribed, over S: it changes with theta alone.
    static S prescribed(double value, [[maybe_unused]] double rate, [[maybe_unused]] const Instant& now,
                        [[maybe_unused]] const S& at) noexcept {
        if constexpr (std::is_same_v<S, double>) {
            return value;
        } else {
            return S(value) + (at - S(value_of(at))) * S(rate * now.time_rate);
        }
    }
    static Vector2<S> prescribed(const Vector2<double>& value, const Vector2<double>& rate, const Instant& now,
                                 const S& at) noexcept {
        return {prescribed(value.x(), rate.x(), now, at), prescribed(value.y(), rate.y(), now, at)};
    }

    const Rig* rig_;
    const Timeline* timeline_;
    const Interval* interval_;
};

}  // namespace footfall
