// The order of both methods across each kind of event of a friction law with states of its own.
#include "footfall/law/friction/lugre.hpp"
#include "footfall/law/normal/azad_featherstone.hpp"
#include "simulate/order.hpp"

namespace footfall {
namespace {

using test::order_of, test::Real, test::soft_ball, test::Steps;
using Law = Pair<AzadFeatherstoneNormal<Real>, LuGreFriction<Real>>;

Law law(double normal_stiffness = 20) {
    return {AzadFeatherstoneNormal<>{normal_stiffness, 2}.cast<Real>(),
            LuGreFriction<>{2, 0.1, 0.4, 0.3, 3, 0.05}.cast<Real>()};
}

enum class Friction { measured, idle };

void expect_order(Steps steps, const Simulation& s, const std::vector<EventKind>& events, double coarsest,
                  const Law& over = law(), Friction friction = Friction::measured) {
    const auto measured = test::measured_order<2>(s, over, steps, events, coarsest);
    EXPECT_NEAR(measured.all, order_of(steps), 0.4);
    if (friction == Friction::measured) {
        EXPECT_NEAR(measured.tangential, order_of(steps), 0.4);
    }
}

using enum EventKind;

class OrderOfLuGre : public testing::TestWithParam<Steps> {};
INSTANTIATE_TEST_SUITE_P(, OrderOfLuGre, testing::Values(Steps::explicit_, Steps::implicit), test::name_of_steps);

TEST_P(OrderOfLuGre, IsTheMethodsAcrossTouchdown) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 1.05};
    s.initial.velocity = {6, 1.5, -0.8};
    s.options.end_time = 0.45;
    expect_order(GetParam(), s, {touchdown}, 0.1);
}

TEST_P(OrderOfLuGre, IsTheMethodsAcrossSeparation) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 0.6};
    s.initial.velocity = {6, 1.5, 0};
    s.options.end_time = 0.6;
    expect_order(GetParam(), s, {separation}, 0.1);
}

TEST_P(OrderOfLuGre, IsTheMethodsAcrossRecovered) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 0.2};
    s.initial.velocity = {6, 1.5, 1.4};
    s.options.end_time = 1;
    expect_order(GetParam(), s, {recovered}, 0.4, law(1), Friction::idle);
}

TEST_P(OrderOfLuGre, IsTheMethodsAcrossAWholeImpact) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 1.05};
    s.initial.velocity = {6, 1.5, -0.8};
    s.options.end_time = 1.9;
    expect_order(GetParam(), s, {touchdown, separation, recovered}, 0.1);
}

// |V| has a kink where the slip passes zero along one line, and the law has no event there: the bristle's rate is
// continuous and its slope is not. In the plane, V as a rule passes zero at a distance, and there is no kink.
TEST_P(OrderOfLuGre, IsAboutTwoWhereTheSlipReversesAlongOneLine) {
    Simulation s = soft_ball();
    s.initial.position = {0, 0, 0.8};
    s.initial.velocity = {0.2, 0, -0.2};
    s.options.end_time = 1;
    const Law stiff{AzadFeatherstoneNormal<>{20, 2}.cast<Real>(),
                    LuGreFriction<>{10, 0.5, 0.4, 0.3, 1, 0.1}.cast<Real>()};
    const auto measured = test::measured_order<2>(s, stiff, GetParam(), {}, 0.05, 5);
    EXPECT_GT(measured.overall, 1.5);
    EXPECT_LT(measured.overall, 4);
}

}  // namespace
}  // namespace footfall
