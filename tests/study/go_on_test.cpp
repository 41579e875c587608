// A caller can end every study that takes long, and what it throws itself comes out.
#include "footfall/study/go_on.hpp"

#include <functional>
#include <stdexcept>

#include <gtest/gtest.h>

#include "footfall/study/drive.hpp"
#include "footfall/study/fit.hpp"
#include "footfall/study/oblique.hpp"
#include "footfall/study/restitution.hpp"

namespace footfall {
namespace {

constexpr double mass = 0.154;
constexpr AzadFeatherstoneNormal<> normal_law{8.5e6, 3.1e3};
constexpr int patience = 3;

class CannotWait : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The study goes through while its caller says so, asking all along; ends soon after the caller says no; and lets out
/// what the caller throws.
void expect_to_be_asked(const std::function<void(const GoOn&)>& study) {
    int calls = 0;
    study([&] { return ++calls > 0; });
    EXPECT_GT(calls, patience);

    calls = 0;
    EXPECT_THROW(study([&] { return ++calls < patience; }), Interrupted);
    EXPECT_EQ(calls, patience);

    calls = 0;
    const GoOn impatient = [&] {
        if (++calls == patience) throw CannotWait("enough");
        return true;
    };
    EXPECT_THROW(study(impatient), CannotWait);
    EXPECT_EQ(calls, patience);
}

TEST(GoOn, EndsRestitution) {
    expect_to_be_asked([](const GoOn& go_on) {
        (void)restitution({.title = "",
                           .cases = {{"ball", normal_law, mass, 0.0165}},
                           .speeds = {0.1, 0.3, 1, 3, 10},
                           .options = {.go_on = go_on}});
    });
}

TEST(GoOn, EndsAnObliqueImpact) {
    expect_to_be_asked([](const GoOn& go_on) {
        const AzadFeatherstoneFriction<> friction{{12.75e6, 3.1e3, 0.2, 0.1}};
        const ObliqueSphere sphere{
            .mass = mass, .radius = 0.0165, .inertia = {}, .contact = {normal_law, friction}, .go_on = go_on};
        (void)oblique_impact(sphere, {.normal_speed = 1, .tangential_velocity = 1});
    });
}

TEST(GoOn, EndsADrive) {
    expect_to_be_asked([](const GoOn& go_on) {
        Rig rig;
        rig.pressing.add(ConstantPart{10});
        rig.drag = Drag::velocity;
        rig.dragging[0].add(ConstantPart{1e-3});
        rig.go_on = go_on;
        (void)drive(rig, {normal_law, AzadFeatherstoneFriction<>{{12.75e6, 3.1e3, 0.2, 0.1}}});
    });
}

TEST(GoOn, EndsAFit) {
    FitData data;
    for (const double speed : {0.1, 0.3, 1.0, 3.0}) {
        data.x.push_back(speed);
        data.y.push_back(normal_impact(normal_law, mass, speed).restitution);
    }
    expect_to_be_asked([&](const GoOn& go_on) {
        (void)fit({.data = data,
                   .laws = {{normal_law, {{"damping", {.value = 1e3, .free = true}}}}},
                   .mass = FitValue{.value = mass},
                   .speed = {},
                   .options = {.starts = 20, .go_on = go_on}});
    });
}

}  // namespace
}  // namespace footfall
