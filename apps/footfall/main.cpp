// The command line: footfall COMMAND ...
#include <array>
#include <filesystem>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands.hpp"
#include "footfall/io/printable.hpp"
#include "footfall/io/scenario.hpp"
#include "footfall/io/table_input.hpp"
#include "footfall/math/error.hpp"
#include "terminal.hpp"
#include "usage.hpp"
#include "version_line.hpp"

namespace footfall::cli {
namespace {

constexpr const char* exit_codes =
    "Exit codes:\n"
    "  0    success\n"
    "  1    the run failed, or its results could not be written\n"
    "  2    wrong input: the command line, a scenario, a rig or data\n"
    "  130  interrupted (Ctrl-C); 143 terminated, 129 hung up. Nothing is half written.\n";

/// One line: what a file's name or an option breaks is written out.
void say_error(std::string_view message) { say(fmt::format("footfall: {}\n", printable(message))); }

constexpr const char* too_large =
    "the memory does not suffice for the results; ask for fewer: a larger sample or an earlier end of a run, fewer "
    "points, "
    "angles or starts of a study";

// In the order of --help.
constexpr std::array commands{add_run,      add_restitution, add_oblique, add_drive,
                              add_material, add_fit,         add_laws,    add_schema};

/// The command line as data: which command, and its arguments.
struct CommandLine {
    CLI::App app{"Compliant contact between spheres and the ground, with every joule accounted for.", "footfall"};
    Command command;

    CommandLine() {
        app.require_subcommand(0, 1);  // none at all gets a message of our own
        app.formatter(help_formatter());
        app.set_version_flag("--version", version_line(), "Print the version and exit");
        for (const auto add : commands) {
            CLI::App* subcommand = add(app, command);
            subcommand->set_version_flag("--version", version_line(), "Print the version and exit");
            const std::string examples = subcommand->get_footer();
            subcommand->footer(examples.empty() ? exit_codes : examples + "\n" + exit_codes);
        }
        app.footer(exit_codes);
    }

    [[nodiscard]] std::string names() const {
        std::vector<std::string> all;
        for (const CLI::App* subcommand : app.get_subcommands({})) all.push_back(subcommand->get_name());
        return fmt::format("{}", fmt::join(all, ", "));
    }
};

int parse_and_run(int argc, char** argv) {
    CommandLine line;
    const std::vector<std::string> words(argv + (argc > 0 ? 1 : 0), argv + argc);
    const auto refuse = [&line](std::string_view message) {
        say_error(message);
        std::string asked = "footfall";
        for (const CLI::App* subcommand : line.app.get_subcommands()) asked += " " + subcommand->get_name();
        say(fmt::format("Try: {} --help\n", asked));
        return ExitCode::wrong_input;
    };
    try {
        line.app.parse(argc, argv);
    } catch (const CLI::Success& asked) {  // --help, --version
        std::ostringstream page;
        line.app.exit(asked, page, page);
        print(page.str());
        return ExitCode::success;
    } catch (const CLI::ParseError& error) {
        return refuse(usage_error(line.app, error, words));
    }
    if (const auto misuse = misused(line.app, words)) return refuse(*misuse);
    if (!line.command) return refuse("a command is required, one of " + line.names());
    return line.command();
}

}  // namespace
}  // namespace footfall::cli

int main(int argc, char** argv) {
    using namespace footfall::cli;
    open_standard_streams();
    end_on_signals();
    try {
        return parse_and_run(argc, argv);
    } catch (const footfall::BadRows& error) {
        say(fmt::format("footfall: {}\n--skip-bad-rows leaves such rows out\n", error.what()));
        return ExitCode::wrong_input;
    } catch (const footfall::ScenarioError& error) {  // one line for each problem
        say(fmt::format("footfall: {}\n", error.what()));
        return ExitCode::wrong_input;
    } catch (const footfall::InvalidInput& error) {
        say_error(error.what());
        return ExitCode::wrong_input;
    } catch (const std::filesystem::filesystem_error& error) {
        say_error(fmt::format("cannot look at {}: {}", error.path1().native(), error.code().message()));
        return ExitCode::wrong_input;
    } catch (const std::system_error& error) {  // the scenario cannot be read
        say_error(error.what());
        return ExitCode::wrong_input;
    } catch (const std::bad_alloc&) {
        say_error(too_large);
        return ExitCode::failure;
    } catch (const std::length_error&) {  // more than any memory has
        say_error(too_large);
        return ExitCode::failure;
    } catch (const std::exception& error) {
        say_error(error.what());
        return ExitCode::failure;
    }
}
