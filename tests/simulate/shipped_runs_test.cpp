// The shipped scenarios, run: the numbers that their comments name.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "footfall/io/scenario.hpp"
#include "simulate/scenes.hpp"

namespace footfall {
namespace {

const std::filesystem::path folder = FOOTFALL_SOURCE_DIR "/scenarios";
constexpr double degree = std::numbers::pi / 180;

Simulation shipped(const std::string& name) { return load_scenario(folder / (name + ".toml")).simulation; }

/// The ground's frame of a slope that descends towards +x.
Eigen::Vector3d downhill(const Simulation& s) { return Eigen::Vector3d::UnitY().cross(s.ground.normal); }

/// The mean acceleration over the last fifth of a run.
Eigen::Vector3d late_acceleration(const Run& run) {
    const Snapshot &a = run.samples[run.samples.size() * 4 / 5], &b = run.samples.back();
    return (b.body.velocity - a.body.velocity) / (b.time - a.time);
}

TEST(ShippedRuns, CloseTheirLedgers) {
    std::size_t seen = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.is_directory()) continue;  // the rigs of footfall drive
        SCOPED_TRACE(entry.path().filename());
        const Simulation s = load_scenario(entry.path()).simulation;
        const auto run = footfall::run(s);
        EXPECT_LE(run.max_residual, 100 * s.options.tolerance);
        EXPECT_TRUE(test::finite(run.final));
        EXPECT_FALSE(run.events.empty());
        EXPECT_LT(run.cost.evaluations, 1000000);
        ++seen;
    }
    EXPECT_GE(seen, 11u);
}

TEST(ShippedRuns, SlopeStickRollsDownAtFiveSevenths) {
    const Simulation s = shipped("slope-stick");
    const auto run = footfall::run(s);
    const double expected = 5.0 / 7.0 * 9.81 * std::sin(20 * degree);
    EXPECT_NEAR(expected, 2.397, 5e-4);
    EXPECT_NEAR(late_acceleration(run).dot(downhill(s)) / expected, 1, 1e-4);
    EXPECT_EQ(run.final.contacts[0].phase, Phase::stick);
    const Snapshot& settled = run.samples[run.samples.size() / 2];
    EXPECT_EQ(run.final.ledger.contact.clutch, settled.ledger.contact.clutch) << "the clutch takes nothing more";
}

TEST(ShippedRuns, SlopeSlideSlidesAndSpinsUpTooSlowlyToRoll) {
    const Simulation s = shipped("slope-slide");
    const auto run = footfall::run(s);
    const double slide = 9.81 * (std::sin(45 * degree) - 0.2 * std::cos(45 * degree));
    const double spin = 2.5 * 0.2 * 9.81 * std::cos(45 * degree) / 0.0165;
    EXPECT_NEAR(slide, 5.549, 5e-4);
    EXPECT_NEAR(spin, 210.2, 0.05);
    EXPECT_NEAR(late_acceleration(run).dot(downhill(s)) / slide, 1, 1e-4);
    const Snapshot &a = run.samples[run.samples.size() / 2], &b = run.samples.back();
    EXPECT_NEAR((b.body.angular_velocity.y() - a.body.angular_velocity.y()) / (b.time - a.time) / spin, 1, 1e-4);
    EXPECT_LT(b.body.angular_velocity.y() * 0.0165, 0.7 * b.body.velocity.norm());
    EXPECT_EQ(test::count(run, EventKind::stick), 0u) << "it slips all the way";
}

TEST(ShippedRuns, SlopeBlockStickComesToRest) {
    const auto run = footfall::run(shipped("slope-block-stick"));
    EXPECT_LE(run.final.body.velocity.norm(), 1e-8);
    EXPECT_LE(run.final.body.angular_velocity.norm(), 1e-6);
    for (const ContactSnapshot& c : run.final.contacts) EXPECT_EQ(c.phase, Phase::stick);
    const ContactEnergy &settled = run.samples[run.samples.size() * 4 / 5].ledger.contact,
                        &end = run.final.ledger.contact;
    EXPECT_NEAR(settled.dissipated(), end.dissipated(), 1e-10);
}

TEST(ShippedRuns, SlopeBlockSlideSlides) {
    const Simulation s = shipped("slope-block-slide");
    const auto run = footfall::run(s);
    const double expected = 9.81 * (std::sin(25 * degree) - 0.3 * std::cos(25 * degree));
    EXPECT_NEAR(expected, 1.479, 5e-4);
    EXPECT_NEAR(late_acceleration(run).dot(downhill(s)) / expected, 1, 1e-3);
    for (const ContactSnapshot& c : run.final.contacts) EXPECT_EQ(c.phase, Phase::slip);
}

TEST(ShippedRuns, RestingBallSinksToTheStaticIndentation) {
    const auto run = footfall::run(shipped("resting-ball"));
    const double depth = std::pow(0.154 * 9.81 / 8.5e6, 2.0 / 3.0);
    EXPECT_NEAR(depth, 31.6e-6, 0.05e-6);
    EXPECT_NEAR(run.final.contacts[0].depth / depth, 1, 1e-3);
    EXPECT_LE(run.final.body.velocity.norm(), 1e-4);
}

TEST(ShippedRuns, SpinningBallTurnsSpinIntoSpeedAndKeepsWhatIsAboutTheNormal) {
    const Simulation s = shipped("spinning-ball");
    const auto run = footfall::run(s);
    ASSERT_FALSE(run.impacts.empty());
    ASSERT_TRUE(run.impacts[0].recovered);
    const Event* up = test::first(run, EventKind::recovered);
    EXPECT_GT(up->state.body.velocity.x(), 0.05);
    EXPECT_NEAR(up->state.body.velocity.y(), 0, 1e-12);
    EXPECT_LT(up->state.body.angular_velocity.y(), s.initial.angular_velocity.y() - 1);
    EXPECT_NEAR(run.final.body.angular_velocity.z(), 300 * 2 * std::numbers::pi / 60, 1e-12);
    // What friction gives the centre it takes from the spin: the moment about a point of the ground's line stays.
    EXPECT_NEAR(0.154 * up->state.body.velocity.x() * 0.0165,
                0.4 * 0.154 * 0.0165 * 0.0165 * (s.initial.angular_velocity.y() - up->state.body.angular_velocity.y()),
                1e-13);
}

TEST(ShippedRuns, FootLandsHeelFirstAndSlips) {
    const auto run = footfall::run(shipped("foot-heel-first"));
    double heel = 0, toe = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 4; ++i) {
        const Event* down = test::first(run, EventKind::touchdown, i);
        ASSERT_NE(down, nullptr) << i;
        if (i < 2) {
            heel = std::max(heel, down->time);
            EXPECT_EQ(down->state.contacts[static_cast<std::size_t>(i)].phase, Phase::slip) << i;
        } else {
            toe = std::min(toe, down->time);
        }
    }
    EXPECT_LT(heel, toe);
}

TEST(ShippedRuns, SingleImpactsLeaveTheGroundAsTheirLawsHaveIt) {
    const auto paper = footfall::run(shipped("single-impact")),
               classical = footfall::run(shipped("single-impact-classical"));
    ASSERT_EQ(paper.impacts.size(), 1u);
    ASSERT_EQ(classical.impacts.size(), 1u);
    EXPECT_GT(*paper.impacts[0].recovered - *paper.impacts[0].separation, 1e-5) << "the ground is still indented";
    EXPECT_NEAR(*classical.impacts[0].recovered - *classical.impacts[0].separation, 0, 1e-12) << "it follows";
    EXPECT_LT(*paper.impacts[0].restitution(), 1);
    EXPECT_LT(*classical.impacts[0].restitution(), 1);
}

TEST(ShippedRuns, BouncesOfTheBouncingSphereGetLowerAndShorter) {
    const auto run = footfall::run(shipped("bouncing-sphere"));
    ASSERT_GE(run.impacts.size(), 3u);
    for (std::size_t i = 1; i + 1 < run.impacts.size(); ++i) {
        EXPECT_LT(run.impacts[i].speed_in, run.impacts[i - 1].speed_in);
        EXPECT_LT(run.impacts[i + 1].touchdown - run.impacts[i].touchdown,
                  run.impacts[i].touchdown - run.impacts[i - 1].touchdown);
    }
    for (const Impact& impact : run.impacts) {
        if (!impact.recovered) continue;
        EXPECT_LT(*impact.separation, *impact.recovered);
    }
}

}  // namespace
}  // namespace footfall
