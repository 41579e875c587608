#include "study/drop_impact.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "footfall/simulate/budget.hpp"
#include "study/drop_system.hpp"
#include "study/drop_watchers.hpp"

namespace footfall::study {
namespace {

/// What is looked on with where only the end counts.
struct Nothing {};

/// Follows the impact to its end; `watch(system)` makes a watcher. Empty where it cannot be followed.
template <class System, class S, class Watch>
std::optional<S> followed(System system, const Watch& watch) {
    if (!system.has_scales()) return std::nullopt;
    using State = typename System::State;
    Solver<System> solver(system);
    auto watcher = watch(system);
    constexpr bool watched = !std::is_same_v<decltype(watcher), Nothing>;
    if constexpr (watched) solver.add(watcher);
    DropBudget<State> budget;
    solver.add(budget);
    try {
        in_own_words([&] { solver.run(system.initial_state(), std::numeric_limits<double>::infinity()); });
    } catch (const std::runtime_error&) {  // too expensive, or not to be told apart: a fit goes on with other numbers
        return std::nullopt;
    }
    if constexpr (requires { watcher.finish(); }) watcher.finish();
    return -solver.state()[System::Plant::velocity];
}

/// Laws with few states, which most have, are followed with sizes that the compiler knows.
template <class S, class Watch>
std::optional<S> follow(const DropLaw<S>& law, const S& mass, const S& speed, double tolerance, const Watch& watch) {
    const auto with = [&]<int States>() {
        return followed<DropSystem<S, States>, S>({law, mass, speed, tolerance}, watch);
    };
    switch (law.states()) {
        case 0:
            return with.template operator()<0>();
        case 1:
            return with.template operator()<1>();
        default:
            return with.template operator()<Eigen::Dynamic>();
    }
}

}  // namespace

template <class S>
DropImpact<S>::DropImpact(const NormalLawOver<S>& law, const S& mass, const S& speed, double tolerance)
    : law_(law, {}), mass_(mass), speed_(speed), tolerance_(tolerance) {}

template <class S>
std::optional<S> DropImpact<S>::speed_out() const {
    return follow(law_, mass_, speed_, tolerance_, [](const auto&) { return Nothing{}; });
}

template <class S>
bool DropImpact<S>::force_at_times(std::span<const S> times, std::span<S> forces) const {
    std::fill(forces.begin(), forces.end(), S(0));
    return follow(law_, mass_, speed_, tolerance_,
                  [&](const auto& system) { return ForceAtTimes(system, times, forces); })
        .has_value();
}

template <class S>
bool DropImpact<S>::force_at_depths(std::span<const double> depths, std::span<const Branch> branches,
                                    std::span<S> forces) const {
    return follow(law_, mass_, speed_, tolerance_,
                  [&](const auto& system) { return ForceAtDepths(system, depths, branches, forces); })
        .has_value();
}

template class DropImpact<double>;
template class DropImpact<FitDual>;

}  // namespace footfall::study
