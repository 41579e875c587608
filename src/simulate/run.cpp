#include "footfall/simulate/run.hpp"

#include <variant>

#include "footfall/law/any_normal.hpp"
#include "footfall/law/any_rate_friction.hpp"
#include "footfall/simulate/budget.hpp"

namespace footfall {

template <class Normal, class Friction>
Run run_under(const Simulation& simulation);  // instantiated in run_<laws>.cpp

namespace {

Run run_by_laws(const Simulation& simulation) {
    const ContactParameters& laws = simulation.contacts.front();
    return std::visit(
        [&]<class Friction>(const Friction&) {
            // The paper's pair of laws has equations of motion of its own, which saves some 5 % of the time.
            if constexpr (std::is_same_v<Friction, AzadFeatherstoneFriction<>>) {
                if (std::holds_alternative<AzadFeatherstoneNormal<>>(laws.normal))
                    return run_under<AzadFeatherstoneNormal<>, Friction>(simulation);
            }
            if constexpr (RateFriction<Friction>) {
                return run_under<AnyNormal<>, AnyRateFriction<>>(simulation);
            } else {
                return run_under<AnyNormal<>, Friction>(simulation);
            }
        },
        laws.friction);
}

}  // namespace

Run run(const Simulation& simulation) {
    check(simulation);
    return in_own_words([&] { return run_by_laws(simulation); });
}

}  // namespace footfall
