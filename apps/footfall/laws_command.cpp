// footfall laws: every law of the registry, for a person or as JSON.
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "footfall/law/registry.hpp"
#include "terminal.hpp"

namespace footfall::cli {
namespace {

using Json = nlohmann::ordered_json;

template <class Variant>
Json as_json() {
    Json laws = Json::array();
    for_each_law<Variant>([&]<class Law>(const Law&) {
        const LawDescription& law = Law::description;
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

template <class Variant>
std::string as_text(std::string_view title, std::string_view table) {
    std::string page = fmt::format("{}   law = \"NAME\" under [{}]\n", title, table);
    for_each_law<Variant>([&]<class Law>(const Law&) {
        const LawDescription& law = Law::description;
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
    return page;
}

int list_laws(bool json) {
    if (json) {
        print(Json{{"normal", as_json<NormalLaw>()}, {"friction", as_json<FrictionLaw>()}}.dump(2) + "\n");
        return ExitCode::success;
    }
    print(as_text<NormalLaw>("Normal laws", "contact.normal") + "\n" +
          as_text<FrictionLaw>("Friction laws", "contact.friction") +
          "\nAny normal law goes with any friction law. z is the indentation, zdot its rate, u the tangential\n"
          "deformation, V the velocity of the sphere's bottom point. A parameter is a number in the unit given here,\n"
          "or a string with a unit such as \"3.1 kN s/m^1.5\".\n");
    return ExitCode::success;
}

}  // namespace

CLI::App* add_laws(CLI::App& app, Command& command) {
    auto json = std::make_shared<bool>(false);
    CLI::App* laws = app.add_subcommand("laws", "List every law: formula, parameters, units, source");
    laws->add_flag("--json", *json, "Print JSON");
    laws->final_callback([&command, json] { command = [json] { return list_laws(*json); }; });
    return laws;
}

}  // namespace footfall::cli
