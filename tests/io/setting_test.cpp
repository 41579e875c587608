// Settings: a scenario or rig changed before it is read, as if its file said so.
#include "footfall/io/setting.hpp"

#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "footfall/io/rig.hpp"
#include "footfall/io/scenario.hpp"

namespace footfall {
namespace {

const std::string ball = R"(
[time]
end = 2.0
[body]
mass = "154 g"
inertia = [1e-5, 1e-5, 1e-5]
[[body.spheres]]
radius = "1.65 cm"
[[body.spheres]]
radius = "1.5 cm"
center = ["5 cm", 0, 0]
[body.spheres.friction]
coefficient = 0.9
[body.spheres.normal]
damping = 10
[body.initial]
position = [0, 0, "10 cm"]
[contact.normal]
law = "azad-featherstone"
stiffness = 8.5e6
damping = 3.1e3
[contact.friction]
law = "azad-featherstone"
stiffness = 12.75e6
damping = 3.1e3
coefficient = 0.2
)";

Setting set(const std::string& text) { return parse_setting(text, "--set " + text); }

Scenario with(const std::vector<std::string>& settings, const std::string& text = ball) {
    std::vector<Setting> all;
    for (const std::string& setting : settings) all.push_back(set(setting));
    return parse_scenario(text, "ball.toml", all);
}

std::string error_with(const std::vector<std::string>& settings) {
    try {
        (void)with(settings);
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "accepted";
}

TEST(Setting, TakesThePlaceOfWhatTheFileSays) {
    const Scenario scenario =
        with({"time.end=3", "body.mass=200 g", "body.spheres[1].radius=2cm", "body.initial.velocity=[1, 0, \"2 mm/s\"]",
              "body.initial.velocity[1]=.5", "body.initial.position[2]=\"11 cm\"", "title=A ball",
              "solver.tolerance=1e-8", "contact.friction.coefficient=0.3"});
    const Simulation& s = scenario.simulation;
    EXPECT_EQ(scenario.title, "A ball");
    EXPECT_EQ(s.options.end_time, 3);
    EXPECT_EQ(s.options.tolerance, 1e-8);
    EXPECT_EQ(s.body.mass, 0.2);
    EXPECT_EQ(s.body.spheres[0].radius, 0.0165);
    EXPECT_EQ(s.body.spheres[1].radius, 0.02);
    EXPECT_EQ(s.initial.velocity, Eigen::Vector3d(1, 0.5, 0.002));
    EXPECT_EQ(s.initial.position.z(), 0.11);
    EXPECT_EQ(std::get<AzadFeatherstoneFriction<>>(s.contacts[0].friction).coefficient, 0.3);
    EXPECT_EQ(std::get<AzadFeatherstoneFriction<>>(s.contacts[1].friction).coefficient, 0.9);
}

TEST(Setting, TheLastOneOfAKeyCounts) { EXPECT_EQ(with({"time.end=3", "time.end=4"}).simulation.options.end_time, 4); }

TEST(Setting, ALawIsThatOfAllSpheres) {
    const Setting normal = normal_law_setting("hertz:stiffness=8.5 MN/m^1.5", "--normal"),
                  friction = friction_law_setting("none", "--friction");
    const Scenario scenario = parse_scenario(ball, "ball.toml", {normal, friction});
    ASSERT_EQ(scenario.simulation.contacts.size(), 2u);
    for (const ContactParameters& contact : scenario.simulation.contacts) {
        EXPECT_EQ(std::get<HertzNormal<>>(contact.normal).stiffness, 8.5e6);
        EXPECT_TRUE(std::holds_alternative<NoFriction<>>(contact.friction));
    }
}

TEST(Setting, ErrorsNameItInPlaceOfALine) {
    EXPECT_EQ(error_with({"time.edn=3"}),
              "--set time.edn=3: time: unknown key 'edn': did you mean 'end'? (keys here: end, sample)");
    EXPECT_EQ(error_with({"body.mass=2 m"}),
              "--set body.mass=2 m: body.mass: expected a mass (kg), got a length (m): '2 m'");
    EXPECT_EQ(error_with({"body.mass=-2"}), "--set body.mass=-2: body.mass: -2 kg is not allowed: must be > 0");
    EXPECT_EQ(error_with({"contact.normal.law=hetrz"})
                  .find("--set contact.normal.law=hetrz: contact.normal.law: "
                        "'hetrz' is not allowed: did you mean 'hertz'?"),
              0u);
    // The file's key that does not fit the setting stays an error of the file.
    EXPECT_NE(error_with({"contact.normal.law=hertz"}).find("ball.toml:21:1: contact.normal: unknown key 'damping'"),
              std::string::npos);
    const std::string sloping = "[ground]\nnormal = [0, 0, 1]\n" + ball;
    EXPECT_THROW((void)with({"ground.slope=10 deg"}, sloping), ScenarioError);
    try {
        (void)with({"ground.slope=10 deg"}, sloping);
    } catch (const ScenarioError& error) {
        EXPECT_EQ(std::string(error.what()), "--set ground.slope=10 deg: ground: give only one of normal, slope");
    }
}

TEST(Setting, ProblemsHaveTheirSetting) {
    try {
        (void)parse_scenario("[time]\nend = -1\n" + ball.substr(ball.find("[body]")), "ball.toml",
                             {set("body.mass=0")});
        FAIL();
    } catch (const ScenarioError& error) {
        ASSERT_EQ(error.problems().size(), 2u);
        EXPECT_EQ(error.problems()[0].setting, "--set body.mass=0");
        EXPECT_EQ(error.problems()[1].setting, "");
        EXPECT_EQ(error.problems()[1].line, 2);
    }
}

TEST(Setting, WhatCannotBePutIsRefused) {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"body.spheres[2].radius=1", "body.spheres has no element 2: it has 2, counted from 0"},
        {"body.spheres.radius=1", "body.spheres is an array, not a table: write body.spheres[0]"},
        {"body.mass.x=1", "body.mass is a string, not a table"},
        {"time[0]=1", "time is a table, not an array"},
        {"body.initial.velocity[0]=1", "there is no body.initial.velocity that an element could be set of"},
        {"body..mass=1", "'body..mass' is not a key"},
        {"body.spheres[x].radius=1", "is not a key"},
        {"body.spheres[0=1", "is not a key"},
        {"body.initial.velocity=[1 m/s, 0, 0]", "the value cannot be read: write an array as in"},
        {"title=\"A ball", "its quotes do not match"},
        {"title=\xff", "not UTF-8"},
        {"body.mass", "expected KEY=VALUE"},
        {"body.mass=", "expected KEY=VALUE"},
        {"=1", "expected KEY=VALUE"},
    };
    std::string deep = "a";
    for (int i = 0; i < 100000; ++i) deep += ".a";
    EXPECT_NE(error_with({deep + "=1"}).find("is not a key"), std::string::npos);
    for (const auto& [setting, why] : cases) {
        const std::string error = error_with({setting});
        EXPECT_EQ(error.find("--set " + setting + ": "), 0u) << error;
        EXPECT_NE(error.find(why), std::string::npos) << error;
    }
}

TEST(Setting, AValueCannotBringFurtherKeys) {
    EXPECT_EQ(with({"title=1\n[time]\nend = 9"}).title, "1\n[time]\nend = 9");
    EXPECT_EQ(with({"title=1\n[time]\nend = 9"}).simulation.options.end_time, 2);
}

TEST(Setting, TheStoredTextIsTheChangedScenario) {
    EXPECT_EQ(with({}).text, ball);
    const Scenario changed = with({"body.mass=200 g", "title=\"Ball \xc2\xb0 \\\"9\\\"\""});
    EXPECT_EQ(changed.text.find("# Changed by --set body.mass=200 g --set title="), 0u) << changed.text;
    const Scenario again = parse_scenario(changed.text);
    EXPECT_EQ(again.title, "Ball \xc2\xb0 \"9\"");
    EXPECT_EQ(again.simulation.body.mass, 0.2);
    EXPECT_EQ(again.simulation.initial.position, changed.simulation.initial.position);
    EXPECT_EQ(with({"body.mass=200 g"}, changed.text).text.find("# Changed by"), 0u);
}

RC_GTEST_PROP(Setting, NumbersInTheStoredTextReadBackExactly, ()) {
    const double value = *rc::gen::map(rc::gen::pair(rc::gen::inRange<long>(1, 1L << 53), rc::gen::inRange(-60, 60)),
                                       [](const auto& pair) { return std::ldexp(pair.first, pair.second - 53); });
    const Scenario changed = with({fmt::format("ground.height={}", -value)});
    RC_ASSERT(changed.simulation.ground.height == -value);
    RC_ASSERT(parse_scenario(changed.text).simulation.ground.height == -value);
}

TEST(Setting, AppliesToARig) {
    const std::string rig =
        "[rig]\nend = 1\n[[rig.load]]\nshape = \"constant\"\nvalue = 3\n"
        "[contact.normal]\nlaw = \"hertz\"\nstiffness = 1e6\n";
    const RigFile file = parse_rig(rig, "rig.toml", {set("rig.end=3 s"), set("rig.load[0].value=20N")});
    EXPECT_EQ(file.rig.end_time, 3);
    EXPECT_TRUE(file.friction_left_out);
    EXPECT_EQ(parse_rig(file.text).rig.end_time, 3);
    EXPECT_EQ(parse_rig(rig).text, rig);
}

TEST(Setting, FrictionIsLeftOutOnlyWhereNothingIsSaidOfIt) {
    const std::string without = ball.substr(0, ball.find("[contact.friction]"));
    std::string plain = without;
    plain.erase(plain.find("[body.spheres.friction]"),
                std::string("[body.spheres.friction]\ncoefficient = 0.9\n").size());
    EXPECT_TRUE(parse_scenario(plain).friction_left_out);
    EXPECT_FALSE(parse_scenario(plain + "[contact.friction]\nlaw = \"none\"\n").friction_left_out);
    EXPECT_FALSE(with({"contact.friction.law=none"}, plain).friction_left_out);
}

}  // namespace
}  // namespace footfall
