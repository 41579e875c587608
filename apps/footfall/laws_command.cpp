// footfall laws: every law of the registry, or some of them, for a person or as JSON.
#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "footfall/io/printable.hpp"
#include "footfall/law/registry.hpp"
#include "footfall/math/error.hpp"
#include "io/nearest.hpp"
#include "terminal.hpp"

namespace footfall::cli {
namespace {

using Json = nlohmann::ordered_json;

/// The names that were asked for; none means every law.
using Names = std::vector<std::string>;

bool wanted(const Names& names, std::string_view name) {
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

/// The name of every law; one that is both a normal and a friction law is there once.
Names all_names() {
    Names names;
    const auto add = [&](const auto& law) {
        if (names.empty() || !wanted(names, law.description.name)) names.emplace_back(law.description.name);
    };
    for_each_law<NormalLaw>(add);
    for_each_law<FrictionLaw>(add);
    return names;
}

template <class Variant>
Json as_json(const Names& names) {
    Json laws = Json::array();
    for_each_law<Variant>([&]<class Law>(const Law&) {
        const LawDescription& law = Law::description;
        if (!wanted(names, law.name)) return;
        Json parameters = Json::array();
        for (const auto& parameter : Law::parameters()) {
            parameters.push_back({{"key", parameter.key},
                                  {"symbol", parameter.symbol},
                                  {"unit", parameter.unit},
                                  {"description", parameter.description},
                                  {"range", parameter.range()},
                                  {"when_zero", parameter.may_be_zero() ? Json(parameter.when_zero) : Json(nullptr)},
                                  {"default", parameter.fallback ? Json(*parameter.fallback) : Json(nullptr)}});
        }
        laws.push_back({{"name", law.name},
                        {"formula", law.formula},
                        {"source", law.source},
                        {"limits", law.limits},
                        {"parameters", parameters}});
    });
    return laws;
}

/// Nothing where none of these laws was asked for.
template <class Variant>
std::string as_text(std::string_view title, std::string_view table, const Names& names) {
    std::string page;
    for_each_law<Variant>([&]<class Law>(const Law&) {
        const LawDescription& law = Law::description;
        if (!wanted(names, law.name)) return;
        page += fmt::format("\n  {}\n", law.name);
        page += fmt::format("    formula      {}\n", law.formula);
        page += fmt::format("    source       {}\n", law.source);
        page += fmt::format("    limits       {}\n", law.limits);
        for (const auto& parameter : Law::parameters()) {
            const std::string unit = parameter.unit == "1" ? "no unit" : std::string(parameter.unit);
            const std::string fallback = parameter.fallback ? fmt::format(", by default {}", *parameter.fallback) : "";
            page += fmt::format("    {:<12} {:<6}  {:<16}  {}, {}{}\n", parameter.key, parameter.symbol, unit,
                                parameter.description, parameter.range(), fallback);
            if (parameter.unit_depends) page += fmt::format("{:43}a plain number: its unit depends on others\n", "");
            if (parameter.may_be_zero()) page += fmt::format("{:43}at 0: {}\n", "", parameter.when_zero);
        }
    });
    return page.empty() ? page : fmt::format("{}   law = \"NAME\" under [{}]\n{}\n", title, table, page);
}

int list_laws(const Names& names, bool json) {
    const Names all = all_names();
    for (const std::string& name : names) {
        if (wanted(all, name)) continue;
        throw InvalidInput(
            fmt::format("unknown law '{}'{} (laws: {})", name, io::did_you_mean(name, all), io::listed(all)));
    }
    if (json) {
        print(json_text(Json{{"normal", as_json<NormalLaw>(names)}, {"friction", as_json<FrictionLaw>(names)}}) + "\n");
        return ExitCode::success;
    }
    print(as_text<NormalLaw>("Normal laws", "contact.normal", names) +
          as_text<FrictionLaw>("Friction laws", "contact.friction", names) +
          "Any normal law goes with any friction law. z is the indentation, zdot its rate, u the tangential\n"
          "deformation, V the velocity of the sphere's bottom point. A parameter is a number in the unit given here,\n"
          "or a string with a unit such as \"3.1 kN s/m^1.5\".\n");
    return ExitCode::success;
}

}  // namespace

CLI::App* add_laws(CLI::App& app, Command& command) {
    struct Arguments {
        Names names;
        bool json = false;
    };
    auto arguments = std::make_shared<Arguments>();
    CLI::App* laws = app.add_subcommand("laws", "Describe every law: formula, parameters, units, source");
    laws->add_option("NAME", arguments->names, "Only these laws")->type_name("");
    laws->add_flag("--json", arguments->json, "Print JSON");
    laws->footer(
        "Example:\n"
        "  footfall laws hertz dahl\n");
    laws->final_callback(
        [&command, arguments] { command = [arguments] { return list_laws(arguments->names, arguments->json); }; });
    return laws;
}

}  // namespace footfall::cli
