// The two integrators behind one face: explicit until the equations prove stiff, implicit while they are.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <utility>

#include "footfall/eigen/interop.hpp"
#include "footfall/solve/dormand_prince_853.hpp"
#include "footfall/solve/radau.hpp"

namespace footfall {

/// When the implicit method takes over, and when it gives back. The defaults suit many components, whose implicit steps
/// are dear.
struct Switching {
    int look = 256;     ///< explicit steps between looks
    double border = 4;  ///< of h |lambda|, where the implicit method is tried; explicit stability reaches to about 6
    double price = 0;   ///< of an implicit step, in explicit ones; 0: by the number of components
    int patience = 64;  ///< looks become at most this much rarer, after implicit steps that did not pay
    /// Of h |lambda|, below which an implicit step is one that the explicit method can do: it takes over, and patience
    /// begins anew. 0: the price alone decides. Above 0 the implicit method is also tried early where the equations
    /// have become much stiffer since it did not pay.
    double gentle = 0;
    bool follows_turning = false;  ///< RadauIIA::follow_turning
};

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

    Method(F f, J jacobian, int motion, D product = {}, const Switching& switching = {})
        : f_(std::move(f)),
          jacobian_(jacobian),
          product_(std::move(product)),
          motion_(motion),
          switching_(switching),
          price_(switching.price > 0 ? Value(switching.price) : price(motion)),
          explicit_(motion),
          implicit_([this](const Vector& y, Vector& rate) { call(y, rate); }, std::move(jacobian), motion) {
        implicit_.follow_turning(switching.follows_turning);
    }
    Method(const Method&) = delete;
    Method& operator=(const Method&) = delete;

    /// Every step from the next `begin` on is implicit, whether that pays or not: for measuring the implicit method
    /// where nothing is stiff.
    void stay_implicit() noexcept { stiff_ = stays_ = true; }

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
    void return_to_explicit() noexcept { stiff_ = stays_; }
    /// What was learnt of the equations is forgotten: the next steps are those of a new method.
    void forget() noexcept {
        return_to_explicit();
        last_error_ = Value(1);
        failures_ = steps_ = 0;
        patience_ = 1;
        explicit_step_ = gained_ = refused_rate_ = Value(0);
    }

    /// After a refused step: whether the implicit method has failed to converge so often that the explicit one takes
    /// over.
    [[nodiscard]] bool gives_up(const Value& error) {
        using std::isfinite;
        constexpr int often = 8;
        if (stays_) return false;
        failures_ = stiff_ && !isfinite(error) ? failures_ + 1 : 0;
        if (failures_ < often) return false;
        failures_ = 0;
        patience_ = std::min(4 * patience_, switching_.patience);
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
        if (stays_) return;
        constexpr int settle = 6;  // implicit steps before the price is asked
        ++steps_;
        if (!stiff_) {
            const bool due = steps_ >= switching_.look * patience_;
            const bool early = switching_.gentle > 0 && steps_ % switching_.look == 0;
            if (!due && !early) return;
            if (due) steps_ = 0;
            const Value rate = fastest_rate(weight);
            if (h_ * rate < Value(switching_.border)) return;
            // After steps that did not pay: early only where it has become much stiffer since.
            constexpr double much = 4;
            if (!due && !(rate > Value(much) * refused_rate_)) return;
            steps_ = 0;
            stiff_ = true;
            explicit_step_ = h_;
            gained_ = Value(0);
            refused_rate_ = rate;
            implicit_.begin(start_);
        } else {
            const Value gain = h_ / explicit_step_ - price_;
            gained_ += gain;
            if (steps_ <= settle) return;
            if (!(gain > Value(0))) {
                // After steps that paid, what follows on an event or a fast change need not last.
                patience_ = gained_ > Value(0) ? 1 : std::min(4 * patience_, switching_.patience);
                leave_implicit();
            } else if (switching_.gentle > 0 && steps_ % switching_.look == 0 &&
                       h_ * fastest_rate(weight) < Value(switching_.gentle)) {
                patience_ = 1;
                refused_rate_ = Value(0);
                leave_implicit();
            }
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
    Switching switching_;
    Value price_;
    Matrix J_;
    StateVector state_, rate_, start_, end_;
    DormandPrince853<StateVector, Motion> explicit_;
    RadauIIA<S> implicit_;
    Value h_{0}, last_error_{1};
    bool stiff_ = false;
    bool stays_ = false;
    int failures_ = 0;        // of the implicit method in a row
    int steps_ = 0;           // since the last look
    int patience_ = 1;        // looks are this much rarer, after implicit steps that did not pay
    Value explicit_step_{0};  // before the implicit steps
    Value gained_{0};         // by the implicit steps, in explicit ones
    Value refused_rate_{0};   // the fastest rate as the implicit method last took over
};

}  // namespace footfall
