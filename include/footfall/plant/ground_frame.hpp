// The frame in which a run is computed: the ground's. What is given and what is given back is in the world's.
#pragma once

#include <cmath>

#include <Eigen/Geometry>

#include "footfall/eigen/interop.hpp"
#include "footfall/math/vector.hpp"

namespace footfall {

/// A right-handed frame whose third axis is the ground's normal. For a ground whose normal is z it is the world's, and
/// every conversion is exact.
template <class S>
class GroundFrame {
public:
    explicit GroundFrame(const Eigen::Vector3d& normal) {
        // Along the plane: the world axis nearest to it, x where there is a choice.
        const bool x_is_steep = std::abs(normal.x()) > 0.9;
        const Eigen::Vector3d axis = x_is_steep ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
        to_ground_.row(2) = normal.cast<S>();
        const Eigen::Matrix<S, 3, 1> n = to_ground_.row(2);
        Eigen::Matrix<S, 3, 1> t1 = axis.cast<S>();
        t1 = (t1 - n * n.dot(t1)).normalized();
        to_ground_.row(0) = t1;
        to_ground_.row(1) = n.cross(t1);
        turn_ = Eigen::Quaternion<S>(to_ground_);
    }

    [[nodiscard]] Vector3<S> to_ground(const Eigen::Vector3d& v) const {
        return from_eigen((to_ground_ * v.cast<S>()).eval());
    }
    [[nodiscard]] Eigen::Quaternion<S> to_ground(const Eigen::Quaterniond& q) const { return turn_ * q.cast<S>(); }

    [[nodiscard]] Eigen::Vector3d to_world(const Vector3<S>& v) const {
        return (to_ground_.transpose() * to_eigen(v)).template cast<double>();
    }
    /// A vector in the ground's plane.
    [[nodiscard]] Eigen::Vector3d to_world(const Vector2<S>& v) const {
        return to_world(Vector3<S>(v.x(), v.y(), S(0)));
    }
    [[nodiscard]] Eigen::Quaterniond to_world(const Eigen::Quaternion<S>& q) const {
        return (turn_.conjugate() * q).template cast<double>();
    }

private:
    Eigen::Matrix<S, 3, 3> to_ground_;
    Eigen::Quaternion<S> turn_;
};

}  // namespace footfall
