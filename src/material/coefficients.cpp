#include "footfall/material/coefficients.hpp"

#include "footfall/math/error.hpp"

namespace footfall {

ContactCoefficients contact_coefficients(const Material& sphere, const Material& ground, double radius,
                                         double damping_time, TangentialStiffness tangential) {
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

double damping_time(double alpha, double effective_modulus, double radius) {
    const double per_second = damping_coefficient(1, effective_modulus, radius);
    (void)normal_damping(alpha, radius);  // for its check of alpha
    return alpha / per_second;
}

}  // namespace footfall
