// Scenarios and rigs by name, and changed on the command line.
#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "cli/program.hpp"

namespace footfall::test {
namespace {

const std::string scenarios = FOOTFALL_SOURCE_DIR "/scenarios/";

class SettingCli : public ProgramTest {
protected:
    /// What a run prints as JSON, but for the time that it took.
    Json run(const std::string& words) const {
        const Result result = footfall("run --json " + words);
        EXPECT_EQ(result.exit_code, 0) << words << "\n" << result.err;
        Json json = Json::parse(result.out);
        json.erase("wall_seconds");
        return json;
    }
};

TEST_F(SettingCli, AShippedFileIsThereByItsName) {
    EXPECT_EQ(run("spinning-ball"), run(scenarios + "spinning-ball.toml"));
    EXPECT_EQ(footfall("run rolling-sphere --print").out, read_text(scenarios + "rolling-sphere.toml"));
    EXPECT_EQ(footfall("drive drift --print").out, read_text(scenarios + "rigs/drift.toml"));
}

TEST_F(SettingCli, EveryShippedFileIsListed) {
    for (const auto& [command, under] : {std::pair{"run", "."}, {"drive", "rigs"}}) {
        const std::string list = footfall(std::string(command) + " --list").out;
        std::size_t files = 0;
        for (const auto& entry : std::filesystem::directory_iterator(scenarios + under)) {
            if (entry.path().extension() != ".toml") continue;
            ++files;
            EXPECT_TRUE(contains("\n" + list, "\n" + entry.path().stem().string() + "  ")) << list;
        }
        EXPECT_EQ(files, static_cast<std::size_t>(std::count(list.begin(), list.end(), '\n')));
    }
    EXPECT_TRUE(contains(footfall("run --list").out, "A spinning ball dropped\n"));
}

TEST_F(SettingCli, AFileComesBeforeAShippedOne) {
    folder.write("drift", "not TOML");
    const Result result = footfall("drive " + (folder / "drift").string());
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_TRUE(contains(result.err, (folder / "drift").string() + ":1:")) << result.err;
}

TEST_F(SettingCli, ANameThatIsNeitherIsMetWithTheNearest) {
    const auto expect = [&](const std::string& words, const std::string& said) {
        const Result result = footfall(words);
        EXPECT_EQ(result.exit_code, 2) << words;
        EXPECT_EQ(result.err.find("footfall: cannot read "), 0u) << result.err;
        EXPECT_TRUE(contains(result.err, said)) << result.err;
    };
    expect("run roling-sphere", "did you mean 'rolling-sphere'? (footfall run --list has their names)");
    expect("run nowhere/rolling-sphere.toml", "did you mean 'rolling-sphere'?");
    expect("run drift", "'drift' is a rig: footfall drive drift");
    expect("drive rolling-sphere", "'rolling-sphere' is a scenario: footfall run rolling-sphere");
    expect("drive presliding", "did you mean 'presliding-loop'?");
}

TEST_F(SettingCli, AChangedScenarioRunsAsItsPrintedText) {
    const std::string options =
        " --set time.end=0.3 --set 'body.initial.velocity=[\"1 m/s\", 0.1, 0]' --tolerance 1e-9 "
        "--normal hertz:stiffness=8.3e6 --friction dahl:stiffness=1e4,coefficient=0.4";
    const Result text = footfall("run rolling-sphere --print" + options);
    ASSERT_EQ(text.exit_code, 0) << text.err;
    const std::string file = folder.write("changed.toml", text.out).string();
    const Json changed = run("rolling-sphere" + options);
    EXPECT_EQ(changed, run(file));
    EXPECT_EQ(changed["final"]["time"], 0.3);
    EXPECT_NE(changed, run("rolling-sphere --set time.end=0.3"));
}

TEST_F(SettingCli, TheNetcdfFileHasTheChangedScenario) {
    const std::string file = (folder / "run.nc").string();
    ASSERT_EQ(footfall("run spinning-ball -q --set body.mass=0.2 --set time.end=0.1 -o " + file).exit_code, 0);
    // NetCDF-4 keeps texts as they are.
    EXPECT_TRUE(contains(read_text(file), "# Changed by --set body.mass=0.2 --set time.end=0.1\n"));
}

TEST_F(SettingCli, AForgottenFrictionIsSaid) {
    const std::string said = "No friction: [contact.friction] is not given.";
    EXPECT_TRUE(contains(footfall("run bouncing-sphere").out, said));
    EXPECT_FALSE(contains(footfall("run bouncing-sphere --friction none").out, said));
    EXPECT_FALSE(contains(footfall("run bouncing-sphere --json").out, said));
    folder.write("rig.toml",
                 "[rig]\nend = 1\n[[rig.load]]\nshape = \"constant\"\nvalue = 3\n[contact.normal]\n"
                 "law = \"hertz\"\nstiffness = 1e6\n");
    const std::string rig = "drive " + (folder / "rig.toml").string();
    EXPECT_TRUE(contains(footfall(rig).out, said));
    EXPECT_FALSE(contains(footfall(rig + " --friction none").out, said));
}

TEST_F(SettingCli, ARigIsChangedToo) {
    const auto loops = [&](const std::string& words) {
        const Result result = footfall("drive presliding-loop --json " + words);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return Json::parse(result.out);
    };
    EXPECT_NEAR(loops("--set rig.load[0].value=20N --set rig.end=1")["runs"][0]["largest_normal_force"].get<double>(),
                20, 1e-6);
    EXPECT_TRUE(
        contains(footfall("drive drift --set rig.lod=3").err, "--set rig.lod=3: rig: unknown key 'lod': did you"));
}

TEST_F(SettingCli, OneLawIsDescribed) {
    const std::string page = footfall("laws hertz linear").out;
    for (const char* words : {"\n  hertz\n", "f = max(k z + d zdot, 0)", "f_stick = -k_t u", "Friction laws"})
        EXPECT_TRUE(contains(page, words)) << page;
    EXPECT_FALSE(contains(page, "dahl"));
    EXPECT_FALSE(contains(footfall("laws dahl").out, "Normal laws"));
    const Json json = Json::parse(footfall("laws linear dahl --json").out);
    ASSERT_EQ(json["normal"].size(), 1u);
    ASSERT_EQ(json["friction"].size(), 2u);
    EXPECT_EQ(json["normal"][0]["name"], "linear");
}

}  // namespace
}  // namespace footfall::test
