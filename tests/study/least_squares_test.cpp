// Nonlinear least squares against certified regressions, closed forms of linear regression, and problems whose
// determined combinations are known.
#include "footfall/study/least_squares.hpp"

#include <array>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace footfall {
namespace {

bool contains(const std::string& text, std::string_view words) { return text.find(words) != std::string::npos; }

/// r_i = y_i - model(x_i, b)
template <std::size_t N>
LeastSquaresProblem regression(const std::array<double, N>& x, const std::array<double, N>& y,
                               std::vector<FitParameter> parameters,
                               std::function<double(double x, std::span<const double> b)> model) {
    return {.parameters = std::move(parameters),
            .residual_count = N,
            .residuals = [x, y, model = std::move(model)](std::span<const double> b, std::span<double> r) {
                for (std::size_t i = 0; i < N; ++i) r[i] = y[i] - model(x[i], b);
            }};
}

// NIST Statistical Reference Datasets, nonlinear regression, Misra1a: dental research, monomolecular adsorption.
constexpr std::array misra_x{77.6,  114.9, 141.1, 190.8, 239.9, 289.0, 332.8,
                             378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0};
constexpr std::array misra_y{10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02,
                             44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78};

LeastSquaresProblem misra1a(bool logarithmic) {
    return regression(misra_x, misra_y,
                      {{.name = "b1", .start = 500, .logarithmic = logarithmic},
                       {.name = "b2", .start = 1e-4, .logarithmic = logarithmic}},
                      [](double x, std::span<const double> b) { return b[0] * (1 - std::exp(-b[1] * x)); });
}

TEST(LeastSquares, GivesTheCertifiedEstimatesAndErrorsOfMisra1a) {
    for (const bool logarithmic : {false, true}) {
        const FitResult fit = fit_least_squares(misra1a(logarithmic));
        EXPECT_TRUE(fit.converged);
        EXPECT_NEAR(fit.estimates[0].value / 2.3894212918e+02, 1, 1e-8);
        EXPECT_NEAR(fit.estimates[1].value / 5.5015643181e-04, 1, 1e-8);
        EXPECT_NEAR(fit.estimates[0].standard_error.value() / 2.7070075241, 1, 1e-6);
        EXPECT_NEAR(fit.estimates[1].standard_error.value() / 7.2668688436e-06, 1, 1e-6);
        EXPECT_NEAR(fit.sum_of_squares / 1.2455138894e-01, 1, 1e-9);
        EXPECT_NEAR(fit.noise / 1.0187876330e-01, 1, 1e-9);
        EXPECT_EQ(fit.degrees_of_freedom, 12);
    }
}

TEST(LeastSquares, AnOwnJacobianGivesWhatDifferencesGive) {
    LeastSquaresProblem problem = misra1a(true);
    problem.jacobian = [plain = problem.residuals](std::span<const double> b, std::span<double> r,
                                                   std::span<double> J) {
        plain(b, r);
        for (std::size_t i = 0; i < misra_x.size(); ++i) {
            J[2 * i] = -(1 - std::exp(-b[1] * misra_x[i]));
            J[2 * i + 1] = -b[0] * misra_x[i] * std::exp(-b[1] * misra_x[i]);
        }
    };
    const FitResult own = fit_least_squares(problem), differences = fit_least_squares(misra1a(true));
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_NEAR(own.estimates[i].value / differences.estimates[i].value, 1, 1e-9);
        EXPECT_NEAR(*own.estimates[i].standard_error / *differences.estimates[i].standard_error, 1, 1e-7);
    }
    EXPECT_LT(own.evaluations, differences.evaluations);
}

// A straight line has everything in closed form.
constexpr std::array line_x{1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
constexpr std::array line_y{5.1, 6.9, 9.2, 10.8, 13.1, 15.2};
const auto line = [](double x, std::span<const double> b) { return b[0] + b[1] * x; };

TEST(LeastSquares, IntervalsCorrelationAndAiccAreThoseOfLinearRegression) {
    const FitResult fit =
        fit_least_squares(regression(line_x, line_y, {{.name = "a", .start = -3}, {.name = "b", .start = 1}}, line));
    const double n = 6, mean = 3.5, Sxx = 17.5, Sxy = 35.35, y_mean = 60.3 / 6;
    const double b = Sxy / Sxx, a = y_mean - b * mean;
    double rss = 0;
    for (std::size_t i = 0; i < 6; ++i) rss += std::pow(line_y[i] - a - b * line_x[i], 2);
    const double s = std::sqrt(rss / (n - 2));
    EXPECT_NEAR(fit.estimates[0].value, a, 1e-6 * *fit.estimates[0].standard_error);
    EXPECT_NEAR(fit.estimates[1].value, b, 1e-6 * *fit.estimates[1].standard_error);
    EXPECT_NEAR(*fit.estimates[1].standard_error, s / std::sqrt(Sxx), 1e-8);
    EXPECT_NEAR(*fit.estimates[0].standard_error, s * std::sqrt(1 / n + mean * mean / Sxx), 1e-8);
    // Student's t, four degrees of freedom, 97.5 %: 2.776445 (tables).
    EXPECT_NEAR((fit.estimates[1].interval->high - b) / *fit.estimates[1].standard_error, 2.776445, 1e-6);
    EXPECT_NEAR(fit.correlation[0][1], -mean / std::sqrt(Sxx / n + mean * mean), 1e-8);
    EXPECT_EQ(fit.correlation[0][0], 1);
    const double k = 3;  // intercept, slope, noise
    EXPECT_NEAR(fit.aicc, n * std::log(rss / n) + 2 * k + 2 * k * (k + 1) / (n - k - 1), 1e-8);
    EXPECT_NEAR(fit.rms, std::sqrt(rss / n), 1e-10);
    EXPECT_TRUE(fit.warnings.empty());
}

TEST(LeastSquares, AKnownNoiseIsTakenAtItsWord) {
    LeastSquaresProblem problem =
        regression(line_x, line_y, {{.name = "a", .start = 0}, {.name = "b", .start = 1}}, line);
    problem.residuals = [plain = problem.residuals](std::span<const double> b, std::span<double> r) {
        plain(b, r);
        for (double& value : r) value /= 0.5;
    };
    const FitResult fit = fit_least_squares(problem, {.noise_is_known = true});
    EXPECT_NEAR(*fit.estimates[1].standard_error, 0.5 / std::sqrt(17.5), 1e-9);
    EXPECT_NEAR((fit.estimates[1].interval->high - fit.estimates[1].value) / *fit.estimates[1].standard_error, 1.959964,
                1e-6);
}

// Brownlee's stack loss data, the usual example of robust regression. The expected values are those that R's MASS::rlm
// (coefficients, scale) and Python's statsmodels RLM with covariance H1 (errors) publish in their documentation.
TEST(LeastSquares, HuberOnTheStackLossDataGivesThePublishedRobustRegression) {
    constexpr std::array<std::array<double, 4>, 21> stackloss{
        {{80, 27, 89, 42}, {80, 27, 88, 37}, {75, 25, 90, 37}, {62, 24, 87, 28}, {62, 22, 87, 18}, {62, 23, 87, 18},
         {62, 24, 93, 19}, {62, 24, 93, 20}, {58, 23, 87, 15}, {58, 18, 80, 14}, {58, 18, 89, 14}, {58, 17, 88, 13},
         {58, 18, 82, 11}, {58, 19, 93, 12}, {50, 18, 89, 8},  {50, 18, 86, 7},  {50, 19, 72, 8},  {50, 19, 79, 8},
         {50, 20, 80, 9},  {56, 20, 82, 15}, {70, 20, 91, 15}}};
    const LeastSquaresProblem problem{.parameters = {{.name = "intercept", .start = 0},
                                                     {.name = "air flow", .start = 0},
                                                     {.name = "temperature", .start = 0},
                                                     {.name = "acid", .start = 0}},
                                      .residual_count = 21,
                                      .residuals = [&](std::span<const double> b, std::span<double> r) {
                                          for (std::size_t i = 0; i < 21; ++i) {
                                              const auto& d = stackloss[i];
                                              r[i] = d[3] - b[0] - b[1] * d[0] - b[2] * d[1] - b[3] * d[2];
                                          }
                                      }};
    const FitResult fit = fit_least_squares(problem, {.loss = Loss::huber});
    EXPECT_NEAR(fit.estimates[0].value, -41.02649835, 2e-3);
    EXPECT_NEAR(fit.estimates[1].value, 0.82938433, 2e-5);
    EXPECT_NEAR(fit.estimates[2].value, 0.92606597, 5e-5);
    EXPECT_NEAR(fit.estimates[3].value, -0.12784672, 2e-5);
    EXPECT_NEAR(*fit.estimates[0].standard_error, 9.79189854, 2e-2);
    EXPECT_NEAR(*fit.estimates[1].standard_error, 0.11100521, 2e-4);
    EXPECT_NEAR(*fit.estimates[2].standard_error, 0.30293016, 5e-4);
    EXPECT_NEAR(*fit.estimates[3].standard_error, 0.12864961, 2e-4);
}

TEST(LeastSquares, ARobustLossForgetsAnOutlierThatLeastSquaresFollow) {
    std::array<double, 6> y{};
    constexpr std::array wiggle{0.01, -0.02, 0.015, 0.0, -0.01, 0.012};
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = 1 + 2 * line_x[i] + wiggle[i];
    y[4] += 50;
    const LeastSquaresProblem problem =
        regression(line_x, y, {{.name = "a", .start = 0}, {.name = "b", .start = 1}}, line);
    EXPECT_GT(std::abs(fit_least_squares(problem).estimates[1].value - 2), 1);
    EXPECT_NEAR(fit_least_squares(problem, {.loss = Loss::huber}).estimates[1].value, 2, 0.05);
    EXPECT_NEAR(fit_least_squares(problem, {.loss = Loss::cauchy}).estimates[1].value, 2, 0.05);
}

/// y = g x with g = K^(-3/5) D m^(-2/5), and an offset c that the data know.
LeastSquaresProblem product_problem(bool mass_is_fixed) {
    std::array<double, 6> y{};
    constexpr std::array wiggle{0.01, -0.02, 0.015, 0.0, -0.01, 0.012};
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = 0.5 + 3 * line_x[i] + wiggle[i];
    return regression(line_x, y,
                      {{.name = "K", .start = 20, .logarithmic = true},
                       {.name = "D", .start = 4, .logarithmic = true},
                       {.name = "c", .start = 1, .logarithmic = true},
                       {.name = "m", .start = 2, .logarithmic = true, .fixed = mass_is_fixed}},
                      [](double x, std::span<const double> b) {
                          return std::pow(b[0], -0.6) * b[1] * std::pow(b[3], -0.4) * x + b[2];
                      });
}

TEST(LeastSquares, FindsTheOnlyCombinationThatTheDataDetermine) {
    for (const bool mass_is_fixed : {true, false}) {
        const FitResult fit = fit_least_squares(product_problem(mass_is_fixed));
        ASSERT_EQ(fit.combinations.size(), 1U);
        const FitCombination& c = fit.combinations[0];
        EXPECT_EQ(c.text, "D K^(-3/5) m^(-2/5)");
        EXPECT_NEAR(c.exponents[0], -0.6, 1e-6);
        EXPECT_NEAR(c.exponents[1], 1, 1e-12);
        EXPECT_EQ(c.exponents[2], 0);
        EXPECT_NEAR(c.exponents[3], -0.4, 1e-6);
        // The closed form of the regression y = c + g x.
        double y_mean = 0, Sxy = 0, rss = 0;
        constexpr std::array wiggle{0.01, -0.02, 0.015, 0.0, -0.01, 0.012};
        for (std::size_t i = 0; i < 6; ++i) y_mean += wiggle[i] / 6;
        for (std::size_t i = 0; i < 6; ++i) Sxy += (line_x[i] - 3.5) * wiggle[i];
        for (std::size_t i = 0; i < 6; ++i) {
            rss += std::pow(wiggle[i] - y_mean - Sxy / 17.5 * (line_x[i] - 3.5), 2);
        }
        EXPECT_NEAR(c.value, 3 + Sxy / 17.5, 1e-8);
        EXPECT_NEAR(c.standard_error, std::sqrt(rss / 4 / 17.5), 1e-7);
        EXPECT_EQ(fit.degrees_of_freedom, 4);
        EXPECT_FALSE(fit.estimates[0].standard_error.has_value());
        EXPECT_FALSE(fit.estimates[1].interval.has_value());
        EXPECT_TRUE(fit.estimates[2].standard_error.has_value());
        EXPECT_TRUE(std::isnan(fit.correlation[0][1]));
        ASSERT_FALSE(fit.warnings.empty());
        EXPECT_TRUE(contains(fit.warnings[0],
                             mass_is_fixed ? "do not determine K and D one" : "do not determine K, D and m one"))
            << fit.warnings[0];
        EXPECT_TRUE(contains(fit.warnings[0], "What is known: D K^(-3/5) m^(-2/5)")) << fit.warnings[0];
    }
}

TEST(LeastSquares, SaysWhereTheModelDoesNotDependOnAParameter) {
    const FitResult fit = fit_least_squares(regression(
        line_x, line_y, {{.name = "a", .start = 1}, {.name = "b", .start = 1}, {.name = "idle", .start = 1}}, line));
    EXPECT_TRUE(fit.estimates[0].standard_error && fit.estimates[1].standard_error);
    EXPECT_FALSE(fit.estimates[2].standard_error);
    ASSERT_EQ(fit.warnings.size(), 1U);
    EXPECT_TRUE(contains(fit.warnings[0], "do not determine idle: the model does not depend on it"));
}

TEST(LeastSquares, StaysWithinItsBoundsAndSaysSo) {
    const FitResult fit = fit_least_squares(regression(
        line_x, line_y, {{.name = "a", .start = 4.5, .low = 4, .high = 9}, {.name = "b", .start = 1}}, line));
    EXPECT_EQ(fit.estimates[0].value, 4);
    EXPECT_TRUE(fit.estimates[0].at_bound);
    EXPECT_FALSE(fit.estimates[0].standard_error);
    // The slope of a line through (0, 4): sum x (y - 4) / sum x^2.
    EXPECT_NEAR(fit.estimates[1].value, (1.1 + 5.8 + 15.6 + 27.2 + 45.5 + 67.2) / 91, 1e-9);
    ASSERT_EQ(fit.warnings.size(), 1U);
    EXPECT_TRUE(contains(fit.warnings[0], "a is at its bound"));
}

TEST(LeastSquares, SeveralStartsFindTheDeeperOfTwoMinima) {
    // (b - 1)^2 (b - 40)^2 + a slope: minima near 1 and near 40, the second one deeper.
    LeastSquaresProblem problem{
        .parameters = {{.name = "b", .start = 1.1, .low = 0.1, .high = 100, .logarithmic = true}},
        .residual_count = 2,
        .residuals = [](std::span<const double> b, std::span<double> r) {
            r[0] = std::log(b[0]) * std::log(b[0] / 40);
            r[1] = 0.1 * std::log(b[0] / 50);
        }};
    EXPECT_LT(fit_least_squares(problem).estimates[0].value, 2);
    const FitResult many = fit_least_squares(problem, {.starts = 8});
    EXPECT_NEAR(many.estimates[0].value, 40, 1);
    EXPECT_EQ(many.starts_tried, 8);
    EXPECT_GT(many.starts_agreeing, 1);
    EXPECT_LT(many.starts_agreeing, 8);
}

TEST(LeastSquares, TurnsBackWhereTheModelHasNoValue) {
    // A square root that ends at b = 4; the first step of Gauss and Newton from 3.9 goes beyond.
    const LeastSquaresProblem problem{.parameters = {{.name = "b", .start = 3.9}},
                                      .residual_count = 2,
                                      .residuals = [](std::span<const double> b, std::span<double> r) {
                                          r[0] = std::sqrt(4 - b[0]) - 1.5;
                                          r[1] = 0.01 * (b[0] - 10);
                                      }};
    const FitResult fit = fit_least_squares(problem);
    EXPECT_TRUE(fit.converged);
    EXPECT_NEAR(fit.estimates[0].value, 1.75, 0.02);
}

TEST(LeastSquares, RefusesWhatMakesNoSense) {
    const auto fails = [](const LeastSquaresProblem& problem, std::string_view words, const FitOptions& options = {}) {
        try {
            (void)fit_least_squares(problem, options);
            ADD_FAILURE() << words;
        } catch (const InvalidInput& error) {
            EXPECT_TRUE(contains(error.what(), words)) << error.what();
        }
    };
    fails(regression(line_x, line_y, {{.name = "a", .start = 1, .fixed = true}}, line), "at least one free parameter");
    fails(regression(line_x, line_y, {{.name = "a", .start = 3, .low = 0, .high = 2}}, line), "a: the start 3");
    fails(regression(line_x, line_y, {{.name = "a", .start = 0, .logarithmic = true}}, line), "a: the start 0");
    LeastSquaresProblem few = misra1a(false);
    few.residual_count = 1;
    fails(few, "1 data cannot determine 2 parameters");
    fails(misra1a(false), "starts 0", {.starts = 0});
    fails(misra1a(false), "confidence 1", {.confidence = 1});
    LeastSquaresProblem nowhere = misra1a(false);
    nowhere.residuals = [](std::span<const double>, std::span<double> r) { r[0] = NAN; };
    fails(nowhere, "no value at any starting point");
}

}  // namespace
}  // namespace footfall
