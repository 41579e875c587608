// One reader for every table of measurements: `fit`, `oblique --fit` and the paths of `drive` come here.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "footfall/io/table_input.hpp"
#include "footfall/study/table.hpp"
#include "io/problems.hpp"
#include "io/table_columns.hpp"

namespace footfall::io {

/// The numbers of one row, in the order of the quantities that were asked for; returns what is wrong with them
/// together, if anything is.
using RowCheck = std::function<std::optional<std::string>(std::span<const double>)>;

class TableReader {
public:
    /// Reads the header of a table. `wanted` says in messages what the header should name. Throws ScenarioError.
    TableReader(std::string text, std::string name, std::vector<Sought> sought, const TableInput& input,
                std::string_view wanted);

    /// The table has a column for this quantity, by its place in the list.
    [[nodiscard]] bool has(std::size_t sought) const { return columns_->has(sought); }

    /// Says the unit of a quantity that was sought without one.
    void set_unit(std::size_t sought, std::string_view unit) { sought_[sought].unit = unit; }

    /// A quantity without a unit has the one of another quantity.
    void share_unit(std::size_t sought, std::size_t of) { shares_.emplace_back(sought, of); }

    /// Bad rows are errors whatever the user says, for this reason.
    void keep_all_rows(std::string reason) { rows_stay_ = std::move(reason); }

    /// Throws ScenarioError: what the header lacks, beside what might have been meant.
    [[noreturn]] void refuse_header(const std::string& message);

    /// The numbers of the quantities `used`, each of which the header has, one vector for each, converted to their
    /// units. Rows that `input` does not pick are passed over. Throws ScenarioError with everything that is wrong;
    /// BadRows where only rows are.
    [[nodiscard]] std::vector<std::vector<double>> read(std::span<const std::size_t> used, const RowCheck& check = {});

    /// What there is to say of the table; complete after read().
    [[nodiscard]] TableRemarks& remarks() noexcept { return remarks_; }

private:
    struct Fault {
        Position at;
        std::string message;
        bool is_unit = false;  ///< a unit stands where a number should: such a row is never left out
    };
    /// How the numbers of a column are written.
    struct Style {
        bool commas = false;       ///< there is one
        bool separated = false;    ///< there is a comma or a point
        bool only_triples = true;  ///< all have three digits behind it, and none a zero before it
        double largest_whole = 0;  ///< of the numbers without
    };
    [[noreturn]] void refuse(const Cell& cell, const std::string& message);
    void pick_rows();
    [[nodiscard]] std::optional<double> number(const Cell& cell, Style& style, std::string& allowed);
    [[nodiscard]] std::vector<Fault> read_row(const Cells& row, std::span<const FoundColumn> columns,
                                              std::span<const double> before, const RowCheck& check,
                                              std::vector<double>& values);
    [[nodiscard]] bool picked_by(std::size_t column) const;
    [[nodiscard]] std::string values_of(std::size_t column) const;
    void note_columns(std::span<const FoundColumn> columns);
    void note_left_out(const std::vector<int>& lines, std::size_t rows);
    void warn_of_style(const FoundColumn& column);
    void warn_of_numbers(std::span<const FoundColumn> columns, const std::vector<std::vector<double>>& values);

    DecodedText text_;
    std::string name_;
    Problems problems_;
    std::vector<Sought> sought_;
    const TableInput& input_;
    TableText table_;
    std::unique_ptr<Columns> columns_;
    std::vector<std::pair<std::size_t, std::size_t>> shares_;
    TableRemarks remarks_;
    std::vector<Style> styles_;                  ///< of each column of the table
    int decimal_comma_ = 0, decimal_point_ = 0;  ///< the line where one was first seen
    std::string rows_stay_;                      ///< why no row may be left out; empty: any may
};

}  // namespace footfall::io
