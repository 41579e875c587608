#include "footfall/io/units.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace footfall {
namespace {

std::string error_of(const std::string& quantity, const std::string& unit) {
    try {
        const double value = to_si(quantity, unit);
        return "accepted as " + std::to_string(value);
    } catch (const InvalidInput& error) {
        return error.what();
    }
}

struct Conversion {
    const char* quantity;
    const char* unit;
    double value;
};

TEST(Units, ConvertsDecimalMultiplesExactly) {
    // Each literal is the double nearest to the value, which is what a conversion without a second rounding gives.
    const std::vector<Conversion> table{
        {"154 g", "kg", 0.154},
        {"1.65 cm", "m", 0.0165},
        {"16.6 mm", "m", 0.0166},
        {"0.1 ms", "s", 1e-4},
        {"5 us", "s", 5e-6},
        {"5 \u00b5s", "s", 5e-6},
        {"5 \u03bcs", "s", 5e-6},
        {"10 kN", "N", 1e4},
        {"210 GPa", "Pa", 210e9},
        {"8.5e6 N/m^1.5", "N/m^1.5", 8.5e6},
        {"8.5 MN/m^1.5", "N/m^1.5", 8.5e6},
        {"3.1e3 N s/m^1.5", "N s/m^1.5", 3.1e3},
        {"9.81 m/s^2", "m/s^2", 9.81},
        {"981 cm/s\u00b2", "m/s^2", 9.81},
        {"9.81 N/kg", "m/s^2", 9.81},
        {"0.3 N", "kg m/s^2", 0.3},
        {"1570 kg mm^2", "kg m^2", 1.57e-3},
        {"2 t", "kg", 2000},
        {"1.2 bar", "Pa", 1.2e5},
        {"5 in", "m", 0.127},
        {"20 %", "1", 0.2},
        {"0.2", "1", 0.2},
        {"-3 km", "m", -3000},
        {"+.5 m", "m", 0.5},
        {"7.m", "m", 7},
        {"1E3mm", "m", 1},
        {"  2   m ", "m", 2},
        {"4 hm", "m", 400},
        {"4 dam", "m", 40},
    };
    for (const Conversion& c : table) EXPECT_EQ(to_si(c.quantity, c.unit), c.value) << c.quantity;
}

TEST(Units, ConvertsOtherMultiples) {
    const std::vector<Conversion> table{
        {"30 deg", "rad", 0.52359877559829887},
        {"90\u00b0", "rad", 1.5707963267948966},
        {"12 rpm", "rad/s", 1.2566370614359172},
        {"12 rev/min", "rad/s", 1.2566370614359172},
        {"1 rev/s", "rad/s", 6.2831853071795865},
        {"36 km/h", "m/s", 10},
        {"90 min", "s", 5400},
        {"3 ft", "m", 0.9144},
        {"1 lb", "kg", 0.45359237},
        {"1 lbf", "N", 4.4482216152605},
        {"1 N/mm^1.5", "N/m^1.5", 31622.776601683793},  // 10^4.5
        {"1 N/cm^(3/2)", "N/m^1.5", 1000},              // 10^3
        {"1 m^(1/2) m", "m^1.5", 1},
        {"4 /s", "Hz", 4},
        {"4 1/s", "Hz", 4},
        {"4 s^-1", "Hz", 4},
        {"4 s**-1", "Hz", 4},
        {"2 kN*s/(m s)", "N/m", 2000},
        {"2 N\u00b7s/m", "N s/m", 2},
        {"2 m/s/s", "m/s^2", 2},
        {"2 (kg m)/s^2", "N", 2},
    };
    for (const Conversion& c : table) EXPECT_DOUBLE_EQ(to_si(c.quantity, c.unit), c.value) << c.quantity;
}

TEST(Units, RefusesAWrongDimensionAndSaysWhatWasExpected) {
    EXPECT_EQ(error_of("1.65 kg", "m"), "expected a length (m), got a mass (kg): '1.65 kg'");
    EXPECT_EQ(error_of("12 Hz", "rad/s"), "expected an angular velocity (rad/s), got a frequency (Hz): '12 Hz'");
    EXPECT_EQ(error_of("1 N/m", "N/m^1.5"), "expected a nonlinear stiffness (N/m^1.5), got a stiffness (N/m): '1 N/m'");
    EXPECT_EQ(error_of("1 m^2 kg", "s"), "expected a time (s), got a moment of inertia (kg m^2): '1 m^2 kg'");
    EXPECT_EQ(error_of("1 kg^2 s^0.5", "s"), "expected a time (s), got a quantity in kg^2 s^0.5: '1 kg^2 s^0.5'");
    EXPECT_EQ(error_of("1 deg", "1"), "expected a pure number, got an angle (rad): '1 deg'");
}

TEST(Units, RefusesANumberInQuotesWithoutItsUnit) {
    EXPECT_EQ(error_of("5", "m"), "expected a length (m), got '5' without a unit (a number without quotes is in m)");
}

TEST(Units, SuggestsTheNearestUnit) {
    EXPECT_NE(error_of("3 Kg", "kg").find("unknown unit 'Kg': did you mean 'kg'?"), std::string::npos);
    EXPECT_NE(error_of("3 dg/s", "rad").find("expected an angle (rad), got"), std::string::npos);
    EXPECT_NE(error_of("3 degs", "rad").find("did you mean 'deg'?"), std::string::npos);
}

TEST(Units, RefusesWhatCanBeReadInTwoWays) {
    EXPECT_NE(error_of("1 N/m s", "N s/m").find("can be read in two ways: use parentheses"), std::string::npos);
    EXPECT_NE(error_of("1 N/m*s", "N s/m").find("can be read in two ways: use parentheses"), std::string::npos);
}

TEST(Units, RefusesWhatCannotBeRead) {
    for (const char* bad :
         {"",      " ",    "m",     "inf m",  "nan m",     "-inf m",   "1e999 m", "1e-999 m", "1.2.3 m", "0x10 m",
          "1 m)",  "1 (m", "1 m^",  "1 m^x",  "1 m^(1/0)", "1 m^(1/2", "1 m^1e3", "1 m^inf",  "1 m/",    "1 m*",
          "1 m**", "1 ^2", "1 m,s", "1 m m_", "--1 m",     "1,5 m",    "1 mkg",   "1 kkg",    "1 mdeg",  "1 m\n"}) {
        EXPECT_THROW((void)to_si(bad, "m"), InvalidInput) << bad;
    }
    EXPECT_THROW((void)parse_quantity("1 " + std::string(100000, '(') + "m"), InvalidInput);
}

RC_GTEST_PROP(Units, MillimetresAreAThousandthToTheLastBit, (int thousandths)) {
    // n mm is n/1000 m: both sides are the double nearest to the same rational number.
    RC_ASSERT(to_si(std::to_string(thousandths) + " mm", "m") == thousandths / 1000.0);
}

RC_GTEST_PROP(Units, AnyTextIsReadOrRefused, ()) {
    const std::string letters = "0123456789.eE+-^*/() mgsNPakHzrd%";
    const auto text = *rc::gen::container<std::string>(rc::gen::elementOf(letters));
    try {
        RC_ASSERT(std::isfinite(parse_quantity("1" + text).value));
    } catch (const InvalidInput& error) {
        RC_ASSERT(!std::string(error.what()).empty());
    }
}

}  // namespace
}  // namespace footfall
