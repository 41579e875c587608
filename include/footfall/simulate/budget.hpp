// What keeps a run from its end: a cost above RunOptions::max_evaluations, memory above RunOptions::max_memory, numbers
// that overflow.
#pragma once

#include <new>
#include <stdexcept>
#include <string>

#include <boost/math/policies/error_handling.hpp>

#include "footfall/simulate/run.hpp"

namespace footfall {

/// Throws TooExpensive before a run whose contact, once at rest, would swing at `rate` [rad/s], which makes `estimate`
/// evaluations over the run.
[[noreturn]] void refuse_cost(double estimate, double rate, const RunOptions& options);

/// Throws TooExpensive for a run that has spent its budget at `time` [s].
[[noreturn]] void stop_for_cost(double time, const RunOptions& options);

/// What is kept for one Snapshot's contacts, beside the Snapshot itself [bytes].
[[nodiscard]] double contacts_bytes(std::size_t spheres) noexcept;

/// What the implicit method works on where the motion has `size` components [bytes]: square matrices.
[[nodiscard]] double implicit_bytes(int size) noexcept;

/// How many samples a run keeps that samples every `period` [s] until `end` [s], the first and the last included; 2
/// where the period is 0.
[[nodiscard]] double sample_count(double period, double end) noexcept;

/// What a finished run keeps [bytes].
[[nodiscard]] double kept_bytes(const Run& run) noexcept;

/// "1.2 GB"
[[nodiscard]] std::string bytes_text(double bytes);

/// Throws TooExpensive before a run that would keep `bytes` for its samples.
[[noreturn]] void refuse_memory(double bytes, std::size_t spheres, const RunOptions& options);

/// Throws TooExpensive for a run that has kept so many events until `time` [s] that the next needs `bytes` in all.
[[noreturn]] void stop_for_events(double bytes, std::size_t events, double time, const RunOptions& options);

/// Throws TooExpensive for a run that has turned stiff at `time` [s] and needs `bytes` in all for the implicit method.
[[noreturn]] void stop_for_stiffness(double bytes, std::size_t spheres, double time, const RunOptions& options);

/// Throws TooExpensive for a run that the machine itself has no memory for.
[[noreturn]] void stop_for_machine();

/// What `work` returns, which does a run again; where it throws TooExpensive, that says so.
template <class Work>
auto as_second_attempt(const Work& work) {
    try {
        return work();
    } catch (const TooExpensive& error) {
        throw TooExpensive(
            std::string("done again with smaller steps, since its energy was not accounted for well enough: ") +
            error.what());
    }
}

/// Throws std::runtime_error for a run in which the search for an event or a peak met numbers that are none.
[[noreturn]] void stop_for_search();

/// What `work`, a run, returns. TooExpensive where max_memory allows more than the machine has, and std::runtime_error
/// where the searches for zeros fail, in words that are ours.
template <class Work>
auto in_own_words(const Work& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        stop_for_machine();
    } catch (const std::length_error&) {
        stop_for_machine();
    } catch (const boost::math::evaluation_error&) {
        stop_for_search();
    } catch (const std::domain_error&) {
        stop_for_search();
    }
}

/// Throws std::runtime_error for a run whose numbers are no longer finite at `time` [s].
[[noreturn]] void stop_for_overflow(double time);

}  // namespace footfall
