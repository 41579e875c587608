// Random scenarios (bench/soak.cpp) that found a defect once, and some under every law.
#include <gtest/gtest.h>

#include "simulate/random_scenario.hpp"

namespace {

using namespace footfall;

class SeedThatOnceFailed : public testing::TestWithParam<std::uint64_t> {};

TEST_P(SeedThatOnceFailed, EndsFiniteWithItsLedgerClosedAndNothingGivenBack) {
    const Simulation simulation = soak::RandomScenario(GetParam(), soak::Laws::clutch).draw();
    EXPECT_EQ(soak::verdict(run(simulation), simulation), "");
}

// Standing exactly on the ground, rounding hid the touchdown.
INSTANTIATE_TEST_SUITE_P(OnTheGround, SeedThatOnceFailed, testing::Values(4717, 6848, 10068, 22988, 23989, 44023));
// Stretched bristles at touchdown, and beyond the cone of an undamped clutch.
INSTANTIATE_TEST_SUITE_P(StretchedBristle, SeedThatOnceFailed, testing::Values(16637, 8434));
// Motion along F_n = 0. The last two took more than 2e7 evaluations: rounding lifted the sphere off again and again.
INSTANTIATE_TEST_SUITE_P(Drag, SeedThatOnceFailed, testing::Values(8892, 13229, 13765, 6349));
// Undamped clutches, whose stick and slip are tangent to each other at touchdown.
INSTANTIATE_TEST_SUITE_P(UndampedClutch, SeedThatOnceFailed, testing::Values(12912, 22303, 24750, 28583, 73138, 73256));
// A linear law without damper lifting off in slip: a power of the vanishing depth overflowed.
INSTANTIATE_TEST_SUITE_P(VanishingDepth, SeedThatOnceFailed, testing::Values(8430));

// Implicit steps past the end of one of several contacts, where dt/dsigma has a pole.
INSTANTIATE_TEST_SUITE_P(Pole, SeedThatOnceFailed, testing::Values(3986));

class UnderThePassiveLaw : public testing::TestWithParam<std::uint64_t> {};

TEST_P(UnderThePassiveLaw, EndsFiniteWithItsLedgerClosedAndNothingMade) {
    const Simulation simulation =
        soak::RandomScenario(GetParam(), soak::Laws::every, false, "azad-featherstone-passive").draw();
    EXPECT_EQ(soak::verdict(run(simulation), simulation), "");
}
INSTANTIATE_TEST_SUITE_P(, UnderThePassiveLaw, testing::Range<std::uint64_t>(1, 25));

}  // namespace
