// Small systems with modes that have nothing to do with contact, and what a Solver makes of them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "footfall/math/dual.hpp"
#include "footfall/solve/plain_system.hpp"
#include "footfall/solve/solver.hpp"

namespace footfall::test {

/// A model as a Solver's system. `Model<S>` has
///   motion, guards                    how many components (without the clock) and guards there are
///   flow(mode, y, rate), look(mode, y, guards)    over pointers to any scalar that S stands for
///   jump(guard, mode, y)              changes y where the guard has reached zero; returns the next mode
///   over<T>()                         the same with the values of its parameters
template <template <class> class Model, class Scalar>
class Followed : public PlainSystem<Scalar> {
public:
    using S = Scalar;
    using Value = ValueOf<S>;
    static constexpr int motion_at_compile_time = Model<S>::motion;
    using State = Eigen::Array<S, motion_at_compile_time + 1, 1>;
    using Guards = Eigen::Array<S, Model<S>::guards, 1>;

    struct Happened {
        int guard;
        S time;
        State state;  ///< before the jump
    };

    explicit Followed(Model<S> m) : model(std::move(m)) {}

    Model<S> model;
    int mode = 0;
    Value tolerance{1e-12};
    Value first{1e-3};       ///< the first step
    Value short_time{1e-9};  ///< see Solver: moment()
    Value longest{std::numeric_limits<Value>::max()};
    std::vector<Happened> events;
    std::int64_t most_events = 100'000;  ///< beyond, a test has hung

    [[nodiscard]] static constexpr int motion_size() noexcept { return motion_at_compile_time; }
    [[nodiscard]] static constexpr int guard_count() noexcept { return Model<S>::guards; }
    [[nodiscard]] static constexpr int clock() noexcept { return motion_at_compile_time; }
    [[nodiscard]] Value first_step() const noexcept { return first; }
    [[nodiscard]] Value longest_step(const State&) const noexcept { return longest; }
    [[nodiscard]] Value moment() const noexcept { return short_time; }

    void evaluate(const State& y, State& rate, Guards* guards) const {
        model.flow(mode, y.data(), rate.data());
        rate[clock()] = S(1);
        if (guards) model.look(mode, y.data(), guards->data());
    }
    template <class Vector, class Matrix>
    std::int64_t jacobian(const Vector& y, Matrix& J) const {
        constexpr int n = motion_at_compile_time;
        using Direction = Dual<Value, n>;
        std::array<Direction, n> point, rate;
        for (int c = 0; c < n; ++c) point[static_cast<std::size_t>(c)] = Direction::variable(y[c], c);
        model.template over<Direction>().flow(mode, point.data(), rate.data());
        J.resize(n, n);
        for (int r = 0; r < n; ++r)
            for (int c = 0; c < n; ++c)
                J(r, c) = rate[static_cast<std::size_t>(r)].gradient[static_cast<std::size_t>(c)];
        return n;
    }
    template <class Weights>
    void weights(const State& y, Weights& weight) const {
        weight.resize(y.size());
        weight.setConstant(Value(1) / tolerance);
    }

    GoesOn<Value> jump(std::span<const int> guards, State& y, std::vector<bool>& armed) {
        for (const int guard : guards) {
            events.push_back({guard, y[clock()], y});
            mode = model.jump(guard, mode, y.data());
            armed[static_cast<std::size_t>(guard)] = false;
            if (static_cast<std::int64_t>(events.size()) > most_events) throw std::runtime_error("too many events");
        }
        return {};
    }
};

/// The state that starts with the clock at zero.
template <class System>
[[nodiscard]] typename System::State from(const std::vector<typename System::S>& motion) {
    typename System::State y;
    y.setZero();
    for (std::size_t c = 0; c < motion.size(); ++c) y[static_cast<Eigen::Index>(c)] = motion[c];
    return y;
}

/// Follows a system to an end; returns the last state.
template <class System>
typename System::State follow(System& system, const std::vector<typename System::S>& motion, typename System::Value end,
                              SolverCost* cost = nullptr) {
    Solver<System> solver(system);
    solver.run(from<System>(motion), end);
    if (cost) *cost = solver.cost();
    return solver.state();
}

// ---- models -------------------------------------------------------------------------------------------------------

/// A point that falls on a floor and leaves it with a share of its speed. Components: height, velocity.
template <class S>
struct BouncingPoint {
    static constexpr int motion = 2, guards = 1;
    S gravity, restitution;

    template <class T>
    void flow(int, const T* y, T* rate) const {
        rate[0] = y[1];
        rate[1] = -T(gravity);
    }
    template <class T>
    void look(int, const T* y, T* out) const {
        out[0] = y[0];
    }
    int jump(int, int mode, S* y) const {
        y[0] = S(0);
        y[1] = -restitution * y[1];
        return mode;
    }
    template <class T>
    [[nodiscard]] BouncingPoint<T> over() const {
        return {T(value_of(gravity)), T(value_of(restitution))};
    }
};

/// When the point that falls from a height at rest comes down for the k-th time, k = 0, 1, ...
template <class S>
[[nodiscard]] S bounce_time(const S& gravity, const S& restitution, const S& height, int k) {
    using std::sqrt;
    S flights(1), part(2);
    for (int i = 0; i < k; ++i) {
        part *= restitution;
        flights += part;
    }
    return sqrt(S(2) * height / gravity) * flights;
}

}  // namespace footfall::test
