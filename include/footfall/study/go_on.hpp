// How a caller ends a study that takes long.
#pragma once

#include <functional>

#include "footfall/simulate/run.hpp"

namespace footfall {

/// Called now and then during a study, as RunOptions::progress is during a run; returning false ends the study with
/// Interrupted. Empty: it goes on to its end.
using GoOn = std::function<bool()>;

/// Throws Interrupted where the caller wants no more.
inline void ask(const GoOn& go_on) {
    if (go_on && !go_on()) throw Interrupted("the study was interrupted");
}

/// The same question for the runs that a study is made of.
[[nodiscard]] inline std::function<bool(double)> progress_of(const GoOn& go_on) {
    if (!go_on) return nullptr;
    return [&go_on](double /*time*/) { return go_on(); };
}

}  // namespace footfall
