// What a contact does to the body, and by which channels it takes energy.
#pragma once

#include <array>

#include "footfall/math/vector.hpp"

namespace footfall {

/// Force and torque on the body, at the sphere's bottom point; tangential vectors are in the ground's plane.
template <class S>
struct Push {
    S normal = S(0);                                 ///< F_n [N], >= 0. (13), (14)
    Vector2<S> friction = Vector2<S>::Zero();        ///< F_f [N]. (26), (27)
    S spin_torque = S(0);                            ///< about the normal [N m]
    Vector2<S> rolling_torque = Vector2<S>::Zero();  ///< in the plane [N m]
};

/// The channels by which a contact takes energy while it lasts, in the order of the ledger. The last is not taken by
/// anything: it is energy for which no force has paid.
enum TakenChannel : int { by_normal_damper, by_tangential_damper, by_clutch, unpaid, taken_channels };

/// Powers [W] or energies [J] by channel.
template <class S>
using Taken = std::array<S, static_cast<std::size_t>(taken_channels)>;

/// What a contact holds [J].
template <class S>
struct Held {
    S normal_spring = S(0);      ///< (17)
    S tangential_spring = S(0);  ///< W
};

/// What a contact does at one moment.
template <class S>
struct Response {
    Push<S> push;
    Taken<S> power{};                 ///< [W]
    bool asks_for_load_rate = false;  ///< some of it waits for how fast the load changes
};

}  // namespace footfall
