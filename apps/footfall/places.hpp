// Which files a command reads and writes, and that none of them is written over another.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace footfall::cli {

/// A file, or the folder of a run's tables, and the option or argument that names it.
struct Place {
    std::string option;
    std::filesystem::path path;
};

/// The places that `footfall run --csv DIR` writes: the folder and its three tables.
[[nodiscard]] std::vector<Place> table_places(const std::string& option, const std::filesystem::path& folder);

/// Throws InvalidInput where an output is an input, two outputs are one file, or standard output goes to one of them,
/// whatever the names and links that lead there. Ask before anything runs.
void keep_apart(const std::vector<Place>& inputs, const std::vector<Place>& outputs);

}  // namespace footfall::cli
