// A test rig in a file (TOML), and what it measures, written out. docs/friction.md has an example of each kind.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "footfall/io/scenario.hpp"
#include "footfall/study/drive.hpp"
#include "footfall/study/rig.hpp"

namespace footfall {

struct RigFile {
    Rig rig;
    ContactParameters laws;
    std::vector<std::filesystem::path> tables = {};  ///< the files that its paths were read from
    std::string text = {};           ///< the file as it was read; with settings, the file that they make of it
    bool friction_left_out = false;  ///< nothing was said of friction; law = "none" says that there is none
};

/// Reads a rig file, as the settings, in their order, make it. Tables of points (CSV) are looked for beside it. Throws
/// ScenarioError; InvalidInput, naming its place, where a setting cannot be put into the file; std::system_error where
/// the file cannot be read.
[[nodiscard]] RigFile load_rig(const std::filesystem::path& file, const std::vector<Setting>& settings = {});

/// Likewise from the text of a file; `name` stands for the file in error messages, and names the folder of its tables.
[[nodiscard]] RigFile parse_rig(const std::string& text, const std::filesystem::path& name = "rig",
                                const std::vector<Setting>& settings = {});

/// A run and the laws that it was under.
struct RigRun {
    ContactParameters laws;
    NamedDrive named;
};

/// The runs of one rig as one JSON object: title, runs (normal, friction, events, largest forces, energy, stick_slip,
/// residual, cost), samples (as to_json(Table) has them), version. Every number reads back exactly.
[[nodiscard]] std::string to_json(const Rig& rig, const std::vector<RigRun>& runs);

/// The runs of one rig as a page of text for a person, at most 100 columns wide.
[[nodiscard]] std::string summary(const Rig& rig, const std::vector<RigRun>& runs);

}  // namespace footfall
