// A stiff problem whose stiff direction turns: a point drawn fast onto a curve, (p + sin 3t)(cos t, sin t), from t = 0.
#pragma once

#include <cmath>

#include "footfall/math/value_of.hpp"

namespace footfall::test {

/// In the components t, x, y; on the curve y = (t, p + sin 3t at the angle t).
template <class S>
struct TurningStiffness {
    using V = ValueOf<S>;

    V lambda;  ///< how fast the distance from the curve falls
    S p;

    template <class Y>
    void operator()(const Y& y, Y& out) const {
        using std::cos, std::sin, std::sqrt;
        const S r = p + sin(S(3) * y[0]), r_rate = S(3) * cos(S(3) * y[0]);
        const S size = sqrt(y[1] * y[1] + y[2] * y[2]);
        const S along = (r_rate - S(lambda) * (size - r)) / size;
        out.resize(3);
        out << S(1), along * y[1] - y[2], along * y[2] + y[1];
    }
    template <class Y, class Matrix>
    void jacobian(const Y& y, Matrix& J) const {
        const V r = value_of(p) + std::sin(3 * y[0]), r_rate = 3 * std::cos(3 * y[0]), size = std::hypot(y[1], y[2]);
        const V along = (r_rate - lambda * (size - r)) / size;
        const V by_time = (-9 * std::sin(3 * y[0]) + lambda * r_rate) / size, by_size = -(lambda + along) / size;
        J.setZero(3, 3);
        for (int i = 1; i <= 2; ++i) {
            J(i, 0) = by_time * y[i];
            for (int k = 1; k <= 2; ++k) J(i, k) = by_size * y[i] * y[k] / size;
            J(i, i) += along;
        }
        J(1, 2) -= 1;
        J(2, 1) += 1;
    }
};

}  // namespace footfall::test
