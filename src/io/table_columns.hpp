// What a table's columns hold: quantities by their name, by the names that laboratories give them, or by what the user
// says; each with its unit.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "footfall/io/table_input.hpp"
#include "footfall/io/units.hpp"
#include "io/keys.hpp"
#include "io/table_text.hpp"

namespace footfall::io {

/// A quantity that is looked for in a table.
struct Sought {
    std::string_view name;  ///< as messages and --column call it: "speed"
    /// What its numbers are converted to, and have where none is given; empty: known only when the others are.
    std::string_view unit = "1";
    std::vector<std::string_view> names = {};  ///< well-known names: lower case, '_' between words; one letter as it is
    Range range = {};
    enum class Order { any, not_falling, rising } order = Order::any;
    /// Beyond it [unit] a number without a unit is hardly meant, and a warning says so.
    double plausible = std::numeric_limits<double>::infinity();
    double hardly = 0;  ///< the same where no number reaches it
};

/// The column of a table that holds a sought quantity.
struct FoundColumn {
    std::size_t sought = 0;
    std::size_t column = 0;
    std::string unit = {};   ///< as the table or the user gives it; empty: none
    std::string other = {};  ///< another unit that its name or the row below gives
    double sign = 1;
    /// To the sought unit: its power of ten apart, as Unit has it, and either multiplied or divided by.
    double factor = 1, ten = 1;
    bool divide = false;
};

/// A unit as a table's header writes it, "-" and "1" being none; nothing where it cannot be read.
[[nodiscard]] std::optional<Unit> readable_unit(std::string_view text);

/// The columns of a table. Units may stand behind a name, in brackets, in parentheses or after an underscore, or in a
/// row of their own below the header.
class Columns {
public:
    /// Finds `sought` in the header; takes the row of units out of the table. What `input` chooses and the table lacks
    /// is added to `problems`.
    Columns(TableText& table, std::span<const Sought> sought, const TableInput& input, Problems& problems);

    [[nodiscard]] bool has(std::size_t sought) const;
    /// The columns of these quantities, each of which is there. Adds to `problems` where one is there twice, or has a
    /// unit that cannot be read or is of another dimension.
    /// A quantity of `shares` that has no unit has that of its partner.
    [[nodiscard]] std::vector<FoundColumn> use(std::span<const std::size_t> used,
                                               std::span<const std::pair<std::size_t, std::size_t>> shares,
                                               Problems& problems) const;

    /// The one column with this name in the header, with or without its unit.
    [[nodiscard]] std::optional<std::size_t> named(std::string_view name) const;
    /// "no column 'x': did you mean 'y'? (columns here: y, z)", or that there are several.
    [[nodiscard]] std::string no_column(std::string_view name) const;
    /// Adds a problem for each column that might have been meant for a quantity, by a name that is near to its or by a
    /// known name with a unit of another dimension.
    void say_what_was_meant(Problems& problems) const;

private:
    /// A name of the header, apart from its unit.
    struct Head {
        std::string name;
        std::string unit;
        bool open = false;  ///< a bracket without its other half
    };
    [[nodiscard]] static Head head_of(std::string_view text);
    [[nodiscard]] bool is_taken(std::size_t column) const;
    [[nodiscard]] const std::string& row_unit(std::size_t column) const;
    [[nodiscard]] std::optional<std::size_t> known(std::string_view name) const;
    [[nodiscard]] static std::vector<std::string> units_of(const Cells& cells);
    void take_row_of_units(TableText& table);
    void choose(std::size_t sought, std::string_view text, Problems& problems);
    void find_by_name(std::size_t column);
    [[nodiscard]] bool has_dimension_of(const Sought& sought, std::string_view unit) const;
    /// A quantity that a name stands for, with the unit in the name.
    struct Named {
        std::size_t sought;
        std::string unit;
    };
    [[nodiscard]] std::optional<Named> named_quantity(std::string_view name) const;
    [[nodiscard]] std::string unit_within(std::string_view name, const Sought& sought) const;
    [[nodiscard]] std::vector<std::size_t> all_named(std::string_view name) const;
    void convert(FoundColumn& found, Problems& problems) const;

    const TableText& table_;
    std::span<const Sought> sought_;
    std::vector<Head> heads_;
    std::vector<std::string> row_units_;
    std::vector<FoundColumn> found_;
    std::vector<std::size_t> chosen_;  ///< the quantities whose column the user names
};

}  // namespace footfall::io
