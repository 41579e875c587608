// What long work asks of Python now and then: was Ctrl-C pressed, and does the caller's own function want it to go on?
#pragma once

#include <chrono>
#include <functional>
#include <utility>

#include <nanobind/nanobind.h>

namespace footfall::python {

namespace nb = nanobind;

/// A function for RunOptions::progress, to be called without the GIL; `watch` is None or a function of the time [s]
/// reached whose False ends the run. It throws what Python raises. `watch` must outlive it.
inline std::function<bool(double)> progress_of(const nb::object& watch) {
    using Clock = std::chrono::steady_clock;
    return [&watch, last = Clock::now()](double time) mutable {
        constexpr std::chrono::milliseconds between(20);  // far less often than steps are taken
        const Clock::time_point now = Clock::now();
        if (now - last < between) return true;
        last = now;
        const nb::gil_scoped_acquire gil;
        if (PyErr_CheckSignals() != 0) throw nb::python_error();
        if (watch.is_none()) return true;
        const nb::object answer = watch(time);
        return !answer.is(nb::bool_(false));
    };
}

}  // namespace footfall::python
