// Rig files: what they mean, and what is said where they cannot be used.
#include "footfall/io/rig.hpp"

#include <cmath>
#include <filesystem>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "io/temporary_folder.hpp"

namespace footfall::test {
namespace {

const std::string normal = R"(
[contact.normal]
law = "azad-featherstone"
stiffness = 8.5e6
damping = 3.1e3
)";

std::string rig(const std::string& body, const std::string& head = "end = 2\n") {
    return "[rig]\n" + head + body + normal;
}
const std::string pressed = "[[rig.load]]\nshape = \"constant\"\nvalue = \"10 N\"\n";

/// All that is wrong with it.
std::string refusal(const std::string& text) {
    try {
        (void)parse_rig(text, "some/rig.toml");
    } catch (const ScenarioError& error) {
        return error.what();
    }
    return "";
}
void expect_refusal(const std::string& text, const std::string& words) {
    EXPECT_NE(refusal(text).find(words), std::string::npos) << refusal(text);
}

TEST(RigFile, ReadsEachShapeInItsUnits) {
    const RigFile file = parse_rig(rig(pressed + R"(
[[rig.displacement]]
shape = "sine"
amplitude = "5 um"
frequency = "2 kHz"
phase = "90 deg"
cycles = 3
[[rig.displacement]]
shape = "ramp"
change = "1 mm"
start = "1 ms"
duration = "1 s"
direction = "90 deg"
[[rig.displacement]]
shape = "triangle"
amplitude = 2e-6
frequency = 3
direction = "180 deg"
)"));
    EXPECT_EQ(file.rig.press, Press::load);
    EXPECT_EQ(file.rig.drag, Drag::displacement);
    EXPECT_EQ(file.rig.pressing.at(0.3).value, 10);
    ASSERT_EQ(file.rig.dragging[0].parts().size(), 2u);
    ASSERT_EQ(file.rig.dragging[1].parts().size(), 1u);  // a right angle leaves nothing in the first direction
    const auto& sine = std::get<SinePart>(file.rig.dragging[0].parts()[0]);
    EXPECT_DOUBLE_EQ(sine.amplitude, 5e-6);
    EXPECT_DOUBLE_EQ(sine.frequency, 2000);
    EXPECT_DOUBLE_EQ(sine.phase, std::acos(0.0));
    EXPECT_EQ(sine.cycles, 3);
    const auto& triangle = std::get<TrianglePart>(file.rig.dragging[0].parts()[1]);
    EXPECT_DOUBLE_EQ(triangle.amplitude, -2e-6);
    EXPECT_TRUE(std::isinf(triangle.cycles));
    const auto& ramp = std::get<RampPart>(file.rig.dragging[1].parts()[0]);
    EXPECT_DOUBLE_EQ(ramp.change, 1e-3);
    EXPECT_DOUBLE_EQ(ramp.start, 1e-3);
}

TEST(RigFile, HasDefaults) {
    const RigFile file = parse_rig(rig(pressed));
    EXPECT_EQ(file.rig.period(), 2e-3);
    EXPECT_EQ(file.rig.tolerance, 1e-10);
    EXPECT_TRUE(file.rig.dragging[0].empty());
    EXPECT_TRUE(std::holds_alternative<NoFriction<>>(file.laws.friction));
    EXPECT_EQ(std::get<AzadFeatherstoneNormal<>>(file.laws.normal).damping, 3.1e3);
}

TEST(RigFile, ReadsAMassOnABelt) {
    const RigFile file = parse_rig(rig(pressed + R"(
[rig.mass]
mass = "100 g"
stiffness = "2 kN/m"
[[rig.mass.belt]]
shape = "constant"
value = "1 mm/s"
[[rig.mass.force]]
shape = "sine"
amplitude = "2 N"
frequency = 5
[contact.friction]
law = "linear"
stiffness = 1e5
damping = 3
coefficient = 0.2
)"));
    EXPECT_EQ(file.rig.drag, Drag::mass);
    EXPECT_DOUBLE_EQ(file.rig.mass.mass, 0.1);
    EXPECT_DOUBLE_EQ(file.rig.mass.stiffness, 2000);
    EXPECT_EQ(file.rig.mass.damping, 0);
    EXPECT_DOUBLE_EQ(file.rig.mass.belt[0].at(1).value, 1e-3);
    EXPECT_EQ(file.rig.mass.force[0].parts().size(), 1u);
    EXPECT_EQ(std::get<LinearFriction<>>(file.laws.friction).coefficient, 0.2);
}

TEST(RigFile, ReadsPointsFromATableBesideIt) {
    const TemporaryFolder folder;
    folder.write("path.csv", "# a path\nt, x , other\n0,1e-3,7\n\n1, 3e-3,8\r\n");
    folder.write("rig.toml",
                 rig("[[rig.indentation]]\nshape = \"table\"\nfile = \"path.csv\"\ntime = \"t\"\ncolumn = \"x\"\n"));
    const RigFile file = load_rig(folder / "rig.toml");
    EXPECT_EQ(file.rig.press, Press::indentation);
    EXPECT_DOUBLE_EQ(file.rig.pressing.at(0.25).value, 1.5e-3);
    EXPECT_DOUBLE_EQ(file.rig.pressing.at(5).value, 3e-3);
}

TEST(RigFile, ATableMayHaveAnyUnitHoweverItIsWritten) {
    // 4 mm at 1 s, in every way of saying it.
    const std::vector<std::pair<std::string, std::string>> tables{
        {"x [mm]", "time [s],x [mm]\n0,0\n1,4\n"},
        {"x", "time [s],x [mm]\n0,0\n1,4\n"},
        {"x [mm]", "time,x\n0,0\n1,4\n"},
        {"x_mm", "t_ms;x_mm\n0;0\n1000;4,0\n"},
        {"x", "time (s)\tx (mm)\n0\t0\n1\t4\n"},
        {"x", "time,x\ns,mm\n0,0\n1,4\n"},
        {"x", "time [ms] x [um]\n0 0\n1000 4000\n"},
        {"-x", "time [min],x [cm]\n0,0\n0.016666666666666667,-.4\n"},
    };
    for (const auto& [column, table] : tables) {
        const TemporaryFolder folder;
        folder.write("path.csv", table);
        folder.write("rig.toml",
                     rig(pressed + "[[rig.displacement]]\nshape = \"table\"\nfile = \"path.csv\"\ncolumn = \"" +
                         column + "\"\n"));
        const RigFile file = load_rig(folder / "rig.toml");
        EXPECT_DOUBLE_EQ(file.rig.dragging[0].at(1).value, 4e-3) << table;
        EXPECT_DOUBLE_EQ(file.rig.dragging[0].at(0.5).value, 2e-3) << table;
        EXPECT_TRUE(file.rig.remarks.warnings.empty());
    }
}

TEST(RigFile, RefusesAUnitThatTheTableContradicts) {
    const TemporaryFolder folder;
    folder.write("path.csv", "time,x [mm]\n0,0\n1,4\n");
    const std::string text = rig("[[rig.indentation]]\nshape = \"table\"\nfile = \"path.csv\"\ncolumn = \"x [m]\"\n");
    try {
        (void)parse_rig(text, folder / "rig.toml");
        ADD_FAILURE();
    } catch (const ScenarioError& error) {
        EXPECT_NE(std::string(error.what()).find("'x [mm]' has the unit mm, but x [m] asks for m"), std::string::npos)
            << error.what();
    }
}

TEST(RigFile, WarnsOfDepthsInMetresThatNobodyGaveAUnit) {
    const TemporaryFolder folder;
    folder.write("path.csv", "time,depth\n0,0\n1,4\n");
    const RigFile file = parse_rig(
        rig("[[rig.indentation]]\nshape = \"table\"\nfile = \"path.csv\"\ncolumn = \"depth\"\n"), folder / "rig.toml");
    ASSERT_EQ(file.rig.remarks.warnings.size(), 1u);
    EXPECT_NE(file.rig.remarks.warnings[0].find("column 'depth' has no unit"), std::string::npos);
}

TEST(RigFile, SaysWhereATableIsWrong) {
    const TemporaryFolder folder;
    const std::string text = rig("[[rig.indentation]]\nshape = \"table\"\nfile = \"path.csv\"\ncolumn = \"depth\"\n");
    const auto refused = [&](const std::string& table) -> std::string {
        folder.write("path.csv", table);
        try {
            (void)parse_rig(text, folder / "rig.toml");
        } catch (const ScenarioError& error) {
            EXPECT_EQ(error.problems().size(), 1u);
            EXPECT_EQ(error.problems().front().line, 5);  // of the key `file`
            return error.problems().front().message;
        }
        return "";
    };
    const auto expect = [&](const std::string& table, const std::string& words) {
        EXPECT_NE(refused(table).find(words), std::string::npos) << refused(table);
    };
    expect("time,dept\n0,1\n1,2\n", "path.csv:1:1: indentation: no column 'depth': did you mean 'dept'?");
    expect("time,depth\n0,1\n1,x\n", "path.csv:3:3: indentation is 'x'; allowed is a finite number");
    expect("time,depth\n0,1\n1,inf\n", "path.csv:3:3: indentation is 'inf'; allowed is a finite number");
    expect("time,depth\n0,1\n1\n", "path.csv:3:1: 1 values, where the header has 2 columns");
    expect("time,depth\n1,1\n# no\n1,2\n", "path.csv:4:1: time is '1'; allowed is after the row above");
    expect("clock,depth\n0,1\n1,2\n", "path.csv:1:1: there is no column 'time'");
    expect("time,depth [s]\n0,1\n1,2\n", "path.csv:1:6: 'depth [s]': expected a length (m), got a time (s)");
    expect("time,depth\n0,1\n", "at least two rows are needed");
    std::filesystem::remove(folder / "path.csv");
    EXPECT_THROW((void)parse_rig(text, folder / "rig.toml"), ScenarioError);
}

TEST(RigFile, SaysWhatIsMissing) {
    expect_refusal(rig(""), "rig: one of indentation, load is missing");
    expect_refusal("[rig]\nend = 1\n" + pressed, "the table [contact] is missing");
    expect_refusal(rig(pressed, ""), "'end' is missing");
    expect_refusal(rig(pressed + "[rig.mass]\nstiffness = 3\n"), "rig.mass: 'mass' is missing");
    expect_refusal(rig("[[rig.load]]\nshape = \"ramp\"\nchange = 1\n"), "rig.load[0]: 'duration' is missing");
}

TEST(RigFile, AnglesMeantInDegreesAreRefusedWithTheMend) {
    for (const std::string key : {"direction", "phase"}) {
        const std::string part = "[[rig.displacement]]\nshape = \"sine\"\namplitude = 1\nfrequency = 1\n" + key;
        expect_refusal(rig(pressed + part + " = 90\n"),
                       "rig.displacement[0]." + key + ": 90 rad is more than a turn; for degrees write \"90 deg\"");
        EXPECT_NO_THROW((void)parse_rig(rig(pressed + part + " = \"90 rad\"\n"))) << key;
    }
}

TEST(RigFile, RefusesWhatExcludesItself) {
    const std::string dragged = "[[rig.displacement]]\nshape = \"constant\"\nvalue = 0\n";
    expect_refusal(rig(pressed + "[[rig.indentation]]\nshape = \"constant\"\nvalue = 0\n"),
                   "give only one of indentation, load");
    expect_refusal(rig(pressed + dragged + "[rig.mass]\nmass = 1\n"), "give only one of displacement, mass");
}

TEST(RigFile, PointsAtUnknownKeysAndWrongValues) {
    const std::string text =
        rig("[[rig.load]]\nshape = \"sine\"\namplitud = 1\namplitude = \"3 mm\"\nfrequency = -1\n");
    expect_refusal(text, "some/rig.toml:5:1: rig.load[0]: unknown key 'amplitud': did you mean 'amplitude'?");
    expect_refusal(text, "some/rig.toml:6:13: rig.load[0].amplitude: expected a force (N), got a length (m)");
    expect_refusal(text, "some/rig.toml:7:13: rig.load[0].frequency: -1 Hz is not allowed: must be > 0");
    expect_refusal(rig("[[rig.load]]\nshape = \"sinus\"\n"), "'sinus' is not allowed: did you mean 'sine'?");
    expect_refusal(rig("[[rig.load]\n"), "some/rig.toml:3:1: the '[' is not closed");
}

TEST(RigFile, MissingFilesAreErrorsOfTheSystem) {
    EXPECT_THROW((void)load_rig("nowhere/rig.toml"), std::system_error);
    EXPECT_THROW((void)load_rig("/"), std::system_error);
}

TEST(RigFile, ShippedRigsRunAndCloseTheirAccount) {
    int rigs = 0;
    for (const auto& entry : std::filesystem::directory_iterator(FOOTFALL_SOURCE_DIR "/scenarios/rigs")) {
        const RigFile file = load_rig(entry.path());
        const Drive run = drive(file.rig, file.laws);
        EXPECT_LT(run.max_residual, 1e-9) << entry.path();
        EXPECT_FALSE(file.rig.title.empty()) << entry.path();
        ++rigs;
    }
    EXPECT_GE(rigs, 6);
}

TEST(RigOutput, SummaryFitsATerminal) {
    const RigFile file = load_rig(FOOTFALL_SOURCE_DIR "/scenarios/rigs/stick-slip-belt.toml");
    std::vector<RigRun> runs;
    for (const char* name : {"azad-featherstone", "azad-featherstone (2)"})
        runs.push_back({file.laws, {name, drive(file.rig, file.laws)}});
    for (const auto& shown : {runs, std::vector<RigRun>{runs.front()}}) {
        const std::string page = summary(file.rig, shown);
        EXPECT_NE(page.find("Swing of the mass"), std::string::npos);
        EXPECT_EQ(page.find("Events") != std::string::npos, shown.size() == 1);
        std::size_t columns = 0;
        for (const char c : page) {
            columns = c == '\n' ? 0 : columns + ((static_cast<unsigned char>(c) & 0xc0) != 0x80);
            EXPECT_LE(columns, 100u) << page;
        }
    }
}

}  // namespace
}  // namespace footfall::test
