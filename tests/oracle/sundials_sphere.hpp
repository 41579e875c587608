// The paper's ball driven by SUNDIALS in plain time, with root finding for the events and the phase frozen between
// them; what ARKODE and CVODE have in common. The equations are those of paper_sphere.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>

#include "paper_sphere.hpp"
#include "timed_run.hpp"

namespace oracle {

/// Runs the ball from flight with relative tolerance `tolerance` and absolute tolerance `tolerance * paper_scale`.
class SundialsSphere {
public:
    SundialsSphere(const SundialsSphere&) = delete;
    SundialsSphere& operator=(const SundialsSphere&) = delete;
    virtual ~SundialsSphere() {
        N_VDestroy(absolute_);
        N_VDestroy(y_);
        SUNContext_Free(&context_);
    }

    /// Throws std::runtime_error where SUNDIALS fails.
    TimedRun run(const State<double>& start, double end) {
        TimedRun result;
        State<double> y = start;
        double t = 0;
        phase_ = Phase::flight;
        for (;;) {
            std::copy(y.begin(), y.end(), N_VGetArrayPointer(y_));
            std::array<int, 2> found{};
            const bool event = evolve(t, end, found);
            count(result);
            std::copy_n(N_VGetArrayPointer(y_), dimension, y.begin());
            if (!event) break;
            phase_ = apply(event_of(phase_, found[0] != 0 ? 0 : 1), ball_, y, [&](EventKind kind) {
                result.events.push_back({t, kind});
            });
        }
        result.final = y;
        return result;
    }

protected:
    SundialsSphere(const Ball<double>& ball, double tolerance) : ball_(ball) {
#ifdef SUN_COMM_NULL  // SUNDIALS 7
        require(SUNContext_Create(SUN_COMM_NULL, &context_), "SUNContext_Create");
#else
        require(SUNContext_Create(nullptr, &context_), "SUNContext_Create");
#endif
        y_ = N_VNew_Serial(dimension, context_);
        absolute_ = N_VNew_Serial(dimension, context_);
        std::fill_n(N_VGetArrayPointer(y_), dimension, 0.0);
        std::transform(paper_scale.begin(), paper_scale.end(), N_VGetArrayPointer(absolute_),
                       [tolerance](double scale) { return tolerance * scale; });
    }

    /// Integrates y_ from t until a guard falls through zero, and says which, or to `end`; sets t.
    virtual bool evolve(double& t, double end, std::array<int, 2>& found) = 0;
    /// Adds the cost of the last `evolve`.
    virtual void count(TimedRun& run) const = 0;

    static int rhs(sunrealtype, N_Vector y, N_Vector dy, void* self) {
        const auto& sphere = *static_cast<const SundialsSphere*>(self);
        const State<double> rate = derivative(sphere.ball_, sphere.phase_, state_in(y));
        std::copy(rate.begin(), rate.end(), N_VGetArrayPointer(dy));
        return 0;
    }

    static int roots(sunrealtype, N_Vector y, sunrealtype* g, void* self) {
        const auto& sphere = *static_cast<const SundialsSphere*>(self);
        const auto value = guards(sphere.ball_, sphere.phase_, state_in(y));
        std::copy(value.begin(), value.end(), g);
        return 0;
    }

    static int require(int flag, const char* what) {
        if (flag < 0) throw std::runtime_error(std::string(what) + " failed with " + std::to_string(flag));
        return flag;
    }

    static constexpr long step_limit = 10'000'000;
    SUNContext context_ = nullptr;
    N_Vector y_ = nullptr, absolute_ = nullptr;

private:
    static State<double> state_in(N_Vector y) {
        State<double> state;
        std::copy_n(N_VGetArrayPointer(y), dimension, state.begin());
        return state;
    }

    Ball<double> ball_;
    Phase phase_ = Phase::flight;
};

}  // namespace oracle
