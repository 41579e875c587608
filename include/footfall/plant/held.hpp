// Contacts held in one step of another simulator, their host, as a plant.
//
// Within the step the host's mass and all forces but those of the contacts are frozen. The velocities of the contact
// points against the ground then follow from the contact forces F alone:
//
//   dv/dt = a + D F,   dz_i/dt = -v_n,i,   D = J M^-1 J^T,   a = J (free acceleration) + (dJ/dt) v
//
// D may be singular; it is never inverted.
//
// Components:  v (3 each)  s (1 each)  t  |  impulse (3 each)  moment of the impulse (3 each)  [angular impulse]
//              \------ the motion ------/    \------------------ what follows from it ------------------------/
//
// Vectors of contact i are in its own frame: two tangents, then the ground's normal. The moment of the impulse is about
// the step's start, the integral of t F dt: with it the double impulse is t (impulse) - (moment), and the depth of a
// contact in flight follows from that.
//
// Time as of a FreeBody: 1/g = sum of 1/s_i, or g = 1 while no contact can come near its surface.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include "footfall/law/push.hpp"
#include "footfall/law/touch.hpp"
#include "footfall/math/value_of.hpp"
#include "footfall/math/vector.hpp"
#include "footfall/plant/root_depths.hpp"

namespace footfall {

/// What a host gives for one of its steps, over the scalar of what it gives.
template <class Given>
struct HeldStep {
    explicit HeldStep(std::size_t n)
        : depth(n, Given(0)),
          velocity(3 * n, Given(0)),
          acceleration(3 * n, Given(0)),
          delassus(9 * n * n, Given(0)),
          radius(n, 0),
          spin(n, 0),
          rolling(2 * n, 0),
          depth_offset(n, Given(0)) {}

    std::vector<Given> depth;         ///< z at the start [m]
    std::vector<Given> velocity;      ///< v at the start, 3 numbers a contact [m/s]
    std::vector<Given> acceleration;  ///< a, 3 numbers a contact [m/s^2]
    std::vector<Given> delassus;      ///< D, 3n x 3n, symmetric [1/kg]
    std::vector<double> radius;       ///< [m]
    std::vector<double> spin;         ///< about the normal [rad/s]
    std::vector<double> rolling;      ///< in the plane, 2 numbers a contact [rad/s]
    /// By this the depth of a contact in flight is less than D and a say [m]: what s has gone astray by, where it left
    /// the ground.
    std::vector<Given> depth_offset;
    bool plain_time = false;  ///< g = 1: no contact comes near its surface
};

/// `Given` is the scalar of what the host gives: S itself, or what S is a derivative of.
template <class S, class Given = S>
class HeldPlant {
public:
    using value_type = S;
    static constexpr int contacts_at_compile_time = Eigen::Dynamic;
    static constexpr int motion_at_compile_time = Eigen::Dynamic;
    static constexpr int follows = Eigen::Dynamic;
    static constexpr int velocity = 0;

    /// `step` is read whenever the plant is asked, and outlives it. `torques`: laws may give torques.
    HeldPlant(const HeldStep<Given>& step, bool torques)
        : step_(&step),
          contacts_(static_cast<int>(step.depth.size())),
          torques_(torques),
          push_(torques ? 6 * step.depth.size() : 3 * step.depth.size(), S(0)) {}

    [[nodiscard]] int contacts() const noexcept { return contacts_; }
    [[nodiscard]] int motion_size() const noexcept { return clock_component() + 1; }
    [[nodiscard]] int root_depth_component(int i) const noexcept { return 3 * contacts_ + i; }
    [[nodiscard]] int clock_component() const noexcept { return 4 * contacts_; }
    [[nodiscard]] bool torques() const noexcept { return torques_; }
    /// Of the components that follow.
    [[nodiscard]] int follow_size() const noexcept { return (torques_ ? 9 : 6) * contacts_; }
    [[nodiscard]] int impulse(int i) const noexcept { return 3 * i; }
    [[nodiscard]] int impulse_moment(int i) const noexcept { return 3 * (contacts_ + i); }
    [[nodiscard]] int angular_impulse(int i) const noexcept { return 3 * (2 * contacts_ + i); }
    [[nodiscard]] const HeldStep<Given>& step() const noexcept { return *step_; }

    struct Motion {
        const S* velocity;
        S time;
    };
    template <class State>
    [[nodiscard]] Motion motion(const State& y) const noexcept {
        return {y.data() + velocity, y[clock_component()]};
    }

    template <class State>
    [[nodiscard]] Touch<S> touch(const State& y, const Motion& m, int i) const noexcept {
        const S* const v = m.velocity + 3 * i;
        const std::size_t k = index(i);
        return {root_depth(y, i),
                -v[2],
                {v[0], v[1]},
                S(step_->spin[k]),
                {S(step_->rolling[2 * k]), S(step_->rolling[2 * k + 1])},
                S(step_->radius[k])};
    }
    [[nodiscard]] static S depth_rate(const Motion& m, int i) noexcept { return -m.velocity[3 * i + 2]; }

    /// s of contact i, never so near zero that a power of it in a denominator would overflow.
    template <class State>
    [[nodiscard]] S root_depth(const State& y, int i) const noexcept {
        return off_zero<S>(y[root_depth_component(i)]);
    }

    /// Forces of all contacts, and torques behind them, 3 numbers a contact; in the plant's own memory, where the next
    /// one takes their place.
    struct Action {
        S* push;
    };
    [[nodiscard]] Action no_action() const noexcept {
        std::fill(push_.begin(), push_.end(), S(0));
        return {push_.data()};
    }
    void push(Action& total, const Motion& /*m*/, int i, const Push<S>& p) const noexcept {
        S* const force = total.push + 3 * i;
        force[0] += p.friction.x();
        force[1] += p.friction.y();
        force[2] += p.normal;
        if (!torques_) return;
        S* const torque = total.push + 3 * (contacts_ + i);
        torque[0] += p.rolling_torque.x();
        torque[1] += p.rolling_torque.y();
        torque[2] += p.spin_torque;
    }

    /// d(zdot)/dt of contact i.
    [[nodiscard]] S depth_acceleration(const Motion& /*m*/, const Action& total, int i) const noexcept {
        return -(as(step_->acceleration[index(3 * i + 2)]) + row_times(3 * i + 2, total.push));
    }
    /// How a push at contact j changes it.
    [[nodiscard]] S depth_response(const Motion& /*m*/, int i, int j, const Push<S>& p) const noexcept {
        const Given* const d = row(3 * i + 2) + 3 * j;
        return -(as(d[0]) * p.friction.x() + as(d[1]) * p.friction.y() + as(d[2]) * p.normal);
    }

    /// g = dt/dsigma. `counts(i)`: contact i touches and does not drag.
    template <class State, class Counts>
    [[nodiscard]] S time_rate(const State& y, Counts&& counts) const noexcept {
        if (step_->plain_time) return S(1);
        return shared_time_rate<S>(contacts_, counts, [&](int i) { return root_depth(y, i); });
    }

    /// d/dsigma of the components but for the root depths; what follows begins at `follow`.
    template <class State>
    void rates(const State& /*y*/, const Motion& m, const Action& total, const S& g, int follow,
               State& rate) const noexcept {
        const int n = 3 * contacts_;
        for (int k = 0; k < n; ++k) {
            rate[velocity + k] = (as(step_->acceleration[index(k)]) + row_times(k, total.push)) * g;
            const S force = total.push[k] * g;
            rate[follow + k] = force;
            rate[follow + n + k] = force * m.time;
        }
        rate[clock_component()] = g;
        if (!torques_) return;
        for (int k = 0; k < n; ++k) rate[follow + 2 * n + k] = total.push[n + k] * g;
    }
    /// ds/dsigma of a contact that touches: zdot g/(2 s).
    template <class State>
    void root_depth_rate(const State& y, int i, const S& depth_rate, const S& g, bool /*alone*/,
                         State& rate) const noexcept {
        rate[root_depth_component(i)] = depth_rate * root_depth_per_depth<S>(root_depth(y, i), g);
    }

    /// Component k of the double impulse since the start [N s^2].
    template <class State>
    [[nodiscard]] S double_impulse(const State& y, const S& time, int follow, int k) const noexcept {
        return time * y[follow + k] - y[follow + 3 * contacts_ + k];
    }
    /// z of contact i by the impulses so far: that of the host, whose positions they move.
    template <class State>
    [[nodiscard]] S geometric_depth(const State& y, const Motion& m, int follow, int i) const noexcept {
        const std::size_t k = index(3 * i + 2);
        S height = as(step_->velocity[k]) * m.time + S(0.5) * as(step_->acceleration[k]) * m.time * m.time;
        const Given* const d = row(3 * i + 2);
        for (int l = 0; l < 3 * contacts_; ++l) height += as(d[l]) * double_impulse(y, m.time, follow, l);
        return as(step_->depth[index(i)]) - as(step_->depth_offset[index(i)]) - height;
    }

    /// The same plant over another scalar, in whichever step `step` holds by then.
    template <class T>
    [[nodiscard]] HeldPlant<T, Given> cast() const {
        return {*step_, torques_};
    }

private:
    static constexpr std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }
    [[nodiscard]] static S as(const Given& x) noexcept {
        if constexpr (std::is_same_v<S, Given>) {
            return x;
        } else {
            return S(value_of(x));
        }
    }
    [[nodiscard]] const Given* row(int k) const noexcept {
        return step_->delassus.data() + index(3 * contacts_) * index(k);
    }
    [[nodiscard]] S row_times(int k, const S* push) const noexcept {
        const Given* const d = row(k);
        // Four sums at a time: one would wait for each addition.
        std::array<S, 4> sum{S(0), S(0), S(0), S(0)};
        const int n = 3 * contacts_;
        int l = 0;
        for (; l + 4 <= n; l += 4)
            for (int j = 0; j < 4; ++j) sum[index(j)] += as(d[l + j]) * push[l + j];
        for (; l < n; ++l) sum[0] += as(d[l]) * push[l];
        return (sum[0] + sum[1]) + (sum[2] + sum[3]);
    }

    const HeldStep<Given>* step_;
    int contacts_;
    bool torques_;
    mutable std::vector<S> push_;
};

}  // namespace footfall
