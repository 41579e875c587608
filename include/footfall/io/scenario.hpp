// A scenario file (TOML) as data. docs/scenario.md is the reference of its keys.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "footfall/math/error.hpp"
#include "footfall/simulate/simulation.hpp"

namespace footfall {

struct Scenario {
    std::string title;
    Simulation simulation;
    std::string text;  ///< the file as it was read
};

/// One thing that is wrong in a scenario file, and where. Lines and columns count from 1, columns in characters.
struct ScenarioProblem {
    int line = 1;
    int column = 1;
    std::string message;
};

/// Everything that is wrong in a scenario file; what() has a line "FILE:LINE:COLUMN: message" for each problem.
class ScenarioError : public InvalidInput {
public:
    ScenarioError(const std::string& file, std::vector<ScenarioProblem> problems);

    /// At least one, in the order of the file.
    [[nodiscard]] const std::vector<ScenarioProblem>& problems() const noexcept { return problems_; }

private:
    std::vector<ScenarioProblem> problems_;
};

/// Reads a scenario file. Throws ScenarioError, or std::system_error where the file cannot be read.
[[nodiscard]] Scenario load_scenario(const std::filesystem::path& file);

/// Reads a scenario from its text; `name` stands for the file in error messages. Throws ScenarioError.
[[nodiscard]] Scenario parse_scenario(std::string text, const std::string& name = "scenario");

/// The JSON Schema (2020-12) of a scenario file, for editors.
[[nodiscard]] std::string scenario_schema();

/// Every table and key of a scenario file, with unit, range and default, in Markdown.
[[nodiscard]] std::string scenario_reference();

}  // namespace footfall
