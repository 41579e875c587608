// footfall restitution and footfall material, as programs.
#include <chrono>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "cli/program.hpp"

namespace footfall::test {
namespace {

using RestitutionCli = ProgramTest;

const std::string three_laws =
    " --mass '154 g' --radius '1.65 cm' --normal azad-featherstone:stiffness=8.5e6,damping=3.1e3"
    " --normal hunt-crossley:stiffness=8.5e6,damping=3.1e6 --normal linear:stiffness=2.5e5,damping=60 ";

TEST_F(RestitutionCli, GivesFiftySpeedsAndThreeLawsInUnderASecondAsTheClosedFormsHaveThem) {
    const auto start = std::chrono::steady_clock::now();
    const Result result = footfall("restitution --json --points 50 --to '1 m/s'" + three_laws);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_LT(taken.count(), 1);
    const auto json = Json::parse(result.out);
    EXPECT_EQ(column(json["columns"], "speed").size(), 50u);
    for (const char* law : {"hunt-crossley", "linear"}) {
        const auto e = column(json["columns"], "restitution", law),
                   theory = column(json["columns"], "closed_form", law);
        for (std::size_t i = 0; i < 50; ++i) EXPECT_NEAR(e[i], theory[i], 1e-9) << law << " " << i;
    }
    EXPECT_EQ(json["cases"][0]["law"], "azad-featherstone:stiffness=8500000,damping=3100");
}

TEST_F(RestitutionCli, WritesCsvAndPrintsAPage) {
    const std::string file = (folder / "e.csv").string();
    const Result result = footfall("restitution --points 30 --linear --gravity 9.81 --csv " + file + three_laws);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(contains(result.out, "10 rows left out"));
    EXPECT_TRUE(contains(result.out, "does not bounce below"));
    EXPECT_TRUE(contains(result.err, "warning: linear: the sphere sinks in"));  // 0.4 of its radius at 10 m/s
    EXPECT_TRUE(contains(read_text(file), "\nspeed,azad-featherstone.restitution,"));
}

TEST_F(RestitutionCli, TellsCurvesOfOneLawApart) {
    const Result result = footfall(
        "restitution --mass 1 --points 2 --normal linear:stiffness=1e5,damping=1 "
        "--normal linear:stiffness=1e5,damping=2 --json");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto json = Json::parse(result.out);
    EXPECT_EQ(json["cases"][1]["series"], "linear:stiffness=100000,damping=2");
}

TEST_F(RestitutionCli, FindsWhereACurveIsStraight) {
    const Result result = footfall(
        "restitution --mass '154 g' --normal azad-featherstone:stiffness=8.5e6,damping=3.1e3 --from 1e-6 --to 1e6 "
        "--points 2 --straight 0.01 --json");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto straight = Json::parse(result.out)["cases"][0]["straight"];
    EXPECT_LT(straight["slowest"], straight["speed"]);
    EXPECT_GT(straight["fastest"], straight["speed"]);
}

TEST_F(RestitutionCli, ReproducesTheFigures) {
    for (const char* figure : {"2", "3", "4"}) {
        const Result result = footfall(std::string("restitution --json --figure ") + figure);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_TRUE(Json::accept(result.out));
    }
}

TEST_F(RestitutionCli, RefusesWrongInputWithTwoAndSaysWhatIsAllowed) {
    const auto refuses = [&](const std::string& words, std::string_view why) {
        const Result result = footfall(words);
        EXPECT_EQ(result.exit_code, 2) << words;
        EXPECT_EQ(result.out, "") << words;
        EXPECT_TRUE(contains(result.err, why)) << words << "\n" << result.err;
    };
    refuses("restitution", "--mass and at least one --normal are required");
    refuses("restitution --figure 7", "one of 2, 3, 4");
    refuses("restitution --figure 2 --mass 1", "--mass and --figure cannot be given together");
    refuses("restitution --mass '1 m' --normal linear:stiffness=1,damping=1", "--mass: expected a mass (kg)");
    refuses("restitution --mass 1 --normal linaer:stiffness=1,damping=1", "did you mean 'linear'?");
    refuses("restitution --mass 1 --normal linear:stiffness=1,damping=1 --from 2 --to 1", "above the slowest");
    refuses("restitution --mass 1 --normal linear:stiffness=1,damping=1 --tolerance 1", "from 1e-14 to 1e-3");
    refuses("material", "--sphere and --ground are required");
    refuses("material --sphere steal --ground cork --radius 0.01", "(materials: aluminium,");
    refuses("material --sphere E=1e9 --ground cork --radius 0.01", "needs both E and nu");
    refuses("material --sphere steel --ground cork --radius 0.01", "no damping is given");
    refuses("material --sphere steel --ground cork --radius 0.01 --alpha 1 --damping-time 1", "more than once");
    refuses("material --sphere steel --ground cork --radius 0.01 --restitution 0.5", "--speed is missing");
    refuses("material --sphere steel --ground cork --radius 0.01 --restitution 1.2 --speed 1", "must be > 0 and <= 1");
    refuses("material --sphere E=1e9,nu=0.3 --ground cork --radius 0.01 --restitution 0.5 --speed 1",
            "--mass is missing");
}

TEST_F(RestitutionCli, MaterialGivesTablesThatAScenarioTakesAndThatBounceAsMeasured) {
    const Result material = footfall(
        "material --sphere steel --ground brass --radius '1.27 cm' --mass '67 g' --restitution 0.6 --speed '1 m/s' "
        "--tangential mindlin --friction 0.2");
    ASSERT_EQ(material.exit_code, 0) << material.err;
    const auto file = folder.write(
        "ball.toml",
        "title = \"A bounce\"\n[time]\nend = 1e-2\n[gravity]\nacceleration = [0, 0, 0]\n[body]\nmass = \"67 g\"\n"
        "inertia = \"solid-sphere\"\n[[body.spheres]]\nradius = \"1.27 cm\"\n[body.initial]\n"
        "position = [0, 0, 0.0128]\nvelocity = [0, 0, -1]\n" +
            material.out);
    const Result run = footfall("run --json " + file.string());
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NEAR(Json::parse(run.out)["impacts"][0]["restitution"], 0.6, 1e-8);
}

TEST_F(RestitutionCli, MaterialInvertsALawAndListsItsSources) {
    const Result inverse = footfall(
        "material --json --normal linear:stiffness=1e5,damping=0 --mass 1 --speed 3 --restitution 0.1353352832366127");
    ASSERT_EQ(inverse.exit_code, 0) << inverse.err;
    // e = exp(-2) is critical damping, d = 2 sqrt(k m) = 632.4555320336759.
    EXPECT_TRUE(contains(inverse.out, "damping=632.4555")) << inverse.out;
    const Result list = footfall("material --list");
    EXPECT_TRUE(contains(list.out, "Callister 2007"));
    EXPECT_GE(Json::parse(footfall("material --list --json").out)["materials"].size(), 11u);
}

}  // namespace
}  // namespace footfall::test
