// Characters of UTF-8, and text that is in an older encoding.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace footfall::io {

/// A character, and how many bytes it has.
struct Character {
    char32_t code;
    std::size_t size;
};

/// The first character of UTF-8 text that is not empty; none where it does not begin with one (RFC 3629: no overlong
/// forms, no surrogates, nothing above U+10FFFF).
[[nodiscard]] std::optional<Character> first_character(std::string_view text);

[[nodiscard]] bool is_utf8(std::string_view text);

/// Windows-1252 text, of which Latin-1 is the printable part, as UTF-8. Bytes that it leaves open become U+FFFD.
[[nodiscard]] std::string from_windows_1252(std::string_view text);

}  // namespace footfall::io
