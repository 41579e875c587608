#include "footfall/solve/radau.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

namespace footfall {

namespace {

constexpr int s = RadauIIA<double>::stages;

/// The method's coefficients, computed in long double from their definition.
struct Coefficients {
    using Real = long double;
    using Complex = std::complex<Real>;
    using Square = Eigen::Matrix<Real, s, s>;
    using Column = Eigen::Matrix<Real, s, 1>;

    Column c;                       // nodes
    Square A;                       // stage weights; the last row is b
    Column estimate;                // weights of Z in the error estimate
    Column estimate_f;              // weights of h f at the stages, the same estimate
    Real gamma0;                    // weight of h f(y0) there
    Real lambda_real;               // the real eigenvalue of A^-1
    std::array<Complex, 2> lambda;  // those with positive imaginary part
    // Z = T_real w + 2 Re(T_1 w_1 + T_2 w_2), and the rows that give w from Z
    Column T_real, from_Z_real;
    std::array<Eigen::Matrix<Complex, s, 1>, 2> T, from_Z;

    Coefficients() {
        nodes();
        // Collocation: sum_j a_ij c_j^(k-1) = c_i^k / k, k = 1..s
        Square powers, moments;
        for (int k = 0; k < s; ++k)
            for (int j = 0; j < s; ++j) {
                powers(k, j) = std::pow(c[j], Real(k));
                moments(j, k) = std::pow(c[j], Real(k + 1)) / Real(k + 1);
            }
        A = moments * powers.transpose().inverse();
        const Square inverse = A.inverse();
        const Eigen::EigenSolver<Square> eigen(inverse);
        const auto vectors = eigen.eigenvectors().eval();
        const auto back = vectors.inverse().eval();
        int pair = 0;
        for (int j = 0; j < s; ++j) {
            const Complex value = eigen.eigenvalues()[j];
            if (std::abs(value.imag()) < 1e-12L) {
                lambda_real = value.real();
                // A real eigenvector may come with a complex factor: the product with its row has none.
                const Complex phase = vectors(0, j) / std::abs(vectors(0, j));
                T_real = (vectors.col(j) / phase).real();
                from_Z_real = (back.row(j).transpose() * phase).real();
            } else if (value.imag() > 0) {
                const auto p = static_cast<std::size_t>(pair++);
                lambda[p] = value;
                T[p] = vectors.col(j);
                from_Z[p] = back.row(j).transpose();
            }
        }
        // The embedded formula of order s with f(y0): sum_j bhat_j c_j^(k-1) = 1/k, less gamma0 for k = 1
        gamma0 = 1 / lambda_real;
        Column right;
        for (int k = 0; k < s; ++k) right[k] = Real(1) / Real(k + 1);
        right[0] -= gamma0;
        const Column embedded = powers.inverse() * right;
        estimate_f = embedded - A.row(s - 1).transpose();
        estimate = inverse.transpose() * estimate_f;
    }

private:
    // The zeros of d^(s-1)/dx^(s-1) [x^(s-1) (x-1)^s]: P_s - P_(s-1) at 2x - 1, P Legendre's polynomials.
    void nodes() {
        const auto value = [](Real x) {
            const Real t = 2 * x - 1;
            Real before = 1, now = t;
            for (int k = 1; k < s; ++k) {
                const Real next = ((2 * k + 1) * t * now - k * before) / (k + 1);
                before = now;
                now = next;
            }
            return now - before;
        };
        int found = 0;
        constexpr int cells = 400;
        for (int k = 0; k < cells && found < s - 1; ++k) {
            Real a = Real(k) / cells, b = Real(k + 1) / cells;
            if (value(a) * value(b) > 0) continue;
            const bool falling = value(a) > 0;
            for (int i = 0; i < 80; ++i) {
                const Real m = (a + b) / 2;
                ((value(m) > 0) == falling ? a : b) = m;
            }
            c[found++] = (a + b) / 2;
        }
        c[s - 1] = 1;
    }
};

const Coefficients& coefficients() {
    static const Coefficients table;
    return table;
}

/// The Lagrange weights of the nodes 0, c_1, ..., c_s at theta, without that of 0.
template <class S>
std::array<S, s> lagrange(const S& theta) {
    const auto& c = coefficients().c;
    std::array<S, s> w;
    for (int i = 0; i < s; ++i) {
        S p = theta / S(c[i]);
        for (int j = 0; j < s; ++j)
            if (j != i) p *= (theta - S(c[j])) / S(c[i] - c[j]);
        w[static_cast<std::size_t>(i)] = p;
    }
    return w;
}

template <class S, class Stages, class Vector>
Vector interpolate(const S& theta, const Stages& Z, const Vector& y0) {
    const auto w = lagrange(theta);
    Vector y = y0;
    for (std::size_t i = 0; i < w.size(); ++i) y += w[i] * Z[i];
    return y;
}

}  // namespace

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
void RadauIIA<S>::step(const S& h, const Vector& weight) {
    h_ = h;
    if (!jacobian_is_current_) {
        jacobian_(y0_, J_);
        jacobian_is_current_ = true;
    }
    factorize(h);
    bool solved = solve_stages(h, weight);
    if (!solved && has_previous_) {  // the extrapolated start was too far off
        has_previous_ = false;
        solved = solve_stages(h, weight);
    }
    if (!solved) {
        error_ = std::numeric_limits<S>::infinity();
        y1_ = y0_;
        return;
    }
    y1_ = y0_ + Z_[stages - 1];
    error_ = estimate(h, weight);
}

template <class S>
void RadauIIA<S>::factorize(const S& h) {
    const auto& table = coefficients();
    real_.compute(Matrix::Identity(motion_, motion_) * (S(table.lambda_real) / h) - J_);
    for (std::size_t p = 0; p < 2; ++p) {
        const Complex shift = Complex(S(table.lambda[p].real()), S(table.lambda[p].imag())) / h;
        complex_[p].compute(Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic>::Identity(motion_, motion_) * shift -
                            J_.template cast<Complex>());
    }
}

template <class S>
bool RadauIIA<S>::solve_stages(const S& h, const Vector& weight) {
    const auto& table = coefficients();
    const auto n = static_cast<Eigen::Index>(motion_);
    for (int i = 0; i < stages; ++i) {
        Vector& z = Z_[static_cast<std::size_t>(i)];
        if (has_previous_) {
            const S theta = S(1) + S(table.c[i]) * h / previous_h_;
            z = interpolate(theta, previous_Z_, previous_y0_) - y0_;
        } else {
            z.setZero();
        }
    }
    using ComplexVector = Eigen::Matrix<Complex, Eigen::Dynamic, 1>;
    using RealVector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
    const Coefficients::Square inverse = table.A.inverse();
    S last(0);
    Vector y = y0_;
    for (int iteration = 0; iteration < 15; ++iteration) {
        // residual_i = f(y0 + Z_i) - (1/h) sum_j (A^-1)_ij Z_j
        std::array<RealVector, stages> residual;
        for (std::size_t i = 0; i < stages; ++i) {
            y.head(n) = y0_.head(n) + Z_[i].head(n);
            f_(y, rates_[i]);
            residual[i] = rates_[i].head(n).matrix();
            for (std::size_t j = 0; j < stages; ++j)
                residual[i] -= S(inverse(static_cast<int>(i), static_cast<int>(j))) / h * Z_[j].head(n).matrix();
        }
        RealVector right = RealVector::Zero(n);
        for (std::size_t i = 0; i < stages; ++i) right += S(table.from_Z_real[static_cast<int>(i)]) * residual[i];
        const RealVector w_real = real_.solve(right);
        std::array<ComplexVector, 2> w;
        for (std::size_t p = 0; p < 2; ++p) {
            ComplexVector r = ComplexVector::Zero(n);
            for (std::size_t i = 0; i < stages; ++i) {
                const Coefficients::Complex t = table.from_Z[p][static_cast<int>(i)];
                r += Complex(static_cast<S>(t.real()), static_cast<S>(t.imag())) * residual[i].template cast<Complex>();
            }
            w[p] = complex_[p].solve(r);
        }
        S change(0);
        for (std::size_t i = 0; i < stages; ++i) {
            const int k = static_cast<int>(i);
            RealVector d = S(table.T_real[k]) * w_real;
            for (std::size_t p = 0; p < 2; ++p) {
                const Coefficients::Complex t = table.T[p][k];
                d += S(2) * (Complex(static_cast<S>(t.real()), static_cast<S>(t.imag())) * w[p]).real();
            }
            Z_[i].head(n) += d.array();
            change = std::max<S>(change, (d.array().abs() * weight.head(n)).maxCoeff());
        }
        if (!std::isfinite(static_cast<double>(change))) return false;
        const S ratio = iteration > 0 ? change / last : S(0);
        const bool done =
            change < S(1e-3) || (iteration > 0 && ratio < S(1) && change * ratio / (S(1) - ratio) < S(1e-3));
        if (!done && iteration > 0 && ratio > S(0.99)) {
            if (change < S(0.1)) break;  // rounding: it gets no better
            return false;
        }
        last = change;
        if (done) break;
        if (iteration == 14) return false;
    }
    // The integrals: their increments follow from the right-hand side at the stages.
    for (std::size_t i = 0; i < stages; ++i) {
        y.head(n) = y0_.head(n) + Z_[i].head(n);
        f_(y, rates_[i]);
    }
    for (std::size_t i = 0; i < stages; ++i) {
        auto z = Z_[i].tail(Z_[i].size() - n);
        z.setZero();
        for (std::size_t j = 0; j < stages; ++j)
            z += h * S(table.A(static_cast<int>(i), static_cast<int>(j))) * rates_[j].tail(z.size());
    }
    return true;
}

template <class S>
S RadauIIA<S>::estimate(const S& h, const Vector& weight) {
    const auto& table = coefficients();
    const auto n = static_cast<Eigen::Index>(motion_);
    Eigen::Matrix<S, Eigen::Dynamic, 1> from_stages = Eigen::Matrix<S, Eigen::Dynamic, 1>::Zero(n);
    for (std::size_t i = 0; i < stages; ++i)
        from_stages += S(table.estimate[static_cast<int>(i)]) * Z_[i].head(n).matrix();
    const S gamma0 = static_cast<S>(table.gamma0);
    // (I - h gamma0 J)^-1 keeps the estimate from growing with the stiffness.
    const auto filtered = [&](const Vector& rate) {
        const Eigen::Matrix<S, Eigen::Dynamic, 1> raw = from_stages + gamma0 * h * rate.head(n).matrix();
        return real_.solve(raw / (h * gamma0)).eval();
    };
    const auto size = [&](const auto& e) { return (e.array().abs() * weight.head(n)).maxCoeff(); };
    auto e = filtered(rate0_);
    S error = size(e);
    if (error > S(1)) {
        Vector y = y0_, rate = rate0_;
        y.head(n) += e.array();
        f_(y, rate);
        e = filtered(rate);
        const S again = size(e);
        if (std::isfinite(static_cast<double>(again))) error = std::min(error, again);
    }
    const Eigen::Index rest = y0_.size() - n;
    if (rest == 0) return error;
    Vector integral = gamma0 * h * rate0_.tail(rest);
    for (std::size_t i = 0; i < stages; ++i)
        integral += h * S(table.estimate_f[static_cast<int>(i)]) * rates_[i].tail(rest);
    const S worst = std::max<S>(error, (integral.abs() * weight.tail(rest)).maxCoeff());
    return y1_.allFinite() && std::isfinite(static_cast<double>(worst)) ? worst : std::numeric_limits<S>::infinity();
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
    has_previous_ = true;
    y0_ = end;
    rate0_ = rate1_;
    jacobian_is_current_ = false;
}

template <class S>
typename RadauIIA<S>::Vector RadauIIA<S>::at(const S& theta) const {
    return interpolate(theta, Z_, y0_);
}

template <class S>
S RadauIIA<S>::at(const S& theta, Eigen::Index component) const {
    const auto w = lagrange(theta);
    S y = y0_[component];
    for (std::size_t i = 0; i < w.size(); ++i) y += w[i] * Z_[i][component];
    return y;
}

template class RadauIIA<double>;
template class RadauIIA<long double>;

}  // namespace footfall
