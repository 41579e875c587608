// The plain number in a scalar: what decisions are made on, such as the size of a step or which side of a guard a state
// is on, so that a run over dual numbers goes the way that the run over their values goes.
#pragma once

#include <concepts>
#include <type_traits>
#include <utility>

#include "footfall/math/dual.hpp"

namespace footfall {

/// A plain number is its own value.
template <std::floating_point T>
[[nodiscard]] constexpr T value_of(const T& x) noexcept {
    return x;
}

/// The number below all derivatives, however deep they are nested.
template <class T, int N>
[[nodiscard]] constexpr auto value_of(const Dual<T, N>& x) noexcept {
    return value_of(x.value);
}

/// double for double and Dual<double, N>, long double for long double and Dual<long double, N>.
template <class S>
using ValueOf = std::remove_cvref_t<decltype(value_of(std::declval<const S&>()))>;

}  // namespace footfall
