// The command line: footfall run | laws | schema.
#include <functional>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands.hpp"
#include "footfall/law/parameter.hpp"
#include "footfall/simulate/run.hpp"
#include "footfall/version.hpp"
#include "terminal.hpp"

namespace footfall::cli {
namespace {

constexpr const char* exit_codes =
    "Exit codes:\n"
    "  0    success\n"
    "  1    the run failed, or its results could not be written\n"
    "  2    wrong input: the command line or the scenario\n"
    "  130  interrupted (Ctrl-C); 143 terminated. Nothing is half written.\n";

void say_error(std::string_view message) { fmt::print(stderr, "footfall: {}\n", message); }

/// The command line as data: which command, and its arguments.
struct CommandLine {
    CLI::App app{"Compliant contact between spheres and the ground, with every joule accounted for.", "footfall"};
    RunArguments run;
    LawsArguments laws;
    std::function<int()> command;

    CommandLine() {
        app.require_subcommand(0, 1);  // none at all gets a message of our own
        app.get_formatter()->column_width(28);
        const std::string version_line = fmt::format("footfall {}", version);
        app.set_version_flag("--version", version_line, "Print the version and exit");

        CLI::App* run_app = app.add_subcommand("run", "Run a scenario and report it");
        run_app->add_option("SCENARIO", run.scenario, "The scenario, a TOML file")->required()->type_name("");
        run_app->add_option("-o,--output", run.netcdf, "Write the run as NetCDF-4")->type_name("RUN.nc");
        run_app->add_option("--csv", run.csv_directory, "Write samples.csv, events.csv and impacts.csv into a folder")
            ->type_name("DIR");
        run_app->add_option("--tolerance", run.tolerance, "Relative tolerance, in place of the scenario's")
            ->type_name("NUMBER");
        CLI::Option* json = run_app->add_flag("--json", run.json, "Print JSON instead of the summary");
        run_app->add_flag("-q,--quiet", run.quiet, "Print nothing but errors")->excludes(json);
        run_app->final_callback([this] { command = [this] { return run_command(run); }; });

        CLI::App* laws_app = app.add_subcommand("laws", "List every law: formula, parameters, units, source");
        laws_app->add_flag("--json", laws.json, "Print JSON");
        laws_app->final_callback([this] { command = [this] { return laws_command(laws); }; });

        CLI::App* schema_app = app.add_subcommand("schema", "Print the JSON Schema of a scenario, for editors");
        schema_app->final_callback([this] { command = schema_command; });

        app.footer(exit_codes);
        for (CLI::App* subcommand : {run_app, laws_app, schema_app}) {
            subcommand->set_version_flag("--version", version_line, "Print the version and exit");
            subcommand->footer(exit_codes);
        }
    }
};

int parse_and_run(int argc, char** argv) {
    CommandLine line;
    const auto refuse = [&line](std::string_view message) {
        say_error(message);
        std::string asked = "footfall";
        for (const CLI::App* subcommand : line.app.get_subcommands()) asked += " " + subcommand->get_name();
        fmt::print(stderr, "Try: {} --help\n", asked);
        return ExitCode::wrong_input;
    };
    try {
        line.app.parse(argc, argv);
    } catch (const CLI::Success& asked) {  // --help, --version
        line.app.exit(asked);
        return ExitCode::success;
    } catch (const CLI::ParseError& error) {
        return refuse(error.what());
    }
    if (!line.command) return refuse("a command is required: run, laws or schema");
    return line.command();
}

}  // namespace
}  // namespace footfall::cli

int main(int argc, char** argv) {
    using namespace footfall::cli;
    try {
        return parse_and_run(argc, argv);
    } catch (const footfall::InvalidInput& error) {
        say_error(error.what());
        return ExitCode::wrong_input;
    } catch (const std::system_error& error) {  // the scenario cannot be read
        say_error(error.what());
        return ExitCode::wrong_input;
    } catch (const footfall::Interrupted& error) {
        say_error(error.what());
        return ExitCode::signalled + SignalGuard::received();
    } catch (const std::exception& error) {
        say_error(error.what());
        return ExitCode::failure;
    }
}
