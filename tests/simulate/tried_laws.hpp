// Every law of the registry with numbers to try it with. A law that no test knows has them from the units of its
// parameters, so that it is tried where every law is.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "footfall/io/units.hpp"
#include "footfall/law/registry.hpp"

namespace footfall::test {

/// What an impact is made of.
struct Scale {
    double mass;          ///< [kg]
    double length;        ///< how deep it goes [m]
    double time;          ///< [s]
    double number = 0.2;  ///< of what has no unit, such as a coefficient of friction

    [[nodiscard]] double of(std::string_view unit) const {
        if (unit == "1") return number;
        const Dimension d = parse_unit(unit).dimension;
        return std::pow(mass, d.mass) * std::pow(length, d.length) * std::pow(time, d.time);
    }
};

/// The paper's ball at half a metre a second.
inline constexpr Scale ball_scale{.mass = 0.154, .length = 1e-4, .time = 2e-4};

/// The law with what is not left out at its natural size.
template <class Law>
[[nodiscard]] Law of_natural_size(const Scale& scale) {
    Law law{};
    for (const auto& p : Law::parameters()) law.*p.member = p.fallback ? *p.fallback : scale.of(p.unit);
    return law;
}

/// The laws that are given, and every other one of the registry of its natural size.
template <class Variant>
[[nodiscard]] std::vector<Variant> completed(const std::vector<Variant>& known, const Scale& scale) {
    std::vector<Variant> all = known;
    for_each_law<Variant>([&]<class Law>(const Law&) {
        for (const Variant& law : known)
            if (std::holds_alternative<Law>(law)) return;
        all.push_back(of_natural_size<Law>(scale));
    });
    return all;
}

/// Every normal law of the registry, for the paper's ball: those that are known here with numbers that lose some of
/// the energy, the others of their natural size.
[[nodiscard]] inline std::vector<NormalLaw> tried_normal_laws() {
    return completed<NormalLaw>(
        {AzadFeatherstoneNormal<>{8.5e6, 3.1e3}, KuwabaraKonoNormal<>{{8.5e6, 2.4e-4}},
         HuntCrossleyNormal<>{8.5e6, 3.1e6}, MarhefkaOrinNormal<>{{8.5e6, 0.2}},
         LankaraniNikraveshNormal<>{{8.5e6, 0.7}}, FloresNormal<>{{8.5e6, 0.7}}, FalconNormal<>{8.5e6, 300},
         TsujiNormal<>{8.5e6, ball_scale.mass, 0.7}, HertzNormal<>{{8.5e6}}, LinearNormal<>{2.5e5, 60}},
        ball_scale);
}

/// Every friction law of the registry. Those that are known here slide at a coefficient of about 0.2; those with a
/// stiffness have about that of the paper's law at a depth of 0.1 mm.
[[nodiscard]] inline std::vector<FrictionLaw> tried_friction_laws() {
    return completed<FrictionLaw>(
        {NoFriction<>{}, AzadFeatherstoneFriction<>{{12.75e6, 3.1e3, 0.2, 0.1}},
         AzadFeatherstonePassiveFriction<>{{12.75e6, 3.1e3, 0.2, 0.1}}, LinearFriction<>{{1.3e5, 33, 0.2, 0}},
         RegularizedCoulombFriction<>{0.2, 1e-3}, DahlFriction<>{1.5e4, 0.2}, LuGreFriction<>{1.5e4, 5, 0.3, 0.2, 0.01},
         ElastoPlasticFriction<>{1.5e4, 5, 0.3, 0.2, 0.01}, BlimanSorineFriction<>{0.2, 0.3, 5e-5, 0.2},
         SevenParameterFriction<>{1.5e4, 0.2, 0.1, 0.01, 1e-3, 0.1}, ResetIntegratorFriction<>{1.5e4, 5, 1.3e-5, 0.3},
         HaessigFriedlandFriction<>{1.5e4, 2e-5}},
        ball_scale);
}

/// The keys of a law's table in a scenario, one a line.
template <class Variant>
[[nodiscard]] std::string keys_of(const Variant& law) {
    std::string text;
    std::visit(
        [&](const auto& l) {
            for (const auto& p : l.parameters()) text += fmt::format("{} = {}\n", p.key, l.*p.member);
        },
        law);
    return text;
}

}  // namespace footfall::test
