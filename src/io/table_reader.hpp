// One reader for every table of measurements: `fit`, `oblique --fit` and the paths of `drive` come here.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
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
    };
    void pick_rows();
    [[nodiscard]] std::optional<double> number(const Cell& cell, std::string& allowed);
    [[nodiscard]] std::vector<Fault> read_row(const Cells& row, std::span<const FoundColumn> columns,
                                              std::span<const double> before, const RowCheck& check,
                                              std::vector<double>& values);
    [[nodiscard]] bool picked_by(std::size_t column) const;
    [[nodiscard]] std::string values_of(std::size_t column) const;
    void note_columns(std::span<const FoundColumn> columns);
    void note_left_out(const std::vector<int>& lines, std::size_t rows);
    void warn_of_numbers(std::span<const FoundColumn> columns, const std::vector<std::vector<double>>& values);

    bool is_utf8_;
    std::string text_;
    std::string name_;
    Problems problems_;
    std::vector<Sought> sought_;
    const TableInput& input_;
    TableText table_;
    std::unique_ptr<Columns> columns_;
    TableRemarks remarks_;
    int decimal_comma_ = 0, decimal_point_ = 0;  ///< the line where one was first seen
    bool commas_are_decimal_ = false;            ///< one cannot be a separator of thousands
};

}  // namespace footfall::io
