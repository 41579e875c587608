// Ranges in words, and keys for tables.
#include "io/keys.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace footfall::io {
namespace {

/// A bound with its unit: "0", "1e-14", "1.5708 rad".
std::string bound(double value, const std::string& unit) {
    if (value == 0 || unit == "1") return fmt::format("{:.6g}", value);
    return fmt::format("{:.6g} {}", value, unit);
}

}  // namespace

bool Range::contains(double value) const noexcept {
    return std::isfinite(value) && (low_open ? value > low : value >= low) &&
           (high_open ? value < high : value <= high);
}

bool Range::bounded() const noexcept { return std::isfinite(low) || std::isfinite(high); }

std::string Range::words(const std::string& unit) const {
    if (!bounded()) return "";
    std::string above = fmt::format("{} {}", low_open ? ">" : ">=", bound(low, unit));
    std::string below = fmt::format("{} {}", high_open ? "<" : "<=", bound(high, unit));
    if (!std::isfinite(high)) return above;
    if (!std::isfinite(low)) return below;
    if (!low_open && !high_open) return fmt::format("from {} to {}", bound(low, unit), bound(high, unit));
    return fmt::format("{} and {}", above, below);
}

Key table_key(std::string name, Table table, bool required) {
    Key key{.name = std::move(name), .form = Form::table, .required = required, .description = table.description};
    key.tables.push_back(std::move(table));
    return key;
}

}  // namespace footfall::io
