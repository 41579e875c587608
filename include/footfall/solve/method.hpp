// The two integrators behind one face: explicit until the equations prove stiff, implicit while they are.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <utility>

#include "footfall/math/value_of.hpp"
#include "footfall/solve/dormand_prince_853.hpp"
#include "footfall/solve/radau.hpp"

namespace footfall {

/// For `Method`: the product of Jacobian and vector is formed with the whole Jacobian.
struct ByJacobian {};

/// Takes steps with the method that suits the equations, and chooses their size. `F(y, rate, look)` is the right-hand
/// side, `J(values, matrix)` its Jacobian for the first `Motion` components, on which alone it depends, at the values
/// of y. `D(values, v)`, where it is given, returns this Jacobian times v, which is one derivative along v: the look
/// for stiffness, which comes in every run, then does without the n x n numbers.
template <class StateVector, int Motion, class F, class J, class D = ByJacobian>
class Method {
public:
    using S = typename StateVector::Scalar;
    /// What the method decides on: step sizes, weights and errors.
    using Value = ValueOf<S>;
    using Values = ValuesOf<StateVector>;
    using Vector = typename RadauIIA<S>::Vector;
    using Matrix = typename RadauIIA<S>::Matrix;
    /// Evaluations of an explicit step.
    static constexpr int stages = DormandPrince853<StateVector, Motion>::stages;

    Method(F f, J jacobian, int motion, D product = {})
        : f_(std::move(f)),
          jacobian_(jacobian),
          product_(std::move(product)),
          motion_(motion),
          explicit_(motion),
          implicit_([this](const Vector& y, Vector& rate) { call(y, rate); }, std::move(jacobian), motion) {}
    Method(const Method&) = delete;
    Method& operator=(const Method&) = delete;

    /// The next step starts at y, after a change of phase.
    void begin(const StateVector& y) {
        start_ = y;
        if (stiff_) {
            implicit_.begin(y);
        } else {
            explicit_.begin(f_, y);
        }
        steps_ = 0;
    }

    void step(const Value& h, const Values& weight) {
        h_ = h;
        if (stiff_) {
            implicit_.step(h, weight);
            end_ = implicit_.end();
        } else {
            explicit_.step(f_, h);
            end_ = explicit_.end();
        }
    }

    /// The step's local error in units of what is allowed.
    [[nodiscard]] Value error(const Values& weight) const {
        return stiff_ ? implicit_.error() : explicit_.error(weight);
    }

    /// Evaluates the right-hand side at the step's end.
    void finish() {
        if (stiff_) {
            implicit_.finish();
        } else {
            explicit_.finish(f_);
        }
    }

    /// The step is taken and no phase has changed: the next starts at `end`, its end, possibly corrected.
    void advance(const StateVector& end, const Values& weight) {
        start_ = end;
        if (stiff_) {
            implicit_.advance(end);
        } else {
            explicit_.advance(end);
        }
        reconsider(weight);
    }

    /// Prepares `at` for the step; after `finish`.
    void prepare_dense() {
        if (!stiff_) explicit_.prepare_dense(f_);
    }
    template <class Theta>
    [[nodiscard]] StateVector at(const Theta& theta) const {
        return stiff_ ? StateVector(implicit_.at(theta)) : explicit_.at(theta);
    }
    template <class Theta>
    [[nodiscard]] S at(const Theta& theta, Eigen::Index c) const {
        return stiff_ ? implicit_.at(theta, c) : explicit_.at(theta, c);
    }

    /// Of the last step, over sigma.
    [[nodiscard]] const Value& size() const noexcept { return h_; }
    [[nodiscard]] const StateVector& start() const noexcept { return start_; }
    [[nodiscard]] const StateVector& end() const noexcept { return end_; }
    [[nodiscard]] StateVector start_rate() const {
        return stiff_ ? StateVector(implicit_.start_rate()) : explicit_.start_rate();
    }
    [[nodiscard]] StateVector end_rate() const {
        return stiff_ ? StateVector(implicit_.end_rate()) : explicit_.end_rate();
    }

    [[nodiscard]] bool implicit() const noexcept { return stiff_; }
    /// Nothing is stiff in flight.
    void return_to_explicit() noexcept { stiff_ = false; }

    /// After a refused step: whether the implicit method has failed to converge so often that the explicit one takes
    /// over.
    [[nodiscard]] bool gives_up(const Value& error) {
        using std::isfinite;
        constexpr int often = 8;
        failures_ = stiff_ && !isfinite(error) ? failures_ + 1 : 0;
        if (failures_ < often) return false;
        failures_ = 0;
        leave_implicit();
        return true;
    }

    /// The factor to the next step size that a step's error suggests: proportional-integral control, which keeps the
    /// size from swinging where stability limits it (Hairer & Wanner, section IV.2).
    [[nodiscard]] Value growth(const Value& error, bool refused) {
        using std::isfinite, std::pow;
        if (!isfinite(error)) return Value(0.25);
        const Value exponent =
            Value(1) / Value(stiff_ ? RadauIIA<S>::estimate_order + 1 : DormandPrince853<StateVector, Motion>::order);
        const Value seen = std::max(error, Value(1e-6));
        Value factor = Value(0.9);
        if (error > Value(1)) {
            factor *= pow(seen, -exponent);
        } else {
            constexpr double beta = 0.04;
            factor *= pow(seen, Value(0.75 * beta) - exponent) * pow(last_error_, Value(beta));
            last_error_ = seen;
        }
        return std::clamp<Value>(factor, Value(0.2), refused ? Value(1) : Value(6));
    }

private:
    // The explicit method gives way once its steps are at the border of its stability, where accuracy would allow
    // larger ones; the implicit one where its steps do not pay for their price.
    void reconsider(const Values& weight) {
        constexpr int look = 256;     // steps between looks
        constexpr double border = 4;  // of h |lambda|: the stability region reaches to about 6
        ++steps_;
        if (!stiff_) {
            if (steps_ < look * patience_) return;
            steps_ = 0;
            if (h_ * fastest_rate(weight) < Value(border)) return;
            stiff_ = true;
            explicit_step_ = h_;
            implicit_.begin(start_);
        } else if (steps_ > 6 && h_ < price(motion_) * explicit_step_) {
            leave_implicit();
        }
    }

    // What an implicit step of n components costs, in explicit ones. For small n these are its some 25 evaluations, the
    // Jacobian and what is done at every change of method. For large n it is the factors of one real and two complex
    // matrices: 6 n^3 multiplications (a complex one is four) beside the 12 n components that an explicit step
    // evaluates, each of which costs about as much as 75 multiplications in a large matrix (0.2 ns and 15 ns,
    // measured).
    [[nodiscard]] static Value price(int n) {
        constexpr double small = 50;
        constexpr double multiplications = 6, evaluated = stages, per_component = 75;
        const double size = n;
        return Value(std::max(small, multiplications * size * size / (evaluated * per_component)));
    }

    void leave_implicit() {
        stiff_ = false;
        patience_ = std::min(4 * patience_, 64);
        const StateVector y = start_;
        begin(y);
    }

    // The spectral radius of the Jacobian, about: the mean growth of a vector under it.
    [[nodiscard]] Value fastest_rate(const Values& weight) {
        const auto& y = values_of(start_);
        if constexpr (by_jacobian) jacobian_(y, J_);
        const auto times = [&](const ColumnVector<Value>& v) -> ColumnVector<Value> {
            if constexpr (by_jacobian) {
                return J_ * v;
            } else {
                return product_(y, v);
            }
        };
        const Eigen::Index n = motion_;
        const ColumnVector<Value> w = weight.head(n).matrix();
        ColumnVector<Value> v = ColumnVector<Value>::LinSpaced(n, Value(1), Value(2));
        constexpr int settle = 8, measure = 8;
        Value growth(1);
        for (int k = 0; k < settle + measure; ++k) {
            v = w.cwiseProduct(times(v.cwiseQuotient(w)));
            const Value size = v.norm();
            if (!(size > Value(0))) return Value(0);
            v /= size;
            if (k >= settle) growth *= size;
        }
        using std::pow;
        return pow(growth, Value(1) / Value(measure));
    }

    void call(const Vector& y, Vector& rate) {
        state_ = y;
        rate_.resizeLike(state_);
        f_(state_, rate_, true);
        rate = rate_;
    }

    static constexpr bool by_jacobian = std::same_as<D, ByJacobian>;

    F f_;
    J jacobian_;
    D product_;
    int motion_;
    Matrix J_;
    StateVector state_, rate_, start_, end_;
    DormandPrince853<StateVector, Motion> explicit_;
    RadauIIA<S> implicit_;
    Value h_{0}, last_error_{1};
    bool stiff_ = false;
    int failures_ = 0;  // of the implicit method in a row
    int steps_ = 0;     // since the last look
    int patience_ = 1;  // looks are this much rarer, after implicit steps that did not pay
    Value explicit_step_{0};
};

}  // namespace footfall
