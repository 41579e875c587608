// The first place inside a step where a function that starts positive falls through zero.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

namespace footfall {

/// Equal parts of a step at whose ends a function is looked at.
inline constexpr int first_zero_samples = 8;

/// A piece of a step, from 0 to 1, in which a function falls through zero; or nothing.
template <class Value>
struct Bracket {
    Value from = Value(-1), at_from = Value(0);
    Value to = Value(-1), at_to = Value(0);
    explicit operator bool() const noexcept { return !(to < Value(0)); }
};

/// Whether a function with these values, which are as far apart from each other as from the next, may come near zero
/// between them: the value in the middle is low, or the parabola through the three is, where it turns.
template <class Value>
[[nodiscard]] bool dips(const Value& a, const Value& b, const Value& c) {
    if (b < a && b <= c && b < Value(0.5) * std::max(a, c)) return true;
    const Value slope = Value(0.5) * (c - a), bend = a - Value(2) * b + c;
    if (!(a > Value(0) && bend > Value(0) && std::abs(slope) < bend)) return false;
    return b - Value(0.5) * slope * slope / bend < Value(0.1) * std::min(a, c);
}

/// Where a function that is positive, or meant to be, at 0 first falls through zero on (0, 1]. `sample(k)` is its value
/// at k/first_zero_samples, `f(theta)` anywhere. Two zeros between the samples are found through the minimum between
/// them.
template <class Value, class F, class Sample>
[[nodiscard]] Bracket<Value> first_fall(F&& f, Sample&& sample, Value at_start) {
    std::array<Value, first_zero_samples + 1> value;
    value[0] = at_start;
    const auto theta = [](int k) { return Value(k) / Value(first_zero_samples); };
    for (int k = 1; k <= first_zero_samples; ++k) {
        const auto i = static_cast<std::size_t>(k);
        value[i] = sample(k);
        if (value[i] < Value(0)) {
            Value a = theta(k - 1), fa = value[i - 1];
            // A mode that has just begun starts on its boundary, rounding aside: step off it.
            for (Value inside = theta(k) / Value(64); k == 1 && !(fa > Value(0)) && inside > Value(1e-9);
                 inside /= Value(64)) {
                a = inside;
                fa = f(inside);
            }
            if (fa > Value(0)) return {a, fa, theta(k), value[i]};
            // It falls from where it starts, or from a sample on which it is exactly zero.
            return {theta(k - 1), Value(0), theta(k - 1), Value(0)};
        }
        if (k >= 2 && dips<Value>(value[i - 2], value[i - 1], value[i])) {
            std::uintmax_t iterations = 40;
            const auto lowest = boost::math::tools::brent_find_minima(
                f, theta(k - 2), theta(k), std::numeric_limits<Value>::digits / 2, iterations);
            if (lowest.second < Value(0)) return {theta(k - 2), value[i - 2], lowest.first, lowest.second};
        }
    }
    return {};
}

/// The zero of f between a and b, where it has different signs, to so many binary digits.
template <class Value, class F>
[[nodiscard]] Value zero_between(F&& f, Value a, Value b, Value at_a, Value at_b,
                                 int digits = std::numeric_limits<Value>::digits) {
    std::uintmax_t iterations = 60;
    const auto r = boost::math::tools::toms748_solve(f, a, b, at_a, at_b,
                                                     boost::math::tools::eps_tolerance<Value>(digits), iterations);
    return (r.first + r.second) / Value(2);
}

/// The zero in a bracket.
template <class Value, class F>
[[nodiscard]] Value zero_in(const Bracket<Value>& in, F&& f) {
    if (!(in.at_to < Value(0))) return in.to;
    return zero_between(f, in.from, in.to, in.at_from, in.at_to, std::numeric_limits<Value>::digits - 4);
}

/// Both: the first zero, or a negative number where there is none.
template <class Value, class F>
[[nodiscard]] Value first_zero(F&& f, Value at_start) {
    const auto sample = [&](int k) { return f(Value(k) / Value(first_zero_samples)); };
    const Bracket<Value> in = first_fall<Value>(f, sample, at_start);
    return in ? zero_in(in, f) : Value(-1);
}

}  // namespace footfall
