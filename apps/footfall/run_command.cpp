// footfall run: a scenario in, a summary and files out.
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
#include "footfall/io/output.hpp"
#include "footfall/io/scenario.hpp"
#include "footfall/io/staged_files.hpp"
#include "footfall/simulate/run.hpp"
#include "io/temporary.hpp"
#include "places.hpp"
#include "settings.hpp"
#include "shipped.hpp"
#include "terminal.hpp"
#include "usage.hpp"

namespace footfall::cli {
namespace {

struct RunArguments {
    std::filesystem::path scenario;
    SettingArguments settings;
    std::optional<std::filesystem::path> netcdf;         ///< --output
    std::optional<std::filesystem::path> csv_directory;  ///< --csv
    bool json = false;
    bool quiet = false;
    bool list = false;
    bool print = false;
};

Scenario load(const RunArguments& arguments) {
    const std::vector<Setting> settings = arguments.settings.all("solver.tolerance");
    const std::filesystem::path& file = arguments.scenario;
    if (auto text = shipped_text(FileKind::scenario, file)) {
        return parse_scenario(std::move(*text), file.string(), settings);
    }
    return load_scenario(file, settings);
}

int run_scenario(const RunArguments& arguments) {
    Scenario scenario = load(arguments);
    if (arguments.print) {
        print_as_it_is(scenario.text);
        return ExitCode::success;
    }
    work_on(arguments.scenario);
    std::vector<Place> outputs;
    if (arguments.csv_directory) outputs = table_places("--csv", *arguments.csv_directory);
    if (arguments.netcdf) outputs.push_back({"--output", *arguments.netcdf});
    std::vector<Place> inputs;
    if (!shipped_text(FileKind::scenario, arguments.scenario)) inputs.push_back({"SCENARIO", arguments.scenario});
    keep_apart(inputs, outputs);

    // A place that cannot be written is better known before a long run than after it.
    if (arguments.netcdf) check_netcdf_file(*arguments.netcdf);
    if (arguments.csv_directory) check_csv_directory(*arguments.csv_directory);

    RunOptions& options = scenario.simulation.options;
    ProgressBar bar(options.end_time, !arguments.quiet);
    options.progress = [&bar](double time) {
        bar.update(time);
        return true;
    };
    const std::string name = arguments.scenario.string();
    const Run result = in_context(name, [&] { return run(scenario.simulation); });
    bar.clear();

    StagedFiles files;
    std::vector<std::filesystem::path> written;
    if (arguments.netcdf) {
        files.add_netcdf(*arguments.netcdf, scenario, result);
        written.push_back(*arguments.netcdf);
    }
    if (arguments.csv_directory) {
        files.add_csv(*arguments.csv_directory, scenario, result);
        for (const char* table : io::run_tables) {
            written.push_back(*arguments.csv_directory / table);
        }
    }
    files.commit();
    if (arguments.json) {
        print(to_json(scenario, result) + "\n");
    } else if (!arguments.quiet) {
        print_page(summary(scenario, result), written);
    }
    return ExitCode::success;
}

int list_scenarios() {
    print(shipped_list(FileKind::scenario,
                       [](std::string_view text) { return parse_scenario(std::string(text)).title; }));
    return ExitCode::success;
}

}  // namespace

CLI::App* add_run(CLI::App& app, Command& command) {
    auto arguments = std::make_shared<RunArguments>();
    CLI::App* run = app.add_subcommand("run", "Run a scenario and report it");
    CLI::Option* scenario =
        run->add_option("SCENARIO", arguments->scenario, "A TOML file, or the name of a scenario of --list")
            ->type_name("");
    CLI::Option* netcdf =
        run->add_option("-o,--output", arguments->netcdf, "Write the run as NetCDF-4")->type_name("RUN.nc");
    CLI::Option* csv = run->add_option("--csv", arguments->csv_directory,
                                       "Write samples.csv, events.csv and impacts.csv into a folder")
                           ->type_name("DIR");
    run->add_option("--normal", arguments->settings.normal,
                    "A normal law for all spheres, NAME:key=value,..., in place of the scenario's")
        ->type_name("LAW");
    run->add_option("--friction", arguments->settings.friction,
                    "A friction law, likewise; `footfall laws` lists them all")
        ->type_name("LAW");
    arguments->settings.add_to(*run, "scenario");
    CLI::Option* json = run->add_flag("--json", arguments->json, "Print JSON instead of the summary");
    CLI::Option* quiet = run->add_flag("-q,--quiet", arguments->quiet, "Print nothing but errors")->excludes(json);
    CLI::Option* show = run->add_flag("--print", arguments->print, "Print the scenario, as the options make it");
    CLI::Option* list = run->add_flag("--list", arguments->list, "List the scenarios that come with footfall");
    for (CLI::Option* other : {netcdf, csv, json, quiet}) show->excludes(other), list->excludes(other);
    list->excludes(scenario, show);
    run->footer(
        "Example:\n"
        "  footfall run rolling-sphere\n"
        "  footfall run rolling-sphere --set contact.friction.coefficient=0.3 --set 'body.mass=200 g' -o rolling.nc\n"
        "  footfall run rolling-sphere --print > mine.toml\n");
    run->final_callback([&command, arguments, scenario] {
        if (arguments->list) {
            command = list_scenarios;
            return;
        }
        if (scenario->count() == 0) throw missing(*scenario);
        command = [arguments] { return run_scenario(*arguments); };
    });
    return run;
}

}  // namespace footfall::cli
