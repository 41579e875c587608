// Dual numbers against derivatives known in closed form and against differences taken in long double.
#include "footfall/math/dual.hpp"

#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "footfall/eigen/interop.hpp"
#include "footfall/math/scalar.hpp"
#include "footfall/math/vector.hpp"
#include "math/random_real.hpp"

namespace footfall {
namespace {

using test::uniform;
using Dual1 = Dual<double, 1>;
using Dual2 = Dual<double, 2>;
using Dual3 = Dual<double, 3>;

static_assert(Scalar<Dual1>);
static_assert(Scalar<Dual<float, 7>>);
static_assert(Scalar<Dual<Dual2, 2>>);

/// A derivative by central differences in long double, extrapolated once: error of order h^4, about 1e-13.
template <class F>
long double difference(const F& f, long double x) {
    const auto central = [&](long double h) { return (f(x + h) - f(x - h)) / (2 * h); };
    const long double h = 1e-4L * (1 + std::abs(x));
    return (4 * central(h / 2) - central(h)) / 3;
}

/// Holds `f` on duals against the same `f` on double (value) and on long double (slope).
template <class F>
void expect_same_value_and_slope(const F& f, double x) {
    const Dual1 y = f(Dual1::variable(x, 0));
    RC_ASSERT(y.value == f(x));
    const auto slope = static_cast<double>(difference(f, x));
    RC_ASSERT(std::abs(y.gradient[0] - slope) <= 1e-9 * (1 + std::abs(slope)));
}

RC_GTEST_PROP(Dual, ElementaryFunctionsHaveTheValueOfDoubleAndTheSlopeOfADifference, ()) {
    using std::abs, std::cos, std::exp, std::log, std::pow, std::sin, std::sqrt, std::tanh;
    const double any = *uniform(-3, 3);
    const double positive = *uniform(0.05, 5);
    expect_same_value_and_slope([](auto x) { return exp(x); }, any);
    expect_same_value_and_slope([](auto x) { return sin(x); }, any);
    expect_same_value_and_slope([](auto x) { return cos(x); }, any);
    expect_same_value_and_slope([](auto x) { return tanh(x); }, any);
    expect_same_value_and_slope([](auto x) { return sqrt(x); }, positive);
    expect_same_value_and_slope([](auto x) { return log(x); }, positive);
    expect_same_value_and_slope([](auto x) { return abs(x); }, positive);
    expect_same_value_and_slope([](auto x) { return abs(x); }, -positive);
    expect_same_value_and_slope([](auto x) { return pow(x, decltype(x)(1.7)); }, positive);
    expect_same_value_and_slope([](auto x) { return pow(x, 3); }, any);
    expect_same_value_and_slope([](auto x) { return pow(decltype(x)(0.3), x); }, any);
    expect_same_value_and_slope([](auto x) { return pow(x, x); }, positive);
}

RC_GTEST_PROP(Dual, ArithmeticHasTheValueOfDoubleAndTheSlopeOfADifference, ()) {
    const double x = *uniform(0.5, 4);
    const double c = *uniform(-4, 4);
    expect_same_value_and_slope([c](auto v) { return v * v + v * c - c / v + v / 3.0; }, x);
    expect_same_value_and_slope([c](auto v) { return (c - v) / (v + v * v) - (v - c) * (c * v); }, x);
    expect_same_value_and_slope([c](auto v) { return -v + (c + v) * (+v) - 1 / v + 2 * v; }, x);
    expect_same_value_and_slope(
        [c](auto v) {
            auto a = v;
            a += v * v;
            a -= c;
            a *= v;
            a /= v + 1;
            return a;
        },
        x);
}

RC_GTEST_PROP(Dual, GradientHoldsEveryPartialDerivative, ()) {
    const double x = *uniform(0.5, 2), y = *uniform(-2, 2), z = *uniform(0.5, 2);
    const Dual3 f = Dual3::variable(x, 0) * sin(Dual3::variable(y, 1)) / Dual3::variable(z, 2);
    const auto near = [](double a, double b) { return std::abs(a - b) <= 1e-14 * (1 + std::abs(b)); };
    RC_ASSERT(near(f.gradient[0], std::sin(y) / z));
    RC_ASSERT(near(f.gradient[1], x * std::cos(y) / z));
    RC_ASSERT(near(f.gradient[2], -x * std::sin(y) / (z * z)));
}

RC_GTEST_PROP(Dual, PowerOfTwoVariablesHasBothPartialDerivatives, ()) {
    const double x = *uniform(0.1, 4), e = *uniform(-3, 3);
    const Dual2 p = pow(Dual2::variable(x, 0), Dual2::variable(e, 1));
    const double by_base = e * std::exp((e - 1) * std::log(x)), by_exponent = std::log(x) * std::exp(e * std::log(x));
    RC_ASSERT(std::abs(p.gradient[0] - by_base) <= 1e-12 * (1 + std::abs(by_base)));
    RC_ASSERT(std::abs(p.gradient[1] - by_exponent) <= 1e-12 * (1 + std::abs(by_exponent)));
}

RC_GTEST_PROP(Dual, ComparesByValueAlone, ()) {
    const double a = *uniform(-1, 1);
    const double b = *rc::gen::oneOf(uniform(-1, 1), rc::gen::just(a));
    const Dual2 x(a, {5, -1}), y(b, {-7, 2});
    RC_ASSERT((x < y) == (a < b));
    RC_ASSERT((x > y) == (a > b));
    RC_ASSERT((x <= y) == (a <= b));
    RC_ASSERT((x >= y) == (a >= b));
    RC_ASSERT((x == y) == (a == b));
    RC_ASSERT((x != y) == (a != b));
    RC_ASSERT((x < b) == (a < b));
    RC_ASSERT((a < y) == (a < b));
}

TEST(Dual, ConstantsHaveNoDerivative) {
    EXPECT_EQ(Dual2().value, 0);
    for (const Dual2& c : {Dual2(), Dual2(3.0), Dual2(3), Dual2(3.0F)}) EXPECT_EQ(c.gradient, (std::array{0.0, 0.0}));
    EXPECT_EQ(Dual2::variable(3, 1).gradient, (std::array{0.0, 1.0}));
}

TEST(Dual, RootAtZeroMovesOnlyWithInputsThatMoveItsArgument) {
    const Dual2 root = sqrt(Dual2(0.0, {0.0, 2.0}));
    EXPECT_EQ(root.value, 0);
    EXPECT_EQ(root.gradient[0], 0);
    EXPECT_EQ(root.gradient[1], std::numeric_limits<double>::infinity());
}

TEST(Dual, PowersAtZeroAreAsSmoothAsTheyShouldBe) {
    const auto x = Dual2::variable(0, 0);
    EXPECT_EQ(pow(x, 1.5).gradient[0], 0);
    EXPECT_EQ(pow(x, 1).gradient[0], 1);
    EXPECT_EQ(pow(x, 0).gradient[0], 0);
    EXPECT_EQ(pow(x, Dual2(1.5)).gradient, (std::array{0.0, 0.0}));
    EXPECT_EQ(pow(x, Dual2::variable(2, 1)).gradient, (std::array{0.0, 0.0}));
    EXPECT_EQ(pow(x, 0.5).gradient[0], std::numeric_limits<double>::infinity());
    EXPECT_EQ(pow(x, 0.5).gradient[1], 0);
}

TEST(Dual, AWholePowerOfANegativeNumberHasADerivativeWhereTheExponentIsConstant) {
    const Dual1 p = pow(Dual1::variable(-2, 0), Dual1(3));
    EXPECT_DOUBLE_EQ(p.value, -8);
    EXPECT_DOUBLE_EQ(p.gradient[0], 12);
}

TEST(Dual, APowerThatUnderflowsKeepsItsDerivative) {
    // x^1.6 at 1e-220 underflows; 1.6 x^0.6 does not.
    const Dual1 p = pow(Dual1::variable(1e-220, 0), 1.6);
    EXPECT_NEAR(p.gradient[0] / 1.6e-132, 1, 1e-12);
}

TEST(Dual, IsFiniteLooksAtTheGradientToo) {
    const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(isfinite(Dual2(1, {2, 3})));
    EXPECT_FALSE(isfinite(Dual2(infinity, {2, 3})));
    EXPECT_FALSE(isfinite(Dual2(1, {nan, 3})));
    EXPECT_FALSE(isfinite(Dual2(1, {2, -infinity})));
}

TEST(Dual, NestsForSecondDerivatives) {
    using Dual11 = Dual<Dual1, 1>;
    const Dual11 x = Dual11::variable(Dual1::variable(0.7, 0), 0);
    const Dual11 y = 2 * x * x * x + sin(x) / 3.0;
    EXPECT_NEAR(y.gradient[0].value, 6 * 0.49 + std::cos(0.7) / 3, 1e-15);
    EXPECT_NEAR(y.gradient[0].gradient[0], 12 * 0.7 - std::sin(0.7) / 3, 1e-15);
}

TEST(Dual, IsAScalarOfVectors) {
    const Vector3<Dual3> x(Dual3::variable(1, 0), Dual3::variable(2, 1), Dual3::variable(2, 2));
    const Dual3 length = x.norm();  // 3, with gradient x / |x|
    EXPECT_DOUBLE_EQ(length.value, 3);
    EXPECT_DOUBLE_EQ(length.gradient[0], 1.0 / 3);
    EXPECT_DOUBLE_EQ(length.gradient[1], 2.0 / 3);
    const Vector3<double> a(3, -1, 4);
    const Vector3<Dual3> cross = (2.0 * a).cast<Dual3>().cross(x);  // d(a x X)/dX = [a]x
    EXPECT_DOUBLE_EQ(cross[2].gradient[1], 2 * a[0]);
    EXPECT_DOUBLE_EQ(cross[2].gradient[0], -2 * a[1]);
    EXPECT_DOUBLE_EQ((2.0 * x)[1].gradient[1], 2);
    // A quarter turn about z takes (x, y, z) to (-y, x, z).
    const double half = std::sqrt(0.5);
    const Vector3<Dual3> turned = rotation_of<double>(half, 0, 0, half).cast<Dual3>() * x;
    EXPECT_NEAR(turned[0].gradient[1], -1, 1e-15);
    EXPECT_NEAR(turned[1].gradient[0], 1, 1e-15);
    const Vector3<Dual3> back = rotation_of<double>(half, 0, 0, half).cast<Dual3>().transposed_times(turned);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(back[i].value, x[i].value, 4e-15);  // the root of 1/2 is rounded
}

TEST(Dual, IsAScalarForEigen) {
    const Vector3<Dual3> x(Dual3::variable(1, 0), Dual3::variable(2, 1), Dual3::variable(2, 2));
    const Eigen::Matrix<Dual3, 3, 1> column = to_eigen(x);
    EXPECT_DOUBLE_EQ(column.norm().gradient[1], 2.0 / 3);
    EXPECT_DOUBLE_EQ((2.0 * column)[1].gradient[1], 2);
    // A quarter turn about z takes (x, y, z) to (-y, x, z).
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(std::acos(-1.0) / 2, Eigen::Vector3d::UnitZ()));
    const Vector3<Dual3> turned = from_eigen<Dual3>(turn.cast<Dual3>() * column);
    EXPECT_NEAR(turned[0].gradient[1], -1, 1e-15);
    EXPECT_NEAR(turned[1].gradient[0], 1, 1e-15);
}

}  // namespace
}  // namespace footfall
