// A scenario file (TOML) as data. docs/scenario.md is the reference of its keys.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "footfall/io/setting.hpp"
#include "footfall/math/error.hpp"
#include "footfall/simulate/simulation.hpp"

namespace footfall {

struct Scenario {
    std::string title;
    Simulation simulation;
    std::string text;                ///< the file as it was read; with settings, the file that they make of it
    bool friction_left_out = false;  ///< nothing was said of friction; law = "none" says that there is none
};

/// One thing that is wrong in a scenario file, and where. Lines and columns count from 1, columns in characters.
struct ScenarioProblem {
    int line = 1;
    int column = 1;
    std::string message;
    std::string setting = {};  ///< Setting::place where a setting is wrong; the line and column are not the file's then
};

/// Everything that is wrong in a scenario file; what() has a line "FILE:LINE:COLUMN: message" for each problem, or
/// "PLACE: message" where a setting is wrong.
class ScenarioError : public InvalidInput {
public:
    ScenarioError(const std::string& file, std::vector<ScenarioProblem> problems);

    /// At least one: those of settings, then in the order of the file.
    [[nodiscard]] const std::vector<ScenarioProblem>& problems() const noexcept { return problems_; }

private:
    std::vector<ScenarioProblem> problems_;
};

/// Reads a scenario file, as the settings, in their order, make it. Throws ScenarioError; InvalidInput, naming its
/// place, where a setting cannot be put into the file; std::system_error where the file cannot be read.
[[nodiscard]] Scenario load_scenario(const std::filesystem::path& file, const std::vector<Setting>& settings = {});

/// Likewise from the text of a file; `name` stands for the file in error messages.
[[nodiscard]] Scenario parse_scenario(std::string text, const std::string& name = "scenario",
                                      const std::vector<Setting>& settings = {});

/// The JSON Schema (2020-12) of a scenario file, for editors.
[[nodiscard]] std::string scenario_schema();

/// Every table and key of a scenario file, with unit, range and default, in Markdown.
[[nodiscard]] std::string scenario_reference();

}  // namespace footfall
