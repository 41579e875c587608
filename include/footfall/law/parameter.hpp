// How a law describes itself: the one source of scenario keys, help, schema and range checks.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "footfall/math/error.hpp"

namespace footfall {

/// One parameter of a law, over the law's own scalar. A law's parameters are given by setting these members.
template <class Law>
struct Parameter {
    std::string_view key;                           ///< name in a scenario and in the API, "stiffness"
    std::string_view symbol;                        ///< the paper's symbol, "K_n"
    std::string_view unit;                          ///< SI unit, "N/m^1.5"; "1" where it has none
    typename Law::value_type Law::*member;          ///< where the value lives
    std::string_view description;                   ///< one phrase: what it is
    std::string_view when_zero;                     ///< what the law becomes at zero; empty where zero is refused
    std::optional<double> fallback = std::nullopt;  ///< value where it is left out; none: it is required
    /// The unit depends on the values of other parameters, so only a plain SI number can be given.
    bool unit_depends = false;
    /// Values above 1 are refused, as of a coefficient of restitution.
    bool at_most_one = false;

    /// Zero is a meaningful value.
    [[nodiscard]] constexpr bool may_be_zero() const noexcept { return !when_zero.empty(); }
    /// The allowed range in words: "> 0", ">= 0", "> 0 and <= 1", "from 0 to 1". Every parameter is finite.
    [[nodiscard]] constexpr std::string_view range() const noexcept {
        if (at_most_one) return may_be_zero() ? "from 0 to 1" : "> 0 and <= 1";
        return may_be_zero() ? ">= 0" : "> 0";
    }
    [[nodiscard]] bool allows(double value) const noexcept {
        return std::isfinite(value) && (may_be_zero() ? value >= 0 : value > 0) && (!at_most_one || value <= 1);
    }
};

/// What a user must know to choose a law.
struct LawDescription {
    std::string_view name;     ///< as written in a scenario, "azad-featherstone"
    std::string_view formula;  ///< in the source's symbols
    std::string_view source;   ///< author, year, equation numbers
    std::string_view limits;   ///< what it cannot represent, and where it departs from its source
};

}  // namespace footfall
