#include "footfall/simulate/budget.hpp"

#include <stdexcept>

#include <fmt/core.h>

namespace footfall {

void refuse_cost(double estimate, double rate, const RunOptions& options) {
    throw TooExpensive(fmt::format(
        "the run would need about {:.1e} evaluations of the equations of motion, far more than the {:g} of "
        "max_evaluations: "
        "at rest the contact would swing at {:.1e} rad/s for {:g} s; soften the contact, shorten the run, or raise "
        "max_evaluations",
        estimate, options.max_evaluations, rate, options.end_time));
}

void stop_for_cost(double time, const RunOptions& options) {
    throw TooExpensive(fmt::format(
        "the run needed more than {:g} evaluations of the equations of motion and had reached t = {:g} s of {:g} s; "
        "loosen the tolerance, shorten the run, or raise max_evaluations",
        options.max_evaluations, time, options.end_time));
}

void stop_for_overflow(double time) {
    throw std::runtime_error(fmt::format(
        "the run's numbers overflow at t = {:g} s: its parameters are too far from each other for double precision",
        time));
}

}  // namespace footfall
