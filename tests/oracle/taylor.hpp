// Taylor-series steps: the solution over a step is a polynomial whose coefficients come from recurrences of the
// equations, so the order is whatever the precision deserves and an event is a root of something known everywhere.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "real_math.hpp"

namespace oracle {

/// Coefficients a_0 .. a_order of one quantity.
template <class Real>
using Series = std::vector<Real>;

/// Coefficient k of the product.
template <class Real>
Real product(const Series<Real>& a, const Series<Real>& b, std::size_t k) {
    Real sum = 0;
    for (std::size_t j = 0; j <= k; ++j) sum += a[j] * b[k - j];
    return sum;
}

/// Coefficient k of a / b, given those of the quotient below k.
template <class Real>
Real quotient(const Series<Real>& a, const Series<Real>& b, const Series<Real>& q, std::size_t k) {
    Real sum = a[k];
    for (std::size_t j = 0; j < k; ++j) sum -= q[j] * b[k - j];
    return sum / b[0];
}

/// Coefficient k of sqrt(a), given those of the root below k.
template <class Real>
Real root(const Series<Real>& a, const Series<Real>& q, std::size_t k) {
    if (k == 0) return sqrt(a[0]);
    Real sum = a[k];
    for (std::size_t j = 1; j < k; ++j) sum -= q[j] * q[k - j];
    return sum / (2 * q[0]);
}

template <class Real>
Real evaluate(const Series<Real>& a, const Real& x) {
    Real sum = 0;
    for (std::size_t k = a.size(); k-- > 0;) sum = sum * x + a[k];
    return sum;
}

template <class Real, std::size_t N>
std::array<Real, N> evaluate(const std::array<Series<Real>, N>& a, const Real& x) {
    std::array<Real, N> y;
    for (std::size_t i = 0; i < N; ++i) y[i] = evaluate(a[i], x);
    return y;
}

/// The largest x (in steps of 5 % below `longest`) at which the last terms of every series are below `tolerance` times
/// its scale. Eight terms, because an equation may leave gaps in its series.
template <class Real, std::size_t N>
Real step_size(const std::array<Series<Real>, N>& a, const std::array<Real, N>& scale, Real tolerance, Real longest) {
    Real x = longest;
    for (std::size_t i = 0; i < N; ++i) {
        const std::size_t first = a[i].size() - 8;
        auto tail = [&] {
            Real power = 1, largest = 0;
            for (std::size_t k = 0; k < first; ++k) power *= x;
            for (std::size_t k = first; k < a[i].size(); ++k) {
                largest = std::max(largest, Real(magnitude(a[i][k]) * power));
                power *= x;
            }
            return largest;
        };
        while (tail() > tolerance * scale[i]) x *= Real(0.95);
    }
    return x;
}

/// The first x in (0, end] where `guard`, positive at first, is no longer positive; to the last bit. It may be zero
/// at 0. Dips between the points that it looks at are searched for.
template <class Real, class Guard>
std::optional<Real> first_fall(const Guard& guard, Real end) {
    constexpr int points = 24;
    std::array<Real, points + 1> x, value;
    for (int i = 0; i <= points; ++i) {
        x[i] = end * i / points;
        value[i] = guard(x[i]);
    }
    auto bisect = [&](Real above, Real below) {
        for (;;) {
            const Real middle = (above + below) / 2;
            if (!(middle > above && middle < below)) return below;
            (guard(middle) > 0 ? above : below) = middle;
        }
    };
    for (int i = 1; i <= points; ++i) {
        if (!(value[i] > 0)) return bisect(x[i - 1], x[i]);
        if (i < 2 || !(value[i - 1] < value[i - 2]) || !(value[i - 1] < value[i])) continue;
        Real a = x[i - 2], b = x[i];  // a minimum is in between: does it go below zero?
        for (int n = 0; n < 60; ++n) {
            const Real left = a + (b - a) * Real(0.382), right = a + (b - a) * Real(0.618);
            const Real at_left = guard(left), at_right = guard(right);
            if (!(at_left > 0)) return bisect(x[i - 2], left);
            if (!(at_right > 0)) return bisect(x[i - 2], right);
            (at_left < at_right ? b : a) = at_left < at_right ? right : left;
        }
    }
    return std::nullopt;
}

}  // namespace oracle
