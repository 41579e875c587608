// The implicit method on systems whose solutions are known in closed form.
#include "footfall/solve/radau.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "solve/turning_stiffness.hpp"

namespace footfall {
namespace {

using Real = long double;
using Method = RadauIIA<Real>;

/// y = (a, c, s, A): adot = a (1 - a), (c, s) on the unit circle, and A the integral of a + c.
struct Known {
    static void rate(const Method::Vector& y, Method::Vector& out) {
        out.resize(4);
        out << y[0] * (1 - y[0]), -y[2], y[1], y[0] + y[1];
    }
    static void jacobian(const Method::Vector& y, Method::Matrix& J) {
        J.setZero(3, 3);
        J(0, 0) = 1 - 2 * y[0];
        J(1, 2) = -1;
        J(2, 1) = 1;
    }
    static Method::Vector at(Real t) {
        Method::Vector y(4);
        y << 1 / (1 + std::exp(-t)), std::cos(t), std::sin(t), std::log((1 + std::exp(t)) / 2) + std::sin(t);
        return y;
    }
    static Method method() { return Method(rate, jacobian, 3); }
};

// The iteration stops a thousandth below what the weights allow.
Method::Vector fine() { return Method::Vector::Constant(4, 1e17L); }

/// Integrates to time 4 and returns the largest error of the implicit components and that of the integral.
std::pair<Real, Real> errors_after(int steps) {
    Method method = Known::method();
    const Real h = 4.0L / steps;
    method.begin(Known::at(0));
    for (int k = 0; k < steps; ++k) {
        method.step(h, fine());
        method.finish();
        method.advance(Method::Vector(method.end()));
    }
    const Method::Vector difference = (method.start() - Known::at(4)).abs();
    return {difference.head(3).maxCoeff(), difference[3]};
}

template <class Error>
double mean_slope(const Error& error, Real first, int halvings) {
    return static_cast<double>(std::log2(error(first) / error(std::ldexp(first, -halvings)))) / halvings;
}

TEST(RadauIIA, IsOfOrderNineInItsImplicitComponents) {
    EXPECT_NEAR(mean_slope([](Real h) { return errors_after(static_cast<int>(std::lround(4 / h))).first; }, 0.5L, 2), 9,
                0.3);
}

TEST(RadauIIA, IsOfOrderNineInItsIntegrals) {
    EXPECT_NEAR(mean_slope([](Real h) { return errors_after(static_cast<int>(std::lround(4 / h))).second; }, 0.5L, 2),
                9, 0.3);
}

// The collocation polynomial has degree 5: inside the step it is wrong by h^6.
TEST(RadauIIA, DenseOutputIsOfOrderFive) {
    for (const Real theta : {0.2L, 0.45L, 0.8L}) {
        const auto error = [&](Real h) {
            Method method = Known::method();
            method.begin(Known::at(0.3L));
            method.step(h, fine());
            method.finish();
            return (method.at(theta) - Known::at(0.3L + theta * h)).abs().maxCoeff();
        };
        EXPECT_NEAR(mean_slope(error, 0.25L, 3), 6, 0.3) << static_cast<double>(theta);
    }
}

TEST(RadauIIA, DenseOutputMeetsBothEnds) {
    Method method = Known::method();
    method.begin(Known::at(0));
    method.step(0.5L, fine());
    EXPECT_LE((method.at(0) - method.start()).abs().maxCoeff(), 1e-18L);
    EXPECT_LE((method.at(1) - method.end()).abs().maxCoeff(), 1e-18L);
    for (Eigen::Index c = 0; c < 4; ++c) EXPECT_LE(std::abs(method.at(0.3L, c) - method.at(0.3L)[c]), 1e-18L);
}

TEST(RadauIIA, ErrorEstimateFallsWithTheSixthPowerOfTheStep) {
    const auto estimate = [](Real h) {
        Method method = Known::method();
        method.begin(Known::at(0.3L));
        method.step(h, fine());
        return method.error();
    };
    EXPECT_NEAR(mean_slope(estimate, 0.25L, 3), Method::estimate_order + 1, 0.3);
}

TEST(RadauIIA, ErrorEstimateIsNotBelowTheError) {
    Method method = Known::method();
    for (const Real h : {2.0L, 1.0L, 0.5L, 0.1L}) {
        method.begin(Known::at(0));
        method.step(h, fine());
        EXPECT_GE(method.error(), (method.end() - Known::at(h)).abs().maxCoeff() * 1e17L) << static_cast<double>(h);
    }
}

// ydot = lambda (y - c), (c, s) on the unit circle: for h lambda = -1e9 y must follow c, and y's own error must vanish
// in one step, as the method's stability function vanishes at infinity.
TEST(RadauIIA, ForgetsAStiffTransientInOneStep) {
    const Real lambda = -1e10L;
    Method method(
        [&](const Method::Vector& y, Method::Vector& out) {
            out.resize(4);
            out << lambda * (y[0] - y[1]), -y[2], y[1], y[0];
        },
        [&](const Method::Vector&, Method::Matrix& J) {
            J.setZero(3, 3);
            J(0, 0) = lambda;
            J(0, 1) = -lambda;
            J(1, 2) = -1;
            J(2, 1) = 1;
        },
        3);
    Method::Vector y(4);
    y << 2, 1, 0, 0;
    method.begin(y);
    method.step(0.1L, Method::Vector::Constant(4, 1e12L));
    EXPECT_NEAR(static_cast<double>(method.end()[0] - std::cos(0.1L)), 0, 1e-8);
}

// A point is drawn fast onto a curve, in a direction that turns with the point itself: u = (2 + sin 3t)(cos p, sin p),
// pdot = 1, written as udot = p' x u + rdot u/|u| - lambda (|u| - r) u/|u|, which does not depend on the frame.
TEST(RadauIIA, StridesWhereItsStiffDirectionTurns) {
    const test::TurningStiffness<Real> rate{.lambda = 1e10L, .p = 2};
    const auto jacobian = [&](const Method::Vector& y, Method::Matrix& J) { rate.jacobian(y, J); };
    const Method::Vector weight = Method::Vector::Constant(3, 1e10L);
    Method::Vector start(3);
    start << 0, 2, 0;
    Method method(rate, jacobian, 3);
    method.begin(start);
    method.step(0.1L, weight);
    EXPECT_FALSE(std::isfinite(method.error()));
    method.follow_turning(true);
    method.begin(start);
    for (int k = 1; k <= 20; ++k) {
        method.step(0.1L, weight);
        ASSERT_TRUE(std::isfinite(method.error())) << k;
        const Real t = 0.1L * k, r = 2 + std::sin(3 * t);
        EXPECT_NEAR(static_cast<double>(method.end()[1] - r * std::cos(t)), 0, 1e-6) << k;
        EXPECT_NEAR(static_cast<double>(method.end()[2] - r * std::sin(t)), 0, 1e-6) << k;
        method.finish();
        method.advance(Method::Vector(method.end()));
    }
}

TEST(RadauIIA, StaysWhereItIsInAStepOfNoSize) {
    Method method = Known::method();
    method.begin(Known::at(0));
    method.step(0, fine());
    method.finish();
    EXPECT_EQ(method.error(), 0);
    EXPECT_TRUE((method.end() == Known::at(0)).all());
    EXPECT_TRUE((method.end_rate() == method.start_rate()).all());
}

TEST(RadauIIA, SaysSoWhereItsIterationCannotConverge) {
    Method method(
        [](const Method::Vector&, Method::Vector& out) { out.setConstant(2, std::numeric_limits<Real>::quiet_NaN()); },
        [](const Method::Vector&, Method::Matrix& J) { J.setZero(1, 1); }, 1);
    method.begin(Method::Vector::Zero(2));
    method.step(1, Method::Vector::Constant(2, 1e12L));
    EXPECT_FALSE(method.error() <= 1);
}

}  // namespace
}  // namespace footfall
