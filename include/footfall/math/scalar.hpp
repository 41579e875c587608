// What the arithmetic of footfall asks of a number: double, long double and dual numbers all do.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <utility>

namespace footfall {

/// A type that the laws and the integrator can compute with: a field with an order and a square root,
/// made from a double. `sqrt`, `pow` and `abs` are found by argument-dependent look-up.
template <class T>
concept Scalar = requires(T a, T b) {
    T(1.0);
    { a + b } -> std::convertible_to<T>;
    { a - b } -> std::convertible_to<T>;
    { a* b } -> std::convertible_to<T>;
    { a / b } -> std::convertible_to<T>;
    { a < b } -> std::convertible_to<bool>;
};

/// `chosen ? a : b`, as a function so that a scalar with lanes can blend. Both sides are computed.
template <class S>
[[nodiscard]] constexpr S select(bool chosen, const S& a, const S& b) noexcept {
    return chosen ? a : b;
}

/// f(0), f(1), ..., f(N - 1), without a loop.
template <int N, class F>
[[gnu::always_inline]] constexpr void unrolled(F&& f) {
    [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) { (f(I), ...); }
    (std::make_integer_sequence<int, N>{});
}

/// x^N for an integer N known at compile time, by multiplication (division where N < 0).
template <int N, class S>
[[nodiscard]] constexpr S power(const S& x) noexcept {
    if constexpr (N < 0) {
        return S(1) / power<-N>(x);
    } else if constexpr (N == 0) {
        return S(1);
    } else if constexpr (N == 1) {
        return x;
    } else {
        const S half = power<N / 2>(x);
        if constexpr (N % 2 == 0) return half * half;
        return half * half * x;
    }
}

}  // namespace footfall
