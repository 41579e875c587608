// Options that change a scenario or rig before it is read.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "footfall/io/setting.hpp"

namespace footfall::cli {

struct SettingArguments {
    std::string normal, friction;      ///< laws of all spheres; empty: those of the file
    std::string tolerance;             ///< --tolerance; empty: that of the file
    std::vector<std::string> changes;  ///< --set

    /// Adds --tolerance and --set to the command that reads a `kind` ("scenario").
    void add_to(CLI::App& command, const std::string& kind);

    /// In the order in which they are put: --set may change the laws that were given. Throws InvalidInput.
    [[nodiscard]] std::vector<Setting> all(const std::string& tolerance_key) const;
};

}  // namespace footfall::cli
