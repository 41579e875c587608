#include "footfall/io/table_output.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "footfall/io/printable.hpp"
#include "footfall/io/staged_files.hpp"
#include "footfall/math/error.hpp"
#include "footfall/version.hpp"
#include "io/atomic_file.hpp"
#include "io/text.hpp"

namespace footfall {
namespace {

std::size_t rows_of(const Table& table) {
    if (table.columns.empty()) return 0;
    const Column& first = table.columns.front();
    for (const Column& column : table.columns) {
        if (column.values.size() != first.values.size()) {
            throw InvalidInput(fmt::format("table '{}': column '{}' has {} values, '{}' has {}", table.title,
                                           column.name, column.values.size(), first.name, first.values.size()));
        }
    }
    return first.values.size();
}

std::string full_name(const Column& column) {
    return column.series.empty() ? column.name : fmt::format("{}.{}", column.series, column.name);
}

/// A cell of text, in quotes where it would break the row (RFC 4180).
std::string csv_cell(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + '"';
}

/// Text for a comment: a line end of the text is none of the file.
std::string comment(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return printable(text);
}

void fill(io::Writer& output, const Table& table) {
    constexpr std::size_t block = 1 << 20;
    const std::size_t rows = rows_of(table);
    std::string content = fmt::format("# {}\n# footfall {}\n", comment(table.title), version);
    for (const Column& column : table.columns) {
        content += fmt::format("# {} [{}]: {}\n", comment(full_name(column)), column.unit, comment(column.description));
    }
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        content += fmt::format("{}{}", i == 0 ? "" : ",", csv_cell(printable(full_name(table.columns[i]))));
    }
    content += '\n';
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t i = 0; i < table.columns.size(); ++i) {
            const double value = table.columns[i].values[row];
            if (i > 0) content += ',';
            if (!std::isnan(value)) fmt::format_to(std::back_inserter(content), "{}", value);
        }
        content += '\n';
        if (content.size() < block) continue;
        output.write(content);
        content.clear();
    }
    output.write(content);
}

// What a person reads -------------------------------------------------------------------------------------------------

constexpr std::size_t page_width = 100;
constexpr std::size_t longest_series = 20;  // a longer name is replaced by a number and told in a legend

std::string cell(double value) { return std::isnan(value) ? "-" : text::number(value); }

/// One column as it is shown: its head in two lines, and its cells.
struct Shown {
    std::string head;
    std::vector<std::string> cells;
    std::size_t width = 0;
    bool shared = false;
};

/// The rows that are shown: all, or the first and last ones.
struct Rows {
    std::size_t all = 0, first = 0, last = 0;
    [[nodiscard]] std::size_t left_out() const { return all - first - last; }
};

Shown show(const Column& column, const std::string& series, bool any_series, const Rows& rows) {
    const std::string unit = column.unit == "1" ? "" : fmt::format("[{}]", column.unit);
    const std::string own = printable(column.name);
    const std::string name = any_series && !unit.empty() ? own + " " + unit : own;
    const std::string& above = any_series ? series : own;
    const std::string& below = any_series ? name : unit;
    Shown shown{.head = above + "\n" + below,
                .cells = {},
                .width = std::max(text::width(above), text::width(below)),
                .shared = column.series.empty()};
    const auto add = [&](std::size_t row) {
        shown.cells.push_back(cell(column.values[row]));
        shown.width = std::max(shown.width, text::width(shown.cells.back()));
    };
    for (std::size_t row = 0; row < rows.first; ++row) add(row);
    for (std::size_t row = rows.all - rows.last; row < rows.all; ++row) add(row);
    return shown;
}

std::string block(const std::vector<const Shown*>& columns, const Rows& rows) {
    text::Table page(std::vector<text::Align>(columns.size(), text::Align::right));
    std::vector<std::string> head;
    for (const Shown* column : columns) head.push_back(column->head);
    page.head(std::move(head));
    for (std::size_t row = 0; row < rows.first + rows.last; ++row) {
        if (row == rows.first && rows.left_out() > 0) page.note(fmt::format("... {} rows left out", rows.left_out()));
        std::vector<std::string> cells;
        for (const Shown* column : columns) cells.push_back(column->cells[row]);
        page.row(std::move(cells));
    }
    return page.str();
}

}  // namespace

void check_csv_file(const std::filesystem::path& file) { const io::AtomicFile attempt(file); }

void StagedFiles::add_csv(const std::filesystem::path& file, const Table& table) {
    auto output = std::make_unique<io::AtomicFile>(file);
    io::within_memory(file, "ask for fewer rows", [&] {
        io::Writer writer = output->writer();
        fill(writer, table);
        writer.finish();
    });
    parts_.push_back(std::move(output));
}

void write_csv(const std::filesystem::path& file, const Table& table) {
    StagedFiles files;
    files.add_csv(file, table);
    files.commit();
}

std::string to_json(const Table& table) {
    (void)rows_of(table);
    using Json = nlohmann::ordered_json;
    Json columns = Json::array();
    for (const Column& column : table.columns) {
        columns.push_back({{"name", column.name},
                           {"unit", column.unit},
                           {"description", column.description},
                           {"series", column.series},
                           {"values", column.values}});
    }
    return json_text(Json{{"title", table.title}, {"columns", columns}, {"version", version}});
}

std::string to_text(const Table& table, std::size_t max_rows) {
    Rows rows{.all = rows_of(table)};
    rows.first = rows.all <= max_rows ? rows.all : max_rows - max_rows / 2;
    rows.last = rows.all <= max_rows ? 0 : max_rows / 2;

    std::vector<std::string> series;
    for (const Column& column : table.columns) {
        const bool known = std::find(series.begin(), series.end(), column.series) != series.end();
        if (!column.series.empty() && !known) series.push_back(column.series);
    }
    const bool numbered = std::any_of(series.begin(), series.end(),
                                      [](const std::string& name) { return text::width(name) > longest_series; });
    const auto label = [&](const std::string& name) {
        if (name.empty() || !numbered) return printable(name);
        return fmt::format("({})", std::find(series.begin(), series.end(), name) - series.begin() + 1);
    };

    std::string page;
    for (const std::string& line : text::wrap(printable(table.title), page_width)) page += line + '\n';
    for (std::size_t i = 0; numbered && i < series.size(); ++i) {
        page += fmt::format("  ({}) {}\n", i + 1, printable(series[i]));
    }
    std::vector<Shown> columns;
    for (const Column& column : table.columns) {
        columns.push_back(show(column, label(column.series), !series.empty(), rows));
    }

    // What all series share (or the first column) stands at the left of every block; the rest goes where there is room.
    std::vector<const Shown*> shared;
    std::vector<const Shown*> own;
    for (const Shown& column : columns) {
        const bool left = series.empty() ? shared.empty() : column.shared;
        (left ? shared : own).push_back(&column);
    }
    const auto width_of = [](const std::vector<const Shown*>& list) {
        std::size_t width = 0;
        for (const Shown* column : list) width += 2 + column->width;
        return width;
    };
    if (columns.empty()) return page;
    std::size_t next = 0;
    do {
        std::vector<const Shown*> chosen = shared;
        const std::size_t least = chosen.size() + 1;
        while (next < own.size() && (chosen.size() < least || width_of(chosen) + 2 + own[next]->width <= page_width)) {
            chosen.push_back(own[next++]);
        }
        page += '\n' + block(chosen, rows);
    } while (next < own.size());
    return page;
}

}  // namespace footfall
