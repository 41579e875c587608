// Vectors and rotations: Eigen's, under the names used here.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace footfall {

template <class S>
using Vector2 = Eigen::Matrix<S, 2, 1>;
template <class S>
using Vector3 = Eigen::Matrix<S, 3, 1>;
template <class S>
using Matrix3 = Eigen::Matrix<S, 3, 3>;
template <class S>
using Quaternion = Eigen::Quaternion<S>;

}  // namespace footfall
