// Dormand and Prince's explicit Runge-Kutta method of order 8 with error estimate and dense output, for an autonomous
// system on a flat Eigen array. It takes one step when asked; who chooses the step is elsewhere.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <utility>

#include "footfall/simulate/dormand_prince_853_table.hpp"

namespace footfall {

/// One step at a time: `begin`, then `step` (again with another h where it is refused), `finish`, `advance`.
template <class StateVector>
class DormandPrince853 {
public:
    using S = typename StateVector::Scalar;
    static constexpr int order = 8;
    /// Evaluations of a step, of `finish`, and of `prepare_dense`.
    static constexpr int stages = dormand_prince_853_table::stages;

    /// Sets the start of the next step. `f(y, rate)` is the right-hand side.
    template <class F>
    void begin(F&& f, const StateVector& y) {
        y0_ = y;
        for (StateVector& k : k_) k.resizeLike(y);
        f(y0_, k_[0]);
    }

    /// Takes a step of size h from the start.
    template <class F>
    void step(F&& f, const S& h) {
        h_ = h;
        [&]<std::size_t... I>(std::index_sequence<I...>) {
            ((stage_state<I + 1>(y1_), f(y1_, k_[I + 1])), ...);
        }(std::make_index_sequence<stages - 1>{});
        stage_state<stages>(y1_);
    }

    /// The local error of the step in units of what `weight` allows: a step with at most 1 is good.
    [[nodiscard]] S error(const StateVector& weight) const {
        using std::abs, std::sqrt;
        S five(0), three(0);
        for (Eigen::Index c = 0; c < y0_.size(); ++c) {
            const auto [e5, e3] = errors(c);
            five = larger(five, abs(e5) * weight[c]);
            three = larger(three, abs(e3) * weight[c]);
        }
        if (five == S(0)) return S(0);
        return abs(h_) * five * five / sqrt(five * five + S(0.01) * three * three);
    }

    /// Evaluates the right-hand side at the step's end.
    template <class F>
    void finish(F&& f) {
        f(y1_, k_[stages]);
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
            ((stage_state<I + stages + 1>(y), f(y, k_[I + stages + 1])), ...);
        }(std::make_index_sequence<3>{});
        const StateVector dy = y1_ - y0_;
        dense_[0] = dy;
        dense_[1] = h_ * k_[0] - dy;
        dense_[2] = S(2) * dy - h_ * (k_[stages] + k_[0]);
        [&]<std::size_t... R>(std::index_sequence<R...>) {
            (combine<R>(dense_[R + 3]), ...);
        }(std::make_index_sequence<4>{});
    }

    /// The state at y(start + theta h), 0 <= theta <= 1, to order 7.
    [[nodiscard]] StateVector at(const S& theta) const {
        const S rest = S(1) - theta;
        StateVector y = dense_[6] * theta;
        for (std::size_t i = 6; i-- > 0;) y = (y + dense_[i]) * (i % 2 == 0 ? theta : rest);
        return y0_ + y;
    }

    /// One component of `at`.
    [[nodiscard]] S at(const S& theta, Eigen::Index c) const {
        const S rest = S(1) - theta;
        S y = dense_[6][c] * theta;
        for (std::size_t i = 6; i-- > 0;) y = (y + dense_[i][c]) * (i % 2 == 0 ? theta : rest);
        return y0_[c] + y;
    }

private:
    // Sum over the stages whose coefficient is not zero, for one component: the zeros cost nothing.
    template <const auto& Row, std::size_t... J>
    [[nodiscard]] S weighted(Eigen::Index c, std::index_sequence<J...>) const {
        S sum(0);
        (
            [&] {
                if constexpr (Row[J] != 0) sum += S(Row[J]) * k_[J][c];
            }(),
            ...);
        return sum;
    }

    template <std::size_t Stage>
    void stage_state(StateVector& y) const {
        namespace table = dormand_prince_853_table;
        static constexpr const auto& row = table::a[Stage];
        y.resizeLike(y0_);
        for (Eigen::Index c = 0; c < y0_.size(); ++c)
            y[c] = y0_[c] + h_ * weighted<row>(c, std::make_index_sequence<Stage>{});
    }

    template <std::size_t Row>
    void combine(StateVector& y) const {
        namespace table = dormand_prince_853_table;
        static constexpr const auto& row = table::dense[Row];
        y.resizeLike(y0_);
        for (Eigen::Index c = 0; c < y0_.size(); ++c)
            y[c] = h_ * weighted<row>(c, std::make_index_sequence<table::dense_stages>{});
    }

    // The larger of two, where a NaN is larger than any number.
    static S larger(const S& a, const S& b) noexcept { return b > a || b != b ? b : a; }

    [[nodiscard]] std::pair<S, S> errors(Eigen::Index c) const {
        namespace table = dormand_prince_853_table;
        static constexpr const auto& five = table::error5;
        static constexpr const auto& b = table::a[stages];
        static constexpr const auto& third = table::third_order;
        const S e5 = weighted<five>(c, std::make_index_sequence<stages>{});
        const S e3 = weighted<b>(c, std::make_index_sequence<stages>{}) -
                     weighted<third>(c, std::make_index_sequence<stages>{});
        return {e5, e3};
    }

    StateVector y0_, y1_;
    S h_{0};
    std::array<StateVector, dormand_prince_853_table::dense_stages> k_;
    std::array<StateVector, 7> dense_;
};

}  // namespace footfall
