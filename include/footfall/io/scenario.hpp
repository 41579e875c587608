// A scenario file (TOML) as data. docs/scenario.md is the reference of its keys.
#pragma once

#include <cstddef>
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

/// What is wrong in a scenario file; what() has a line "FILE:LINE:COLUMN: message", or "PLACE: message" where a setting
/// is wrong, for each of the first twenty problems, and counts the rest.
class ScenarioError : public InvalidInput {
public:
    ScenarioError(const std::string& file, std::vector<ScenarioProblem> problems, std::size_t more = 0);

    /// At least one, those of settings first, then in the order of the file; a thousand at most.
    [[nodiscard]] const std::vector<ScenarioProblem>& problems() const noexcept { return problems_; }
    /// How many problems there are beside those.
    [[nodiscard]] std::size_t more() const noexcept { return more_; }

private:
    std::vector<ScenarioProblem> problems_;
    std::size_t more_;
};

/// Reads a scenario file, as the settings, in their order, make it. Throws ScenarioError; InvalidInput where a setting
/// cannot be put into the file, naming its place, or the file is larger than 16 MiB; std::system_error where the file
/// cannot be read.
[[nodiscard]] Scenario load_scenario(const std::filesystem::path& file, const std::vector<Setting>& settings = {});

/// Likewise from the text of a file; `name` stands for the file in error messages.
[[nodiscard]] Scenario parse_scenario(std::string text, const std::string& name = "scenario",
                                      const std::vector<Setting>& settings = {});

/// The JSON Schema (2020-12) of a scenario file, for editors.
[[nodiscard]] std::string scenario_schema();

/// Every table and key of a scenario file, with unit, range and default, in Markdown.
[[nodiscard]] std::string scenario_reference();

}  // namespace footfall
