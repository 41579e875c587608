// The text of a table, whoever wrote it, as cells: separators, quotes, comments and the header are settled here.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "io/problems.hpp"

namespace footfall::io {

struct Cell {
    std::string_view text;    ///< without the blanks and quotes around it
    std::string_view before;  ///< what stands on its line before it
    int line = 1;
    bool quoted = false;

    [[nodiscard]] Position at() const;
};
using Cells = std::vector<Cell>;

/// What stands between two cells.
enum class Separator { tab, semicolon, comma, wide_blank, blank, none };

/// A header and the rows under it. Cells point into the text and into `unquoted`.
struct TableText {
    Cells header;
    std::vector<Cells> rows;          ///< a row may have more or fewer cells than the header
    Cells comment_below;              ///< a comment between the header and the rows, as cells of their number
    std::vector<int> commented_rows;  ///< lines of comments that look like rows
    bool longer_rows = false;         ///< a row had an empty cell too many at its end
    Separator separator = Separator::none;
    Position end;                      ///< the last line
    std::deque<std::string> unquoted;  ///< cells that had doubled quotes in them
};

/// The text of a file as UTF-8, and whether it was that before.
struct DecodedText {
    std::string text;
    bool was_utf8;
};
/// What is no UTF-8 is taken for Windows-1252. Throws ScenarioError where it is no text.
[[nodiscard]] DecodedText decoded(std::string text, const std::string& name);

/// Splits the text of a file, in UTF-8. Lines may end as on any system; empty lines and those that begin with # or %
/// are passed over; cells may be quoted (RFC 4180). Cells are separated by tabs, semicolons, commas or blanks,
/// whichever splits header and rows alike. `wanted` says in messages what the header should name. Throws ScenarioError
/// where it is no table of text, where it has no header, or where no separator fits.
[[nodiscard]] TableText split_table(std::string_view text, const std::string& name, std::string_view wanted);

/// A cell that has a number in it, with a decimal point or comma.
[[nodiscard]] bool is_number(std::string_view cell);

/// A cell that stands for a missing number ("NaN", "n/a", "-", nothing).
[[nodiscard]] bool is_gap(std::string_view cell);

}  // namespace footfall::io
