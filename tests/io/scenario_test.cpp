#include "footfall/io/scenario.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace footfall {
namespace {

/// A valid scenario; the tests change single lines of it, which are numbered here.
const std::vector<std::string> base{
    /*  1 */ "title = 'ball'",
    /*  2 */ "[time]",
    /*  3 */ "end = 2.0",
    /*  4 */ "sample = '1 ms'",
    /*  5 */ "[solver]",
    /*  6 */ "tolerance = 1e-9",
    /*  7 */ "[ground]",
    /*  8 */ "normal = [0, 0, 2]",
    /*  9 */ "height = '1 cm'",
    /* 10 */ "[body]",
    /* 11 */ "mass = '154 g'",
    /* 12 */ "inertia = 'solid-sphere'",
    /* 13 */ "[[body.spheres]]",
    /* 14 */ "radius = '1.65 cm'",
    /* 15 */ "[body.initial]",
    /* 16 */ "position = [0, 0, '10 cm']",
    /* 17 */ "velocity = [0.5, '50 cm/s', 0]",
    /* 18 */ "[contact.normal]",
    /* 19 */ "law = 'azad-featherstone'",
    /* 20 */ "stiffness = 8.5e6",
    /* 21 */ "damping = 3.1e3",
    /* 22 */ "[contact.friction]",
    /* 23 */ "law = 'azad-featherstone'",
    /* 24 */ "stiffness = '12.75e6 N/m^1.5'",
    /* 25 */ "damping = 3.1e3",
    /* 26 */ "coefficient = 0.2",
};

/// The base with some lines (from 1) replaced.
std::string changed(const std::vector<std::pair<std::size_t, std::string>>& changes = {}) {
    std::vector<std::string> lines = base;
    for (const auto& [line, text] : changes) lines.at(line - 1) = text;
    std::string all;
    for (const std::string& line : lines) all += line + '\n';
    return all;
}

Simulation simulation_of(const std::string& text) { return parse_scenario(text).simulation; }

std::vector<ScenarioProblem> problems_of(const std::string& text) {
    try {
        (void)parse_scenario(text, "ball.toml");
    } catch (const ScenarioError& error) {
        return error.problems();
    }
    ADD_FAILURE() << "accepted:\n" << text;
    return {};
}

/// There is one problem, at this place, and its message contains each of `parts`.
void expect_problem(const std::string& text, int line, int column, const std::vector<std::string>& parts) {
    const auto problems = problems_of(text);
    ASSERT_EQ(problems.size(), 1u) << (problems.empty() ? "" : problems[1].message);
    EXPECT_EQ(problems[0].line, line) << problems[0].message;
    EXPECT_EQ(problems[0].column, column) << problems[0].message;
    for (const std::string& part : parts) {
        EXPECT_NE(problems[0].message.find(part), std::string::npos) << problems[0].message << "\nlacks: " << part;
    }
}

// What is read
// ----------------------------------------------------------------------------------------------------------

TEST(Scenario, ReadsEveryFieldInSiUnits) {
    const Scenario scenario = parse_scenario(changed());
    const Simulation& s = scenario.simulation;
    EXPECT_EQ(scenario.title, "ball");
    EXPECT_EQ(scenario.text, changed());
    EXPECT_EQ(s.options.end_time, 2);
    EXPECT_EQ(s.options.sample_period, 0.001);
    EXPECT_EQ(s.options.tolerance, 1e-9);
    EXPECT_EQ(s.ground.normal, Eigen::Vector3d(0, 0, 1));
    EXPECT_EQ(s.ground.height, 0.01);
    EXPECT_EQ(s.body.mass, 0.154);
    ASSERT_EQ(s.body.spheres.size(), 1u);
    EXPECT_EQ(s.body.spheres[0].radius, 0.0165);
    EXPECT_EQ(s.body.spheres[0].center, Eigen::Vector3d(0, 0, 0));
    // 2/5 0.154 0.0165^2 = 1.67706e-5
    EXPECT_NEAR(s.body.inertia(0, 0), 1.67706e-5, 1e-18);
    EXPECT_EQ(s.initial.position, Eigen::Vector3d(0, 0, 0.1));
    EXPECT_EQ(s.initial.velocity, Eigen::Vector3d(0.5, 0.5, 0));
    ASSERT_EQ(s.contacts.size(), 1u);
    const auto& normal = std::get<AzadFeatherstoneNormal<>>(s.contacts[0].normal);
    EXPECT_EQ(normal.stiffness, 8.5e6);
    EXPECT_EQ(normal.damping, 3.1e3);
    const auto& friction = std::get<AzadFeatherstoneFriction<>>(s.contacts[0].friction);
    EXPECT_EQ(friction.stiffness, 12.75e6);
    EXPECT_EQ(friction.damping, 3.1e3);
    EXPECT_EQ(friction.coefficient, 0.2);
}

TEST(Scenario, HasTheDocumentedDefaults) {
    const Simulation s = simulation_of(
        "time.end = 2\n"
        "body = {mass = 1, inertia = [1, 1, 1], spheres = [{radius = 0.1}], initial = {position = [0, 0, 1]}}\n"
        "contact.normal = {law = 'linear', stiffness = 1, damping = 0}\n");
    EXPECT_EQ(s.options.sample_period, 0.002);
    EXPECT_EQ(s.options.tolerance, 1e-10);
    EXPECT_EQ(s.options.max_evaluations, 1e8);
    EXPECT_FALSE(s.options.allow_initial_penetration);
    EXPECT_EQ(s.gravity, Eigen::Vector3d(0, 0, -9.81));
    EXPECT_EQ(s.ground.normal, Eigen::Vector3d(0, 0, 1));
    EXPECT_EQ(s.ground.height, 0);
    EXPECT_EQ(s.initial.velocity, Eigen::Vector3d(0, 0, 0));
    EXPECT_EQ(s.initial.angular_velocity, Eigen::Vector3d(0, 0, 0));
    EXPECT_TRUE(s.initial.orientation.isApprox(Eigen::Quaterniond::Identity(), 0));
    EXPECT_TRUE(std::holds_alternative<NoFriction<>>(s.contacts.at(0).friction));
}

TEST(Scenario, ReadsEachFormOfInertia) {
    EXPECT_NEAR(simulation_of(changed({{12, "inertia = 'hollow-sphere'"}})).body.inertia(2, 2), 2.7951e-5, 1e-18);
    const Eigen::Matrix3d moments = simulation_of(changed({{12, "inertia = ['3e4 g cm^2', 4e-3, 5e-3]"}})).body.inertia;
    EXPECT_TRUE(moments.isApprox(Eigen::Vector3d(3e-3, 4e-3, 5e-3).asDiagonal().toDenseMatrix(), 1e-15));
    const Eigen::Matrix3d tensor =
        simulation_of(changed({{12, "inertia = [[3, 0.1, 0.2], [0.1, 4, '0.3 kg m^2'], [0.2, 0.3, 5]]"}})).body.inertia;
    Eigen::Matrix3d expected;
    expected << 3, 0.1, 0.2, 0.1, 4, 0.3, 0.2, 0.3, 5;
    EXPECT_EQ(tensor, expected);
}

TEST(Scenario, AcceptsTheInertiaOfAFlatPlateAndOfATinyBody) {
    EXPECT_NO_THROW((void)simulation_of(changed({{12, "inertia = [0.1, 0.2, 0.3]"}})));
    EXPECT_NO_THROW((void)simulation_of(changed({{12, "inertia = [1e-200, 1e-200, 1e-200]"}})));
}

TEST(Scenario, NormalisesAnAlmostUnitQuaternion) {
    const auto q = simulation_of(changed({{17, "orientation = [0.7071068, 0, 0.7071068, 0]"}})).initial.orientation;
    EXPECT_NEAR(q.norm(), 1, 1e-15);
    EXPECT_NEAR(q.y(), std::sqrt(0.5), 1e-15);
}

TEST(Scenario, TurnsTheBodyAboutTheAxis) {
    const auto q =
        simulation_of(changed({{17, "rotation = {axis = [0, 3, 0], angle = '90 deg'}"}})).initial.orientation;
    // A right-handed quarter turn about y takes x to -z.
    EXPECT_TRUE((q * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d(0, 0, -1), 1e-15));
}

TEST(Scenario, TiltsTheGroundTowardsPositiveX) {
    const Ground ground = simulation_of(changed({{8, "slope = '30 deg'"}, {9, ""}})).ground;
    EXPECT_NEAR(ground.normal.x(), 0.5, 1e-15);
    EXPECT_EQ(ground.normal.y(), 0);
    EXPECT_NEAR(ground.normal.z(), 0.86602540378443865, 1e-15);
}

TEST(Scenario, ReadsTheExponentsOfHuntAndCrossley) {
    const auto law = std::get<HuntCrossleyNormal<>>(
        simulation_of(changed({{19, "law = 'hunt-crossley'\np = 1"}})).contacts.at(0).normal);
    EXPECT_EQ(law.n, 1.5);
    EXPECT_EQ(law.p, 1);
    EXPECT_EQ(law.q, 1);
}

TEST(Scenario, GivesASphereItsOwnParameters) {
    const Simulation s = simulation_of(changed({{12, "inertia = [1, 1, 1]"},
                                                {13,
                                                 "[[body.spheres]]\nradius = 0.02\n"
                                                 "normal.damping = 0\nfriction = {coefficient = 0.9}\n"
                                                 "[[body.spheres]]"}}));
    ASSERT_EQ(s.contacts.size(), 2u);
    const auto normal = [&s](std::size_t i) { return std::get<AzadFeatherstoneNormal<>>(s.contacts[i].normal); };
    const auto friction = [&s](std::size_t i) { return std::get<AzadFeatherstoneFriction<>>(s.contacts[i].friction); };
    EXPECT_EQ(normal(0).stiffness, 8.5e6);
    EXPECT_EQ(normal(0).damping, 0);
    EXPECT_EQ(normal(1).damping, 3.1e3);
    EXPECT_EQ(friction(0).coefficient, 0.9);
    EXPECT_EQ(friction(0).stiffness, 12.75e6);
    EXPECT_EQ(friction(1).coefficient, 0.2);
}

/// The base with materials: E* = 16 MPa / 3 * 2 for two equal sides of E = 16 MPa, nu = 0.5 (1 - nu^2 = 3/4).
std::string with_material(const std::string& damping) {
    return changed({{14, "radius = 0.04"},
                    {20, ""},
                    {21, ""},
                    {24, ""},
                    {25, ""},
                    {26, "coefficient = 0.2\n[contact.material]\n" + damping +
                             "\n[contact.material.sphere]\nyoungs_modulus = '16 MPa'\npoisson_ratio = 0.5\n"
                             "[contact.material.ground]\nyoungs_modulus = 16e6\npoisson_ratio = 0.5\n"}});
}

TEST(Scenario, TakesTheCoefficientsFromMaterials) {
    // 1/E* = 2 (3/4) / 16e6, E* = 32e6/3; sqrt(r) = 0.2: K_n = 4/3 E* 0.2 = 2.8444e6, K_t = 2 E* 0.2 = 4.2667e6.
    // alpha = 1000: D = 4 pi 0.04 1000 = 502.65.
    const Simulation s = simulation_of(with_material("damping_coefficient = 1000"));
    const auto& normal = std::get<AzadFeatherstoneNormal<>>(s.contacts.at(0).normal);
    const auto& friction = std::get<AzadFeatherstoneFriction<>>(s.contacts.at(0).friction);
    EXPECT_NEAR(normal.stiffness, 2844444.4444444, 1e-6);
    EXPECT_NEAR(normal.damping, 502.65482457437, 1e-10);
    EXPECT_NEAR(friction.stiffness, 4266666.6666667, 1e-6);
    EXPECT_NEAR(friction.damping, 502.65482457437, 1e-10);
    EXPECT_EQ(friction.coefficient, 0.2);
}

TEST(Scenario, GivesThePassiveLawTheSameCoefficientsFromMaterials) {
    std::string text = with_material("damping_coefficient = 1000");
    const std::string paper = "friction]\nlaw = 'azad-featherstone'";
    ASSERT_NE(text.find(paper), std::string::npos) << text;
    text.replace(text.find(paper), paper.size(), "friction]\nlaw = 'azad-featherstone-passive'");
    const Simulation s = simulation_of(text);
    const auto& friction = std::get<AzadFeatherstonePassiveFriction<>>(s.contacts.at(0).friction);
    EXPECT_NEAR(friction.stiffness, 4266666.6666667, 1e-6);
    EXPECT_NEAR(friction.damping, 502.65482457437, 1e-10);
    EXPECT_EQ(friction.coefficient, 0.2);
}

TEST(Scenario, TakesTheDampingFromADampingTime) {
    // D_t = tau K_t: 4.2667e6 N/m^1.5 * 1 ms.
    const Simulation s = simulation_of(with_material("damping_time = '1 ms'"));
    EXPECT_NEAR(std::get<AzadFeatherstoneNormal<>>(s.contacts.at(0).normal).damping, 4266.6666666667, 1e-9);
    EXPECT_NEAR(std::get<AzadFeatherstoneFriction<>>(s.contacts.at(0).friction).damping, 4266.6666666667, 1e-9);
}

TEST(Scenario, StartsABallExactlyOnTheGround) {
    EXPECT_NO_THROW((void)simulation_of(changed({{9, "height = 0"}, {16, "position = [0, 0, '1.65 cm']"}})));
}

TEST(Scenario, AllowsInitialPenetrationWhereAsked) {
    const Simulation s = simulation_of(
        changed({{16, "position = [0, 0, 0.026]"}, {18, "[contact]\nallow_initial_penetration = true\n" + base[17]}}));
    EXPECT_TRUE(s.options.allow_initial_penetration);
}

// What is refused, and where
// --------------------------------------------------------------------------------------------

TEST(ScenarioErrors, BeginWithFileLineAndColumn) {
    try {
        (void)parse_scenario(changed({{11, "mass = -1"}}), "dir/ball.toml");
        FAIL();
    } catch (const ScenarioError& error) {
        EXPECT_EQ(std::string(error.what()), "dir/ball.toml:11:8: body.mass: -1 kg is not allowed: must be > 0");
    }
}

TEST(ScenarioErrors, MisspeltKeyNamesTheNearestAndTheValidOnes) {
    expect_problem(changed({{20, "stifness = 8.5e6"}}), 20, 1,
                   {"contact.normal: unknown key 'stifness'", "did you mean 'stiffness'?",
                    "(keys here: law, stiffness, damping)"});
    expect_problem(changed({{14, "raduis = '1.65 cm'"}}), 14, 1, {"body.spheres[0]", "did you mean 'radius'?"});
    expect_problem(changed({{5, "[sovler]"}}), 5, 2, {"unknown key 'sovler'", "did you mean 'solver'?"});
    expect_problem(changed({{6, "  viscosity = 3"}}), 6, 3, {"unknown key 'viscosity' (keys here: tolerance, "});
}

TEST(ScenarioErrors, KeyOfAnotherLawIsUnknown) {
    expect_problem(changed({{21, "damping = 0\nn = 1.5"}}), 22, 1, {"contact.normal: unknown key 'n'"});
    expect_problem(changed({{23, "law = 'none'"}, {25, ""}, {26, ""}}), 24, 1, {"contact.friction: unknown key"});
}

TEST(ScenarioErrors, MissingKeySaysWhatItIsWithAnExample) {
    expect_problem(changed({{11, ""}}), 10, 1, {"body: 'mass' is missing", "(kg)", "for example: mass = \"154 g\""});
    expect_problem(changed({{19, ""}}), 18, 1, {"contact.normal: 'law' is missing", "hunt-crossley"});
    expect_problem(changed({{21, ""}}), 18, 1, {"'damping' is missing: D_n, normal damping", "(N s/m^1.5)"});
    expect_problem(changed({{14, ""}}), 13, 1, {"body.spheres[0]: 'radius' is missing"});
    expect_problem(changed({{2, ""}, {3, ""}, {4, ""}}), 1, 1, {"the table [time] is missing"});
}

TEST(ScenarioErrors, BodyNeedsASphere) {
    expect_problem(changed({{13, ""}, {14, ""}}), 10, 1, {"[[body.spheres]] is missing"});
    expect_problem(changed({{13, "spheres = []"}, {14, ""}}), 13, 11, {"body.spheres: at least one is needed"});
    expect_problem(changed({{13, "[body.spheres]"}}), 13, 1,
                   {"expected an array of tables, got a table: write [[body.spheres]]"});
}

TEST(ScenarioErrors, WrongTypeSaysWhatWasExpected) {
    expect_problem(changed({{11, "mass = true"}}), 11, 8, {"body.mass: expected a mass (kg)", "got a boolean"});
    expect_problem(changed({{1, "title = 3"}}), 1, 9, {"title: expected a string, got an integer"});
    expect_problem(changed({{16, "position = 3"}}), 16, 12, {"expected an array of 3 numbers, got an integer"});
    expect_problem(changed({{16, "position = [0, 1]"}}), 16, 12, {"expected 3 numbers, got 2"});
    expect_problem(changed({{16, "position = [0, [], 1]"}}), 16, 16, {"position[1]: expected a length (m)"});
    expect_problem(changed({{5, "solver = 3"}, {6, ""}, {1, ""}, {2, ""}, {3, "time.end = 1"}, {4, ""}}), 5, 10,
                   {"solver: expected a table, got an integer"});
    expect_problem(changed({{12, "inertia = 1"}}), 12, 11, {"body.inertia: expected one of solid-sphere"});
    expect_problem(changed({{18, "[contact]\nallow_initial_penetration = 1\n[contact.normal]"}}), 19, 29,
                   {"expected true or false, got an integer"});
}

TEST(ScenarioErrors, WrongDimensionSaysWhatWasExpected) {
    expect_problem(changed({{14, "radius = '1.65 kg'"}}), 14, 10, {"expected a length (m), got a mass (kg)"});
    expect_problem(changed({{17, "velocity = [0, '1 m', 0]"}}), 17, 16,
                   {"velocity[1]: expected a velocity (m/s), got a length (m)"});
    expect_problem(changed({{17, "angular_velocity = ['12 Hz', 0, 0]"}}), 17, 21, {"an angular velocity (rad/s)"});
    expect_problem(changed({{24, "stiffness = '1 N/m'"}}), 24, 13, {"expected a nonlinear stiffness (N/m^1.5)"});
    expect_problem(changed({{14, "radius = '1.65 furlong'"}}), 14, 10, {"unknown unit 'furlong'"});
}

TEST(ScenarioErrors, UnitThatDependsOnExponentsIsRefused) {
    expect_problem(changed({{19, "law = 'hunt-crossley'"}, {20, "stiffness = '1 N/m^1.5'"}}), 20, 13,
                   {"expected a plain number (its unit, N/m^n, depends on other keys), got a string"});
}

TEST(ScenarioErrors, NumbersMustBeFinite) {
    expect_problem(changed({{11, "mass = nan"}}), 11, 8, {"body.mass: nan is not allowed: must be a finite number"});
    expect_problem(changed({{3, "end = inf"}}), 3, 7, {"must be a finite number"});
    expect_problem(changed({{16, "position = [0, 0, -inf]"}}), 16, 19, {"position[2]: -inf"});
}

TEST(ScenarioErrors, RangesAreKept) {
    expect_problem(changed({{11, "mass = '-154 g'"}}), 11, 8, {"(-0.154 kg) is not allowed: must be > 0"});
    expect_problem(changed({{14, "radius = 0"}}), 14, 10, {"radius: 0 m is not allowed: must be > 0"});
    expect_problem(changed({{3, "end = 0"}}), 3, 7, {"time.end"});
    expect_problem(changed({{4, "sample = -1"}}), 4, 10, {"time.sample", "must be >= 0"});
    expect_problem(changed({{6, "tolerance = 1e-15"}}), 6, 13, {"must be from 1e-14 to 0.001"});
    expect_problem(changed({{6, "tolerance = 0.01"}}), 6, 13, {"must be from 1e-14 to 0.001"});
    expect_problem(changed({{20, "stiffness = 0"}}), 20, 13, {"0 N/m^1.5 is not allowed: must be > 0"});
    const auto restitution = [](const char* value) {
        return changed({{19, "law = 'flores'"}, {21, std::string("restitution = ") + value}});
    };
    EXPECT_NO_THROW((void)simulation_of(restitution("1")));
    for (const char* value : {"1.01", "0.0", "-0.5"})
        expect_problem(restitution(value), 21, 15, {"contact.normal.restitution", "must be > 0 and <= 1"});
    expect_problem(changed({{26, "coefficient = -0.1"}}), 26, 15, {"coefficient: -0.1 is not allowed: must be >= 0"});
    expect_problem(changed({{8, "normal = [0, 0, 0]"}}), 8, 10, {"ground.normal: a zero vector is not allowed"});
    expect_problem(changed({{8, "slope = '91 deg'"}}), 8, 9, {"ground.slope"});
}

/// The names of the registry in its order, as in a sentence.
template <class Variant>
std::string all_names() {
    std::string names;
    for_each_law<Variant>(
        [&](const auto& law) { names += (names.empty() ? "" : ", ") + std::string(law.description.name); });
    return names;
}

TEST(ScenarioErrors, UnknownLawNamesTheNearestAndAll) {
    expect_problem(changed({{19, "law = 'azad-feathrstone'"}}), 19, 7,
                   {"contact.normal.law: 'azad-feathrstone' is not allowed: did you mean 'azad-featherstone'?",
                    "(one of " + all_names<NormalLaw>() + ")"});
    expect_problem(changed({{23, "law = 'lugree'"}}), 23, 7,
                   {"contact.friction.law: 'lugree' is not allowed: did you mean 'lugre'?",
                    "(one of " + all_names<FrictionLaw>() + ")"});
}

TEST(ScenarioErrors, UnknownLawMakesNoErrorsOfItsParameters) {
    expect_problem(changed({{14, "radius = 0.01\nnormal.damping = 3"}, {19, "law = 'azad'"}}), 20, 7, {"'azad'"});
}

TEST(ScenarioErrors, InertiaThatNoBodyCanHaveIsRefused) {
    expect_problem(changed({{12, "inertia = 'solid-spere'"}}), 12, 11, {"did you mean 'solid-sphere'?"});
    expect_problem(changed({{12, "inertia = [1, -1, 1]"}}), 12, 15, {"inertia[1]: -1 kg m^2"});
    expect_problem(changed({{12, "inertia = [1, 1, 2.1]"}}), 12, 11, {"above the sum of the other two"});
    expect_problem(changed({{12, "inertia = [[1, 0, 0], [0.1, 1, 0], [0, 0, 1]]"}}), 12, 11, {"not symmetric"});
    expect_problem(changed({{12, "inertia = [[1, 2, 0], [2, 1, 0], [0, 0, 1]]"}}), 12, 11, {"-1", "must be > 0"});
    expect_problem(changed({{12, "inertia = [[0, 0, 0], [0, 0, 0], [0, 0, 0]]"}}), 12, 11, {"zero"});
    expect_problem(changed({{12, "inertia = [[1, 0, 0], [0, 1, 0]]"}}), 12, 11, {"a 3x3 array"});
    expect_problem(changed({{12, "inertia = [[1, 0, 0], [0, 1], [0, 0, 1]]"}}), 12, 23, {"expected 3 numbers, got 2"});
}

TEST(ScenarioErrors, SphereInertiaIsForOneSphereAtTheCentre) {
    expect_problem(changed({{14, "radius = 0.01\ncenter = [0, 0, 1e-3]"}}), 12, 11,
                   {"'solid-sphere' is for a body of one sphere at its centre"});
    expect_problem(changed({{14, "radius = 0.01\n[[body.spheres]]\nradius = 0.02"}}), 12, 11, {"of one sphere"});
}

TEST(ScenarioErrors, QuaternionMustBeAUnit) {
    expect_problem(changed({{17, "orientation = [1, 1, 0, 0]"}}), 17, 15, {"length 1.41421", "must be 1"});
    expect_problem(changed({{17, "orientation = [0, 0, 0, 0]"}}), 17, 15, {"zero vector"});
    expect_problem(changed({{17, "orientation = [1, 0, 0]"}}), 17, 15, {"expected 4 numbers, got 3"});
}

TEST(ScenarioErrors, AlternativesCannotBothBeGiven) {
    expect_problem(changed({{9, "slope = 0.1"}}), 9, 1, {"ground: give only one of normal, slope"});
    expect_problem(changed({{17, "rotation = {axis = [0, 0, 1], angle = 1}\norientation = [1, 0, 0, 0]"}}), 18, 1,
                   {"body.initial: give only one of orientation, rotation"});
}

TEST(ScenarioErrors, InitialPenetrationIsRefused) {
    // The ground is at 1 cm, so the bottom of the sphere is 0.5 mm in it.
    expect_problem(changed({{16, "position = [0, 0, 0.026]"}}), 16, 12,
                   {"sphere 0 starts 0.0005 m in the ground", "allow_initial_penetration"});
}

TEST(ScenarioErrors, SphereCannotHaveALawOfItsOwn) {
    expect_problem(changed({{14, "radius = 0.01\nnormal.law = 'linear'"}}), 15, 8,
                   {"body.spheres[0].normal.law: all spheres have the law of [contact.normal]"});
    expect_problem(changed({{14, "radius = 0.01\nfriction.coeff = 1"}}), 15, 10,
                   {"body.spheres[0].friction: unknown key 'coeff'"});
    expect_problem(changed({{14, "radius = 0.01\nfriction.coefficient = -1"}}), 15, 24, {"must be >= 0"});
}

TEST(ScenarioErrors, SphereHasNoFrictionParametersWhereThereIsNoFriction) {
    expect_problem(
        changed({{14, "radius = 0.01\nfriction.coefficient = 1"}, {22, ""}, {23, ""}, {24, ""}, {25, ""}, {26, ""}}),
        15, 10, {"[contact.friction] has the law 'none', which has no parameters"});
}

TEST(ScenarioErrors, MaterialsReplaceTheCoefficients) {
    const std::string good = with_material("damping_time = 1e-3");
    EXPECT_NO_THROW((void)parse_scenario(good));
    const auto replaced = [&good](const std::string& from, const std::string& to) {
        std::string text = good;
        return text.replace(text.find(from), from.size(), to);
    };
    expect_problem(replaced("[contact.friction]", "damping = 1\n[contact.friction]"), 22, 1,
                   {"contact.normal.damping: [contact.material] gives this coefficient"});
    expect_problem(replaced("radius = 0.04", "radius = 0.04\nnormal.stiffness = 3"), 15, 8,
                   {"[contact.material] gives this coefficient"});
    expect_problem(replaced("law = 'azad-featherstone'", "law = 'hunt-crossley'"), 19, 7,
                   {"(with [contact.material], one of azad-featherstone)"});
    expect_problem(replaced("damping_time = 1e-3", ""), 27, 1, {"one of damping_coefficient, damping_time is missing"});
    expect_problem(replaced("damping_time = 1e-3", "damping_time = 1\ndamping_coefficient = 1"), 29, 1,
                   {"give only one of"});
    expect_problem(replaced("poisson_ratio = 0.5", "poisson_ratio = 0.6"), 31, 17, {"must be > -1 and <= 0.5"});
}

TEST(ScenarioErrors, AllAreReportedInTheOrderOfTheFile) {
    const auto problems = problems_of(changed({{3, "ende = 1"},
                                               {6, "tolerance = 1"},
                                               {11, "mass = -1"},
                                               {12, "inertia = 'solid-sphere'\ncolour = 'red'"},
                                               {20, "stiffness = 'x'"}}));
    ASSERT_EQ(problems.size(), 5u);
    EXPECT_EQ(problems[0].line, 3);
    EXPECT_EQ(problems[1].line, 6);
    EXPECT_EQ(problems[2].line, 11);
    EXPECT_EQ(problems[3].line, 13);
    EXPECT_EQ(problems[4].line, 21);
}

TEST(ScenarioErrors, ColumnsCountCharactersNotBytes) {
    expect_problem(changed({{17, "velocity = ['1 \u00b5m/s', '1 \u00b5m', 0]"}}), 17, 23,
                   {"expected a velocity (m/s)"});
}

RC_GTEST_PROP(ScenarioErrors, AnyDamageIsReadOrRefusedWithItsPlace, ()) {
    std::string text = changed();
    const int damages = *rc::gen::inRange(1, 4);
    for (int i = 0; i < damages; ++i) {
        const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
        const auto length = *rc::gen::inRange<std::size_t>(0, 12);
        const std::string letters = "0123456789.eE+-'[]{}=,\n abcdefgx_#\x01";
        text.replace(at, length, *rc::gen::container<std::string>(rc::gen::elementOf(letters)));
    }
    try {
        (void)parse_scenario(text);
    } catch (const ScenarioError& error) {
        RC_ASSERT(!error.problems().empty());
        RC_ASSERT(error.problems().front().line >= 1);
        RC_ASSERT(error.problems().front().column >= 1);
    }
}

// Files
// -------------------------------------------------------------------------------------------------------------------

TEST(LoadScenario, NamesTheFileInItsErrors) {
    const auto file = std::filesystem::path(testing::TempDir()) / "footfall_scenario_test.toml";
    std::ofstream(file) << changed({{11, "mass = -1"}});
    try {
        (void)load_scenario(file);
        FAIL();
    } catch (const ScenarioError& error) {
        EXPECT_EQ(std::string(error.what()).find(file.string() + ":11:8: "), 0u) << error.what();
    }
    std::filesystem::remove(file);
}

TEST(LoadScenario, SaysWhyAFileCannotBeRead) {
    try {
        (void)load_scenario("/nonexistent/ball.toml");
        FAIL();
    } catch (const std::system_error& error) {
        EXPECT_EQ(error.code(), std::errc::no_such_file_or_directory);
        EXPECT_NE(std::string(error.what()).find("/nonexistent/ball.toml"), std::string::npos);
    }
    EXPECT_THROW((void)load_scenario(testing::TempDir()), std::system_error);
}

// Angles --------------------------------------------------------------------------------------------------------------

TEST(Scenario, AnAngleMeantInDegreesIsRefusedWithTheMend) {
    expect_problem(changed({{8, "slope = 10"}}), 8, 9,
                   {"ground.slope: 10 rad is not allowed: must be from -1.5708 rad to 1.5708 rad",
                    "; for degrees write \"10 deg\""});
    expect_problem(changed({{17, "rotation = {axis = [0, 1, 0], angle = -90}"}}), 17, 39,
                   {"body.initial.rotation.angle: -90 rad is more than a turn; for degrees write \"-90 deg\", or "
                    "\"-90 rad\" where that is meant"});
}

TEST(Scenario, AnAngleOfSeveralTurnsIsReadWhereItsUnitIsSaid) {
    const auto angle = [](const std::string& written) {
        const Simulation s = simulation_of(changed({{17, "rotation = {axis = [0, 0, 1], angle = " + written + "}"}}));
        return 2 * std::atan2(s.initial.orientation.z(), s.initial.orientation.w());
    };
    const auto turns_apart = [](double a, double b) { return std::remainder(a - b, 2 * 3.14159265358979323846); };
    EXPECT_NEAR(turns_apart(angle("'7 rad'"), 7), 0, 1e-14);
    EXPECT_NEAR(turns_apart(angle("'720.5 deg'"), angle("'0.5 deg'")), 0, 1e-14);
    EXPECT_NEAR(turns_apart(angle("6.25"), 6.25), 0, 1e-14);
}

TEST(Scenario, AQuantityOutOfRangeIsSaidAsItWasWritten) {
    expect_problem(changed({{8, "slope = '100 deg'"}}), 8, 9, {"ground.slope: '100 deg' (1.74533 rad) is not allowed"});
    expect_problem(changed({{14, "radius = '-2 cm'"}}), 14, 10, {"'-2 cm' (-0.02 m) is not allowed: must be > 0"});
}

}  // namespace
}  // namespace footfall
