// Files that are written together.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "footfall/io/scenario.hpp"
#include "footfall/simulate/run.hpp"
#include "footfall/study/table.hpp"

namespace footfall {

namespace io {
class Staged;
}

/// Files that are complete and on the disk, and whose places are taken all at once: until `commit` older files stay as
/// they are, and without it nothing remains. docs/cli.md ("Files that are written") says what a killed process leaves.
class StagedFiles {
public:
    StagedFiles();
    ~StagedFiles();
    StagedFiles(const StagedFiles&) = delete;
    StagedFiles& operator=(const StagedFiles&) = delete;

    /// As write_netcdf and write_csv do, up to the file's taking its place. Throw std::runtime_error, naming the file.
    void add_netcdf(const std::filesystem::path& file, const Scenario& scenario, const Run& run);
    void add_csv(const std::filesystem::path& directory, const Scenario& scenario, const Run& run);
    void add_csv(const std::filesystem::path& file, const Table& table);

    /// Gives every file its place. Throws std::runtime_error, naming the file that could not take its own.
    void commit();

private:
    std::vector<std::unique_ptr<io::Staged>> parts_;
};

/// For a program that is about to end, from any thread: removes what this process has under temporary names, and lets
/// no file take its place from now on; whoever tries waits for ever. Waits for a commit that has begun. Returns whether
/// any file had taken its place before.
bool discard_staged_files();

}  // namespace footfall
