// Where what is prescribed for a contact jumps.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "footfall/law/normal/spring_alone.hpp"
#include "footfall/law/registry.hpp"

namespace footfall {
namespace {

constexpr double s = 1e-2;  // sqrt(m): 0.1 mm deep
const AzadFeatherstoneNormal<> normal{8.5e6, 3.1e3};

Touch<double> touch(double depth_rate, double slip) { return {s, depth_rate, {slip, 0}}; }
double load_at(double depth_rate) { return 8.5e6 * s * s * s + 3.1e3 * s * depth_rate; }

TEST(Kink, OfTheLoadIsPaidByNobodyUnderALawInProportionToIt) {
    const double sigma = 1e4, z = 3e-5;
    const Pair law(normal, DahlFriction<>{sigma, 0.4});
    std::array x{z, 0.0};
    const double before = load_at(0), after = load_at(1e-2);
    const auto jump = law.kink({Phase::slip}, true, touch(0, 1), touch(1e-2, 1), 0, x);
    EXPECT_EQ(jump.mode, Mode{Phase::slip});
    EXPECT_EQ(jump.event_count, 0);
    EXPECT_NEAR(jump.taken[unpaid], (before - after) * sigma * z * z / 2, 1e-15);
    EXPECT_EQ(x[0], z);
}

TEST(Kink, ThatTakesTheLoadAwayFreesTheStates) {
    const double sigma = 1e4, z = 3e-5;
    const Pair law(normal, DahlFriction<>{sigma, 0.4});
    std::array x{z, 0.0};
    const auto jump = law.kink({Phase::slip}, false, touch(0, 1), touch(-1, 1), 0, x);
    EXPECT_EQ(jump.mode, Mode{Phase::recovering});
    ASSERT_EQ(jump.event_count, 1);
    EXPECT_EQ(jump.events[0], EventKind::separation);
    EXPECT_NEAR(jump.taken[unpaid], load_at(0) * sigma * z * z / 2, 1e-15);
    EXPECT_EQ(x[0], 0);
}

TEST(Kink, OfTheSlipVelocityEndsAStickThatItsDamperCannotHold) {
    const AzadFeatherstoneFriction<> friction{{12.75e6, 3.1e3, 0.2, 0.1}};
    const Pair law(normal, friction);
    std::array x{0.0, 0.0};
    const double slowest = 0.2 * load_at(0) / (3.1e3 * s);  // that slips: D_t s V = mu F_n
    const auto holds = law.kink({Phase::stick}, true, touch(0, 0), touch(0, 0.99 * slowest), 0, x);
    EXPECT_EQ(holds.mode, Mode{Phase::stick});
    EXPECT_EQ(holds.event_count, 0);
    const auto slips = law.kink({Phase::stick}, true, touch(0, 0), touch(0, 1.01 * slowest), 0, x);
    EXPECT_EQ(slips.mode, Mode{Phase::slip});
    ASSERT_EQ(slips.event_count, 1);
    EXPECT_EQ(slips.events[0], EventKind::slip);
}

TEST(Kink, OfTheLoadLetsABristleWithoutDampingSpringBackThroughTheClutch) {
    const double K_t = 12.75e6, mu = 0.2;
    const Pair law(normal, AzadFeatherstoneFriction<>{{K_t, 0, mu, 0}});
    const double u = mu * load_at(0) / (K_t * s), smaller = mu * load_at(-1e-2) / (K_t * s);  // on the cones
    std::array x{u, 0.0};
    const auto jump = law.kink({Phase::slip}, true, touch(0, 1), touch(-1e-2, 1), 0, x);
    EXPECT_EQ(jump.mode, Mode{Phase::slip});
    EXPECT_NEAR(x[0], smaller, 1e-12 * u);
    EXPECT_NEAR(jump.taken[by_clutch], K_t * s * (u * u - smaller * smaller) / 2, 1e-15);
    EXPECT_EQ(jump.taken[unpaid], 0);
}

// On its cone the sign of a difference of two equal numbers decides nothing: the clutch goes on, or it does not.
TEST(Kink, LeavesABristleOnItsConeToTheWayThatItsClutchGoes) {
    const double K_t = 12.75e6, mu = 0.2;
    const Pair law(normal, AzadFeatherstoneFriction<>{{K_t, 0, mu, 0}});
    for (const double off : {-1e-15, 0.0, 1e-15}) {
        const double u = mu * load_at(0) / (K_t * s) * (1 + off);
        for (const double slip : {-1.0, 1.0}) {
            std::array x{u, 0.0};
            const auto jump = law.kink({Phase::slip}, true, touch(0, 1), touch(0, slip), 0, x);
            EXPECT_EQ(jump.mode, Mode{slip > 0 ? Phase::slip : Phase::stick}) << off << " " << slip;
        }
    }
}

TEST(Kink, BringsALoadBack) {
    const Pair law(normal, AzadFeatherstoneFriction<>{{12.75e6, 3.1e3, 0.2, 0.1}});
    std::array x{0.0, 0.0};
    const auto jump = law.kink({Phase::recovering}, true, touch(-1, 0), touch(0, 0), 0, x);
    EXPECT_EQ(jump.mode, Mode{Phase::stick});
    ASSERT_EQ(jump.event_count, 2);
    EXPECT_EQ(jump.events[0], EventKind::touchdown);
    EXPECT_EQ(jump.events[1], EventKind::stick);
    const auto free = law.kink({Phase::recovering}, false, touch(-1, 0), touch(-2, 0), 0, x);
    EXPECT_EQ(free.mode, Mode{Phase::recovering});
    EXPECT_EQ(free.event_count, 0);
}

TEST(SpringAlone, CarriesWhatTheLawCarriesWithoutSpeedAtAnySpeed) {
    for_each_law<NormalLaw>([]<class Law>(Law) {
        Law law{};
        for (const auto& p : Law::parameters()) law.*p.member = p.at_most_one ? 0.5 : 1.5;
        std::array x{0.1, 0.1};
        using Part = NormalPart<Law>;
        const std::span<const double> states(x.data(), static_cast<std::size_t>(Part::states()));
        const SpringAlone spring(law);
        const NormalPart<SpringAlone<Law>> alone{spring};
        EXPECT_EQ(alone.states(), Part::states()) << law.description.name;
        for (const double speed : {-2.0, 0.0, 3.0}) {
            const NormalForce<double> f = alone.force(0, 0.3, speed, states);
            EXPECT_EQ(f.total(), Part{law}.force(0, 0.3, 0, states).elastic) << law.description.name;
            EXPECT_EQ(f.dissipative, 0) << law.description.name;
            EXPECT_GT(alone.load(0.3, speed, states), 0) << law.description.name;
        }
        EXPECT_EQ(alone.stored_energy(0.3, states), Part{law}.stored_energy(0.3, states)) << law.description.name;
    });
}

}  // namespace
}  // namespace footfall
