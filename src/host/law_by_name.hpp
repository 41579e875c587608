// A law of the registry from its name and the names and values of its parameters, in SI units.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "footfall/law/registry.hpp"
#include "footfall/math/error.hpp"

namespace footfall::host {

struct NamedValue {
    std::string_view name;
    double value;
};

/// Throws InvalidInput for a name that is none, and where a parameter is missing; `kind` is "normal" or "friction".
template <class Variant>
[[nodiscard]] Variant law_by_name(std::string_view kind, std::string_view name, std::span<const NamedValue> given) {
    Variant found;
    bool known = false;
    std::string names;
    for_each_law<Variant>([&]<class Law>(Law law) {
        names += fmt::format("{}'{}'", names.empty() ? "" : ", ", Law::description.name);
        if (name != Law::description.name) return;
        known = true;
        const auto parameters = Law::parameters();
        std::string keys;
        for (const auto& p : parameters) {
            keys += fmt::format("{}'{}'", keys.empty() ? "" : ", ", p.key);
            bool set = false;
            for (const NamedValue& value : given) {
                if (value.name != p.key) continue;
                if (set) throw InvalidInput(fmt::format("{} law '{}': {} is given twice", kind, name, p.key));
                law.*p.member = value.value;
                set = true;
            }
            if (set) continue;
            if (!p.fallback)
                throw InvalidInput(fmt::format("{} law '{}': {} ({}, {}) [{}] is missing", kind, name, p.key, p.symbol,
                                               p.description, p.unit));
            law.*p.member = *p.fallback;
        }
        for (const NamedValue& value : given) {
            bool any = false;
            for (const auto& p : parameters) any = any || value.name == p.key;
            if (!any)
                throw InvalidInput(fmt::format("{} law '{}': unknown parameter '{}'. It has {}", kind, name, value.name,
                                               keys.empty() ? "no parameters" : keys));
        }
        found = law;
    });
    if (!known) throw InvalidInput(fmt::format("unknown {} law '{}'. There are {}", kind, name, names));
    return found;
}

}  // namespace footfall::host
