// A free rigid body over a plane at rest, with its equations of motion (34)-(37).
//
// Components:  cdot (3)  L (3)  q (4: x, y, z, w)  s of each contact  |  c (3)
//              \---------------- the motion -------------------/      \- what follows from it
//
// Vectors are in the ground's frame (ground_frame.hpp): the normal is the third axis. L is the angular momentum about
// the centre of mass: constant in flight for every body. s = sqrt(z) is a component of its own, so that nothing is
// singular at touchdown, and the forces need no position.
//
// Time. In flight dt = dsigma. With contacts dt = g dsigma, 1/g = sum of 1/s_i: for one contact dt = s dsigma, and
// nothing is singular where s = 0. The force starts as sqrt(t - t0), but it is polynomial in sigma. A contact that is
// dragged along F_n = 0 does not count: it neither begins nor ends there, and s falls as an exponential of time.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include <Eigen/LU>

#include "footfall/body/body.hpp"
#include "footfall/eigen/interop.hpp"
#include "footfall/law/push.hpp"
#include "footfall/law/touch.hpp"
#include "footfall/math/vector.hpp"
#include "footfall/plant/ground_frame.hpp"
#include "footfall/plant/root_depths.hpp"
#include "footfall/surface/plane.hpp"

namespace footfall {

/// `Contacts` is the number of spheres, or Eigen::Dynamic where it is known when the program runs.
template <class S, int Contacts = Eigen::Dynamic>
class FreeBody {
public:
    using value_type = S;
    static constexpr int contacts_at_compile_time = Contacts;
    static constexpr int velocity = 0, momentum = 3, orientation = 6, root_depths = 10;
    static constexpr int motion_at_compile_time = Contacts == Eigen::Dynamic ? Eigen::Dynamic : root_depths + Contacts;
    static constexpr int follows = 3;  ///< the position

    FreeBody(const Body& body, const Ground& ground, const Eigen::Vector3d& gravity)
        : mass_(body.mass),
          inverse_mass_(S(1) / mass_),
          inverse_inertia_(inverse_of(body.inertia)),
          gravity_(GroundFrame<S>(ground.normal).to_ground(gravity)),
          height_(ground.height) {
        isotropic_ = body.inertia.isApprox(Eigen::Matrix3d(body.inertia(0, 0) * Eigen::Matrix3d::Identity()), 0.0);
        oriented_ = !isotropic_;
        for (const Sphere& sphere : body.spheres) {
            centers_.push_back(from_eigen(sphere.center).template cast<S>());
            radii_.push_back(S(sphere.radius));
            oriented_ = oriented_ || !sphere.center.isZero(0);
        }
    }

    [[nodiscard]] constexpr int contacts() const noexcept {
        return Contacts == Eigen::Dynamic ? static_cast<int>(radii_.size()) : Contacts;
    }
    [[nodiscard]] constexpr int motion_size() const noexcept { return root_depths + contacts(); }
    [[nodiscard]] const Vector3<S>& gravity() const noexcept { return gravity_; }
    [[nodiscard]] const S& radius(int i) const noexcept { return radii_[static_cast<std::size_t>(i)]; }
    /// Whether the motion depends on the body's orientation; that of one homogeneous ball does not.
    [[nodiscard]] bool oriented() const noexcept { return oriented_; }

    /// What all contacts have in common at one moment.
    struct Motion {
        Vector3<S> velocity, momentum, angular_velocity;
        Matrix3<S> rotation;  // where `oriented`
    };

    template <class State>
    [[nodiscard, gnu::always_inline]] Motion motion(const State& y) const noexcept {
        Motion m;
        m.velocity = three_at(y, velocity);
        m.momentum = three_at(y, momentum);
        if (oriented_)
            m.rotation = rotation_of(y[orientation + 3], y[orientation], y[orientation + 1], y[orientation + 2]);
        m.angular_velocity = by_inverse_inertia(m, m.momentum);
        return m;
    }

    template <class State>
    [[nodiscard]] static Eigen::Quaternion<S> quaternion(const State& y) noexcept {
        return {y[orientation + 3], y[orientation], y[orientation + 1], y[orientation + 2]};
    }

    /// How contact i stands. (36)
    template <class State>
    [[nodiscard, gnu::always_inline]] Touch<S> touch(const State& y, const Motion& m, int i) const noexcept {
        const Vector3<S> at_contact = bottom_velocity(m, i);
        return {root_depth(y, i),
                -at_contact.z(),
                at_contact.in_plane(),
                m.angular_velocity.z(),
                m.angular_velocity.in_plane(),
                radius(i)};
    }
    [[nodiscard]] S depth_rate(const Motion& m, int i) const noexcept { return -bottom_velocity(m, i).z(); }

    [[nodiscard]] static constexpr int root_depth_component(int i) noexcept { return root_depths + i; }
    /// s of contact i, never so near zero that a power of it in a denominator would overflow.
    template <class State>
    [[nodiscard, gnu::always_inline]] static S root_depth(const State& y, int i) noexcept {
        return off_zero<S>(y[root_depths + i]);
    }

    /// Forces of all contacts, and their torque about the centre of mass.
    struct Action {
        Vector3<S> force = Vector3<S>::Zero(), torque = Vector3<S>::Zero();
    };

    [[gnu::always_inline]] void push(Action& total, const Motion& m, int i, const Push<S>& p) const noexcept {
        const Vector3<S> f(p.friction.x(), p.friction.y(), p.normal);
        total.force += f;
        total.torque.x() += radius(i) * f.y() + p.rolling_torque.x();
        total.torque.y() += p.rolling_torque.y() - radius(i) * f.x();
        total.torque.z() += p.spin_torque;
        if (oriented_) total.torque += center(m, i).cross(f);
    }

    /// d(zdot)/dt of contact i.
    [[nodiscard]] S depth_acceleration(const Motion& m, const Action& total, int i) const noexcept {
        const Vector3<S>& omega = m.angular_velocity;
        const Vector3<S> c = center(m, i);
        const Vector3<S> spin_up = by_inverse_inertia(m, Vector3<S>(total.torque - omega.cross(m.momentum)));
        return -(acceleration(total) + spin_up.cross(c) + omega.cross(omega.cross(c))).z();
    }
    /// How a push at contact j changes it: a row of J M^-1 J^T times the push.
    [[nodiscard]] S depth_response(const Motion& m, int i, int j, const Push<S>& p) const noexcept {
        Action alone;
        push(alone, m, j, p);
        return -(alone.force * inverse_mass_ + by_inverse_inertia(m, alone.torque).cross(center(m, i))).z();
    }

    /// g = dt/dsigma. `counts(i)`: contact i touches and does not drag.
    template <class State, class Counts>
    [[nodiscard, gnu::always_inline]] S time_rate(const State& y, Counts&& counts) const noexcept {
        if constexpr (Contacts == 1) {
            return counts(0) ? root_depth(y, 0) : S(1);
        } else {
            return shared_time_rate<S>(contacts(), counts, [&](int i) { return root_depth(y, i); });
        }
    }

    /// d/dsigma of the components but for the root depths; the position's stand at `follow`.
    template <class State>
    [[gnu::always_inline]] void rates(const State& y, const Motion& m, const Action& total, const S& g, int follow,
                                      State& rate) const noexcept {
        const Vector3<S> a = acceleration(total), w = m.angular_velocity * g;
        for (int k = 0; k < 3; ++k) {
            rate[velocity + k] = a[k] * g;
            rate[momentum + k] = total.torque[k] * g;  // (35)
            rate[follow + k] = m.velocity[k] * g;
        }
        // qdot = (1/2) (0, omega) q
        const S half(0.5), &q0 = y[orientation], &q1 = y[orientation + 1], &q2 = y[orientation + 2],
                           &q3 = y[orientation + 3];
        rate[orientation] = half * (w.x() * q3 + w.y() * q2 - w.z() * q1);
        rate[orientation + 1] = half * (w.y() * q3 + w.z() * q0 - w.x() * q2);
        rate[orientation + 2] = half * (w.z() * q3 + w.x() * q1 - w.y() * q0);
        rate[orientation + 3] = -half * (w.x() * q0 + w.y() * q1 + w.z() * q2);
    }
    /// ds/dsigma of a contact that touches: zdot g/(2 s). `alone`: g = s.
    template <class State>
    [[gnu::always_inline]] void root_depth_rate(const State& y, int i, const S& depth_rate, const S& g, bool alone,
                                                State& rate) const noexcept {
        rate[root_depths + i] = depth_rate * (alone ? S(0.5) : root_depth_per_depth<S>(root_depth(y, i), g));
    }

    // ---- energy ----------------------------------------------------------------------------------------------------

    [[nodiscard]] S kinetic_energy(const Motion& m) const noexcept {
        return S(0.5) * (mass_ * m.velocity.squaredNorm() + m.angular_velocity.dot(m.momentum));  // (37)
    }
    template <class State>
    [[nodiscard]] S potential_energy(const State& y, int follow) const noexcept {
        return -mass_ * gravity_.dot(position(y, follow));
    }

    // ---- position and root depth --------------------------------------------------------------------------------

    template <class State>
    [[nodiscard]] static Vector3<S> position(const State& y, int follow) noexcept {
        return three_at(y, follow);
    }
    /// z of contact i from the body's position.
    template <class State>
    [[nodiscard]] S geometric_depth(const State& y, const Motion& m, int follow, int i) const noexcept {
        return depth_in_plane(S(y[follow + 2] + center(m, i).z()), radius(i), height_);
    }
    /// s^2 and the depth that the body's position gives are one number kept twice. The forces follow s, so the position
    /// is moved to it: by the mean over the spheres that touch.
    template <class State, class Touches>
    void align(State& y, int follow, Touches&& touches) const noexcept {
        const Motion m = motion(y);
        S apart(0);
        int touching = 0;
        for (int i = 0; i < contacts(); ++i) {
            if (!touches(i)) continue;
            const S s = y[root_depths + i];
            apart += geometric_depth(y, m, follow, i) - s * s;
            ++touching;
        }
        if (touching > 0) y[follow + 2] += apart / S(touching);
    }
    template <class State>
    static void normalize(State& y) noexcept {
        using std::sqrt;
        auto q = y.template segment<4>(orientation);
        q /= S(sqrt(q.square().sum()));
    }

    template <class T>
    [[nodiscard]] FreeBody<T, Contacts> cast() const {
        FreeBody<T, Contacts> other;
        other.mass_ = T(mass_);
        other.inverse_mass_ = T(inverse_mass_);
        other.inverse_inertia_ = inverse_inertia_.template cast<T>();
        other.isotropic_ = isotropic_;
        other.oriented_ = oriented_;
        other.gravity_ = gravity_.template cast<T>();
        other.height_ = T(height_);
        for (const auto& c : centers_) other.centers_.push_back(c.template cast<T>());
        for (const auto& r : radii_) other.radii_.push_back(T(r));
        return other;
    }

private:
    template <class, int>
    friend class FreeBody;
    FreeBody() = default;

    template <class State>
    [[nodiscard, gnu::always_inline]] static Vector3<S> three_at(const State& y, int first) noexcept {
        return {y[first], y[first + 1], y[first + 2]};
    }
    [[nodiscard]] static Matrix3<S> inverse_of(const Eigen::Matrix3d& inertia) {
        const Eigen::Matrix3d inverse = inertia.inverse();
        const auto row = [&](int i) { return Vector3<S>(S(inverse(i, 0)), S(inverse(i, 1)), S(inverse(i, 2))); };
        return {{row(0), row(1), row(2)}};
    }
    /// From the centre of mass to the sphere's centre.
    [[nodiscard, gnu::always_inline]] Vector3<S> center(const Motion& m, int i) const noexcept {
        if (!oriented_) return Vector3<S>::Zero();
        return m.rotation * centers_[static_cast<std::size_t>(i)];
    }
    /// Of the sphere's bottom point: the lever arm is r, straight down from its centre. (36)
    [[nodiscard, gnu::always_inline]] Vector3<S> bottom_velocity(const Motion& m, int i) const noexcept {
        const S& r = radius(i);
        Vector3<S> v = m.velocity;
        v.x() -= r * m.angular_velocity.y();
        v.y() += r * m.angular_velocity.x();
        if (oriented_) v += m.angular_velocity.cross(center(m, i));
        return v;
    }
    [[nodiscard, gnu::always_inline]] Vector3<S> acceleration(const Action& total) const noexcept {
        return gravity_ + total.force * inverse_mass_;  // (34)
    }
    [[nodiscard, gnu::always_inline]] Vector3<S> by_inverse_inertia(const Motion& m,
                                                                    const Vector3<S>& v) const noexcept {
        if (isotropic_) return v * inverse_inertia_.row[0][0];
        return m.rotation * (inverse_inertia_ * m.rotation.transposed_times(v));
    }
    S mass_, inverse_mass_;
    Matrix3<S> inverse_inertia_;
    bool isotropic_ = false;  // inertia is a multiple of the identity: omega = L / I
    bool oriented_ = false;
    Vector3<S> gravity_;
    S height_;
    std::vector<Vector3<S>> centers_;
    std::vector<S> radii_;
};

}  // namespace footfall
