// The errors of a run that costs more than RunOptions::max_evaluations allows.
#pragma once

#include "footfall/simulate/run.hpp"

namespace footfall {

/// Throws TooExpensive before a run whose contact, once at rest, would swing at `rate` [rad/s], which makes `estimate`
/// evaluations over the run.
[[noreturn]] void refuse_cost(double estimate, double rate, const RunOptions& options);

/// Throws TooExpensive for a run that has spent its budget at `time` [s].
[[noreturn]] void stop_for_cost(double time, const RunOptions& options);

}  // namespace footfall
