// What a table's columns hold.
#include "io/table_columns.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "footfall/math/error.hpp"
#include "io/nearest.hpp"
#include "io/read.hpp"

namespace footfall::io {
namespace {

/// Names are compared without case; blanks, hyphens, points and underscores are the same.
std::string normalized(std::string_view name) {
    std::string made;
    for (const char c : name) {
        const bool gap = c == ' ' || c == '-' || c == '.' || c == '_' || c == '\t';
        if (!gap) made += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
        if (gap && !made.empty() && made.back() != '_') made += '_';
    }
    while (made.ends_with('_')) made.pop_back();
    return made;
}

/// A name of a quantity as the header has it. Single letters are compared as they are: t is a time, T may be a
/// temperature.
class Word {
public:
    explicit Word(std::string_view name) : name_(name), normalized_(normalized(name)) {}
    [[nodiscard]] bool is(std::string_view known) const {
        return known.size() == 1 ? name_ == known : normalized_ == known;
    }

private:
    std::string_view name_;
    std::string normalized_;
};

/// As readable_unit, but throws InvalidInput.
Unit unit_of(std::string_view text) {
    const bool none = text.empty() || text == "-" || text == "1";
    return none ? Unit{} : parse_unit(text);
}

/// The words of a name.
std::vector<std::string_view> words_of(std::string_view name) {
    constexpr std::string_view gaps = "_ -.,:";
    std::vector<std::string_view> words;
    for (std::size_t begin = 0; begin < name.size();) {
        const std::size_t end = std::min(name.find_first_of(gaps, begin), name.size());
        if (end > begin) words.push_back(name.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

bool has_letter(std::string_view word) {
    const auto letter = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%' || static_cast<unsigned char>(c) >= 0x80;
    };
    return std::any_of(word.begin(), word.end(), letter);
}

/// The same unit, however it is written.
bool same_unit(std::string_view a, std::string_view b) {
    const auto first = readable_unit(a), second = readable_unit(b);
    return a == b || (first && second && first->dimension == second->dimension && first->factor == second->factor &&
                      first->exponent == second->exponent);
}

/// What words after an underscore may mean: "us"; "rad_s" and "rad_per_s" are rad/s, "N_m" N/m or N m; "s2" is s^2.
std::vector<std::string> unit_readings(std::span<const std::string_view> words) {
    std::vector<std::string> units;
    for (const std::string_view word : words) {
        if (!has_letter(word)) return {};
        std::string unit(word);
        const bool power = unit.size() > 1 && (unit.back() == '2' || unit.back() == '3');
        if (power) unit.insert(unit.size() - 1, "^");
        units.push_back(std::move(unit));
    }
    if (units.size() == 1) return units;
    if (units.size() == 2) return {units[0] + "/" + units[1], units[0] + " " + units[1]};
    if (units.size() == 3 && units[1] == "per") return {units[0] + "/" + units[2]};
    return {};
}

std::string quoted(const Cell& cell) { return fmt::format("'{}'", cell.text); }

/// The name and what stands behind it: "F / N", "speed in mm/s".
std::vector<std::pair<std::string_view, std::string_view>> halves_of(std::string_view name) {
    std::vector<std::pair<std::string_view, std::string_view>> halves;
    for (const std::string_view between : {"/", " in "}) {
        const std::size_t place = name.find(between);
        if (place == std::string_view::npos) continue;
        halves.emplace_back(trimmed(name.substr(0, place)), trimmed(name.substr(place + between.size())));
    }
    return halves;
}

}  // namespace

std::optional<Unit> readable_unit(std::string_view text) {
    try {
        return unit_of(text);
    } catch (const InvalidInput&) {
        return std::nullopt;
    }
}

Columns::Columns(TableText& table, std::span<const Sought> sought, const TableInput& input, Problems& problems)
    : table_(table), sought_(sought) {
    for (const Cell& cell : table.header) heads_.push_back(head_of(cell.text));
    // In a long table the column "value" holds what the rows that are picked are called.
    for (Head& head : heads_) {
        const std::string name = normalized(head.name);
        if (name != "value" && name != "values") continue;
        for (const auto& where : input.where) {
            const Head called = head_of(where.second);
            if (!named_quantity(called.name)) continue;
            head.name = called.name;
            if (head.unit.empty()) head.unit = called.unit;
        }
    }
    take_row_of_units(table);

    std::vector<std::string> names;
    for (const Sought& one : sought) names.emplace_back(one.name);
    for (const auto& [name, column] : input.columns) {
        const auto place = std::find(names.begin(), names.end(), name);
        if (place == names.end()) {
            throw InvalidInput(fmt::format("column {}={}: unknown quantity '{}'{} (there are {})", name, column, name,
                                           did_you_mean(name, names), listed(names)));
        }
        choose(static_cast<std::size_t>(place - names.begin()), column, problems);
    }
    for (std::size_t column = 0; column < heads_.size(); ++column) find_by_name(column);
}

Columns::Head Columns::head_of(std::string_view text) {
    Head head{std::string(text), "", false};
    for (const auto& [open, close] : {std::pair{'[', ']'}, {'(', ')'}}) {
        const std::size_t begin = text.find(open);
        if (begin == std::string_view::npos) continue;
        head.name = trimmed(text.substr(0, begin), " \t/");  // "v / (m/s)"
        head.open = !text.ends_with(close);
        if (!head.open) head.unit = trimmed(text.substr(begin + 1, text.size() - begin - 2));
        break;
    }
    return head;
}

const std::string& Columns::row_unit(std::size_t column) const {
    static const std::string none;
    return column < row_units_.size() ? row_units_[column] : none;
}

/// The units of a row in which no cell is a number and one at least is a unit; empty where it is none.
std::vector<std::string> Columns::units_of(const Cells& cells) {
    std::vector<std::string> units;
    bool any = false;
    for (const Cell& cell : cells) {
        std::string_view text = cell.text;
        const bool brackets = text.size() >= 2 && ((text.front() == '[' && text.back() == ']') ||
                                                   (text.front() == '(' && text.back() == ')'));
        if (brackets) text = trimmed(text.substr(1, text.size() - 2));
        const bool without = is_gap(text) || text == "1";
        if (!without && is_number(text)) return {};
        any |= brackets || (!without && readable_unit(text));
        units.emplace_back(without ? "" : text);
    }
    return any ? units : std::vector<std::string>{};
}

/// Units may stand in the first row, or in a comment above it.
void Columns::take_row_of_units(TableText& table) {
    if (!table.rows.empty()) row_units_ = units_of(table.rows.front());
    if (!row_units_.empty()) {
        table.rows.erase(table.rows.begin());
    } else {
        row_units_ = units_of(table.comment_below);
    }
}

std::optional<std::size_t> Columns::known(std::string_view name) const {
    const Word word(name);
    for (std::size_t i = 0; i < sought_.size(); ++i) {
        const auto is = [&word](std::string_view one) { return word.is(one); };
        if (is(sought_[i].name) || std::any_of(sought_[i].names.begin(), sought_[i].names.end(), is)) return i;
    }
    return std::nullopt;
}

bool Columns::has_dimension_of(const Sought& sought, std::string_view unit) const {
    const auto read = readable_unit(unit);
    return read && (sought.unit.empty() || read->dimension == parse_unit(sought.unit).dimension);
}

/// The unit in a name that was chosen for a quantity: "us" of "time_us", "mm/s" of "U in mm/s".
std::string Columns::unit_within(std::string_view name, const Sought& sought) const {
    for (const auto& [first, rest] : halves_of(name))
        if (!rest.empty() && has_dimension_of(sought, rest)) return std::string(rest);
    // The unit of a speed may have a stroke of its own: "u mm/s".
    const std::size_t blank = name.rfind(' ');
    const std::string_view last = blank == std::string_view::npos ? std::string_view{} : name.substr(blank + 1);
    if (has_letter(last) && has_dimension_of(sought, last)) return std::string(last);
    const std::vector<std::string_view> words = words_of(name);
    for (std::size_t length = 3; length > 0; --length) {
        for (std::size_t begin = 1; begin + length <= words.size(); ++begin)
            for (const std::string& unit : unit_readings(std::span(words).subspan(begin, length)))
                if (has_dimension_of(sought, unit)) return unit;
    }
    return "";
}

void Columns::choose(std::size_t sought, std::string_view text, Problems& problems) {
    FoundColumn found{.sought = sought};
    const auto is_text = [&](const Cell& cell) { return cell.text == text; };
    if (text.starts_with('-') && std::none_of(table_.header.begin(), table_.header.end(), is_text)) {
        found.sign = -1;
        text = trimmed(text.substr(1));
    }
    std::string asked;
    std::vector<std::size_t> columns = all_named(text);
    // "Force (filtered) [N]" asks for the column "Force (filtered)" in N.
    const std::size_t bracket = text.rfind('[');
    if (bracket != std::string_view::npos && text.ends_with(']')) {
        const std::string_view name = trimmed(text.substr(0, bracket));
        if (columns.empty()) columns = all_named(name);
        if (columns.size() == 1 && table_.header[columns.front()].text != text)
            asked = trimmed(text.substr(bracket + 1, text.size() - bracket - 2));
    } else if (const Head head = head_of(text); columns.size() == 1 && table_.header[columns.front()].text != text) {
        asked = head.unit;
    }
    if (columns.size() != 1) {
        problems.add(table_.header.front().at(), fmt::format("{}: {}", sought_[sought].name, no_column(text)));
        return;
    }
    found.column = columns.front();
    const Cell& cell = table_.header[found.column];
    if (is_taken(found.column)) {
        problems.add(cell.at(), fmt::format("{} is chosen for two quantities", quoted(cell)));
        return;
    }
    chosen_.push_back(sought);
    const Head& head = heads_[found.column];
    std::string own = head.unit.empty() ? row_unit(found.column) : head.unit;
    const std::string within = unit_within(head.name, sought_[sought]);
    if (own.empty()) own = within;
    // What stands in parentheses may be no unit at all, "force (filtered)"; the user then says which it is.
    const bool replaces = own.empty() || (!asked.empty() && !readable_unit(own));
    if (!asked.empty() && !replaces && !same_unit(asked, own)) {
        problems.add(cell.at(), fmt::format("{} has the unit {}, but {} asks for {}", quoted(cell), own, text, asked));
        return;
    }
    found.unit = asked.empty() ? own : asked;
    if (!within.empty() && !same_unit(within, found.unit)) found.other = within;
    found_.push_back(std::move(found));
}

std::optional<Columns::Named> Columns::named_quantity(std::string_view name) const {
    if (const auto whole = known(name)) return Named{*whole, ""};
    for (const auto& [first, rest] : halves_of(name))
        if (const auto sought = known(first)) return Named{*sought, std::string(rest)};
    // A unit among the words of the name, most often the last: "time_us", "final_omega_rad_s".
    const std::vector<std::string_view> words = words_of(name);
    constexpr std::size_t longest = 3, most_words = 12;
    if (words.size() > most_words) return std::nullopt;
    for (std::size_t length = 1; length <= longest && length < words.size(); ++length) {
        for (std::size_t begin = words.size() - length; begin > 0; --begin) {
            std::vector<std::string_view> rest(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(begin));
            rest.insert(rest.end(), words.begin() + static_cast<std::ptrdiff_t>(begin + length), words.end());
            const auto sought = known(fmt::format("{}", fmt::join(rest, "_")));
            if (!sought) continue;
            for (std::string& reading : unit_readings(std::span(words).subspan(begin, length)))
                if (has_dimension_of(sought_[*sought], reading)) return Named{*sought, std::move(reading)};
        }
    }
    return std::nullopt;
}

void Columns::find_by_name(std::size_t column) {
    if (is_taken(column)) return;
    const Head& head = heads_[column];
    auto quantity = named_quantity(head.name);
    if (!quantity || std::find(chosen_.begin(), chosen_.end(), quantity->sought) != chosen_.end()) return;
    FoundColumn found{.sought = quantity->sought, .column = column};
    found.unit = head.unit.empty() ? row_unit(column) : head.unit;
    if (found.unit.empty()) {
        found.unit = std::move(quantity->unit);
    } else if (!quantity->unit.empty() && !same_unit(quantity->unit, found.unit)) {
        found.other = std::move(quantity->unit);
    }
    found_.push_back(std::move(found));
}

bool Columns::is_taken(std::size_t column) const {
    return std::any_of(found_.begin(), found_.end(), [&](const FoundColumn& one) { return one.column == column; });
}

bool Columns::has(std::size_t sought) const {
    return std::any_of(found_.begin(), found_.end(), [&](const FoundColumn& one) { return one.sought == sought; });
}

std::vector<FoundColumn> Columns::use(std::span<const std::size_t> used,
                                      std::span<const std::pair<std::size_t, std::size_t>> shares,
                                      Problems& problems) const {
    const auto unit_of_found = [&](std::size_t sought) -> std::string {
        for (const FoundColumn& one : found_)
            if (one.sought == sought) return one.unit;
        return "";
    };
    std::vector<FoundColumn> columns;
    for (const std::size_t sought : used) {
        const FoundColumn* first = nullptr;
        for (const FoundColumn& one : found_) {
            if (one.sought != sought) continue;
            const Cell& cell = table_.header[one.column];
            if (first != nullptr) {
                const std::string& name = heads_[one.column].name;
                problems.add(cell.at(), name == heads_[first->column].name
                                            ? fmt::format("column '{}' is there twice", name)
                                            : fmt::format("{} and {} are both the {}: choose one with --column {}=NAME",
                                                          quoted(table_.header[first->column]), quoted(cell),
                                                          sought_[sought].name, sought_[sought].name));
                continue;
            }
            first = &one;
            columns.push_back(one);
            for (const auto& [sharing, of] : shares)
                if (sharing == sought && one.unit.empty()) columns.back().unit = unit_of_found(of);
            convert(columns.back(), problems);
        }
    }
    return columns;
}

void Columns::convert(FoundColumn& found, Problems& problems) const {
    const Cell& cell = table_.header[found.column];
    const Head& head = heads_[found.column];
    if (head.open) {
        problems.add(cell.at(), fmt::format("{}: a unit stands in brackets, as in 'speed [m/s]'", quoted(cell)));
        return;
    }
    const std::string& below = row_unit(found.column);
    if (!found.other.empty()) {
        problems.add(cell.at(), fmt::format("{}: is it in {} or in {}? Give the unit once", quoted(cell), found.other,
                                            found.unit));
        return;
    }
    if (!head.unit.empty() && !below.empty() && !same_unit(head.unit, below)) {
        problems.add(cell.at(), fmt::format("{}: the row below says {}; give the unit once", quoted(cell), below));
        return;
    }
    if (found.unit.empty()) return;
    const Unit wanted = parse_unit(sought_[found.sought].unit);
    try {
        const Unit given = unit_of(found.unit);
        if (given.dimension != wanted.dimension) {
            throw InvalidInput(
                fmt::format("expected {}, got {}", describe(wanted.dimension), describe(given.dimension)));
        }
        const double exponent = given.exponent - wanted.exponent;
        found.factor = given.factor / wanted.factor;
        found.ten = std::pow(10.0, std::abs(exponent));
        found.divide = exponent < 0;
    } catch (const InvalidInput& error) {
        const bool said = cell.text.find(found.unit) != std::string_view::npos;
        problems.add(cell.at(), said ? fmt::format("{}: {}", quoted(cell), error.what())
                                     : fmt::format("{} [{}]: {}", quoted(cell), found.unit, error.what()));
    }
}

std::vector<std::size_t> Columns::all_named(std::string_view name) const {
    std::vector<std::size_t> columns;
    for (std::size_t column = 0; column < table_.header.size(); ++column)
        if (table_.header[column].text == name) columns.push_back(column);
    if (!columns.empty()) return columns;
    const std::string wanted = normalized(head_of(name).name);
    for (std::size_t column = 0; column < heads_.size(); ++column)
        if (!wanted.empty() && normalized(heads_[column].name) == wanted) columns.push_back(column);
    return columns;
}

std::optional<std::size_t> Columns::named(std::string_view name) const {
    const std::vector<std::size_t> columns = all_named(name);
    return columns.size() == 1 ? std::optional(columns.front()) : std::nullopt;
}

std::string Columns::no_column(std::string_view name) const {
    std::vector<std::string> names;
    for (const Cell& cell : table_.header) names.emplace_back(shown(cell.text));
    if (const std::size_t count = all_named(name).size(); count > 1)
        return fmt::format("there are {} columns '{}' (columns here: {})", count, name, listed(names));
    return fmt::format("no column '{}'{} (columns here: {})", name, did_you_mean(name, names), listed(names));
}

void Columns::say_what_was_meant(Problems& problems) const {
    // Short names are near to everything.
    constexpr std::size_t short_name = 3;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < sought_.size(); ++i) {
        if (has(i)) continue;
        names.emplace_back(sought_[i].name);
        for (const std::string_view other : sought_[i].names)
            if (other.size() > short_name) names.emplace_back(other);
    }
    for (std::size_t column = 0; column < heads_.size(); ++column) {
        if (is_taken(column)) continue;
        const std::string name = normalized(heads_[column].name);
        const std::string meant = name.size() > short_name ? did_you_mean(name, names) : "";
        if (meant.empty()) continue;
        problems.add(table_.header[column].at(), fmt::format("unknown column '{}'{}", heads_[column].name, meant));
    }
}

}  // namespace footfall::io
