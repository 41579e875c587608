// What `fit` and `oblique --fit` ask about a table of measurements.
#pragma once

#include <CLI/CLI.hpp>

#include "footfall/io/table_input.hpp"

namespace footfall::cli {

/// Adds --column, --where and --skip-bad-rows, which are read into `input`; it must live as long as `app`.
void add_table_options(CLI::App& app, TableInput& input);

}  // namespace footfall::cli
