// Where each quantity stands in the flat state vector that the integrators advance.
//
//   c (3)  cdot (3)  L (3)  q (4: x, y, z, w)  t  | for each contact: s, u (2) | for each contact: the ledger (4)
//
// L is the angular momentum about the centre of mass in the world's frame: constant in flight for every body.
// s = sqrt(z) is a state of its own, so that nothing is singular at touchdown. The ledger comes last because nothing
// depends on it: an implicit method leaves it out of its Jacobian.
#pragma once

#include <Eigen/Core>

namespace footfall {

/// Index of each state. `Spheres` is the number of contacts, or Eigen::Dynamic.
template <int Spheres>
struct Layout {
    static constexpr int position = 0, velocity = 3, momentum = 6, orientation = 9, time = 13, contacts = 14;
    static constexpr int dynamic_per_contact = 3, ledger_per_contact = 4;
    static constexpr int size_at_compile_time =
        Spheres == Eigen::Dynamic ? Eigen::Dynamic : contacts + (dynamic_per_contact + ledger_per_contact) * Spheres;

    int spheres = Spheres;

    [[nodiscard]] constexpr int root_depth(int i) const noexcept { return contacts + dynamic_per_contact * i; }
    [[nodiscard]] constexpr int bristle(int i) const noexcept { return root_depth(i) + 1; }
    /// Without the ledger.
    [[nodiscard]] constexpr int dynamic_size() const noexcept { return contacts + dynamic_per_contact * spheres; }
    [[nodiscard]] constexpr int ledger(int i) const noexcept { return dynamic_size() + ledger_per_contact * i; }
    [[nodiscard]] constexpr int size() const noexcept { return dynamic_size() + ledger_per_contact * spheres; }

    // Offsets inside a contact's ledger.
    static constexpr int normal_damper = 0, tangential_damper = 1, clutch = 2, stiffness_change = 3;
};

template <class S, int Spheres>
using State = Eigen::Array<S, Layout<Spheres>::size_at_compile_time, 1>;

}  // namespace footfall
