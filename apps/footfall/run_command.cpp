// footfall run: a scenario in, a summary and files out.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands.hpp"
#include "context.hpp"
#include "footfall/io/output.hpp"
#include "footfall/io/scenario.hpp"
#include "footfall/simulate/run.hpp"
#include "terminal.hpp"

namespace footfall::cli {
namespace {

struct RunArguments {
    std::filesystem::path scenario;
    std::optional<std::filesystem::path> netcdf;         ///< --output
    std::optional<std::filesystem::path> csv_directory;  ///< --csv
    std::optional<double> tolerance;                     ///< --tolerance, in place of the scenario's
    bool json = false;
    bool quiet = false;
};

int run_scenario(const RunArguments& arguments) {
    Scenario scenario = load_scenario(arguments.scenario);
    RunOptions& options = scenario.simulation.options;
    if (arguments.tolerance) options.tolerance = *arguments.tolerance;

    // A place that cannot be written is better known before a long run than after it.
    if (arguments.netcdf) check_netcdf_file(*arguments.netcdf);
    if (arguments.csv_directory) check_csv_directory(*arguments.csv_directory);

    const SignalGuard signals;
    ProgressBar bar(options.end_time, !arguments.quiet);
    options.progress = [&bar](double time) {
        bar.update(time);
        return SignalGuard::received() == 0;
    };
    const std::string name = arguments.scenario.string();
    const Run result = in_context(name, [&] {
        try {
            Run done = run(scenario.simulation);
            if (SignalGuard::received() != 0) throw Interrupted("after the last step");
            return done;
        } catch (const Interrupted&) {
            throw Interrupted(fmt::format("{}: interrupted; nothing was written", name));
        }
    });
    bar.clear();

    std::vector<std::filesystem::path> written;
    if (arguments.netcdf) {
        write_netcdf(*arguments.netcdf, scenario, result);
        written.push_back(*arguments.netcdf);
    }
    if (arguments.csv_directory) {
        write_csv(*arguments.csv_directory, scenario, result);
        for (const char* table : {"samples.csv", "events.csv", "impacts.csv"}) {
            written.push_back(*arguments.csv_directory / table);
        }
    }
    if (arguments.json) {
        print(to_json(scenario, result) + "\n");
    } else if (!arguments.quiet) {
        print_page(summary(scenario, result), written);
    }
    return ExitCode::success;
}

}  // namespace

CLI::App* add_run(CLI::App& app, Command& command) {
    auto arguments = std::make_shared<RunArguments>();
    CLI::App* run = app.add_subcommand("run", "Run a scenario and report it");
    run->add_option("SCENARIO", arguments->scenario, "The scenario, a TOML file")->required()->type_name("");
    run->add_option("-o,--output", arguments->netcdf, "Write the run as NetCDF-4")->type_name("RUN.nc");
    run->add_option("--csv", arguments->csv_directory, "Write samples.csv, events.csv and impacts.csv into a folder")
        ->type_name("DIR");
    run->add_option("--tolerance", arguments->tolerance, "Relative tolerance, in place of the scenario's")
        ->type_name("NUMBER");
    CLI::Option* json = run->add_flag("--json", arguments->json, "Print JSON instead of the summary");
    run->add_flag("-q,--quiet", arguments->quiet, "Print nothing but errors")->excludes(json);
    run->final_callback([&command, arguments] { command = [arguments] { return run_scenario(*arguments); }; });
    return run;
}

}  // namespace footfall::cli
