// Text from elsewhere that no terminal takes for an instruction.
#include "footfall/io/printable.hpp"

#include <fmt/format.h>

#include "io/utf8.hpp"

namespace footfall {
namespace {

using io::first_character;

/// A terminal would act on it, or a reader would not see it where it stands.
bool acts(char32_t c) {
    return c < 0x20 || (c >= 0x7f && c < 0xa0)                                               // C0, DEL, C1
           || c == 0x2028 || c == 0x2029                                                     // line ends
           || c == 0x61c || c == 0x200e || c == 0x200f                                       // marks of direction
           || (c >= 0x202a && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069)                   // bidirectional overrides
           || (c >= 0xfff9 && c <= 0xfffb) || c == 0xfeff || (c >= 0xe0000 && c < 0xe0080);  // not seen at all
}

std::string written_out(char32_t c) {
    switch (c) {
        case '\n':
            return "\\n";
        case '\r':
            return "\\r";
        case '\t':
            return "\\t";
        default:
            break;
    }
    const auto number = static_cast<unsigned>(c);
    if (number < 0x80) return fmt::format("\\x{:02x}", number);
    return number < 0x10000 ? fmt::format("\\u{:04x}", number) : fmt::format("\\U{:08x}", number);
}

std::string clean(std::string_view text, bool keep_line_ends) {
    std::string result;
    result.reserve(text.size());
    while (!text.empty()) {
        const auto character = first_character(text);
        const std::size_t size = character ? character->size : 1;
        if (!character) {
            result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
        } else if (acts(character->code) && !(keep_line_ends && character->code == '\n')) {
            result += written_out(character->code);
        } else {
            result += text.substr(0, size);
        }
        text.remove_prefix(size);
    }
    return result;
}

}  // namespace

std::string printable(std::string_view text) { return clean(text, false); }

std::string printable_lines(std::string_view text) { return clean(text, true); }

std::string printable_json(std::string_view json) {
    std::string result;
    result.reserve(json.size());
    while (!json.empty()) {
        const auto character = first_character(json);
        const std::size_t size = character ? character->size : 1;
        if (!character) {
            result += "\\ufffd";
        } else if (character->code >= 0x7f && acts(character->code)) {  // below it JSON's own escapes are there
            const auto code = static_cast<unsigned>(character->code);
            if (code < 0x10000) {
                result += fmt::format("\\u{:04x}", code);
            } else {  // RFC 8259, section 7: two surrogates
                result += fmt::format("\\u{:04x}\\u{:04x}", 0xd800U + ((code - 0x10000U) >> 10U),
                                      0xdc00U + ((code - 0x10000U) & 0x3ffU));
            }
        } else {
            result += json.substr(0, size);
        }
        json.remove_prefix(size);
    }
    return result;
}

}  // namespace footfall
