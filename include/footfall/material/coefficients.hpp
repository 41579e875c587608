// From two materials, a radius and a damping time to the coefficients of the paper's laws, all at once.
#pragma once

#include "footfall/material/material.hpp"

namespace footfall {

/// Which tangential stiffness.
enum class TangentialStiffness {
    paper,    ///< K_t = (3/2) K_n, (23): that of nu = 0
    mindlin,  ///< K_t = 8 G* sqrt(r), Mindlin & Deresiewicz 1953
};

/// The coefficients of the laws 'azad-featherstone', normal and friction.
struct ContactCoefficients {
    double effective_modulus = 0;        ///< E* [Pa]. (9)
    double effective_shear_modulus = 0;  ///< G* [Pa]
    double damping_time = 0;             ///< tau [s] = D_A / K_A, the A of Brilliantov et al. 1996
    double alpha = 0;                    ///< [N s/m^2.5]. (11)
    double normal_stiffness = 0;         ///< K_n [N/m^1.5]. (10)
    double normal_damping = 0;           ///< D_n = (3/2) tau K_n [N s/m^1.5]. (12)
    double tangential_stiffness = 0;     ///< K_t [N/m^1.5]. (23), or Mindlin's
    /// D_t = tau K_t [N s/m^1.5], which is (24) with the K_t of (23): a free bristle recovers in tau either way.
    double tangential_damping = 0;
};

/// The contact of a sphere of radius r [m], > 0, with a damping time [s], >= 0. Throws InvalidInput.
[[nodiscard]] inline ContactCoefficients contact_coefficients(const Material& sphere, const Material& ground,
                                                              double radius, double damping_time,
                                                              TangentialStiffness tangential) {
    ContactCoefficients c;
    c.effective_modulus = effective_modulus(sphere, ground);
    c.effective_shear_modulus = effective_shear_modulus(sphere, ground);
    c.damping_time = damping_time;
    c.alpha = damping_coefficient(damping_time, c.effective_modulus, radius);
    c.normal_stiffness = normal_stiffness(c.effective_modulus, radius);
    c.normal_damping = normal_damping(c.alpha, radius);
    c.tangential_stiffness = tangential == TangentialStiffness::paper
                                 ? tangential_stiffness(c.effective_modulus, radius)
                                 : mindlin_tangential_stiffness(c.effective_shear_modulus, radius);
    c.tangential_damping = damping_time * c.tangential_stiffness;
    return c;
}

/// tau [s] of alpha [N s/m^2.5], >= 0: the inverse of damping_coefficient. Throws InvalidInput.
[[nodiscard]] inline double damping_time(double alpha, double effective_modulus, double radius) {
    const double per_second = damping_coefficient(1, effective_modulus, radius);
    (void)normal_damping(alpha, radius);  // for its check of alpha
    return alpha / per_second;
}

}  // namespace footfall
