// From what things are made of to the coefficients of the paper's laws.
//
// The ground is a bed of springs and dampers whose stiffness and damping per unit area fall with the local
// deformation as its inverse root, (8) and (11). Integrated over the contact they give the coefficients of
// (13) and (22). Both densities have the same shape, so one time says how much damping there is:
//
//   tau = D_A / K_A = 2 pi sqrt(r) alpha / E*,   D_n = (3/2) tau K_n,   D_t = tau K_t
//
// tau is the A of Brilliantov et al. (1996), and the time in which a free bristle recovers.
// Source: Azad & Featherstone 2010, (6)-(12), (20)-(24). Their tangential stiffness is that of nu = 0; Mindlin's, for
// any nu, stands beside it.
#pragma once

namespace footfall {

/// An isotropic, linearly elastic solid.
struct Material {
    double youngs_modulus = 0;  ///< E [Pa], > 0; infinity for a rigid side
    double poisson_ratio = 0;   ///< nu [1], -1 < nu <= 0.5
};

/// E* [Pa], the modulus of two solids in contact. (9)
/// Throws InvalidInput where a property is out of its range, or both sides are rigid.
[[nodiscard]] double effective_modulus(const Material& a, const Material& b);

/// K_n = (4/3) E* sqrt(r), normal stiffness [N/m^1.5], from E* [Pa], > 0, and the sphere's radius r [m], > 0. (10)
/// Throws InvalidInput, as every function below does where an argument is out of its range.
[[nodiscard]] double normal_stiffness(double effective_modulus, double radius);

/// K_t = 2 E* sqrt(r) = (3/2) K_n, tangential stiffness [N/m^1.5]. (20), (23)
[[nodiscard]] double tangential_stiffness(double effective_modulus, double radius);

/// G* [Pa], the shear modulus of two solids in contact: 1/G* = (2 - nu_1)/G_1 + (2 - nu_2)/G_2, G = E / (2 (1 + nu)).
/// Mindlin & Deresiewicz 1953; Johnson 1985, Contact Mechanics, (7.43). Throws as effective_modulus does.
[[nodiscard]] double effective_shear_modulus(const Material& a, const Material& b);

/// K_t = 8 G* sqrt(r) [N/m^1.5], from G* [Pa], > 0, and r [m], > 0: the stiffness 8 G* a of a contact of radius
/// a = sqrt(r z) that does not slide. Mindlin & Deresiewicz 1953; Johnson 1985, (7.43). It is kappa times that of (23),
/// kappa = 4 G*/E*, which is 2 (1 - nu) / (2 - nu) for equal materials: 1 for nu = 0, 0.82 for nu = 0.3.
[[nodiscard]] double mindlin_tangential_stiffness(double effective_shear_modulus, double radius);

/// D_n = 4 pi r alpha, normal damping [N s/m^1.5], from alpha [N s/m^2.5], >= 0, and r [m], > 0. (12)
[[nodiscard]] double normal_damping(double alpha, double radius);

/// D_t = 4 pi r alpha = D_n, tangential damping [N s/m^1.5]. (21), (24)
[[nodiscard]] double tangential_damping(double alpha, double radius);

/// alpha = tau E* / (2 pi sqrt(r)) [N s/m^2.5], from the damping time tau [s], >= 0. (8), (11)
[[nodiscard]] double damping_coefficient(double damping_time, double effective_modulus, double radius);

/// K_A(z) = E* / (2 pi sqrt(r)) z^(-1/2), stiffness per unit area [N/m^3], at a local deformation z [m], > 0. (8)
[[nodiscard]] double stiffness_per_area(double effective_modulus, double radius, double depth);

/// D_A(z) = alpha z^(-1/2), damping per unit area [N s/m^3], at a local deformation z [m], > 0. (11)
[[nodiscard]] double damping_per_area(double alpha, double depth);

/// A(z) = 2 pi r z [m^2]; 0 where z < 0. What the laws use: right for z << 2r. (7)
[[nodiscard]] double contact_area(double radius, double depth);

/// A(z) = pi (2 r z - z^2) [m^2], z <= r; 0 where z < 0. (6)
/// With it instead of (7), f_K is smaller by the factor 1 - (2/5) z/r, and f_D, k_t and b_t by 1 - (2/3) z/r.
[[nodiscard]] double exact_contact_area(double radius, double depth);

}  // namespace footfall
