// How a sphere stands to the ground: all that a contact law may know of the bodies.
#pragma once

#include <cmath>

#include "footfall/math/vector.hpp"

namespace footfall {

/// One contact at one moment. Vectors are in the ground's plane; angular velocities are of the sphere against the
/// ground.
template <class S>
struct Touch {
    S root_depth;                             ///< s = sqrt(z) [m^0.5]; an event locator looks a little below zero
    S depth_rate;                             ///< zdot [m/s], > 0 loading
    Vector2<S> slip;                          ///< V_sph, of the sphere's bottom point [m/s]. (36)
    S spin = S(0);                            ///< about the normal [rad/s]
    Vector2<S> rolling = Vector2<S>::Zero();  ///< in the plane [rad/s]
    S radius = S(0);                          ///< r [m]
};

/// sqrt(z), or 0 above the ground.
template <class S>
[[nodiscard]] S root_of_depth(const S& depth) noexcept {
    using std::sqrt;
    return depth > S(0) ? S(sqrt(depth)) : S(0);
}

}  // namespace footfall
