// Finds the first crossing of any guard inside a step, on the step's interpolant.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

namespace footfall {

/// Where a guard falls through zero.
template <class S>
struct Crossing {
    int guard = -1;   ///< its index; -1: no crossing
    S theta = S(1);   ///< fraction of the step
    S slope = S(-1);  ///< d(guard)/d(theta) there
    explicit operator bool() const noexcept { return guard >= 0; }
};

/// The first zero on (0, 1] of a function that is positive, or meant to be, at 0. Two zeros between the samples
/// are found through the minimum between them. Returns a negative number where there is none.
template <class S, class F>
[[nodiscard]] S first_zero(F&& f, S at_start) {
    constexpr int samples = 8;
    constexpr int bits = std::numeric_limits<S>::digits;
    std::array<S, samples + 1> value;
    value[0] = at_start;
    const auto theta = [](int k) { return S(k) / S(samples); };
    const auto root = [&](S a, S fa, S b, S fb) {
        if (!(fb < S(0))) return b;
        std::uintmax_t iterations = 60;
        const auto r = boost::math::tools::toms748_solve(f, a, b, fa, fb,
                                                         boost::math::tools::eps_tolerance<S>(bits - 4), iterations);
        return (r.first + r.second) / S(2);
    };
    for (int k = 1; k <= samples; ++k) {
        const auto i = static_cast<std::size_t>(k);
        value[i] = f(theta(k));
        if (value[i] < S(0)) {
            S a = theta(k - 1), fa = value[i - 1];
            // A phase that has just begun starts on its boundary, rounding aside: step off it.
            for (S inside = theta(k) / S(64); k == 1 && !(fa > S(0)) && inside > S(1e-9); inside /= S(64)) {
                a = inside;
                fa = f(inside);
            }
            return fa > S(0) ? root(a, fa, theta(k), value[i]) : S(0);
        }
        const bool dips = k >= 2 && value[i - 1] < value[i - 2] && value[i - 1] <= value[i];
        if (dips && value[i - 1] < S(0.5) * std::max(value[i - 2], value[i])) {
            std::uintmax_t iterations = 40;
            const auto lowest = boost::math::tools::brent_find_minima(f, theta(k - 2), theta(k), bits / 2, iterations);
            if (lowest.second < S(0)) return root(theta(k - 2), value[i - 2], lowest.first, lowest.second);
        }
    }
    return S(-1);
}

}  // namespace footfall
