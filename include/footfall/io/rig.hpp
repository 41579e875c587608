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
};

/// Reads a rig file. Tables of points (CSV) are looked for beside it. Throws ScenarioError, or std::system_error where
/// the file cannot be read.
[[nodiscard]] RigFile load_rig(const std::filesystem::path& file);

/// Reads a rig from its text; `name` stands for the file in error messages, and names the folder of its tables. Throws
/// ScenarioError.
[[nodiscard]] RigFile parse_rig(const std::string& text, const std::filesystem::path& name = "rig");

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
