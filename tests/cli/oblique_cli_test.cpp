// footfall oblique, as a user meets it.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "cli/program.hpp"

namespace footfall::test {
namespace {

class ObliqueCli : public ProgramTest {
protected:
    Result oblique(const std::string& words) const { return footfall("oblique " + words); }
};

const std::string ball =
    "--radius 2.5mm --density 4000 --speed 3.9 --normal azad-featherstone:stiffness=2.675e10,damping=0 ";
const std::string friction = "--friction azad-featherstone:stiffness=4.01e10,damping=0,coefficient=0.092 ";

TEST_F(ObliqueCli, JsonIsTheTableWithEveryPhase) {
    const Result answer = oblique(ball + friction + "--angles 50..60:5 --json");
    ASSERT_EQ(answer.exit_code, 0) << answer.err;
    EXPECT_EQ(answer.err, "");
    const Json json = Json::parse(answer.out);
    const std::vector<double> angle = column(json["columns"], "angle"),
                              e_t = column(json["columns"], "tangential_restitution");
    ASSERT_EQ(angle.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(angle[i], 50 + 5.0 * static_cast<double>(i), 1e-9);
        EXPECT_NEAR(e_t[i], 1 - 2 * 0.092 / std::tan(angle[i] * std::numbers::pi / 180), 1e-8);  // it slides, e_n = 1
    }
    ASSERT_EQ(json["history"].size(), 3U);
    EXPECT_EQ(json["history"][0][0]["phase"], "slip");
}

TEST_F(ObliqueCli, PlainAnglesAreDegreesAndUnitsAreTaken) {
    const auto e_t = [&](const std::string& angles) {
        return column(Json::parse(oblique(ball + friction + "--json --angles " + angles).out)["columns"],
                      "tangential_restitution");
    };
    const std::vector<double> plain = e_t("15"), in_radians = e_t("0.2617993877991494rad");
    ASSERT_EQ(plain.size(), 1U);
    EXPECT_NEAR(plain[0], in_radians.at(0), 1e-12);
}

TEST_F(ObliqueCli, SweepsTheSpinAtAGivenNormalSpeed) {
    const Result answer = oblique("--radius 2.5mm --mass 0.26g --normal-speed 2 --angles 0 --spins=-100,0,100 --json " +
                                  friction + "--normal azad-featherstone:stiffness=2.675e10,damping=0");
    ASSERT_EQ(answer.exit_code, 0) << answer.err;
    const std::vector<double> v = column(Json::parse(answer.out)["columns"], "tangential_velocity_after");
    ASSERT_EQ(v.size(), 3U);
    EXPECT_NEAR(v[1], 0, 1e-12);
    EXPECT_NEAR(v[0], -v[2], 1e-10);
    EXPECT_GT(std::abs(v[0]), 1e-3);
}

TEST_F(ObliqueCli, TheAskedRestitutionIsMetAtNormalIncidence) {
    const Result answer = oblique(ball + friction + "--restitution 0.8 --angles 0 --json");
    ASSERT_EQ(answer.exit_code, 0) << answer.err;
    EXPECT_NEAR(column(Json::parse(answer.out)["columns"], "normal_restitution").at(0), 0.8, 1e-8);
}

TEST_F(ObliqueCli, WritesTheTableAndThePhasesAsCsv) {
    const Result answer = oblique(ball + friction + "--angles 10,50 --csv " + (folder / "t.csv").string() +
                                  " --history " + (folder / "h.csv").string());
    ASSERT_EQ(answer.exit_code, 0) << answer.err;
    EXPECT_NE(read_text(folder / "t.csv").find("contact_rebound_angle"), std::string::npos);
    EXPECT_NE(read_text(folder / "h.csv").find("row,phase,start,duration\n0,0,0,"), std::string::npos);
    EXPECT_NE(answer.out.find("Stick and slip, durations in us"), std::string::npos) << answer.out;
}

TEST_F(ObliqueCli, FitsTheCoefficientToAMeasuredCurve) {
    std::string data = "# closed form of sliding\nangle,tangential_restitution\n";
    for (const double angle : {55.0, 65.0, 75.0}) {
        const double e_t = 1 - 2 * 0.12 / std::tan(angle * std::numbers::pi / 180);
        data += std::to_string(angle) + "," + std::to_string(e_t) + "\n";
    }
    const std::string file = folder.write("d.csv", data).string();
    const Result answer = oblique(ball + friction + "--vary friction.coefficient --json --fit " + file);
    ASSERT_EQ(answer.exit_code, 0) << answer.err;
    const Json json = Json::parse(answer.out);
    EXPECT_NEAR(json["estimates"][0]["value"].get<double>(), 0.12, 2e-6);
    EXPECT_EQ(json["observable"], "tangential_restitution");
    EXPECT_NE(oblique(ball + friction + "--vary friction.coefficient --fit " + file).out.find("friction.coefficient"),
              std::string::npos);
}

TEST_F(ObliqueCli, ReadsThePublishedAngleFilesAsTheyAre) {
    const std::string published = FOOTFALL_SOURCE_DIR "/data/published/";
    const struct {
        std::string words, observable;
        std::size_t count;  // of rows, by hand
    } files[]{{"chung_ooi_test4_et.csv", "tangential_restitution", 13},
              {"chung_ooi_test4_rebound.csv", "contact_rebound_angle", 13},
              {"chung_ooi_test4_omega.csv --where series=Experiment", "spin_after", 10},
              {"chung_ooi_test5_psi2_psi1.csv --where series=Steel", "contact_velocity_after", 15},
              {"chung_ooi_test5_romega.csv --where series=Steel", "spin_after", 15},
              {"chung_ooi_test6_beta.csv", "contact_restitution", 17},
              {"kharaz2001_lethe.csv --where quantity=et", "tangential_restitution", 8},
              {"kharaz2001_lethe.csv --where quantity=omega_rad_s", "spin_after", 7},
              {"kharaz2001_lethe.csv --where quantity=rebound_deg_centre", "rebound_angle", 9}};
    for (const auto& file : files) {
        const Result answer =
            oblique(ball + friction + "--vary friction.stiffness --json --fit " + published + file.words);
        ASSERT_EQ(answer.exit_code, 0) << answer.err;
        const Json json = Json::parse(answer.out);
        EXPECT_EQ(json["observable"], file.observable) << file.words;
        EXPECT_EQ(json["measured"].size(), file.count) << file.words;
    }
}

TEST_F(ObliqueCli, SaysWhereAFitRunsAway) {
    const std::string file = folder.write("d.csv", "angle,rebound_angle\n10,6.442\n").string();
    const Result answer = oblique(
        "--radius 2.5mm --density 4000 --speed 3.9 --normal azad-featherstone:stiffness=2.675e10,damping=700 "
        "--friction "
        "azad-featherstone:stiffness=4.01e10,damping=700,coefficient=0.092 --tolerance 1e-6 --vary "
        "friction.coefficient --fit " +
        file);
    EXPECT_EQ(answer.exit_code, 2);
    EXPECT_NE(answer.err.find("d.csv: the fit runs away: friction.coefficient"), std::string::npos) << answer.err;
}

TEST_F(ObliqueCli, WarnsOfSignsThatAreTheOtherWayRound) {
    const std::string file = std::string(FOOTFALL_SOURCE_DIR) + "/data/published/chung_ooi_test4_omega.csv";
    const std::string words = ball + friction + "--vary friction.stiffness --where series=Experiment --fit " + file;
    EXPECT_NE(oblique(words).out.find("Warning: spin_after has the other sign"), std::string::npos);
    const Result turned = oblique(words + " --column spin_after=-final_omega_rad_s");
    EXPECT_EQ(turned.exit_code, 0) << turned.err;
    EXPECT_EQ(turned.out.find("other sign"), std::string::npos) << turned.out;
}

TEST_F(ObliqueCli, TheCoefficientIsNotFittedToWhatIsInItsUnits) {
    const std::string file = std::string(FOOTFALL_SOURCE_DIR) + "/data/published/chung_ooi_test6_beta.csv";
    const Result answer = oblique(ball + friction + "--vary friction.coefficient --fit " + file);
    EXPECT_EQ(answer.exit_code, 2);
    EXPECT_NE(answer.err.find("in units of mu"), std::string::npos) << answer.err;
}

TEST_F(ObliqueCli, WrongInputExitsWithTwoAndSaysWhereItIs) {
    const auto refuse = [&](const std::string& words, const std::string& reason) {
        const Result answer = oblique(words);
        EXPECT_EQ(answer.exit_code, 2) << words;
        EXPECT_EQ(answer.out, "");
        EXPECT_EQ(answer.err.find("footfall: "), 0U) << answer.err;
        EXPECT_NE(answer.err.find(reason), std::string::npos) << answer.err;
    };
    const std::string good = ball + friction;
    refuse(ball, "--friction");
    refuse(good + "--normal-speed 3", "--normal-speed");
    refuse("--radius 1 --speed 1 --normal linear:stiffness=1,damping=0 --friction none", "--mass or --density");
    refuse("--radius 1 --mass 1 --normal linear:stiffness=1,damping=0 --friction none", "--speed or --normal-speed");
    refuse(good + "--angles 90", "below 90");
    refuse(good + "--angles 5..85", "START..END:STEP");
    refuse(good + "--angles 85..5:5", "from START to END");
    refuse(good + "--angles 5..85:0", "from START to END");
    refuse(good + "--spins 5m", "--spins");
    refuse(good + "--vary friction.coefficient", "--fit");
    const auto data = [&](const std::string& text) {
        return "--vary friction.coefficient --fit " + folder.write("d.csv", text).string();
    };
    refuse(good + data("angle,spin_after\n10,x\n"), "d.csv:2:4: spin_after is 'x'");
    refuse(good + data("angle,spin_after\n10\n"), "d.csv:2:1: 1 values, where the header has 2 columns");
    refuse(good + data("angle,spin_after,rebound_angle\n1,1,1\n"), "2 measured columns, 'rebound_angle', 'spin_after'");
    refuse(good + data("angle,colour\n10,1\n"), "colour");
    refuse(good + data("angle,spin_after\n"), "no rows of data");
    refuse(good + "--vary friction.coefficient --fit " + (folder / "none.csv").string(), "none.csv");
    refuse(good + "--fit " + folder.write("d.csv", "angle,spin_after\n10,1\n").string(), "--vary");
}

TEST_F(ObliqueCli, TheExampleOfItsHelpRuns) {
    const std::string help = oblique("--help").out;
    const std::size_t begin = help.find("  footfall oblique");
    ASSERT_NE(begin, std::string::npos);
    const std::size_t words = begin + std::string("  footfall oblique").size();
    const Result answer = oblique(help.substr(words, help.find("\n\n", words) - words));
    EXPECT_EQ(answer.exit_code, 0) << answer.err;
    EXPECT_NE(answer.out.find("tangential_restitution"), std::string::npos);
}

}  // namespace
}  // namespace footfall::test
