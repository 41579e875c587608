// The order of the explicit method under the passive friction law: where its equations are smooth, across touchdown,
// where they are regular along the motion alone, and across the kink where the depth turns.
#include "footfall/law/friction/azad_featherstone_passive.hpp"
#include "simulate/order.hpp"

namespace footfall {
namespace {

using test::Real, test::soft_ball, test::Steps;
using enum EventKind;
using PassiveLaw = Pair<AzadFeatherstoneNormal<Real>, AzadFeatherstonePassiveFriction<Real>>;

test::MeasuredOrder order_over(const Simulation& s, const std::vector<EventKind>& events, double coarsest,
                               int halvings) {
    const PassiveLaw law{AzadFeatherstoneNormal<>{20, 2}.cast<Real>(),
                         AzadFeatherstonePassiveFriction<>{{15, 3, 0.3, 0.5}}.cast<Real>()};
    return test::measured_order<2>(s, law, Steps::explicit_, events, coarsest, halvings);
}

/// A ball in the ground that slips, and goes deeper or comes out.
Simulation slipping(double depth_rate) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 0.8};
    s.initial.velocity = {2, 0.5, -depth_rate};
    s.options.end_time = 0.12;
    return s;
}

TEST(PassiveOrder, IsTheMethodsWhileTheDepthGrowsAndWhileItShrinks) {
    for (const double depth_rate : {1.0, -0.5})
        EXPECT_NEAR(order_over(slipping(depth_rate), {}, 0.1, 2).overall_tangential, 8, 0.4);
}

TEST(PassiveOrder, IsAboutFiveAcrossTouchdown) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 1.05};
    s.initial.velocity = {2, 0.5, -0.8};
    s.options.end_time = 0.45;
    EXPECT_NEAR(order_over(s, {touchdown}, 0.2, 3).all, 4.7, 0.4);
}

// Where in a step the kink falls decides how wrong the step is.
TEST(PassiveOrder, IsLostAcrossTheTurn) {
    Simulation s = slipping(0.2);
    s.options.end_time = 0.6;
    EXPECT_LT(order_over(s, {}, 0.2, 6).overall, 4);
}

}  // namespace
}  // namespace footfall
