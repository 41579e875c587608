// Every law there is. To add one: write its file, add it here (and, for a friction law, src/simulate/run_<law>.cpp).
// The scenario's names, the command line's help, the schema and the typed tests all follow this list.
#pragma once

#include <string_view>
#include <variant>

#include "footfall/law/friction/azad_featherstone.hpp"
#include "footfall/law/friction/linear.hpp"
#include "footfall/law/friction/none.hpp"
#include "footfall/law/normal/azad_featherstone.hpp"
#include "footfall/law/normal/hunt_crossley.hpp"
#include "footfall/law/normal/linear.hpp"

namespace footfall {

template <class S>
using NormalLawOver = std::variant<AzadFeatherstoneNormal<S>, HuntCrossleyNormal<S>, LinearNormal<S>>;
using NormalLaw = NormalLawOver<double>;

using FrictionLaw = std::variant<NoFriction<>, AzadFeatherstoneFriction<>, LinearFriction<>>;

/// The laws of one contact, with their parameters.
struct ContactParameters {
    NormalLaw normal;
    FrictionLaw friction = NoFriction<>{};
};

/// Calls `visit(law)` with a value-initialised law of each kind in `Variant`, in order.
template <class Variant, class Visit>
constexpr void for_each_law(Visit&& visit) {
    [&]<class... Laws>(const std::variant<Laws...>*) { (visit(Laws{}), ...); }(static_cast<const Variant*>(nullptr));
}

/// The law's name in a scenario.
template <class Variant>
[[nodiscard]] std::string_view name_of(const Variant& law) {
    return std::visit([](const auto& l) { return l.description.name; }, law);
}

/// Throws InvalidInput where a parameter of a law is outside its range; `who` names the law's place in the message.
void check(const ContactParameters& contact, std::string_view who);

}  // namespace footfall
