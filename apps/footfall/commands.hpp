// The commands of the program and what they are told.
#pragma once

#include <filesystem>
#include <optional>

namespace footfall::cli {

/// What the program tells its caller.
struct ExitCode {
    static constexpr int success = 0;
    static constexpr int failure = 1;      ///< the run, or the writing of its results, failed
    static constexpr int wrong_input = 2;  ///< the command line or the scenario cannot be used
    static constexpr int signalled = 128;  ///< plus the signal's number: 130 after Ctrl-C
};

struct RunArguments {
    std::filesystem::path scenario;
    std::optional<std::filesystem::path> netcdf;         ///< --output
    std::optional<std::filesystem::path> csv_directory;  ///< --csv
    std::optional<double> tolerance;                     ///< --tolerance, in place of the scenario's
    bool json = false;
    bool quiet = false;
};

struct LawsArguments {
    bool json = false;
};

/// Runs a scenario and reports it. Throws what the library throws.
int run_command(const RunArguments& arguments);

/// Lists every law.
int laws_command(const LawsArguments& arguments);

/// Prints the JSON Schema of a scenario.
int schema_command();

}  // namespace footfall::cli
