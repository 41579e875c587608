// Quantities written with their unit: a recursive-descent reader over a table of symbols.
#include "footfall/io/units.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
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
    std::string_view usual_prefixes = "";  ///< those that are suggested, a letter each
};

// Sources: the SI brochure (9th edition), tables 2, 4, 7 and 8; the international yard and pound agreement (1959) for
// in, ft, yd, mi, lb and oz = lb/16; NIST SP 811 (2008), appendix B.8, for standard gravity gn = 9.80665 m/s^2 exactly,
// hence kgf, lbf = lb gn and psi = lbf/in^2, and for the nautical mile of 1852 m in the knot. kn and kt are not known:
// they read as kN and kilotonne.
constexpr std::array symbols{
    Symbol{"m", {{0, 1, 0, 0}}, true, "mcukn"},
    Symbol{"g", {{1, 0, 0, 0}, 1, -3}, true, "km"},
    Symbol{"s", {{0, 0, 1, 0}}, true, "mun"},
    Symbol{"sec", {{0, 0, 1, 0}}, true, "mu"},
    Symbol{"N", {{1, 1, -2, 0}}, true, "kmM"},
    Symbol{"Pa", {{1, -1, -2, 0}}, true, "kMG"},
    Symbol{"J", {{1, 2, -2, 0}}, true, "mk"},
    Symbol{"W", {{1, 2, -3, 0}}, true, "mk"},
    Symbol{"Hz", {{0, 0, -1, 0}}, true, "kM"},
    Symbol{"rad", {{0, 0, 0, 1}}, true, "m"},
    Symbol{"deg", {{0, 0, 0, 1}, pi / 180}, false},
    Symbol{"\u00b0", {{0, 0, 0, 1}, pi / 180}, false},
    Symbol{"rev", {{0, 0, 0, 1}, 2 * pi}, false},
    Symbol{"rpm", {{0, 0, -1, 1}, pi / 30}, false},
    Symbol{"min", {{0, 0, 1, 0}, 60}, false},
    Symbol{"h", {{0, 0, 1, 0}, 3600}, false},
    Symbol{"t", {{1, 0, 0, 0}, 1, 3}, false},
    Symbol{"bar", {{1, -1, -2, 0}, 1, 5}, true, "m"},
    Symbol{"micron", {{0, 1, 0, 0}, 1, -6}, false},
    Symbol{"in", {{0, 1, 0, 0}, 254, -4}, false},
    Symbol{"ft", {{0, 1, 0, 0}, 3048, -4}, false},
    Symbol{"yd", {{0, 1, 0, 0}, 9144, -4}, false},
    Symbol{"mi", {{0, 1, 0, 0}, 1609344, -3}, false},
    Symbol{"lb", {{1, 0, 0, 0}, 45359237, -8}, false},
    Symbol{"oz", {{1, 0, 0, 0}, 28349523125, -12}, false},
    Symbol{"kgf", {{1, 1, -2, 0}, 980665, -5}, false},
    Symbol{"lbf", {{1, 1, -2, 0}, 44482216152605, -13}, false},
    Symbol{"psi", {{1, -1, -2, 0}, 6894.7572931683613}, false},
    Symbol{"ksi", {{1, -1, -2, 0}, 6894.7572931683613, 3}, false},
    Symbol{"mph", {{0, 1, -1, 0}, 44704, -5}, false},
    Symbol{"knot", {{0, 1, -1, 0}, 1852.0 / 3600}, false},
    Symbol{"gn", {{0, 1, -2, 0}, 980665, -5}, false},
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

/// A unit written out, with its plural; it means what the symbol means.
struct Word {
    std::string_view one, many;
    std::string_view symbol;
};

constexpr std::array words{
    Word{"metre", "metres", "m"},        Word{"meter", "meters", "m"},     Word{"gram", "grams", "g"},
    Word{"second", "seconds", "s"},      Word{"newton", "newtons", "N"},   Word{"pascal", "pascals", "Pa"},
    Word{"joule", "joules", "J"},        Word{"watt", "watts", "W"},       Word{"hertz", "hertz", "Hz"},
    Word{"radian", "radians", "rad"},    Word{"degree", "degrees", "deg"}, Word{"revolution", "revolutions", "rev"},
    Word{"minute", "minutes", "min"},    Word{"hour", "hours", "h"},       Word{"tonne", "tonnes", "t"},
    Word{"micron", "microns", "micron"}, Word{"inch", "inches", "in"},     Word{"foot", "feet", "ft"},
    Word{"yard", "yards", "yd"},         Word{"mile", "miles", "mi"},      Word{"pound", "pounds", "lb"},
    Word{"ounce", "ounces", "oz"},       Word{"knot", "knots", "knot"},    Word{"percent", "percent", "%"},
};

/// What goes before a word whose symbol takes prefixes.
constexpr std::array word_prefixes{Prefix{"", 0},       Prefix{"kilo", 3},   Prefix{"mega", 6},   Prefix{"giga", 9},
                                   Prefix{"tera", 12},  Prefix{"hecto", 2},  Prefix{"deca", 1},   Prefix{"deci", -1},
                                   Prefix{"centi", -2}, Prefix{"milli", -3}, Prefix{"micro", -6}, Prefix{"nano", -9},
                                   Prefix{"pico", -12}};

const Symbol* symbol_named(std::string_view name) {
    for (const Symbol& symbol : symbols) {
        if (symbol.name == name) return &symbol;
    }
    return nullptr;
}

Unit prefixed(const Symbol& symbol, const Prefix& prefix) {
    Unit unit = symbol.unit;
    unit.exponent += prefix.exponent;
    return unit;
}

std::optional<Unit> find_symbol(std::string_view name) {
    if (const Symbol* symbol = symbol_named(name)) return symbol->unit;
    for (const Prefix& prefix : prefixes) {
        if (!name.starts_with(prefix.name)) continue;
        const Symbol* symbol = symbol_named(name.substr(prefix.name.size()));
        if (symbol && symbol->takes_prefix) return prefixed(*symbol, prefix);
    }
    for (const Prefix& prefix : word_prefixes) {
        if (!name.starts_with(prefix.name)) continue;
        const std::string_view rest = name.substr(prefix.name.size());
        for (const Word& word : words) {
            if (rest != word.one && rest != word.many) continue;
            const Symbol& symbol = *symbol_named(word.symbol);
            if (prefix.name.empty() || symbol.takes_prefix) return prefixed(symbol, prefix);
        }
    }
    return std::nullopt;
}

/// What may be suggested: the units that people use, in symbols and in words.
std::vector<std::string> usual_units() {
    std::vector<std::string> usual;
    for (const Symbol& symbol : symbols) {
        usual.emplace_back(symbol.name);
        for (const char prefix : symbol.usual_prefixes) usual.push_back(prefix + std::string(symbol.name));
    }
    for (const Prefix& prefix : word_prefixes) {
        for (const Word& word : words) {
            if (!prefix.name.empty() && !symbol_named(word.symbol)->takes_prefix) continue;
            for (const std::string_view name : {word.one, word.many})
                usual.push_back(std::string(prefix.name) + std::string(name));
        }
    }
    return usual;
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
        const std::optional<Unit> unit = find_symbol(name);
        if (!unit) {
            const std::string hint = io::did_you_mean(name, candidates(name));
            refuse(fmt::format("unknown unit '{}'{} ({})", name, hint, allowed()));
        }
        rest_.remove_prefix(length);
        return *unit;
    }

    /// The usual units that can stand here in place of `name`.
    [[nodiscard]] std::vector<std::string> candidates(std::string_view name) const {
        std::vector<std::string> usual = usual_units();
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
        for (const Symbol& symbol : symbols) {
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
        wanted == symbol_named("gn")->unit.dimension && read.dimension == symbol_named("g")->unit.dimension;
    throw InvalidInput(fmt::format("expected {}, got {}: '{}'{}", describe(wanted), describe(read.dimension), quantity,
                                   meant_gravity ? "; 'g' is the gram, standard gravity is 'gn'" : ""));
}

double plain_or_si(std::string_view text, std::string_view si_unit) {
    const std::string_view trim = trimmed(text);
    const bool plain = !trim.empty() && read_decimal(trim).length == trim.size();
    return plain ? parse_quantity(trim).value : to_si(text, si_unit);
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
    std::vector<std::string> all;
    for (const Symbol& symbol : symbols) all.emplace_back(symbol.name);
    return io::listed(all);
}

}  // namespace footfall
