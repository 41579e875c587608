#include "footfall/simulate/run.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "footfall/law/registry.hpp"
#include "footfall/simulate/budget.hpp"
#include "footfall/simulate/run_once.hpp"

namespace footfall {

namespace {

using Law = ContactLawOver<double>;

// One sphere under a bristle, or without friction, is what most runs are: their sizes are known to the compiler.
Run run_once(const Simulation& simulation) {
    std::vector<Law> laws;
    for (const ContactParameters& c : simulation.contacts) laws.emplace_back(c.normal, c.friction);
    if (laws.size() == 1) {
        if (laws[0].states() == 2) return SimulationRun<Law, 1, 2>(simulation, std::move(laws)).run();
        if (laws[0].states() == 0) return SimulationRun<Law, 1, 0>(simulation, std::move(laws)).run();
    }
    return SimulationRun<Law>(simulation, std::move(laws)).run();
}

// The tolerance bounds the error of a step; a run of very many steps can add them up. Where the ledger shows that it
// has, the run is done again with smaller steps.
Run run_to_tolerance(Simulation simulation) {
    constexpr double allowed = 30;      // times the tolerance, for the ledger's residual
    constexpr double tightest = 1e-13;  // below, rounding decides
    const double wanted = simulation.options.tolerance, max_memory = simulation.options.max_memory;
    Run run = run_once(simulation);
    Cost spent = run.cost;
    while (run.max_residual > allowed * wanted && simulation.options.tolerance > tightest) {
        simulation.options.tolerance = std::max(1e-2 * simulation.options.tolerance, 1e-14);
        // The first is kept meanwhile, as the second may turn out no better.
        simulation.options.max_memory = std::max(max_memory - kept_bytes(run), 1.0);
        Run again = as_second_attempt([&] { return run_once(simulation); });
        spent += again.cost;
        if (again.max_residual < run.max_residual) run = std::move(again);
    }
    run.cost = spent;
    return run;
}

}  // namespace

Run run(const Simulation& simulation) {
    check(simulation);
    return in_own_words([&] { return run_to_tolerance(simulation); });
}

}  // namespace footfall
