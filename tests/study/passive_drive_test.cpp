// The passive friction law on the rig, whose depth is prescribed.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "footfall/study/drive.hpp"

namespace footfall::test {
namespace {

constexpr double pi = std::numbers::pi, depth = 1e-4, K_t = 12.75e6;
constexpr AzadFeatherstoneNormal<> normal_law{8.5e6, 3.1e3};

/// Pressed to a depth that swings about a mean at 1 Hz.
Rig swinging(double end_time, double swing) {
    Rig rig;
    rig.end_time = end_time;
    rig.sample_period = 0.01;
    rig.tolerance = 1e-11;
    rig.press = Press::indentation;
    rig.pressing.add(ConstantPart{depth});
    rig.pressing.add(SinePart{swing, 1});
    return rig;
}

// It is dragged within a moment and held. Where the depth grows the tension stays, K_t sqrt(z) |u|; where it shrinks
// the stretch does, and the tension falls with the root of the depth.
TEST(PassiveDrive, FrictionOfAHeldSphereStaysAsItIsPressedAndFallsAsItIsLifted) {
    Rig rig = swinging(2, 0.5 * depth);
    rig.dragging[0].add(RampPart{2e-6, 0, 1e-4});
    const Drive run = drive(rig, {normal_law, AzadFeatherstonePassiveFriction<>{{K_t, 0, 10, 0}}});
    const double mean = std::sqrt(depth), top = std::sqrt(1.5 * depth), bottom = std::sqrt(0.5 * depth);
    const double first = K_t * mean * 2e-6;  // falls by bottom/top in every cycle
    for (const RigState& s : run.samples) {
        if (s.time < 0.005) continue;
        const double cycle = std::floor(s.time + 0.25 - 1e-12);  // from one least depth to the next
        const bool lifted = s.time - cycle > 0.25;
        double tension = first * std::pow(bottom / top, cycle);
        if (lifted) tension *= std::sqrt(s.depth) / top;
        EXPECT_NEAR(-s.friction_force.x(), tension, 1e-3 * first) << s.time;  // the depth moves in the drag, too
    }
    EXPECT_LT(run.max_residual, 1e-10);
    EXPECT_GT(run.samples.back().energy.contact.stiffness_change, 0);
}

TEST(PassiveDrive, TakesOnlyAndClosesItsAccountWhereTheContactSlipsAndLeavesTheGround) {
    for (const double swing : {0.5 * depth, 1.5 * depth}) {  // the second leaves the ground in every cycle
        for (const double damping : {0.0, 1.0, 100.0, 3.1e3, 3e4}) {
            Rig rig = swinging(3, swing);
            rig.dragging[0].add(SinePart{4e-5, 2});
            rig.dragging[1].add(SinePart{2.5e-5, 3, 0.7});
            rig.max_evaluations = 1e6;
            const Drive paper = drive(rig, {normal_law, AzadFeatherstoneFriction<>{{K_t, damping, 0.2, 0}}});
            const Drive run = drive(rig, {normal_law, AzadFeatherstonePassiveFriction<>{{K_t, damping, 0.2, 0}}});
            EXPECT_LT(run.max_residual, 1e-9) << swing << ", " << damping;
            EXPECT_LT(run.cost.evaluations, 3 * paper.cost.evaluations) << swing << ", " << damping;
            for (std::size_t k = 1; k < run.samples.size(); ++k)
                ASSERT_GE(run.samples[k].energy.contact.stiffness_change,
                          run.samples[k - 1].energy.contact.stiffness_change - 1e-10 * run.energy_scale)
                    << swing << ", " << damping << ", " << run.samples[k].time;
        }
    }
}

// Dragged from touchdown on: u is 2/3 of the way while the depth grows at a constant rate.
TEST(PassiveDrive, StretchesByTwoThirdsOfTheWayAsTheDepthGrowsFromTheSurface) {
    Rig rig;
    rig.end_time = 1;
    rig.sample_period = 0.1;
    rig.tolerance = 1e-11;
    rig.press = Press::indentation;
    rig.pressing.add(RampPart{depth, 0, 1});
    rig.dragging[0].add(RampPart{1e-6, 0, 1});
    for (const double damping : {0.0, 3.1e3}) {
        const Drive run = drive(rig, {normal_law, AzadFeatherstonePassiveFriction<>{{K_t, damping, 10, 0}}});
        for (const RigState& s : run.samples)
            EXPECT_NEAR(s.bristle.x(), 2.0 / 3.0 * 1e-6 * s.time, 1e-16) << damping << ", " << s.time;
        EXPECT_LT(run.max_residual, 1e-10);
    }
}

}  // namespace
}  // namespace footfall::test
