// How a table of measurements is to be read, beyond what its own header says.
// docs/tables.md describes the tables.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "footfall/io/scenario.hpp"

namespace footfall {

/// What a user says about a table.
struct TableInput {
    /// Which column holds a quantity, where its name does not tell: {"speed", "v_in [mm/s]"}. The unit in brackets is
    /// that of a column without one of its own. A minus before the name turns the sign of the numbers.
    std::map<std::string, std::string, std::less<>> columns;
    /// Only the rows that have this text in this column: {"series", "Experiment"}. All of them must hold.
    std::vector<std::pair<std::string, std::string>> where;
    /// Rows that cannot be used are left out and counted; otherwise they are errors.
    bool skip_bad_rows = false;
};

/// Rows of a table that cannot be used, where everything else of it can: TableInput::skip_bad_rows would leave them
/// out.
class BadRows : public ScenarioError {
public:
    explicit BadRows(const ScenarioError& error) : ScenarioError(error) {}
};

}  // namespace footfall
