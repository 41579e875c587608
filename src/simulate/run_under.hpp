// A run under one normal law, whatever the friction: compiled once for each normal law, in a file of its own, because
// every pair of laws has its own inlined equations of motion.
#pragma once

#include <algorithm>
#include <utility>
#include <variant>

#include "footfall/simulate/run.hpp"
#include "footfall/simulate/simulator.hpp"

namespace footfall {

// The tolerance bounds the error of a step; a run of very many steps can add them up. Where the ledger shows that it
// has, the run is done again with smaller steps.
template <class RunOnce>
Run run_to_tolerance(Simulation simulation, RunOnce&& run_once) {
    constexpr double allowed = 30;      // times the tolerance, for the ledger's residual
    constexpr double tightest = 1e-13;  // below, rounding decides
    const double wanted = simulation.options.tolerance;
    Run run = run_once(simulation);
    Cost spent = run.cost;
    while (run.max_residual > allowed * wanted && simulation.options.tolerance > tightest) {
        simulation.options.tolerance = std::max(1e-2 * simulation.options.tolerance, 1e-14);
        Run again = run_once(simulation);
        spent += again.cost;
        if (again.max_residual < run.max_residual) run = std::move(again);
    }
    run.cost = spent;
    return run;
}

template <class Normal>
Run run_under(const Simulation& simulation) {
    return std::visit(
        [&]<class Friction>(const Friction&) {
            using Law = ContactLaw<Normal, Friction>;
            std::vector<Law> laws;
            for (const ContactParameters& c : simulation.contacts)
                laws.push_back({std::get<Normal>(c.normal), std::get<Friction>(c.friction)});
            return run_to_tolerance(simulation, [&](const Simulation& s) {
                return laws.size() == 1 ? Simulator<Law, 1>(s, laws).run()
                                        : Simulator<Law, Eigen::Dynamic>(s, laws).run();
            });
        },
        simulation.contacts.front().friction);
}

}  // namespace footfall
