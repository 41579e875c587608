// The library and the program give the same numbers, to the last bit. That Python does too is for its own tests to say
// (python/tests/test_run.py).
#include <gtest/gtest.h>

#include "cli/program.hpp"
#include "footfall/io/output.hpp"
#include "footfall/io/scenario.hpp"
#include "footfall/simulate/run.hpp"

namespace footfall::test {
namespace {

class SameNumbers : public ProgramTest, public testing::WithParamInterface<const char*> {};

TEST_P(SameNumbers, FromTheLibraryAndFromTheProgram) {
    const std::string file = std::string(FOOTFALL_SOURCE_DIR "/scenarios/") + GetParam() + ".toml";
    const Result told = footfall("run " + file + " --json");
    ASSERT_EQ(told.exit_code, 0) << told.err;
    const Scenario scenario = load_scenario(file);
    Json program = Json::parse(told.out), library = Json::parse(to_json(scenario, run(scenario.simulation)));
    program.erase("wall_seconds");
    library.erase("wall_seconds");
    EXPECT_EQ(program, library);
}

INSTANTIATE_TEST_SUITE_P(Scenarios, SameNumbers,
                         testing::Values("rolling-sphere", "foot-heel-first", "slope-stick",
                                         "single-impact-classical"));

}  // namespace
}  // namespace footfall::test
