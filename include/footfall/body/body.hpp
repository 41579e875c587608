// A rigid body that touches the ground with spheres, and the ground itself.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace footfall {

/// One sphere fixed to a body.
struct Sphere {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< from the centre of mass, in the body's frame [m]
    double radius = 0;                                 ///< r [m], > 0
};

/// A rigid body in three dimensions.
struct Body {
    double mass = 0;  ///< m [kg], > 0
    /// About the centre of mass, in the body's frame [kg m^2]; symmetric, positive definite, and each
    /// principal moment at most the sum of the other two. (35)
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
    std::vector<Sphere> spheres;  ///< at least one
};

/// (2/5) m r^2, the inertia of a homogeneous sphere [kg m^2].
[[nodiscard]] inline Eigen::Matrix3d solid_sphere_inertia(double mass, double radius) {
    return 2.0 / 5.0 * mass * radius * radius * Eigen::Matrix3d::Identity();
}

/// (2/3) m r^2, the inertia of a thin spherical shell [kg m^2].
[[nodiscard]] inline Eigen::Matrix3d hollow_sphere_inertia(double mass, double radius) {
    return 2.0 / 3.0 * mass * radius * radius * Eigen::Matrix3d::Identity();
}

/// A plane: the points x with normal . x = height. The body is on the side that the normal points to.
struct Ground {
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit vector, world
    double height = 0;                                  ///< [m]
};

/// Position and motion of a body, in the world's frame.
struct BodyState {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< c, centre of mass [m]
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               ///< cdot [m/s]
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< body to world, unit
    Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();       ///< omega [rad/s]
};

/// Throws InvalidInput unless the body can exist and has a sphere.
void check(const Body& body);
/// Throws InvalidInput unless the normal is a unit vector and the height finite.
void check(const Ground& ground);

}  // namespace footfall
