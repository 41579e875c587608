// What four values of a function say of its least value between them.
#include "footfall/solve/dip.hpp"

#include <gtest/gtest.h>

namespace footfall {
namespace {

template <class F>
double least(F&& f, double enough) {
    return least_between(f(0.0), f(first_look), f(second_look), f(1.0), enough);
}

TEST(Dip, OfAParabolaIsItsBottom) {
    for (double bottom = 0.05; bottom < 1; bottom += 0.05)
        for (const double height : {-1e-3, 0.0, 1e-3})
            EXPECT_NEAR(least([&](double t) { return (t - bottom) * (t - bottom) + height; }, 1), height, 1e-14);
}

TEST(Dip, OfACubicIsItsBottom) {
    // t (t - 0.6)^2 + 0.01 t, whose slope is (t - 0.6) (3 t - 0.6) + 0.01.
    const auto f = [](double t) { return t * (t - 0.6) * (t - 0.6) + 0.01 * t; };
    const double bottom = (2.4 + std::sqrt(2.4 * 2.4 - 12 * 0.37)) / 6;
    EXPECT_NEAR(least(f, 1), f(bottom), 1e-14);
}

TEST(Dip, IsNoneWhereTheFunctionHasNoMinimumInside) {
    EXPECT_EQ(least([](double t) { return 1 + t; }, 0.1), 0.1);
    EXPECT_EQ(least([](double t) { return 2 - t; }, 0.1), 0.1);
    EXPECT_EQ(least([](double t) { return 1 + t * (1 - t); }, 0.1), 0.1);
    EXPECT_EQ(least([](double t) { return (t + 0.1) * (t + 0.1); }, 0.001), 0.001);
}

}  // namespace
}  // namespace footfall
