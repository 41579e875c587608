// Linear equations whose matrix is of plain numbers and whose right-hand side may be of dual numbers: each derivative
// of the solution is the solution for that derivative of the right-hand side. The value of the solution is the same, to
// the last bit, as for a right-hand side of plain numbers.
#pragma once

#include <complex>
#include <concepts>
#include <cstddef>
#include <tuple>
#include <type_traits>

#include <Eigen/Core>
#include <Eigen/LU>

#include "footfall/math/value_of.hpp"

namespace footfall {

template <class S>
using ColumnVector = Eigen::Matrix<S, Eigen::Dynamic, 1>;

/// Real and imaginary part: std::complex is not meant for dual numbers.
template <class S>
struct ComplexColumnVector {
    ColumnVector<S> re, im;
};

template <class V>
using RealFactors = Eigen::PartialPivLU<Eigen::Matrix<V, Eigen::Dynamic, Eigen::Dynamic>>;
template <class V>
using ComplexFactors = Eigen::PartialPivLU<Eigen::Matrix<std::complex<V>, Eigen::Dynamic, Eigen::Dynamic>>;

/// The solution x of A x = b, A given by its factors.
template <class S>
[[nodiscard]] ColumnVector<S> solve_with(const RealFactors<ValueOf<S>>& A, const ColumnVector<S>& b) {
    if constexpr (std::floating_point<S>) {
        return A.solve(b);
    } else {
        using T = decltype(S::value);
        ColumnVector<S> x(b.size());
        const ColumnVector<T> value = solve_with<T>(A, b.unaryExpr([](const S& part) { return part.value; }));
        for (Eigen::Index c = 0; c < x.size(); ++c) x[c].value = value[c];
        for (std::size_t i = 0; i < std::tuple_size_v<decltype(S::gradient)>; ++i) {
            const ColumnVector<T> slope =
                solve_with<T>(A, b.unaryExpr([i](const S& part) { return part.gradient[i]; }));
            for (Eigen::Index c = 0; c < x.size(); ++c) x[c].gradient[i] = slope[c];
        }
        return x;
    }
}

/// The same for a complex matrix.
template <class S>
[[nodiscard]] ComplexColumnVector<S> solve_with(const ComplexFactors<ValueOf<S>>& A, const ComplexColumnVector<S>& b) {
    if constexpr (std::floating_point<S>) {
        ColumnVector<std::complex<S>> right(b.re.size());
        right.real() = b.re;
        right.imag() = b.im;
        const ColumnVector<std::complex<S>> x = A.solve(right);
        return {x.real(), x.imag()};
    } else {
        using T = decltype(S::value);
        ComplexColumnVector<S> x{ColumnVector<S>(b.re.size()), ColumnVector<S>(b.re.size())};
        const auto value = [](const S& part) { return part.value; };
        const ComplexColumnVector<T> v =
            solve_with<T>(A, ComplexColumnVector<T>{b.re.unaryExpr(value), b.im.unaryExpr(value)});
        for (Eigen::Index c = 0; c < b.re.size(); ++c) {
            x.re[c].value = v.re[c];
            x.im[c].value = v.im[c];
        }
        for (std::size_t i = 0; i < std::tuple_size_v<decltype(S::gradient)>; ++i) {
            const auto slope = [i](const S& part) { return part.gradient[i]; };
            const ComplexColumnVector<T> g =
                solve_with<T>(A, ComplexColumnVector<T>{b.re.unaryExpr(slope), b.im.unaryExpr(slope)});
            for (Eigen::Index c = 0; c < b.re.size(); ++c) {
                x.re[c].gradient[i] = g.re[c];
                x.im[c].gradient[i] = g.im[c];
            }
        }
        return x;
    }
}

}  // namespace footfall
