// An impact under the passive friction law, by the library and by an integration that shares nothing with it.
#include <cmath>
#include <cstddef>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "oracle/library_run.hpp"
#include "oracle/passive_impact.hpp"

namespace {

using oracle::Ball;

struct Hit {
    const char* name;
    double mu, C_V, speed, slip;
};
std::ostream& operator<<(std::ostream& out, const Hit& hit) { return out << hit.name; }

class PassiveHit : public testing::TestWithParam<Hit> {
protected:
    static Ball<double> ball() {
        Ball<double> b = oracle::paper_ball();
        b.mu = GetParam().mu;
        b.C_V = GetParam().C_V;
        b.g = 0;
        return b;
    }
    /// In steps of sigma of which the impact takes some 0.1 s/m^0.5.
    static oracle::PassiveImpact<long double> reference(long double step) {
        return oracle::passive_impact<long double>(ball().cast<long double>(), GetParam().speed, GetParam().slip, step);
    }
};

constexpr long double fine = 2e-6L;

TEST_P(PassiveHit, IsKnownToTenDigits) {
    const auto once = reference(2 * fine), again = reference(fine);
    ASSERT_EQ(once.events.size(), again.events.size());
    EXPECT_NEAR(static_cast<double>(once.slip_velocity / again.slip_velocity), 1, 1e-10);
    EXPECT_NEAR(static_cast<double>(once.clutch / again.clutch), 1, 1e-10);
    EXPECT_NEAR(static_cast<double>(once.stiffness_change / again.stiffness_change), 1, 1e-10);
}

TEST_P(PassiveHit, IsTheLibrarys) {
    const auto expected = reference(fine);
    oracle::State<double> start{};
    const double gap = 1e-3;
    start[oracle::cz] = ball().r + gap;
    start[oracle::vx] = GetParam().slip;
    start[oracle::vz] = -GetParam().speed;
    footfall::Simulation simulation = oracle::simulation_of(ball(), start, 2 * gap / GetParam().speed + 0.02, 1e-12);
    simulation.contacts[0].friction =
        footfall::AzadFeatherstonePassiveFriction<>{{ball().K_t, ball().D_t, ball().mu, ball().C_V}};
    const footfall::Run run = footfall::run(simulation);

    std::size_t k = 0;
    for (const footfall::Event& event : run.events) {
        if (event.kind == footfall::EventKind::touchdown) continue;
        if (k == 0 && event.kind == footfall::EventKind::stick && event.time == run.events[0].time) continue;
        ASSERT_LT(k, expected.events.size());
        EXPECT_EQ(footfall::name_of(event.kind), oracle::name_of(expected.events[k].kind));
        EXPECT_NEAR(event.time - run.events[0].time, static_cast<double>(expected.events[k].time), 1e-12);
        ++k;
    }
    EXPECT_EQ(k, expected.events.size());
    const footfall::BodyState& body = run.final.body;
    const double slip = body.velocity.x() - ball().r * body.angular_velocity.y();
    EXPECT_NEAR(slip, static_cast<double>(expected.slip_velocity), 1e-11);
    const footfall::ContactEnergy& energy = run.final.ledger.contact;
    const auto expect = [](double value, long double channel) {
        EXPECT_NEAR(value, static_cast<double>(channel), 1e-9 * static_cast<double>(channel));
    };
    expect(energy.tangential_damper, expected.tangential_damper);
    expect(energy.clutch, expected.clutch);
    expect(energy.stiffness_change, expected.stiffness_change);
    EXPECT_GT(energy.stiffness_change, 0);
    EXPECT_LE(run.max_residual, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Impacts, PassiveHit,
                         testing::Values(Hit{"the paper's first bounce", 0.2, 0.1, 1.28, 0.7071},
                                         Hit{"sticks from touchdown", 2, 0.1, 1, 0.05},
                                         Hit{"no viscous friction", 0.3, 0, 0.5, 0.3},
                                         Hit{"slips all along", 0.1, 0.1, 0.5, 2}),
                         [](const auto& instance) {
                             std::string name = instance.param.name;
                             for (char& c : name)
                                 if (c == ' ' || c == '\'') c = '_';
                             return name;
                         });

}  // namespace
