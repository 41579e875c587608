#include "footfall/law/registry.hpp"

#include <fmt/core.h>

namespace footfall {

namespace {

template <class Law>
void check_law(const Law& law, std::string_view who, std::string_view part) {
    for (const auto& p : Law::parameters()) {
        const double value = law.*p.member;
        if (!p.allows(value))
            throw InvalidInput(fmt::format("{}: {} law '{}': {} ({}, {}) is {} {}; allowed is {}, finite", who, part,
                                           Law::description.name, p.key, p.symbol, p.description, value, p.unit,
                                           p.range()));
    }
}

}  // namespace

bool clutch_only_takes(const FrictionLaw& law) {
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

void check(const ContactParameters& contact, std::string_view who) {
    std::visit([&](const auto& law) { check_law(law, who, "normal"); }, contact.normal);
    std::visit([&](const auto& law) { check_law(law, who, "friction"); }, contact.friction);
}

}  // namespace footfall
