#include "footfall/io/units.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>
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
        {"0.1 in", "m", 0.00254},
        {"-1.1 ft", "m", -0.33528},
        {"3.3 yd", "m", 3.01752},
        {"26.2 mi", "m", 42164.8128},
        {"0.3 lb", "kg", 0.136077711},
        {"5 oz", "kg", 0.141747615625},
        {"1.1 min", "s", 66},
        {"0.7 h", "s", 2520},
        {"0.1 lbf", "N", 0.44482216152605},
        {"3 kgf", "N", 29.41995},
        {"0.9 gn", "m/s^2", 8.825985},
        {"30 mph", "m/s", 13.4112},
        {"7 micron", "m", 7e-6},
        {"7 microns", "m", 7e-6},
        {"300 grams", "kg", 0.3},
        {"5 millimetres", "m", 0.005},
        {"5 centimeters", "m", 0.05},
        {"0.3 milliseconds", "s", 3e-4},
        {"0.3 msec", "s", 3e-4},
        {"2 kilonewtons", "N", 2000},
        {"2 meters/second^2", "m/s^2", 2},
        {"0.1 kilogram", "kg", 0.1},
        {"1 inch", "m", 0.0254},
        {"2 feet", "m", 0.6096},
        {"2 pounds", "kg", 0.90718474},
        {"20 percent", "1", 0.2},
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
        {"1 psi", "Pa", 6894.757293168361},  // NIST SP 811, B.8: 6.894 757 E+03
        {"10 ksi", "Pa", 68947572.93168361},
        {"36 knots", "m/s", 18.52},
        {"90 degrees", "rad", 1.5707963267948966},
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

TEST(Units, SuggestsOnlyWhatHasTheExpectedDimension) {
    // A prefix before every unit would make of these "Grad", "min" or "kg".
    EXPECT_EQ(error_of("5 gram", "m"), "expected a length (m), got a mass (kg): '5 gram'");
    EXPECT_NE(error_of("5 gramm", "kg").find("'gramm': did you mean 'gram'?"), std::string::npos);
    EXPECT_NE(error_of("5 micrn", "m").find("'micrn': did you mean 'micron'?"), std::string::npos);
    EXPECT_NE(error_of("5 mm/sk", "m/s").find("'sk': did you mean 's'?"), std::string::npos);
    for (const auto& [quantity, unit] : std::vector<std::pair<std::string, std::string>>{
             {"5 gramm", "m"}, {"5 bra", "kg"}, {"5 mim", "Pa"}, {"5 kgg", "s"}, {"5 Ns", "N"}}) {
        const std::string error = error_of(quantity, unit);
        const std::size_t found = error.find("did you mean '");
        if (found == std::string::npos) continue;
        const std::string meant = error.substr(found + 14, error.find('\'', found + 14) - found - 14);
        EXPECT_EQ(parse_unit(meant).dimension, parse_unit(unit).dimension) << error;
    }
}

TEST(Units, ListsTheUnitsOfTheExpectedDimension) {
    EXPECT_NE(error_of("5 kn", "m/s").find("(for a velocity (m/s): mph, knot)"), std::string::npos);
    EXPECT_NE(error_of("5 xyz", "N/m^1.5").find("(units: m, g, s, "), std::string::npos);
}

TEST(Units, WordsStandAlone) {
    for (const char* bad : {"1 kmetre", "1 millim", "1 kilo", "1 kiloinch", "1 kilofeet", "1 metress", "1 mpsi"})
        EXPECT_THROW((void)parse_quantity(bad), InvalidInput) << bad;
}

TEST(Units, TellsTheGramFromStandardGravity) {
    EXPECT_EQ(error_of("2 g", "m/s^2"),
              "expected an acceleration (m/s^2), got a mass (kg): '2 g'; 'g' is the gram, standard gravity is 'gn'");
}

TEST(Units, ANumberWithoutAUnitIsInSiUnitsOnACommandLine) {
    EXPECT_EQ(plain_or_si(" 0.25 ", "m"), 0.25);
    EXPECT_EQ(plain_or_si("25cm", "m"), 0.25);
    EXPECT_THROW((void)plain_or_si("20 %", "m"), InvalidInput);
    EXPECT_THROW((void)plain_or_si("", "m"), InvalidInput);
    EXPECT_THROW((void)plain_or_si("nan", "1"), InvalidInput);
}

TEST(Units, TheDocumentedListIsTheWholeList) {
    std::ifstream file(FOOTFALL_SOURCE_DIR "/docs/scenario.md");
    const std::string page{std::istreambuf_iterator<char>(file), {}};
    const std::size_t begin = page.find("- Symbols: ");
    ASSERT_NE(begin, std::string::npos);
    std::string listed = page.substr(begin, page.find("\n- ", begin) - begin);
    std::replace(listed.begin(), listed.end(), '\n', ' ');
    std::istringstream symbols(known_units());
    for (std::string symbol; std::getline(symbols >> std::ws, symbol, ',');)
        EXPECT_NE(listed.find("`" + symbol + "`"), std::string::npos) << symbol;
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
