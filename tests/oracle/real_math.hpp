// Square root, exponential and magnitude for the real types of the oracles: double, long double and, where the
// compiler has it, __float128 (for which the standard library has no functions).
#pragma once

#include <cmath>
#include <limits>

namespace oracle {

inline double sqrt(double x) { return std::sqrt(x); }
inline long double sqrt(long double x) { return std::sqrt(x); }
inline double exp(double x) { return std::exp(x); }
inline long double exp(long double x) { return std::exp(x); }
inline double log(double x) { return std::log(x); }
inline long double log(long double x) { return std::log(x); }

template <class Real>
Real magnitude(const Real& x) {
    return x < Real(0) ? -x : x;
}

template <class Real>
constexpr Real epsilon() {
    return std::numeric_limits<Real>::epsilon();
}

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 Quad;
inline constexpr bool has_quad = true;

template <>
constexpr Quad epsilon<Quad>() {
    Quad e = 1;
    for (int i = 0; i < 112; ++i) e /= 2;
    return e;
}

inline Quad sqrt(Quad x) {
    if (!(x > 0)) return 0;
    Quad root = std::sqrt(static_cast<long double>(x));
    root = (root + x / root) / 2;  // Newton: 64 bits become 113
    return (root + x / root) / 2;
}

inline Quad exp(Quad x) {
    // exp(x) = exp(x / 2^k)^(2^k), with a Taylor series for the small argument.
    int halvings = 0;
    while (magnitude(x) > Quad(1) / 1024) {
        x /= 2;
        ++halvings;
    }
    Quad sum = 0;
    for (int n = 14; n > 0; --n) sum = (sum + 1) * x / n;  // exp(x) - 1 by Horner's rule
    // (1 + a)^2 - 1 = a (2 + a) keeps the digits that squaring 1 + a would lose.
    for (; halvings > 0; --halvings) sum = sum * (2 + sum);
    return sum + 1;
}

inline Quad log(Quad x) {
    Quad y = std::log(static_cast<long double>(x));
    for (int i = 0; i < 2; ++i) y += x * exp(-y) - 1;  // Newton on exp(y) = x
    return y;
}
#else
using Quad = long double;
inline constexpr bool has_quad = false;
#endif

}  // namespace oracle
