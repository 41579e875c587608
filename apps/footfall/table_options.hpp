// What `fit` and `oblique --fit` ask about a table of measurements.
#pragma once

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "footfall/io/table_input.hpp"

namespace footfall::cli {

/// Adds --column, --where and --skip-bad-rows, which are read into `input`; it must live as long as `app`.
void add_table_options(CLI::App& app, TableInput& input);

/// What `read` returns; where it throws BadRows, that says --skip-bad-rows as well.
template <class Read>
auto saying_how_to_skip(const Read& read) {
    try {
        return read();
    } catch (const BadRows& error) {
        throw InvalidInput(fmt::format("{}\n--skip-bad-rows leaves such rows out", error.what()));
    }
}

}  // namespace footfall::cli
