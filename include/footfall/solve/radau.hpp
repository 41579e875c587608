// Radau IIA with five stages, of order 9: the implicit method for parameters that make the equations stiff.
// Hairer & Wanner, Solving Ordinary Differential Equations II, 2nd ed. (1996), sections IV.5 and IV.8.
#pragma once

#include <array>
#include <complex>
#include <functional>

#include <Eigen/Core>
#include <Eigen/LU>

namespace footfall {

/// The same interface as DormandPrince853, on vectors of any length whose first `motion` components make
/// the motion; the rest are integrals of functions of these. Compiled for double and long double.
template <class S>
class RadauIIA {
public:
    using Vector = Eigen::Array<S, Eigen::Dynamic, 1>;
    using Matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
    static constexpr int stages = 5;
    static constexpr int order = 9;
    /// The order of the error estimate, one less than the exponent of its local error.
    static constexpr int estimate_order = stages;

    /// f(y, rate): the right-hand side.
    using Function = std::function<void(const Vector&, Vector&)>;
    /// jacobian(y, J): d(rate)/dy for the components of the motion.
    using Jacobian = std::function<void(const Vector&, Matrix&)>;

    RadauIIA(Function f, Jacobian jacobian, int motion);

    /// Sets the start of the next step.
    void begin(const Vector& y);
    /// Takes a step of size h from the start. Where Newton's iteration does not converge, `error` is infinite.
    void step(const S& h, const Vector& weight);
    /// The local error of the step in units of what `weight` allows.
    [[nodiscard]] S error() const noexcept { return error_; }
    /// Evaluates the right-hand side at the step's end.
    void finish();
    /// Makes the end of the step the start of the next; `end` is that state, possibly corrected.
    void advance(const Vector& end);

    [[nodiscard]] const Vector& start() const noexcept { return y0_; }
    [[nodiscard]] const Vector& end() const noexcept { return y1_; }
    [[nodiscard]] const Vector& start_rate() const noexcept { return rate0_; }
    [[nodiscard]] const Vector& end_rate() const noexcept { return rate1_; }

    /// The collocation polynomial at y(start + theta h).
    [[nodiscard]] Vector at(const S& theta) const;
    [[nodiscard]] S at(const S& theta, Eigen::Index component) const;

private:
    using Complex = std::complex<S>;
    using Stages = std::array<Vector, stages>;

    [[nodiscard]] bool solve_stages(const S& h, const Vector& weight);
    void factorize(const S& h);
    [[nodiscard]] S estimate(const S& h, const Vector& weight);

    Function f_;
    Jacobian jacobian_;
    int motion_;
    Vector y0_, y1_, rate0_, rate1_;
    S h_{0}, error_{0};
    bool jacobian_is_current_ = false;
    Matrix J_;
    Stages Z_;      // increments of the stages, y0 + Z_i
    Stages rates_;  // right-hand side at the stages
    bool has_previous_ = false;
    Stages previous_Z_;
    Vector previous_y0_;
    S previous_h_{0};
    Eigen::PartialPivLU<Matrix> real_;
    std::array<Eigen::PartialPivLU<Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic>>, 2> complex_;
};

extern template class RadauIIA<double>;
extern template class RadauIIA<long double>;

}  // namespace footfall
