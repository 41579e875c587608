// Timing of things side by side: in turns, so that what disturbs the machine disturbs all alike, and in processor
// time, so that other programs do not count.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

#include <time.h>

namespace bench {

/// Processor time of this process so far [s].
inline double processor_time() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The median time of one call of each function [s], over `rounds` rounds in which each has its turn. A turn is as many
/// calls as fill `turn` seconds, so that caches and branch predictors know each function as they do where it runs a
/// million times.
inline std::vector<double> median_times(const std::vector<std::function<void()>>& functions, int rounds,
                                        double turn = 0.01) {
    std::vector<std::vector<double>> times(functions.size());
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < functions.size(); ++i) {
            const double start = processor_time();
            double now = start;
            int calls = 0;
            for (; now < start + turn; ++calls) {
                functions[i]();
                now = processor_time();
            }
            times[i].push_back((now - start) / calls);
        }
    }
    std::vector<double> medians;
    for (auto& t : times) {
        const auto middle = t.begin() + static_cast<std::ptrdiff_t>(t.size() / 2);
        std::nth_element(t.begin(), middle, t.end());
        medians.push_back(*middle);
    }
    return medians;
}

}  // namespace bench
