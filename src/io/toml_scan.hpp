// Looks over a TOML text before it is parsed: how deep it nests, and what it opens and does not close.
#pragma once

#include <optional>
#include <string_view>

#include "io/problems.hpp"

namespace footfall::io {

/// What a text opens and does not close.
struct Unclosed {
    Position at;
    char what = '"';  ///< '[', '{', or the quote of a string
};

struct TomlScan {
    /// Where the text nests deeper than a parser's stack should have to bear; the rest has not been looked at.
    std::optional<Position> too_deep;
    /// The first string that does not end where it must, or the innermost bracket that is open at the end.
    std::optional<Unclosed> unclosed;
};

/// The most brackets that may be open, and the most dots that a key may have: a scenario needs two of the first and
/// three of the second.
inline constexpr int deepest_toml = 32;

/// Never recurses, and takes time in proportion to the text. A text that is not TOML is looked at as far as it makes
/// sense.
[[nodiscard]] TomlScan scan_toml(std::string_view text);

}  // namespace footfall::io
