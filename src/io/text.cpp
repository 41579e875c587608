// Numbers and tables for a terminal.
#include "io/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

namespace footfall::text {
namespace {

/// `value` rounded to `digits` significant digits.
double rounded(double value, int digits) {
    return std::strtod(fmt::format("{:.{}e}", value, digits - 1).c_str(), nullptr);
}

std::string padding(std::size_t size) { return std::string(size, ' '); }

/// A cell split into its number and its unit with the space before it.
struct Split {
    std::string_view number, unit;
};
Split split(std::string_view cell) {
    const std::size_t space = cell.find(' ');
    if (space == std::string_view::npos) return {cell, {}};
    return {cell.substr(0, space), cell.substr(space)};
}

}  // namespace

std::string number(double value, int digits) {
    if (!std::isfinite(value) || value == 0) return fmt::format("{}", value);
    const double shown = rounded(value, digits);
    const int exponent = static_cast<int>(std::floor(std::log10(std::abs(shown))));
    if (exponent >= -4 && exponent < 6) return fmt::format("{}", shown);
    // The shortest digits of the mantissa, and the exponent without its sign and leading zeros: 8.5e6.
    for (int decimals = 0;; ++decimals) {
        const std::string scientific = fmt::format("{:.{}e}", shown, decimals);
        if (decimals + 1 < digits && std::strtod(scientific.c_str(), nullptr) != shown) continue;
        const std::size_t e = scientific.find('e');
        return fmt::format("{}e{}", scientific.substr(0, e), std::atoi(scientific.c_str() + e + 1));
    }
}

Prefix prefix_of(double magnitude) {
    static constexpr std::array prefixes{Prefix{1e-15, "f"}, Prefix{1e-12, "p"}, Prefix{1e-9, "n"},
                                         Prefix{1e-6, "µ"},  Prefix{1e-3, "m"},  Prefix{1, ""},
                                         Prefix{1e3, "k"},   Prefix{1e6, "M"},   Prefix{1e9, "G"}};
    if (!(magnitude > 0) || !std::isfinite(magnitude)) return {1, ""};
    Prefix best = prefixes.front();
    for (const Prefix& prefix : prefixes) {
        if (magnitude >= prefix.factor) best = prefix;
    }
    return best;
}

std::string quantity(double value, std::string_view unit) {
    constexpr int digits = 4;
    if (value == 0 || !std::isfinite(value)) return fmt::format("{} {}", value == 0 ? 0.0 : value, unit);
    const double shown = rounded(value, digits);
    const Prefix prefix = prefix_of(std::abs(shown));
    const double scaled = shown / prefix.factor;
    if (std::abs(scaled) >= 1000 || std::abs(scaled) < 1) return fmt::format("{:.3e} {}", value, unit);
    return fmt::format("{:#.{}g} {}{}", scaled, digits, prefix.symbol, unit);
}

std::string count(long long value) {
    std::string digits = std::to_string(value);
    for (std::size_t i = digits.size(); i > 3; i -= 3) {
        if (digits[i - 4] != '-') digits.insert(i - 3, ",");
    }
    return digits;
}

std::string toml_string(std::string_view text) {
    std::string written = "\"";
    for (const char c : text) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
            written += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        } else {
            if (c == '"' || c == '\\') written += '\\';
            written += c;
        }
    }
    return written + '"';
}

std::size_t width(std::string_view text) {
    // A byte of the form 10xxxxxx goes on with a character that an earlier byte began.
    return static_cast<std::size_t>(std::count_if(
        text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string repeat(std::string_view character, std::size_t length) {
    std::string line;
    for (std::size_t i = 0; i < length; ++i) line += character;
    return line;
}

std::vector<std::string> wrap(std::string_view text, std::size_t columns) {
    std::vector<std::string> lines(1);
    while (!text.empty()) {
        const std::string_view word = text.substr(0, text.find(' '));
        if (!lines.back().empty() && width(lines.back()) + 1 + width(word) > columns) lines.emplace_back();
        if (!lines.back().empty()) lines.back() += ' ';
        lines.back() += word;
        text.remove_prefix(std::min(text.size(), word.size() + 1));
    }
    return lines;
}

std::string hanging(std::string_view text) {
    constexpr std::size_t page_width = 100, indent = 4;
    std::string page;
    for (const std::string& line : wrap(text, page_width - indent))
        page += (page.empty() ? "  " : "    ") + line + '\n';
    return page;
}

void Table::head(std::vector<std::string> names) {
    std::vector<std::string> above;
    for (std::string& name : names) {
        const std::size_t end = name.find('\n');
        above.push_back(end == std::string::npos ? "" : name.substr(0, end));
        if (end != std::string::npos) name.erase(0, end + 1);
    }
    const auto written = [](const std::string& name) { return !name.empty(); };
    if (std::any_of(above.begin(), above.end(), written)) rows_.push_back({Row::Kind::head, std::move(above)});
    rows_.push_back({Row::Kind::head, std::move(names)});
    rule();
}
void Table::row(std::vector<std::string> cells) { rows_.push_back({Row::Kind::cells, std::move(cells)}); }
void Table::rule() { rows_.push_back({Row::Kind::rule, {}}); }
void Table::note(std::string text) { rows_.push_back({Row::Kind::note, {std::move(text)}}); }

std::string Table::aligned(const Row& row, std::size_t column, std::size_t column_width, std::size_t unit_width) const {
    if (row.kind == Row::Kind::rule) return repeat("─", column_width);
    const std::string& cell = column < row.cells.size() ? row.cells[column] : std::string();
    std::size_t after = 0;
    if (alignment_[column] == Align::left) {
        after = column_width - width(cell);
    } else if (alignment_[column] == Align::unit && row.kind == Row::Kind::cells) {
        const std::string_view unit = split(cell).unit;
        after = unit.empty() ? 0 : unit_width - width(unit);
    }
    return padding(column_width - width(cell) - after) + cell + padding(after);
}

std::string Table::str() const {
    const std::size_t columns = alignment_.size();
    std::vector<std::size_t> widths(columns, 0), numbers(columns, 0), units(columns, 0);
    for (const Row& row : rows_) {
        if (row.kind == Row::Kind::note) continue;
        for (std::size_t i = 0; i < row.cells.size(); ++i) {
            widths[i] = std::max(widths[i], width(row.cells[i]));
            if (row.kind == Row::Kind::head || alignment_[i] != Align::unit) continue;
            numbers[i] = std::max(numbers[i], width(split(row.cells[i]).number));
            units[i] = std::max(units[i], width(split(row.cells[i]).unit));
        }
    }
    for (std::size_t i = 0; i < columns; ++i) widths[i] = std::max(widths[i], numbers[i] + units[i]);

    std::string page;
    for (const Row& row : rows_) {
        std::string line = " ";
        if (row.kind == Row::Kind::note) {
            line += " " + row.cells.front();
        } else {
            for (std::size_t i = 0; i < columns; ++i)
                line += (i == 0 ? " " : "  ") + aligned(row, i, widths[i], units[i]);
        }
        line.erase(line.find_last_not_of(' ') + 1);
        page += line + '\n';
    }
    return page;
}

}  // namespace footfall::text
