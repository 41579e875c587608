// Between Eigen and what is here: vectors both ways, and Eigen's arrays of dual numbers.
#pragma once

#include <concepts>
#include <type_traits>
#include <utility>

#include <Eigen/Core>

#include "footfall/math/dual.hpp"
#include "footfall/math/value_of.hpp"
#include "footfall/math/vector.hpp"

namespace footfall {

template <class S>
[[nodiscard]] Eigen::Matrix<S, 2, 1> to_eigen(const Vector2<S>& v) {
    return {v.x(), v.y()};
}
template <class S>
[[nodiscard]] Eigen::Matrix<S, 3, 1> to_eigen(const Vector3<S>& v) {
    return {v.x(), v.y(), v.z()};
}
template <class S>
[[nodiscard]] Vector2<S> from_eigen(const Eigen::Matrix<S, 2, 1>& v) {
    return {v.x(), v.y()};
}
template <class S>
[[nodiscard]] Vector3<S> from_eigen(const Eigen::Matrix<S, 3, 1>& v) {
    return {v.x(), v.y(), v.z()};
}

/// The array of a value for each component; of plain numbers, the array itself.
template <class Array>
[[nodiscard]] decltype(auto) values_of(const Array& y) {
    using S = typename Array::Scalar;
    if constexpr (std::floating_point<S>) {
        return (y);
    } else {
        return y.unaryExpr([](const S& x) { return value_of(x); }).eval();
    }
}

template <class Array>
void values_of(const Array&& y) = delete;  // the array itself would be gone

/// The array type of the values of an array type, with its shape.
template <class Array>
using ValuesOf = std::remove_cvref_t<decltype(values_of(std::declval<const Array&>()))>;

}  // namespace footfall

/// Lets Eigen's matrices hold dual numbers.
template <class T, int N>
struct Eigen::NumTraits<footfall::Dual<T, N>> : Eigen::NumTraits<T> {
    using Real = footfall::Dual<T, N>;
    using NonInteger = footfall::Dual<T, N>;
    using Nested = footfall::Dual<T, N>;
    enum {
        IsComplex = 0,
        IsInteger = 0,
        IsSigned = 1,
        RequireInitialization = 1,
        ReadCost = (N + 1) * NumTraits<T>::ReadCost,
        AddCost = (N + 1) * NumTraits<T>::AddCost,
        MulCost = (2 * N + 1) * NumTraits<T>::MulCost
    };
};

/// Lets constants of type T stand beside matrices of dual numbers, as in 2.0 * v.
template <class T, int N, class Operation>
struct Eigen::ScalarBinaryOpTraits<T, footfall::Dual<T, N>, Operation> {
    using ReturnType = footfall::Dual<T, N>;
};
template <class T, int N, class Operation>
struct Eigen::ScalarBinaryOpTraits<footfall::Dual<T, N>, T, Operation> {
    using ReturnType = footfall::Dual<T, N>;
};
