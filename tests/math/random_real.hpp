// Random reals for properties, spread evenly or over decades.
#pragma once

#include <cmath>
#include <cstdint>

#include <rapidcheck.h>

namespace footfall::test {

/// Evenly in [low, high].
inline rc::Gen<double> uniform(double low, double high) {
    constexpr std::int64_t steps = std::int64_t{1} << 40;
    return rc::gen::map(rc::gen::resize(rc::kNominalSize, rc::gen::inRange<std::int64_t>(0, steps + 1)),
                        [=](std::int64_t i) { return low + (high - low) * static_cast<double>(i) / steps; });
}

/// Evenly in the logarithm, in [low, high], 0 < low.
inline rc::Gen<double> decades(double low, double high) {
    return rc::gen::map(uniform(std::log(low), std::log(high)), [](double x) { return std::exp(x); });
}

}  // namespace footfall::test
