#include "footfall/simulate/budget.hpp"

#include <array>
#include <cmath>
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

double contacts_bytes(std::size_t spheres) noexcept {
    constexpr double header = 16;  // of a block on the heap
    return header + static_cast<double>(spheres) * sizeof(ContactSnapshot);
}

double implicit_bytes(int size) noexcept {
    // Two Jacobians, the scaled one, a real and two complex factorizations, and the matrix that is being factorized.
    constexpr double real_matrices = 4, complex_matrices = 3;
    constexpr double element = sizeof(double);
    return (real_matrices + 2 * complex_matrices) * element * size * size;
}

double sample_count(double period, double end) noexcept { return period > 0 ? std::floor(end / period) + 2 : 2; }

double kept_bytes(const Run& run) noexcept {
    const double contacts = contacts_bytes(run.initial.contacts.size());
    return static_cast<double>(run.samples.size()) * (sizeof(Snapshot) + contacts) +
           static_cast<double>(run.events.size()) * (sizeof(Event) + contacts) +
           static_cast<double>(run.impacts.size()) * sizeof(Impact);
}

std::string bytes_text(double bytes) {
    constexpr std::array units{"bytes", "kB", "MB", "GB", "TB", "PB", "EB"};
    std::size_t unit = 0;
    for (; bytes >= 999.5 && unit + 1 < units.size(); ++unit) bytes /= 1000;
    return fmt::format("{:.3g} {}", bytes, units[unit]);
}

void refuse_memory(double bytes, std::size_t spheres, const RunOptions& options) {
    throw TooExpensive(fmt::format(
        "the run would keep about {} in memory, more than the {} of max_memory: {:.3g} samples of {} {}; choose a "
        "longer sample period, a shorter run or fewer spheres, or raise max_memory",
        bytes_text(bytes), bytes_text(options.max_memory), sample_count(options.sample_period, options.end_time),
        spheres, spheres == 1 ? "sphere" : "spheres"));
}

void stop_for_events(double bytes, std::size_t events, double time, const RunOptions& options) {
    throw TooExpensive(
        fmt::format("the run needed about {} of memory, more than the {} of max_memory: it had kept {} events and had "
                    "reached t = {:g} s of {:g} s; shorten the run, sample less often, or raise max_memory",
                    bytes_text(bytes), bytes_text(options.max_memory), events, time, options.end_time));
}

void stop_for_stiffness(double bytes, std::size_t spheres, double time, const RunOptions& options) {
    throw TooExpensive(fmt::format(
        "the run turned stiff at t = {:g} s of {:g} s, and the implicit method for {} spheres needs about {} of "
        "memory, more than the {} of max_memory; soften the contact, give the body fewer spheres, or raise max_memory",
        time, options.end_time, spheres, bytes_text(bytes), bytes_text(options.max_memory)));
}

void stop_for_machine() {
    throw TooExpensive(
        "the machine has no more memory for the run; sample less often, shorten the run, give the body fewer spheres, "
        "or lower max_memory to what the machine has");
}

void stop_for_search() {
    throw std::runtime_error(
        "the run's numbers cannot be told apart where an event is looked for: its parameters are too far from each "
        "other for double precision");
}

void stop_for_overflow(double time) {
    throw std::runtime_error(fmt::format(
        "the run's numbers overflow at t = {:g} s: its parameters are too far from each other for double precision",
        time));
}

}  // namespace footfall
