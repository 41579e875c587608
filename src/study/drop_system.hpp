// One impact along the normal as a Solver sees it, from touchdown until the ground no longer presses.
//
// Over dual numbers its derivatives with respect to the law's parameters, the mass and the speed come out of the same
// steps, which are chosen by the values alone. The end of contact moves with the parameters too; the speed there does
// not notice to first order, since the force is zero.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "footfall/law/registry.hpp"
#include "footfall/math/value_of.hpp"
#include "footfall/plant/drop.hpp"
#include "footfall/simulate/derivatives.hpp"
#include "footfall/simulate/hybrid.hpp"
#include "footfall/solve/plain_system.hpp"
#include "footfall/solve/solver.hpp"

namespace footfall::study {

/// Any normal law, alone.
template <class S>
using DropLaw = Pair<NormalLawOver<S>, NoFriction<S>>;

/// `States` is how many states the law has, where that is known at compile time.
template <class S, int States>
class DropSystem : public PlainSystem<S> {
public:
    using Plant = Drop<S>;
    using Law = DropLaw<S>;
    using HybridType = Hybrid<Plant, Law, States>;
    using State = typename HybridType::State;
    using Guards = typename HybridType::Guards;
    using Value = ValueOf<S>;

    static constexpr int motion_at_compile_time = HybridType::motion_at_compile_time;
    static constexpr int guards_per_group = HybridType::guards_per_contact;

    /// Mass [kg] and speed into the ground [m/s], both > 0. The error of a step is at most `tolerance` of what each
    /// component may become.
    DropSystem(const Law& law, const S& mass, const S& speed, double tolerance)
        : hybrid_(Plant(mass), {law}), derivatives_(hybrid_), speed_(speed), tolerance_(tolerance) {
        const double v = value_of(speed);
        energy_ = 0.5 * value_of(mass) * v * v;
        root_depth_ = law.root_depth_holding(energy_);
        path_ = 2 * root_depth_ / v;
    }

    [[nodiscard]] const HybridType& hybrid() const noexcept { return hybrid_; }
    [[nodiscard]] const Law& law() const noexcept { return hybrid_.law(0); }

    /// Whether the numbers of an impact can be told apart in double precision.
    [[nodiscard]] bool has_scales() const noexcept {
        return energy_ > 0 && std::isfinite(energy_) && root_depth_ > 0 && path_ > 0 && std::isfinite(path_);
    }

    /// At touchdown, before the law knows of it. A root depth of exactly zero would begin on the guard of the depth, so
    /// it is one whose square is nothing beside any depth that matters.
    [[nodiscard]] State initial_state() const {
        constexpr double nothing = 1e-10;
        State y = State::Zero(hybrid_.size());
        y[Plant::velocity] = speed_;
        y[Plant::root_depths] = S(nothing * root_depth_);
        return y;
    }

    /// The force on the sphere [N], after the clamp (14), while the contact lasts.
    [[nodiscard]] S force(const State& y) const noexcept { return force(hybrid_.touch(y, 0), y); }
    /// The force at the deepest point, were it at this depth [m].
    [[nodiscard]] S force_at_rest(double depth, const State& y) const noexcept {
        return force({S(std::sqrt(depth)), S(0), Vector2<S>::Zero()}, y);
    }

    // ---- what a Solver asks for ----------------------------------------------------------------------------------

    [[nodiscard]] int size() const noexcept { return hybrid_.size(); }
    [[nodiscard]] int motion_size() const noexcept { return hybrid_.motion_size(); }
    [[nodiscard]] static constexpr int guard_count() noexcept { return guards_per_group; }
    [[nodiscard]] int clock() const noexcept { return hybrid_.clock(); }
    [[nodiscard]] static constexpr bool uniform() noexcept { return false; }

    [[gnu::always_inline]] void evaluate(const State& y, State& rate, Guards* guards) const noexcept {
        hybrid_.evaluate(y, rate, guards);
    }
    template <class Vector, class Matrix>
    std::int64_t jacobian(const Vector& y, Matrix& J) {
        return derivatives_.jacobian(hybrid_, y, J);
    }

    template <class Weights>
    void weights(const State& y, Weights& weight) const {
        weight.resize(y.size());
        const auto set = [&](int c, double size) { weight[c] = Value(1 / (tolerance_ * size)); };
        set(Plant::velocity, value_of(speed_));
        set(Plant::root_depths, root_depth_);
        for (int i = 0; i < law().states(); ++i) set(hybrid_.first_state(0) + i, law().state_size(i, S(root_depth_)));
        set(hybrid_.clock(), root_depth_ * path_);
    }
    [[nodiscard]] Value first_step() const noexcept {
        constexpr double share = 1e-2;  // of the way to the deepest point
        return Value(share * path_);
    }
    [[nodiscard]] Value moment() const noexcept {
        constexpr double share = 1e-3;  // of the impact
        return Value(share * root_depth_ * path_);
    }

    void start(State& y, std::vector<bool>&) {
        constexpr double soon = 1e-6;  // of the deepest
        apply(law().touch_down(hybrid_.touch(y, 0), S(soon * root_depth_), hybrid_.states(y, 0)), y);
    }
    /// The force has reached zero, or the depth with it: the impact is over.
    GoesOn<Value> jump(std::span<const int> guards, State& y, std::vector<bool>&) {
        for (const int guard : guards)
            apply(law().cross(guard, hybrid_.mode(0), hybrid_.touch(y, 0), S(0), false, hybrid_.states(y, 0)), y);
        return {.done = true};
    }

private:
    [[nodiscard]] S force(const Touch<S>& t, const State& y) const noexcept {
        const S f = law().normal_force(t, hybrid_.states(y, 0));
        return f > S(0) ? f : S(0);
    }
    void apply(const Jump<S>& jump, State& y) {
        hybrid_.set_mode(0, jump.mode);
        hybrid_.book(y, 0, jump.taken);
    }

    HybridType hybrid_;
    Derivatives<HybridType> derivatives_;
    S speed_;
    double tolerance_;
    double energy_ = 0;                 // that the impact brings [J]
    double root_depth_ = 0, path_ = 0;  // s where the spring holds that [m^0.5]; sigma on the way there, about
};

}  // namespace footfall::study
