// What a solver in double precision gives back for the paper's ball.
#pragma once

#include <vector>

#include "paper_sphere.hpp"

namespace oracle {

struct TimedEvent {
    double time;
    EventKind kind;
};

/// A run in double precision, and what it cost.
struct TimedRun {
    std::vector<TimedEvent> events;
    State<double> final{};
    long steps = 0;
    long evaluations = 0;
};

/// What an absolute error in each quantity is measured against: the sizes that it has in the paper's run.
inline constexpr State<double> paper_scale{0.1, 0.1,  0.1,  0.5,  0.5,   0.5,  20,   20,
                                           20,  1e-4, 1e-4, 0.01, 0.001, 0.01, 0.001};

}  // namespace oracle
