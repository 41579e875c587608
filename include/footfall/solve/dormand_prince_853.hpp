// Dormand and Prince's explicit Runge-Kutta method of order 8 with error estimate and dense output, for an autonomous
// system on a flat Eigen array. It takes one step when asked; who chooses the step is elsewhere.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <utility>

#include <Eigen/Core>

#include "footfall/eigen/interop.hpp"
#include "footfall/math/value_of.hpp"
#include "footfall/solve/dormand_prince_853_table.hpp"

namespace footfall {

/// One step at a time: `begin`, then `step` (again with another h where it is refused), `finish`, `advance`.
///
/// The right-hand side is `f(y, rate, look)`; it may depend on the first `Motion` components of y alone, so that the
/// others, which are integrals, need no stage. `look` is set at a few places along the step where a caller may want to
/// examine y.
template <class StateVector, int Motion = StateVector::RowsAtCompileTime>
class DormandPrince853 {
public:
    using S = typename StateVector::Scalar;
    /// What the method decides on: step sizes, weights and errors.
    using Value = ValueOf<S>;
    using Values = ValuesOf<StateVector>;
    static constexpr int order = 8;
    /// Evaluations of a step, of `finish`, and of `prepare_dense`.
    static constexpr int stages = dormand_prince_853_table::stages;

    /// `motion` is the number of components that make the motion, where it is not known at compile time.
    explicit DormandPrince853(Eigen::Index motion = Motion) : motion_(motion) {}

    /// Sets the start of the next step.
    template <class F>
    void begin(F&& f, const StateVector& y) {
        y0_ = y;
        for (StateVector& k : k_) k.resizeLike(y);
        f(y0_, k_[0], true);
    }

    /// Takes a step of size h from the start.
    template <class F>
    void step(F&& f, const Value& h) {
        h_ = h;
        y1_ = y0_;
        // Looks at c = 1/3 and 0.65 (dip.hpp).
        [&]<std::size_t... I>(std::index_sequence<I...>) {
            ((stage_state<I + 1>(y1_, motion()), f(y1_, k_[I + 1], I + 1 == 5 || I + 1 == 8)), ...);
        }(std::make_index_sequence<stages - 1>{});
        stage_state<stages>(y1_, y0_.size());
    }

    /// The local error of the step in units of what `weight` allows: a step with at most 1 is good.
    [[nodiscard]] Value error(const Values& weight) const {
        using std::abs, std::sqrt;
        constexpr auto fifth = [] { return dormand_prince_853_table::error5; };
        constexpr auto third = [] { return dormand_prince_853_table::error3; };
        constexpr auto all = std::make_index_sequence<stages>{};
        Value five(0), three(0);
        for (Eigen::Index c = 0; c < y0_.size(); ++c) {
            keep_largest(five, abs(weight[c] * weighted<Value>(fifth, c, all)));
            keep_largest(three, abs(weight[c] * weighted<Value>(third, c, all)));
        }
        if (five == Value(0)) return Value(0);
        // Where a square overflows, the quotient would be zero.
        const Value most = sqrt(std::numeric_limits<Value>::max()) / Value(2);
        if (!(five < most && three < most)) return std::numeric_limits<Value>::infinity();
        return abs(h_) * five * five / sqrt(five * five + Value(0.01) * three * three);
    }

    /// Evaluates the right-hand side at the step's end.
    template <class F>
    void finish(F&& f) {
        f(y1_, k_[stages], true);
    }

    /// Makes the end of the step the start of the next; `end` is that state, possibly corrected.
    void advance(const StateVector& end) {
        y0_ = end;
        k_[0] = k_[stages];
    }

    [[nodiscard]] const StateVector& start() const noexcept { return y0_; }
    [[nodiscard]] const StateVector& end() const noexcept { return y1_; }
    [[nodiscard]] const StateVector& start_rate() const noexcept { return k_[0]; }
    [[nodiscard]] const StateVector& end_rate() const noexcept { return k_[stages]; }
    /// Prepares `at` for the step; after `finish`.
    template <class F>
    void prepare_dense(F&& f) {
        StateVector y = y0_;
        [&]<std::size_t... I>(std::index_sequence<I...>) {
            ((stage_state<I + stages + 1>(y, motion()), f(y, k_[I + stages + 1], false)), ...);
        }(std::make_index_sequence<3>{});
        const StateVector dy = y1_ - y0_;
        dense_[0] = dy;
        dense_[1] = h_ * k_[0] - dy;
        dense_[2] = Value(2) * dy - h_ * (k_[stages] + k_[0]);
        [&]<std::size_t... R>(std::index_sequence<R...>) {
            (combine<R>(dense_[R + 3]), ...);
        }(std::make_index_sequence<4>{});
    }

    /// The state at y(start + theta h), 0 <= theta <= 1, to order 7; theta is a value, or moves with the inputs too.
    template <class Theta>
    [[nodiscard]] StateVector at(const Theta& fraction) const {
        const auto theta = as_fraction(fraction);
        const auto rest = Value(1) - theta;
        StateVector y = dense_[6] * theta;
        for (std::size_t i = 6; i-- > 0;) y = (y + dense_[i]) * (i % 2 == 0 ? theta : rest);
        return y0_ + y;
    }

    /// One component of `at`.
    template <class Theta>
    [[nodiscard]] S at(const Theta& fraction, Eigen::Index c) const {
        const auto theta = as_fraction(fraction);
        const auto rest = Value(1) - theta;
        S y = dense_[6][c] * theta;
        for (std::size_t i = 6; i-- > 0;) y = (y + dense_[i][c]) * (i % 2 == 0 ? theta : rest);
        return y0_[c] + y;
    }

private:
    /// Where a component is not a number, neither is the largest.
    static void keep_largest(Value& largest, const Value& x) noexcept {
        if (!(x <= largest)) largest = largest == largest ? x : largest;
    }
    [[nodiscard]] constexpr Eigen::Index motion() const noexcept { return Motion == Eigen::Dynamic ? motion_ : Motion; }

    template <class Theta>
    [[nodiscard]] static auto as_fraction(const Theta& theta) {
        if constexpr (std::same_as<Theta, S>) {
            return theta;
        } else {
            return Value(theta);
        }
    }

    // Sum over the stages whose coefficient is not zero, for one component: the zeros cost nothing. `Row` is the type
    // of a function that returns the coefficients, so that they are known at compile time. T: S, or Value for the
    // values.
    template <class T, class Row, std::size_t... J>
    [[nodiscard, gnu::always_inline]] T weighted(Row, Eigen::Index c, std::index_sequence<J...>) const {
        constexpr auto row = Row{}();
        T sum(0);
        (
            [&] {
                if constexpr (row[J] != 0) sum += Value(row[J]) * part<T>(k_[J][c]);
            }(),
            ...);
        return sum;
    }

    template <class T>
    [[nodiscard]] static decltype(auto) part(const S& k) {
        if constexpr (std::same_as<T, S>) {
            return (k);
        } else {
            return value_of(k);
        }
    }

    template <std::size_t Stage>
    void stage_state(StateVector& y, Eigen::Index components) const {
        constexpr auto row = [] { return dormand_prince_853_table::a[Stage]; };
        for (Eigen::Index c = 0; c < components; ++c)
            y[c] = y0_[c] + h_ * weighted<S>(row, c, std::make_index_sequence<Stage>{});
    }

    template <std::size_t Row>
    void combine(StateVector& y) const {
        constexpr auto row = [] { return dormand_prince_853_table::dense[Row]; };
        y.resizeLike(y0_);
        for (Eigen::Index c = 0; c < y0_.size(); ++c)
            y[c] = h_ * weighted<S>(row, c, std::make_index_sequence<dormand_prince_853_table::dense_stages>{});
    }

    Eigen::Index motion_;
    StateVector y0_, y1_;
    Value h_{0};
    std::array<StateVector, dormand_prince_853_table::dense_stages> k_;
    std::array<StateVector, 7> dense_;
};

}  // namespace footfall
