// The errors that keep a run from its end: a cost above RunOptions::max_evaluations, numbers that overflow.
#pragma once

#include "footfall/simulate/run.hpp"

namespace footfall {

/// Throws TooExpensive before a run whose contact, once at rest, would swing at `rate` [rad/s], which makes `estimate`
/// evaluations over the run.
[[noreturn]] void refuse_cost(double estimate, double rate, const RunOptions& options);

/// Throws TooExpensive for a run that has spent its budget at `time` [s].
[[noreturn]] void stop_for_cost(double time, const RunOptions& options);

/// Throws std::runtime_error for a run whose numbers are no longer finite at `time` [s].
[[noreturn]] void stop_for_overflow(double time);

}  // namespace footfall
