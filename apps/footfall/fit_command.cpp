// footfall fit: parameters of laws from measurements.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "checks.hpp"
#include "commands.hpp"
#include "context.hpp"
#include "footfall/io/fit_data.hpp"
#include "footfall/io/fit_report.hpp"
#include "footfall/io/table_output.hpp"
#include "footfall/study/fit.hpp"
#include "places.hpp"
#include "quantity.hpp"
#include "table_options.hpp"
#include "terminal.hpp"

namespace footfall::cli {
namespace {

struct FitArguments {
    std::filesystem::path data;
    FitInput input;
    std::string kind, gravity;
    std::vector<std::string> normal;
    std::string mass, speed, touchdown = "0", sigma;
    std::string loss = "none";
    bool quasistatic = false, sigma_is_true = false;
    int starts = 4;
    double confidence = 0.95;
    std::optional<std::filesystem::path> csv;
    bool json = false;
};

FitValue read(const char* option, const std::string& text, const char* unit) {
    return in_context(option, [&] { return parse_fit_value(text, unit); });
}

FitData data_of(const FitArguments& arguments) {
    FitInput input = arguments.input;
    input.kind = measured_by_name(arguments.kind);
    if (!arguments.gravity.empty()) input.gravity = quantity("--gravity", arguments.gravity, "m/s^2");
    return load_fit_data(arguments.data, input);
}

FitStudy study_of(const FitArguments& arguments) {
    FitStudy study{.data = data_of(arguments)};
    for (const std::string& text : arguments.normal) study.laws.push_back(parse_fit_law(text));
    if (!arguments.mass.empty()) study.mass = read("--mass", arguments.mass, "kg");
    if (!arguments.speed.empty()) study.speed = read("--speed", arguments.speed, "m/s");
    study.touchdown = read("--touchdown", arguments.touchdown, "s");
    study.quasistatic = arguments.quasistatic;
    if (!arguments.sigma.empty()) {
        const bool restitution = study.data.kind == Measured::restitution;
        const FitValue given = read("--sigma", arguments.sigma, restitution ? "1" : "N");
        const double sigma = given.free ? 0 : given.value.value_or(0);
        if (!(sigma > 0)) throw InvalidInput("--sigma: expected a number greater than 0");
        if (!study.data.sigma.empty()) {
            throw InvalidInput(fmt::format("--sigma: {} has a column sigma already", arguments.data.string()));
        }
        study.data.sigma.assign(study.data.x.size(), sigma);
    }
    if (arguments.sigma_is_true && study.data.sigma.empty()) {
        throw InvalidInput("--sigma-is-true: there is no sigma; give --sigma or a column of that name");
    }
    study.options = {.loss = arguments.loss == "huber"    ? Loss::huber
                             : arguments.loss == "cauchy" ? Loss::cauchy
                                                          : Loss::none,
                     .starts = arguments.starts,
                     .confidence = arguments.confidence,
                     .noise_is_known = arguments.sigma_is_true};
    return study;
}

int run_fit(const FitArguments& arguments) {
    work_on(arguments.data);
    std::vector<Place> outputs;
    if (arguments.csv) outputs.push_back({"--csv", *arguments.csv});
    keep_apart({{"DATA", arguments.data}}, outputs);
    if (arguments.csv) check_csv_file(*arguments.csv);
    const FitStudy study = study_of(arguments);
    const FitStudyResult result = in_context(arguments.data.string(), [&] { return fit(study); });
    std::vector<std::filesystem::path> written;
    if (arguments.csv) {
        write_csv(*arguments.csv, table(result));
        written.push_back(*arguments.csv);
    }
    if (arguments.json) {
        print(to_json(result) + "\n");
    } else {
        print_page(report(result), written);
    }
    return ExitCode::success;
}

}  // namespace

CLI::App* add_fit(CLI::App& app, Command& command) {
    auto a = std::make_shared<FitArguments>();
    CLI::App* fit = app.add_subcommand("fit", "Fit parameters of normal laws to measurements");
    fit->add_option(
           "DATA", a->data,
           "A table with a header: 'speed [m/s], restitution', 'indentation [m], force [N]' (and 'rate [m/s]'), "
           "'time [s], force [N]', speeds or heights before and after, or times of bounces")
        ->required()
        ->type_name("");
    add_table_options(*fit, a->input);
    fit->add_option("--kind", a->kind, "What was measured, where the columns fit more than one")
        ->check(CLI::IsMember({"restitution", "force-indentation", "force-time"}))
        ->type_name("KIND");
    fit->add_option("--gravity", a->gravity, "Turns heights and times of flight into speeds; by default 9.81 m/s^2")
        ->type_name("ACCELERATION");
    fit->add_option("-n,--normal", a->normal,
                    "Law, several to compare: NAME:KEY=VALUE,... with VALUE a number, or to be fitted: ?, ?START, "
                    "?LOW..HIGH")
        ->required()
        ->type_name("LAW");
    fit->add_option("--mass", a->mass, "Mass of the sphere: \"154 g\", or ?START to fit it")->type_name("MASS");
    fit->add_option("--speed", a->speed, "Speed at touchdown, of a force trace: \"1 m/s\", or ?START")
        ->type_name("SPEED");
    fit->add_option("--touchdown", a->touchdown, "When the impact begins, in the data's time; ?START to fit it")
        ->capture_default_str()
        ->type_name("TIME");
    fit->add_flag("--quasistatic", a->quasistatic, "Force against indentation was measured slowly: rate 0");
    fit->add_option("--sigma", a->sigma, "Standard deviation of every datum")->type_name("SIGMA");
    fit->add_flag("--sigma-is-true", a->sigma_is_true,
                  "Take sigma at its word; otherwise it only weights, and the residuals say how large the noise is");
    fit->add_option("--loss", a->loss, "What an outlier counts: none (all), huber, cauchy")
        ->check(one_of({"none", "huber", "cauchy"}))
        ->capture_default_str()
        ->type_name("LOSS");
    fit->add_option("--starts", a->starts, "Points to start from")
        ->transform(whole_number(1, 10000))
        ->capture_default_str()
        ->type_name("N");
    fit->add_option("--confidence", a->confidence, "Of the intervals")
        ->transform(number())
        ->capture_default_str()
        ->type_name("P");
    fit->add_flag("--json", a->json, "Print JSON");
    fit->add_option("--csv", a->csv, "Write data, models and residuals")->type_name("FILE");
    fit->footer(
        "Example:\n"
        "  footfall fit data/synthetic/restitution.csv --mass \"154 g\" \\\n"
        "      --normal \"azad-featherstone:stiffness=8.5e6,damping=?\" \\\n"
        "      --normal \"hunt-crossley:stiffness=8.5e6,damping=?\"\n");
    fit->final_callback([&command, a] { command = [a] { return run_fit(*a); }; });
    return fit;
}

}  // namespace footfall::cli
