// Nonlinear least squares with an account of what the data say.
#include "footfall/study/least_squares.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

#include "study/least_squares_account.hpp"
#include "study/least_squares_model.hpp"
#include "study/least_squares_search.hpp"

namespace footfall {

namespace least_squares {

Rho rho(Loss loss, double r) {
    const double s = r * r;
    switch (loss) {
        case Loss::huber: {
            constexpr double c = 1.345;
            const double size = std::abs(r);
            return size <= c ? Rho{s, 1, 1} : Rho{2 * c * size - c * c, c / size, 0};
        }
        case Loss::cauchy: {
            constexpr double c2 = 2.385 * 2.385;
            const double q = 1 + s / c2;
            return {c2 * std::log1p(s / c2), 1 / q, (1 - s / c2) / (q * q)};
        }
        case Loss::none:
            break;
    }
    return {s, 1, 1};
}

}  // namespace least_squares

namespace {

/// Standard deviation of Gaussian noise from the median of |r|, which outliers do not move.
double robust_noise(const least_squares::Vector& r) {
    std::vector<double> size(static_cast<std::size_t>(r.size()));
    for (std::size_t i = 0; i < size.size(); ++i) size[i] = std::abs(r[static_cast<Eigen::Index>(i)]);
    std::sort(size.begin(), size.end());
    const std::size_t n = size.size();
    constexpr double normal_quartile = 0.6744897501960817;
    return (size[(n - 1) / 2] + size[n / 2]) / 2 / normal_quartile;
}

void check(const LeastSquaresProblem& problem, const FitOptions& options) {
    std::size_t free = 0;
    for (const FitParameter& p : problem.parameters) {
        if (!std::isfinite(p.start) || (p.logarithmic && !(p.start > 0))) {
            throw InvalidInput(fmt::format("{}: {} {} cannot be used; it must be {}", p.name,
                                           p.fixed ? "the value" : "the start", p.start,
                                           p.logarithmic ? "greater than 0" : "finite"));
        }
        if (p.fixed) continue;
        ++free;
        if (!(p.low < p.high) || p.start < p.low || p.start > p.high) {
            throw InvalidInput(fmt::format("{}: the start {} must lie within the bounds {} to {}, the lower one first",
                                           p.name, p.start, p.low, p.high));
        }
    }
    if (free == 0) throw InvalidInput("a fit needs at least one free parameter");
    if (problem.residual_count < free) {
        throw InvalidInput(fmt::format("{} data cannot determine {} parameters; at least as many data are needed",
                                       problem.residual_count, free));
    }
    if (!(options.confidence > 0 && options.confidence < 1)) {
        throw InvalidInput(fmt::format("confidence {} must lie between 0 and 1", options.confidence));
    }
    if (options.starts < 1) throw InvalidInput(fmt::format("starts {} must be at least 1", options.starts));
}

}  // namespace

FitResult fit_least_squares(const LeastSquaresProblem& problem, const FitOptions& options) {
    using namespace least_squares;
    check(problem, options);
    const Model model(problem, options.go_on);

    const auto require = [&](const Search& found) {
        if (found.tried == 0) {
            throw InvalidInput("the model has no value at any starting point; give other starts or bounds");
        }
    };
    double scale = 1;
    Search found;
    if (options.loss == Loss::none || options.noise_is_known) {
        found = search(model, options.loss, scale, options);
        require(found);
    } else {
        // The size of the noise is found along with the parameters: each from the other, beginning with least squares.
        found = search(model, Loss::none, scale, options);
        require(found);
        Vector r;
        for (int round = 0; round < 20; ++round) {
            if (!model.residuals(model.arguments(found.best.coordinates.data()), r)) break;
            const double next = robust_noise(r);
            if (!(next > 0)) break;
            const bool settled = std::abs(next / scale - 1) < 1e-4 && round > 0;
            scale = next;
            if (settled) break;
            const auto minimum = minimise(model, found.best.coordinates, options.loss, scale, options.max_iterations);
            if (!minimum) break;
            found.best = *minimum;
        }
    }

    FitResult result;
    result.converged = found.best.converged;
    result.iterations = found.best.iterations;
    result.starts_tried = found.tried;
    result.starts_agreeing = found.agreeing;
    account(problem, model, options, model.arguments(found.best.coordinates.data()), scale, result);
    result.evaluations = model.evaluations();
    return result;
}

}  // namespace footfall
