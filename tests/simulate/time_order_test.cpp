// Samples, events and impacts of a run are in the order of time.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "footfall/io/scenario.hpp"
#include "simulate/random_scenario.hpp"

namespace {

using namespace footfall;

/// How many random scenarios; FOOTFALL_ORDER_SCENARIOS in the environment asks for more.
std::uint64_t random_scenarios() {
    const char* asked = std::getenv("FOOTFALL_ORDER_SCENARIOS");
    return asked ? std::strtoull(asked, nullptr, 10) : 300;
}

TEST(TimeOrder, HoldsInRandomScenariosOfOneToSixSpheres) {
    std::size_t seen = 0, together = 0;
    for (std::uint64_t seed = 0; seed < random_scenarios(); ++seed) {
        Simulation simulation = soak::RandomScenario(seed).draw();
        simulation.options.tolerance = 1e-6;  // the order does not depend on it
        simulation.options.max_evaluations = 1e6;
        try {
            const footfall::Run done = run(simulation);
            EXPECT_EQ(soak::disorder(done), "") << "seed " << seed;
            for (std::size_t k = 1; k < done.events.size(); ++k)
                together += done.events[k - 1].time == done.events[k].time;
            seen += done.events.size();
        } catch (const TooExpensive&) {
        }
    }
    // The property says something only where there are events, some of them at the same moment.
    EXPECT_GT(seen, random_scenarios());
    EXPECT_GT(together, random_scenarios() / 10);
}

class TimeOrderOf : public testing::TestWithParam<std::string> {};

TEST_P(TimeOrderOf, HoldsInAShippedScenario) {
    const std::filesystem::path folder = std::filesystem::path(FOOTFALL_SOURCE_DIR) / "scenarios";
    EXPECT_EQ(soak::disorder(run(load_scenario(folder / (GetParam() + ".toml")).simulation)), "");
}

INSTANTIATE_TEST_SUITE_P(Feet, TimeOrderOf,
                         testing::Values("foot-heel-first", "slope-block-slide", "slope-block-stick", "spinning-ball"),
                         [](const auto& name) {
                             std::string text = name.param;
                             std::replace(text.begin(), text.end(), '-', '_');
                             return text;
                         });

}  // namespace
