// All that one contact does at one moment, as a loop of one's own, NumPy and tables see it.
#pragma once

#include "footfall/law/phase.hpp"
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

}  // namespace footfall
