// Measurements from a CSV file, and what of a law is to be fitted.
#include "footfall/io/fit_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "footfall/io/law_text.hpp"
#include "footfall/io/units.hpp"
#include "io/nearest.hpp"
#include "io/problems.hpp"
#include "io/read.hpp"

namespace footfall {
namespace {

using io::plain_number;
using io::Position;
using io::trimmed;

// The file ------------------------------------------------------------------------------------------------------------

/// One cell and where it begins.
struct Cell {
    std::string_view text;
    Position at;
};

std::vector<Cell> cells_of(std::string_view line, int number) {
    std::vector<Cell> cells;
    for (std::size_t begin = 0;;) {
        const std::size_t comma = std::min(line.find(',', begin), line.size());
        const std::string_view text = trimmed(line.substr(begin, comma - begin));
        const std::size_t offset = text.empty() ? begin : static_cast<std::size_t>(text.data() - line.data());
        cells.push_back({text, {number, static_cast<int>(offset) + 1}});
        if (comma == line.size()) return cells;
        begin = comma + 1;
    }
}

/// The columns that there are.
enum Name : std::size_t { speed, restitution, indentation, rate, time, force, sigma, name_count };
struct Known {
    std::string_view name, unit;
};
constexpr std::array<Known, name_count> known{{{"speed", "m/s"},
                                               {"restitution", "1"},
                                               {"indentation", "m"},
                                               {"rate", "m/s"},
                                               {"time", "s"},
                                               {"force", "N"},
                                               {"sigma", ""}}};  // that of what it belongs to

constexpr std::string_view what_is_needed =
    "needed are speed and restitution, or indentation and force, or time and force";

class Reader {
public:
    explicit Reader(const std::string& name) : name_(name), problems_(name) {}

    FitData read(std::string_view text) {
        if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // the byte order mark of a spreadsheet
        int number = 0;
        Position end;
        while (!text.empty()) {
            const std::size_t length = std::min(text.find('\n'), text.size());
            const std::string_view line = text.substr(0, length);
            text.remove_prefix(std::min(length + 1, text.size()));
            end = {++number, 1};
            const std::string_view content = trimmed(line);
            if (content.empty() || content.starts_with('#')) continue;
            const std::vector<Cell> cells = cells_of(line, number);
            if (!header_) {
                head(cells);
                if (!problems_.empty()) break;  // the rows would only say the same again
            } else {
                row(cells);
            }
        }
        if (!header_)
            problems_.add(end, fmt::format("there is no header line that names the columns; {}", what_is_needed));
        if (problems_.empty() && data_.x.empty()) problems_.add(end, "there are no rows of data");
        problems_.throw_if_any();
        return std::move(data_);
    }

private:
    struct Column {
        Name name;
        double factor;  ///< to SI units
    };

    void head(const std::vector<Cell>& cells) {
        header_ = cells.front().at;
        std::vector<std::string> names;
        for (const Known& k : known) names.emplace_back(k.name);
        std::vector<std::pair<Cell, std::string_view>> units;
        for (const Cell& cell : cells) {
            const std::size_t bracket = std::min(cell.text.find('['), cell.text.size());
            const std::string_view word = trimmed(cell.text.substr(0, bracket));
            std::string_view unit = trimmed(cell.text.substr(bracket));
            if (!unit.empty() && !unit.ends_with(']')) {
                problems_.add(cell.at, fmt::format("'{}': a unit stands in brackets, as in 'speed [m/s]'", cell.text));
            }
            if (unit.size() >= 2) unit = unit.substr(1, unit.size() - 2);
            const auto found = std::find_if(known.begin(), known.end(), [&](const Known& k) { return k.name == word; });
            if (found == known.end()) {
                const std::string meant = io::did_you_mean(word, names);
                problems_.add(cell.at,
                              fmt::format("unknown column '{}'{} (columns: {})", word, meant, io::listed(names)));
                return;
            }
            const auto column = static_cast<Name>(found - known.begin());
            if (has(column)) problems_.add(cell.at, fmt::format("column '{}' is there twice", word));
            columns_.push_back({column, 1});
            units.emplace_back(cell, unit);
        }
        const bool curve = has(speed) && has(restitution), loop = has(indentation) && has(force),
                   trace = has(time) && has(force);
        if (curve + loop + trace != 1) {
            problems_.add(*header_, fmt::format("the columns do not fit together: {}", what_is_needed));
            return;
        }
        data_.source = name_;
        data_.kind = curve ? Measured::restitution : loop ? Measured::force_indentation : Measured::force_time;
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            const Name name = columns_[i].name;
            const bool belongs = name == x_name() || name == y_name() || name == sigma || (name == rate && loop);
            if (!belongs) {
                problems_.add(units[i].first.at, fmt::format("column '{}' has no place in {} data", known[name].name,
                                                             name_of(data_.kind)));
            }
            columns_[i].factor =
                factor(units[i].first, units[i].second, name == sigma ? known[y_name()].unit : known[name].unit);
        }
    }

    void row(const std::vector<Cell>& cells) {
        if (cells.size() != columns_.size()) {
            problems_.add(cells.front().at,
                          fmt::format("{} values, where the header has {} columns", cells.size(), columns_.size()));
            return;
        }
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const Name name = columns_[i].name;
            const auto value = plain_number(cells[i].text);
            const auto refuse = [&](std::string_view allowed) {
                problems_.add(cells[i].at,
                              fmt::format("{} is '{}'; allowed is {}", known[name].name, cells[i].text, allowed));
            };
            if (!value || !std::isfinite(*value)) {
                refuse("a finite number");
                continue;
            }
            const double si = *value * columns_[i].factor;
            if ((name == speed || name == sigma) && !(si > 0)) refuse("> 0");
            if (name == restitution && !(si >= 0 && si <= 1)) refuse("from 0 to 1");
            if (name == time && !data_.x.empty() && si < data_.x.back()) refuse("not before the row above");
            auto& into = name == x_name()   ? data_.x
                         : name == y_name() ? data_.y
                         : name == rate     ? data_.rate
                                            : data_.sigma;
            into.push_back(si);
        }
    }

    [[nodiscard]] bool has(Name name) const {
        return std::any_of(columns_.begin(), columns_.end(), [&](const Column& c) { return c.name == name; });
    }
    [[nodiscard]] Name x_name() const {
        switch (data_.kind) {
            case Measured::restitution:
                return speed;
            case Measured::force_indentation:
                return indentation;
            case Measured::force_time:
                break;
        }
        return time;
    }
    [[nodiscard]] Name y_name() const { return data_.kind == Measured::restitution ? restitution : force; }

    double factor(const Cell& cell, std::string_view unit, std::string_view si_unit) {
        if (unit.empty()) return 1;
        try {
            return to_si(fmt::format("1 {}", unit == "1" ? "" : unit), si_unit);
        } catch (const InvalidInput& error) {
            problems_.add(cell.at, fmt::format("'{}': {}", cell.text, error.what()));
            return 1;
        }
    }

    const std::string& name_;
    io::Problems problems_;
    std::optional<Position> header_;
    std::vector<Column> columns_;
    FitData data_;
};

// What is asked -------------------------------------------------------------------------------------------------------

double read_number(std::string_view text, std::string_view unit, bool plain_only) {
    if (const auto plain = plain_number(text); plain && std::isfinite(*plain)) return *plain;
    if (plain_only) {
        throw InvalidInput(
            fmt::format("expected a plain number (its unit depends on other parameters), got '{}'", text));
    }
    return to_si(text, unit);
}

}  // namespace

FitData load_fit_data(const std::filesystem::path& file) { return parse_fit_data(io::read_file(file), file.string()); }

FitData parse_fit_data(std::string_view text, const std::string& name) { return Reader(name).read(text); }

FitValue parse_fit_value(std::string_view text, std::string_view unit, bool plain_only) {
    text = trimmed(text);
    FitValue read;
    if (!text.starts_with('?')) {
        read.value = read_number(text, unit, plain_only);
        return read;
    }
    read.free = true;
    const std::string_view rest = trimmed(text.substr(1));
    if (rest.empty()) return read;
    const std::size_t dots = rest.find("..");
    if (dots == std::string_view::npos) {
        read.value = read_number(rest, unit, plain_only);
        return read;
    }
    read.low = read_number(trimmed(rest.substr(0, dots)), unit, plain_only);
    read.high = read_number(trimmed(rest.substr(dots + 2)), unit, plain_only);
    if (!(*read.low < *read.high)) {
        throw InvalidInput(fmt::format("'{}': the lower bound must come first, as in ?1e3..1e5", text));
    }
    return read;
}

FitLaw parse_fit_law(std::string_view text) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    // What parse_normal_law is to check, with a number that every parameter allows in place of those to be fitted.
    std::string given(text.substr(0, colon));
    std::vector<std::pair<std::string, std::string_view>> free;
    char separator = ':';
    for (std::size_t begin = colon; begin < text.size();) {
        const std::size_t comma = std::min(text.find(',', begin + 1), text.size());
        const std::string_view setting = text.substr(begin + 1, comma - begin - 1);
        const std::size_t equals = setting.find('=');
        const std::string_view value = equals == std::string_view::npos ? "" : trimmed(setting.substr(equals + 1));
        given += std::exchange(separator, ',');
        if (value.starts_with('?')) {
            free.emplace_back(trimmed(setting.substr(0, equals)), value);
            given += fmt::format("{}=1", free.back().first);
        } else {
            given += setting;
        }
        begin = comma;
    }
    FitLaw law{parse_normal_law(given), {}};
    if (free.empty()) {
        throw InvalidInput(fmt::format(
            "normal law '{}': nothing is to be fitted; mark what is with a question mark, as in stiffness=?", text));
    }
    std::visit(
        [&]<class Law>(const Law&) {
            for (const auto& [key, value] : free) {
                for (const auto& parameter : Law::parameters()) {
                    if (parameter.key != key) continue;
                    try {
                        law.free.push_back({key, parse_fit_value(value, parameter.unit, parameter.unit_depends)});
                    } catch (const InvalidInput& error) {
                        throw InvalidInput(
                            fmt::format("normal law '{}': {}: {}", Law::description.name, key, error.what()));
                    }
                    const FitValue& read = law.free.back().value;
                    for (const auto& number : {read.value, read.low, read.high}) {
                        if (number && !(*number > 0 && parameter.allows(*number))) {
                            throw InvalidInput(fmt::format(
                                "normal law '{}': {}={}: a parameter is fitted in its "
                                "logarithm; allowed is > 0{}",
                                Law::description.name, key, value, parameter.at_most_one ? " and <= 1" : ""));
                        }
                    }
                }
            }
        },
        law.law);
    return law;
}

}  // namespace footfall
