// A Python class for every law of the registry, made from what the law says of itself.
#include <cctype>
#include <deque>
#include <string>

#include <fmt/format.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>

#include "bind.hpp"
#include "footfall/io/law_text.hpp"
#include "footfall/io/units.hpp"
#include "footfall/law/registry.hpp"

namespace footfall::python {
namespace {

/// "azad-featherstone", "Normal" -> "AzadFeatherstoneNormal".
std::string class_name(std::string_view law, std::string_view kind) {
    std::string name;
    bool start = true;
    for (const char c : law) {
        if (c == '-') {
            start = true;
            continue;
        }
        name += start ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
        start = false;
    }
    return name + std::string(kind);
}

/// nanobind keeps pointers to the texts of a signature.
const char* keep(std::string text) {
    static std::deque<std::string> kept;
    return kept.emplace_back(std::move(text)).c_str();
}

template <class Parameter>
std::string described(const Parameter& p) {
    std::string text = fmt::format("{}, {} [{}], {}", p.symbol, p.description, p.unit, p.range());
    if (p.fallback) text += fmt::format(", by default {}", *p.fallback);
    if (p.may_be_zero()) text += fmt::format("; at 0: {}", p.when_zero);
    return text;
}

template <class Law>
std::string documentation() {
    const LawDescription& law = Law::description;
    std::string text = fmt::format("{}\n\nSource: {}.\nLimits: {}.\n", law.formula, law.source, law.limits);
    const auto parameters = Law::parameters();
    if (parameters.empty()) return text;
    text +=
        "\nParameters: a number in the unit given here, or a string with a unit. Raises InvalidInput where a value is\n"
        "not in its range.\n\n";
    for (const auto& p : parameters) text += fmt::format("- ``{}``: {}\n", p.key, described(p));
    return text;
}

template <class Law>
std::string init_signature() {
    std::string text = "def __init__(self";
    if (!Law::parameters().empty()) text += ", *";
    for (const auto& p : Law::parameters()) {
        text += fmt::format(", {}: float{}", p.key, p.unit_depends ? "" : " | str");
        if (p.fallback) text += fmt::format(" = {}", *p.fallback);
    }
    return text + ") -> None";
}

/// "stiffness=..., damping=..."
template <class Law>
std::string named_parameters() {
    std::string text;
    for (const auto& p : Law::parameters()) text += fmt::format("{}{}=...", text.empty() ? "" : ", ", p.key);
    return text;
}

template <class Law>
std::string representation(const Law& law, const std::string& name) {
    std::string text;
    for (const auto& p : Law::parameters()) {
        text += fmt::format("{}{}={}", text.empty() ? "" : ", ", p.key, law.*p.member);
    }
    return fmt::format("{}({})", name, text);
}

std::string kind_of(const nb::handle& given) {
    if (given.is_none()) return "None";
    return nb::cast<std::string>(nb::handle(given.type().attr("__name__")));
}

/// The text of a Python string, as UTF-8. A lone surrogate, which has none, and a null, which would end a message, are
/// shown as their escapes; neither is in a number or a unit.
std::string text_of(const nb::handle& given) {
    const nb::object text = given.attr("encode")("utf-8", "backslashreplace").attr("decode")("utf-8");
    return nb::cast<std::string>(text.attr("replace")(nb::str("\0", 1), "\\0"));
}

template <class Parameter>
double value_of(const nb::handle& given, const Parameter& p) {
    if (nb::isinstance<nb::str>(given) && !p.unit_depends) {
        try {
            return to_si(text_of(given), p.unit);
        } catch (const InvalidInput& error) {
            throw InvalidInput(fmt::format("{}: {}", p.key, error.what()));
        }
    }
    try {
        return nb::cast<double>(given);
    } catch (const nb::cast_error&) {
        throw nb::type_error(fmt::format("{}: a number in {} is wanted{}, not {}", p.key, p.unit,
                                         p.unit_depends ? "" : " or a string with a unit", kind_of(given))
                                 .c_str());
    }
}

/// The law with the parameters of a call.
template <class Law>
Law from_arguments(const nb::kwargs& arguments, const std::string& name) {
    Law law{};
    const auto parameters = Law::parameters();
    for (const auto& [key, value] : arguments) {
        const std::string given = nb::cast<std::string>(key);
        std::string known;
        bool found = false;
        for (const auto& p : parameters) {
            found |= p.key == given;
            known += fmt::format("{}{}", known.empty() ? "" : ", ", p.key);
        }
        if (!found) {
            throw nb::type_error(
                fmt::format("{}() has no parameter '{}'; it has: {}", name, given, known.empty() ? "none" : known)
                    .c_str());
        }
    }
    for (const auto& p : parameters) {
        const std::string key(p.key);
        if (arguments.contains(key.c_str())) {
            law.*p.member = value_of(arguments[key.c_str()], p);
        } else if (p.fallback) {
            law.*p.member = *p.fallback;
        } else {
            throw nb::type_error(fmt::format("{}() needs {} ({})", name, p.key, described(p)).c_str());
        }
    }
    return law;
}

void check_alone(const NormalLaw& law, const std::string& name) { check({.normal = law, .friction = {}}, name); }
void check_alone(const FrictionLaw& law, const std::string& name) {
    check({.normal = LinearNormal<>{.stiffness = 1, .damping = 0}, .friction = law}, name);
}

template <class Variant, class Law>
void bind_law(nb::module_& laws, std::string_view kind) {
    const std::string name = class_name(Law::description.name, kind);
    const auto parameters = Law::parameters();
    auto type = nb::class_<Law>(laws, keep(name), keep(documentation<Law>()));
    type.def(
        "__init__",
        [name](Law* self, const nb::args& unnamed, const nb::kwargs& arguments) {
            if (unnamed.size() > 0) {
                throw nb::type_error(
                    fmt::format("{0}() takes its parameters by name: {0}({1})", name, named_parameters<Law>()).c_str());
            }
            const Law law = from_arguments<Law>(arguments, name);
            check_alone(Variant(law), name);
            new (self) Law(law);
        },
        nb::sig(keep(init_signature<Law>())));
    for (const auto& p : parameters) {
        type.def_prop_ro(
            keep(std::string(p.key)), [member = p.member](const Law& law) -> double { return law.*member; },
            keep(described(p)));
    }
    type.def("__repr__", [name](const Law& law) { return representation(law, name); });
    type.def(
        "__eq__",
        [](const Law& law, const nb::object& other) {
            if (!nb::isinstance<Law>(other)) return false;
            const Law& theirs = nb::cast<const Law&>(other);
            for (const auto& p : Law::parameters()) {
                if (law.*p.member != theirs.*p.member) return false;
            }
            return true;
        },
        nb::arg("other").none(), nb::sig("def __eq__(self, other: object, /) -> bool"));
    type.def("__hash__", [name](const Law& law) {
        std::size_t hash = std::hash<std::string>{}(name);
        // Not the text of the numbers: 0 and -0 are equal and must have the same hash.
        for (const auto& p : Law::parameters()) hash = hash * 31 + std::hash<double>{}(law.*p.member);
        return hash;
    });
    type.def("__reduce__", [name](const nb::object& self) {
        nb::dict values;
        for (const auto& p : Law::parameters()) {
            values[std::string(p.key).c_str()] = nb::cast<const Law&>(self).*p.member;
        }
        return nb::make_tuple(nb::module_::import_("footfall.laws").attr("_make"), nb::make_tuple(name, values));
    });
    type.def_prop_ro(
        "text", [](const Law& law) { return law_text(Variant(law)); },
        "The law in one line, as the command line reads it.");
    const LawDescription& law = Law::description;
    type.attr("name") = nb::str(law.name.data(), law.name.size());
    type.attr("formula") = nb::str(law.formula.data(), law.formula.size());
    type.attr("source") = nb::str(law.source.data(), law.source.size());
    type.attr("limits") = nb::str(law.limits.data(), law.limits.size());
    nb::dict units;
    for (const auto& p : parameters) units[std::string(p.key).c_str()] = nb::str(p.unit.data(), p.unit.size());
    type.attr("units") = units;
}

}  // namespace

void bind_laws(nb::module_& module) {
    nb::module_ laws = module.def_submodule("laws", "Every law of footfall, with its parameters.");
    for_each_law<NormalLaw>([&]<class Law>(const Law&) { bind_law<NormalLaw, Law>(laws, "Normal"); });
    for_each_law<FrictionLaw>([&]<class Law>(const Law&) { bind_law<FrictionLaw, Law>(laws, "Friction"); });
    laws.def(
        "normal", [](const std::string& text) { return parse_normal_law(text); }, nb::arg("text"),
        "A normal law from one line, such as \"azad-featherstone:stiffness=8.5e6,damping=3.1e3\". Raises "
        "InvalidInput.");
    laws.def(
        "friction", [](const std::string& text) { return parse_friction_law(text); }, nb::arg("text"),
        "A friction law from one line, such as\n"
        "\"azad-featherstone:stiffness=12.75e6,damping=3.1e3,coefficient=0.2\". Raises InvalidInput.");
}

}  // namespace footfall::python
