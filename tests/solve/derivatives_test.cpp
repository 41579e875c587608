// Derivatives with respect to parameters and initial values, out of the same integration: the methods over dual
// numbers.
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "footfall/math/dual.hpp"
#include "footfall/math/value_of.hpp"
#include "footfall/solve/dormand_prince_853.hpp"
#include "footfall/solve/method.hpp"
#include "footfall/solve/radau.hpp"
#include "solve/turning_stiffness.hpp"

namespace footfall {
namespace {

/// Parameters and start of a system of two components and an integral: numbers that derivatives are taken with respect
/// to.
template <class S>
using Inputs = std::array<S, 3>;
using Slopes = Dual<double, 3>;
using Real = long double;

template <class S>
using State = Eigen::Array<S, 3, 1>;

/// adot = lambda (a - p c), c = cos t by its own equation cdot = -q, qdot = c: stiff for large -lambda.
/// Inputs: lambda, p, a(0).
template <class S>
struct Follower {
    using Y = Eigen::Array<S, 4, 1>;
    static constexpr int motion = 3;
    Inputs<S> in;
    [[nodiscard]] Y start() const {
        Y y;
        y << in[2], S(1), S(0), S(0);
        return y;
    }
    template <class A>
    void rate(const A& y, A& out) const {
        out.resizeLike(y);
        out[0] = in[0] * (y[0] - in[1] * y[1]);
        out[1] = -y[2];
        out[2] = y[1];
        out[3] = y[0];
    }
    template <class A, class M>
    void jacobian(const A&, M& J) const {
        using V = ValueOf<S>;
        const V lambda = value_of(in[0]), p = value_of(in[1]);
        J.setZero(3, 3);
        J(0, 0) = lambda;
        J(0, 1) = -lambda * p;
        J(1, 2) = V(-1);
        J(2, 1) = V(1);
    }
};

/// a(t) in closed form, and its derivatives with respect to lambda, p and a(0), by hand.
Inputs<double> follower_slopes(double lambda, double p, double a0, double t) {
    const double n = 1 + lambda * lambda, e = std::exp(lambda * t);
    const double share = lambda * lambda / n;  // of p cos t
    const double lag = -lambda / n;            // of p sin t
    const double share_slope = 2 * lambda / (n * n), lag_slope = (lambda * lambda - 1) / (n * n);
    return {p * (share_slope * std::cos(t) + lag_slope * std::sin(t)) - p * share_slope * e + (a0 - p * share) * t * e,
            share * std::cos(t) + lag * std::sin(t) - share * e, e};
}

/// Van der Pol's oscillator, x'' = mu^2 ((1 - x^2) x' - x), and the integral of x. Inputs: mu, x(0), x'(0).
template <class S>
struct VanDerPol {
    using Y = State<S>;
    static constexpr int motion = 2;
    Inputs<S> in;
    [[nodiscard]] Y start() const {
        Y y;
        y << in[1], in[2], S(0);
        return y;
    }
    template <class A>
    void rate(const A& y, A& out) const {
        out.resizeLike(y);
        out[0] = y[1];
        out[1] = in[0] * in[0] * ((S(1) - y[0] * y[0]) * y[1] - y[0]);
        out[2] = y[0];
    }
    template <class A, class M>
    void jacobian(const A& y, M& J) const {
        using V = ValueOf<S>;
        const V square = value_of(in[0]) * value_of(in[0]);
        J.resize(2, 2);
        J << V(0), V(1), -square * (V(2) * y[0] * y[1] + V(1)), square * (V(1) - y[0] * y[0]);
    }
};

Inputs<Slopes> variables(const Inputs<double>& in) {
    return {Slopes::variable(in[0], 0), Slopes::variable(in[1], 1), Slopes::variable(in[2], 2)};
}

/// The state after steps of these sizes.
template <class System, class Value>
typename System::Y by_radau(const System& system, const std::vector<double>& steps, const Value& weight) {
    using S = typename System::Y::Scalar;
    using Method = RadauIIA<S>;
    Method method([&](const auto& y, auto& out) { system.rate(y, out); },
                  [&](const auto& y, auto& J) { system.jacobian(y, J); }, System::motion);
    method.begin(system.start());
    for (const double h : steps) {
        method.step(Value(h), Method::Values::Constant(System::Y::SizeAtCompileTime, weight));
        EXPECT_TRUE(std::isfinite(method.error()));
        method.finish();
        method.advance(typename Method::Vector(method.end()));
    }
    return method.start();
}

template <class System>
typename System::Y by_dormand_prince(const System& system, int steps, double h) {
    using S = typename System::Y::Scalar;
    DormandPrince853<typename System::Y, System::motion> method;
    const auto f = [&](const auto& y, auto& out, bool) { system.rate(y, out); };
    method.begin(f, system.start());
    for (int k = 0; k < steps; ++k) {
        method.step(f, ValueOf<S>(h));
        method.finish(f);
        method.advance(typename System::Y(method.end()));
    }
    return method.start();
}

/// Central differences of an integration in long double.
template <class Integrate>
std::array<State<double>, 3> differences(const Inputs<double>& in, const Integrate& integrate) {
    std::array<State<double>, 3> slopes;
    for (std::size_t k = 0; k < 3; ++k) {
        Inputs<Real> up{in[0], in[1], in[2]}, down = up;
        const Real d = 1e-5L * std::abs(up[k]);
        up[k] += d;
        down[k] -= d;
        slopes[k] = ((integrate(up) - integrate(down)) / (up[k] - down[k])).template cast<double>();
    }
    return slopes;
}

/// Component by component, in relation to the component.
template <class Y>
void expect_slopes(const Y& y, const std::array<State<double>, 3>& wanted, double tolerance) {
    for (std::size_t k = 0; k < 3; ++k)
        for (Eigen::Index c = 0; c < 3; ++c)
            EXPECT_NEAR(y[c].gradient[k] / wanted[k][c], 1, tolerance) << "of component " << c << " by input " << k;
}

/// From the layer at the start to the slow motion.
std::vector<double> growing_steps() {
    std::vector<double> steps;
    for (double h = 1e-8; h < 0.02; h *= 2) steps.push_back(h);
    for (int k = 0; k < 20; ++k) steps.push_back(0.02);
    return steps;
}

const Inputs<double> stiff_van_der_pol{1e3, 2, -0.5};

TEST(Derivatives, OfAStiffLinearSystemThroughTheImplicitMethodAreThoseOfTheClosedForm) {
    const Inputs<double> in{-1e6, 0.7, 2};
    const auto y = by_radau(Follower<Slopes>{variables(in)}, std::vector<double>(20, 0.05), 1e12);
    const Inputs<double> wanted = follower_slopes(in[0], in[1], in[2], 1);
    // The layer at the start is not resolved but damped: what is left of a(0) is nothing.
    EXPECT_NEAR(y[0].gradient[0], wanted[0], 1e-16);  // about 6e-13
    EXPECT_NEAR(y[0].gradient[1], wanted[1], 1e-13);
    EXPECT_NEAR(y[0].gradient[2], 0, 1e-13);
}

TEST(Derivatives, OfALinearSystemThroughTheExplicitMethodAreThoseOfTheClosedForm) {
    const Inputs<double> in{-5, 0.7, 2};
    const auto y = by_dormand_prince(Follower<Slopes>{variables(in)}, 40, 0.025);
    const Inputs<double> wanted = follower_slopes(in[0], in[1], in[2], 1);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(y[0].gradient[k], wanted[k], 1e-12) << k;
}

TEST(Derivatives, OfVanDerPolThroughTheImplicitMethodAreItsDifferences) {
    const auto y = by_radau(VanDerPol<Slopes>{variables(stiff_van_der_pol)}, growing_steps(), 1e12);
    expect_slopes(
        y,
        differences(stiff_van_der_pol,
                    [](const Inputs<Real>& in) { return by_radau(VanDerPol<Real>{in}, growing_steps(), 1e16L); }),
        1e-7);
}

// The iteration for the values stops where these are good; that of the derivatives comes later and must go on.
TEST(Derivatives, ConvergeThoughTheValuesHaveConvergedBefore) {
    const auto y = by_radau(VanDerPol<Slopes>{variables(stiff_van_der_pol)}, growing_steps(), 1e5);
    expect_slopes(
        y,
        differences(stiff_van_der_pol,
                    [](const Inputs<Real>& in) { return by_radau(VanDerPol<Real>{in}, growing_steps(), 1e16L); }),
        1e-4);
}

// Slopes of 1e-9, so that rounding shows.
TEST(Derivatives, OfVanDerPolThroughTheExplicitMethodAreItsDifferences) {
    constexpr int steps = 1000;
    constexpr double h = 1e-6;  // h |lambda| = 3
    const auto y = by_dormand_prince(VanDerPol<Slopes>{variables(stiff_van_der_pol)}, steps, h);
    expect_slopes(y,
                  differences(stiff_van_der_pol,
                              [](const Inputs<Real>& in) { return by_dormand_prince(VanDerPol<Real>{in}, steps, h); }),
                  2e-6);
}

/// Where the point of TurningStiffness is after some steps of 0.1.
template <class S>
typename RadauIIA<S>::Vector drawn_onto_a_curve(const S& p, int steps) {
    using Method = RadauIIA<S>;
    using V = ValueOf<S>;
    const test::TurningStiffness<S> rate{.lambda = V(1e8), .p = p};
    const auto jacobian = [&](const auto& y, auto& J) { rate.jacobian(y, J); };
    typename Method::Vector start(3);
    start << S(0), p, S(0);
    Method method(rate, jacobian, 3);
    method.follow_turning(true);
    method.begin(start);
    for (int k = 0; k < steps; ++k) {
        method.step(V(0.1), Method::Values::Constant(3, V(1e8)));
        EXPECT_TRUE(std::isfinite(method.error())) << k;
        method.finish();
        method.advance(typename Method::Vector(method.end()));
    }
    return method.start();
}

TEST(Derivatives, GoThroughStepsWhoseStagesAreSolvedTogether) {
    constexpr int steps = 10;
    const auto plain = drawn_onto_a_curve<double>(2, steps);
    const auto y = drawn_onto_a_curve<Slopes>(Slopes::variable(2, 0), steps);
    for (Eigen::Index c = 0; c < 3; ++c) EXPECT_EQ(plain[c], value_of(y[c])) << c;
    EXPECT_NEAR(y[1].gradient[0], std::cos(0.1 * steps), 1e-6);
    EXPECT_NEAR(y[2].gradient[0], std::sin(0.1 * steps), 1e-6);
}

/// What a run with steps of the method's own choice came to.
template <class Y>
struct Outcome {
    Y end;
    int steps = 0, implicit = 0;
};

template <class S>
Outcome<State<S>> run(const Inputs<S>& in, double end, double tolerance) {
    using Value = ValueOf<S>;
    const VanDerPol<S> system{in};
    const auto f = [&](const State<S>& y, State<S>& out, bool) { system.rate(y, out); };
    const auto J = [&](const auto& y, auto& matrix) { system.jacobian(y, matrix); };
    Method<State<S>, 2, decltype(f), decltype(J)> method(f, J, 2);
    const ValuesOf<State<S>> weight = ValuesOf<State<S>>::Constant(Value(1 / tolerance));
    Value t(0), next(1e-8);
    Outcome<State<S>> outcome;
    method.begin(system.start());
    while (t < Value(end)) {
        const Value h = std::min(next, Value(end) - t);
        method.step(h, weight);
        const Value error = method.error(weight);
        const bool refused = !(error <= Value(1));
        next = h * method.growth(error, refused);
        if (refused) continue;
        t += h;
        ++outcome.steps;
        outcome.implicit += method.implicit() ? 1 : 0;
        method.finish();
        method.advance(State<S>(method.end()), weight);
    }
    outcome.end = method.start();
    return outcome;
}

TEST(Derivatives, DoNotChangeTheWayOfARun) {
    constexpr double end = 0.5, tolerance = 1e-9;
    const auto plain = run<double>(stiff_van_der_pol, end, tolerance);
    const auto dual = run<Slopes>(variables(stiff_van_der_pol), end, tolerance);
    EXPECT_GT(plain.steps, plain.implicit);
    EXPECT_GT(plain.implicit, 10);
    EXPECT_EQ(plain.steps, dual.steps);
    EXPECT_EQ(plain.implicit, dual.implicit);
    for (Eigen::Index c = 0; c < 3; ++c) EXPECT_EQ(plain.end[c], value_of(dual.end[c])) << c;
}

// The method changes between explicit and implicit on the way.
TEST(Derivatives, OfARunThatTurnsStiffAreItsDifferences) {
    constexpr double end = 0.5;
    const auto y = run<Slopes>(variables(stiff_van_der_pol), end, 1e-10).end;
    expect_slopes(
        y, differences(stiff_van_der_pol, [](const Inputs<Real>& in) { return run<Real>(in, end, 1e-13).end; }), 1e-4);
}

}  // namespace
}  // namespace footfall
