// A study's table, written out. A column of a series is named "SERIES.name" in CSV.
#pragma once

#include <filesystem>
#include <string>

#include "footfall/study/table.hpp"

namespace footfall {

/// Writes a CSV file: comment lines with title, units and version, a header line, the rows. Whole or not at all; throws
/// std::runtime_error, naming the file.
void write_csv(const std::filesystem::path& file, const Table& table);

/// Throws what write_csv would throw for a file that cannot be made there; ask before a long study.
void check_csv_file(const std::filesystem::path& file);

/// {"title", "columns": [{"name", "unit", "description", "series", "values"}], "version"}. Every number reads back
/// exactly; NaN is null.
[[nodiscard]] std::string to_json(const Table& table);

/// Aligned columns for a person, at most 100 characters wide, with units in the head. Where it has more rows than
/// `max_rows`, the middle ones are left out and it says so.
[[nodiscard]] std::string to_text(const Table& table, std::size_t max_rows = 60);

}  // namespace footfall
