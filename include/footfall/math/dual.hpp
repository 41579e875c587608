// Forward-mode dual numbers: a value that carries its derivatives with respect to N inputs.
//
// Every operation gives, in `value`, exactly the number that the same operation on plain T gives, and in
// `gradient` its derivatives by the chain rule. Comparisons look at the value alone, so a branch is taken as
// plain T takes it, and the gradient is that of the branch taken. Where an elementary function has an infinite
// or undefined slope (the root at 0, a power at 0, the logarithm in a power), an input that does not move
// the argument still has derivative 0 there instead of 0 * infinity = NaN; one that does move it gets what
// IEEE arithmetic gives, which is not finite.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <type_traits>

namespace footfall {

/// A number with its derivatives with respect to N inputs. N >= 1; T a floating-point type, or again a Dual.
template <class T, int N>
struct Dual {
    static_assert(N >= 1);

    // The gradient comes first, so that a copy moves it in the pairs in which the arithmetic has just written it: a
    // processor waits where it reads across two writes.
    std::array<T, N> gradient{};  ///< its derivative with respect to each input
    T value{};                    ///< the number itself

    constexpr Dual() noexcept = default;
    /// A constant: all derivatives are zero.
    constexpr Dual(const T& constant) noexcept : value(constant) {}
    /// A constant of another arithmetic type.
    template <class A>
        requires(std::is_arithmetic_v<A> && !std::same_as<A, T>)
    constexpr Dual(A constant) noexcept : value(static_cast<T>(constant)) {}
    constexpr Dual(const T& v, const std::array<T, N>& g) noexcept : gradient(g), value(v) {}
    /// The number alone of one that carries other derivatives, as a constant.
    template <int M>
        requires(M != N)
    explicit constexpr Dual(const Dual<T, M>& other) noexcept : value(other.value) {}

    /// The `index`-th input itself, 0 <= index < N: derivative 1 with respect to itself, 0 to the others.
    [[nodiscard]] static constexpr Dual variable(const T& v, int index) noexcept {
        Dual x(v);
        x.gradient[static_cast<std::size_t>(index)] = T(1);
        return x;
    }

    [[gnu::always_inline]] constexpr Dual& operator+=(const Dual& b) noexcept { return *this = *this + b; }
    [[gnu::always_inline]] constexpr Dual& operator-=(const Dual& b) noexcept { return *this = *this - b; }
    constexpr Dual& operator*=(const Dual& b) noexcept { return *this = *this * b; }
    constexpr Dual& operator/=(const Dual& b) noexcept { return *this = *this / b; }

    friend constexpr Dual operator+(const Dual& a) noexcept { return a; }
    friend constexpr Dual operator-(const Dual& a) noexcept {
        return make(-a.value, [&](std::size_t i) { return -a.gradient[i]; });
    }

    friend constexpr Dual operator+(const Dual& a, const Dual& b) noexcept {
        return make(a.value + b.value, [&](std::size_t i) { return a.gradient[i] + b.gradient[i]; });
    }
    friend constexpr Dual operator-(const Dual& a, const Dual& b) noexcept {
        return make(a.value - b.value, [&](std::size_t i) { return a.gradient[i] - b.gradient[i]; });
    }
    friend constexpr Dual operator*(const Dual& a, const Dual& b) noexcept {
        return make(a.value * b.value,
                    [&](std::size_t i) { return a.gradient[i] * b.value + a.value * b.gradient[i]; });
    }
    friend constexpr Dual operator/(const Dual& a, const Dual& b) noexcept {
        const T quotient = a.value / b.value;
        const T inverse = T(1) / b.value;
        return make(quotient, [&](std::size_t i) { return (a.gradient[i] - quotient * b.gradient[i]) * inverse; });
    }

    // A constant on one side: its zero gradient is never formed.
    friend constexpr Dual operator+(const Dual& a, const T& b) noexcept { return {a.value + b, a.gradient}; }
    friend constexpr Dual operator+(const T& a, const Dual& b) noexcept { return {a + b.value, b.gradient}; }
    friend constexpr Dual operator-(const Dual& a, const T& b) noexcept { return {a.value - b, a.gradient}; }
    friend constexpr Dual operator-(const T& a, const Dual& b) noexcept {
        return make(a - b.value, [&](std::size_t i) { return -b.gradient[i]; });
    }
    friend constexpr Dual operator*(const Dual& a, const T& b) noexcept {
        return make(a.value * b, [&](std::size_t i) { return a.gradient[i] * b; });
    }
    friend constexpr Dual operator*(const T& a, const Dual& b) noexcept {
        return make(a * b.value, [&](std::size_t i) { return a * b.gradient[i]; });
    }
    friend constexpr Dual operator/(const Dual& a, const T& b) noexcept {
        return make(a.value / b, [&](std::size_t i) { return a.gradient[i] / b; });
    }
    friend constexpr Dual operator/(const T& a, const Dual& b) noexcept {
        const T quotient = a / b.value;
        return make(quotient, [&, factor = -quotient / b.value](std::size_t i) { return factor * b.gradient[i]; });
    }

    friend constexpr bool operator==(const Dual& a, const Dual& b) noexcept { return a.value == b.value; }
    friend constexpr bool operator<(const Dual& a, const Dual& b) noexcept { return a.value < b.value; }
    friend constexpr bool operator>(const Dual& a, const Dual& b) noexcept { return a.value > b.value; }
    friend constexpr bool operator<=(const Dual& a, const Dual& b) noexcept { return a.value <= b.value; }
    friend constexpr bool operator>=(const Dual& a, const Dual& b) noexcept { return a.value >= b.value; }

    /// |x|; at 0 the derivative from the right.
    friend constexpr Dual abs(const Dual& x) noexcept { return x.value < T(0) ? -x : x; }

    /// sqrt(x). At 0 the slope is infinite: a derivative there is 0 where x does not move, else infinite.
    friend Dual sqrt(const Dual& x) noexcept {
        using std::sqrt;
        const T root = sqrt(x.value);
        return chain(root, T(0.5) / root, x);
    }
    friend Dual exp(const Dual& x) noexcept {
        using std::exp;
        const T e = exp(x.value);
        return chain(e, e, x);
    }
    friend Dual log(const Dual& x) noexcept {
        using std::log;
        return chain(log(x.value), T(1) / x.value, x);
    }
    friend Dual sin(const Dual& x) noexcept {
        using std::cos, std::sin;
        return chain(sin(x.value), cos(x.value), x);
    }
    friend Dual cos(const Dual& x) noexcept {
        using std::cos, std::sin;
        return chain(cos(x.value), -sin(x.value), x);
    }
    friend Dual tanh(const Dual& x) noexcept {
        using std::tanh;
        const T t = tanh(x.value);
        return chain(t, T(1) - t * t, x);
    }

    /// x^e for a constant exponent.
    friend Dual pow(const Dual& x, const T& e) noexcept {
        using std::pow;
        const T p = pow(x.value, e);
        return chain(p, power_slope(x.value, e, p), x);
    }
    /// b^x for a constant base.
    friend Dual pow(const T& b, const Dual& x) noexcept {
        using std::pow;
        const T p = pow(b, x.value);
        return chain(p, exponent_slope(b, p), x);
    }
    /// x^e. Where x < 0 only an exponent that does not move has a finite derivative.
    friend Dual pow(const Dual& x, const Dual& e) noexcept {
        using std::pow;
        const T p = pow(x.value, e.value);
        const Dual by_base = chain(p, power_slope(x.value, e.value, p), x);
        const Dual by_exponent = chain(p, exponent_slope(x.value, p), e);
        return make(p, [&](std::size_t i) { return by_base.gradient[i] + by_exponent.gradient[i]; });
    }

    // Constants of another arithmetic type, such as the 2 in 2 * x, are constants of type T.
    template <class A>
    static constexpr bool is_other_constant = std::is_arithmetic_v<A> && !std::same_as<A, T>;
    template <class A>
        requires is_other_constant<A>
    friend constexpr Dual operator+(const Dual& a, A b) noexcept {
        return a + T(b);
    }
    template <class A>
        requires is_other_constant<A>
    friend constexpr Dual operator+(A a, const Dual& b) noexcept {
        return T(a) + b;
    }
    template <class A>
        requires is_other_constant<A>
    friend constexpr Dual operator-(const Dual& a, A b) noexcept {
        return a - T(b);
    }
    template <class A>
        requires is_other_constant<A>
    friend constexpr Dual operator-(A a, const Dual& b) noexcept {
        return T(a) - b;
    }
    template <class A>
        requires is_other_constant<A>
    friend constexpr Dual operator*(const Dual& a, A b) noexcept {
        return a * T(b);
    }
    template <class A>
        requires is_other_constant<A>
    friend constexpr Dual operator*(A a, const Dual& b) noexcept {
        return T(a) * b;
    }
    template <class A>
        requires is_other_constant<A>
    friend constexpr Dual operator/(const Dual& a, A b) noexcept {
        return a / T(b);
    }
    template <class A>
        requires is_other_constant<A>
    friend constexpr Dual operator/(A a, const Dual& b) noexcept {
        return T(a) / b;
    }
    template <class A>
        requires is_other_constant<A>
    friend Dual pow(const Dual& x, A e) noexcept {
        return pow(x, T(e));
    }
    template <class A>
        requires is_other_constant<A>
    friend Dual pow(A b, const Dual& x) noexcept {
        return pow(T(b), x);
    }

    /// The value and every derivative are finite.
    friend bool isfinite(const Dual& x) noexcept {
        using std::isfinite;
        bool finite = isfinite(x.value);
        for (const T& g : x.gradient) finite = finite && isfinite(g);
        return finite;
    }

private:
    template <class Component>
    static constexpr Dual make(const T& v, Component&& component) noexcept {
        Dual result(v);
        for (std::size_t i = 0; i < static_cast<std::size_t>(N); ++i) result.gradient[i] = component(i);
        return result;
    }

    /// f(x) from its value and slope. A slope that is not finite leaves a zero derivative zero.
    static Dual chain(const T& v, const T& slope, const Dual& x) noexcept {
        using std::isfinite;
        if (isfinite(slope)) [[likely]] {
            return make(v, [&](std::size_t i) { return slope * x.gradient[i]; });
        }
        return make(v, [&](std::size_t i) { return x.gradient[i] == T(0) ? T(0) : slope * x.gradient[i]; });
    }

    /// e b^(e-1), with one call of pow where the quotient loses no digits.
    static T power_slope(const T& b, const T& e, const T& p) noexcept {
        using std::abs, std::pow;
        if (e == T(0)) return T(0);
        if (abs(p) > T(1e-30) && abs(p) < T(1e30)) [[likely]]
            return e * p / b;
        return e * pow(b, e - T(1));
    }
    /// b^e log b, whose limit at b = 0 < e is 0.
    static T exponent_slope(const T& b, const T& p) noexcept {
        using std::log;
        return p == T(0) ? T(0) : p * log(b);
    }
};

}  // namespace footfall
