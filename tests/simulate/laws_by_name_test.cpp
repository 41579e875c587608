// Every friction law as a reader of the documentation reaches it: by its name and keys in a scenario. The paper's ball
// drops a centimetre, sliding, and bounces.
#include <string>

#include <gtest/gtest.h>

#include "footfall/io/scenario.hpp"
#include "footfall/law/registry.hpp"
#include "footfall/simulate/run.hpp"
#include "simulate/scenes.hpp"
#include "simulate/tried_laws.hpp"

namespace footfall {
namespace {

Simulation sliding_ball(const std::string& law, const std::string& keys) {
    return parse_scenario(
               "[time]\nend = 0.2\n"
               "[solver]\ntolerance = 1e-10\n"
               "[body]\nmass = '154 g'\ninertia = 'solid-sphere'\n[[body.spheres]]\nradius = '1.65 cm'\n"
               "[body.initial]\nposition = [0, 0, '2.65 cm']\nvelocity = [0.5, 0, 0]\n"
               "[contact.normal]\nlaw = 'azad-featherstone'\nstiffness = 8.5e6\ndamping = 3.1e3\n"
               "[contact.friction]\nlaw = '" +
               law + "'\n" + keys + "\n")
        .simulation;
}

// The arm of the friction is r, so m r dv = I dw, whatever the law.
TEST(LawsByName, SlowASlidingBallAndSpinItWithTheirLedgersClosed) {
    for (const FrictionLaw& law : test::tried_friction_laws()) {
        const std::string name(name_of(law));
        SCOPED_TRACE(name);
        const Simulation simulation = sliding_ball(name, test::keys_of(law));
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
