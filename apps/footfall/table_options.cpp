// What `fit` and `oblique --fit` ask about a table of measurements.
#include "table_options.hpp"

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace footfall::cli {
namespace {

/// "NAME=REST", split at the first equals sign.
std::pair<std::string, std::string> split(const std::string& text, const char* example) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
        throw CLI::ValidationError(fmt::format("'{}' is not allowed: write {}", text, example));
    return {text.substr(0, equals), text.substr(equals + 1)};
}

}  // namespace

void add_table_options(CLI::App& app, TableInput& input) {
    app.add_option_function<std::vector<std::string>>(
           "--column",
           [&input](const std::vector<std::string>& all) {
               for (const std::string& text : all) {
                   const auto [name, column] = split(text, "QUANTITY=COLUMN, as in speed=\"v_in [mm/s]\"");
                   if (!input.columns.emplace(name, column).second)
                       throw CLI::ValidationError(fmt::format("{} is given twice", name));
               }
           },
           "Which column holds a quantity: speed=\"v_in [mm/s]\"; a minus before the column's name turns its sign")
        ->type_name("QUANTITY=COLUMN")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option_function<std::vector<std::string>>(
           "--where",
           [&input](const std::vector<std::string>& all) {
               for (const std::string& text : all)
                   input.where.push_back(split(text, "COLUMN=VALUE, as in series=Experiment"));
           },
           "Only the rows that have this value in this column: series=Experiment")
        ->type_name("COLUMN=VALUE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_flag("--skip-bad-rows", input.skip_bad_rows, "Leave out rows that cannot be used, and count them");
}

}  // namespace footfall::cli
