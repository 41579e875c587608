// What a run refuses, and how it is stopped.
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "footfall/math/error.hpp"
#include "simulate/scenes.hpp"

namespace footfall {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Wrong {
    std::string name;  ///< of the test
    std::function<void(Simulation&)> spoil;
    std::vector<std::string> said;  ///< what the message must contain
};

AzadFeatherstoneNormal<>& normal(Simulation& s) { return std::get<AzadFeatherstoneNormal<>>(s.contacts[0].normal); }
AzadFeatherstoneFriction<>& friction(Simulation& s) {
    return std::get<AzadFeatherstoneFriction<>>(s.contacts[0].friction);
}

const std::vector<Wrong>& wrongs() {
    static const std::vector<Wrong> all{
        {"MassZero", [](Simulation& s) { s.body.mass = 0; }, {"mass", "0", "> 0"}},
        {"MassNegative", [](Simulation& s) { s.body.mass = -2.5; }, {"mass", "-2.5", "> 0"}},
        {"MassNan", [](Simulation& s) { s.body.mass = nan; }, {"mass", "nan", "> 0"}},
        {"MassInfinite", [](Simulation& s) { s.body.mass = infinity; }, {"mass", "inf", "finite"}},
        {"InertiaNan", [](Simulation& s) { s.body.inertia(1, 1) = nan; }, {"inertia", "finite"}},
        {"InertiaZero", [](Simulation& s) { s.body.inertia.setZero(); }, {"inertia", "> 0"}},
        {"InertiaNegative",
         [](Simulation& s) { s.body.inertia = Eigen::Vector3d(1, -1, 1).asDiagonal(); },
         {"inertia", "-1", "> 0"}},
        {"InertiaNotSymmetric", [](Simulation& s) { s.body.inertia(0, 1) = 1e-5; }, {"inertia", "symmetric"}},
        {"InertiaOfNoBody",
         [](Simulation& s) { s.body.inertia = Eigen::Vector3d(1, 1, 3).asDiagonal(); },
         {"inertia", "3", "larger than the sum"}},
        {"NoSphere",
         [](Simulation& s) {
             s.body.spheres.clear();
             s.contacts.clear();
         },
         {"sphere", "at least one"}},
        {"RadiusZero", [](Simulation& s) { s.body.spheres[0].radius = 0; }, {"sphere 0", "radius", "0", "> 0"}},
        {"RadiusNan", [](Simulation& s) { s.body.spheres[0].radius = nan; }, {"sphere 0", "radius", "nan", "> 0"}},
        {"CenterNan", [](Simulation& s) { s.body.spheres[0].center.y() = nan; }, {"sphere 0", "center", "finite"}},
        {"GroundNormalLong",
         [](Simulation& s) {
             s.ground.normal = {0, 0, 2};
         },
         {"normal", "2", "unit"}},
        {"GroundNormalZero", [](Simulation& s) { s.ground.normal.setZero(); }, {"normal", "0", "unit"}},
        {"GroundNormalNan", [](Simulation& s) { s.ground.normal.x() = nan; }, {"normal", "unit"}},
        {"GroundHeightInfinite", [](Simulation& s) { s.ground.height = infinity; }, {"height", "finite"}},
        {"GravityNan", [](Simulation& s) { s.gravity.z() = nan; }, {"gravity", "finite"}},
        {"PositionNan", [](Simulation& s) { s.initial.position.x() = nan; }, {"position", "finite"}},
        {"VelocityInfinite", [](Simulation& s) { s.initial.velocity.x() = infinity; }, {"velocity", "finite"}},
        {"AngularVelocityNan",
         [](Simulation& s) { s.initial.angular_velocity.z() = nan; },
         {"angular_velocity", "finite"}},
        {"OrientationLong",
         [](Simulation& s) {
             s.initial.orientation = {2, 0, 0, 0};
         },
         {"orientation", "2", "unit"}},
        {"OrientationNan", [](Simulation& s) { s.initial.orientation.w() = nan; }, {"orientation", "unit"}},
        {"EndTimeZero", [](Simulation& s) { s.options.end_time = 0; }, {"end_time", "0", "> 0"}},
        {"EndTimeInfinite", [](Simulation& s) { s.options.end_time = infinity; }, {"end_time", "inf", "finite"}},
        {"SamplePeriodNegative",
         [](Simulation& s) { s.options.sample_period = -0.5; },
         {"sample_period", "-0.5", ">= 0"}},
        {"ToleranceTooSmall",
         [](Simulation& s) { s.options.tolerance = 1e-15; },
         {"tolerance", "1e-15", "1e-14", "1e-3"}},
        {"ToleranceTooLarge",
         [](Simulation& s) { s.options.tolerance = 0.01; },
         {"tolerance", "0.01", "1e-14", "1e-3"}},
        {"ToleranceNan", [](Simulation& s) { s.options.tolerance = nan; }, {"tolerance", "nan", "1e-14"}},
        {"MaxMemoryZero", [](Simulation& s) { s.options.max_memory = 0; }, {"max_memory", "0 bytes", ">= 1"}},
        {"MaxMemoryNan", [](Simulation& s) { s.options.max_memory = nan; }, {"max_memory", "nan", ">= 1"}},
        {"MaxEvaluationsZero", [](Simulation& s) { s.options.max_evaluations = 0; }, {"max_evaluations", "0", ">= 1"}},
        {"MaxEvaluationsNan",
         [](Simulation& s) { s.options.max_evaluations = nan; },
         {"max_evaluations", "nan", ">= 1"}},
        {"TooFewContacts", [](Simulation& s) { s.contacts.clear(); }, {"contacts", "0", "1 spheres"}},
        {"TooManyContacts", [](Simulation& s) { s.contacts.push_back(s.contacts[0]); }, {"contacts", "2", "1 spheres"}},
        {"NormalStiffnessZero", [](Simulation& s) { normal(s).stiffness = 0; }, {"sphere 0", "stiffness", "0", "> 0"}},
        {"NormalDampingNegative", [](Simulation& s) { normal(s).damping = -1; }, {"sphere 0", "damping", "-1", ">= 0"}},
        {"FrictionStiffnessNan",
         [](Simulation& s) { friction(s).stiffness = nan; },
         {"sphere 0", "stiffness", "nan", "> 0"}},
        {"FrictionDampingNegative", [](Simulation& s) { friction(s).damping = -1; }, {"damping", "-1", ">= 0"}},
        {"CoefficientNegative", [](Simulation& s) { friction(s).coefficient = -0.1; }, {"coefficient", "-0.1", ">= 0"}},
        {"ViscousInfinite", [](Simulation& s) { friction(s).viscous = infinity; }, {"viscous", "inf", ">= 0"}},
        {"StartsInTheGround",
         [](Simulation& s) { s.initial.position.z() = 0.0155; },
         {"sphere 0", "0.0165", "0.001", "allow_initial_penetration"}},
    };
    return all;
}

class BadInput : public testing::TestWithParam<Wrong> {};

TEST_P(BadInput, IsRefusedWithItsNameValueAndRange) {
    Simulation s = test::paper_ball(0.01, 0.1);
    GetParam().spoil(s);
    for (const auto& use :
         {std::function<void()>([&] { check(s); }), std::function<void()>([&] { (void)footfall::run(s); })}) {
        try {
            use();
            ADD_FAILURE() << "accepted";
        } catch (const InvalidInput& error) {
            for (const std::string& word : GetParam().said)
                EXPECT_NE(std::string(error.what()).find(word), std::string::npos)
                    << "'" << word << "' in: " << error.what();
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Each, BadInput, testing::ValuesIn(wrongs()), [](const auto& each) { return each.param.name; });

TEST(Check, AcceptsWhatItShould) {
    EXPECT_NO_THROW(check(test::paper_ball(0.01, 0.1)));
    EXPECT_NO_THROW(check(test::paper_ball(0, 0.1))) << "exactly on the ground";
    Simulation inside = test::paper_ball(-1e-3, 0.1);
    inside.options.allow_initial_penetration = true;
    EXPECT_NO_THROW(check(inside));
    Simulation flat = test::paper_ball(0.01, 0.1);
    flat.body.inertia = Eigen::Vector3d(1, 2, 3).asDiagonal();  // a lamina
    EXPECT_NO_THROW(check(flat));
    Simulation turned = test::foot(0.01, 0.1);  // rounding in a turned tensor and in a unit vector
    const Eigen::Matrix3d R = Eigen::Quaterniond(0.3, 0.1, -0.7, 0.2).normalized().toRotationMatrix();
    turned.body.inertia = R * turned.body.inertia * R.transpose();
    EXPECT_NO_THROW(check(turned));
}

TEST(Check, TakesRoundingOfAPositionForTheGround) {
    const Simulation s = test::paper_ball(-1e-17, 0.1);
    EXPECT_NO_THROW(check(s));
    EXPECT_NEAR(initial_depth(test::paper_ball(-1e-3, 0.1), 0), 1e-3, 1e-15);
    EXPECT_NEAR(initial_depth(test::paper_ball(0.02, 0.1), 0), -0.02, 1e-15);
    EXPECT_LT(initial_depth_rounding(s), 1e-14);
}

TEST(Budget, ARunThatNeedsTooManyEvaluationsSaysHowFarItCame) {
    Simulation s = test::paper_ball(0.05, 100);
    s.contacts[0].normal = AzadFeatherstoneNormal<>{8.5e6, 0};
    s.options.max_evaluations = 20000;
    try {
        (void)footfall::run(s);
        ADD_FAILURE() << "ended within the budget";
    } catch (const TooExpensive& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("20000"), std::string::npos) << text;
        EXPECT_NE(text.find("max_evaluations"), std::string::npos) << text;
        const auto at = text.find("t = ");
        ASSERT_NE(at, std::string::npos) << text;
        const double reached = std::stod(text.substr(at + 4));
        EXPECT_GT(reached, 0.1) << text;
        EXPECT_LT(reached, 100) << text;
    }
}

TEST(Budget, ARunThatIsOutOfReachIsRefusedBeforeItStarts) {
    Simulation s = test::paper_ball(0.05, 1);
    s.contacts[0].normal = AzadFeatherstoneNormal<>{1e30, 1e10};
    bool started = false;
    s.options.progress = [&](double) { return started = true; };
    try {
        (void)footfall::run(s);
        ADD_FAILURE() << "was not refused";
    } catch (const TooExpensive& error) {
        EXPECT_NE(std::string(error.what()).find("would need about"), std::string::npos) << error.what();
    }
    EXPECT_FALSE(started);
}

TEST(Budget, IsNotTouchedByARunThatKeepsIt) {
    Simulation s = test::paper_ball(0.05, 0.5);
    const auto run = footfall::run(s);
    s.options.max_evaluations = static_cast<double>(run.cost.evaluations);
    EXPECT_NO_THROW((void)footfall::run(s));
}

TEST(Progress, IsToldTheTimeReachedAndCanEndTheRun) {
    Simulation s = test::paper_ball(0.05, 20);
    s.contacts[0].normal = AzadFeatherstoneNormal<>{8.5e6, 0};
    std::vector<double> times;
    s.options.progress = [&](double t) {
        times.push_back(t);
        return true;
    };
    (void)footfall::run(s);
    ASSERT_GT(times.size(), 2u);
    for (std::size_t i = 1; i < times.size(); ++i) EXPECT_GT(times[i], times[i - 1]);
    EXPECT_LE(times.back(), 20);
    std::size_t calls = 0;
    s.options.progress = [&](double) { return ++calls < 2; };
    EXPECT_THROW((void)footfall::run(s), Interrupted);
    EXPECT_EQ(calls, 2u);
}

}  // namespace
}  // namespace footfall
