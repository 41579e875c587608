// The paper's integrals over the contact, done by quadrature, against the coefficients in closed form.
#include "footfall/material/material.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "footfall/math/error.hpp"
#include "math/random_real.hpp"

namespace footfall {
namespace {

using test::decades;
using test::uniform;
constexpr double pi = std::numbers::pi;

/// The integral over [0, length] by the tanh-sinh rule, which an integrable singularity at an end does not
/// disturb. The integrand gets its distances from both ends, so that nothing is lost near the singularity.
double integral(double length, const std::function<double(double from_start, double from_end)>& f) {
    constexpr double step = 1.0 / 32, last = 5;
    double sum = 0;
    for (double t = -last; t <= last; t += step) {
        const double from_start = length / (1 + std::exp(-pi * std::sinh(t)));
        const double from_end = length / (1 + std::exp(pi * std::sinh(t)));
        sum += f(from_start, from_end) * pi * std::cosh(t) * from_start * (from_end / length);
    }
    return sum * step;
}

/// One contact, and both readings of its area: how deep the sphere's surface lies, counted from its bottom, at the
/// edge of an area, and the local deformation at an area that is short of the whole by a given rest.
struct Contact {
    double effective_modulus = *decades(1e5, 1e12);
    double alpha = *decades(1e-2, 1e6);
    double radius = *decades(1e-3, 1);
    double depth = *decades(1e-7, 1) * radius;

    double stiffness(double z) const { return stiffness_per_area(effective_modulus, radius, z); }
    double damping(double z) const { return damping_per_area(alpha, z); }

    /// zeta for (7): the surface is the paraboloid A = 2 pi r xi.
    double local(double rest) const { return rest / (2 * pi * radius); }
    /// zeta for (6): the surface is the sphere, xi = r - sqrt(r^2 - A/pi).
    double exact_local(double rest) const {
        const double edge = radius - depth;
        return rest / pi / (std::sqrt(edge * edge + rest / pi) + edge);
    }
};

void expect_equal(double a, double b) { RC_ASSERT(std::abs(a - b) <= 1e-11 * std::abs(b)); }

RC_GTEST_PROP(Material, SpringForceIsTheIntegralOverTheContactArea, ()) {
    const Contact c;
    const double f_K = integral(c.depth, [&](double xi, double rest) {  // (4)
        return contact_area(c.radius, xi) * c.stiffness(rest);
    });
    expect_equal(f_K, normal_stiffness(c.effective_modulus, c.radius) * std::pow(c.depth, 1.5));
}

RC_GTEST_PROP(Material, DamperForceIsTheIntegralOverTheContactArea, ()) {
    const Contact c;
    const double per_rate = integral(contact_area(c.radius, c.depth), [&](double, double rest) {  // (5)
        return c.damping(c.local(rest));
    });
    expect_equal(per_rate, normal_damping(c.alpha, c.radius) * std::sqrt(c.depth));
}

RC_GTEST_PROP(Material, TangentialCoefficientsAreIntegralsOverTheContactArea, ()) {
    const Contact c;
    const double area = contact_area(c.radius, c.depth);
    const double k_t = integral(area, [&](double, double rest) { return c.stiffness(c.local(rest)); });  // (20)
    const double b_t = integral(area, [&](double, double rest) { return c.damping(c.local(rest)); });    // (21)
    expect_equal(k_t, tangential_stiffness(c.effective_modulus, c.radius) * std::sqrt(c.depth));
    expect_equal(b_t, tangential_damping(c.alpha, c.radius) * std::sqrt(c.depth));
}

RC_GTEST_PROP(Material, ExactAreaLowersTheSpringForceByTwoFifthsOfTheRelativeDepth, ()) {
    const Contact c;
    const double f_K = integral(c.depth, [&](double xi, double rest) {  // (4) with (6)
        return exact_contact_area(c.radius, xi) * c.stiffness(rest);
    });
    const double paper = normal_stiffness(c.effective_modulus, c.radius) * std::pow(c.depth, 1.5);
    expect_equal(f_K, paper * (1 - 2.0 / 5.0 * c.depth / c.radius));
}

RC_GTEST_PROP(Material, ExactAreaLowersDampingAndTangentialStiffnessByTwoThirdsOfTheRelativeDepth, ()) {
    const Contact c;
    const double area = exact_contact_area(c.radius, c.depth);
    const double k_t = integral(area, [&](double, double rest) { return c.stiffness(c.exact_local(rest)); });
    const double b_t = integral(area, [&](double, double rest) { return c.damping(c.exact_local(rest)); });
    const double factor = (1 - 2.0 / 3.0 * c.depth / c.radius) * std::sqrt(c.depth);
    expect_equal(k_t, tangential_stiffness(c.effective_modulus, c.radius) * factor);
    expect_equal(b_t, tangential_damping(c.alpha, c.radius) * factor);
    expect_equal(b_t, normal_damping(c.alpha, c.radius) * factor);
}

RC_GTEST_PROP(Material, TangentialStiffnessIsTheSlopeOfTheSpringForce, ()) {
    // (20) integrates the stiffness over the area, which is what the slope of (4) does.
    const Contact c;
    const double K_n = normal_stiffness(c.effective_modulus, c.radius), h = 1e-5 * c.depth;
    const double slope = K_n * (std::pow(c.depth + h, 1.5) - std::pow(c.depth - h, 1.5)) / (2 * h);
    const double k_t = tangential_stiffness(c.effective_modulus, c.radius) * std::sqrt(c.depth);
    RC_ASSERT(std::abs(k_t - slope) <= 1e-8 * slope);
}

RC_GTEST_PROP(Material, DampingTimeIsDampingOverStiffnessEverywhere, ()) {
    const Contact c;
    const double tau = *decades(1e-9, 1);
    const double alpha = damping_coefficient(tau, c.effective_modulus, c.radius);
    expect_equal(damping_per_area(alpha, c.depth) / c.stiffness(c.depth), tau);
    expect_equal(tangential_damping(alpha, c.radius) / tangential_stiffness(c.effective_modulus, c.radius), tau);
    expect_equal(normal_damping(alpha, c.radius) / normal_stiffness(c.effective_modulus, c.radius), 1.5 * tau);
}

RC_GTEST_PROP(Material, ExactAreaIsThatOfTheCircleAtTheGround, ()) {
    const double r = *decades(1e-3, 1), z = *uniform(0, 1) * r;
    const double half_chord_squared = r * r - (r - z) * (r - z);  // Pythagoras
    RC_ASSERT(std::abs(exact_contact_area(r, z) - pi * half_chord_squared) <= 1e-14 * r * r);
    RC_ASSERT(contact_area(r, z) >= exact_contact_area(r, z));
}

TEST(Material, NoAreaTouchesAboveTheGround) {
    EXPECT_EQ(contact_area(0.5, -0.1), 0);
    EXPECT_EQ(exact_contact_area(0.5, -0.1), 0);
    EXPECT_EQ(contact_area(0.5, 0), 0);
    EXPECT_EQ(exact_contact_area(0.5, 0), 0);
}

TEST(Material, PaperNumbersBelongToOneMaterial) {
    // Section 4: K_n = 8.5e6, K_t = 12.75e6, D_n = D_t = 3.1e3 for r = 1.65 cm.
    const double r = 0.0165, E_star = 4.962930769e7, alpha = 1.4950918897e4;
    EXPECT_NEAR(normal_stiffness(E_star, r), 8.5e6, 0.01);
    EXPECT_NEAR(tangential_stiffness(E_star, r), 12.75e6, 0.01);
    EXPECT_NEAR(normal_damping(alpha, r), 3.1e3, 1e-5);
    EXPECT_NEAR(tangential_damping(alpha, r), 3.1e3, 1e-5);
}

TEST(Material, HertzApproachOfASteelBallOnSteel) {
    // Johnson, Contact Mechanics, (4.23): delta = (9 P^2 / (16 R E*^2))^(1/3). E = 210 GPa, nu = 0.3 on both sides give
    // E* = 210/1.82 GPa; with R = 1 cm and P = 100 N, delta = 3.482910 um.
    const Material steel{210e9, 0.3};
    const double E_star = effective_modulus(steel, steel);
    EXPECT_NEAR(E_star, 210e9 / 1.82, 1e-3);
    EXPECT_NEAR(normal_stiffness(E_star, 0.01) * std::pow(3.482909883941308e-6, 1.5), 100, 1e-6);
}

TEST(Material, ARigidSideLeavesThePlaneStrainModulusOfTheOther) {
    const Material rubber{5e6, 0.5}, rigid{std::numeric_limits<double>::infinity(), 0.3};
    EXPECT_DOUBLE_EQ(effective_modulus(rubber, rigid), 5e6 / 0.75);
    EXPECT_DOUBLE_EQ(effective_modulus(rigid, rubber), 5e6 / 0.75);
    EXPECT_THROW((void)effective_modulus(rigid, rigid), InvalidInput);
}

TEST(Material, NoDampingIsAllowed) {
    EXPECT_EQ(normal_damping(0, 0.1), 0);
    EXPECT_EQ(tangential_damping(0, 0.1), 0);
    EXPECT_EQ(damping_coefficient(0, 1e6, 0.1), 0);
}

TEST(Material, RefusesWhatCannotBeAndSaysWhatIsAllowed) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    const Material good{1e9, 0.3};
    for (const double E : {0.0, -1e9, nan}) EXPECT_THROW((void)effective_modulus({E, 0.3}, good), InvalidInput) << E;
    for (const double nu : {-1.0, 0.51, nan})
        EXPECT_THROW((void)effective_modulus(good, {1e9, nu}), InvalidInput) << nu;
    for (const double bad : {0.0, -1.0, nan, infinity}) {
        EXPECT_THROW((void)normal_stiffness(bad, 0.1), InvalidInput) << bad;
        EXPECT_THROW((void)normal_stiffness(1e6, bad), InvalidInput) << bad;
        EXPECT_THROW((void)tangential_stiffness(bad, 0.1), InvalidInput) << bad;
        EXPECT_THROW((void)tangential_stiffness(1e6, bad), InvalidInput) << bad;
        EXPECT_THROW((void)normal_damping(1, bad), InvalidInput) << bad;
        EXPECT_THROW((void)tangential_damping(1, bad), InvalidInput) << bad;
        EXPECT_THROW((void)damping_coefficient(1, bad, 0.1), InvalidInput) << bad;
        EXPECT_THROW((void)damping_coefficient(1, 1e6, bad), InvalidInput) << bad;
        EXPECT_THROW((void)stiffness_per_area(1e6, 0.1, bad), InvalidInput) << bad;
        EXPECT_THROW((void)stiffness_per_area(1e6, bad, 0.1), InvalidInput) << bad;
        EXPECT_THROW((void)stiffness_per_area(bad, 0.1, 0.1), InvalidInput) << bad;
        EXPECT_THROW((void)damping_per_area(1, bad), InvalidInput) << bad;
        EXPECT_THROW((void)contact_area(bad, 0.01), InvalidInput) << bad;
        EXPECT_THROW((void)exact_contact_area(bad, 0.01), InvalidInput) << bad;
    }
    for (const double bad : {-1.0, nan, infinity}) {
        EXPECT_THROW((void)normal_damping(bad, 0.1), InvalidInput) << bad;
        EXPECT_THROW((void)damping_coefficient(bad, 1e6, 0.1), InvalidInput) << bad;
        EXPECT_THROW((void)damping_per_area(bad, 0.1), InvalidInput) << bad;
    }
    EXPECT_THROW((void)contact_area(0.1, nan), InvalidInput);
    EXPECT_THROW((void)exact_contact_area(0.1, 0.11), InvalidInput);
    try {
        (void)normal_stiffness(1e6, -0.25);
        FAIL() << "a negative radius was accepted";
    } catch (const InvalidInput& error) {
        EXPECT_EQ(std::string(error.what()), "radius is -0.25; it must be finite and > 0");
    }
}

}  // namespace
}  // namespace footfall
