// footfall restitution: e against speed under any normal laws.
#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "checks.hpp"
#include "commands.hpp"
#include "footfall/io/law_text.hpp"
#include "footfall/io/printable.hpp"
#include "footfall/io/table_output.hpp"
#include "footfall/study/restitution.hpp"
#include "quantity.hpp"
#include "terminal.hpp"

namespace footfall::cli {
namespace {

struct RestitutionArguments {
    std::string mass, radius;
    std::vector<std::string> normals;
    std::string from = "0.01", to = "10", gravity = "0";
    int points = 50;
    bool linear = false;
    std::optional<int> figure;
    std::optional<double> tolerance, straight;
    std::optional<std::filesystem::path> csv;
    bool json = false;
};

std::vector<RestitutionCase> cases_of(const RestitutionArguments& arguments) {
    std::vector<RestitutionCase> cases;
    const double mass = quantity("--mass", arguments.mass, "kg");
    const double radius = arguments.radius.empty() ? std::numeric_limits<double>::infinity()
                                                   : quantity("--radius", arguments.radius, "m");
    for (const std::string& text : arguments.normals) {
        const NormalLaw law = parse_normal_law(text);
        cases.push_back({std::string(name_of(law)), law, mass, radius});
    }
    // Laws of one kind are told apart by their parameters.
    for (RestitutionCase& one : cases) {
        const auto same = [&](const RestitutionCase& other) { return name_of(other.law) == name_of(one.law); };
        if (std::count_if(cases.begin(), cases.end(), same) > 1) one.name = law_text(one.law);
    }
    return cases;
}

RestitutionStudy study_of(const RestitutionArguments& arguments) {
    RestitutionStudy study;
    if (arguments.figure) {
        study = paper_figure(*arguments.figure);
    } else {
        if (arguments.mass.empty() || arguments.normals.empty()) {
            throw InvalidInput("--mass and at least one --normal are required, or --figure");
        }
        const double from = quantity("--from", arguments.from, "m/s"), to = quantity("--to", arguments.to, "m/s");
        study.cases = cases_of(arguments);
        study.speeds = arguments.linear ? linear_speeds(from, to, arguments.points)
                                        : logarithmic_speeds(from, to, arguments.points);
        study.options.gravity = quantity("--gravity", arguments.gravity, "m/s^2");
        study.title = study.options.gravity > 0
                          ? fmt::format("Restitution of a sphere of {} kg, gravity {} m/s^2 (theory: without gravity)",
                                        study.cases.front().mass, study.options.gravity)
                          : fmt::format("Restitution of a sphere of {} kg without gravity", study.cases.front().mass);
    }
    if (arguments.tolerance) study.options.tolerance = *arguments.tolerance;
    return study;
}

/// Where each curve is straight in the logarithm of the speed, if that was asked for.
std::vector<std::optional<LogLinearRange>> straight_parts(const RestitutionArguments& arguments,
                                                          const RestitutionStudy& study) {
    std::vector<std::optional<LogLinearRange>> ranges(study.cases.size());
    if (!arguments.straight) return ranges;
    const auto [slowest, fastest] = std::minmax_element(study.speeds.begin(), study.speeds.end());
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        const RestitutionCase& one = study.cases[i];
        ranges[i] = log_linear_range(one.law, one.mass, *slowest, *fastest, *arguments.straight);
    }
    return ranges;
}

using Straight = std::vector<std::optional<LogLinearRange>>;

std::string as_json(const RestitutionArguments& arguments, const RestitutionResult& result, const Table& rows,
                    const Straight& straight) {
    using Json = nlohmann::ordered_json;
    Json json = Json::parse(to_json(rows));
    Json& cases = json["cases"] = Json::array();
    for (std::size_t i = 0; i < result.study.cases.size(); ++i) {
        const RestitutionCase& one = result.study.cases[i];
        Json entry{{"series", one.name}, {"law", law_text(one.law)}, {"mass", one.mass}};
        if (result.study.options.gravity > 0) {
            const std::optional<double>& slowest = result.slowest_bounces[i];
            entry["slowest_bounce"] = slowest ? Json(*slowest) : Json(nullptr);
        }
        if (arguments.straight) {
            entry["straight"] = nullptr;
            if (const auto& range = straight[i]) {
                entry["straight"] = {{"speed", range->speed},     {"restitution", range->restitution},
                                     {"slope", range->slope},     {"slowest", range->slowest},
                                     {"fastest", range->fastest}, {"deviation", *arguments.straight}};
            }
        }
        cases.push_back(std::move(entry));
    }
    return json_text(json) + "\n";
}

std::string as_text(const RestitutionArguments& arguments, const RestitutionResult& result, const Table& rows,
                    const Straight& straight) {
    std::string page = to_text(rows, 20) + "\n";
    for (std::size_t i = 0; i < result.study.cases.size(); ++i) {
        const RestitutionCase& one = result.study.cases[i];
        page += fmt::format("{}: {}, {:.6g} kg\n", one.name, law_text(one.law), one.mass);
        if (result.study.options.gravity > 0) {
            const auto& slowest = result.slowest_bounces[i];
            if (!slowest) {
                page += "  does not bounce at any speed\n";
            } else if (*slowest == 0) {
                page += "  bounces at every speed\n";
            } else {
                page += fmt::format("  does not bounce below {:.6g} m/s\n", *slowest);
            }
        }
        if (!arguments.straight) continue;
        if (const auto& range = straight[i]) {
            page += fmt::format("  e = {:.4f} {:+.4f} ln(v / {:.4g} m/s) within {:g} from {:.4g} to {:.4g} m/s\n",
                                range->restitution, range->slope, range->speed, *arguments.straight, range->slowest,
                                range->fastest);
        } else {
            page += "  has no inflection against the logarithm of the speed in this range\n";
        }
    }
    return page;
}

/// The laws hold for depths small beside the radius.
void warn_of_depth(const RestitutionResult& result) {
    constexpr double small = 0.1;
    for (std::size_t i = 0; i < result.study.cases.size(); ++i) {
        const RestitutionCase& one = result.study.cases[i];
        double deepest = 0;
        for (const NormalImpact& impact : result.impacts[i]) deepest = std::max(deepest, impact.peak_indentation);
        if (deepest > small * one.radius) {
            say(
                fmt::format("footfall: warning: {}: the sphere sinks in by {:.2g} of its radius; the laws are for "
                            "small depths\n",
                            one.name, deepest / one.radius));
        }
    }
}

int run_restitution(const RestitutionArguments& arguments) {
    const RestitutionStudy study = study_of(arguments);
    if (arguments.csv) check_csv_file(*arguments.csv);
    const RestitutionResult result = restitution(study);
    const Straight straight = straight_parts(arguments, result.study);
    const Table rows = table(result);
    warn_of_depth(result);
    if (arguments.csv) write_csv(*arguments.csv, rows);
    print(arguments.json ? as_json(arguments, result, rows, straight) : as_text(arguments, result, rows, straight));
    return ExitCode::success;
}

}  // namespace

CLI::App* add_restitution(CLI::App& app, Command& command) {
    auto arguments = std::make_shared<RestitutionArguments>();
    CLI::App* sub = app.add_subcommand("restitution", "Restitution against impact speed, under any normal laws");
    CLI::Option* mass = sub->add_option("--mass", arguments->mass, "Mass of the sphere, kg or with a unit");
    mass->type_name("MASS");
    sub->add_option("--radius", arguments->radius, "Its radius: warns where the depth is not small beside it")
        ->type_name("LENGTH");
    CLI::Option* normal =
        sub->add_option("--normal", arguments->normals, "A normal law, NAME:key=value,...; give one or more")
            ->type_name("LAW")
            ->allow_extra_args(false);
    sub->add_option("--from", arguments->from, "Slowest impact, by default 0.01 m/s")->type_name("SPEED");
    sub->add_option("--to", arguments->to, "Fastest impact, by default 10 m/s")->type_name("SPEED");
    sub->add_option("--points", arguments->points, "Number of speeds, by default 50")
        ->transform(whole_number(2, std::numeric_limits<int>::max()))
        ->type_name("NUMBER");
    sub->add_flag("--linear", arguments->linear, "Speeds in equal steps, not in equal ratios");
    CLI::Option* gravity =
        sub->add_option("--gravity", arguments->gravity, "Gravity, by default none; finds the slowest bounce")
            ->type_name("ACCELERATION");
    sub->add_option("--figure", arguments->figure, "The curves of the paper's figure 2, 3 or 4")
        ->check(one_of({"2", "3", "4"}))
        ->type_name("NUMBER")
        ->excludes(mass, normal, gravity);
    sub->add_option("--straight", arguments->straight,
                    "Find where e is within this of a straight line in the logarithm of the speed")
        ->transform(number())
        ->type_name("DEVIATION");
    sub->add_option("--tolerance", arguments->tolerance, "Relative tolerance, by default 1e-12")
        ->transform(tolerance())
        ->type_name("NUMBER");
    sub->add_option("--csv", arguments->csv, "Write the table as CSV")->type_name("FILE");
    sub->add_flag("--json", arguments->json, "Print JSON instead of text");
    sub->footer(
        "Example:\n"
        "  footfall restitution --mass \"154 g\" --radius \"1.65 cm\" --from 0.01 --to 10 --points 10 \\\n"
        "    --normal azad-featherstone:stiffness=8.5e6,damping=3.1e3 \\\n"
        "    --normal hunt-crossley:stiffness=8.5e6,damping=3.1e6\n");
    sub->final_callback([&command, arguments] { command = [arguments] { return run_restitution(*arguments); }; });
    return sub;
}

}  // namespace footfall::cli
