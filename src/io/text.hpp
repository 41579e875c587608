// Numbers and tables for a terminal.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace footfall::text {

/// A value that a user gave, as short as `digits` significant digits allow: "8.5e6", "0.2", "12000".
[[nodiscard]] std::string number(double value, int digits = 6);

/// A measured value with four significant digits and an SI prefix: "312.4 µm". Zero is "0 m".
[[nodiscard]] std::string quantity(double value, std::string_view unit);

/// A count in groups of three: "12,345".
[[nodiscard]] std::string count(long long value);

/// One power of 1000, with its prefix.
struct Prefix {
    double factor;
    std::string_view symbol;
};
/// The prefix under which `magnitude` reads between 1 and 1000.
[[nodiscard]] Prefix prefix_of(double magnitude);

/// `text` as a TOML string, with its quotes.
[[nodiscard]] std::string toml_string(std::string_view text);

/// Columns on a terminal, as many characters as they have, not bytes.
[[nodiscard]] std::size_t width(std::string_view text);

/// `length` times a character.
[[nodiscard]] std::string repeat(std::string_view character, std::size_t length);

/// `text` broken between words into lines of at most `columns` characters.
[[nodiscard]] std::vector<std::string> wrap(std::string_view text, std::size_t columns);

/// A paragraph for a page, indented by two, its further lines by four, each with a line break.
[[nodiscard]] std::string hanging(std::string_view text);

enum class Align {
    left,
    right,
    unit,  ///< number and unit, each aligned: the cell is split at its first space
};

/// Cells in aligned columns, two spaces apart, indented by two.
class Table {
public:
    explicit Table(std::vector<Align> alignment) : alignment_(std::move(alignment)) {}

    /// The names of the columns, with a rule under them. A name of two lines has a line break.
    void head(std::vector<std::string> names);
    void row(std::vector<std::string> cells);
    /// A line across the columns.
    void rule();
    /// A row that is not aligned to the columns.
    void note(std::string text);

    [[nodiscard]] std::string str() const;

private:
    struct Row {
        enum class Kind { head, cells, rule, note } kind;
        std::vector<std::string> cells;
    };
    [[nodiscard]] std::string aligned(const Row& row, std::size_t column, std::size_t width, std::size_t unit) const;

    std::vector<Align> alignment_;
    std::vector<Row> rows_;
};

}  // namespace footfall::text
