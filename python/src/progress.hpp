// What long work asks of Python now and then: was Ctrl-C pressed, and does the caller's own function want it to go on?
#pragma once

#include <chrono>
#include <functional>
#include <utility>

#include <nanobind/nanobind.h>

namespace footfall::python {

namespace nb = nanobind;

/// Whether it is time to ask again: fifty times a second, far less often than steps are taken.
class Pace {
public:
    [[nodiscard]] bool due() {
        constexpr std::chrono::milliseconds between(20);
        const Clock::time_point now = Clock::now();
        if (now - last_ < between) return false;
        last_ = now;
        return true;
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point last_ = Clock::now();
};

/// For the GoOn of a study, to be called without the GIL: Ctrl-C is thrown out of it as Python raises it.
inline std::function<bool()> unless_interrupted() {
    return [pace = Pace()]() mutable {
        if (!pace.due()) return true;
        const nb::gil_scoped_acquire gil;
        if (PyErr_CheckSignals() != 0) throw nb::python_error();
        return true;
    };
}

/// A function for RunOptions::progress, to be called without the GIL; `watch` is None or a function of the time [s]
/// reached whose False ends the run. It throws what Python raises. `watch` must outlive it.
inline std::function<bool(double)> progress_of(const nb::object& watch) {
    return [&watch, pace = Pace()](double time) mutable {
        if (!pace.due()) return true;
        const nb::gil_scoped_acquire gil;
        if (PyErr_CheckSignals() != 0) throw nb::python_error();
        if (watch.is_none()) return true;
        const nb::object answer = watch(time);
        return !answer.is(nb::bool_(false));
    };
}

}  // namespace footfall::python
