// The change between the explicit and the implicit method.
#include "footfall/solve/method.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace footfall {
namespace {

using State = Eigen::ArrayXd;

/// n - 2 components that follow cos t at the rate -lambda, y' = lambda (y - cos t), and (cos t, sin t) itself.
struct Followers {
    int n;
    double lambda;
    [[nodiscard]] State start() const {
        State y = State::Ones(n);
        y[n - 1] = 0;
        return y;
    }
    void rate(const State& y, State& out) const {
        out = lambda * (y - y[n - 2]);
        out[n - 2] = -y[n - 1];
        out[n - 1] = y[n - 2];
    }
    void jacobian(const State&, Eigen::MatrixXd& J) const {
        J = lambda * Eigen::MatrixXd::Identity(n, n);
        J.col(n - 2).setConstant(-lambda);
        J.bottomRows(2).setZero();
        J(n - 2, n - 1) = -1;
        J(n - 1, n - 2) = 1;
    }
    [[nodiscard]] Eigen::VectorXd along(const State&, const Eigen::VectorXd& v) const {
        Eigen::VectorXd out = lambda * (v.array() - v[n - 2]).matrix();
        out[n - 2] = -v[n - 1];
        out[n - 1] = v[n - 2];
        return out;
    }
};

struct Outcome {
    int steps = 0, implicit = 0;
    int first_implicit = 0;  // step
    State end;
};

/// Takes steps of the method's own choice until a time.
template <class Method>
Outcome follow(Method& method, const Followers& system, double end, double tolerance) {
    const State weight = State::Constant(system.n, 1 / tolerance);
    Outcome outcome;
    double t = 0, next = 1e-6;
    method.begin(system.start());
    while (t < end) {
        const double h = std::min(next, end - t);
        method.step(h, weight);
        const double error = method.error(weight);
        const bool refused = !(error <= 1);
        next = h * method.growth(error, refused);
        if (refused) continue;
        t += h;
        ++outcome.steps;
        if (method.implicit() && outcome.implicit++ == 0) outcome.first_implicit = outcome.steps;
        method.finish();
        method.advance(State(method.end()), weight);
    }
    outcome.end = method.start();
    return outcome;
}

Outcome by_jacobian(const Followers& system, double end, double tolerance) {
    const auto f = [&](const State& y, State& out, bool) { system.rate(y, out); };
    const auto J = [&](const State& y, Eigen::MatrixXd& matrix) { system.jacobian(y, matrix); };
    Method<State, Eigen::Dynamic, decltype(f), decltype(J)> method(f, J, system.n);
    return follow(method, system, end, tolerance);
}

/// With derivatives along vectors; counts how often either is asked for.
Outcome by_products(const Followers& system, double end, double tolerance, int& jacobians, int& products) {
    const auto f = [&](const State& y, State& out, bool) { system.rate(y, out); };
    const auto J = [&](const State& y, Eigen::MatrixXd& matrix) {
        ++jacobians;
        system.jacobian(y, matrix);
    };
    const auto D = [&](const State& y, const Eigen::VectorXd& v) {
        ++products;
        return system.along(y, v);
    };
    Method<State, Eigen::Dynamic, decltype(f), decltype(J), decltype(D)> method(f, J, system.n, D);
    return follow(method, system, end, tolerance);
}

TEST(Method, LooksForStiffnessByDerivativesAlongVectorsAlone) {
    int jacobians = 0, products = 0;
    // Slow, so that no step is implicit.
    const Outcome outcome = by_products({10, -1}, 60, 1e-14, jacobians, products);
    EXPECT_GT(outcome.steps, 256);
    EXPECT_EQ(outcome.implicit, 0);
    EXPECT_EQ(jacobians, 0);
    EXPECT_GT(products, 0);
}

TEST(Method, TurnsImplicitAtTheSameStepByJacobianAndByProducts) {
    const Followers system{10, -1e5};
    int jacobians = 0, products = 0;
    const Outcome one = by_jacobian(system, 1, 1e-8), other = by_products(system, 1, 1e-8, jacobians, products);
    EXPECT_GT(one.implicit, 0);
    EXPECT_EQ(one.first_implicit, other.first_implicit);
    EXPECT_EQ(one.steps, other.steps);
    EXPECT_NEAR(other.end[0], std::cos(1.0), 1e-4);
}

// An implicit step is here about 100 explicit ones long: worth its price for a small system, not for a large one.
TEST(Method, StaysImplicitOnlyWhereTheSizeOfTheSystemAllowsIt) {
    const double lambda = -3000, end = 6, tolerance = 1e-6;
    const Outcome small = by_jacobian({10, lambda}, end, tolerance), large = by_jacobian({200, lambda}, end, tolerance);
    EXPECT_LT(small.steps, 1000);
    EXPECT_GT(large.steps, 1000);
    EXPECT_GT(large.implicit, 0);
    EXPECT_LT(large.implicit, 20);
    for (const Outcome& outcome : {small, large}) EXPECT_NEAR(outcome.end[0], std::cos(end), 1e-3);
}

}  // namespace
}  // namespace footfall
