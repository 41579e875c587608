// Quantities written with their unit, "1.65 cm", in SI units.
//
// A unit is a product of symbols: "N s/m^1.5", "kg m^2", "N/(m s)", "m/s^2". A symbol may carry an SI prefix. Most
// may be written out: "5 millimetres", "2 feet/second".
// Powers may be fractions ("m^1.5", "m^(3/2)"), which is why this is not UDUNITS: it knows integer powers only,
// and the stiffness of the paper's law is in N/m^1.5.
// An angle is a dimension of its own here, so that "12 Hz" is not taken for 12 rad/s.
#pragma once

#include <string>
#include <string_view>

#include "footfall/math/error.hpp"

namespace footfall {

/// The powers of the base units in a unit.
struct Dimension {
    double mass = 0;    ///< of kg
    double length = 0;  ///< of m
    double time = 0;    ///< of s
    double angle = 0;   ///< of rad

    /// Equal up to the rounding of fractional powers.
    [[nodiscard]] bool operator==(const Dimension& other) const noexcept;
};

/// A unit: `factor` * 10^`exponent` of the SI unit of its dimension. The power of ten is kept apart, and the factor is
/// whole where it can be, so that a decimal number converts with one rounding: "1.65 cm" is exactly 0.0165.
struct Unit {
    Dimension dimension;
    double factor = 1;
    double exponent = 0;
};

/// A value in SI units (rad for angles) and what it measures.
struct Quantity {
    double value = 0;
    Dimension dimension;
};

/// Reads a unit such as "N s/m^1.5"; "1" and "" are the unit of a pure number. Throws InvalidInput where a symbol
/// is unknown, with the nearest one, or the text cannot be read in one way only ("N/m s").
[[nodiscard]] Unit parse_unit(std::string_view text);

/// Reads a number and its unit, "1.65 cm"; a number alone is a pure number. Throws InvalidInput, as parse_unit does
/// and where the number cannot be read or is not finite.
[[nodiscard]] Quantity parse_quantity(std::string_view text);

/// The value of `quantity` in SI units, given that it is to be in a multiple of the SI unit `si_unit`. Throws
/// InvalidInput where it has another dimension, saying which was expected; the unit that is suggested for an unknown
/// one has the expected dimension.
[[nodiscard]] double to_si(std::string_view quantity, std::string_view si_unit);

/// As to_si, where a number without a unit is in SI units: what a command line has.
[[nodiscard]] double plain_or_si(std::string_view text, std::string_view si_unit);

/// A dimension in words, with its SI unit: "a length (m)", "a mass (kg)".
[[nodiscard]] std::string describe(const Dimension& dimension);

/// Every symbol that parse_unit knows, without prefixes, in a list for a person.
[[nodiscard]] std::string known_units();

}  // namespace footfall
