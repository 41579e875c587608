// The model of a fit in the coordinates of its search.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "footfall/study/least_squares.hpp"

namespace footfall::least_squares {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Vector = Eigen::VectorXd;
using Index = Eigen::Index;

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

inline std::span<const double> view(const Vector& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }
inline std::span<double> view(Vector& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }
inline std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// rho(s), s = r^2, its slope, and psi' = d(r rho'(r^2))/dr.
struct Rho {
    double value, slope, influence_slope;
};
[[nodiscard]] Rho rho(Loss loss, double r);

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

}  // namespace footfall::least_squares
