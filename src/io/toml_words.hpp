// What toml++ says about a text that is not TOML, in the words of the person who wrote it.
#pragma once

#include <string>
#include <string_view>

#include "io/problems.hpp"

namespace footfall::io {

/// `description` is what toml++ says, `at` where, in `text`. Nothing of its own words is left.
[[nodiscard]] std::string in_plain_words(std::string_view description, std::string_view text, const Position& at);

/// "the string that begins here is not closed: ...", for '"', '\'', '[' and '{'.
[[nodiscard]] std::string not_closed(char what);

}  // namespace footfall::io
