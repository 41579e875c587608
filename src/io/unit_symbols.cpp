// Every unit that is known, and what quantities are called.
#include "io/unit_symbols.hpp"

#include <array>
#include <numbers>

namespace footfall::io {
namespace {

constexpr double pi = std::numbers::pi;

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

Unit prefixed(const Symbol& symbol, const Prefix& prefix) {
    Unit unit = symbol.unit;
    unit.exponent += prefix.exponent;
    return unit;
}

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

std::span<const Symbol> unit_symbols() { return symbols; }

std::span<const NamedDimension> named_dimensions() { return names; }

const Symbol* symbol_named(std::string_view name) {
    for (const Symbol& symbol : symbols) {
        if (symbol.name == name) return &symbol;
    }
    return nullptr;
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

}  // namespace footfall::io
