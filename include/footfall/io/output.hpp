// A run, written out.
#pragma once

#include <filesystem>
#include <string>

#include "footfall/io/scenario.hpp"
#include "footfall/simulate/run.hpp"

namespace footfall {

/// Writes the run as NetCDF-4: dimensions time, sphere, axis, quaternion, event, impact; units and long names on every
/// variable; the scenario's text and the version as attributes. The file appears whole or not at all. May be called
/// from several threads at once. Throws std::runtime_error, naming the file.
void write_netcdf(const std::filesystem::path& file, const Scenario& scenario, const Run& run);

/// Throws what write_netcdf would throw for a file that cannot be made there; ask before a long run.
void check_netcdf_file(const std::filesystem::path& file);

/// Writes samples.csv, events.csv and impacts.csv into `directory`, made where it is missing. They appear together, and
/// what else is there stays: docs/cli.md, "Files that are written". Throws std::runtime_error, naming the file.
void write_csv(const std::filesystem::path& directory, const Scenario& scenario, const Run& run);

/// Throws what write_csv would throw for a directory that cannot be made or written; ask before a long run.
void check_csv_directory(const std::filesystem::path& directory);

/// The run as one JSON object: final, events, impacts, energy, steps, evaluations, wall_seconds, version. Every number
/// reads back exactly; what has not happened is null.
[[nodiscard]] std::string to_json(const Scenario& scenario, const Run& run);

/// What the scenario describes, as the head of a run's page: title, time, body, ground, start and laws with their
/// units.
[[nodiscard]] std::string summary(const Scenario& scenario);

/// The run as a page of text for a person: UTF-8, at most 100 columns, a few dozen lines whatever the run was.
[[nodiscard]] std::string summary(const Scenario& scenario, const Run& run);

}  // namespace footfall
