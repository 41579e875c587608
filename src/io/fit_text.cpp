// What of a law is to be fitted, from one line of text.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "footfall/io/fit_data.hpp"
#include "footfall/io/law_text.hpp"
#include "footfall/io/units.hpp"
#include "io/read.hpp"

namespace footfall {
namespace {

using io::plain_number;
using io::trimmed;

double read_number(std::string_view text, std::string_view unit, bool plain_only) {
    if (const auto plain = plain_number(text); plain && std::isfinite(*plain)) return *plain;
    if (plain_only) {
        throw InvalidInput(
            fmt::format("expected a plain number (its unit depends on other parameters), got '{}'", text));
    }
    return to_si(text, unit);
}

}  // namespace

FitValue parse_fit_value(std::string_view text, std::string_view unit, bool plain_only) {
    text = trimmed(text);
    FitValue read;
    if (!text.starts_with('?')) {
        read.value = read_number(text, unit, plain_only);
        return read;
    }
    read.free = true;
    const std::string_view rest = trimmed(text.substr(1));
    if (rest.empty()) return read;
    const std::size_t dots = rest.find("..");
    if (dots == std::string_view::npos) {
        read.value = read_number(rest, unit, plain_only);
        return read;
    }
    read.low = read_number(trimmed(rest.substr(0, dots)), unit, plain_only);
    read.high = read_number(trimmed(rest.substr(dots + 2)), unit, plain_only);
    if (!(*read.low < *read.high)) {
        throw InvalidInput(fmt::format("'{}': the lower bound must come first, as in ?1e3..1e5", text));
    }
    return read;
}

FitLaw parse_fit_law(std::string_view text) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    // What parse_normal_law is to check, with a number that every parameter allows in place of those to be fitted.
    std::string given(text.substr(0, colon));
    std::vector<std::pair<std::string, std::string_view>> free;
    char separator = ':';
    for (std::size_t begin = colon; begin < text.size();) {
        const std::size_t comma = std::min(text.find(',', begin + 1), text.size());
        const std::string_view setting = text.substr(begin + 1, comma - begin - 1);
        const std::size_t equals = setting.find('=');
        const std::string_view value = equals == std::string_view::npos ? "" : trimmed(setting.substr(equals + 1));
        given += std::exchange(separator, ',');
        if (value.starts_with('?')) {
            free.emplace_back(trimmed(setting.substr(0, equals)), value);
            given += fmt::format("{}=1", free.back().first);
        } else {
            given += setting;
        }
        begin = comma;
    }
    FitLaw law{parse_normal_law(given), {}};
    if (free.empty()) {
        throw InvalidInput(fmt::format(
            "normal law '{}': nothing is to be fitted; mark what is with a question mark, as in stiffness=?", text));
    }
    std::visit(
        [&]<class Law>(const Law&) {
            for (const auto& [key, value] : free) {
                for (const auto& parameter : Law::parameters()) {
                    if (parameter.key != key) continue;
                    try {
                        law.free.push_back({key, parse_fit_value(value, parameter.unit, parameter.unit_depends)});
                    } catch (const InvalidInput& error) {
                        throw InvalidInput(
                            fmt::format("normal law '{}': {}: {}", Law::description.name, key, error.what()));
                    }
                    const FitValue& read = law.free.back().value;
                    for (const auto& number : {read.value, read.low, read.high}) {
                        if (number && !(*number > 0 && parameter.allows(*number))) {
                            throw InvalidInput(fmt::format(
                                "normal law '{}': {}={}: a parameter is fitted in its "
                                "logarithm; allowed is > 0{}",
                                Law::description.name, key, value, parameter.at_most_one ? " and <= 1" : ""));
                        }
                    }
                }
            }
        },
        law.law);
    return law;
}

}  // namespace footfall
