// footfall schema: what an editor needs to check a scenario while it is written.
#include "commands.hpp"
#include "footfall/io/scenario.hpp"
#include "terminal.hpp"

namespace footfall::cli {

int schema_command() {
    std::string schema = scenario_schema();
    if (!schema.ends_with('\n')) schema += '\n';
    print(schema);
    return ExitCode::success;
}

}  // namespace footfall::cli
