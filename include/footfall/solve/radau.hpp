// Radau IIA with five stages, of order 9: the implicit method for parameters that make the equations stiff.
// Hairer & Wanner, Solving Ordinary Differential Equations II, 2nd ed. (1996), sections IV.5 and IV.8.
//
// Over dual numbers the steps, the matrices and the error are those of the values, to the last bit, and the derivatives
// are those of the numbers that the method gives. Only where the derivatives do not converge, and the values do, is a
// step refused that a run over plain numbers takes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <concepts>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>

#include <Eigen/Core>
#include <Eigen/LU>

#include "footfall/eigen/interop.hpp"
#include "footfall/math/value_of.hpp"
#include "footfall/solve/radau_table.hpp"
#include "footfall/solve/value_solve.hpp"

namespace footfall {

/// The same interface as DormandPrince853, on vectors of any length whose first `motion` components make
/// the motion; the rest are integrals of functions of these. Compiled for double and long double; for dual numbers over
/// these, of one level, where they are used.
template <class S>
class RadauIIA {
public:
    /// What the method decides on: step sizes, weights and errors.
    using Value = ValueOf<S>;
    using Vector = Eigen::Array<S, Eigen::Dynamic, 1>;
    using Values = Eigen::Array<Value, Eigen::Dynamic, 1>;
    using Matrix = Eigen::Matrix<Value, Eigen::Dynamic, Eigen::Dynamic>;
    static constexpr int stages = radau_table::stages;
    static constexpr int order = 9;
    /// The order of the error estimate, one less than the exponent of its local error.
    static constexpr int estimate_order = stages;

    /// f(y, rate): the right-hand side.
    using Function = std::function<void(const Vector&, Vector&)>;
    /// jacobian(y, J): d(rate)/dy for the components of the motion, at values alone.
    using Jacobian = std::function<void(const Values&, Matrix&)>;

    RadauIIA(Function f, Jacobian jacobian, int motion);

    /// Sets the start of the next step.
    void begin(const Vector& y);
    /// Where Newton's iteration with the Jacobian of the step's start does not converge, iterates with those of all
    /// stages. That takes equations of five times the size, and is the only way where a stiff direction turns within
    /// a step: a Jacobian kept from its start then limits steps to (|lambda| times the rate of turning)^(-1/2).
    void follow_turning(bool follows) noexcept { follows_turning_ = follows; }
    /// Takes a step of size h from the start. Where Newton's iteration does not converge, `error` is infinite.
    void step(const Value& h, const Values& weight);
    /// The local error of the step in units of what `weight` allows.
    [[nodiscard]] Value error() const noexcept { return error_; }
    /// Evaluates the right-hand side at the step's end.
    void finish();
    /// Makes the end of the step the start of the next; `end` is that state, possibly corrected.
    void advance(const Vector& end);

    [[nodiscard]] const Vector& start() const noexcept { return y0_; }
    [[nodiscard]] const Vector& end() const noexcept { return y1_; }
    [[nodiscard]] const Vector& start_rate() const noexcept { return rate0_; }
    [[nodiscard]] const Vector& end_rate() const noexcept { return rate1_; }

    /// The collocation polynomial at y(start + theta h); theta is a value, or moves with the inputs too.
    template <class Theta>
    [[nodiscard]] Vector at(const Theta& theta) const {
        return interpolate(lagrange(as_fraction(theta)), Z_, y0_);
    }
    template <class Theta>
    [[nodiscard]] S at(const Theta& theta, Eigen::Index component) const {
        const auto w = lagrange(as_fraction(theta));
        S y = y0_[component];
        for (std::size_t i = 0; i < w.size(); ++i) y += w[i] * Z_[i][component];
        return y;
    }

private:
    using Stages = std::array<Vector, stages>;
    using Increments = std::array<ColumnVector<S>, stages>;

    /// Whether an iteration has come so near that its next changes are below a thousandth of what is allowed.
    class Convergence {
    public:
        enum class Verdict { go_on, good, failed };
        /// The largest change of this iteration, in units of what is allowed.
        Verdict see(const Value& change) {
            constexpr double enough = 1e-3, stalled = 0.99, rounding = 0.1;
            const Value ratio = last_ ? change / *last_ : Value(0);
            const bool done = change < Value(enough) ||
                              (last_ && ratio < Value(1) && change * ratio / (Value(1) - ratio) < Value(enough));
            const bool stuck = !done && last_ && ratio > Value(stalled);
            last_ = change;
            if (done) return Verdict::good;
            if (!stuck) return Verdict::go_on;
            return change < Value(rounding) ? Verdict::good : Verdict::failed;  // rounding: it gets no better
        }

    private:
        std::optional<Value> last_;
    };
    using Verdict = typename Convergence::Verdict;

    void predict(const Value& h);
    [[nodiscard]] bool solve_stages(const Value& h, const Values& weight);
    [[nodiscard]] bool solve_stages_together(const Value& h, const Values& weight);
    template <class Iterate>
    [[nodiscard]] bool solve_derivatives(Iterate&& iterate, const Values& weight, Convergence seen);
    [[nodiscard]] Increments newton(const Value& h);
    [[nodiscard]] Increments newton_together(const Value& h);
    [[nodiscard]] Value add(const Increments& d, const Values& weight);
    [[nodiscard]] Value change_of_derivatives(const Increments& d, const Values& weight) const;
    void integrate(const Value& h);
    void stand_still();
    void factorize(const Value& h);
    [[nodiscard]] Value estimate(const Value& h, const Values& weight);

    template <class Theta>
    [[nodiscard]] static auto as_fraction(const Theta& theta) {
        if constexpr (std::same_as<Theta, S>) {
            return theta;
        } else {
            return Value(theta);
        }
    }

    /// The Lagrange weights of the nodes 0, c_1, ..., c_s at theta, without that of 0.
    template <class Theta>
    [[nodiscard]] static std::array<Theta, stages> lagrange(const Theta& theta) {
        constexpr auto& c = radau_table::c;
        std::array<Theta, stages> w;
        for (std::size_t i = 0; i < stages; ++i) {
            w[i] = theta / Value(c[i]);
            for (std::size_t j = 0; j < stages; ++j)
                if (j != i) w[i] *= (theta - Value(c[j])) / Value(c[i] - c[j]);
        }
        return w;
    }

    template <class Theta>
    [[nodiscard]] static Vector interpolate(const std::array<Theta, stages>& w, const Stages& Z, const Vector& y0) {
        Vector y = y0;
        for (std::size_t i = 0; i < stages; ++i) y += w[i] * Z[i];
        return y;
    }

    Function f_;
    Jacobian jacobian_;
    int motion_;
    Vector y0_, y1_, rate0_, rate1_;
    Value h_{0}, error_{0};
    bool jacobian_is_current_ = false, follows_turning_ = false;
    Matrix J_;
    Stages Z_;      // increments of the stages, y0 + Z_i
    Stages rates_;  // right-hand side at the stages
    bool has_previous_ = false;
    Stages previous_Z_;
    Vector previous_y0_;
    Value previous_h_{0};
    RealFactors<Value> real_;
    std::array<ComplexFactors<Value>, 2> complex_;
};

template <class S>
RadauIIA<S>::RadauIIA(Function f, Jacobian jacobian, int motion)
    : f_(std::move(f)), jacobian_(std::move(jacobian)), motion_(motion) {}

template <class S>
void RadauIIA<S>::begin(const Vector& y) {
    y0_ = y;
    rate0_.resizeLike(y);
    rate1_.resizeLike(y);
    for (Vector& z : Z_) z = Vector::Zero(y.size());
    for (Vector& r : rates_) r.resizeLike(y);
    f_(y0_, rate0_);
    jacobian_is_current_ = false;
    has_previous_ = false;
}

template <class S>
void RadauIIA<S>::step(const Value& h, const Values& weight) {
    h_ = h;
    if (h == Value(0)) {
        stand_still();
        return;
    }
    if (!jacobian_is_current_) {
        jacobian_(values_of(y0_), J_);
        jacobian_is_current_ = true;
    }
    factorize(h);
    const auto solve = [&] {
        return solve_stages(h, weight) || (follows_turning_ && solve_stages_together(h, weight));
    };
    bool solved = solve();
    if (!solved && has_previous_) {  // the extrapolated start was too far off
        has_previous_ = false;
        solved = solve();
    }
    if (!solved) {
        error_ = std::numeric_limits<Value>::infinity();
        y1_ = y0_;
        return;
    }
    y1_ = y0_ + Z_[stages - 1];
    error_ = estimate(h, weight);
}

/// A step of no size: an event at the very start of a step is located by one.
template <class S>
void RadauIIA<S>::stand_still() {
    y1_ = y0_;
    error_ = Value(0);
    for (Vector& z : Z_) z.setZero();
    for (Vector& r : rates_) r = rate0_;
}

template <class S>
void RadauIIA<S>::factorize(const Value& h) {
    using Complex = std::complex<Value>;
    using ComplexMatrix = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic>;
    real_.compute(Matrix::Identity(motion_, motion_) * (Value(radau_table::lambda_real) / h) - J_);
    for (std::size_t p = 0; p < complex_.size(); ++p) {
        const auto& lambda = radau_table::lambda[p];
        const Complex shift = Complex(Value(lambda.re), Value(lambda.im)) / h;
        complex_[p].compute(ComplexMatrix::Identity(motion_, motion_) * shift - J_.template cast<Complex>());
    }
}

/// Where the stages are looked for first: on the last step's polynomial, or at the start.
template <class S>
void RadauIIA<S>::predict(const Value& h) {
    for (std::size_t i = 0; i < stages; ++i) {
        if (has_previous_) {
            const Value theta = Value(1) + Value(radau_table::c[i]) * h / previous_h_;
            Z_[i] = interpolate(lagrange(theta), previous_Z_, previous_y0_) - y0_;
        } else {
            Z_[i].setZero();
        }
    }
}

/// What Newton's iteration, with the Jacobian of the step's start, adds to the stages' motion.
template <class S>
typename RadauIIA<S>::Increments RadauIIA<S>::newton(const Value& h) {
    const auto n = static_cast<Eigen::Index>(motion_);
    // residual_i = f(y0 + Z_i) - (1/h) sum_j (A^-1)_ij Z_j
    Increments residual;
    Vector y = y0_;
    for (std::size_t i = 0; i < stages; ++i) {
        y.head(n) = y0_.head(n) + Z_[i].head(n);
        f_(y, rates_[i]);
        residual[i] = rates_[i].head(n).matrix();
        for (std::size_t j = 0; j < stages; ++j)
            residual[i] -= Value(radau_table::inverse[i][j]) / h * Z_[j].head(n).matrix();
    }
    ColumnVector<S> right = ColumnVector<S>::Zero(n);
    for (std::size_t i = 0; i < stages; ++i) right += Value(radau_table::from_z_real[i]) * residual[i];
    const ColumnVector<S> w_real = solve_with<S>(real_, right);
    std::array<ComplexColumnVector<S>, 2> w;
    for (std::size_t p = 0; p < w.size(); ++p) {
        ComplexColumnVector<S> r{ColumnVector<S>::Zero(n), ColumnVector<S>::Zero(n)};
        for (std::size_t i = 0; i < stages; ++i) {
            const auto& from = radau_table::from_z[p][i];
            r.re += Value(from.re) * residual[i];
            r.im += Value(from.im) * residual[i];
        }
        w[p] = solve_with<S>(complex_[p], r);
    }
    Increments d;
    for (std::size_t i = 0; i < stages; ++i) {
        d[i] = Value(radau_table::t_real[i]) * w_real;
        for (std::size_t p = 0; p < w.size(); ++p) {
            const auto& t = radau_table::t[p][i];
            d[i] += Value(2) * (Value(t.re) * w[p].re - Value(t.im) * w[p].im);
        }
    }
    return d;
}

template <class S>
bool RadauIIA<S>::solve_stages(const Value& h, const Values& weight) {
    constexpr int most = 15;  // iterations
    predict(h);
    Convergence values, derivatives;
    for (int iteration = 0;; ++iteration) {
        if (iteration == most) return false;
        const Increments d = newton(h);
        const Value change = add(d, weight);
        if (!std::isfinite(change)) return false;
        if constexpr (!std::floating_point<S>) derivatives.see(change_of_derivatives(d, weight));
        const Verdict verdict = values.see(change);
        if (verdict == Verdict::failed) return false;
        if (verdict == Verdict::good) break;
    }
    if constexpr (!std::floating_point<S>) {
        if (!solve_derivatives([&] { return newton(h); }, weight, derivatives)) return false;
    }
    integrate(h);
    return true;
}

/// Adds to the stages' motion; returns the largest change in units of what is allowed.
template <class S>
typename RadauIIA<S>::Value RadauIIA<S>::add(const Increments& d, const Values& weight) {
    const auto n = static_cast<Eigen::Index>(motion_);
    Value change(0);
    for (std::size_t i = 0; i < stages; ++i) {
        Z_[i].head(n) += d[i].array();
        change = std::max<Value>(change, (values_of(d[i]).array().abs() * weight.head(n)).maxCoeff());
    }
    return change;
}

/// The same as `newton` with the Jacobians of all stages: Newton's method proper, on the equations of all of them.
template <class S>
typename RadauIIA<S>::Increments RadauIIA<S>::newton_together(const Value& h) {
    const auto n = static_cast<Eigen::Index>(motion_);
    Matrix equations(stages * n, stages * n), slopes;
    ColumnVector<S> residual(stages * n);
    Vector y = y0_;
    for (int i = 0; i < stages; ++i) {
        const auto k = static_cast<std::size_t>(i);
        y.head(n) = y0_.head(n) + Z_[k].head(n);
        f_(y, rates_[k]);
        jacobian_(values_of(y), slopes);
        residual.segment(i * n, n) = rates_[k].head(n).matrix();
        for (int j = 0; j < stages; ++j) {
            const auto l = static_cast<std::size_t>(j);
            const Value a = Value(radau_table::inverse[k][l]) / h;
            residual.segment(i * n, n) -= a * Z_[l].head(n).matrix();
            equations.block(i * n, j * n, n, n) = a * Matrix::Identity(n, n);
            if (i == j) equations.block(i * n, j * n, n, n) -= slopes;
        }
    }
    const RealFactors<Value> factors(equations);
    const ColumnVector<S> all = solve_with<S>(factors, residual);
    Increments d;
    for (int i = 0; i < stages; ++i) d[static_cast<std::size_t>(i)] = all.segment(i * n, n);
    return d;
}

template <class S>
bool RadauIIA<S>::solve_stages_together(const Value& h, const Values& weight) {
    constexpr int most = 15;     // iterations
    constexpr double apart = 2;  // the ratio of changes above which they part; a first step or two may go astray
    constexpr double enough = 1e-3;
    predict(h);
    Value last(0);
    for (int iteration = 0;; ++iteration) {
        if (iteration == most) return false;
        const Value change = add(newton_together(h), weight);
        if (!std::isfinite(change)) return false;
        // It converges quadratically: what is left is smaller than this change by more than the ratio to the last.
        const Value ratio = iteration > 0 ? change / last : Value(1);
        if (change < Value(enough) || (ratio < Value(1) && change * ratio * ratio < Value(enough))) break;
        if (iteration > 1 && ratio > Value(apart)) return false;
        last = change;
    }
    if constexpr (!std::floating_point<S>) {
        if (!solve_derivatives([&] { return newton_together(h); }, weight, {})) return false;
    }
    integrate(h);
    return true;
}

/// Goes on with the iteration for the derivatives alone, which come a little after the values. The values stay, so that
/// they are those of a run over plain numbers.
template <class S>
template <class Iterate>
bool RadauIIA<S>::solve_derivatives(Iterate&& iterate, const Values& weight, Convergence seen) {
    constexpr int most = 30;  // iterations: they converge as the values do, from further away
    const auto n = static_cast<Eigen::Index>(motion_);
    for (int iteration = 0; iteration < most; ++iteration) {
        const Increments d = iterate();
        for (std::size_t i = 0; i < stages; ++i) {
            for (Eigen::Index c = 0; c < n; ++c) Z_[i][c] += d[i][c] - value_of(d[i][c]);
        }
        const Value change = change_of_derivatives(d, weight);
        // A slope that is not finite is handed on, as the explicit method does.
        if (!std::isfinite(change)) return true;
        // What seems stuck may be catching up with the values.
        if (seen.see(change) == Verdict::good) return true;
    }
    return false;
}

/// The largest change of a derivative in units of what is allowed: in relation to the derivatives of all components
/// with respect to the same input, components being compared by their weights, what the values are allowed in relation
/// to themselves.
template <class S>
typename RadauIIA<S>::Value RadauIIA<S>::change_of_derivatives(const Increments& d, const Values& weight) const {
    if constexpr (std::floating_point<S>) {
        return Value(0);
    } else {
        static_assert(std::same_as<decltype(S::value), Value>, "of one level");
        constexpr double loosest = 1e-6;  // of the allowed relative error, where the state is nearly zero
        constexpr Value rounding = Value(1e4) * std::numeric_limits<Value>::epsilon();
        const auto n = static_cast<Eigen::Index>(motion_);
        const Value size = (values_of(y0_).head(n).abs() * weight.head(n)).maxCoeff();
        const Value allowed = std::clamp(Value(1) / size, rounding, Value(loosest));
        Value worst(0);
        for (std::size_t k = 0; k < std::tuple_size_v<decltype(S::gradient)>; ++k) {
            Value change(0), whole(0);
            for (std::size_t i = 0; i < stages; ++i) {
                for (Eigen::Index c = 0; c < n; ++c) {
                    const Value slope = y0_[c].gradient[k] + Z_[i][c].gradient[k];
                    if (!std::isfinite(slope)) return std::numeric_limits<Value>::infinity();
                    change = std::max<Value>(change, std::abs(d[i][c].gradient[k]) * weight[c]);
                    whole = std::max<Value>(whole, std::abs(slope) * weight[c]);
                }
            }
            if (change > Value(0)) worst = std::max<Value>(worst, change / (whole * allowed));
        }
        return worst;
    }
}

/// The integrals: their increments follow from the right-hand side at the stages.
template <class S>
void RadauIIA<S>::integrate(const Value& h) {
    const auto n = static_cast<Eigen::Index>(motion_);
    Vector y = y0_;
    for (std::size_t i = 0; i < stages; ++i) {
        y.head(n) = y0_.head(n) + Z_[i].head(n);
        f_(y, rates_[i]);
    }
    for (std::size_t i = 0; i < stages; ++i) {
        auto z = Z_[i].tail(Z_[i].size() - n);
        z.setZero();
        for (std::size_t j = 0; j < stages; ++j) z += h * Value(radau_table::a[i][j]) * rates_[j].tail(z.size());
    }
}

template <class S>
typename RadauIIA<S>::Value RadauIIA<S>::estimate(const Value& h, const Values& weight) {
    const auto n = static_cast<Eigen::Index>(motion_);
    ColumnVector<Value> from_stages = ColumnVector<Value>::Zero(n);
    for (std::size_t i = 0; i < stages; ++i)
        from_stages += Value(radau_table::estimate[i]) * values_of(Z_[i]).head(n).matrix();
    constexpr auto gamma0 = static_cast<Value>(radau_table::gamma0);
    // (I - h gamma0 J)^-1 keeps the estimate from growing with the stiffness.
    const auto filtered = [&](const Vector& rate) {
        const ColumnVector<Value> raw = from_stages + gamma0 * h * values_of(rate).head(n).matrix();
        return real_.solve(raw / (h * gamma0)).eval();
    };
    const auto size = [&](const auto& e) { return (e.array().abs() * weight.head(n)).maxCoeff(); };
    auto e = filtered(rate0_);
    Value error = size(e);
    if (error > Value(1)) {
        Vector y = y0_, rate = rate0_;
        y.head(n) += e.array().template cast<S>();
        f_(y, rate);
        e = filtered(rate);
        const Value again = size(e);
        if (std::isfinite(again)) error = std::min(error, again);
    }
    const Eigen::Index rest = y0_.size() - n;
    if (rest == 0) return error;
    Values integral = gamma0 * h * values_of(rate0_).tail(rest);
    for (std::size_t i = 0; i < stages; ++i)
        integral += h * Value(radau_table::estimate_f[i]) * values_of(rates_[i]).tail(rest);
    const Value worst = std::max<Value>(error, (integral.abs() * weight.tail(rest)).maxCoeff());
    return values_of(y1_).allFinite() && std::isfinite(worst) ? worst : std::numeric_limits<Value>::infinity();
}

template <class S>
void RadauIIA<S>::finish() {
    f_(y1_, rate1_);
}

template <class S>
void RadauIIA<S>::advance(const Vector& end) {
    previous_Z_ = Z_;
    previous_y0_ = y0_;
    previous_h_ = h_;
    has_previous_ = h_ != Value(0);
    y0_ = end;
    rate0_ = rate1_;
    jacobian_is_current_ = false;
}

extern template class RadauIIA<double>;
extern template class RadauIIA<long double>;

}  // namespace footfall
