// Where a function first falls through zero inside a step.
#include "footfall/solve/first_zero.hpp"

#include <gtest/gtest.h>

namespace footfall {
namespace {

TEST(FirstZero, OnASampleIsThere) {
    for (int k = 1; k < first_zero_samples; ++k) {
        const double zero = static_cast<double>(k) / first_zero_samples;
        EXPECT_EQ(first_zero<double>([&](double x) { return zero - x; }, zero), zero) << k;
    }
}

TEST(FirstZero, OfAFunctionThatStartsOnZeroIsWhereItFallsLater) {
    for (const double zero : {1e-6, 1e-3, 0.1, 0.5, 0.99})
        EXPECT_NEAR(first_zero<double>([&](double x) { return x * (zero - x); }, 0), zero, 1e-15) << zero;
}

TEST(FirstZero, OfAFunctionThatFallsFromZeroIsItsStart) {
    EXPECT_EQ(first_zero<double>([](double x) { return -x; }, 0), 0);
}

TEST(FirstZero, IsTheFirstOfTwoBetweenTwoSamples) {
    EXPECT_NEAR(first_zero<double>([](double x) { return (x - 0.30) * (x - 0.32); }, 0.096), 0.30, 1e-15);
}

TEST(FirstZero, IsNoneWhereNothingFalls) {
    EXPECT_LT(first_zero<double>([](double x) { return (x - 0.3) * (x - 0.3) + 1e-9; }, 0.09), 0);
}

}  // namespace
}  // namespace footfall
