#include "footfall/io/law_text.hpp"

#include <algorithm>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "footfall/io/setting.hpp"
#include "footfall/io/units.hpp"
#include "io/nearest.hpp"
#include "io/read.hpp"
#include "io/text.hpp"

namespace footfall {
namespace {

/// A line of text that is no line of a file does not end with a carriage return.
std::string_view trimmed(std::string_view text) { return io::trimmed(text, " \t"); }

/// One "key=value" as it was written.
struct KeyValue {
    std::string_view key, value;
};

/// "azad-featherstone", {{"stiffness", "8.5e6"}, ...}
struct Parts {
    std::string_view name;
    std::vector<KeyValue> settings;
};

Parts split(std::string_view text, std::string_view kind) {
    const std::size_t colon = text.find(':');
    Parts parts{trimmed(text.substr(0, colon)), {}};
    if (colon == std::string_view::npos) return parts;
    for (std::string_view rest = text.substr(colon + 1);;) {
        const std::size_t comma = rest.find(',');
        const std::string_view setting = trimmed(rest.substr(0, comma));
        const std::size_t equals = setting.find('=');
        if (equals == std::string_view::npos) {
            throw InvalidInput(fmt::format("{} law '{}': expected key=value, got '{}'", kind, text, setting));
        }
        const std::string_view key = trimmed(setting.substr(0, equals));
        const auto same = [key](const KeyValue& other) { return other.key == key; };
        if (std::any_of(parts.settings.begin(), parts.settings.end(), same))
            throw InvalidInput(fmt::format("{} law '{}': '{}' is given twice", kind, parts.name, key));
        parts.settings.push_back({key, trimmed(setting.substr(equals + 1))});
        if (comma == std::string_view::npos) return parts;
        rest.remove_prefix(comma + 1);
    }
}

/// ": did you mean 'WORD'?" or the end of the sentence.
std::string suggestion(std::string_view word, const std::vector<std::string>& words) {
    const std::string meant = io::did_you_mean(word, words);
    return meant.empty() ? "." : meant;
}

template <class Law>
double read_value(const Parameter<Law>& parameter, std::string_view text) {
    const std::optional<double> plain = io::plain_number(text);
    if (!plain && parameter.unit_depends) {
        throw InvalidInput(
            fmt::format("expected a plain number (its unit depends on other parameters), got '{}'", text));
    }
    const double value = plain ? *plain : to_si(text, parameter.unit);
    if (!parameter.allows(value)) {
        const std::string unit = parameter.unit == "1" ? "" : fmt::format(" {}", parameter.unit);
        throw InvalidInput(fmt::format("is {}{}; allowed is {}, finite", value, unit, parameter.range()));
    }
    return value;
}

template <class Law>
Law read_law(const Parts& parts, std::string_view kind) {
    const auto parameters = Law::parameters();
    const std::string who = fmt::format("{} law '{}'", kind, Law::description.name);
    std::vector<std::string> keys, given;
    for (const auto& parameter : parameters) keys.emplace_back(parameter.key);

    Law law{};
    for (const auto& parameter : parameters) {
        if (parameter.fallback) law.*parameter.member = *parameter.fallback;
    }
    for (const auto& [key, text] : parts.settings) {
        const auto* parameter = std::find_if(parameters.begin(), parameters.end(),
                                             [key = key](const auto& candidate) { return candidate.key == key; });
        if (parameter == parameters.end()) {
            throw InvalidInput(fmt::format("{}: unknown parameter '{}'{} It has {}", who, key, suggestion(key, keys),
                                           keys.empty() ? "no parameters" : io::listed(keys)));
        }
        given.emplace_back(key);
        try {
            law.*parameter->member = read_value(*parameter, text);
        } catch (const InvalidInput& error) {
            throw InvalidInput(fmt::format("{}: {} ({}, {}): {}", who, parameter->key, parameter->symbol,
                                           parameter->description, error.what()));
        }
    }
    for (const auto& parameter : parameters) {
        if (parameter.fallback || std::find(given.begin(), given.end(), parameter.key) != given.end()) continue;
        const std::string unit = parameter.unit == "1" ? "" : fmt::format(", in {}", parameter.unit);
        throw InvalidInput(fmt::format("{}: {} ({}, {}) is missing: add {}=NUMBER{}", who, parameter.key,
                                       parameter.symbol, parameter.description, parameter.key, unit));
    }
    return law;
}

template <class Variant>
Variant parse(std::string_view text, std::string_view kind) {
    const Parts parts = split(text, kind);
    std::vector<std::string> names;
    std::optional<Variant> found;
    for_each_law<Variant>([&]<class Law>(const Law&) {
        names.emplace_back(Law::description.name);
        if (parts.name == Law::description.name) found = read_law<Law>(parts, kind);
    });
    if (!found) {
        throw InvalidInput(fmt::format("unknown {} law '{}'{} There are {}", kind, parts.name,
                                       suggestion(parts.name, names), io::listed(names)));
    }
    return *found;
}

/// The law as a table of a file, in one line of TOML.
Setting law_setting(std::string_view kind, std::string_view text, std::string place) {
    try {
        const Parts parts = split(text, kind);
        std::string table = fmt::format("{{ law = {}", text::toml_string(parts.name));
        for (const auto& [key, value] : parts.settings) {
            const std::optional<double> plain = io::plain_number(value);
            const std::string written = plain ? fmt::format("{}", *plain) : text::toml_string(value);
            table += fmt::format(", {} = {}", text::toml_string(key), written);
        }
        return {fmt::format("contact.{}", kind), table + " }", std::move(place), true};
    } catch (const InvalidInput& error) {
        throw InvalidInput(fmt::format("{}: {}", place, error.what()));
    }
}

template <class Variant>
std::string write(const Variant& any) {
    return std::visit(
        []<class Law>(const Law& law) {
            std::string text(Law::description.name);
            char separator = ':';
            for (const auto& parameter : Law::parameters()) {
                text += fmt::format("{}{}={}", std::exchange(separator, ','), parameter.key, law.*parameter.member);
            }
            return text;
        },
        any);
}

}  // namespace

NormalLaw parse_normal_law(std::string_view text) { return parse<NormalLaw>(text, "normal"); }
FrictionLaw parse_friction_law(std::string_view text) { return parse<FrictionLaw>(text, "friction"); }

Setting normal_law_setting(std::string_view law, std::string place) {
    return law_setting("normal", law, std::move(place));
}
Setting friction_law_setting(std::string_view law, std::string place) {
    return law_setting("friction", law, std::move(place));
}

std::string law_text(const NormalLaw& law) { return write(law); }
std::string law_text(const FrictionLaw& law) { return write(law); }

}  // namespace footfall
