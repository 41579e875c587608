#include "study/least_squares_search.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <utility>

#include <ceres/ceres.h>
#include <glog/logging.h>

namespace footfall::least_squares {
namespace {

/// For Ceres: residuals of which the sum of squares is the sum of rho, so that one evaluation of the model serves all.
class Cost final : public ceres::CostFunction {
public:
    Cost(const Model& model, Loss loss, double noise) : model_(model), loss_(loss), noise_(noise) {
        set_num_residuals(static_cast<int>(model.residual_count()));
        mutable_parameter_block_sizes()->push_back(static_cast<int>(model.free().size()));
    }

    /// What the model throws does not go through Ceres, which is not made for it, but waits until Ceres has given up.
    bool Evaluate(const double* const* blocks, double* out, double** jacobians) const override {
        if (thrown_) return false;
        try {
            return evaluate(blocks, out, jacobians);
        } catch (...) {
            thrown_ = std::current_exception();
            return false;
        }
    }
    void rethrow() const {
        if (thrown_) std::rethrow_exception(thrown_);
    }

private:
    bool evaluate(const double* const* blocks, double* out, double** jacobians) const {
        const Vector x = model_.arguments(blocks[0]);
        const bool wants_jacobian = jacobians != nullptr && jacobians[0] != nullptr;
        Vector r;
        Matrix J;
        if (!(wants_jacobian ? model_.jacobian(x, r, J) : model_.residuals(x, r))) return false;
        const std::size_t columns = model_.free().size();
        for (Index i = 0; i < r.size(); ++i) {
            const double scaled = r[i] / noise_;
            const Rho value = rho(loss_, scaled);
            const double root = std::copysign(std::sqrt(value.value), scaled);
            out[i] = root;
            if (!wants_jacobian) continue;
            const double slope = (root == 0 ? 1 : value.slope * scaled / root) / noise_;
            for (std::size_t k = 0; k < columns; ++k) {
                const std::size_t j = model_.free()[k];
                const auto column = static_cast<Index>(j);
                jacobians[0][at(i) * columns + k] = slope * J(i, column) * model_.slope(j, x[column]);
            }
        }
        return true;
    }

    const Model& model_;
    Loss loss_;
    double noise_;
    mutable std::exception_ptr thrown_;
};

/// While one of these lives, Ceres's log says nothing: it goes to standard error by itself, in words that no user of
/// this library knows. What it would tell of a start that fails is told by the count of starts that agree.
class SilentLog {
public:
    SilentLog() {
        const std::lock_guard lock(mutex);
        if (alive++ == 0) before = std::exchange(FLAGS_minloglevel, google::GLOG_FATAL);
    }
    ~SilentLog() {
        const std::lock_guard lock(mutex);
        if (--alive == 0) FLAGS_minloglevel = before;
    }
    SilentLog(const SilentLog&) = delete;
    SilentLog& operator=(const SilentLog&) = delete;

private:
    // The level is one of the process; fits may run in several threads of it.
    static inline std::mutex mutex;
    static inline int alive = 0, before = 0;
};

/// The free parameters, by their place among them, that are at a bound.
std::vector<int> at_bounds(const Model& model, const Vector& coordinates) {
    std::vector<int> held;
    for (std::size_t k = 0; k < model.free().size(); ++k) {
        const double y = coordinates[static_cast<Index>(k)], margin = 1e-9 * (1 + std::abs(y));
        const std::size_t i = model.free()[k];
        if (y - model.low(i) <= margin || model.high(i) - y <= margin) held.push_back(static_cast<int>(k));
    }
    return held;
}

std::optional<Minimum> minimise_holding(const Model& model, Vector start, const std::vector<int>& held, Loss loss,
                                        double noise, int max_iterations) {
    const SilentLog silent;
    ceres::Problem problem;
    auto* cost = new Cost(model, loss, noise);  // the problem's own
    problem.AddResidualBlock(cost, nullptr, start.data());
    if (!held.empty()) {
        problem.SetManifold(start.data(), new ceres::SubsetManifold(static_cast<int>(start.size()), held));
    }
    for (std::size_t k = 0; k < model.free().size(); ++k) {
        const double low = model.low(model.free()[k]), high = model.high(model.free()[k]);
        if (std::isfinite(low)) problem.SetParameterLowerBound(start.data(), static_cast<int>(k), low);
        if (std::isfinite(high)) problem.SetParameterUpperBound(start.data(), static_cast<int>(k), high);
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = max_iterations;
    options.function_tolerance = 1e-14;
    options.gradient_tolerance = 1e-14;
    options.parameter_tolerance = 1e-11;
    options.logging_type = ceres::SILENT;
    // Short steps at first, since a full one from a poor start can end where nothing depends on anything any more; then
    // full ones, to come as close to the minimum as rounding lets them.
    int iterations = 0;
    ceres::Solver::Summary summary;
    for (const double radius : {1.0, 1e12}) {
        options.initial_trust_region_radius = radius;
        ceres::Solve(options, &problem, &summary);
        cost->rethrow();
        if (!summary.IsSolutionUsable()) return std::nullopt;
        iterations += static_cast<int>(summary.iterations.size()) - 1;
    }
    return Minimum{start, summary.final_cost * noise * noise, summary.termination_type == ceres::CONVERGENCE,
                   iterations};
}

/// The k-th point of a sequence that fills the cube evenly in any number of dimensions (Roberts 2018: multiples of the
/// powers of the root of x^(d+1) = x + 1), centred so that point 0 is the middle.
std::vector<double> spread(int k, std::size_t dimensions) {
    double phi = 2;
    for (int i = 0; i < 64; ++i) phi = std::pow(1 + phi, 1 / (static_cast<double>(dimensions) + 1));
    std::vector<double> point(dimensions);
    double step = 1;
    for (double& u : point) {
        step /= phi;
        u = std::fmod(0.5 + step * k, 1.0);
    }
    return point;
}

/// Where the search begins: the k-th of several places.
Vector starting_point(const Model& model, int k) {
    Vector y(static_cast<Index>(model.free().size()));
    const std::vector<double> u = spread(k, model.free().size());
    for (std::size_t f = 0; f < model.free().size(); ++f) {
        const std::size_t i = model.free()[f];
        const double given = model.coordinate(i, model.parameter(i).start);
        const double reach = model.parameter(i).logarithmic ? 2 * std::log(10.0) : given != 0 ? std::abs(given) : 1;
        const double low = std::isfinite(model.low(i)) ? model.low(i) : std::min(given, model.high(i)) - reach;
        const double high = std::isfinite(model.high(i)) ? model.high(i) : std::max(given, low) + reach;
        y[static_cast<Index>(f)] = k == 0 ? given : low + u[f] * (high - low);
    }
    return y;
}

}  // namespace

std::optional<Minimum> minimise(const Model& model, const Vector& start, Loss loss, double noise, int max_iterations) {
    // Where the model fails at its start, there is nothing to search.
    Vector r;
    Matrix J;
    if (!model.jacobian(model.arguments(start.data()), r, J)) return std::nullopt;
    // Least squares do not care for the scale of the residuals, but the tolerances do.
    const double size = r.norm() / std::sqrt(static_cast<double>(r.size()));
    if (loss == Loss::none && size > 0) noise = size;

    auto found = minimise_holding(model, start, {}, loss, noise, max_iterations);
    // Where a bound is met, Ceres projects steps that were made without it and may stop short of the minimum along it.
    std::vector<int> held;
    while (found && found->converged) {
        std::vector<int> met = at_bounds(model, found->coordinates);
        if (met.size() <= held.size() || met.size() == model.free().size()) break;
        held = std::move(met);
        const int before = found->iterations;
        found = minimise_holding(model, found->coordinates, held, loss, noise, max_iterations);
        if (found) found->iterations += before;
    }
    return found;
}

Search search(const Model& model, Loss loss, double noise, const FitOptions& options) {
    Search found;
    std::vector<double> costs;
    for (int k = 0; k < options.starts; ++k) {
        auto minimum = minimise(model, starting_point(model, k), loss, noise, options.max_iterations);
        if (!minimum) continue;
        costs.push_back(minimum->cost);
        // A start further away must be better to be preferred: along a valley all are equal but for rounding.
        if (!(minimum->cost >= found.best.cost * (1 - 1e-9))) found.best = *std::move(minimum);
    }
    found.tried = static_cast<int>(costs.size());
    const double same = found.best.cost * (1 + 1e-6) + 1e-20;
    found.agreeing = static_cast<int>(std::count_if(costs.begin(), costs.end(), [&](double c) { return c <= same; }));
    return found;
}

}  // namespace footfall::least_squares
