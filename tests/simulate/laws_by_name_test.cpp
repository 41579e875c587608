// Every friction law as a reader of the documentation reaches it: by its name and keys in a scenario. The paper's ball
// drops a centimetre, sliding, and bounces.
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "footfall/io/scenario.hpp"
#include "footfall/law/registry.hpp"
#include "footfall/simulate/run.hpp"
#include "simulate/scenes.hpp"

namespace footfall {
namespace {

// All slide at a coefficient of 0.2; those with a stiffness have about that of the paper's law at a depth of 0.1 mm.
const std::map<std::string, std::string> keys{
    {"none", ""},
    {"azad-featherstone", "stiffness = 12.75e6\ndamping = 3.1e3\ncoefficient = 0.2\nviscous = 0.1"},
    {"azad-featherstone-passive", "stiffness = 12.75e6\ndamping = 3.1e3\ncoefficient = 0.2\nviscous = 0.1"},
    {"linear", "stiffness = 1.3e5\ndamping = 33\ncoefficient = 0.2"},
    {"regularized-coulomb", "coefficient = 0.2\nrounding_speed = '1 mm/s'"},
    {"dahl", "stiffness = 1.5e4\ncoefficient = 0.2"},
    {"lugre",
     "stiffness = 1.5e4\ndamping = 5\nstatic_coefficient = 0.3\nkinetic_coefficient = 0.2\nstribeck_velocity = 0.01"},
    {"elasto-plastic",
     "stiffness = 1.5e4\ndamping = 5\nstatic_coefficient = 0.3\nkinetic_coefficient = 0.2\nstribeck_velocity = 0.01"},
    {"bliman-sorine", "coefficient = 0.2\nslow_coefficient = 0.3\nslow_length = 5e-5\nfast_share = 0.2"},
    {"seven-parameter",
     "stiffness = 1.5e4\nkinetic_coefficient = 0.2\nstribeck_coefficient = 0.1\nstribeck_velocity = 0.01\n"
     "memory_time = '1 ms'\nrise_time = 0.1"},
    {"reset-integrator", "stiffness = 1.5e4\ndamping = 5\nreach = 1.3e-5\nstiction = 0.3"},
    {"haessig-friedland", "stiffness = 1.5e4\nreach = 2e-5"}};

Simulation sliding_ball(const std::string& law) {
    return parse_scenario(
               "[time]\nend = 0.2\n"
               "[solver]\ntolerance = 1e-10\n"
               "[body]\nmass = '154 g'\ninertia = 'solid-sphere'\n[[body.spheres]]\nradius = '1.65 cm'\n"
               "[body.initial]\nposition = [0, 0, '2.65 cm']\nvelocity = [0.5, 0, 0]\n"
               "[contact.normal]\nlaw = 'azad-featherstone'\nstiffness = 8.5e6\ndamping = 3.1e3\n"
               "[contact.friction]\nlaw = '" +
               law + "'\n" + keys.at(law) + "\n")
        .simulation;
}

TEST(LawsByName, AreAllHere) {
    std::set<std::string> here, all;
    for (const auto& [name, _] : keys) here.insert(name);
    for_each_law<FrictionLaw>([&all](const auto& law) { all.insert(std::string(name_of(FrictionLaw(law)))); });
    EXPECT_EQ(here, all);
}

// The arm of the friction is r, so m r dv = I dw, whatever the law.
TEST(LawsByName, SlowASlidingBallAndSpinItWithTheirLedgersClosed) {
    for (const auto& [name, _] : keys) {
        SCOPED_TRACE(name);
        const Simulation simulation = sliding_ball(name);
        ASSERT_EQ(name_of(simulation.contacts.at(0).friction), name);
        const auto run = footfall::run(simulation);
        EXPECT_LE(run.max_residual, 3e-9);
        EXPECT_GE(run.impacts.size(), 2u);
        const ContactEnergy& energy = run.final.ledger.contact;
        const double lost = 0.5 - run.final.body.velocity.x();
        if (name == "none") {
            EXPECT_EQ(lost, 0);
            EXPECT_EQ(energy.clutch, 0);
            continue;
        }
        EXPECT_GT(lost, 0.05);
        EXPECT_GT(energy.clutch, 0);
        const double m = test::ball_mass, r = test::ball_radius, I = 0.4 * m * r * r;
        EXPECT_NEAR(I * run.final.body.angular_velocity.y() / (m * r * lost), 1, 1e-8);
    }
}

}  // namespace
}  // namespace footfall
