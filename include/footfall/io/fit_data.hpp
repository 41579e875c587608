// Measurements from a table, and what of a law is to be fitted, from one line of text.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "footfall/io/scenario.hpp"
#include "footfall/io/table_input.hpp"
#include "footfall/study/fit.hpp"

namespace footfall {

/// How measurements are to be read.
struct FitInput : TableInput {
    std::optional<Measured> kind;  ///< where the columns fit more than one
    double gravity = 9.81;         ///< turns heights and times of flight into speeds [m/s^2], > 0
};

/// Reads measurements from a table (docs/tables.md): a header line that names the columns, each with its unit (in SI
/// units where it has none). The columns, in any order and among others, are one of
///
///   speed [m/s], restitution              speed > 0, restitution from 0 to 1
///   speed or drop_height [m], and speed_out or rebound_height
///   bounce_time [s] or flight_time [s]    of one ball's successive bounces
///   indentation [m], force [N]            and optionally rate [m/s], positive while loading
///   time [s], force [N]                   times in order
///
/// and optionally sigma, the standard deviation of restitution or force, > 0. Throws ScenarioError with every problem
/// at its line and column (BadRows where only rows are bad), InvalidInput where `input` cannot be used, or
/// std::system_error where the file cannot be read.
[[nodiscard]] FitData load_fit_data(const std::filesystem::path& file, const FitInput& input = {});

/// The same from the text of a file; `name` stands for the file in messages.
[[nodiscard]] FitData parse_fit_data(std::string_view text, const std::string& name = "data",
                                     const FitInput& input = {});

/// Reads a number in `unit` ("154 g"; a plain one is in SI units), or one that is to be fitted: "?", "?START",
/// "?LOW..HIGH". Throws InvalidInput. With `plain_only`, numbers have no unit.
[[nodiscard]] FitValue parse_fit_value(std::string_view text, std::string_view unit, bool plain_only = false);

/// Reads a law as parse_normal_law does, where values may be such as parse_fit_value reads:
/// "azad-featherstone:stiffness=?,damping=?1e3..1e4". Throws InvalidInput.
[[nodiscard]] FitLaw parse_fit_law(std::string_view text);

}  // namespace footfall
