// The commands of the program. Each lives in <name>_command.cpp with its options; main.cpp lists them all.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace footfall::cli {

/// What the program tells its caller.
struct ExitCode {
    static constexpr int success = 0;
    static constexpr int failure = 1;      ///< the run, or the writing of its results, failed
    static constexpr int wrong_input = 2;  ///< the command line, a scenario, a rig or data cannot be used
    static constexpr int signalled = 128;  ///< plus the signal's number: 130 after Ctrl-C
};

/// What the command line asks for; returns an exit code and throws what the library throws.
using Command = std::function<int()>;

// Each adds its subcommand to `app` and returns it. Where the command line gives that subcommand, parsing sets
// `command`.
CLI::App* add_run(CLI::App& app, Command& command);
CLI::App* add_laws(CLI::App& app, Command& command);
CLI::App* add_schema(CLI::App& app, Command& command);
CLI::App* add_drive(CLI::App& app, Command& command);
CLI::App* add_restitution(CLI::App& app, Command& command);
CLI::App* add_material(CLI::App& app, Command& command);
CLI::App* add_oblique(CLI::App& app, Command& command);
CLI::App* add_fit(CLI::App& app, Command& command);

}  // namespace footfall::cli
