// Every unit that is known, by its symbol or its word, and what quantities are called.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "footfall/io/units.hpp"

namespace footfall::io {

/// A symbol and what it stands for.
struct Symbol {
    std::string_view name;
    Unit unit;
    bool takes_prefix;
    std::string_view usual_prefixes = "";  ///< those that are suggested, a letter each
};

/// What a quantity of this unit is called.
struct NamedDimension {
    std::string_view unit;
    std::string_view name;
};

[[nodiscard]] std::span<const Symbol> unit_symbols();
[[nodiscard]] std::span<const NamedDimension> named_dimensions();

/// Nothing where there is none of that name; prefixes and words are not looked at.
[[nodiscard]] const Symbol* symbol_named(std::string_view name);
/// A symbol or a word, with its prefix; nothing where it is not known.
[[nodiscard]] std::optional<Unit> find_symbol(std::string_view name);
/// What may be suggested: the units that people use, in symbols and in words.
[[nodiscard]] std::vector<std::string> usual_units();

}  // namespace footfall::io
