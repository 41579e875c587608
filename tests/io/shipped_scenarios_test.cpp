#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "footfall/io/scenario.hpp"

namespace footfall {
namespace {

const std::filesystem::path folder = FOOTFALL_SOURCE_DIR "/scenarios";

Simulation shipped(const std::string& name) { return load_scenario(folder / (name + ".toml")).simulation; }

/// How far the lowest sphere is above the ground at the start [m].
double gap(const Simulation& s) {
    double lowest = INFINITY;
    for (const Sphere& sphere : s.body.spheres) {
        const Eigen::Vector3d center = s.initial.position + s.initial.orientation * sphere.center;
        lowest = std::min(lowest, s.ground.normal.dot(center) - s.ground.height - sphere.radius);
    }
    return lowest;
}

TEST(ShippedScenarios, AreAllThereAndLoad) {
    std::set<std::string> missing{"rolling-sphere",  "bouncing-sphere",   "single-impact", "single-impact-classical",
                                  "foot-heel-first", "slope-stick",       "slope-slide",   "slope-block-stick",
                                  "spinning-ball",   "slope-block-slide", "resting-ball"};
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.is_directory()) continue;  // the rigs of footfall drive
        missing.erase(entry.path().stem().string());
        try {
            const Scenario scenario = load_scenario(entry.path());
            EXPECT_FALSE(scenario.title.empty()) << entry.path();
            EXPECT_EQ(scenario.text.substr(0, 2), "# ") << entry.path() << " does not begin by saying what it shows";
        } catch (const std::exception& error) {
            ADD_FAILURE() << error.what();
        }
    }
    EXPECT_TRUE(missing.empty()) << *missing.begin();
}

TEST(ShippedScenarios, RollingSphereHasThePapersNumbers) {
    // Azad & Featherstone 2010, section 4.
    const Simulation s = shipped("rolling-sphere");
    EXPECT_EQ(s.options.end_time, 1);
    EXPECT_EQ(s.options.sample_period, 1e-4);
    EXPECT_EQ(s.options.tolerance, 1e-12);
    EXPECT_EQ(s.gravity, Eigen::Vector3d(0, 0, -9.81));
    EXPECT_EQ(s.body.mass, 0.154);
    ASSERT_EQ(s.body.spheres.size(), 1u);
    EXPECT_EQ(s.body.spheres[0].radius, 0.0165);
    EXPECT_EQ(s.initial.position, Eigen::Vector3d(0, 0, 0.1));
    EXPECT_EQ(s.initial.velocity, Eigen::Vector3d(0.5, 0.5, 0));
    EXPECT_EQ(s.initial.angular_velocity, Eigen::Vector3d(0, 0, 0));
    const auto& normal = std::get<AzadFeatherstoneNormal<>>(s.contacts.at(0).normal);
    EXPECT_EQ(normal.stiffness, 8.5e6);
    EXPECT_EQ(normal.damping, 3.1e3);
    const auto& friction = std::get<AzadFeatherstoneFriction<>>(s.contacts.at(0).friction);
    EXPECT_EQ(friction.stiffness, 12.75e6);
    EXPECT_EQ(friction.damping, 3.1e3);
    EXPECT_EQ(friction.coefficient, 0.2);
    EXPECT_EQ(friction.viscous, 0.1);
}

TEST(ShippedScenarios, BouncingSphereStartsAtRestTenCentimetresUp) {
    const Simulation s = shipped("bouncing-sphere");
    EXPECT_NEAR(gap(s), 0.1, 1e-16);
    EXPECT_EQ(s.initial.velocity, Eigen::Vector3d(0, 0, 0));
}

TEST(ShippedScenarios, SingleImpactsHaveTheNumbersOfFigures6And7) {
    for (const char* name : {"single-impact", "single-impact-classical"}) {
        const Simulation s = shipped(name);
        EXPECT_EQ(s.gravity, Eigen::Vector3d(0, 0, 0));
        EXPECT_EQ(s.initial.velocity, Eigen::Vector3d(0, 0, -1));
        EXPECT_EQ(s.body.mass, 0.154);
        EXPECT_EQ(s.body.spheres.at(0).radius, 0.0165);
    }
    const auto classical = std::get<HuntCrossleyNormal<>>(shipped("single-impact-classical").contacts.at(0).normal);
    EXPECT_EQ(classical.stiffness, 8.5e6);
    EXPECT_EQ(classical.damping, 3.1e6);
    const auto paper = std::get<AzadFeatherstoneNormal<>>(shipped("single-impact").contacts.at(0).normal);
    EXPECT_EQ(paper.stiffness, 8.5e6);
    EXPECT_EQ(paper.damping, 3.1e3);
}

TEST(ShippedScenarios, RestingBallStartsExactlyOnTheGround) { EXPECT_EQ(gap(shipped("resting-ball")), 0); }

TEST(ShippedScenarios, SlopesStartJustAboveTheGround) {
    for (const char* name : {"slope-stick", "slope-slide", "slope-block-stick", "slope-block-slide"}) {
        EXPECT_NEAR(gap(shipped(name)), 1e-5, 1e-8) << name;
    }
}

TEST(ShippedScenarios, SlopesAreBelowAndAboveTheStickingAngle) {
    const auto steepness = [](const std::string& name) {
        const Simulation s = shipped(name);
        const double mu = std::get<AzadFeatherstoneFriction<>>(s.contacts.at(0).friction).coefficient;
        return s.ground.normal.x() / s.ground.normal.z() / mu;
    };
    // A block sticks up to tan = mu, a rolling solid sphere up to tan = 7/2 mu.
    EXPECT_LT(steepness("slope-block-stick"), 1);
    EXPECT_GT(steepness("slope-block-slide"), 1);
    EXPECT_LT(steepness("slope-stick"), 3.5);
    EXPECT_GT(steepness("slope-slide"), 3.5);
}

TEST(ShippedScenarios, FootComesDownHeelFirst) {
    const Simulation s = shipped("foot-heel-first");
    ASSERT_EQ(s.body.spheres.size(), 4u);
    const auto height = [&s](std::size_t i) { return (s.initial.orientation * s.body.spheres[i].center).z(); };
    EXPECT_NEAR(height(0), height(1), 1e-15);
    EXPECT_LT(height(0), height(2) - 0.04);
    EXPECT_GT(gap(s), 0.004);
    EXPECT_LT(gap(s), 0.006);
    EXPECT_LT(s.initial.velocity.z(), 0);
    EXPECT_NE(s.initial.velocity.y(), 0);
}

}  // namespace
}  // namespace footfall
