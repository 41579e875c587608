// footfall schema: what an editor needs to check a scenario while it is written.
#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "footfall/io/scenario.hpp"
#include "terminal.hpp"

namespace footfall::cli {
namespace {

int print_schema() {
    std::string schema = scenario_schema();
    if (!schema.ends_with('\n')) schema += '\n';
    print(schema);
    return ExitCode::success;
}

}  // namespace

CLI::App* add_schema(CLI::App& app, Command& command) {
    CLI::App* schema = app.add_subcommand("schema", "Print the JSON Schema of a scenario, for editors");
    schema->final_callback([&command] { command = print_schema; });
    return schema;
}

}  // namespace footfall::cli
