// One reader for every table of measurements.
#include "io/table_reader.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "footfall/math/error.hpp"
#include "io/nearest.hpp"
#include "io/read.hpp"

namespace footfall::io {
namespace {

/// `value` in the sought unit. Powers of ten below one are divided by: 29 um are the double next to 29e-6 then, as
/// 29 * 1e-6 is not.
double converted(double value, const FoundColumn& column) {
    const double scaled = column.sign * value * column.factor;
    return column.divide ? scaled / column.ten : scaled * column.ten;
}

/// The first few of a list, and that there are more.
template <class List>
std::string first_of(const List& list, std::size_t most = 10) {
    std::string text;
    for (std::size_t i = 0; i < list.size() && i < most; ++i) text += fmt::format("{}{}", i == 0 ? "" : ", ", list[i]);
    if (list.size() > most) text += ", ...";
    return text;
}

/// A cell is what a user asks for: the same text, or the same number.
bool same_value(std::string_view a, std::string_view b) {
    const auto first = plain_number(a), second = plain_number(b);
    return a == b || (first && second && *first == *second);
}

/// "mm/s", "[mm/s]" or "speed [mm/s]" where a number should stand.
bool is_unit(std::string_view cell, const Sought& sought) {
    if (const std::size_t bracket = cell.find_first_of("[("); bracket != std::string_view::npos)
        cell = trimmed(cell.substr(bracket), " \t[]()");
    if (is_gap(cell) || is_number(cell)) return false;
    const auto unit = readable_unit(cell);
    return unit && (unit->dimension != Dimension{} || unit->dimension == parse_unit(sought.unit).dimension);
}

}  // namespace

TableReader::TableReader(std::string text, std::string name, std::vector<Sought> sought, const TableInput& input,
                         std::string_view wanted)
    : text_(decoded(std::move(text), name)),
      name_(std::move(name)),
      problems_(name_),
      sought_(std::move(sought)),
      input_(input),
      table_(split_table(text_.text, name_, wanted)) {
    columns_ = std::make_unique<Columns>(table_, sought_, input_, problems_);
    problems_.throw_if_any();
    pick_rows();
    if (!text_.was_utf8) remarks_.notes.emplace_back("The text is no UTF-8; it was read as Windows-1252 (Latin-1).");
}

void TableReader::pick_rows() {
    for (const auto& [column, wanted] : input_.where) {
        const auto found = columns_->named(column);
        if (!found) refuse(table_.header.front(), columns_->no_column(column));
        const std::size_t place = *found;
        constexpr std::size_t most = 50;  // values that are told
        std::vector<std::string> values;
        std::vector<Cells> picked;
        for (Cells& row : table_.rows) {
            if (place >= row.size()) continue;
            const std::string_view value = row[place].text;
            if (values.size() < most && std::find(values.begin(), values.end(), value) == values.end())
                values.emplace_back(value);
            if (same_value(value, wanted)) picked.push_back(std::move(row));
        }
        if (picked.empty()) {
            refuse(table_.header[place], fmt::format("no row has '{}' in column '{}'{} (it has {})", wanted, column,
                                                     did_you_mean(wanted, values), first_of(values)));
        }
        table_.rows = std::move(picked);
    }
}

void TableReader::refuse_header(const std::string& message) {
    columns_->say_what_was_meant(problems_);
    std::vector<std::string> names;
    for (const Cell& cell : table_.header) names.push_back(fmt::format("'{}'", shown(cell.text)));
    refuse(table_.header.front(), fmt::format("{} (columns here: {})", message, first_of(names, 20)));
}

void TableReader::refuse(const Cell& cell, const std::string& message) { problems_.throw_with(cell.at(), message); }

/// `allowed` says what the cell should be where it is no number.
std::optional<double> TableReader::number(const Cell& cell, Style& style, std::string& allowed) {
    std::string text(cell.text);
    if (constexpr std::string_view minus = "\u2212"; text.starts_with(minus)) text.replace(0, minus.size(), "-");
    const auto commas = std::count(text.begin(), text.end(), ',');
    const auto points = std::count(text.begin(), text.end(), '.');
    allowed = "a finite number";
    const bool gaps = text.find_first_of(" '") != std::string::npos && text.find_first_of("0123456789") == 0;
    if (commas + points > 1 || gaps) {
        allowed += ", without separators of thousands";
        return std::nullopt;
    }
    if (commas == 1) text[text.find(',')] = '.';
    const std::optional<double> value = plain_number(text);
    if (!value || !std::isfinite(*value)) return std::nullopt;
    if (commas + points == 0) {
        style.largest_whole = std::max(style.largest_whole, std::abs(*value));
        return value;
    }
    const int other = commas == 1 ? decimal_point_ : decimal_comma_;
    if (other != 0) {
        allowed = fmt::format("a number with a decimal {}, as in line {}", commas == 1 ? "point" : "comma", other);
        return std::nullopt;
    }
    int& here = commas == 1 ? decimal_comma_ : decimal_point_;
    if (here == 0) here = cell.line;
    const std::size_t point = text.find('.');
    const bool triple =
        text.size() - point == 4 && text.find_first_of("eE") == std::string::npos && std::abs(*value) >= 1;
    style.only_triples = style.only_triples && triple;
    style.separated = true;
    style.commas = commas == 1;
    return value;
}

std::vector<TableReader::Fault> TableReader::read_row(const Cells& row, std::span<const FoundColumn> columns,
                                                      std::span<const double> before, const RowCheck& check,
                                                      std::vector<double>& values) {
    std::vector<Fault> faults;
    if (row.size() != table_.header.size()) {
        const bool comma = table_.separator == Separator::comma && row.size() == 2 * table_.header.size();
        faults.push_back({row.front().at(),
                          fmt::format("{} values, where the header has {} columns{}", row.size(), table_.header.size(),
                                      comma ? "; decimal commas need semicolons between the cells" : "")});
        return faults;
    }
    values.clear();
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const Sought& sought = sought_[columns[i].sought];
        const Cell& cell = row[columns[i].column];
        std::string allowed;
        const auto read = number(cell, styles_[columns[i].column], allowed);
        const double value = read ? converted(*read, columns[i]) : 0;
        if (read && !sought.range.contains(value)) {
            allowed = sought.range.bounded() ? sought.range.words(std::string(sought.unit)) : "a finite number";
        } else if (read && !before.empty() && sought.order == Sought::Order::not_falling && value < before[i]) {
            allowed = "not before the row above";
        } else if (read && !before.empty() && sought.order == Sought::Order::rising && !(value > before[i])) {
            allowed = "after the row above";
        } else if (read) {
            values.push_back(value);
            continue;
        }
        const bool unit = !read && is_unit(cell.text, sought);
        if (unit) allowed += "; units stand in the header, or in a row right below it";
        faults.push_back(
            {cell.at(), fmt::format("{} is '{}'; allowed is {}", sought.name, shown(cell.text), allowed), unit});
    }
    if (!faults.empty() || !check) return faults;
    if (const auto wrong = check(values)) faults.push_back({row[columns.front().column].at(), *wrong});
    return faults;
}

std::vector<std::vector<double>> TableReader::read(std::span<const std::size_t> used, const RowCheck& check) {
    const std::vector<FoundColumn> columns = columns_->use(used, shares_, problems_);
    if (problems_.empty() && table_.rows.empty()) problems_.add(table_.end, "there are no rows of data");
    problems_.throw_if_any();
    note_columns(columns);
    styles_.resize(table_.header.size());

    std::vector<std::vector<double>> values(columns.size());
    std::vector<double> row_values, before;
    std::vector<int> bad;
    bool unit = false;
    for (const Cells& row : table_.rows) {
        const std::vector<Fault> faults = read_row(row, columns, before, check, row_values);
        if (faults.empty()) {
            for (std::size_t i = 0; i < columns.size(); ++i) values[i].push_back(row_values[i]);
            before = row_values;
            continue;
        }
        bad.push_back(row.front().line);
        for (const Fault& fault : faults) {
            problems_.add(fault.at, fault.message);
            unit = unit || fault.is_unit;
        }
    }
    const bool must_stay = unit || !rows_stay_.empty() || bad.size() == table_.rows.size();
    if (!bad.empty() && (!input_.skip_bad_rows || must_stay)) {
        if (input_.skip_bad_rows && !rows_stay_.empty()) problems_.add(table_.end, rows_stay_);
        try {
            problems_.throw_if_any();
        } catch (const ScenarioError& error) {
            if (must_stay) throw;
            throw BadRows(error);
        }
    }
    note_left_out(bad, table_.rows.size());
    warn_of_numbers(columns, values);
    return values;
}

bool TableReader::picked_by(std::size_t column) const {
    return std::any_of(input_.where.begin(), input_.where.end(),
                       [&](const auto& where) { return columns_->named(where.first) == column; });
}

/// " (3 values: a, b, c; --where series=VALUE picks one)" of a column of words that come again and again.
std::string TableReader::values_of(std::size_t column) const {
    constexpr std::size_t most = 10;
    std::vector<std::string> values;
    for (const Cells& row : table_.rows) {
        if (column >= row.size() || is_number(row[column].text) || is_gap(row[column].text) || values.size() > most)
            return "";
        const std::string value(row[column].text);
        if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
    }
    if (values.size() < 2 || values.size() > most || 2 * values.size() > table_.rows.size()) return "";
    return fmt::format(" ({} values: {}; --where {}=VALUE picks one)", values.size(), listed(values),
                       table_.header[column].text);
}

void TableReader::note_columns(std::span<const FoundColumn> columns) {
    std::string renamed;
    std::vector<std::string> unused;
    for (std::size_t column = 0; column < table_.header.size(); ++column) {
        const std::string_view text = table_.header[column].text;
        const auto holds = [&](const FoundColumn& one) { return one.column == column; };
        const auto found = std::find_if(columns.begin(), columns.end(), holds);
        if (found == columns.end()) {
            if (!text.empty() && !picked_by(column)) unused.push_back(shown(text) + values_of(column));
            continue;
        }
        // A name of its own, with its unit in brackets, says it all.
        const Sought& sought = sought_[found->sought];
        const std::string_view unit = found->unit.empty() ? sought.unit : std::string_view(found->unit);
        if (text == sought.name || text == fmt::format("{} [{}]", sought.name, unit)) continue;
        renamed += fmt::format("{}{}{} from '{}'{}", renamed.empty() ? "" : ", ", sought.name,
                               unit == "1" || unit == "-" ? "" : fmt::format(" in {}", unit), shown(text),
                               found->sign < 0 ? " with its sign turned" : "");
    }
    if (!renamed.empty()) remarks_.notes.push_back(fmt::format("Read: {}.", renamed));
    if (!unused.empty()) remarks_.notes.push_back(fmt::format("Columns that are not used: {}.", first_of(unused, 20)));
    if (!table_.commented_rows.empty()) {
        remarks_.notes.push_back(fmt::format("Passed over as comments, though they look like rows: line{} {}.",
                                             table_.commented_rows.size() == 1 ? "" : "s",
                                             first_of(table_.commented_rows)));
    }
    if (table_.longer_rows && table_.separator == Separator::comma) {
        remarks_.warnings.push_back(fmt::format(
            "{}: rows have an empty cell more than the header; if their numbers have decimal commas, they were split "
            "wrongly: separate the cells by semicolons then",
            name_));
    }
}

void TableReader::note_left_out(const std::vector<int>& lines, std::size_t rows) {
    if (lines.empty()) return;
    remarks_.notes.push_back(fmt::format("{} of {} rows could not be used and were left out: line{} {}.", lines.size(),
                                         rows, lines.size() == 1 ? "" : "s", first_of(lines)));
}

void TableReader::warn_of_style(const FoundColumn& column) {
    const Style& style = styles_[column.column];
    // Three digits behind each point are usual; beside whole numbers above them they are not.
    constexpr double hundreds = 100;
    const bool doubtful = style.separated && style.only_triples && (style.commas || style.largest_whole >= hundreds);
    if (!doubtful) return;
    remarks_.warnings.push_back(fmt::format(
        "{}: every {} in column '{}' has three digits behind it; it is read as decimal, 1{}200 as 1.2; if it separates "
        "thousands, remove it",
        name_, style.commas ? "comma" : "point", shown(table_.header[column.column].text), style.commas ? ',' : '.'));
}

void TableReader::warn_of_numbers(std::span<const FoundColumn> columns,
                                  const std::vector<std::vector<double>>& values) {
    if (decimal_comma_ != 0) remarks_.notes.emplace_back("Decimal commas.");
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const Sought& sought = sought_[columns[i].sought];
        warn_of_style(columns[i]);
        double largest = 0;
        for (const double value : values[i]) largest = std::max(largest, std::abs(value));
        if (!columns[i].unit.empty()) continue;
        if (largest < sought.hardly && values[i].size() > 1) {
            remarks_.warnings.push_back(
                fmt::format("{}: column '{}' has no unit, so it was read in {}, and goes to {:.4g} "
                            "{} only; if that is not meant, write its unit into the header",
                            name_, shown(table_.header[columns[i].column].text), sought.unit, largest, sought.unit));
        }
        if (!(largest > sought.plausible)) continue;
        remarks_.warnings.push_back(fmt::format(
            "{}: column '{}' has no unit, so it was read in {}, and goes to {:.4g} {}; if that is not meant, write its "
            "unit into the header: '{} [{}]'",
            name_, shown(table_.header[columns[i].column].text), sought.unit, largest, sought.unit, sought.name,
            sought.unit == "m/s" ? "mm/s" : fmt::format("m{}", sought.unit)));
    }
}

}  // namespace footfall::io
