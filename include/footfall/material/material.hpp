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

#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

#include "footfall/math/error.hpp"
#include "footfall/math/number_text.hpp"

namespace footfall {

/// An isotropic, linearly elastic solid.
struct Material {
    double youngs_modulus = 0;  ///< E [Pa], > 0; infinity for a rigid side
    double poisson_ratio = 0;   ///< nu [1], -1 < nu <= 0.5
};

namespace detail {
inline void require(bool allowed, std::string_view name, double value, std::string_view range) {
    if (!allowed)
        throw InvalidInput(std::string(name) + " is " + number_text(value) + "; it must be " + std::string(range));
}

inline void require_positive(std::string_view name, double value) {
    require(std::isfinite(value) && value > 0, name, value, "finite and > 0");
}

inline void require_not_negative(std::string_view name, double value) {
    require(std::isfinite(value) && value >= 0, name, value, "finite and >= 0");
}

/// (1 - nu^2) / E [1/Pa].
inline double compliance(const Material& material) {
    const double E = material.youngs_modulus, nu = material.poisson_ratio;
    require(E > 0, "Young's modulus", E, "> 0");
    require(nu > -1 && nu <= 0.5, "Poisson's ratio", nu, "> -1 and <= 0.5");
    return (1 - nu * nu) / E;
}
}  // namespace detail

/// E* [Pa], the modulus of two solids in contact. (9)
/// Throws InvalidInput where a property is out of its range, or both sides are rigid.
[[nodiscard]] inline double effective_modulus(const Material& a, const Material& b) {
    const double sum = detail::compliance(a) + detail::compliance(b);  // (9)
    if (!(sum > 0)) throw InvalidInput("both materials are rigid; one Young's modulus must be finite");
    return 1 / sum;
}

/// K_n = (4/3) E* sqrt(r), normal stiffness [N/m^1.5], from E* [Pa], > 0, and the sphere's radius r [m], > 0. (10)
/// Throws InvalidInput, as every function below does where an argument is out of its range.
[[nodiscard]] inline double normal_stiffness(double effective_modulus, double radius) {
    detail::require_positive("effective modulus", effective_modulus);
    detail::require_positive("radius", radius);
    return 4.0 / 3.0 * effective_modulus * std::sqrt(radius);  // (10)
}

/// K_t = 2 E* sqrt(r) = (3/2) K_n, tangential stiffness [N/m^1.5]. (20), (23)
[[nodiscard]] inline double tangential_stiffness(double effective_modulus, double radius) {
    detail::require_positive("effective modulus", effective_modulus);
    detail::require_positive("radius", radius);
    return 2 * effective_modulus * std::sqrt(radius);  // (23)
}

/// G* [Pa], the shear modulus of two solids in contact: 1/G* = (2 - nu_1)/G_1 + (2 - nu_2)/G_2, G = E / (2 (1 + nu)).
/// Mindlin & Deresiewicz 1953; Johnson 1985, Contact Mechanics, (7.43). Throws as effective_modulus does.
[[nodiscard]] inline double effective_shear_modulus(const Material& a, const Material& b) {
    // (2 - nu) / G = 2 (1 + nu) (2 - nu) / E = 2 (2 - nu) / (1 - nu) times the (1 - nu^2) / E of (9).
    const auto shear_compliance = [](const Material& m) {
        return 2 * (2 - m.poisson_ratio) / (1 - m.poisson_ratio) * detail::compliance(m);
    };
    const double sum = shear_compliance(a) + shear_compliance(b);
    if (!(sum > 0)) throw InvalidInput("both materials are rigid; one Young's modulus must be finite");
    return 1 / sum;
}

/// K_t = 8 G* sqrt(r) [N/m^1.5], from G* [Pa], > 0, and r [m], > 0: the stiffness 8 G* a of a contact of radius
/// a = sqrt(r z) that does not slide. Mindlin & Deresiewicz 1953; Johnson 1985, (7.43). It is kappa times that of (23),
/// kappa = 4 G*/E*, which is 2 (1 - nu) / (2 - nu) for equal materials: 1 for nu = 0, 0.82 for nu = 0.3.
[[nodiscard]] inline double mindlin_tangential_stiffness(double effective_shear_modulus, double radius) {
    detail::require_positive("effective shear modulus", effective_shear_modulus);
    detail::require_positive("radius", radius);
    return 8 * effective_shear_modulus * std::sqrt(radius);  // 8 G* a, a = sqrt(r z)
}

/// D_n = 4 pi r alpha, normal damping [N s/m^1.5], from alpha [N s/m^2.5], >= 0, and r [m], > 0. (12)
[[nodiscard]] inline double normal_damping(double alpha, double radius) {
    detail::require_not_negative("alpha", alpha);
    detail::require_positive("radius", radius);
    return 4 * std::numbers::pi * radius * alpha;  // (12)
}

/// D_t = 4 pi r alpha = D_n, tangential damping [N s/m^1.5]. (21), (24)
[[nodiscard]] inline double tangential_damping(double alpha, double radius) {
    return normal_damping(alpha, radius);  // (24) is the coefficient in (12)
}

/// alpha = tau E* / (2 pi sqrt(r)) [N s/m^2.5], from the damping time tau [s], >= 0. (8), (11)
[[nodiscard]] inline double damping_coefficient(double damping_time, double effective_modulus, double radius) {
    detail::require_not_negative("damping time", damping_time);
    detail::require_positive("effective modulus", effective_modulus);
    detail::require_positive("radius", radius);
    return damping_time * effective_modulus / (2 * std::numbers::pi * std::sqrt(radius));  // (8), (11)
}

/// K_A(z) = E* / (2 pi sqrt(r)) z^(-1/2), stiffness per unit area [N/m^3], at a local deformation z [m], > 0. (8)
[[nodiscard]] inline double stiffness_per_area(double effective_modulus, double radius, double depth) {
    detail::require_positive("effective modulus", effective_modulus);
    detail::require_positive("radius", radius);
    detail::require_positive("depth", depth);
    return effective_modulus / (2 * std::numbers::pi * std::sqrt(radius * depth));  // (8)
}

/// D_A(z) = alpha z^(-1/2), damping per unit area [N s/m^3], at a local deformation z [m], > 0. (11)
[[nodiscard]] inline double damping_per_area(double alpha, double depth) {
    detail::require_not_negative("alpha", alpha);
    detail::require_positive("depth", depth);
    return alpha / std::sqrt(depth);  // (11)
}

/// A(z) = 2 pi r z [m^2]; 0 where z < 0. What the laws use: right for z << 2r. (7)
[[nodiscard]] inline double contact_area(double radius, double depth) {
    detail::require_positive("radius", radius);
    detail::require(std::isfinite(depth), "depth", depth, "finite");
    return depth > 0 ? 2 * std::numbers::pi * radius * depth : 0;  // (7)
}

/// A(z) = pi (2 r z - z^2) [m^2], z <= r; 0 where z < 0. (6)
/// With it instead of (7), f_K is smaller by the factor 1 - (2/5) z/r, and f_D, k_t and b_t by 1 - (2/3) z/r.
[[nodiscard]] inline double exact_contact_area(double radius, double depth) {
    detail::require_positive("radius", radius);
    detail::require(std::isfinite(depth) && depth <= radius, "depth", depth,
                    "finite and <= the radius, " + number_text(radius));
    return depth > 0 ? std::numbers::pi * depth * (2 * radius - depth) : 0;  // (6)
}

}  // namespace footfall
