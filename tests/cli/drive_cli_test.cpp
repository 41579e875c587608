// footfall drive, as a user meets it.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "cli/program.hpp"

namespace footfall::test {
namespace {

class DriveCli : public ProgramTest {
protected:
    Result drive(const std::string& words) const { return footfall("drive " + words); }
};

const std::string rigs = FOOTFALL_SOURCE_DIR "/scenarios/rigs/";
const std::string loop = rigs + "presliding-loop.toml ";
const std::string clutch = "--friction linear:stiffness=1e5,damping=0,coefficient=0.4 ";

TEST_F(DriveCli, JsonHasLawsEventsEnergiesAndSamples) {
    const Result answer = drive(loop + clutch + "--json");
    ASSERT_EQ(answer.exit_code, 0) << answer.err;
    EXPECT_EQ(answer.err, "");
    const Json json = Json::parse(answer.out);
    ASSERT_EQ(json["runs"].size(), 1u);
    const Json& run = json["runs"][0];
    EXPECT_EQ(run["name"], "linear");
    EXPECT_EQ(run["events"][0]["kind"], "touchdown");
    EXPECT_EQ(run["stick_slip"], nullptr);
    EXPECT_LT(run["max_residual"], 1e-10);
    // 40 um of give, 30 um of way: nothing slides, and a spring without a damper takes nothing.
    EXPECT_EQ(run["events"].size(), 2u);
    EXPECT_NEAR(run["energy"]["clutch"].get<double>(), 0, 1e-15);
    const std::vector<double> x = column(json["samples"], "slip_displacement_x"),
                              F = column(json["samples"], "friction_force_x");
    ASSERT_EQ(x.size(), column(json["samples"], "time").size());
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(F[i], -1e5 * x[i], 1e-9);
}

TEST_F(DriveCli, LawsStandSideBySideInOneTable) {
    const std::string file = (folder / "loops.csv").string();
    const Result answer = drive(loop + clutch + clutch + "--friction none --csv " + file);
    ASSERT_EQ(answer.exit_code, 0) << answer.err;
    for (const char* words : {"Pre-sliding loops", "linear (2)", "none", "Written"})
        EXPECT_NE(answer.out.find(words), std::string::npos) << words << "\n" << answer.out;
    const std::string table = read_text(file);
    for (const char* head : {"\ntime,linear.phase", "linear (2).friction_force_x", "none.clutch"})
        EXPECT_NE(table.find(head), std::string::npos) << head;
}

TEST_F(DriveCli, NormalLawsAreComparedToo) {
    const Result answer = drive(rigs +
                                "force-indentation.toml --normal hertz:stiffness=8.5e6 "
                                "--normal azad-featherstone:stiffness=8.5e6,damping=3.1e3 --json");
    ASSERT_EQ(answer.exit_code, 0) << answer.err;
    const Json json = Json::parse(answer.out);
    ASSERT_EQ(json["runs"].size(), 2u);
    EXPECT_EQ(json["runs"][0]["name"], "hertz");
    // An elastic contact gives back all that it took: 8.5e6 (1e-4)^1.5 at most.
    EXPECT_NEAR(json["runs"][0]["largest_normal_force"].get<double>(), 8.5, 1e-4);
    EXPECT_NEAR(json["runs"][0]["energy"]["pressing_work"].get<double>(), 0, 1e-14);
    EXPECT_GT(json["runs"][1]["energy"]["normal_damper"], 1e-5);
}

TEST_F(DriveCli, ToleranceTakesThePlaceOfTheFiles) {
    const auto steps = [&](const std::string& tolerance) {
        const Result answer = drive(rigs + "stick-slip-belt.toml --json --tolerance " + tolerance);
        EXPECT_EQ(answer.exit_code, 0) << answer.err;
        return Json::parse(answer.out)["runs"][0]["steps"].get<int>();
    };
    EXPECT_GT(steps("1e-12"), steps("1e-5"));
}

TEST_F(DriveCli, WrongInputIsSaidAndExitsWithTwo) {
    const auto expect = [&](const std::string& words, const std::string& said) {
        const Result answer = drive(words);
        EXPECT_EQ(answer.exit_code, 2) << words;
        EXPECT_EQ(answer.out, "");
        EXPECT_NE(answer.err.find(said), std::string::npos) << answer.err;
    };
    expect("", "RIG is required");
    expect("nowhere.toml", "cannot read nowhere.toml");
    expect(loop + "--friction lnear:stiffness=1", "linear");
    expect(loop + "--tolerance 1", "--tolerance: '1' is not allowed: must be from 1e-14 to 1e-3");
    folder.write("rig.toml",
                 "[rig]\nend = 1\n[[rig.load]]\nshape = \"constant\"\nvalue = -3\n[contact.normal]\n"
                 "law = \"hertz\"\nstiffness = 1e6\n");
    expect((folder / "rig.toml").string(), "load: -3 N between 0 s and 1 s is not allowed: must be > 0");
}

TEST_F(DriveCli, HelpHasAnExampleThatRuns) {
    const Result help = drive("--help");
    ASSERT_EQ(help.exit_code, 0);
    EXPECT_NE(help.out.find("footfall drive presliding-loop"), std::string::npos);
    EXPECT_EQ(drive("presliding-loop").exit_code, 0);
}

}  // namespace
}  // namespace footfall::test
