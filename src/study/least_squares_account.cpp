#include "study/least_squares_account.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include <Eigen/Dense>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace footfall::least_squares {
namespace {

/// A direction of the logarithms in which the residuals change less than this much of the most they change counts as
/// not determined: above what is left of an exact dependence after rounding and the integration's own error.
constexpr double null_threshold = 1e-6;
/// A part of a direction below this is none.
constexpr double no_part = 1e-3;

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

void account(const LeastSquaresProblem& problem, const Model& model, const FitOptions& options, const Vector& x,
             double scale, FitResult& result) {
    Account(problem, model, options, result).take(x, scale);
}

}  // namespace footfall::least_squares
