// What the values of options are checked against, with messages that say what is allowed.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace footfall::cli {

// For Option::transform: what is a number in other words, such as "20 %", becomes a plain one.

/// A finite number.
[[nodiscard]] CLI::Validator number();

/// A relative tolerance, from 1e-14 to 1e-3.
[[nodiscard]] CLI::Validator tolerance();

/// A whole number in this range.
[[nodiscard]] CLI::Validator whole_number(int low, int high);

/// For Option::check. One of these words; the nearest is suggested.
[[nodiscard]] CLI::Validator one_of(std::vector<std::string> words);

}  // namespace footfall::cli
