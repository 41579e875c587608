// Measures the order of the methods over a scene: the step is halved, the slope of the error read off. The scenes have
// numbers of order one and a soft ground, so that the same step suits flight and contact.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "footfall/law/pair.hpp"
#include "footfall/simulate/run_once.hpp"

namespace footfall::test {

using Real = long double;

/// A ball of unit mass and radius that falls with 1 m/s^2.
inline Simulation soft_ball() {
    Simulation s;
    s.body.mass = 1;
    s.body.inertia = solid_sphere_inertia(1, 1);
    s.body.spheres = {{.radius = 1}};
    s.gravity = {0, 0, -1};
    s.options.allow_initial_penetration = true;
    return s;
}

/// Which method takes the steps.
enum class Steps { explicit_, implicit };

inline double order_of(Steps steps) { return steps == Steps::explicit_ ? 8 : 9; }
inline std::string name_of_steps(const testing::TestParamInfo<Steps>& info) {
    return info.param == Steps::explicit_ ? "Explicit" : "Implicit";
}

/// The largest error of any component, and of those that only friction moves.
struct Errors {
    double all, tangential;
};

/// A run of one ball under a law with `States` states.
template <class Law, int States>
struct OrderOf {
    using SimulationRunType = SimulationRun<Law, 1, States>;
    using State = typename SimulationRunType::HybridType::State;

    struct Outcome {
        State state;
        std::vector<EventKind> events;  // those after the start
    };

    const Simulation& simulation;
    const Law& law;
    Steps steps;

    [[nodiscard]] Outcome outcome(Real step) const {
        SimulationRunType run(simulation, {law});
        run.solver().fix_step(step);
        if (steps == Steps::implicit) run.solver().stay_implicit();
        const Run record = run.run();
        Outcome out{run.solver().state(), {}};
        for (const Event& e : record.events)
            if (e.time > 0) out.events.push_back(e.kind);
        return out;
    }

    [[nodiscard]] Errors errors(const State& rough, const State& exact) const {
        using Plant = FreeBody<Real, 1>;
        const Hybrid<Plant, Law, States> layout(Plant(simulation.body, simulation.ground, simulation.gravity), {law});
        const State e = (rough - exact).abs();
        const int taken = layout.taken(0);
        Real tangential = std::max({e.template segment<2>(Plant::velocity).maxCoeff(),
                                    e.template segment<3>(Plant::momentum).maxCoeff(), e[taken + by_tangential_damper],
                                    e[taken + by_clutch], e[taken + unpaid]});
        for (int k = 0; k < States; ++k) tangential = std::max(tangential, e[layout.first_state(0) + k]);
        return {static_cast<double>(e.maxCoeff()), static_cast<double>(tangential)};
    }
};

inline std::string names(const std::vector<EventKind>& events) {
    std::string text;
    for (const EventKind e : events) text += std::string(name_of(e)) + " ";
    return text;
}

/// The order that the errors of ever halved steps show in a state of this size: the slope of the last pair above
/// rounding; 0 without one.
inline double last_slope(const std::vector<double>& errors, double size) {
    const double rounding = 1.5e-17 * size;  // of a whole run in long double
    double slope = 0;
    for (std::size_t k = 1; k < errors.size(); ++k)
        if (errors[k] > rounding) slope = std::log2(errors[k - 1] / errors[k]);
    return slope;
}

struct MeasuredOrder {
    double all = 0, tangential = 0;
    double overall = 0, overall_tangential = 0;  ///< the mean slope from the coarsest to the finest step
};

/// Runs a scene with ever finer steps, and expects exactly these events after its start.
template <int States, class Law>
[[nodiscard]] MeasuredOrder measured_order(Simulation s, const Law& law, Steps steps,
                                           const std::vector<EventKind>& events, double coarsest, int halvings = 3) {
    // Of a step of fixed size it says only where the implicit method's iteration ends.
    s.options.tolerance = 1e-16;
    const OrderOf<Law, States> order{s, law, steps}, reference{s, law, Steps::explicit_};
    const auto exact = reference.outcome(coarsest * std::ldexp(1.0L, -halvings - 3));
    EXPECT_EQ(names(exact.events), names(events));
    std::vector<double> all, tangential;
    for (int k = 0; k <= halvings; ++k) {
        const double step = coarsest * std::ldexp(1.0, -k);
        const auto rough = order.outcome(step);
        EXPECT_EQ(names(rough.events), names(events)) << "at step " << step;
        const Errors e = order.errors(rough.state, exact.state);
        std::printf("  step %-8.4g error %-9.3g friction's %-9.3g", step, e.all, e.tangential);
        if (k > 0)
            std::printf(" slope %.2f %.2f", std::log2(all.back() / e.all), std::log2(tangential.back() / e.tangential));
        std::printf("\n");
        all.push_back(e.all);
        tangential.push_back(e.tangential);
    }
    const double size = static_cast<double>(exact.state.abs().maxCoeff());
    return {last_slope(all, size), last_slope(tangential, size), std::log2(all.front() / all.back()) / halvings,
            std::log2(tangential.front() / tangential.back()) / halvings};
}

}  // namespace footfall::test
