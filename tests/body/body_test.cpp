// Bodies: their inertia, what no body can be, and how their spheres move.
#include "footfall/body/body.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "footfall/math/error.hpp"
#include "footfall/simulate/run.hpp"
#include "math/random_real.hpp"

namespace footfall {
namespace {

/// The moment of inertia of a figure of revolution about its axis, density one: a sum over thin rings.
template <class Radius>
double ring_sum(double half_height, Radius&& outer_squared) {
    constexpr int slices = 2000;
    double sum = 0;
    for (int k = 0; k < slices; ++k) {
        const double x = half_height * (2 * (k + 0.5) / slices - 1);
        const double r2 = outer_squared(x);
        sum += 0.5 * std::numbers::pi * r2 * r2 * 2 * half_height / slices;  // a disc: m r^2 / 2
    }
    return sum;
}

TEST(Inertia, OfASolidSphereIsTheSumOfItsDiscs) {
    const double r = 0.7, mass = 4.0 / 3.0 * std::numbers::pi * r * r * r;
    const double summed = ring_sum(r, [&](double x) { return r * r - x * x; });
    EXPECT_TRUE(solid_sphere_inertia(mass, r).isApprox(summed * Eigen::Matrix3d::Identity(), 1e-6));
}

TEST(Inertia, OfAHollowSphereIsThatOfABallLessASlightlySmallerOne) {
    const double r = 0.7, inner = r * (1 - 1e-5), third = 4.0 / 3.0 * std::numbers::pi;
    const double outside = third * r * r * r, inside = third * inner * inner * inner;
    const double shell = 0.4 * outside * r * r - 0.4 * inside * inner * inner;
    EXPECT_TRUE(hollow_sphere_inertia(outside - inside, r).isApprox(shell * Eigen::Matrix3d::Identity(), 1e-4));
}

Body with_moments(const Eigen::Vector3d& moments, const Eigen::Quaterniond& turned = Eigen::Quaterniond::Identity()) {
    Body body;
    body.mass = 1;
    const Eigen::Matrix3d R = turned.toRotationMatrix();
    body.inertia = R * moments.asDiagonal() * R.transpose();
    body.spheres = {{.radius = 0.1}};
    return body;
}

// A body is a cloud of points: the moments of any cloud are those of a body.
RC_GTEST_PROP(Check, TakesTheInertiaOfEveryCloudOfPoints, ()) {
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
    for (int k = 0; k < 4; ++k) {
        const Eigen::Vector3d x(*test::uniform(-1, 1), *test::uniform(-1, 1), *test::uniform(-1, 1));
        inertia += *test::decades(1e-3, 1) * (x.squaredNorm() * Eigen::Matrix3d::Identity() - x * x.transpose());
    }
    inertia += 1e-6 * Eigen::Matrix3d::Identity();
    Body body = with_moments({1, 1, 1});
    body.inertia = inertia;
    check(body);
}

RC_GTEST_PROP(Check, RefusesMomentsThatNoBodyHasHoweverTheyAreTurned, ()) {
    const double a = *test::decades(1e-3, 1e3), b = *test::decades(1e-3, 1e3);
    const Eigen::Quaterniond q =
        Eigen::Quaterniond(*test::uniform(0.1, 1), *test::uniform(-1, 1), *test::uniform(-1, 1), *test::uniform(-1, 1))
            .normalized();
    check(with_moments({a, b, a + b}, q));  // a lamina
    RC_ASSERT_THROWS_AS(check(with_moments({a, b, 1.001 * (a + b)}, q)), InvalidInput);
    RC_ASSERT_THROWS_AS(check(with_moments({a, b, -0.001 * a}, q)), InvalidInput);
}

TEST(Check, NamesTheSphereThatIsWrong) {
    Body body = with_moments({1, 1, 1});
    body.spheres.push_back({.radius = -0.25});
    try {
        check(body);
        FAIL() << "accepted";
    } catch (const InvalidInput& error) {
        EXPECT_STREQ(error.what(), "body: sphere 1: radius is -0.25 m; it must be > 0 and finite");
    }
}

TEST(Ground, IsAnyPlane) {
    EXPECT_NO_THROW(check(Ground{}));
    EXPECT_NO_THROW(check(Ground{{0.6, 0, 0.8}, -3}));
    EXPECT_NO_THROW(check(Ground{{0, 0, -1}, 0})) << "a ceiling";
    EXPECT_THROW(check(Ground{{0.6, 0, 0.81}, 0}), InvalidInput);
}

// A body turned by 90 degrees about x, spinning about the world's z. Its sphere, at (0, 0, -0.2) in the body, is at
// (0, 0.2, 0) from the centre of mass in the world, its contact point 0.1 below. With omega = (0, 0, 5):
// omega x (0, 0.2, -0.1) = (-1, 0, 0).
TEST(Kinematics, OfAContactAreThoseOfTheBottomOfTheSphere) {
    Simulation s;
    s.body = with_moments({1, 1.1, 1.2});
    s.body.spheres = {{.center = {0, 0, -0.2}, .radius = 0.1}};
    s.initial.position = {3, 4, 0.5};
    s.initial.velocity = {0.25, -0.5, -2};
    s.initial.orientation = Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitX());
    s.initial.angular_velocity = {0, 0, 5};
    s.contacts = {{AzadFeatherstoneNormal<>{1e5, 10}, NoFriction<>{}}};
    s.options.end_time = 1e-6;
    const ContactSnapshot c = footfall::run(s).initial.contacts[0];
    EXPECT_EQ(c.phase, Phase::flight);
    EXPECT_NEAR(c.depth, -0.4, 1e-15);
    EXPECT_NEAR(c.depth_rate, 2, 1e-15);
    EXPECT_LE((c.slip_velocity - Eigen::Vector3d(0.25 - 1, -0.5, 0)).norm(), 1e-15);
}

// (36): a ball that rolls has a contact point at rest.
TEST(Kinematics, OfARollingBallHaveNoSlip) {
    Simulation s;
    s.body.mass = 1;
    s.body.inertia = solid_sphere_inertia(1, 0.1);
    s.body.spheres = {{.radius = 0.1}};
    s.ground.normal = {0, 0.6, 0.8};
    s.ground.height = 0.4;
    s.initial.position = (0.4 + 0.1 + 0.01) * s.ground.normal;
    s.initial.velocity = {2, 0, 0};
    // v = omega x r n for rolling: omega = n x v / r.
    s.initial.angular_velocity = s.ground.normal.cross(s.initial.velocity) / 0.1;
    s.contacts = {{AzadFeatherstoneNormal<>{1e5, 10}, NoFriction<>{}}};
    s.options.end_time = 1e-6;
    const ContactSnapshot c = footfall::run(s).initial.contacts[0];
    EXPECT_LE(c.slip_velocity.norm(), 1e-15);
    EXPECT_NEAR(c.depth, -0.01, 1e-15);
    EXPECT_NEAR(c.depth_rate, 0, 1e-15);
}

}  // namespace
}  // namespace footfall
