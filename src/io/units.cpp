// Quantities written with their unit: a recursive-descent reader over the symbols of unit_symbols.hpp.
#include "footfall/io/units.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "io/nearest.hpp"
#include "io/read.hpp"
#include "io/unit_symbols.hpp"

namespace footfall {
namespace {

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

/// The unit that a quantity should be in a multiple of.
struct Wanted {
    Dimension dimension;
    std::string_view unit;
};

// unit     = [ factor ] { ( "*" | "·" | space ) factor | "/" factor }
// factor   = ( symbol | "1" | "(" unit ")" ) [ "²" | "³" | ( "^" | "**" ) power ]
// power    = number | "(" number [ "/" number ] ")"
class UnitReader {
public:
    /// `wanted` is the dimension that the unit should have, where that is known: suggestions keep to it.
    explicit UnitReader(std::string_view text, const Wanted* wanted = nullptr)
        : text_(text), rest_(text), wanted_(wanted) {}

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
        const std::optional<Unit> unit = io::find_symbol(name);
        if (!unit) {
            const std::string hint = io::did_you_mean(name, candidates(name));
            refuse(fmt::format("unknown unit '{}'{} ({})", name, hint, allowed()));
        }
        rest_.remove_prefix(length);
        return *unit;
    }

    /// The usual units that can stand here in place of `name`.
    [[nodiscard]] std::vector<std::string> candidates(std::string_view name) const {
        std::vector<std::string> usual = io::usual_units();
        if (!wanted_) return usual;
        const std::string before(text_.substr(0, text_.size() - rest_.size()));
        const std::string after(rest_.substr(name.size()));
        std::vector<std::string> fitting;
        for (const std::string& unit : usual) {
            try {
                if (parse_unit(before + unit + after).dimension == wanted_->dimension) fitting.push_back(unit);
            } catch (const InvalidInput&) {
                return usual;  // something else is wrong as well: what would fit is not known
            }
        }
        return fitting;
    }

    /// "for a mass (kg): g, t, lb, oz", or all units where the wanted one has no symbol of its own.
    [[nodiscard]] std::string allowed() const {
        std::vector<std::string> names;
        bool prefixes_too = false;
        for (const io::Symbol& symbol : io::unit_symbols()) {
            if (!wanted_ || symbol.unit.dimension != wanted_->dimension) continue;
            names.emplace_back(symbol.name);
            prefixes_too = prefixes_too || symbol.takes_prefix;
        }
        if (names.empty()) return fmt::format("units: {}, with SI prefixes", known_units());
        return fmt::format("for {}: {}{}", describe(wanted_->dimension), io::listed(names),
                           prefixes_too ? ", with SI prefixes" : "");
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
    const Wanted* wanted_;
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

/// The digits of a decimal number times a whole number, exactly.
std::string times(const std::string& digits, std::uint64_t factor) {
    std::string product;  // backwards
    std::uint64_t carry = 0;
    for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit) {
        if (is_digit(*digit)) {
            carry += static_cast<std::uint64_t>(*digit - '0') * factor;
            product += static_cast<char>('0' + carry % 10);
            carry /= 10;
        } else if (*digit == '.') {
            product += '.';
        }
    }
    for (; carry > 0; carry /= 10) product += static_cast<char>('0' + carry % 10);
    if (digits.starts_with('-')) product += '-';
    return {product.rbegin(), product.rend()};
}

Quantity read_quantity(std::string_view text, const Wanted* wanted) {
    const std::string_view trim = trimmed(text);
    const Decimal number = read_decimal(trim);
    if (number.length == 0) {
        const std::string_view unit = wanted ? wanted->unit : "cm";
        throw InvalidInput(unit == "1" ? fmt::format("'{}' is not a number", text)
                                       : fmt::format("'{}' does not start with a number: write a number and its unit, "
                                                     "as in \"1.65 {}\"",
                                                     text, unit));
    }
    const Unit unit = UnitReader(trimmed(trim.substr(number.length)), wanted).read();
    const double whole = std::round(unit.exponent);
    const bool exact = std::abs(unit.exponent - whole) < 1e-9;
    const double exponent = number.exponent + (exact ? whole : 0);
    constexpr double most = 9007199254740992;  // 2^53: whole numbers up to here are exact in a double
    const bool decimal_factor = unit.factor == std::floor(unit.factor) && unit.factor <= most;

    double value = 0;
    const std::string decimal = fmt::format(
        "{}e{:.0f}", decimal_factor ? times(number.digits, static_cast<std::uint64_t>(unit.factor)) : number.digits,
        exponent);
    const auto parsed = std::from_chars(decimal.data(), decimal.data() + decimal.size(), value);
    if (!decimal_factor) value *= unit.factor;
    if (!exact) value *= std::pow(10.0, unit.exponent);
    if (parsed.ec != std::errc{} || !std::isfinite(value)) {
        throw InvalidInput(fmt::format("'{}' is outside the range of a double", text));
    }
    return {value, unit.dimension};
}

}  // namespace

bool Dimension::operator==(const Dimension& other) const noexcept {
    constexpr double tolerance = 1e-9;
    return std::abs(mass - other.mass) < tolerance && std::abs(length - other.length) < tolerance &&
           std::abs(time - other.time) < tolerance && std::abs(angle - other.angle) < tolerance;
}

Unit parse_unit(std::string_view text) { return UnitReader(trimmed(text)).read(); }

Quantity parse_quantity(std::string_view text) { return read_quantity(text, nullptr); }

double to_si(std::string_view quantity, std::string_view si_unit) {
    const Wanted expected{parse_unit(si_unit).dimension, si_unit};
    const Dimension& wanted = expected.dimension;
    const Quantity read = read_quantity(quantity, &expected);
    if (read.dimension == wanted) return read.value;
    if (read.dimension == Dimension{}) {
        throw InvalidInput(fmt::format("expected {}, got '{}' without a unit (a number without quotes is in {})",
                                       describe(wanted), quantity, si_unit));
    }
    const bool meant_gravity =
        wanted == io::symbol_named("gn")->unit.dimension && read.dimension == io::symbol_named("g")->unit.dimension;
    throw InvalidInput(fmt::format("expected {}, got {}: '{}'{}", describe(wanted), describe(read.dimension), quantity,
                                   meant_gravity ? "; 'g' is the gram, standard gravity is 'gn'" : ""));
}

double plain_or_si(std::string_view text, std::string_view si_unit) {
    const std::string_view trim = trimmed(text);
    const bool plain = !trim.empty() && read_decimal(trim).length == trim.size();
    return plain ? parse_quantity(trim).value : to_si(text, si_unit);
}

std::string describe(const Dimension& dimension) {
    for (const io::NamedDimension& named : io::named_dimensions()) {
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
    std::vector<std::string> all;
    for (const io::Symbol& symbol : io::unit_symbols()) all.emplace_back(symbol.name);
    return io::listed(all);
}

}  // namespace footfall
