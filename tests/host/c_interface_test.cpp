// The C interface: what it refuses, and that it does what the class does. The examples in C and C++17 are tests, too.
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "footfall.h"
#include "footfall/host/contact_set.hpp"
#include "footfall/version.hpp"

namespace footfall::test {
namespace {

const std::array normal{footfall_parameter{"stiffness", 8.5e6}, footfall_parameter{"damping", 3.1e3}};
const std::array friction{footfall_parameter{"stiffness", 12.75e6}, footfall_parameter{"damping", 3.1e3},
                          footfall_parameter{"coefficient", 0.2}};
const footfall_law paper{"azad-featherstone", normal.data(),   normal.size(),
                         "azad-featherstone", friction.data(), friction.size()};

footfall_contact_set* made(const footfall_law& law) {
    footfall_contact_set* set = nullptr;
    EXPECT_EQ(footfall_contact_set_create(FOOTFALL_INTERFACE, &law, 1, 0, 0, &set), FOOTFALL_OK);
    EXPECT_STREQ(footfall_last_error(), "");
    return set;
}

struct Given {
    double depth = -5e-4;
    std::array<double, 3> velocity{0.3, 0, -1}, acceleration{0, 0, -9.81};
    std::array<double, 9> delassus{20, 0, 0, 0, 20, 0, 0, 0, 6};
    std::array<double, 3> impulse{}, double_impulse{};
    footfall_host_step host{};
    footfall_step_result result{};

    Given() {
        host.dt = 1e-3;
        host.depth = &depth;
        host.velocity = velocity.data();
        host.free_acceleration = acceleration.data();
        host.delassus = delassus.data();
        result.impulse = impulse.data();
        result.double_impulse = double_impulse.data();
    }
};

TEST(CInterface, GivesTheNumbersOfTheClass) {
    footfall_contact_set* const set = made(paper);
    ContactSet other({{AzadFeatherstoneNormal<>{8.5e6, 3.1e3}, AzadFeatherstoneFriction<>{12.75e6, 3.1e3, 0.2, 0}}});
    Given given;
    ASSERT_EQ(footfall_contact_set_step(set, &given.host, &given.result), FOOTFALL_OK);
    const std::array<double, 1> depth{given.depth};
    const ContactSetStep& step = other.step({given.host.dt, depth, given.velocity, given.acceleration, given.delassus});
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(given.impulse[k], step.impulse[k]);
        EXPECT_EQ(given.double_impulse[k], step.double_impulse[k]);
    }
    EXPECT_GT(given.impulse[2], 0);
    ASSERT_EQ(given.result.events, step.events.size());
    footfall_event event;
    ASSERT_EQ(footfall_contact_set_event(set, 0, &event), FOOTFALL_OK);
    EXPECT_EQ(event.kind, FOOTFALL_TOUCHDOWN);
    EXPECT_EQ(event.time, step.events[0].time);
    footfall_contact_energy energy;
    ASSERT_EQ(footfall_contact_set_energy(set, 0, &energy), FOOTFALL_OK);
    EXPECT_EQ(energy.normal_damper, step.energy[0].normal_damper);
    EXPECT_EQ(given.result.residual, step.residual);
    footfall_contact_set_destroy(set);
}

TEST(CInterface, CopiesSavesAndRestores) {
    footfall_contact_set* const set = made(paper);
    Given given;
    ASSERT_EQ(footfall_contact_set_step(set, &given.host, &given.result), FOOTFALL_OK);
    EXPECT_EQ(footfall_contact_set_contacts(set), 1U);
    ASSERT_EQ(footfall_contact_set_states(set), 2U);
    std::array<double, 2> states{};
    int phase = -1;
    ASSERT_EQ(footfall_contact_set_save(set, states.data(), &phase), FOOTFALL_OK);
    EXPECT_NE(states[0], 0);
    footfall_contact_set* copy = nullptr;
    ASSERT_EQ(footfall_contact_set_copy(set, &copy), FOOTFALL_OK);
    footfall_contact_set* const restored = made(paper);
    ASSERT_EQ(footfall_contact_set_restore(restored, states.data(), &phase), FOOTFALL_OK);
    std::vector<std::array<double, 3>> impulses;
    for (footfall_contact_set* const one : {set, copy, restored}) {
        Given next;
        next.depth = 4e-4;
        ASSERT_EQ(footfall_contact_set_step(one, &next.host, &next.result), FOOTFALL_OK);
        impulses.push_back(next.impulse);
        footfall_contact_set_destroy(one);
    }
    EXPECT_EQ(impulses[0], impulses[1]);
    EXPECT_EQ(impulses[0], impulses[2]);
}

TEST(CInterface, SaysWhatItCannotUse) {
    const auto refused = [](footfall_law law) {
        footfall_contact_set* set = reinterpret_cast<footfall_contact_set*>(1);
        EXPECT_EQ(footfall_contact_set_create(FOOTFALL_INTERFACE, &law, 1, 0, 0, &set), FOOTFALL_INVALID_INPUT);
        EXPECT_EQ(set, nullptr);
        return std::string(footfall_last_error());
    };
    footfall_law law = paper;
    law.normal = "azad";
    EXPECT_EQ(refused(law).substr(0, 60), "laws[0]: unknown normal law 'azad'. There are 'azad-feathers");
    law = paper;
    law.normal_parameter_count = 1;
    EXPECT_EQ(refused(law),
              "laws[0]: normal law 'azad-featherstone': damping (D_n, normal damping) [N s/m^1.5] is missing");
    const std::array misspelt{footfall_parameter{"stifness", 1}};
    law = paper;
    law.friction = "none";
    law.friction_parameters = misspelt.data();
    law.friction_parameter_count = 1;
    EXPECT_EQ(refused(law), "laws[0]: friction law 'none': unknown parameter 'stifness'. It has no parameters");
    const std::array negative{footfall_parameter{"stiffness", -1}};
    law = paper;
    law.normal = "hertz";
    law.normal_parameters = negative.data();
    law.normal_parameter_count = 1;
    EXPECT_EQ(refused(law),
              "laws[0]: normal law 'hertz': stiffness (K_n, normal stiffness) is -1 N/m^1.5; allowed is > 0, finite");
    law.normal = nullptr;
    EXPECT_EQ(refused(law), "laws[0]: normal: is NULL");

    footfall_contact_set* set = nullptr;
    EXPECT_EQ(footfall_contact_set_create(FOOTFALL_INTERFACE + 1, &paper, 1, 0, 0, &set), FOOTFALL_WRONG_INTERFACE);
    EXPECT_EQ(std::string(footfall_last_error()),
              "footfall.h has interface 2, the library has 1: they do not go together");
    EXPECT_EQ(footfall_contact_set_create(FOOTFALL_INTERFACE, &paper, 0, 0, 0, &set), FOOTFALL_INVALID_INPUT);
    EXPECT_EQ(footfall_contact_set_create(FOOTFALL_INTERFACE, nullptr, 1, 0, 0, &set), FOOTFALL_INVALID_INPUT);

    set = made(paper);
    Given given;
    given.host.delassus = nullptr;
    EXPECT_EQ(footfall_contact_set_step(set, &given.host, &given.result), FOOTFALL_INVALID_INPUT);
    EXPECT_EQ(std::string(footfall_last_error()), "delassus: is NULL");
    given = Given{};
    given.host.dt = std::nan("");
    EXPECT_EQ(footfall_contact_set_step(set, &given.host, &given.result), FOOTFALL_INVALID_INPUT);
    footfall_event event;
    EXPECT_EQ(footfall_contact_set_event(set, 0, &event), FOOTFALL_INVALID_INPUT);
    EXPECT_EQ(footfall_contact_set_step(nullptr, &given.host, &given.result), FOOTFALL_INVALID_INPUT);
    footfall_contact_set_destroy(set);
    footfall_contact_set_destroy(nullptr);
    EXPECT_EQ(footfall_interface(), FOOTFALL_INTERFACE);
    EXPECT_EQ(std::string(footfall_version()), std::string(version));
}

}  // namespace
}  // namespace footfall::test
