// Derivatives of a Hybrid's equations, exact, by dual numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "footfall/math/dual.hpp"
#include "footfall/math/value_of.hpp"

namespace footfall {

/// d(rate)/dy of the motion of a Hybrid, whole or along a vector. Both return what they cost, in evaluations.
template <class Hybrid>
class Derivatives {
public:
    explicit Derivatives(const Hybrid& hybrid) : dual_(hybrid.template cast<Direction>()) {}

    /// At the values y, in the modes that `hybrid` is in.
    template <class Vector, class Matrix>
    std::int64_t jacobian(const Hybrid& hybrid, const Vector& y, Matrix& J) {
        const int n = hybrid.motion_size();
        dual_.take_modes(hybrid);
        J.resize(n, n);
        DualState point = y.template cast<Direction>(), rate = point;
        std::int64_t cost = 0;
        for (int first = 0; first < n; first += directions) {
            const int last = std::min(first + directions, n);
            for (int c = first; c < last; ++c) point[c] = Direction::variable(y[c], c - first);
            dual_.evaluate(point, rate);
            for (int c = first; c < last; ++c) {
                for (int r = 0; r < n; ++r) J(r, c) = value_of(rate[r].gradient[static_cast<std::size_t>(c - first)]);
                point[c] = Direction(y[c]);
            }
            cost += directions;
        }
        return cost;
    }

    /// The Jacobian's product with v.
    template <class Vector, class Product>
    std::int64_t along(const Hybrid& hybrid, const Vector& y, const Product& v, Product& Jv) {
        dual_.take_modes(hybrid);
        DualState point = y.template cast<Direction>(), rate = point;
        const int n = hybrid.motion_size();
        for (int c = 0; c < n; ++c) point[c].gradient[0] = v[c];
        dual_.evaluate(point, rate);
        for (int c = 0; c < n; ++c) Jv[c] = value_of(rate[c].gradient[0]);
        return directions;
    }

private:
    static constexpr int directions = 8;  // at a time
    /// Over the scalar of the equations, so that a law's parameters stay what they are; its values are asked for.
    using Direction = Dual<typename Hybrid::S, directions>;
    using DualHybrid = decltype(std::declval<Hybrid>().template cast<Direction>());
    using DualState = typename DualHybrid::State;

    DualHybrid dual_;
};

}  // namespace footfall
