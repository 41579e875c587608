// Small vectors and matrices of any scalar, with nothing behind them. To and from Eigen: eigen/interop.hpp.
//
// No loop runs over the components: the compiler keeps in registers what none does.
#pragma once

#include <cmath>
#include <utility>

namespace footfall {

/// N numbers, 2 or 3. SmallVector{} is zero; a variable declared without braces holds what is there.
template <class S, int N>
class SmallVector {
    static_assert(N == 2 || N == 3);

public:
    constexpr SmallVector() noexcept = default;
    constexpr SmallVector(const S& x, const S& y) noexcept
        requires(N == 2)
        : v_{x, y} {}
    constexpr SmallVector(const S& x, const S& y, const S& z) noexcept
        requires(N == 3)
        : v_{x, y, z} {}
    [[nodiscard]] static constexpr SmallVector Zero() noexcept { return {}; }

    [[nodiscard]] constexpr const S& operator[](int i) const noexcept { return v_[i]; }
    [[nodiscard]] constexpr S& operator[](int i) noexcept { return v_[i]; }
    [[nodiscard]] constexpr const S& x() const noexcept { return v_[0]; }
    [[nodiscard]] constexpr S& x() noexcept { return v_[0]; }
    [[nodiscard]] constexpr const S& y() const noexcept { return v_[1]; }
    [[nodiscard]] constexpr S& y() noexcept { return v_[1]; }
    [[nodiscard]] constexpr const S& z() const noexcept
        requires(N == 3)
    {
        return v_[2];
    }
    [[nodiscard]] constexpr S& z() noexcept
        requires(N == 3)
    {
        return v_[2];
    }
    [[nodiscard]] constexpr const S* data() const noexcept { return v_; }
    [[nodiscard]] constexpr S* data() noexcept { return v_; }

    constexpr SmallVector& operator+=(const SmallVector& b) noexcept { return *this = *this + b; }
    constexpr SmallVector& operator-=(const SmallVector& b) noexcept { return *this = *this - b; }
    constexpr SmallVector& operator*=(const S& k) noexcept { return *this = *this * k; }
    constexpr SmallVector& operator/=(const S& k) noexcept { return *this = *this / k; }

    [[nodiscard]] friend constexpr SmallVector operator-(const SmallVector& a) noexcept {
        return each([&](int i) { return -a.v_[i]; });
    }
    [[nodiscard]] friend constexpr SmallVector operator+(const SmallVector& a, const SmallVector& b) noexcept {
        return each([&](int i) { return a.v_[i] + b.v_[i]; });
    }
    [[nodiscard]] friend constexpr SmallVector operator-(const SmallVector& a, const SmallVector& b) noexcept {
        return each([&](int i) { return a.v_[i] - b.v_[i]; });
    }
    [[nodiscard]] friend constexpr SmallVector operator*(const SmallVector& a, const S& k) noexcept {
        return each([&](int i) { return a.v_[i] * k; });
    }
    [[nodiscard]] friend constexpr SmallVector operator*(const S& k, const SmallVector& a) noexcept { return a * k; }
    [[nodiscard]] friend constexpr SmallVector operator/(const SmallVector& a, const S& k) noexcept {
        return each([&](int i) { return a.v_[i] / k; });
    }
    [[nodiscard]] friend constexpr bool operator==(const SmallVector& a, const SmallVector& b) noexcept {
        return with_indices([&](auto... i) { return ((a.v_[i] == b.v_[i]) && ...); });
    }

    [[nodiscard]] constexpr S dot(const SmallVector& b) const noexcept {
        return with_indices([&](auto... i) { return (... + (v_[i] * b.v_[i])); });
    }
    [[nodiscard]] constexpr S squaredNorm() const noexcept { return dot(*this); }
    [[nodiscard]] S norm() const noexcept {
        using std::sqrt;
        return sqrt(squaredNorm());
    }
    /// Of length 1; the zero vector stays what it is.
    [[nodiscard]] SmallVector normalized() const noexcept {
        const S length = norm();
        return length > S(0) ? *this / length : *this;
    }
    [[nodiscard]] constexpr SmallVector cross(const SmallVector& b) const noexcept
        requires(N == 3)
    {
        return {y() * b.z() - z() * b.y(), z() * b.x() - x() * b.z(), x() * b.y() - y() * b.x()};
    }
    /// The first two components.
    [[nodiscard]] constexpr SmallVector<S, 2> in_plane() const noexcept
        requires(N == 3)
    {
        return {x(), y()};
    }
    [[nodiscard]] constexpr bool isZero() const noexcept { return *this == SmallVector(); }
    [[nodiscard]] bool allFinite() const noexcept {
        using std::isfinite;
        return with_indices([&](auto... i) { return (isfinite(v_[i]) && ...); });
    }
    /// The same in another scalar.
    template <class T>
    [[nodiscard]] constexpr SmallVector<T, N> cast() const noexcept {
        return with_indices([&](auto... i) { return SmallVector<T, N>(T(v_[i])...); });
    }

private:
    /// f(0, 1, ...), up to N - 1.
    template <class F>
    [[gnu::always_inline]] static constexpr auto with_indices(F&& f) noexcept {
        return [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) { return f(I...); }
        (std::make_integer_sequence<int, N>{});
    }
    /// The vector of f(0), f(1), ...
    template <class F>
    [[gnu::always_inline]] static constexpr SmallVector each(F&& f) noexcept {
        return with_indices([&](auto... i) __attribute__((always_inline)) { return SmallVector(f(i)...); });
    }

    S v_[N];
};

template <class S>
using Vector2 = SmallVector<S, 2>;
template <class S>
using Vector3 = SmallVector<S, 3>;

/// Three rows of three numbers.
template <class S>
struct Matrix3 {
    Vector3<S> row[3];

    [[nodiscard]] friend constexpr Vector3<S> operator*(const Matrix3& m, const Vector3<S>& v) noexcept {
        return {m.row[0].dot(v), m.row[1].dot(v), m.row[2].dot(v)};
    }
    /// The transpose's product with v.
    [[nodiscard]] constexpr Vector3<S> transposed_times(const Vector3<S>& v) const noexcept {
        return row[0] * v[0] + row[1] * v[1] + row[2] * v[2];
    }
    template <class T>
    [[nodiscard]] constexpr Matrix3<T> cast() const noexcept {
        return {row[0].template cast<T>(), row[1].template cast<T>(), row[2].template cast<T>()};
    }
};

/// The rotation of the unit quaternion (w, x, y, z).
template <class S>
[[nodiscard]] constexpr Matrix3<S> rotation_of(const S& w, const S& x, const S& y, const S& z) noexcept {
    const S two(2), one(1);
    const S x2 = two * x, y2 = two * y, z2 = two * z;
    const S wx = x2 * w, wy = y2 * w, wz = z2 * w, xx = x2 * x, xy = y2 * x, xz = z2 * x, yy = y2 * y, yz = z2 * y,
            zz = z2 * z;
    return {{{one - (yy + zz), xy - wz, xz + wy},
             {xy + wz, one - (xx + zz), yz - wx},
             {xz - wy, yz + wx, one - (xx + yy)}}};
}

}  // namespace footfall
