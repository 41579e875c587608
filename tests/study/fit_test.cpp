// Fits of laws to measurements: against traces and curves that an integration of its own makes, closed forms, and what
// is known of which parameters data can tell.
#include "footfall/study/fit.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "oracle/impact.hpp"
#include "study/drop_impact.hpp"
#include "study/synthetic_impact.hpp"

namespace footfall {
namespace {

using study::Branch;
using study::DropImpact;

constexpr double K_n = 8.5e6, D_n = 3.1e3, mass = 0.154;  // Azad & Featherstone 2010, section 2.2
const synthetic::Impact impact{K_n, D_n, mass, 1};

bool contains(const std::string& text, std::string_view words) { return text.find(words) != std::string::npos; }

FitValue given(double value) { return {.value = value}; }
FitLaw::Free free(const char* key) { return {key, {.free = true}}; }

std::vector<double> times() {
    std::vector<double> t;
    for (int i = 1; i <= 60; ++i) t.push_back(impact.duration() * i / 50);
    return t;
}
FitData force_time(double noise = 0) {
    FitData data{.kind = Measured::force_time, .source = "trace", .x = times(), .y = impact.force_at(times())};
    std::mt19937_64 random(7);
    std::normal_distribution<double> gaussian(0, 1);
    for (double& f : data.y) f += noise * gaussian(random);
    return data;
}
FitData force_indentation() {
    FitData data{.kind = Measured::force_indentation, .source = "loop"};
    int step = 0;
    for (synthetic::Impact::State y{0, 1, 0}; !impact.over(y); y = impact.step(y, impact.step_size())) {
        if (step++ % 50 != 7) continue;
        data.x.push_back(y[0] * y[0]);
        data.rate.push_back(y[1]);
        data.y.push_back(impact.force(y));
    }
    return data;
}
FitData restitution(double wiggle = 0) {
    FitData data{.kind = Measured::restitution, .source = "curve"};
    for (int i = 0; i < 12; ++i) {
        const double v = 0.01 * std::pow(500, i / 11.0);
        const auto hit = oracle::impact<long double>(oracle::ImpactLaw::azad_featherstone, mass, K_n, D_n, v);
        data.x.push_back(v);
        data.y.push_back(static_cast<double>(hit.speed_out) / v + wiggle * std::sin(5.0 * i));
    }
    return data;
}
FitStudy study_of(FitData data, const NormalLaw& law, std::vector<FitLaw::Free> parameters) {
    return {.data = std::move(data), .laws = {{law, std::move(parameters)}}, .mass = given(mass), .speed = given(1)};
}
const NormalLaw paper = AzadFeatherstoneNormal<>{1, 1};

// The impact ---------------------------------------------------------------------------------------------------------

TEST(DropImpact, LeavesWithTheSpeedOfAnIndependentIntegration) {
    struct Case {
        NormalLaw law;
        oracle::ImpactLaw kind;
        double stiffness, damping;
    };
    for (const Case& c : {Case{AzadFeatherstoneNormal<>{K_n, D_n}, oracle::ImpactLaw::azad_featherstone, K_n, D_n},
                          Case{AzadFeatherstoneNormal<>{K_n, 0}, oracle::ImpactLaw::azad_featherstone, K_n, 0},
                          Case{HuntCrossleyNormal<>{K_n, 3.1e6}, oracle::ImpactLaw::hunt_crossley, K_n, 3.1e6},
                          Case{LinearNormal<>{2.5e5, 60}, oracle::ImpactLaw::linear, 2.5e5, 60}}) {
        for (const double v : {1e-3, 0.1, 10.0}) {
            const auto expected = oracle::impact<long double>(c.kind, mass, c.stiffness, c.damping, v);
            const auto out = DropImpact<double>(c.law, mass, v).speed_out();
            ASSERT_TRUE(out.has_value());
            EXPECT_NEAR(*out / v, static_cast<double>(expected.speed_out) / v, 1e-9) << name_of(c.law) << " " << v;
        }
    }
}

TEST(DropImpact, FollowsALawThatIsNotSmoothAtTouchdown) {
    // Tsuji et al.'s restitution is a parameter, and met at every speed.
    for (const double v : {0.01, 1.0}) {
        const auto out = DropImpact<double>(TsujiNormal<>{K_n, mass, 0.6}, mass, v).speed_out();
        ASSERT_TRUE(out.has_value());
        EXPECT_NEAR(*out / v, 0.6, 1e-8);
    }
}

TEST(DropImpact, GivesTheForceAtEveryTime) {
    const std::vector<double> t = times();
    std::vector<double> forces(t.size());
    ASSERT_TRUE(DropImpact<double>(AzadFeatherstoneNormal<>{K_n, D_n}, mass, 1).force_at_times(t, forces));
    const std::vector<double> expected = impact.force_at(t);
    for (std::size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(forces[i], expected[i], 1e-5) << i;  // of 200 N
    EXPECT_EQ(forces.back(), 0);
}

TEST(DropImpact, GivesTheForceOnBothWaysThroughADepth) {
    const FitData loop = force_indentation();
    std::vector<Branch> branches;
    for (const double rate : loop.rate) branches.push_back(rate > 0 ? Branch::loading : Branch::unloading);
    std::vector<double> forces(loop.x.size());
    ASSERT_TRUE(
        DropImpact<double>(AzadFeatherstoneNormal<>{K_n, D_n}, mass, 1).force_at_depths(loop.x, branches, forces));
    for (std::size_t i = 0; i < forces.size(); ++i) EXPECT_NEAR(forces[i], loop.y[i], 1e-3) << i;
}

TEST(DropImpact, DualNumbersGiveTheSlopesThatDifferencesGive) {
    using D = Dual<double, 4>;
    const auto var = [](double x, int i) { return D::variable(x, i); };
    const std::array<double, 4> x{K_n, D_n, mass, 1.0};
    std::vector<double> t = times();
    t.pop_back();
    const auto forces = [&](const std::array<double, 4>& p) {
        std::vector<double> f(t.size());
        EXPECT_TRUE(DropImpact<double>(AzadFeatherstoneNormal<>{p[0], p[1]}, p[2], p[3], 1e-13).force_at_times(t, f));
        return f;
    };
    const auto speed = [&](const std::array<double, 4>& p) {
        return *DropImpact<double>(AzadFeatherstoneNormal<>{p[0], p[1]}, p[2], p[3], 1e-13).speed_out();
    };
    const DropImpact<D> dual(AzadFeatherstoneNormal<D>{var(x[0], 0), var(x[1], 1)}, var(x[2], 2), var(x[3], 3));
    std::vector<D> dual_times(t.begin(), t.end()), dual_forces(t.size());
    ASSERT_TRUE(dual.force_at_times(dual_times, dual_forces));
    const D out = *dual.speed_out();
    for (std::size_t j = 0; j < 4; ++j) {
        auto low = x, high = x;
        const double h = 1e-4 * x[j];
        low[j] -= h, high[j] += h;
        EXPECT_NEAR(out.gradient[j] * x[j], (speed(high) - speed(low)) / 2e-4, 1e-7) << j;
        const auto a = forces(low), b = forces(high);
        for (std::size_t i = 0; i < t.size(); ++i) {
            if (t[i] > 0.98 * impact.duration() && t[i] < 1.02 * impact.duration()) continue;  // a kink lies between
            EXPECT_NEAR(dual_forces[i].gradient[j] * x[j], (b[i] - a[i]) / 2e-4, 1e-3) << j << " " << i;  // of 200 N
        }
    }
}

// Recovery -----------------------------------------------------------------------------------------------------------

TEST(Fit, FindsTheTruthInDataWithoutNoise) {
    FitStudy with_rate = study_of(force_indentation(), paper, {free("stiffness"), free("damping")});
    with_rate.mass = with_rate.speed = {};
    FitStudy without_rate = study_of(force_indentation(), paper, {free("stiffness"), free("damping")});
    without_rate.data.rate.clear();
    const FitStudy trace = study_of(force_time(), paper, {free("stiffness"), free("damping")});
    for (const FitStudy& s : {with_rate, without_rate, trace}) {
        const FitStudyResult result = fit(s);
        const FitResult& r = result.fits[0].result;
        EXPECT_TRUE(r.converged);
        EXPECT_NEAR(r.estimates[0].value / K_n, 1, 1e-6) << s.data.source;
        EXPECT_NEAR(r.estimates[1].value / D_n, 1, 1e-6) << s.data.source;
        EXPECT_LT(result.fits[0].rms, 1e-3);
        EXPECT_EQ(std::get<AzadFeatherstoneNormal<>>(result.fits[0].law).stiffness, r.estimates[0].value);
    }
}

TEST(Fit, FindsExponentsToo) {
    // The paper's law is Hunt and Crossley's general one with p = 1/2.
    const FitStudyResult result = fit(study_of(force_indentation(), HuntCrossleyNormal<>{1, 1},
                                               {free("stiffness"), free("damping"), free("n"), free("p")}));
    const FitResult& r = result.fits[0].result;
    EXPECT_NEAR(r.estimates[2].value, 1.5, 1e-5);
    EXPECT_NEAR(r.estimates[3].value, 0.5, 1e-5);
    EXPECT_NEAR(r.estimates[0].value / K_n, 1, 1e-4);
}

TEST(Fit, FindsWhenAndHowFastTheImpactBegan) {
    FitStudy s = study_of(force_time(0.5), paper, {free("stiffness"), free("damping")});
    for (double& t : s.data.x) t += 3e-4;
    s.speed = {.value = 0.9, .free = true};
    s.touchdown = {.value = 2.8e-4, .free = true};
    const FitResult r = fit(s).fits[0].result;
    ASSERT_EQ(r.estimates.size(), 5U);
    EXPECT_NEAR(r.estimates[3].value, 1, 4 * *r.estimates[3].standard_error);
    EXPECT_LT(*r.estimates[3].standard_error, 0.02);
    EXPECT_NEAR(r.estimates[4].value, 3e-4, 4 * *r.estimates[4].standard_error);
    EXPECT_LT(*r.estimates[4].standard_error, 1e-5);
}

TEST(Fit, TakesASlowLoadingAsElastic) {
    FitStudy s{.data = {.kind = Measured::force_indentation, .source = "press"},
               .laws = {{paper, {free("stiffness")}}}};
    for (int i = 1; i <= 10; ++i) {
        s.data.x.push_back(1e-5 * i);
        s.data.y.push_back(K_n * std::pow(1e-5 * i, 1.5));
    }
    s.quasistatic = true;
    EXPECT_NEAR(fit(s).fits[0].result.estimates[0].value / K_n, 1, 1e-9);
}

TEST(Fit, AnOutlierCostsARobustLossLittle) {
    FitStudy s = study_of(force_time(0.5), paper, {free("stiffness"), free("damping")});
    s.data.y[20] += 150;
    const double plain = fit(s).fits[0].result.estimates[1].value;
    s.options.loss = Loss::cauchy;
    const double robust = fit(s).fits[0].result.estimates[1].value;
    EXPECT_LT(std::abs(robust / D_n - 1), 0.01);
    EXPECT_GT(std::abs(plain / D_n - 1), 0.03);
}

// What restitution can tell ------------------------------------------------------------------------------------------

TEST(Fit, RestitutionAloneTellsOneCombinationOnly) {
    const FitStudyResult result = fit(study_of(restitution(0.01), paper, {free("stiffness"), free("damping")}));
    const FitResult& r = result.fits[0].result;
    ASSERT_EQ(r.combinations.size(), 1U);
    const FitCombination& c = r.combinations[0];
    EXPECT_EQ(c.text, "damping stiffness^(-3/5) mass^(-2/5)");
    ASSERT_EQ(c.exponents.size(), 3U);
    EXPECT_NEAR(c.exponents[0], -0.6, 1e-4);
    EXPECT_NEAR(c.exponents[1], 1, 1e-12);
    EXPECT_NEAR(c.exponents[2], -0.4, 1e-4);
    const double truth = D_n * std::pow(K_n, -0.6) * std::pow(mass, -0.4);
    EXPECT_NEAR(c.value, truth, 4 * c.standard_error);
    EXPECT_LT(c.standard_error, 0.05 * truth);
    EXPECT_FALSE(r.estimates[0].standard_error.has_value());
    EXPECT_FALSE(r.estimates[1].standard_error.has_value());
    ASSERT_FALSE(r.warnings.empty());
    EXPECT_TRUE(contains(r.warnings[0], "do not determine stiffness and damping one by one")) << r.warnings[0];

    // With the stiffness given, the damping carries the same relative error.
    const FitResult alone =
        fit(study_of(restitution(0.01), AzadFeatherstoneNormal<>{K_n, 1}, {free("damping")})).fits[0].result;
    EXPECT_NEAR(alone.estimates[0].value * std::pow(K_n, -0.6) * std::pow(mass, -0.4), c.value, 1e-6 * c.value);
    EXPECT_NEAR(*alone.estimates[0].standard_error / alone.estimates[0].value, c.standard_error / c.value, 1e-5);
}

TEST(Fit, RestitutionAloneDoesNotTellTheMassEither) {
    FitStudy s = study_of(restitution(0.01), paper, {free("stiffness"), free("damping")});
    s.mass = FitValue{.value = 0.2, .free = true};
    const FitResult r = fit(s).fits[0].result;
    ASSERT_EQ(r.combinations.size(), 1U);
    EXPECT_EQ(r.combinations[0].text, "damping stiffness^(-3/5) mass^(-2/5)");
    EXPECT_FALSE(r.estimates[2].standard_error.has_value());
}

TEST(Fit, HuntAndCrossleysRestitutionTellsTheirRatioAlone) {
    // (2) depends on lambda v / k only: oracle::hunt_crossley_restitution.
    FitStudy s = study_of({.kind = Measured::restitution, .source = "curve"}, HuntCrossleyNormal<>{1, 1},
                          {free("stiffness"), free("damping")});
    for (int i = 0; i < 8; ++i) {
        const double v = 0.1 * (i + 1);
        s.data.x.push_back(v);
        s.data.y.push_back(static_cast<double>(oracle::hunt_crossley_restitution(K_n, 3.1e6L, v)) +
                           1e-3 * std::sin(4 * i));
    }
    const FitResult r = fit(s).fits[0].result;
    ASSERT_EQ(r.combinations.size(), 1U);
    EXPECT_EQ(r.combinations[0].text, "damping stiffness^(-1)");
    EXPECT_NEAR(r.combinations[0].value, 3.1e6 / K_n, 4 * r.combinations[0].standard_error);
}

// Comparison ---------------------------------------------------------------------------------------------------------

TEST(Fit, TheLawThatMadeTheDataWinsAndItsTwinTies) {
    FitStudy s = study_of(force_time(1.0), HuntCrossleyNormal<>{1, 1}, {free("stiffness"), free("damping")});
    s.laws.push_back({paper, {free("stiffness"), free("damping")}});
    s.laws.push_back({KuwabaraKonoNormal<>{1, 1}, {free("stiffness"), free("damping_time")}});
    const FitStudyResult result = fit(s);
    EXPECT_NEAR(result.fits[1].result.aicc, result.fits[2].result.aicc, 1e-5);
    EXPECT_GT(result.fits[0].aicc_difference, 10);
    EXPECT_LT(result.fits[0].weight, 0.01);
    EXPECT_NEAR(result.fits[1].weight + result.fits[2].weight, 1, 0.01);
    // D_n = (3/2) A K_n.
    const auto& a = result.fits[1].result.estimates;
    const auto& b = result.fits[2].result.estimates;
    EXPECT_NEAR(a[1].value / (1.5 * b[1].value * b[0].value), 1, 1e-6);
    const Table t = table(result);
    ASSERT_EQ(t.columns.size(), 8U);  // time, force, and a model and a residual for each law
    EXPECT_EQ(t.columns[2].series, "hunt-crossley");
    EXPECT_NEAR(t.columns[2].values[5] + t.columns[3].values[5], t.columns[1].values[5], 1e-9);
}

TEST(Fit, SaysWhatIsMissing) {
    const auto fails = [](const FitStudy& s, std::string_view words) {
        try {
            (void)fit(s);
            ADD_FAILURE() << words;
        } catch (const InvalidInput& error) {
            EXPECT_TRUE(contains(error.what(), words)) << error.what();
        }
    };
    const FitStudy good = study_of(force_time(), paper, {free("stiffness"), free("damping")});
    FitStudy bad = good;
    bad.mass = {};
    fails(bad, "trace: mass [kg] is needed to follow an impact");
    bad = good;
    bad.laws[0].free[0].key = "hardness";
    fails(bad, "'azad-featherstone' has no parameter 'hardness'");
    bad = good;
    bad.laws.clear();
    fails(bad, "at least one law");
    bad = good;
    std::swap(bad.data.x[3], bad.data.x[4]);
    fails(bad, "times must be in order");
    bad = study_of(force_indentation(), paper, {free("stiffness")});
    bad.data.rate.clear();
    bad.mass = {};
    fails(bad, "the rate of indentation is needed");
    bad = study_of(restitution(), paper, {free("damping")});
    bad.data.y[3] = 1.2;
    fails(bad, "restitution 1.2 must lie between 0 and 1");
    bad = good;
    bad.laws[0].free[1].value = {.value = 10, .free = true, .low = 20, .high = 30};
    fails(bad, "damping: the start 10");
}

}  // namespace
}  // namespace footfall
