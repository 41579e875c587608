// footfall run: a scenario in, a summary and files out.
#include <fmt/format.h>

#include "commands.hpp"
#include "footfall/io/output.hpp"
#include "footfall/io/scenario.hpp"
#include "footfall/simulate/run.hpp"
#include "terminal.hpp"

namespace footfall::cli {

int run_command(const RunArguments& arguments) {
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
    const Run result = [&] {
        try {
            Run done = run(scenario.simulation);
            if (SignalGuard::received() != 0) throw Interrupted("after the last step");
            return done;
        } catch (const InvalidInput& error) {
            throw InvalidInput(fmt::format("{}: {}", name, error.what()));
        } catch (const TooExpensive& error) {
            throw TooExpensive(fmt::format("{}: {}", name, error.what()));
        } catch (const Interrupted&) {
            throw Interrupted(fmt::format("{}: interrupted; nothing was written", name));
        }
    }();
    bar.clear();

    std::string written;
    if (arguments.netcdf) {
        write_netcdf(*arguments.netcdf, scenario, result);
        written += fmt::format("  {}\n", arguments.netcdf->string());
    }
    if (arguments.csv_directory) {
        write_csv(*arguments.csv_directory, scenario, result);
        for (const char* table : {"samples.csv", "events.csv", "impacts.csv"}) {
            written += fmt::format("  {}\n", (*arguments.csv_directory / table).string());
        }
    }
    if (arguments.json) {
        print(to_json(scenario, result) + "\n");
    } else if (!arguments.quiet) {
        print(summary(scenario, result));
        if (!written.empty()) print("\nWritten\n" + written);
    }
    return ExitCode::success;
}

}  // namespace footfall::cli
