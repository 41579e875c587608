// Nonlinear least squares with an account of what the data say: estimates, errors, intervals, correlations, AICc, and
// which combinations of the parameters the data determine where they do not determine them all.
//
// The minimum is Ceres's (trust region, dense QR). Everything else is computed from the Jacobian at the minimum.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "footfall/math/error.hpp"
#include "footfall/study/go_on.hpp"

namespace footfall {

/// One argument of the model.
struct FitParameter {
    std::string name;
    std::string unit = "1";
    double start = 1;  ///< where the search begins; the value, where it is fixed
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    /// Positive, searched in its logarithm; its interval is symmetric there. A bound `low` <= 0 means none.
    bool logarithmic = false;
    /// Given, not fitted. It still has a place among the arguments, so that where the data determine a combination
    /// only, its part in that is found.
    bool fixed = false;
};

/// What a residual counts for, r in units of the noise: the sum of rho(r^2) is minimised.
enum class Loss {
    none,    ///< r^2
    huber,   ///< r^2 up to 1.345, linear beyond. Huber 1964; 95 % efficient for Gaussian noise.
    cauchy,  ///< c^2 log(1 + r^2/c^2), c = 2.385. Holland & Welsch 1977; 95 % efficient for Gaussian noise.
};

/// Residuals of a model as a function of its arguments.
struct LeastSquaresProblem {
    std::vector<FitParameter> parameters;
    std::size_t residual_count = 0;
    /// Writes the residuals at `x` (all parameters, fixed ones too), each divided by its standard deviation as far as
    /// that is known. A residual that is not finite says that the model has no value there; the search turns back.
    std::function<void(std::span<const double> x, std::span<double> residuals)> residuals;
    /// Writes the same residuals and their derivatives, d residual i / d x_j at i * parameters.size() + j. Where it is
    /// missing, differences of fourth order take its place.
    std::function<void(std::span<const double> x, std::span<double> residuals, std::span<double> jacobian)> jacobian =
        nullptr;
};

struct FitOptions {
    Loss loss = Loss::none;
    /// Points to start from, >= 1: the given one, and others spread evenly in the logarithm over the bounds, or over
    /// two decades to each side where there are none. (A parameter that is not logarithmic: over the bounds where there
    /// are two, else by its own size to each side.)
    int starts = 1;
    double confidence = 0.95;  ///< of the intervals, in (0, 1)
    /// The standard deviations in the residuals are true ones. Otherwise only their ratios are used, and the size of
    /// the noise is estimated from the residuals.
    bool noise_is_known = false;
    int max_iterations = 200;  ///< of each start
    GoOn go_on = nullptr;      ///< asked at each evaluation of the model
};

struct FitInterval {
    double low = 0, high = 0;
};

/// What the data say of one parameter.
struct FitEstimate {
    std::string name, unit;
    double value = 0;
    bool fixed = false;
    bool at_bound = false;  ///< held there: no error is given
    /// Empty where it is fixed, at a bound, or where the data do not determine it.
    std::optional<double> standard_error;
    std::optional<FitInterval> interval;
};

/// A product of powers of parameters that the data determine although not each of its factors: prod x_i^exponent_i.
struct FitCombination {
    std::string text;               ///< "damping stiffness^(-3/5) mass^(-2/5)"
    std::vector<double> exponents;  ///< one for each parameter, fixed ones too; 0 where it has no part
    double value = 0;               ///< in the SI units of its factors
    double standard_error = 0;
    FitInterval interval;
};

struct FitResult {
    std::vector<FitEstimate> estimates;  ///< in the order of the parameters
    /// Of the estimates; NaN where one of the two has no standard error. correlation[i][j].
    std::vector<std::vector<double>> correlation;
    std::vector<double> residuals;  ///< as the model gives them at the estimates
    double sum_of_squares = 0;      ///< of the residuals
    double rms = 0;                 ///< of the residuals
    double noise = 0;               ///< standard deviation of the residuals that the errors are based on
    int degrees_of_freedom = 0;     ///< residuals less what was determined
    /// Akaike's criterion with the correction for few data (Hurvich & Tsai 1989): comparable between models of the
    /// same data with the same weights. Infinite where there are too few data. With a robust loss the sum of rho takes
    /// the place of the sum of squares (Ronchetti 1985).
    double aicc = 0;
    /// Singular values of the Jacobian with respect to the logarithms of the free parameters, largest over smallest.
    double condition = 0;
    /// What is determined where not all is; empty where every free parameter is.
    std::vector<FitCombination> combinations;
    std::vector<std::string> warnings;  ///< whole sentences
    bool converged = false;
    int iterations = 0;       ///< of the start that was best
    int evaluations = 0;      ///< of the model, all starts together
    int starts_tried = 0;     ///< those where the model had a value
    int starts_agreeing = 0;  ///< those that ended with the same cost as the best
};

/// Fits. Throws InvalidInput where the problem makes no sense (no free parameter, fewer residuals than free
/// parameters, a start outside its bounds), or where the model has a value at none of the starts; Interrupted; and what
/// the model throws.
[[nodiscard]] FitResult fit_least_squares(const LeastSquaresProblem& problem, const FitOptions& options = {});

}  // namespace footfall
