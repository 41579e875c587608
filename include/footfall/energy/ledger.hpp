// Where every joule is: what the body and the springs hold, what each channel has taken.
#pragma once

#include "footfall/math/vector.hpp"

namespace footfall {

/// The energies of one contact, or their sum over contacts [J].
struct ContactEnergy {
    double normal_spring = 0;      ///< held by the normal spring. (17)
    double tangential_spring = 0;  ///< W = (1/2) K_t sqrt(z) |u|^2, held by the bristle
    double normal_damper = 0;      ///< taken by the normal damper, with the clamp (14). (16)
    double tangential_damper = 0;  ///< taken by the tangential damper. (28)
    double clutch = 0;             ///< taken by the clutch: minus (29) as printed
    /// P = -integral of (1/4) K_t zdot |u|^2 / sqrt(z) dt. Where it is negative, the changing stiffness has
    /// put that much into the motion with no force paying for it: the law has made energy.
    double stiffness_change = 0;

    /// (33) as printed: W + P.
    [[nodiscard]] double tangential_spring_paper() const noexcept { return tangential_spring + stiffness_change; }
    [[nodiscard]] double stored() const noexcept { return normal_spring + tangential_spring; }
    [[nodiscard]] double dissipated() const noexcept { return normal_damper + tangential_damper + clutch; }

    ContactEnergy& operator+=(const ContactEnergy& other) noexcept {
        normal_spring += other.normal_spring;
        tangential_spring += other.tangential_spring;
        normal_damper += other.normal_damper;
        tangential_damper += other.tangential_damper;
        clutch += other.clutch;
        stiffness_change += other.stiffness_change;
        return *this;
    }
};

/// The whole account at one moment [J].
struct Ledger {
    double kinetic = 0;     ///< (37), without its first term
    double potential = 0;   ///< -m g . c: zero at the world's origin
    ContactEnergy contact;  ///< over all contacts

    /// What (15) says is constant.
    [[nodiscard]] double total() const noexcept {
        return kinetic + potential + contact.stored() + contact.stiffness_change + contact.dissipated();
    }
    /// The size of the account: the sum of its entries without their signs. Residuals are relative to the
    /// largest that a run has seen.
    [[nodiscard]] double magnitude() const noexcept;
};

}  // namespace footfall
