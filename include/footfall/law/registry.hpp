// Every law there is. To add one: write its file, include it here, and put it into the list of its kind.
// All else follows the two lists: scenario, schema, help, output, Python classes, typed tests and the soak.
// Who needs only laws of some kind takes them from here by `LawsThat` (erased.hpp).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "footfall/law/friction/azad_featherstone.hpp"
#include "footfall/law/friction/azad_featherstone_passive.hpp"
#include "footfall/law/friction/bliman_sorine.hpp"
#include "footfall/law/friction/dahl.hpp"
#include "footfall/law/friction/elasto_plastic.hpp"
#include "footfall/law/friction/haessig_friedland.hpp"
#include "footfall/law/friction/linear.hpp"
#include "footfall/law/friction/lugre.hpp"
#include "footfall/law/friction/none.hpp"
#include "footfall/law/friction/regularized_coulomb.hpp"
#include "footfall/law/friction/reset_integrator.hpp"
#include "footfall/law/friction/seven_parameter.hpp"
#include "footfall/law/normal/azad_featherstone.hpp"
#include "footfall/law/normal/falcon.hpp"
#include "footfall/law/normal/flores.hpp"
#include "footfall/law/normal/hertz.hpp"
#include "footfall/law/normal/hunt_crossley.hpp"
#include "footfall/law/normal/kuwabara_kono.hpp"
#include "footfall/law/normal/lankarani_nikravesh.hpp"
#include "footfall/law/normal/linear.hpp"
#include "footfall/law/normal/marhefka_orin.hpp"
#include "footfall/law/normal/tsuji.hpp"
#include "footfall/law/pair.hpp"
#include "footfall/math/error.hpp"
#include "footfall/math/number_text.hpp"

namespace footfall {

// One law a line.
// clang-format off
template <class S>
using NormalLawOver = std::variant<
    AzadFeatherstoneNormal<S>,
    KuwabaraKonoNormal<S>,
    HuntCrossleyNormal<S>,
    MarhefkaOrinNormal<S>,
    LankaraniNikraveshNormal<S>,
    FloresNormal<S>,
    FalconNormal<S>,
    TsujiNormal<S>,
    HertzNormal<S>,
    LinearNormal<S>
>;

template <class S>
using FrictionLawOver = std::variant<
    NoFriction<S>,
    AzadFeatherstoneFriction<S>,
    AzadFeatherstonePassiveFriction<S>,
    LinearFriction<S>,
    RegularizedCoulombFriction<S>,
    DahlFriction<S>,
    LuGreFriction<S>,
    ElastoPlasticFriction<S>,
    BlimanSorineFriction<S>,
    SevenParameterFriction<S>,
    ResetIntegratorFriction<S>,
    HaessigFriedlandFriction<S>
>;
// clang-format on

using NormalLaw = NormalLawOver<double>;
using FrictionLaw = FrictionLawOver<double>;

/// The law of one contact, whichever it is.
template <class S>
using ContactLawOver = Pair<NormalLawOver<S>, FrictionLawOver<S>>;

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

/// The contacts of a body that are under one law; `of(contact)` is the normal or the friction law of a contact.
template <class Law, class OfContact>
[[nodiscard]] std::vector<std::size_t> contacts_under(const std::vector<ContactParameters>& contacts, OfContact of) {
    std::vector<std::size_t> under;
    for (std::size_t i = 0; i < contacts.size(); ++i)
        if (std::holds_alternative<Law>(of(contacts[i]))) under.push_back(i);
    return under;
}

/// The law's name in a scenario.
template <class Variant>
[[nodiscard]] std::string_view name_of(const Variant& law) {
    return std::visit([](const auto& l) { return l.description.name; }, law);
}

/// Whether what the clutch of a friction law has taken can never fall. A law that can give back says so, and for which
/// of its parameters, by a member of this name.
[[nodiscard]] inline bool clutch_only_takes(const FrictionLaw& law) {
    return std::visit(
        [](const auto& l) {
            if constexpr (requires { l.clutch_only_takes(); }) {
                return l.clutch_only_takes();
            } else {
                return true;
            }
        },
        law);
}

/// Throws InvalidInput where a parameter of a law is outside its range; `who` names the law's place in the message.
inline void check(const ContactParameters& contact, std::string_view who) {
    const auto check_one = [&](const auto& law, std::string_view part) {
        for (const auto& p : law.parameters()) {
            const double value = law.*p.member;
            if (p.allows(value)) continue;
            const auto text = [](std::string_view word) { return std::string(word); };
            throw InvalidInput(text(who) + ": " + text(part) + " law '" + text(law.description.name) +
                               "': " + text(p.key) + " (" + text(p.symbol) + ", " + text(p.description) + ") is " +
                               number_text(value) + " " + text(p.unit) + "; allowed is " + text(p.range()) +
                               ", finite");
        }
    };
    std::visit([&](const auto& law) { check_one(law, "normal"); }, contact.normal);
    std::visit([&](const auto& law) { check_one(law, "friction"); }, contact.friction);
}

}  // namespace footfall
