// Quantities on the command line: a number in SI units, or a number with its unit.
#pragma once

#include <string_view>

#include "context.hpp"
#include "footfall/io/units.hpp"

namespace footfall::cli {

/// The SI value of what was given for `option`; `unit` is its SI unit. Throws InvalidInput, naming the option.
[[nodiscard]] inline double quantity(std::string_view option, std::string_view text, std::string_view unit) {
    return in_context(option, [&] { return plain_or_si(text, unit); });
}

}  // namespace footfall::cli
