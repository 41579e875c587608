// Quantities written with their unit: a recursive-descent reader over a table of symbols.
#include "footfall/io/units.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "io/nearest.hpp"
#include "io/read.hpp"

namespace footfall {
namespace {

constexpr double pi = std::numbers::pi;

struct Symbol {
    std::string_view name;
    Unit unit;
    bool takes_prefix;
};

// Sources: the SI brochure (9th edition), tables 2, 4, 7 and 8; the international yard and pound agreement (1959) for
// in, ft and lb, with standard gravity for lbf.
constexpr std::array symbols{
    Symbol{"m", {{0, 1, 0, 0}}, true},
    Symbol{"g", {{1, 0, 0, 0}, 1, -3}, true},
    Symbol{"s", {{0, 0, 1, 0}}, true},
    Symbol{"N", {{1, 1, -2, 0}}, true},
    Symbol{"Pa", {{1, -1, -2, 0}}, true},
    Symbol{"J", {{1, 2, -2, 0}}, true},
    Symbol{"W", {{1, 2, -3, 0}}, true},
    Symbol{"Hz", {{0, 0, -1, 0}}, true},
    Symbol{"rad", {{0, 0, 0, 1}}, true},
    Symbol{"deg", {{0, 0, 0, 1}, pi / 180}, false},
    Symbol{"\u00b0", {{0, 0, 0, 1}, pi / 180}, false},
    Symbol{"rev", {{0, 0, 0, 1}, 2 * pi}, false},
    Symbol{"rpm", {{0, 0, -1, 1}, pi / 30}, false},
    Symbol{"min", {{0, 0, 1, 0}, 60}, false},
    Symbol{"h", {{0, 0, 1, 0}, 3600}, false},
    Symbol{"t", {{1, 0, 0, 0}, 1, 3}, false},
    Symbol{"bar", {{1, -1, -2, 0}, 1, 5}, true},
    Symbol{"in", {{0, 1, 0, 0}, 254, -4}, false},
    Symbol{"ft", {{0, 1, 0, 0}, 3048, -4}, false},
    Symbol{"lb", {{1, 0, 0, 0}, 45359237, -8}, false},
    Symbol{"lbf", {{1, 1, -2, 0}, 4.4482216152605}, false},
    Symbol{"%", {{}, 1, -2}, false},
};

struct Prefix {
    std::string_view name;
    int exponent;
};

constexpr std::array prefixes{Prefix{"da", 1}, Prefix{"h", 2},       Prefix{"k", 3},       Prefix{"M", 6},
                              Prefix{"G", 9},  Prefix{"T", 12},      Prefix{"d", -1},      Prefix{"c", -2},
                              Prefix{"m", -3}, Prefix{"\u00b5", -6}, Prefix{"\u03bc", -6}, Prefix{"u", -6},
                              Prefix{"n", -9}, Prefix{"p", -12}};

std::optional<Unit> find_symbol(std::string_view name) {
    for (const Symbol& symbol : symbols) {
        if (symbol.name == name) return symbol.unit;
    }
    for (const Prefix& prefix : prefixes) {
        if (!name.starts_with(prefix.name)) continue;
        for (const Symbol& symbol : symbols) {
            if (!symbol.takes_prefix || symbol.name != name.substr(prefix.name.size())) continue;
            Unit unit = symbol.unit;
            unit.exponent += prefix.exponent;
            return unit;
        }
    }
    return std::nullopt;
}

/// The symbols, and those with the prefixes that people use, for suggestions.
std::vector<std::string> suggestions() {
    std::vector<std::string> words;
    for (const Symbol& symbol : symbols) words.emplace_back(symbol.name);
    for (const Prefix& prefix : prefixes) {
        for (const Symbol& symbol : symbols) {
            if (symbol.takes_prefix) words.push_back(std::string(prefix.name) + std::string(symbol.name));
        }
    }
    return words;
}

Unit product(const Unit& a, const Unit& b, double sign) {
    const Dimension &d = a.dimension, &e = b.dimension;
    return {{d.mass + sign * e.mass, d.length + sign * e.length, d.time + sign * e.time, d.angle + sign * e.angle},
            sign > 0 ? a.factor * b.factor : a.factor / b.factor,
            a.exponent + sign * b.exponent};
}

Unit raised(const Unit& a, double power) {
    const Dimension& d = a.dimension;
    return {{d.mass * power, d.length * power, d.time * power, d.angle * power},
            std::pow(a.factor, power),
            a.exponent * power};
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The letters of a symbol: ASCII letters, '%', and whatever is not ASCII (the degree sign, mu).
bool is_symbol_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%' || static_cast<unsigned char>(c) >= 0x80;
}

// unit     = [ factor ] { ( "*" | "·" | space ) factor | "/" factor }
// factor   = ( symbol | "1" | "(" unit ")" ) [ "²" | "³" | ( "^" | "**" ) power ]
// power    = number | "(" number [ "/" number ] ")"
class UnitReader {
public:
    explicit UnitReader(std::string_view text) : text_(text), rest_(text) {}

    Unit read() {
        const Unit unit = read_product();
        if (!rest_.empty()) refuse(fmt::format("unexpected '{}'", rest_));
        return unit;
    }

private:
    Unit read_product() {
        Unit unit;
        bool divided = false;
        skip_spaces();
        if (!at_end() && rest_.front() != '/') unit = read_factor();
        for (;;) {
            skip_spaces();
            if (at_end()) return unit;
            if (accept("/")) {
                unit = product(unit, read_factor(), -1);
                divided = true;
                continue;
            }
            // Some read N/m s as (N/m) s and some as N/(m s).
            if (divided) refuse("a product after '/' can be read in two ways: use parentheses");
            if (!rest_.starts_with("**") && !accept("*")) accept("\u00b7");
            unit = product(unit, read_factor(), +1);
        }
    }

    Unit read_factor() {
        skip_spaces();
        Unit unit;
        if (accept("(")) {
            if (++nesting_ > 20) refuse("too many parentheses");
            unit = read_product();
            if (!accept(")")) refuse("a ')' is missing");
            --nesting_;
        } else if (!accept("1")) {
            unit = read_symbol();
        }
        if (accept("\u00b2")) return raised(unit, 2);
        if (accept("\u00b3")) return raised(unit, 3);
        if (accept("^") || accept("**")) return raised(unit, read_power());
        return unit;
    }

    Unit read_symbol() {
        std::size_t length = 0;
        while (length < rest_.size() && is_symbol_letter(rest_[length]) && !ends_symbol(rest_.substr(length))) ++length;
        const std::string_view name = rest_.substr(0, length);
        if (name.empty())
            refuse(rest_.empty() ? "it ends where a unit should stand"
                                 : fmt::format("a unit should stand at '{}'", rest_));
        const std::optional<Unit> unit = find_symbol(name);
        if (!unit) {
            const std::string hint = io::did_you_mean(name, suggestions());
            refuse(fmt::format("unknown unit '{}'{} (units: {}, with SI prefixes)", name, hint, known_units()));
        }
        rest_.remove_prefix(length);
        return *unit;
    }

    static bool ends_symbol(std::string_view text) {
        return text.starts_with("\u00b2") || text.starts_with("\u00b3") || text.starts_with("\u00b7");
    }

    double read_power() {
        skip_spaces();
        if (!accept("(")) return read_number();
        double power = read_number();
        skip_spaces();
        if (accept("/")) {
            const double divisor = read_number();
            if (divisor == 0) refuse("a power with a zero divisor");
            power /= divisor;
            skip_spaces();
        }
        if (!accept(")")) refuse("a ')' is missing");
        return power;
    }

    double read_number() {
        skip_spaces();
        accept("+");
        double value = 0;
        const auto [end, error] =
            std::from_chars(rest_.data(), rest_.data() + rest_.size(), value, std::chars_format::fixed);
        if (error != std::errc{} || !std::isfinite(value) || std::abs(value) > 100) {
            refuse("a power should be a number from -100 to 100");
        }
        rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
        return value;
    }

    [[nodiscard]] bool at_end() const { return rest_.empty() || rest_.front() == ')'; }

    bool accept(std::string_view token) {
        if (!rest_.starts_with(token)) return false;
        rest_.remove_prefix(token.size());
        return true;
    }

    void skip_spaces() {
        while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t')) rest_.remove_prefix(1);
    }

    [[noreturn]] void refuse(const std::string& why) const {
        throw InvalidInput(fmt::format("cannot read the unit '{}': {}", text_, why));
    }

    std::string_view text_;
    std::string_view rest_;
    int nesting_ = 0;
};

std::string_view trimmed(std::string_view text) { return io::trimmed(text, " \t"); }

/// A decimal number as it is written: its digits with sign and point, and its power of ten.
struct Decimal {
    std::string digits;
    double exponent = 0;
    std::size_t length = 0;  ///< of the text that it takes; 0 where there is no number
};

Decimal read_decimal(std::string_view text) {
    Decimal decimal;
    std::size_t i = 0;
    if (i < text.size() && (text[i] == '+' || text[i] == '-')) {
        if (text[i] == '-') decimal.digits += '-';
        ++i;
    }
    int digits = 0;
    for (bool point = false; i < text.size() && (is_digit(text[i]) || (text[i] == '.' && !point)); ++i) {
        if (text[i] == '.')
            point = true;
        else
            ++digits;
        decimal.digits += text[i];
    }
    if (digits == 0) return {};
    // "e" starts an exponent only where digits follow: it could start a unit.
    std::size_t j = i;
    if (j < text.size() && (text[j] == 'e' || text[j] == 'E')) {
        ++j;
        const bool negative = j < text.size() && text[j] == '-';
        if (j < text.size() && (text[j] == '+' || text[j] == '-')) ++j;
        if (j < text.size() && is_digit(text[j])) {
            double exponent = 0;
            for (; j < text.size() && is_digit(text[j]); ++j) exponent = exponent * 10 + (text[j] - '0');
            decimal.exponent = negative ? -exponent : exponent;
            i = j;
        }
    }
    decimal.length = i;
    return decimal;
}

struct NamedDimension {
    std::string_view unit;
    std::string_view name;
};

constexpr std::array names{
    NamedDimension{"1", "a pure number"},
    NamedDimension{"m", "a length"},
    NamedDimension{"m^2", "an area"},
    NamedDimension{"kg", "a mass"},
    NamedDimension{"s", "a time"},
    NamedDimension{"Hz", "a frequency"},
    NamedDimension{"rad", "an angle"},
    NamedDimension{"rad/s", "an angular velocity"},
    NamedDimension{"m/s", "a velocity"},
    NamedDimension{"m/s^2", "an acceleration"},
    NamedDimension{"N", "a force"},
    NamedDimension{"J", "an energy"},
    NamedDimension{"W", "a power"},
    NamedDimension{"Pa", "a pressure"},
    NamedDimension{"kg m^2", "a moment of inertia"},
    NamedDimension{"N/m", "a stiffness"},
    NamedDimension{"N s/m", "a damping"},
    NamedDimension{"N/m^1.5", "a nonlinear stiffness"},
    NamedDimension{"N s/m^1.5", "a nonlinear damping"},
    NamedDimension{"N s/m^2.5", "a damping per area and root of depth"},
};

}  // namespace

bool Dimension::operator==(const Dimension& other) const noexcept {
    constexpr double tolerance = 1e-9;
    return std::abs(mass - other.mass) < tolerance && std::abs(length - other.length) < tolerance &&
           std::abs(time - other.time) < tolerance && std::abs(angle - other.angle) < tolerance;
}

Unit parse_unit(std::string_view text) { return UnitReader(trimmed(text)).read(); }

Quantity parse_quantity(std::string_view text) {
    const std::string_view trim = trimmed(text);
    const Decimal number = read_decimal(trim);
    if (number.length == 0) {
        throw InvalidInput(
            fmt::format("'{}' does not start with a number: write a number and its unit, as in "
                        "\"1.65 cm\"",
                        text));
    }
    const Unit unit = parse_unit(trim.substr(number.length));
    const double whole = std::round(unit.exponent);
    const bool exact = std::abs(unit.exponent - whole) < 1e-9;
    const double exponent = number.exponent + (exact ? whole : 0);

    double value = 0;
    const std::string decimal = fmt::format("{}e{:.0f}", number.digits, exponent);
    const auto parsed = std::from_chars(decimal.data(), decimal.data() + decimal.size(), value);
    value *= unit.factor;
    if (!exact) value *= std::pow(10.0, unit.exponent);
    if (parsed.ec != std::errc{} || !std::isfinite(value)) {
        throw InvalidInput(fmt::format("'{}' is outside the range of a double", text));
    }
    return {value, unit.dimension};
}

double to_si(std::string_view quantity, std::string_view si_unit) {
    const Quantity read = parse_quantity(quantity);
    const Dimension wanted = parse_unit(si_unit).dimension;
    if (read.dimension == wanted) return read.value;
    if (read.dimension == Dimension{}) {
        throw InvalidInput(fmt::format("expected {}, got '{}' without a unit (a number without quotes is in {})",
                                       describe(wanted), quantity, si_unit));
    }
    throw InvalidInput(fmt::format("expected {}, got {}: '{}'", describe(wanted), describe(read.dimension), quantity));
}

std::string describe(const Dimension& dimension) {
    for (const NamedDimension& named : names) {
        if (parse_unit(named.unit).dimension != dimension) continue;
        return named.unit == "1" ? std::string(named.name) : fmt::format("{} ({})", named.name, named.unit);
    }
    std::string unit;
    const auto append = [&unit](std::string_view symbol, double power) {
        if (power == 0) return;
        if (!unit.empty()) unit += ' ';
        unit += power == 1 ? std::string(symbol) : fmt::format("{}^{:.6g}", symbol, power);
    };
    append("kg", dimension.mass);
    append("m", dimension.length);
    append("s", dimension.time);
    append("rad", dimension.angle);
    return fmt::format("a quantity in {}", unit);
}

std::string known_units() {
    std::vector<std::string> words;
    for (const Symbol& symbol : symbols) words.emplace_back(symbol.name);
    return io::listed(words);
}

}  // namespace footfall
