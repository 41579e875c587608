#include "io/toml_words.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include <fmt/format.h>

#include "io/read.hpp"

namespace footfall::io {
namespace {

bool contains(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

/// What stands between `before` and the next `after`; empty where there is no such thing.
std::string_view between(std::string_view text, std::string_view before, std::string_view after) {
    const std::size_t begin = text.find(before);
    if (begin == std::string_view::npos) return {};
    text.remove_prefix(begin + before.size());
    return text.substr(0, text.find(after));
}

std::string_view line_of(std::string_view text, int line) {
    for (; line > 1; --line) {
        const std::size_t end = text.find('\n');
        if (end == std::string_view::npos) return {};
        text.remove_prefix(end + 1);
    }
    return text.substr(0, text.find('\n'));
}

/// The byte of the line that its character `column`, from 1, begins at.
std::size_t byte_of(std::string_view line, int column) {
    std::size_t byte = 0;
    while (byte < line.size() && column > 1) {
        ++byte;
        while (byte < line.size() && (static_cast<unsigned char>(line[byte]) & 0xC0U) == 0x80U) ++byte;
        --column;
    }
    return byte;
}

/// One error of the parser, with the line that it is in.
class Sentence {
public:
    Sentence(std::string_view description, std::string_view text, const Position& at) : line_(line_of(text, at.line)) {
        constexpr std::string_view opening = "Error while parsing ";
        const std::size_t colon = description.find(": ");
        if (description.starts_with(opening) && colon != std::string_view::npos) {
            scope_ = description.substr(opening.size(), colon - opening.size());
            description.remove_prefix(colon + 2);
        }
        reason_ = description;
        if (const std::size_t saw = reason_.find("saw '"); saw != std::string_view::npos) {
            const std::string_view rest = reason_.substr(saw + 5);
            saw_ = rest.substr(0, rest.rfind('\''));
        }
        const std::size_t here = byte_of(line_, at.column);
        // The value that the error is in or behind.
        const std::size_t start = line_.substr(0, std::min(here + 1, line_.size())).find_last_of("=[{,");
        before_ = line_.substr(0, here);
        if (start != std::string_view::npos) {
            value_ = line_.substr(start + 1);
            value_ = trimmed(value_.substr(0, value_.find_first_of(",]}#")));
        }
    }

    [[nodiscard]] std::string say() const {
        if (contains(reason_, "utf-8")) return "this is not UTF-8; save the file in that encoding";
        if (contains(reason_, "cannot redefine") || contains(reason_, "cannot insert")) return twice();
        if (contains(scope_, "string") || contains(scope_, "scalar")) return string();
        if (scope_ == "root table") return line_start();
        if (scope_ == "key") return key();
        if (scope_ == "table header") return header();
        if (scope_ == "array" || scope_ == "inline table") return list();
        if (contains(reason_, "expected '='")) return equals_sign();
        if (contains(reason_, "expected value,") || value_missing()) return "a value is missing";
        if (scope_ == "key-value pair" && contains(reason_, "end-of-file") && !contains(line_, "=")) {
            return equals_sign();
        }
        return value();
    }

private:
    [[nodiscard]] bool value_missing() const {
        return value_.empty() && contains(reason_, "end-of-file") && contains(line_, "=");
    }

    [[nodiscard]] std::string unexpected() const {
        return saw_.empty() ? "unexpected end" : fmt::format("unexpected '{}'", shown(saw_));
    }

    [[nodiscard]] std::string twice() const {
        const std::string name = shown(between(reason_, " '", "'"));
        const bool header = scope_ == "table header";
        if (contains(reason_, "cannot insert")) {
            return fmt::format("'{}' cannot be added: the table in braces ends with its '}}'", name);
        }
        if (contains(reason_, "array-of-tables")) {
            return fmt::format("'{}' is there already, as {}; it cannot be a list of tables, [[{}]], too", name,
                               contains(reason_, "existing table") ? fmt::format("[{}]", name) : "a value", name);
        }
        if (header && contains(reason_, "existing array")) {
            return fmt::format("'{}' is a list already; one more table of it is written [[{}]]", name, name);
        }
        if (header && contains(reason_, "existing table")) {
            return fmt::format("the table [{}] is there twice; put all its keys under one", name);
        }
        if (name.empty()) return "the name before the dot has a value already; it cannot be a table too";
        if (header) return fmt::format("'{}' has a value already; it cannot be a table too", name);
        return fmt::format("'{}' is there twice", name);
    }

    [[nodiscard]] std::string string() const {
        if (contains(reason_, "unknown escape")) {
            return fmt::format(
                "'{}' is nothing that a string knows; write a backslash as \\\\, or put the text in "
                "single quotes",
                shown(between(reason_, "sequence '", "'")));
        }
        if (contains(reason_, "control characters")) {
            return "a control character in a string; write it as \\n, \\t or \\u0007";
        }
        if (contains(reason_, "end-of-file")) return not_closed('"');
        return "after \\u come four hexadecimal digits, after \\U eight, of a character that exists";
    }

    [[nodiscard]] std::string line_start() const {
        if (saw_ == "/") return "a comment begins with '#'";
        if (saw_ == "=") return "the key before '=' is missing";
        constexpr std::string_view what =
            "expected a key, a table's name in brackets, or a comment that begins with '#'";
        const bool letter = !saw_.empty() && (static_cast<unsigned char>(saw_.front()) & 0x80U) != 0;
        return fmt::format("{}: {}{}", unexpected(), what, letter ? "; other letters than A to Z need quotes" : "");
    }

    [[nodiscard]] std::string key() const {
        if (contains(reason_, "multi-line")) return "a key cannot have three quotes";
        return fmt::format("{}: a name is missing beside the dot", unexpected());
    }

    [[nodiscard]] std::string header() const {
        if (contains(reason_, "blank")) return "the name of the table between the brackets is missing";
        if (contains(reason_, "end-of-file") || contains(reason_, "expected ']'")) {
            return fmt::format("{}: the name of a table ends with ']', that of a list of tables with ']]'",
                               unexpected());
        }
        if (contains(reason_, "comment or whitespace")) {
            return fmt::format("{}: keys of a table begin on the next line", unexpected());
        }
        return fmt::format("{} in the name of a table", unexpected());
    }

    [[nodiscard]] std::string list() const {
        const bool array = scope_ == "array";
        if (contains(reason_, "dangling")) return "the comma before '}' is one too many";
        if (contains(reason_, "saw comma")) return "a value is missing between the commas";
        if (contains(reason_, "end-of-file")) return not_closed(array ? '[' : '{');
        if (saw_ == "\\n" && !array)
            return "a table in braces is on one line; write it as [table] with a line for each key";
        if (contains(reason_, "comma or closing")) {
            return fmt::format("{}: expected ',' or '{}'", unexpected(), array ? ']' : '}');
        }
        return fmt::format("{}: expected {}", unexpected(), array ? "a value or ']'" : "a key or '}'");
    }

    [[nodiscard]] std::string equals_sign() const {
        const std::string_view name = trimmed(before_);
        if (saw_ == ":") return fmt::format("write '{} = ...', not ':'", shown(trimmed(name, " \t:")));
        return name.empty() ? "'=' and a value are missing" : fmt::format("'=' is missing after '{}'", shown(name));
    }

    /// What is no value, and what was meant by it.
    [[nodiscard]] std::string value() const {
        if (value_.empty()) return fmt::format("{}: this is no value", unexpected());
        const std::string said = shown(value_);
        if (trimmed(before_).ends_with('=') && line_.substr(before_.size(), 1) == "=") {
            return "write one '=', not two";
        }
        std::string small(value_);
        std::transform(small.begin(), small.end(), small.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        for (const char* word : {"true", "false"}) {
            if (small == word && value_ != word) return fmt::format("write {}, in small letters", word);
        }
        if (saw_ == "," && before_.find('=') != std::string_view::npos && decimal_comma()) {
            return "a number has a decimal point, not a comma";
        }
        if (begins_with_number()) {
            if (contains(reason_, "representable") || contains(reason_, "could not be interpreted") ||
                contains(reason_, "length limit") || contains(reason_, "too long")) {
                return fmt::format("{} is too large for a number", said);
            }
            if (contains(reason_, "leading zero")) return fmt::format("{}: a number begins with no extra zero", said);
            if (const auto unit = unit_behind(); unit) {
                return fmt::format("'{}' is no number; with its unit it is in quotes: \"{}\"", said, said);
            }
            if (saw_ == "=" || contains(value_, "=")) {
                return fmt::format("{}: one key and its value to a line", unexpected());
            }
            if (value_.front() == '.' || value_.back() == '.') {
                return fmt::format("'{}' is no number: there are digits on both sides of the decimal point", said);
            }
            return fmt::format("'{}' is no number", said);
        }
        if (contains(reason_, "comment or whitespace") && contains("\"'", value_.substr(0, 1))) {
            return fmt::format("{} behind the string: expected the end of the line, or a comment that begins with '#'",
                               unexpected());
        }
        if (contains(reason_, "comment or whitespace")) {
            return fmt::format("{}: expected the end of the line, or a comment that begins with '#'", unexpected());
        }
        return fmt::format("'{}' is no value: expected a number, a text in quotes, true or false", said);
    }

    [[nodiscard]] bool begins_with_number() const {
        std::string_view rest = value_;
        if (rest.starts_with('+') || rest.starts_with('-')) rest.remove_prefix(1);
        if (rest.starts_with('.')) rest.remove_prefix(1);
        return !rest.empty() && std::isdigit(static_cast<unsigned char>(rest.front())) != 0;
    }

    /// "1,5": digits right before and right behind the comma.
    [[nodiscard]] bool decimal_comma() const {
        const std::size_t comma = before_.size();
        const auto digit = [this](std::size_t i) {
            return i < line_.size() && std::isdigit(static_cast<unsigned char>(line_[i])) != 0;
        };
        return comma > 0 && digit(comma - 1) && digit(comma + 1);
    }

    /// "154 g", "10%": what is behind the number begins with a letter or a sign that units have.
    [[nodiscard]] std::optional<std::string_view> unit_behind() const {
        const std::size_t end = value_.find_first_not_of("+-.0123456789eE_");
        if (end == std::string_view::npos || (end == 1 && value_.front() == '0')) return std::nullopt;  // 0x, 0b, 0o
        const std::string_view behind = trimmed(value_.substr(end));
        if (behind.empty() || contains(behind, "=")) return std::nullopt;
        const auto first = static_cast<unsigned char>(behind.front());
        const bool unit = std::isalpha(first) != 0 || first == '%' || (first & 0x80U) != 0;
        return unit ? std::optional(behind) : std::nullopt;
    }

    std::string_view line_, before_, value_;
    std::string_view scope_, reason_, saw_;
};

}  // namespace

std::string in_plain_words(std::string_view description, std::string_view text, const Position& at) {
    return Sentence(description, text, at).say();
}

std::string not_closed(char what) {
    if (what == '[') return "the '[' is not closed with ']'";
    if (what == '{') return "the '{' is not closed with '}'";
    return fmt::format(
        "the text in quotes that begins here is not closed with {0} on its line, or {0}{0}{0} where it began so", what);
}

}  // namespace footfall::io
