// Restitution of a single impact: against closed forms, an independent integration in long double, dimensional
// analysis, and the energy that gravity leaves.
#include "footfall/study/restitution.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "footfall/study/viscoelastic_theory.hpp"
#include "oracle/impact.hpp"

namespace footfall {
namespace {

constexpr double mass = 0.154;
constexpr AzadFeatherstoneNormal<> paper{8.5e6, 3.1e3};
constexpr HuntCrossleyNormal<> classical{8.5e6, 3.1e6};

std::string error_of(const std::function<void()>& call) {
    try {
        call();
        return "accepted";
    } catch (const InvalidInput& error) {
        return error.what();
    }
}

TEST(NormalImpact, AgreesWithAnIndependentIntegrationOverNineDecadesOfSpeed) {
    for (const double speed : {1e-6, 1e-4, 1e-2, 1.0, 30.0, 1e3}) {
        SCOPED_TRACE(speed);
        const auto expected = oracle::impact<long double>(oracle::ImpactLaw::azad_featherstone, mass, paper.stiffness,
                                                          paper.damping, speed);
        const NormalImpact impact = normal_impact(paper, mass, speed);
        EXPECT_NEAR(impact.restitution, static_cast<double>(expected.speed_out / speed), 1e-10);
        ASSERT_TRUE(impact.separation && impact.recovered);
        EXPECT_NEAR(*impact.separation / static_cast<double>(expected.separation), 1, 1e-10);
        EXPECT_NEAR(*impact.recovered / static_cast<double>(expected.recovered), 1, 1e-10);
        EXPECT_NEAR(impact.peak_indentation / static_cast<double>(expected.peak_depth), 1, 1e-10);
        EXPECT_NEAR(impact.peak_force / static_cast<double>(expected.peak_force), 1, 1e-10);
    }
}

TEST(NormalImpact, IsWithinTenToTheMinusTenOfTheClosedFormsAtTheTightestTolerance) {
    const ImpactOptions tightest{.gravity = 0, .tolerance = 1e-14};
    for (const double speed : {1e-3, 0.1, 1.0, 10.0}) {
        EXPECT_NEAR(normal_impact(classical, mass, speed, tightest).restitution,
                    static_cast<double>(oracle::hunt_crossley_restitution(8.5e6, 3.1e6, speed)), 1e-12);
        for (const double damping : {60.0, 390.0, 2000.0}) {
            EXPECT_NEAR(normal_impact(LinearNormal<>{2.5e5, damping}, mass, speed, tightest).restitution,
                        static_cast<double>(oracle::linear_restitution(mass, 2.5e5, damping)), 1e-12);
        }
    }
}

TEST(NormalImpact, EndsHoweverHeavyTheDamping) {
    // e of the overdamped linear law tends to k m / d^2.
    const double k = 2.5e5, d = 1e6;
    EXPECT_NEAR(normal_impact(LinearNormal<>{k, d}, mass, 1).restitution / (k * mass / (d * d)), 1, 1e-3);
}

RC_GTEST_PROP(NormalImpact, OfTheSameDimensionlessNumberHasTheSameRestitution, ()) {
    // e depends on D_n K_n^(-3/5) m^(-2/5) v^(1/5) alone: mass, stiffness and speed change, the damping makes up for
    // it.
    const auto decade = [](int low, int high) {
        return std::pow(10.0, *rc::gen::inRange(low * 100, high * 100) / 100.0);
    };
    const double m = decade(-3, 2), K_n = decade(3, 10), v = decade(-3, 1);
    const double number = 0.4;
    const double D_n = number * std::pow(K_n, 0.6) * std::pow(m, 0.4) * std::pow(v, -0.2);
    const double expected = normal_impact(AzadFeatherstoneNormal<>{1, number}, 1, 1).restitution;
    RC_ASSERT(std::abs(normal_impact(AzadFeatherstoneNormal<>{K_n, D_n}, m, v).restitution - expected) < 1e-10);
}

TEST(NormalImpact, LosesNothingUnderAnElasticLawWithGravityToo) {
    for (const double gravity : {0.0, 9.81}) {
        for (const double speed : {1e-3, 1.0}) {
            const NormalImpact impact =
                normal_impact(AzadFeatherstoneNormal<>{8.5e6, 0}, mass, speed, {.gravity = gravity});
            EXPECT_NEAR(impact.restitution, 1, 1e-10);
        }
    }
}

TEST(NormalImpact, RefusesValuesOutOfRange) {
    EXPECT_EQ(error_of([] { (void)normal_impact(paper, 0, 1); }), "mass is 0 kg; it must be finite and > 0");
    EXPECT_EQ(error_of([] { (void)normal_impact(paper, 1, -1); }), "speed is -1 m/s; it must be finite and > 0");
    EXPECT_NE(error_of([] { (void)normal_impact(paper, 1, 1, {.gravity = -1}); }).find("gravity is -1"),
              std::string::npos);
    EXPECT_NE(error_of([] { (void)normal_impact(paper, 1, 1, {.tolerance = 1}); }).find("tolerance is 1"),
              std::string::npos);
    EXPECT_NE(error_of([] {
                  (void)normal_impact(AzadFeatherstoneNormal<>{-1, 0}, 1, 1);
              }).find("stiffness"),
              std::string::npos);
}

TEST(SlowestBounce, IsWhereGravityBeginsToHoldTheSphere) {
    const ImpactOptions options{.gravity = 9.81, .tolerance = 1e-12};
    const auto threshold = slowest_bounce(paper, mass, options);
    ASSERT_TRUE(threshold && *threshold > 0);
    const NormalImpact below = normal_impact(paper, mass, *threshold * (1 - 1e-6), options);
    const NormalImpact above = normal_impact(paper, mass, *threshold * (1 + 1e-6), options);
    EXPECT_EQ(below.restitution, 0);
    EXPECT_FALSE(below.recovered.has_value());
    EXPECT_GT(above.restitution, 0);
    EXPECT_LT(above.restitution, 0.01);  // e rises as the root of the distance
}

TEST(SlowestBounce, OfTheLinearLawIsTheClosedForm) {
    // At the slowest bounce the sphere comes back to z = 0 with no speed. A time t before that, while it flies freely
    // under the clamp, z = g t^2 / 2 and zdot = -g t, so the force ends where k g t^2 / 2 = d g t, at t = 2 d / k.
    // Before that it is a damped oscillator about its depth of rest; backwards in time, T, the damping grows it:
    //   z = rest + exp(beta T) (A cos(omega T) + B sin(omega T)).
    const double k = 1000, d = 3, g = 9.81, m = 0.154;
    const long double beta = d / (2 * m), omega = std::sqrt(k / m - beta * beta), rest = m * g / k;
    const long double A = 2 * g * d * d / (k * k) - rest, B = (2 * g * d / k - beta * A) / omega;
    const auto z = [&](long double T) {
        return rest + std::exp(beta * T) * (A * std::cos(omega * T) + B * std::sin(omega * T));
    };
    long double high = 1e-5L;
    while (z(high) > 0) high += 1e-5L;
    long double low = high - 1e-5L;
    for (int i = 0; i < 100; ++i) {
        const long double middle = (low + high) / 2;
        (z(middle) > 0 ? low : high) = middle;
    }
    const long double speed = -std::exp(beta * low) * ((beta * A + omega * B) * std::cos(omega * low) +
                                                       (beta * B - omega * A) * std::sin(omega * low));
    const auto threshold = slowest_bounce(LinearNormal<>{k, d}, m, {.gravity = g, .tolerance = 1e-13});
    ASSERT_TRUE(threshold.has_value());
    EXPECT_NEAR(*threshold / static_cast<double>(speed), 1, 1e-8);
}

TEST(SlowestBounce, IsZeroWithoutLoss) {
    EXPECT_EQ(slowest_bounce(AzadFeatherstoneNormal<>{8.5e6, 0}, mass, {.gravity = 9.81}), 0.0);
    EXPECT_THROW((void)slowest_bounce(paper, mass, {}), InvalidInput);
}

TEST(Theory, OfZeroForceMeetsTheIntegrationToTheOrderOfItsLastTerm) {
    // The error of a series to B^10 falls as B^(21/2).
    std::array<double, 2> errors{};
    const std::array<double, 2> numbers{0.6, 0.3};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto exact = oracle::impact<long double>(oracle::ImpactLaw::azad_featherstone, 1.0L, 1.0L,
                                                       static_cast<long double>(numbers[i]), 1.0L);
        errors[i] = std::abs(zero_force_series(numbers[i]) - static_cast<double>(exact.speed_out));
    }
    EXPECT_LT(errors[1], 1e-6);
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), 10.5, 1);
    for (const double B : {1e-3, 1e-2, 0.05}) {
        const auto exact = oracle::impact<long double>(oracle::ImpactLaw::azad_featherstone, 1.0L, 1.0L,
                                                       static_cast<long double>(B), 1.0L);
        EXPECT_NEAR(zero_force_series(B), static_cast<double>(exact.speed_out), 1e-12) << B;
    }
}

TEST(Theory, PadeApproximantIsNearForEveryNumber) {
    for (double B = 1e-3; B < 1e3; B *= 3) {
        const auto exact = oracle::impact<long double>(oracle::ImpactLaw::azad_featherstone, 1.0L, 1.0L,
                                                       static_cast<long double>(B), 1.0L);
        EXPECT_NEAR(zero_force_pade(B), static_cast<double>(exact.speed_out), 0.01) << B;
    }
}

TEST(Theory, OfZeroDepthAndZeroForceDifferByFourFifteenthsOfBToTheFiveHalves) {
    for (const double B : {1e-4, 1e-3}) {
        const double difference = zero_force_series(B) - zero_depth_series(B);
        EXPECT_NEAR(difference / (4.0 / 15 * std::pow(B, 2.5)), 1, 2 * std::sqrt(B) * B + 0.02) << B;
    }
}

TEST(Theory, FirstCoefficientIsTheBetaFunctionOfRamirez) {
    const double B = 1e-9;
    EXPECT_NEAR((1 - zero_depth_series(B)) / B, static_cast<double>(oracle::viscoelastic_slope()), 1e-6);
    EXPECT_NEAR((1 - zero_force_pade(B)) / B, 1.15344, 1e-4);
}

TEST(Theory, ClosedFormsMeetIndependentOnes) {
    for (const double a : {1e-7, 1e-5, 4e-4, 6e-4, 1e-3, 0.1, 0.9, 1.1, 10.0, 1e4}) {
        EXPECT_NEAR(hunt_crossley_restitution(2, a, 2), static_cast<double>(oracle::hunt_crossley_restitution(2, a, 2)),
                    1e-10)
            << a;
    }
    const double critical = 2 * std::sqrt(2.5e5 * mass);
    for (const double d : {0.0, 1.0, 60.0, 277.0, critical, 1000.0, 1e6}) {
        const double square = 2.5e5 / mass - d * d / (4 * mass * mass);
        if (square == 0) {
            EXPECT_NEAR(linear_restitution(mass, 2.5e5, d), std::exp(-2.0), 1e-9);
        } else {
            EXPECT_NEAR(linear_restitution(mass, 2.5e5, d),
                        static_cast<double>(oracle::linear_restitution(mass, 2.5e5, d)), 1e-9)
                << d;
        }
    }
}

TEST(Theory, OfEveryLawMeetsItsSimulation) {
    int compared = 0;
    for_each_law<NormalLaw>([&]<class Law>(Law law) {
        for (const auto& parameter : Law::parameters()) {
            law.*parameter.member = parameter.fallback.value_or(parameter.key == "stiffness" ? 1e6 : 0.7);
        }
        // Damping of the size of the stiffness over the speed, where the law's own is a coefficient of force.
        if constexpr (requires { law.damping; }) law.damping = 300;
        if constexpr (requires { law.damping_time; }) law.damping_time = 1e-4;
        for (const RestitutionTheory& theory : theories_of(law, mass)) {
            if (theory.name != "closed_form" && theory.name != "schwager_poeschel") continue;
            ++compared;
            for (const double speed : {0.01, 0.1}) {
                EXPECT_NEAR(theory.restitution(speed), normal_impact(law, mass, speed).restitution, 1e-9)
                    << Law::description.name << " " << theory.name << " " << speed;
            }
        }
    });
    EXPECT_GE(compared, 3);
}

TEST(Theory, ClosedFormIsNotOfferedForOtherExponents) {
    EXPECT_TRUE(theories_of(HuntCrossleyNormal<>{1, 1, 1.5, 1.0, 1}, 1).empty());
    EXPECT_TRUE(theories_of(HuntCrossleyNormal<>{1, 1, 1.5, 1.5, 2}, 1).empty());
    // n = p: the exponent cancels.
    const HuntCrossleyNormal<> soft{1e4, 5e3, 1.1, 1.1, 1};
    const auto theories = theories_of(soft, mass);
    ASSERT_EQ(theories.size(), 1u);
    EXPECT_NEAR(theories[0].restitution(1.5), normal_impact(soft, mass, 1.5).restitution, 1e-9);
}

TEST(LogLinearRange, FindsTheInflectionOfTheUniversalCurve) {
    // e depends on ln B = ln beta + (ln v)/5, so every sphere has the same e at its inflection.
    const auto first = log_linear_range(AzadFeatherstoneNormal<>{1, 1}, 1, 1e-12, 1e12, 0.01);
    const auto second = log_linear_range(AzadFeatherstoneNormal<>{8.5e6, 3.1e4}, mass, 1e-9, 1e9, 0.01);
    ASSERT_TRUE(first && second);
    EXPECT_NEAR(first->restitution, second->restitution, 1e-3);
    EXPECT_NEAR(first->fastest / first->slowest / (second->fastest / second->slowest), 1, 1e-2);
    EXPECT_LT(first->slowest, first->speed);
    EXPECT_GT(first->fastest, first->speed);
    // At the ends the curve is off the tangent by what was asked for.
    for (const double end : {first->slowest, first->fastest}) {
        const double tangent = first->restitution + first->slope * std::log(end / first->speed);
        const auto exact = oracle::impact<long double>(oracle::ImpactLaw::azad_featherstone, 1.0L, 1.0L, 1.0L, end);
        EXPECT_NEAR(std::abs(static_cast<double>(exact.speed_out / end) - tangent), 0.01, 1e-6);
    }
}

TEST(LogLinearRange, IsEmptyWhereThereIsNoInflection) {
    EXPECT_FALSE(log_linear_range(LinearNormal<>{1000, 3}, 1, 1e-3, 10, 0.01).has_value());
    EXPECT_FALSE(log_linear_range(paper, mass, 1e-9, 1e-7, 0.01).has_value());
}

TEST(Speeds, IncludeBothEnds) {
    const auto even = linear_speeds(1, 3, 3);
    EXPECT_EQ(even, (std::vector<double>{1, 2, 3}));
    const auto logarithmic = logarithmic_speeds(0.01, 10, 4);
    ASSERT_EQ(logarithmic.size(), 4u);
    EXPECT_EQ(logarithmic.front(), 0.01);
    EXPECT_NEAR(logarithmic[1], 0.1, 1e-15);
    EXPECT_EQ(logarithmic.back(), 10);
    EXPECT_THROW((void)linear_speeds(1, 1, 3), InvalidInput);
    EXPECT_THROW((void)logarithmic_speeds(0, 1, 3), InvalidInput);
    EXPECT_THROW((void)logarithmic_speeds(1, 2, 1), InvalidInput);
}

TEST(RestitutionStudy, TabulatesEveryCaseWithItsTheory) {
    RestitutionStudy study{.title = "two",
                           .cases = {{"paper", paper, mass, 0.0165}, {"classical", classical, mass, 0.0165}},
                           .speeds = {0.5, 1},
                           .options = {}};
    const Table rows = table(restitution(study));
    std::vector<std::string> names;
    for (const Column& column : rows.columns) {
        names.push_back(column.series.empty() ? column.name : column.series + "." + column.name);
        EXPECT_EQ(column.values.size(), 2u) << column.name;
    }
    const std::vector<std::string> expected{"speed",
                                            "paper.restitution",
                                            "classical.restitution",
                                            "paper.ramirez",
                                            "paper.schwager_poeschel",
                                            "paper.mueller_poeschel",
                                            "classical.closed_form",
                                            "paper.peak_force",
                                            "classical.peak_force",
                                            "paper.peak_indentation",
                                            "classical.peak_indentation",
                                            "paper.separation",
                                            "classical.separation",
                                            "paper.recovered",
                                            "classical.recovered"};
    EXPECT_EQ(names, expected);
    EXPECT_NEAR(rows.columns[2].values[1], rows.columns[6].values[1], 1e-10);
    study.speeds.clear();
    EXPECT_THROW((void)restitution(study), InvalidInput);
}

TEST(PaperFigures, HaveTheCurvesOfTheirCaptions) {
    EXPECT_EQ(paper_figure(2).cases.size(), 3u);
    EXPECT_EQ(paper_figure(3).cases.size(), 5u);
    EXPECT_EQ(paper_figure(4).cases.size(), 4u);
    EXPECT_THROW((void)paper_figure(5), InvalidInput);
    // Figure 2: the linear law is constant and meets the paper's law at 1 m/s, and the three differ elsewhere.
    const RestitutionStudy study = paper_figure(2);
    const double at_one = normal_impact(study.cases[0].law, mass, 1).restitution;
    for (const double speed : {0.1, 1.0, 10.0}) {
        EXPECT_NEAR(normal_impact(study.cases[2].law, mass, speed).restitution, at_one, 1e-10);
    }
    // Figure 4: a 1.27 cm steel sphere weighs 67 g.
    EXPECT_NEAR(paper_figure(4).cases[0].mass, 0.0674, 1e-4);
}

}  // namespace
}  // namespace footfall
