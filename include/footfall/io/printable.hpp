// Text from elsewhere (a title, a file's name, an option) that no terminal takes for an instruction.
#pragma once

#include <string>
#include <string_view>

namespace footfall {

/// The text on one line of valid UTF-8. What is not to be seen as itself is written out: control characters and line
/// ends as in C (\n, \x1b), characters that turn the direction of writing and other line ends as \u202e, bytes that
/// are no UTF-8 as \xff.
[[nodiscard]] std::string printable(std::string_view text);

/// The same line by line.
[[nodiscard]] std::string printable_lines(std::string_view text);

/// JSON text in which such characters are escapes of JSON. `json` must be JSON already.
[[nodiscard]] std::string printable_json(std::string_view json);

/// A value of nlohmann::json as text, indented, valid UTF-8 and printable; bytes that are no UTF-8 become U+FFFD.
template <class Json>
[[nodiscard]] std::string json_text(const Json& json) {
    return printable_json(json.dump(2, ' ', false, Json::error_handler_t::replace));
}

}  // namespace footfall
