// Whether a function that is positive at the ends of a step may come near zero between them.
#pragma once

#include <algorithm>
#include <cmath>

namespace footfall {

/// The places inside a step, as shares of it, at which the explicit method looks at the guards.
inline constexpr double first_look = 1.0 / 3, second_look = 0.65;

/// The least value inside the step of the cubic through the function's values at 0, first_look, second_look and 1, or
/// `enough` where that is less.
template <class Value>
[[nodiscard]] Value least_between(const Value& at_start, const Value& at_first, const Value& at_second,
                                  const Value& at_end, const Value& enough) {
    // As a Bernstein polynomial with the coefficients b: it lies above the least of these.
    constexpr double p = first_look, q = second_look;
    constexpr double p1 = 3 * p * (1 - p) * (1 - p), p2 = 3 * p * p * (1 - p);
    constexpr double q1 = 3 * q * (1 - q) * (1 - q), q2 = 3 * q * q * (1 - q);
    constexpr double determinant = p1 * q2 - p2 * q1;
    const Value f = at_first - Value((1 - p) * (1 - p) * (1 - p)) * at_start - Value(p * p * p) * at_end;
    const Value g = at_second - Value((1 - q) * (1 - q) * (1 - q)) * at_start - Value(q * q * q) * at_end;
    const Value b1 = (f * Value(q2) - g * Value(p2)) / Value(determinant);
    const Value b2 = (g * Value(p1) - f * Value(q1)) / Value(determinant);
    if (!(std::min(b1, b2) < enough)) return enough;
    // Its slope over three, a t^2 + b t + c, rises through zero at the minimum.
    const Value c = b1 - at_start, b = Value(2) * (b2 - b1 - c), a = at_end - Value(3) * b2 + Value(2) * b1 + c;
    const Value square = b * b - Value(4) * a * c;
    if (!(square > Value(0))) return enough;
    const Value root = std::sqrt(square);
    const Value t = b > Value(0) ? Value(-2) * c / (b + root) : (root - b) / (Value(2) * a);
    if (!(t > Value(0) && t < Value(1))) return enough;
    const Value r = Value(1) - t;
    return std::min(enough, r * r * (r * at_start + Value(3) * t * b1) + t * t * (Value(3) * r * b2 + t * at_end));
}

}  // namespace footfall
