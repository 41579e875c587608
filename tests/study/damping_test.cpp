// The inverse of restitution, against closed forms and for every law that has a damping.
#include "footfall/study/damping.hpp"

#include <cmath>
#include <string>
#include <variant>

#include <gtest/gtest.h>

namespace footfall {
namespace {

constexpr double mass = 0.154;

/// A law of each kind with its defaults, and 1 or 0.7 where there is none.
template <class Law>
Law sample() {
    Law law{};
    for (const auto& parameter : Law::parameters()) {
        law.*parameter.member = parameter.fallback.value_or(parameter.key == "stiffness" ? 1e6 : 0.7);
    }
    return law;
}

TEST(WithRestitution, FindsTheDampingOfTheLinearLawInClosedForm) {
    // Schwager & Poeschel 2007, (15)-(17), solved for the damping on the side where the formula is plain: at
    // d = sqrt(2 k m), beta = omega = omega_0 / sqrt 2, the phase is pi/2 and e = exp(-pi/2).
    const double k = 2.5e5;
    const NormalLaw law = with_restitution(LinearNormal<>{k, 0}, mass, 1, std::exp(-std::acos(0.0)));
    EXPECT_NEAR(std::get<LinearNormal<>>(law).damping / std::sqrt(2 * k * mass), 1, 1e-9);
    // Critical damping, d = 2 sqrt(k m), gives e = exp(-2).
    const NormalLaw critical = with_restitution(LinearNormal<>{k, 0}, mass, 1, std::exp(-2));
    EXPECT_NEAR(std::get<LinearNormal<>>(critical).damping / (2 * std::sqrt(k * mass)), 1, 1e-7);
}

TEST(WithRestitution, FindsTheDampingOfHuntAndCrossleyInClosedForm) {
    // a (1 + e) = log((1 + a) / (1 - a e)) with a = 1: 1 + e = log 2 - log(1 - e), e = 0.5569...
    double low = 0, high = 1;
    for (int i = 0; i < 100; ++i) {
        const double e = (low + high) / 2;
        (1 + e < std::log(2 / (1 - e)) ? high : low) = e;
    }
    const NormalLaw law = with_restitution(HuntCrossleyNormal<>{8.5e6, 7}, mass, 2, low);
    EXPECT_NEAR(std::get<HuntCrossleyNormal<>>(law).damping * 2 / 8.5e6, 1, 1e-8);
}

TEST(WithRestitution, InvertsEveryLawThatHasADamping) {
    int inverted = 0;
    for_each_law<NormalLaw>([&]<class Law>(const Law&) {
        const NormalLaw law = sample<Law>();
        if (!damping_key(law)) {
            EXPECT_THROW((void)with_restitution(law, mass, 1, 0.7), InvalidInput) << Law::description.name;
            return;
        }
        ++inverted;
        for (const double e : {0.999, 0.7, 0.1, 0.01}) {
            const NormalLaw found = with_restitution(law, mass, 1, e);
            EXPECT_NEAR(normal_impact(found, mass, 1).restitution, e, 1e-9) << Law::description.name << " " << e;
        }
        EXPECT_NEAR(normal_impact(with_restitution(law, mass, 1, 1), mass, 1).restitution, 1, 1e-9);
    });
    EXPECT_GE(inverted, 3);
}

TEST(WithRestitution, KnowsWhichParameterIsTheDamping) {
    EXPECT_EQ(damping_key(AzadFeatherstoneNormal<>{1, 1}), "damping");
    EXPECT_EQ(damping_key(HuntCrossleyNormal<>{1, 1}), "damping");
    EXPECT_EQ(damping_key(LinearNormal<>{1, 1}), "damping");
}

TEST(WithRestitution, SaysWhenNoDampingGivesTheValue) {
    for (const double e : {1.2, 0.0, -0.5, std::nan("")}) {
        try {
            (void)with_restitution(AzadFeatherstoneNormal<>{8.5e6, 0}, mass, 1, e);
            ADD_FAILURE() << e;
        } catch (const InvalidInput& error) {
            EXPECT_NE(std::string(error.what()).find("it must be > 0 and <= 1"), std::string::npos) << error.what();
        }
    }
    try {
        (void)with_restitution(LinearNormal<>{2.5e5, 0}, mass, 1, 1e-300);
        ADD_FAILURE();
    } catch (const InvalidInput& error) {
        EXPECT_NE(std::string(error.what()).find("can be reached"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace footfall
