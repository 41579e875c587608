// Where each quantity stands in the flat state vector that the integrators advance.
//
//   cdot (3)  L (3)  q (4: x, y, z, w)  | for each contact: s, u (2) |  c (3)  t  | for each contact: the ledger (4)
//   \-------------------- the motion -------------------------------/  \------- what follows from it ------------/
//
// Under a friction law with internal states (law/friction/rate_friction.hpp) these stand in place of the bristle u.
//
// Vectors are in the ground's frame. L is the angular momentum about the centre of mass: constant in flight for every
// body.
// s = sqrt(z) is a state of its own, so that nothing is singular at touchdown, and the forces need no position.
// The motion does not depend on what stands behind it, so the methods integrate that part as plain integrals: no
// stage needs it, and no Jacobian.
#pragma once

#include <Eigen/Core>

namespace footfall {

/// Index of each state. `Spheres` is the number of contacts, `FrictionStates` that of the states of friction in each: 2
/// for a bristle. Either may be Eigen::Dynamic.
template <int Spheres, int FrictionStates = 2>
struct Layout {
    static constexpr int velocity = 0, momentum = 3, orientation = 6, contacts = 10;
    static constexpr int ledger_per_contact = 4, position_and_time = 4;
    static constexpr bool dynamic = Spheres == Eigen::Dynamic || FrictionStates == Eigen::Dynamic;
    static constexpr int size_at_compile_time =
        dynamic ? Eigen::Dynamic : contacts + position_and_time + (1 + FrictionStates + ledger_per_contact) * Spheres;
    static constexpr int motion_at_compile_time = dynamic ? Eigen::Dynamic : contacts + (1 + FrictionStates) * Spheres;

    int spheres = Spheres;
    int friction_states = FrictionStates;

    [[nodiscard]] constexpr int root_depth(int i) const noexcept { return contacts + motion_per_contact() * i; }
    /// The first of the contact's friction states; for a bristle, u.
    [[nodiscard]] constexpr int bristle(int i) const noexcept { return root_depth(i) + 1; }
    /// How many components come first and make the motion.
    [[nodiscard]] constexpr int motion_size() const noexcept { return contacts + motion_per_contact() * count(); }
    [[nodiscard]] constexpr int position() const noexcept { return motion_size(); }
    [[nodiscard]] constexpr int time() const noexcept { return motion_size() + 3; }
    [[nodiscard]] constexpr int ledger(int i) const noexcept {
        return motion_size() + position_and_time + ledger_per_contact * i;
    }
    [[nodiscard]] constexpr int size() const noexcept { return ledger(count()); }

    // Offsets inside a contact's ledger.
    static constexpr int normal_damper = 0, tangential_damper = 1, clutch = 2, stiffness_change = 3;

private:
    // A number of spheres that is known at compile time unrolls every loop over the state.
    [[nodiscard]] constexpr int count() const noexcept { return Spheres == Eigen::Dynamic ? spheres : Spheres; }
    [[nodiscard]] constexpr int motion_per_contact() const noexcept {
        return 1 + (FrictionStates == Eigen::Dynamic ? friction_states : FrictionStates);
    }
};

template <class S, class Layout>
using State = Eigen::Array<S, Layout::size_at_compile_time, 1>;

}  // namespace footfall
