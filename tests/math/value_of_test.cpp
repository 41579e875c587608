// The plain number in every scalar that the library computes with.
#include "footfall/math/value_of.hpp"

#include <type_traits>

#include <gtest/gtest.h>

namespace footfall {
namespace {

TEST(ValueOf, APlainNumberIsItself) {
    EXPECT_EQ(value_of(0.1), 0.1);
    EXPECT_EQ(value_of(0.1L), 0.1L);
    static_assert(std::is_same_v<ValueOf<double>, double> && std::is_same_v<ValueOf<long double>, long double>);
}

TEST(ValueOf, OfADualNumberIsTheNumberBelowAllDerivatives) {
    using Once = Dual<long double, 3>;
    using Twice = Dual<Dual<double, 2>, 1>;
    EXPECT_EQ(value_of(Once::variable(0.1L, 1)), 0.1L);
    EXPECT_EQ(value_of(Twice::variable(Dual<double, 2>::variable(7.0, 0), 0)), 7.0);
    static_assert(std::is_same_v<ValueOf<Once>, long double> && std::is_same_v<ValueOf<Twice>, double>);
}

}  // namespace
}  // namespace footfall
