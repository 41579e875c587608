// A run under one friction law: compiled once for each, in a file of its own, because the equations of motion are
// inlined into the integrator.
#pragma once

#include <algorithm>
#include <type_traits>
#include <utility>
#include <variant>

#include "footfall/law/any_normal.hpp"
#include "footfall/law/any_rate_friction.hpp"
#include "footfall/simulate/budget.hpp"
#include "footfall/simulate/run.hpp"
#include "footfall/simulate/simulator.hpp"

namespace footfall {

// The tolerance bounds the error of a step; a run of very many steps can add them up. Where the ledger shows that it
// has, the run is done again with smaller steps.
template <class RunOnce>
Run run_to_tolerance(Simulation simulation, RunOnce&& run_once) {
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

/// A law of the registry as `Friction`, which is that law, or AnyRateFriction.
template <class Friction>
Friction friction_of(const FrictionLaw& law) {
    if constexpr (std::is_same_v<Friction, AnyRateFriction<>>) {
        return std::visit(
            []<class Law>(const Law& l) -> Friction {
                if constexpr (RateFriction<Law>) return Friction(l);
                throw std::bad_variant_access();
            },
            law);
    } else {
        return std::get<Friction>(law);
    }
}

/// The laws of every sphere as ContactLaw wants them. `Normal` is a law, or AnyNormal.
template <class Normal, class Friction>
std::vector<ContactLaw<Normal, Friction>> laws_of(const Simulation& simulation) {
    std::vector<ContactLaw<Normal, Friction>> laws;
    for (const ContactParameters& c : simulation.contacts) {
        const Friction friction = friction_of<Friction>(c.friction);
        if constexpr (std::is_same_v<Normal, AnyNormal<>>) {
            laws.push_back({std::visit([](const auto& law) { return Normal(law); }, c.normal), friction});
        } else {
            laws.push_back({std::get<Normal>(c.normal), friction});
        }
    }
    return laws;
}

template <class Normal, class Friction>
Run run_under(const Simulation& simulation) {
    using Law = ContactLaw<Normal, Friction>;
    const std::vector<Law> laws = laws_of<Normal, Friction>(simulation);
    return run_to_tolerance(simulation, [&](const Simulation& s) {
        // The number of friction states is known when the program runs, so that of the spheres may be as well.
        if constexpr (Law::has_states) {
            return Simulator<Law, Eigen::Dynamic>(s, laws).run();
        } else {
            return laws.size() == 1 ? Simulator<Law, 1>(s, laws).run() : Simulator<Law, Eigen::Dynamic>(s, laws).run();
        }
    });
}

}  // namespace footfall
