// Small vectors and matrices of any scalar, with nothing behind them. To and from Eigen: eigen/interop.hpp.
//
// Every component is written out: the compiler keeps in registers what no loop runs over.
#pragma once

#include <cmath>

namespace footfall {

/// Two numbers. Vector2<S>{} is zero; a variable declared without braces holds what is there.
template <class S>
class Vector2 {
public:
    using Scalar = S;

    constexpr Vector2() noexcept = default;
    constexpr Vector2(const S& x, const S& y) noexcept : v_{x, y} {}
    [[nodiscard]] static constexpr Vector2 Zero() noexcept { return {}; }

    [[nodiscard]] constexpr const S& operator[](int i) const noexcept { return v_[i]; }
    [[nodiscard]] constexpr S& operator[](int i) noexcept { return v_[i]; }
    [[nodiscard]] constexpr const S& x() const noexcept { return v_[0]; }
    [[nodiscard]] constexpr S& x() noexcept { return v_[0]; }
    [[nodiscard]] constexpr const S& y() const noexcept { return v_[1]; }
    [[nodiscard]] constexpr S& y() noexcept { return v_[1]; }
    [[nodiscard]] constexpr const S* data() const noexcept { return v_; }
    [[nodiscard]] constexpr S* data() noexcept { return v_; }

    constexpr Vector2& operator+=(const Vector2& b) noexcept { return *this = *this + b; }
    constexpr Vector2& operator-=(const Vector2& b) noexcept { return *this = *this - b; }
    constexpr Vector2& operator*=(const S& k) noexcept { return *this = *this * k; }
    constexpr Vector2& operator/=(const S& k) noexcept { return *this = *this / k; }

    [[nodiscard]] friend constexpr Vector2 operator-(const Vector2& a) noexcept { return {-a.v_[0], -a.v_[1]}; }
    [[nodiscard]] friend constexpr Vector2 operator+(const Vector2& a, const Vector2& b) noexcept {
        return {a.v_[0] + b.v_[0], a.v_[1] + b.v_[1]};
    }
    [[nodiscard]] friend constexpr Vector2 operator-(const Vector2& a, const Vector2& b) noexcept {
        return {a.v_[0] - b.v_[0], a.v_[1] - b.v_[1]};
    }
    [[nodiscard]] friend constexpr Vector2 operator*(const Vector2& a, const S& k) noexcept {
        return {a.v_[0] * k, a.v_[1] * k};
    }
    [[nodiscard]] friend constexpr Vector2 operator*(const S& k, const Vector2& a) noexcept { return a * k; }
    [[nodiscard]] friend constexpr Vector2 operator/(const Vector2& a, const S& k) noexcept {
        return {a.v_[0] / k, a.v_[1] / k};
    }
    [[nodiscard]] friend constexpr bool operator==(const Vector2& a, const Vector2& b) noexcept {
        return a.v_[0] == b.v_[0] && a.v_[1] == b.v_[1];
    }

    [[nodiscard]] constexpr S dot(const Vector2& b) const noexcept { return v_[0] * b.v_[0] + v_[1] * b.v_[1]; }
    [[nodiscard]] constexpr S squaredNorm() const noexcept { return dot(*this); }
    [[nodiscard]] S norm() const noexcept {
        using std::sqrt;
        return sqrt(squaredNorm());
    }
    /// Of length 1; the zero vector stays what it is.
    [[nodiscard]] Vector2 normalized() const noexcept {
        const S length = norm();
        return length > S(0) ? *this / length : *this;
    }
    [[nodiscard]] constexpr bool isZero() const noexcept { return *this == Vector2(); }
    [[nodiscard]] bool allFinite() const noexcept {
        using std::isfinite;
        return isfinite(v_[0]) && isfinite(v_[1]);
    }
    /// The same in another scalar.
    template <class T>
    [[nodiscard]] constexpr Vector2<T> cast() const noexcept {
        return {T(v_[0]), T(v_[1])};
    }

private:
    S v_[2];
};

/// Three numbers, as Vector2.
template <class S>
class Vector3 {
public:
    using Scalar = S;

    constexpr Vector3() noexcept = default;
    constexpr Vector3(const S& x, const S& y, const S& z) noexcept : v_{x, y, z} {}
    [[nodiscard]] static constexpr Vector3 Zero() noexcept { return {}; }

    [[nodiscard]] constexpr const S& operator[](int i) const noexcept { return v_[i]; }
    [[nodiscard]] constexpr S& operator[](int i) noexcept { return v_[i]; }
    [[nodiscard]] constexpr const S& x() const noexcept { return v_[0]; }
    [[nodiscard]] constexpr S& x() noexcept { return v_[0]; }
    [[nodiscard]] constexpr const S& y() const noexcept { return v_[1]; }
    [[nodiscard]] constexpr S& y() noexcept { return v_[1]; }
    [[nodiscard]] constexpr const S& z() const noexcept { return v_[2]; }
    [[nodiscard]] constexpr S& z() noexcept { return v_[2]; }
    [[nodiscard]] constexpr const S* data() const noexcept { return v_; }
    [[nodiscard]] constexpr S* data() noexcept { return v_; }

    constexpr Vector3& operator+=(const Vector3& b) noexcept { return *this = *this + b; }
    constexpr Vector3& operator-=(const Vector3& b) noexcept { return *this = *this - b; }
    constexpr Vector3& operator*=(const S& k) noexcept { return *this = *this * k; }
    constexpr Vector3& operator/=(const S& k) noexcept { return *this = *this / k; }

    [[nodiscard]] friend constexpr Vector3 operator-(const Vector3& a) noexcept {
        return {-a.v_[0], -a.v_[1], -a.v_[2]};
    }
    [[nodiscard]] friend constexpr Vector3 operator+(const Vector3& a, const Vector3& b) noexcept {
        return {a.v_[0] + b.v_[0], a.v_[1] + b.v_[1], a.v_[2] + b.v_[2]};
    }
    [[nodiscard]] friend constexpr Vector3 operator-(const Vector3& a, const Vector3& b) noexcept {
        return {a.v_[0] - b.v_[0], a.v_[1] - b.v_[1], a.v_[2] - b.v_[2]};
    }
    [[nodiscard]] friend constexpr Vector3 operator*(const Vector3& a, const S& k) noexcept {
        return {a.v_[0] * k, a.v_[1] * k, a.v_[2] * k};
    }
    [[nodiscard]] friend constexpr Vector3 operator*(const S& k, const Vector3& a) noexcept { return a * k; }
    [[nodiscard]] friend constexpr Vector3 operator/(const Vector3& a, const S& k) noexcept {
        return {a.v_[0] / k, a.v_[1] / k, a.v_[2] / k};
    }
    [[nodiscard]] friend constexpr bool operator==(const Vector3& a, const Vector3& b) noexcept {
        return a.v_[0] == b.v_[0] && a.v_[1] == b.v_[1] && a.v_[2] == b.v_[2];
    }

    [[nodiscard]] constexpr S dot(const Vector3& b) const noexcept {
        return v_[0] * b.v_[0] + v_[1] * b.v_[1] + v_[2] * b.v_[2];
    }
    [[nodiscard]] constexpr S squaredNorm() const noexcept { return dot(*this); }
    [[nodiscard]] S norm() const noexcept {
        using std::sqrt;
        return sqrt(squaredNorm());
    }
    /// Of length 1; the zero vector stays what it is.
    [[nodiscard]] Vector3 normalized() const noexcept {
        const S length = norm();
        return length > S(0) ? *this / length : *this;
    }
    [[nodiscard]] constexpr Vector3 cross(const Vector3& b) const noexcept {
        return {y() * b.z() - z() * b.y(), z() * b.x() - x() * b.z(), x() * b.y() - y() * b.x()};
    }
    /// The first two components.
    [[nodiscard]] constexpr Vector2<S> in_plane() const noexcept { return {x(), y()}; }
    [[nodiscard]] constexpr bool isZero() const noexcept { return *this == Vector3(); }
    [[nodiscard]] bool allFinite() const noexcept {
        using std::isfinite;
        return isfinite(v_[0]) && isfinite(v_[1]) && isfinite(v_[2]);
    }
    /// The same in another scalar.
    template <class T>
    [[nodiscard]] constexpr Vector3<T> cast() const noexcept {
        return {T(v_[0]), T(v_[1]), T(v_[2])};
    }

private:
    S v_[3];
};

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
