// Tables as laboratories write them: each is read to the same numbers, or refused with the reason and the place.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "footfall/io/fit_data.hpp"
#include "io/temporary_folder.hpp"

namespace footfall::test {
namespace {

bool contains(std::string_view text, std::string_view words) { return text.find(words) != std::string_view::npos; }

std::string error_of(std::string_view text, const FitInput& input = {}) {
    try {
        (void)parse_fit_data(text, "lab.csv", input);
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "";
}

void expect_refused(std::string_view text, std::string_view words, const FitInput& input = {}) {
    const std::string message = error_of(text, input);
    EXPECT_TRUE(contains(message, words)) << "'" << message << "' for\n" << text;
}

const std::vector<double> speeds{0.1, 1.25}, restitutions{0.779, 0.66};

void expect_curve(std::string_view text, const FitInput& input = {}) {
    SCOPED_TRACE(text);
    const FitData data = parse_fit_data(text, "lab.csv", input);
    EXPECT_EQ(data.kind, Measured::restitution);
    EXPECT_EQ(data.x, speeds);
    EXPECT_EQ(data.y, restitutions);
    EXPECT_TRUE(data.remarks.warnings.empty());
}

TEST(TableReader, FindsTheSeparator) {
    expect_curve("speed [m/s],restitution\n0.1,0.779\n1.25,0.66\n");
    expect_curve("speed [m/s];restitution\n0.1;0.779\n1.25;0.66\n");
    expect_curve("speed [m/s]\trestitution\n0.1\t0.779\n1.25\t0.66\n");
    expect_curve("speed [m/s] restitution\n0.1 0.779\n1.25   0.66\n");
    expect_curve("  speed [m/s]   restitution\n  0.1       0.779\n  1.25      0.66\n");
    expect_curve("impact velocity [m/s]    coefficient of restitution\n0.1    0.779\n1.25   0.66\n");
    expect_curve("sep=;\nspeed;restitution\n0.1;0.779\n1.25;0.66\n");
    // Spreadsheets end lines with separators.
    expect_curve("speed,restitution,,\n0.1,0.779,,\n1.25,0.66,,\n");
    expect_curve("speed;restitution\n0.1;0.779;\n1.25;0.66;\n;\n");
    expect_curve("speed\t\trestitution\n0.1\t0.779\n1.25\t0.66\n");
}

TEST(TableReader, TakesDecimalCommas) {
    expect_curve("speed [m/s];restitution\n0,1;0,779\n1,25;0,66\n");
    expect_curve("speed [m/s]\trestitution\n0,1\t0,779\n1,25\t0,66\n");
    expect_curve("speed [m/s],restitution\n\"0,1\",\"0,779\"\n\"1,25\",\"0,66\"\n");
    expect_curve("speed [mm/s];restitution [%]\n100;77,9\n1250;66\n");
}

TEST(TableReader, RefusesNumbersThatCanBeReadInTwoWays) {
    expect_refused("speed;restitution\n1.234,5;0.5\n",
                   "lab.csv:2:1: speed is '1.234,5'; allowed is a finite number, "
                   "without separators of thousands");
    expect_refused("speed;restitution\n1,234,567;0.5\n", "without separators of thousands");
    expect_refused("speed;restitution\n1.5;0.5\n0,3;0.5\n",
                   "lab.csv:3:1: speed is '0,3'; allowed is a number with a decimal point, as in line 2");
    expect_refused("speed,restitution\n0,1,0,779\n", "decimal commas need semicolons");
    const FitData grouped = parse_fit_data("indentation [um];force [N]\n1,200;2,400\n", "lab.csv");
    ASSERT_EQ(grouped.remarks.warnings.size(), 2U);
    EXPECT_TRUE(contains(grouped.remarks.warnings[0], "every comma in column 'indentation [um]' has three digits"));
    const FitData points = parse_fit_data("force [N];depth [um]\n980;1\n1.234;2\n12.345;3\n", "lab.csv");
    ASSERT_EQ(points.remarks.warnings.size(), 1U);
    EXPECT_TRUE(contains(points.remarks.warnings[0], "every point in column 'force [N]'"));
    EXPECT_TRUE(parse_fit_data("force [N];depth [um]\n9;1\n1.234;2\n", "lab.csv").remarks.warnings.empty());
    // One stray sign does not turn the others into errors.
    const std::string stray = error_of("speed;restitution\n1,5;0,8\n2.5;0,7\n3,5;0,6\n");
    EXPECT_EQ(stray, "lab.csv:3:1: speed is '2.5'; allowed is a number with a decimal comma, as in line 2");
    expect_refused("speed;restitution\n1 234,5;0,8\n", "without separators of thousands");
}

TEST(TableReader, PassesOverWhatIsAroundTheTable) {
    expect_curve("\xEF\xBB\xBFspeed [m/s],restitution\r\n0.1,0.779\r\n1.25,0.66\r\n");
    expect_curve("speed [m/s],restitution\r0.1,0.779\r1.25,0.66");
    expect_curve("% made by a rig\n# on Monday\n\nspeed,restitution\n% between\n0.1,0.779\n\n1.25,0.66\n");
    expect_curve("\"speed [m/s]\", \"restitution\"\n\"0.1\",0.779\n1.25,\" 0.66 \"\n");
    expect_curve("speed,remark,restitution\n0.1,\"a \"\"good\"\", long\nremark\",0.779\n1.25,none,0.66\n");
}

TEST(TableReader, ReadsTheEncodingOfOlderSpreadsheets) {
    // "time [µs]" and "remark with ü" in Windows-1252.
    const FitData trace = parse_fit_data("time [\xB5s],force [N],Gr\xFC\xDF\x65\n29,0.5,\x80\n", "lab.csv");
    EXPECT_EQ(trace.x, (std::vector<double>{29e-6}));
    EXPECT_EQ(trace.remarks.notes,
              (std::vector<std::string>{"The text is no UTF-8; it was read as Windows-1252 (Latin-1).",
                                        "Columns that are not used: Gr\u00fc\u00dfe."}));
}

TEST(TableReader, TakesUnitsInEveryPlace) {
    expect_curve("speed [mm/s],restitution [%]\n100,77.9\n1250,66\n");
    expect_curve("speed (mm/s),restitution (-)\n100,0.779\n1250,0.66\n");
    expect_curve("speed / (mm/s),restitution\n100,0.779\n1250,0.66\n");
    expect_curve("v in mm/s,e/%\n100,77.9\n1250,66\n");
    expect_curve("speed_mm_s,restitution\n100,0.779\n1250,0.66\n");
    expect_curve("speed_mm_per_s,restitution\n100,0.779\n1250,0.66\n");
    expect_curve("speed,restitution\nmm/s,%\n100,77.9\n1250,66\n");
    expect_curve("speed,restitution,remark\n[mm/s],[-],\n100,0.779,good\n1250,0.66,bad\n");
    expect_curve("speed,restitution\nmm/s,1\n100,0.779\n1250,0.66\n");
    const FitData trace = parse_fit_data("time_us,force_kN\n29,0.5\n30,1\n", "lab.csv");
    EXPECT_EQ(trace.kind, Measured::force_time);
    EXPECT_EQ(trace.x, (std::vector<double>{29e-6, 30e-6}));  // to the last bit
    EXPECT_EQ(trace.y, (std::vector<double>{500, 1000}));
}

TEST(TableReader, RefusesUnitsThatDoNotFit) {
    expect_refused("speed [m],restitution\n1,0.5\n",
                   "lab.csv:1:1: 'speed [m]': expected a velocity (m/s), got a length");
    expect_refused("speed,restitution\nkg,-\n1,0.5\n", "lab.csv:1:1: 'speed' [kg]: expected a velocity");
    expect_refused("speed [furlong],restitution\n1,0.5\n", "unknown unit 'furlong'");
    expect_refused("speed [mm/s],restitution\nm/s,-\n1,0.5\n", "the row below says m/s; give the unit once");
    expect_refused("speed [m/s,restitution\n1,0.5\n", "a unit stands in brackets");
    // A name that ends like a unit of another dimension is another name.
    expect_refused("speed_kg,restitution\n1,0.5\n", "the columns do not fit together");
}

TEST(TableReader, KnowsTheNamesThatLaboratoriesUse) {
    for (const char* speed : {"v", "V", "v_in", "Impact Velocity", "approach-speed", "VELOCITY", "v0", "Speed"})
        for (const char* e : {"e", "COR", "e_n", "Coefficient of restitution", "Restitution"})
            expect_curve(std::string(speed) + "," + e + "\n0.1,0.779\n1.25,0.66\n");
    for (const char* depth : {"z", "depth", "Displacement", "penetration", "delta", "normal_disp"}) {
        for (const char* force : {"F", "load", "Force", "normal force", "F_n"}) {
            const FitData loop = parse_fit_data(std::string(depth) + " [um]," + force + " [kN]\n29,0.5\n", "lab.csv");
            EXPECT_EQ(loop.kind, Measured::force_indentation);
            EXPECT_EQ(loop.x[0], 29e-6);
            EXPECT_EQ(loop.y[0], 500);
        }
    }
    // Case tells single letters apart: T is no time.
    expect_refused("T,F\n0,1\n", "the columns do not fit together");
}

TEST(TableReader, SaysWhatItReadAndWhatItDidNot) {
    const FitData data = parse_fit_data("trial,v_in [mm/s],COR,remark\n1,100,0.779,ok\n2,1250,0.66,ok\n", "lab.csv");
    EXPECT_EQ(data.x, speeds);
    EXPECT_EQ(data.remarks.notes,
              (std::vector<std::string>{"Read: speed in mm/s from 'v_in [mm/s]', restitution from 'COR'.",
                                        "Columns that are not used: trial, remark."}));
}

TEST(TableReader, TakesTheUsersWordForAColumn) {
    FitInput input;
    input.columns = {{"speed", "U [mm/s]"}, {"restitution", "ratio"}};
    expect_curve("U,ratio,speed\n100,0.779,7\n1250,0.66,8\n", input);
    input.columns = {{"speed", "-down"}};
    expect_curve("down,e\n-0.1,0.779\n-1.25,0.66\n", input);
    // It decides between two names of the same.
    expect_refused("v,speed,e\n0.1,1,0.779\n1.25,1,0.66\n",
                   "lab.csv:1:3: 'v' and 'speed' are both the speed: choose one");
    input.columns = {{"speed", "v"}};
    expect_curve("v,speed,e\n0.1,1,0.779\n1.25,1,0.66\n", input);
    input.columns = {{"speed", "U [m/s]"}};
    expect_refused("U [mm/s],e\n100,0.7\n", "'U [mm/s]' has the unit mm/s, but U [m/s] asks for m/s", input);
    input.columns = {{"speed", "W"}};
    expect_refused("U,e\n100,0.7\n", "speed: no column 'W' (columns here: U, e)", input);
    input.columns = {{"sped", "U"}};
    expect_refused("U,e\n100,0.7\n", "unknown quantity 'sped': did you mean 'speed'?", input);
}

TEST(TableReader, RefusesTheSameNameTwice) {
    expect_refused("speed,speed,restitution\n1,1,0.5\n", "lab.csv:1:7: column 'speed' is there twice");
    expect_refused("speed [m/s],speed [mm/s],restitution\n1,1,0.5\n", "column 'speed' is there twice");
}

TEST(TableReader, RefusesWhatIsNoTable) {
    expect_refused("0.1,0.779\n0.2,0.75\n", "lab.csv:1:1: there is no header line that names the columns: write one");
    expect_refused("0,1;0,779\n0,2;0,75\n", "there is no header line");
    expect_refused("# speed,restitution\n0.1,0.779\n", "line 1 looks like one: remove the '#' before it");
    expect_refused("speed,restitution\n0.1;0.779\n", "lab.csv:2:1: cannot tell what separates the columns: semicolons");
    expect_refused("", "there is no header line");
    expect_refused("speed,restitution\n", "there are no rows of data");
    expect_refused(std::string("\xFF\xFEs\0", 4), "UTF-16");
    expect_refused(std::string("speed,restitution\n1,\0\n", 22), "lab.csv:2:1: this is no table of text");
    expect_refused("speed,restitution\n\"1,0.5\n2,0.5\n", "lab.csv:2:1: a quote (\") opens here and none closes it");
}

TEST(TableReader, LeavesOutBadRowsWhereItIsAskedToAndCountsThem) {
    const std::string table = "speed,restitution\n0.1,0.779\n0.5,NaN\n0.7,\n1,n/a\n2,1.5\n-3,0.5\n4\n1.25,0.66\n";
    EXPECT_THROW((void)parse_fit_data(table, "lab.csv"), BadRows);
    for (const char* place : {":3:5:", ":4:5:", ":5:3:", ":6:3:", ":7:1:", ":8:1:"}) expect_refused(table, place);
    FitInput input;
    input.skip_bad_rows = true;
    expect_curve(table, input);
    EXPECT_EQ(parse_fit_data(table, "lab.csv", input).remarks.notes.back(),
              "6 of 8 rows could not be used and were left out: lines 3, 4, 5, 6, 7, 8.");
    expect_refused("speed,restitution\n0.1,x\n0.5,y\n", "lab.csv:2:5: restitution is 'x'", input);
    // What is wrong with the header is no bad row.
    try {
        (void)parse_fit_data("speed [kg],restitution\n1,1\n", "lab.csv");
        ADD_FAILURE();
    } catch (const ScenarioError& error) {
        EXPECT_EQ(dynamic_cast<const BadRows*>(&error), nullptr);
    }
}

TEST(TableReader, CellsOfOtherColumnsMayHoldAnything) {
    expect_curve("speed,trial,restitution\n0.1,NaN,0.779\n1.25,,0.66\n");
}

TEST(TableReader, LosesNoRowInSilence) {
    // What a spreadsheet could not compute is a bad cell, not a comment.
    for (const char* word : {"#DIV/0!", "#N/A", "#NV", "#VALUE!", "#WERT!"}) {
        const std::string table = std::string("v;e\n1;0,8\n") + word + ";0,8\n3;0,7\n";
        expect_refused(table, "lab.csv:3:1: speed is '#");
    }
    const std::string bounces = "t_bounce;n\n0,1;1\n#NV;2\n1,5;3\n1,9;4\n";
    FitInput skip;
    skip.skip_bad_rows = true;
    expect_refused(bounces, "two flights would be one", skip);
    expect_refused("bounce,t_bounce\n1,0.1\n,\n3,1.5\n4,1.9\n", "lab.csv:3:2: bounce_time is ''");
    // Rows of separators below the last one are nothing.
    expect_curve("v,e\n0.1,0.779\n1.25,0.66\n,\n,\n");
    // A row that somebody commented out is told.
    EXPECT_EQ(parse_fit_data("v,e\n0.1,0.779\n#0.5,0.9\n1.25,0.66\n", "lab.csv").remarks.notes.back(),
              "Passed over as comments, though they look like rows: line 3.");
}

TEST(TableReader, NeverLeavesOutUnits) {
    FitInput skip;
    skip.skip_bad_rows = true;
    expect_curve("speed,restitution\nmm/s,none\n100,0.779\n1250,0.66\n", skip);
    expect_curve("speed,restitution\n# mm/s,-\n100,0.779\n1250,0.66\n");
    expect_refused("speed,e\nrun1,run1\nmm/s,-\n100,0.8\n", "units stand in the header", skip);
    expect_refused("v,e\n1,0.8\nv [mm/s],e\n300,0.6\n", "units stand in the header", skip);
}

TEST(TableReader, ReadsAUnitInTheNameOfAColumnThatIsChosen) {
    for (const char* name : {"U / mm/s", "U in mm/s", "U mm/s", "U_mm_s", "U_mm_s_raw", "U [mm/s]", "U (mm/s)"}) {
        FitInput input;
        input.columns = {{"speed", name}};
        expect_curve(std::string(name) + ";restitution\n100;0.779\n1250;0.66\n", input);
    }
    FitInput input;
    input.columns = {{"force", "Force (filtered) [kN]"}};
    EXPECT_EQ(parse_fit_data("time [ms],Force (filtered)\n1,2\n", "lab.csv", input).y[0], 2000);
    input.columns = {{"speed", "x"}, {"restitution", "x"}};
    expect_refused("x,y\n1,1\n", "'x' is chosen for two quantities", input);
}

TEST(TableReader, RefusesUnitsThatContradictEachOther) {
    expect_refused("time_us [ms],force\n1,1\n", "'time_us [ms]': is it in us or in ms?");
    expect_refused("time_us,force\nms,N\n1,1\n", "'time_us': is it in us or in ms?");
    FitInput input;
    input.columns = {{"speed", "U_mm_s [m/s]"}};
    expect_refused("U_mm_s,e\n1,0.5\n", "has the unit mm/s, but U_mm_s [m/s] asks for m/s", input);
}

TEST(TableReader, RefusesAChoiceBetweenColumnsOfOneName) {
    FitInput input;
    input.columns = {{"speed", "x"}};
    expect_refused("e,x,x\n0.5,1,2\n", "there are 2 columns 'x'", input);
    input.columns = {{"force", "force"}};
    expect_refused("time,force [N],force [kN]\n1,1,1\n", "there are 2 columns 'force'", input);
    input.columns = {{"force", "force [kN]"}};
    EXPECT_EQ(parse_fit_data("time,force [N],force [kN]\n1,1,2\n", "lab.csv", input).y[0], 2000);
}

TEST(TableReader, TakesNamesThatMeanTwoThingsForNeither) {
    // Inches or coming in, a duration of contact or the time of an impact, the number of a drop.
    expect_refused("h_in,h_out\n40,25\n", "do not fit together");
    expect_refused("drop,COR\n1,0.8\n", "do not fit together");
    expect_refused("impact_time [ms],impact_velocity [m/s]\n1,4\n", "do not fit together");
    expect_refused("bounce_time,v\n1,4\n2,3\n", "do not fit together");
}

TEST(TableReader, GivesAStandardDeviationTheUnitOfItsColumn) {
    EXPECT_EQ(parse_fit_data("v,e [%],sd\n1,80,2\n", "lab.csv").sigma[0], 0.02);
    EXPECT_EQ(parse_fit_data("t [ms],F [kN],sd\n1,80,2\n", "lab.csv").sigma[0], 2000);
    EXPECT_EQ(parse_fit_data("t [ms],F [kN],sd [N]\n1,80,2\n", "lab.csv").sigma[0], 2);
}

TEST(TableReader, IsQuickWithWhatIsVeryLong) {
    const std::string blanks(300000, ' '), many(200000, '_');
    expect_refused("speed" + blanks + "[m/s] e\n1 x\n", "restitution is 'x'");
    expect_refused("a" + many + "b,e\n1,1\n", "do not fit together");
    std::string table = "id,v,e\n";
    for (int i = 0; i < 100000; ++i) table += std::to_string(i) + ",1,0.5\n";
    FitInput input;
    input.where = {{"id", "77"}};
    EXPECT_EQ(parse_fit_data(table, "lab.csv", input).x.size(), 1U);
}

TEST(TableReader, PicksRowsOfALongTable) {
    const std::string table = "series,v,e\nsteel,7,0.9\nglass,0.1,0.779\nglass,1.25,0.66\n";
    FitInput input;
    input.where = {{"series", "glass"}};
    expect_curve(table, input);
    input.where = {{"series", "glas"}};
    expect_refused(table, "no row has 'glas' in column 'series': did you mean 'glass'? (it has steel, glass)", input);
    input.where = {{"serie", "glass"}};
    expect_refused(table, "no column 'serie': did you mean 'series'?", input);
    // What is not picked is not looked at.
    input.where = {{"series", "glass"}};
    expect_curve("series,v,e\nsteel,fast,none\nglass,0.1,0.779\nglass,1.25,0.66\n", input);
    // In a long table the column of values is what the rows are called, with their unit.
    input.where = {{"quantity", "force_kN"}};
    const FitData trace = parse_fit_data("quantity,time_us,value\nforce_kN,1,2\nspeed,1,7\n", "lab.csv", input);
    EXPECT_EQ(trace.y, (std::vector<double>{2000}));
}

TEST(TableReader, AsksWhereColumnsCanBeReadInTwoWays) {
    const std::string table = "time [ms],displacement [um],force [N]\n1,20,3\n";
    expect_refused(table, "in more than one way: choose with --kind, one of force-indentation, force-time");
    FitInput input;
    input.kind = Measured::force_time;
    EXPECT_EQ(parse_fit_data(table, "lab.csv", input).x, (std::vector<double>{1e-3}));
    input.kind = Measured::force_indentation;
    EXPECT_EQ(parse_fit_data(table, "lab.csv", input).x, (std::vector<double>{20e-6}));
    input.kind = Measured::restitution;
    expect_refused(table, "do not fit together for restitution data", input);
}

// A ball of restitution 0.8 that falls from 1 m at 10 m/s^2, by hand: it comes in at sqrt(20) m/s.
TEST(TableReader, MakesRestitutionOfWhatIsMeasuredInItsPlace) {
    FitInput input;
    input.gravity = 10;
    const double v = std::sqrt(20.0);
    const auto expect = [&](const std::string& table, std::vector<double> x, const std::vector<double>& y) {
        SCOPED_TRACE(table);
        const FitData data = parse_fit_data(table, "lab.csv", input);
        ASSERT_EQ(data.x.size(), x.size());
        for (std::size_t i = 0; i < x.size(); ++i) {
            EXPECT_NEAR(data.x[i], x[i], 1e-12);
            EXPECT_NEAR(data.y[i], y[i], 1e-12);
        }
    };
    expect("v_in,v_out\n5,4\n", {5}, {0.8});
    expect("v_in [mm/s],v_out [m/s]\n5000,4\n", {5}, {0.8});
    expect("drop_height [cm],rebound_height [cm]\n100,64\n", {v}, {0.8});
    expect("h,e\n1,0.8\n", {v}, {0.8});
    // Flights of 0.8, 0.64 and 0.512 s: each bounce between two of them comes in at g/2 times the flight before.
    expect("bounce_time [s]\n1\n1.8\n2.44\n2.952\n", {4, 3.2}, {0.8, 0.8});
    expect("flight_time [ms]\n800\n640\n512\n", {4, 3.2}, {0.8, 0.8});
    expect_refused("v_in,v_out\n5,6\n", "lab.csv:2:1: restitution is 1.2, from speed 5 and speed_out 6");
    expect_refused("bounce_time\n0\n1\n", "two flights at least");
    expect_refused("bounce_time\n0\n1\n3\n", "flight 2 lasts 2 s, longer than the 1 s");
    input.skip_bad_rows = true;
    expect_refused("bounce_time\n0\n2\nx\n3\n", "cannot be left out", input);
    input.gravity = -1;
    expect_refused("h,e\n1,0.8\n", "gravity: -1 m/s^2 is not allowed", input);
}

TEST(TableReader, WarnsOfNumbersThatAreHardlyInSiUnits) {
    const auto warnings = [](std::string_view text) { return parse_fit_data(text, "lab.csv").remarks.warnings; };
    ASSERT_EQ(warnings("indentation,force\n20,1\n40,2\n").size(), 1U);
    EXPECT_TRUE(contains(warnings("indentation,force\n20,1\n40,2\n")[0],
                         "column 'indentation' has no unit, so it was read in m, and goes to 40 m"));
    EXPECT_TRUE(warnings("indentation,force\n2e-5,1\n4e-5,2\n").empty());
    EXPECT_TRUE(warnings("indentation [um],force\n20,1\n40,2\n").empty());
    EXPECT_TRUE(warnings("indentation [m],force\n20,1\n40,2\n").empty());  // said, so meant
    EXPECT_EQ(warnings("speed,restitution\n1500,0.7\n").size(), 1U);
    EXPECT_EQ(warnings("time,force\n0,1\n100,1\n").size(), 1U);
}

// The table of names in docs/tables.md is what the reader knows.
TEST(TableReader, KnowsEveryNameOfTheDocumentation) {
    const std::map<std::string, std::string> partners{{"speed", "restitution"},
                                                      {"restitution", "speed"},
                                                      {"speed_out", "speed"},
                                                      {"drop_height", "restitution"},
                                                      {"rebound_height", "drop_height"},
                                                      {"bounce_time", ""},
                                                      {"flight_time", ""},
                                                      {"indentation", "force"},
                                                      {"rate", "indentation,force"},
                                                      {"time", "force"},
                                                      {"force", "time"},
                                                      {"sigma", "speed,restitution"}};
    std::istringstream page(read_text(FOOTFALL_SOURCE_DIR "/docs/tables.md"));
    std::set<std::string> seen;
    for (std::string line; std::getline(page, line);) {
        if (!line.starts_with("| `")) continue;
        std::vector<std::string> words;
        for (std::size_t at = 0; (at = line.find('`', at)) != std::string::npos;) {
            const std::size_t end = line.find('`', at + 1);
            if (end == std::string::npos) break;
            words.push_back(line.substr(at + 1, end - at - 1));
            at = end + 1;
        }
        if (words.empty() || !partners.contains(words[0]) || !line.starts_with("| `" + words[0] + "` |")) continue;
        seen.insert(words[0]);
        for (const std::string& name : words) {
            const std::string& partner = partners.at(words[0]);
            const std::string header = name + (partner.empty() ? "" : "," + partner);
            try {
                (void)parse_fit_data(header + "\n", "lab.csv");
                ADD_FAILURE() << "a table without rows";
            } catch (const ScenarioError& error) {
                EXPECT_TRUE(contains(error.what(), "there are no rows")) << header << ": " << error.what();
            }
        }
    }
    EXPECT_EQ(seen.size(), partners.size());
}

TEST(TableReader, ReadsThePublishedForceFilesAsTheyAre) {
    const std::string folder = FOOTFALL_SOURCE_DIR "/data/published/";
    const FitData trace = load_fit_data(folder + "chung_ooi_test1_force_time.csv");
    EXPECT_EQ(trace.kind, Measured::force_time);
    EXPECT_DOUBLE_EQ(trace.x[1], 2.4401913875598105e-6);
    EXPECT_DOUBLE_EQ(trace.y[1], 737.4301675977648);
    EXPECT_EQ(load_fit_data(folder + "chung_ooi_test2_force_time.csv").kind, Measured::force_time);
    for (const char* name : {"chung_ooi_test1_force_disp.csv", "chung_ooi_test2_force_disp.csv"}) {
        const FitData loop = load_fit_data(folder + name);
        EXPECT_EQ(loop.kind, Measured::force_indentation);
        EXPECT_GT(loop.x.size(), 10U);
        EXPECT_LT(*std::max_element(loop.x.begin(), loop.x.end()), 1e-3);
    }
}

}  // namespace
}  // namespace footfall::test
