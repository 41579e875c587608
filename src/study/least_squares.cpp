// Nonlinear least squares with an account of what the data say.
#include "footfall/study/least_squares.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <mutex>
#include <utility>

#include <Eigen/Dense>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <ceres/ceres.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glog/logging.h>

namespace footfall {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Vector = Eigen::VectorXd;
using Index = Eigen::Index;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
/// A direction of the logarithms in which the residuals change less than this much of the most they change counts as
/// not determined: above what is left of an exact dependence after rounding and the integration's own error.
constexpr double null_threshold = 1e-6;
/// A part of a direction below this is none.
constexpr double no_part = 1e-3;

std::span<const double> view(const Vector& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }
std::span<double> view(Vector& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }
std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Loss ----------------------------------------------------------------------------------------------------------------

/// rho(s), s = r^2, its slope, and psi' = d(r rho'(r^2))/dr.
struct Rho {
    double value, slope, influence_slope;
};
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

// The model in the coordinates of the search ------------------------------------------------------------------------

/// A parameter's coordinate is its logarithm, or itself.
class Model {
public:
    Model(const LeastSquaresProblem& problem, const GoOn& go_on) : problem_(problem), go_on_(go_on) {
        for (std::size_t i = 0; i < problem.parameters.size(); ++i) {
            if (!problem.parameters[i].fixed) free_.push_back(i);
        }
    }

    [[nodiscard]] const std::vector<std::size_t>& free() const { return free_; }
    [[nodiscard]] const FitParameter& parameter(std::size_t i) const { return problem_.parameters[i]; }
    [[nodiscard]] Index parameter_count() const { return static_cast<Index>(problem_.parameters.size()); }
    [[nodiscard]] Index residual_count() const { return static_cast<Index>(problem_.residual_count); }
    [[nodiscard]] int evaluations() const { return evaluations_; }

    [[nodiscard]] double coordinate(std::size_t i, double x) const {
        return parameter(i).logarithmic ? std::log(x) : x;
    }
    /// dx_i / dcoordinate
    [[nodiscard]] double slope(std::size_t i, double x) const { return parameter(i).logarithmic ? x : 1; }
    [[nodiscard]] double low(std::size_t i) const {
        const FitParameter& p = parameter(i);
        if (!p.logarithmic) return p.low;
        return p.low > 0 ? std::log(p.low) : -infinity;
    }
    [[nodiscard]] double high(std::size_t i) const { return coordinate(i, parameter(i).high); }

    /// All arguments for the coordinates of the free ones.
    [[nodiscard]] Vector arguments(const double* coordinates) const {
        Vector x(parameter_count());
        for (Index i = 0; i < x.size(); ++i) x[i] = parameter(at(i)).start;
        for (std::size_t k = 0; k < free_.size(); ++k) {
            const FitParameter& p = parameter(free_[k]);
            const double y = p.logarithmic ? std::exp(coordinates[k]) : coordinates[k];
            x[static_cast<Index>(free_[k])] = std::clamp(y, p.low, p.high);  // exp(log) may round past a bound
        }
        return x;
    }

    /// False where the model has no value.
    bool residuals(const Vector& x, Vector& r) const {
        ask(go_on_);
        r.resize(residual_count());
        ++evaluations_;
        problem_.residuals(view(x), view(r));
        return r.allFinite();
    }

    /// Residuals and their derivatives with respect to the arguments; those that are fixed on demand.
    bool jacobian(const Vector& x, Vector& r, Matrix& J, bool of_fixed = false) const {
        r.resize(residual_count());
        J.setZero(residual_count(), parameter_count());
        if (problem_.jacobian) {
            ask(go_on_);
            ++evaluations_;
            problem_.jacobian(view(x), view(r), {J.data(), at(J.size())});
            return r.allFinite() && J.allFinite();
        }
        if (!residuals(x, r)) return false;
        for (Index j = 0; j < x.size(); ++j) {
            if ((of_fixed || !parameter(at(j)).fixed) && !difference(x, j, r, J)) return false;
        }
        return true;
    }

private:
    /// Column j of J. Central differences of fourth order; at a bound, one-sided ones of second order.
    bool difference(const Vector& x, Index j, const Vector& r, Matrix& J) const {
        const FitParameter& p = parameter(at(j));
        const double size = x[j] != 0 ? std::abs(x[j]) : p.start != 0 ? std::abs(p.start) : 1;
        const double h = 1e-3 * size;
        Vector a, b, c, d;
        const auto shifted = [&](double step, Vector& into) {
            Vector moved = x;
            moved[j] += step;
            return residuals(moved, into);
        };
        if (p.fixed || (x[j] - 2 * h >= p.low && x[j] + 2 * h <= p.high)) {
            if (!shifted(-2 * h, a) || !shifted(-h, b) || !shifted(h, c) || !shifted(2 * h, d)) return false;
            J.col(j) = (8 * (c - b) - (d - a)) / (12 * h);
            return true;
        }
        const double inward = (x[j] - 2 * h >= p.low ? -h : h) / 10;
        if (!shifted(inward, a) || !shifted(2 * inward, b)) return false;
        J.col(j) = (4 * a - b - 3 * r) / (2 * inward);
        return true;
    }

    const LeastSquaresProblem& problem_;
    const GoOn& go_on_;
    std::vector<std::size_t> free_;
    mutable int evaluations_ = 0;
};

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

// The search ----------------------------------------------------------------------------------------------------------

struct Minimum {
    Vector coordinates;
    double cost = infinity;
    bool converged = false;
    int iterations = 0;
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

struct Search {
    Minimum best;
    int tried = 0, agreeing = 0;
};

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

/// Standard deviation of Gaussian noise from the median of |r|, which outliers do not move.
double robust_noise(const Vector& r) {
    std::vector<double> size(at(r.size()));
    for (Index i = 0; i < r.size(); ++i) size[at(i)] = std::abs(r[i]);
    std::sort(size.begin(), size.end());
    const std::size_t n = size.size();
    constexpr double normal_quartile = 0.6744897501960817;
    return (size[(n - 1) / 2] + size[n / 2]) / 2 / normal_quartile;
}

// What is determined --------------------------------------------------------------------------------------------------

/// "a, b and c"
std::string listed(const std::vector<std::string>& words) {
    std::string text = words.front();
    for (std::size_t i = 1; i < words.size(); ++i) text += (i + 1 < words.size() ? ", " : " and ") + words[i];
    return text;
}

/// "-3/5", or "0.4183" where no small fraction is near.
std::string exponent_text(double e) {
    for (int q = 1; q <= 12; ++q) {
        const double p = std::round(e * q);
        if (std::abs(e * q - p) > 1e-4 * q) continue;
        if (q == 1) return p < 0 ? fmt::format("({:.0f})", p) : fmt::format("{:.0f}", p);
        return fmt::format("({:.0f}/{})", p, q);
    }
    return e < 0 ? fmt::format("({:.4g})", e) : fmt::format("{:.4g}", e);
}

std::string product_text(const std::vector<double>& exponents, const std::vector<FitParameter>& parameters) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < exponents.size(); ++i) {
        if (exponents[i] != 0) order.push_back(i);
    }
    // What is to the first power leads, what is given ends.
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(parameters[a].fixed, exponents[a] != 1) < std::pair(parameters[b].fixed, exponents[b] != 1);
    });
    std::vector<std::string> factors;
    for (const std::size_t i : order) {
        factors.push_back(exponents[i] == 1 ? parameters[i].name
                                            : parameters[i].name + "^" + exponent_text(exponents[i]));
    }
    return fmt::format("{}", fmt::join(factors, " "));
}

/// Rows that span the same space as those of V, each with a 1 where all others have a 0: its pivot.
struct Echelon {
    Matrix rows;
    std::vector<Index> pivots;
};
Echelon echelon(Matrix V) {
    Echelon result;
    for (Index k = 0; k < V.rows(); ++k) {
        // The last of the largest: stiffness comes before damping, and it is damping that is scaled by stiffness.
        Index row = k, pivot = 0;
        double largest = 0;
        for (Index i = k; i < V.rows(); ++i) {
            for (Index j = 0; j < V.cols(); ++j) {
                if (std::abs(V(i, j)) >= largest * (1 - 1e-6)) row = i, pivot = j, largest = std::abs(V(i, j));
            }
        }
        V.row(k).swap(V.row(row));
        V.row(k) /= V(k, pivot);
        for (Index i = 0; i < V.rows(); ++i) {
            if (i != k) V.row(i) -= V(i, pivot) * V.row(k);
        }
        result.pivots.push_back(pivot);
    }
    result.rows = V.unaryExpr([](double a) { return std::abs(a) < no_part ? 0.0 : a; });
    return result;
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

/// Fills in what follows from the residuals and the Jacobian at the minimum.
class Account {
public:
    Account(const LeastSquaresProblem& problem, const Model& model, const FitOptions& options, FitResult& result)
        : parameters_(problem.parameters), model_(model), options_(options), result_(result) {}

    /// `scale` is what the residuals were divided by inside the loss.
    void take(const Vector& x, double scale) {
        Vector r;
        Matrix J;
        if (!model_.jacobian(x, r, J, true)) {  // cannot be: the search has been here
            throw std::logic_error("least squares: no derivatives at the minimum");
        }
        estimate_values(x);
        split(x, J);
        spend(r, scale);
        state_errors();
        if (rank_ > 0 && rank_ < static_cast<Index>(inner_.size())) combine(x);
        warn();
    }

private:
    void estimate_values(const Vector& x) {
        for (std::size_t i = 0; i < parameters_.size(); ++i) {
            const FitParameter& p = parameters_[i];
            FitEstimate e{p.name, p.unit, x[static_cast<Index>(i)], p.fixed};
            const double margin = 1e-9 * std::abs(e.value);
            e.at_bound =
                !p.fixed && ((std::isfinite(p.low) && e.value - p.low <= margin && model_.low(i) > -infinity) ||
                             (std::isfinite(p.high) && p.high - e.value <= margin));
            if (!p.fixed && !e.at_bound) inner_.push_back(i);
            result_.estimates.push_back(e);
        }
    }

    /// Singular directions of the Jacobian with respect to the logarithms of what is free.
    void split(const Vector& x, const Matrix& J) {
        log_J_ = J;
        for (Index j = 0; j < J.cols(); ++j) {
            // What is not searched in its logarithm may be near 0 by accident: where it began says how large it is.
            const FitParameter& p = parameters_[at(j)];
            double size = std::abs(x[j]);
            if (!p.logarithmic) size = std::max(size, std::abs(p.start));
            const double column = J.col(j).norm();
            relative_.push_back(size > 0 ? size : column > 0 ? 1 / column : 1);
            log_J_.col(j) *= relative_.back();
        }
        const auto columns = static_cast<Index>(inner_.size());
        Matrix A(J.rows(), columns);
        for (Index k = 0; k < columns; ++k) A.col(k) = log_J_.col(static_cast<Index>(inner_[at(k)]));
        if (columns == 0) return;
        const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
        singular_ = svd.singularValues();
        directions_ = svd.matrixV();
        while (rank_ < columns && singular_[rank_] > null_threshold * singular_[0]) ++rank_;
        result_.condition = singular_[columns - 1] > 0 ? singular_[0] / singular_[columns - 1] : infinity;
    }

    /// Noise, degrees of freedom and AICc.
    void spend(const Vector& r, double scale) {
        const auto n = static_cast<double>(r.size());
        result_.residuals.assign(r.data(), r.data() + r.size());
        result_.sum_of_squares = r.squaredNorm();
        result_.rms = std::sqrt(result_.sum_of_squares / n);
        result_.degrees_of_freedom = static_cast<int>(r.size() - rank_);
        const double dof = result_.degrees_of_freedom;

        double sum = 0, influence_squares = 0, slope_sum = 0, slope_squares = 0;
        for (const double residual : result_.residuals) {
            const Rho value = rho(options_.loss, residual / scale);
            sum += value.value;
            influence_squares += std::pow(value.slope * residual / scale, 2);
            slope_sum += value.influence_slope;
            slope_squares += value.influence_slope * value.influence_slope;
        }
        sum *= scale * scale;
        const bool robust = options_.loss != Loss::none;
        if (options_.noise_is_known && !robust) {
            result_.noise = 1;
        } else if (!robust) {
            result_.noise = dof > 0 ? std::sqrt(sum / dof) : nan;
        } else {
            // Huber 1981, Robust Statistics, (7.6.4): the variance of an M-estimate is that of least squares with this
            // in place of the variance of the noise.
            const double mean = slope_sum / n;
            const double K = 1 + static_cast<double>(rank_) / n * (slope_squares / n - mean * mean) / (mean * mean);
            result_.noise = dof > 0 ? scale * K * std::sqrt(influence_squares / dof) / mean : nan;
        }

        // The size of the noise, where it is estimated, is a parameter too.
        const double k = static_cast<double>(rank_) + (options_.noise_is_known ? 0 : 1);
        const double fit = options_.noise_is_known ? sum : n * std::log(sum / n);
        result_.aicc = n - k - 1 > 0 ? fit + 2 * k + 2 * k * (k + 1) / (n - k - 1) : infinity;
    }

    void state_errors() {
        const auto size = parameters_.size();
        result_.correlation.assign(size, std::vector<double>(size, nan));
        const auto columns = static_cast<Index>(inner_.size());
        covariance_.setZero(columns, columns);
        for (Index k = 0; k < rank_; ++k) {
            const Vector v = directions_.col(k);
            covariance_ += v * v.transpose() * std::pow(result_.noise / singular_[k], 2);
        }
        determined_.assign(inner_.size(), true);
        for (Index k = rank_; k < columns; ++k) {
            for (Index i = 0; i < columns; ++i) {
                if (std::abs(directions_(i, k)) > no_part) determined_[at(i)] = false;
            }
        }
        for (Index i = 0; i < columns; ++i) {
            if (!determined_[at(i)]) continue;
            const std::size_t p = inner_[at(i)];
            FitEstimate& e = result_.estimates[p];
            const double relative = std::sqrt(covariance_(i, i));
            e.standard_error = relative * relative_[p];
            e.interval = parameters_[p].logarithmic ? around(e.value, relative)
                                                    : FitInterval{e.value - quantile() * *e.standard_error,
                                                                  e.value + quantile() * *e.standard_error};
            for (Index j = 0; j < columns; ++j) {
                if (!determined_[at(j)]) continue;
                const std::size_t q = inner_[at(j)];
                result_.correlation[p][q] =
                    i == j ? 1 : covariance_(i, j) / std::sqrt(covariance_(i, i) * covariance_(j, j));
            }
        }
    }

    /// The products of powers that are determined. The rows of the Jacobian span them.
    void combine(const Vector& x) {
        const Echelon basis = echelon(directions_.leftCols(rank_).transpose());
        Matrix U(log_J_.rows(), rank_);
        for (Index k = 0; k < rank_; ++k) {
            U.col(k) = log_J_.col(static_cast<Index>(inner_[at(basis.pivots[at(k)])]));
        }
        const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(U);
        for (Index k = 0; k < rank_; ++k) {
            FitCombination c;
            c.exponents.assign(parameters_.size(), 0);
            double log_value = 0;
            bool alone = true, product = true;
            for (Index i = 0; i < basis.rows.cols(); ++i) {
                const double a = basis.rows(k, i);
                if (a == 0) continue;
                const std::size_t p = inner_[at(i)];
                if (!determined_[at(i)]) alone = false;
                if (!parameters_[p].logarithmic) product = false;
                c.exponents[p] = a;
                log_value += a * std::log(x[static_cast<Index>(p)]);
            }
            if (alone || !product) continue;
            // What is given has its part where moving it does the same as moving the combinations.
            for (std::size_t p = 0; p < parameters_.size(); ++p) {
                if (!parameters_[p].fixed || !parameters_[p].logarithmic) continue;
                const Vector column = log_J_.col(static_cast<Index>(p));
                const Vector part = solver.solve(column);
                if ((U * part - column).norm() > 1e-4 * column.norm() || std::abs(part[k]) < no_part) continue;
                c.exponents[p] = part[k];
                log_value += part[k] * std::log(x[static_cast<Index>(p)]);
            }
            const Vector a = basis.rows.row(k);
            const double relative = std::sqrt(a.dot(covariance_ * a));
            c.text = product_text(c.exponents, parameters_);
            c.value = std::exp(log_value);
            c.standard_error = c.value * relative;
            c.interval = around(c.value, relative);
            result_.combinations.push_back(c);
        }
    }

    void warn() {
        auto& warnings = result_.warnings;
        std::vector<std::string> lost;
        for (std::size_t i = 0; i < parameters_.size(); ++i) {
            const FitEstimate& e = result_.estimates[i];
            if (e.at_bound) {
                warnings.push_back(
                    fmt::format("{} is at its bound, {:.6g}: the data ask for a value beyond it, and it has "
                                "no error.",
                                e.name, e.value));
            } else if (!e.fixed && !e.standard_error) {
                lost.push_back(e.name);
            } else if (!e.fixed && *e.standard_error > std::abs(e.value)) {
                warnings.push_back(
                    fmt::format("The data hardly determine {}: its standard error is larger than itself.", e.name));
            }
        }
        if (!lost.empty()) {
            std::string text =
                lost.size() == 1
                    ? fmt::format("The data do not determine {}: the model does not depend on it here.", lost[0])
                    : fmt::format(
                          "The data do not determine {} one by one: they can change together without any effect.",
                          listed(lost));
            std::vector<std::string> products;
            for (const FitCombination& c : result_.combinations) products.push_back(c.text);
            if (!products.empty()) text += fmt::format(" What is known: {}.", fmt::join(products, "; "));
            warnings.push_back(text);
        }
        for (std::size_t i = 0; i < parameters_.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                if (std::abs(result_.correlation[i][j]) > 0.99) {
                    warnings.push_back(fmt::format("{} and {} are hard to tell apart: their correlation is {:.4f}.",
                                                   parameters_[j].name, parameters_[i].name,
                                                   result_.correlation[i][j]));
                }
            }
        }
        if (!result_.converged) warnings.emplace_back("The search ended before it had converged.");
        if (result_.degrees_of_freedom == 0) {
            warnings.emplace_back(
                "There are as many parameters as data: the noise, and with it every error, is unknown.");
        }
    }

    /// A value and the error of its logarithm.
    [[nodiscard]] FitInterval around(double value, double relative) const {
        const double factor = std::exp(quantile() * relative);
        return {value / factor, value * factor};
    }

    [[nodiscard]] double quantile() const {
        const double tail = (1 - options_.confidence) / 2;
        if (options_.noise_is_known) return boost::math::quantile(complement(boost::math::normal(), tail));
        if (result_.degrees_of_freedom == 0) return nan;
        return boost::math::quantile(complement(boost::math::students_t(result_.degrees_of_freedom), tail));
    }

    const std::vector<FitParameter>& parameters_;
    const Model& model_;
    const FitOptions& options_;
    FitResult& result_;
    std::vector<std::size_t> inner_;  ///< free, and not at a bound
    std::vector<double> relative_;    ///< size of each parameter: dx / dlog(x)
    Matrix log_J_;
    Vector singular_;
    Matrix directions_;  ///< columns, in the order of the singular values
    Index rank_ = 0;
    Matrix covariance_;  ///< of the logarithms of the inner ones, in the determined directions
    std::vector<bool> determined_;
};

}  // namespace

FitResult fit_least_squares(const LeastSquaresProblem& problem, const FitOptions& options) {
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
    Account(problem, model, options, result).take(model.arguments(found.best.coordinates.data()), scale);
    result.evaluations = model.evaluations();
    return result;
}

}  // namespace footfall
