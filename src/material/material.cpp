#include "footfall/material/material.hpp"

#include <cmath>
#include <numbers>
#include <string_view>

#include <fmt/format.h>

#include "footfall/math/error.hpp"

namespace footfall {
namespace {

using std::numbers::pi;

void require(bool allowed, std::string_view name, double value, std::string_view range) {
    if (!allowed) throw InvalidInput(fmt::format("{} is {}; it must be {}", name, value, range));
}

void require_positive(std::string_view name, double value) {
    require(std::isfinite(value) && value > 0, name, value, "finite and > 0");
}

void require_not_negative(std::string_view name, double value) {
    require(std::isfinite(value) && value >= 0, name, value, "finite and >= 0");
}

/// (1 - nu^2) / E [1/Pa].
double compliance(const Material& material) {
    const double E = material.youngs_modulus, nu = material.poisson_ratio;
    require(E > 0, "Young's modulus", E, "> 0");
    require(nu > -1 && nu <= 0.5, "Poisson's ratio", nu, "> -1 and <= 0.5");
    return (1 - nu * nu) / E;
}

}  // namespace

double effective_modulus(const Material& a, const Material& b) {
    const double sum = compliance(a) + compliance(b);  // (9)
    if (!(sum > 0)) throw InvalidInput("both materials are rigid; one Young's modulus must be finite");
    return 1 / sum;
}

double normal_stiffness(double effective_modulus, double radius) {
    require_positive("effective modulus", effective_modulus);
    require_positive("radius", radius);
    return 4.0 / 3.0 * effective_modulus * std::sqrt(radius);  // (10)
}

double tangential_stiffness(double effective_modulus, double radius) {
    require_positive("effective modulus", effective_modulus);
    require_positive("radius", radius);
    return 2 * effective_modulus * std::sqrt(radius);  // (23)
}

double effective_shear_modulus(const Material& a, const Material& b) {
    // (2 - nu) / G = 2 (1 + nu) (2 - nu) / E = 2 (2 - nu) / (1 - nu) times the (1 - nu^2) / E of (9).
    const auto shear_compliance = [](const Material& m) {
        return 2 * (2 - m.poisson_ratio) / (1 - m.poisson_ratio) * compliance(m);
    };
    const double sum = shear_compliance(a) + shear_compliance(b);
    if (!(sum > 0)) throw InvalidInput("both materials are rigid; one Young's modulus must be finite");
    return 1 / sum;
}

double mindlin_tangential_stiffness(double effective_shear_modulus, double radius) {
    require_positive("effective shear modulus", effective_shear_modulus);
    require_positive("radius", radius);
    return 8 * effective_shear_modulus * std::sqrt(radius);  // 8 G* a, a = sqrt(r z)
}

double normal_damping(double alpha, double radius) {
    require_not_negative("alpha", alpha);
    require_positive("radius", radius);
    return 4 * pi * radius * alpha;  // (12)
}

double tangential_damping(double alpha, double radius) {
    return normal_damping(alpha, radius);  // (24) is the coefficient in (12)
}

double damping_coefficient(double damping_time, double effective_modulus, double radius) {
    require_not_negative("damping time", damping_time);
    require_positive("effective modulus", effective_modulus);
    require_positive("radius", radius);
    return damping_time * effective_modulus / (2 * pi * std::sqrt(radius));  // (8), (11)
}

double stiffness_per_area(double effective_modulus, double radius, double depth) {
    require_positive("effective modulus", effective_modulus);
    require_positive("radius", radius);
    require_positive("depth", depth);
    return effective_modulus / (2 * pi * std::sqrt(radius * depth));  // (8)
}

double damping_per_area(double alpha, double depth) {
    require_not_negative("alpha", alpha);
    require_positive("depth", depth);
    return alpha / std::sqrt(depth);  // (11)
}

double contact_area(double radius, double depth) {
    require_positive("radius", radius);
    require(std::isfinite(depth), "depth", depth, "finite");
    return depth > 0 ? 2 * pi * radius * depth : 0;  // (7)
}

double exact_contact_area(double radius, double depth) {
    require_positive("radius", radius);
    require(std::isfinite(depth) && depth <= radius, "depth", depth,
            fmt::format("finite and <= the radius, {}", radius));
    return depth > 0 ? pi * depth * (2 * radius - depth) : 0;  // (6)
}

}  // namespace footfall
