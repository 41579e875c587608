// The laws of the registry as type lists, and random laws and states to try them on.
#pragma once

#include <array>
#include <cmath>
#include <string_view>
#include <tuple>
#include <variant>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "footfall/law/contact_law.hpp"
#include "footfall/law/registry.hpp"
#include "math/random_real.hpp"

namespace footfall::test {

template <class Variant>
struct TypesOf;
template <class... Laws>
struct TypesOf<std::variant<Laws...>> {
    using type = ::testing::Types<Laws...>;
};
using NormalLaws = TypesOf<NormalLaw>::type;

/// The friction laws that have a bristle with a clutch.
template <class Law>
using HasClutch = std::bool_constant<ClutchFriction<Law>>;
using ClutchedLaws = LawsThat<FrictionLaw, HasClutch>;
using BristleLaws = TypesOf<ClutchedLaws>::type;

/// Pairs of a normal law and a friction law with a clutch; those with internal states are in friction_states_test.cpp.
/// ContactLaw asks nothing of a normal law that NormalLawTest does not try on each of them, so three that start with
/// different powers of the depth stand for all.
template <class Normals, class Frictions>
struct PairsOf;
template <class... Normals, class... Frictions>
struct PairsOf<std::variant<Normals...>, std::variant<Frictions...>> {
    template <class Normal>
    using row = std::tuple<ContactLaw<Normal, Frictions>...>;
    template <class... Laws>
    static ::testing::Types<Laws...> listed(const std::tuple<Laws...>&);
    using type = decltype(listed(std::tuple_cat(std::declval<row<Normals>>()...)));
};
/// The laws with one bristle and a clutch, and none.
template <class Law>
using HasClutchOrNothing = std::bool_constant<requires { Law::has_bristle; }>;
using ClutchFrictionLaw = LawsThat<FrictionLaw, HasClutchOrNothing>;
using SomeNormals = std::variant<AzadFeatherstoneNormal<>, HuntCrossleyNormal<>, LinearNormal<>>;
using ContactLaws = PairsOf<SomeNormals, ClutchFrictionLaw>::type;
/// Those of them in which stick and slip differ.
using ClutchedContactLaws = PairsOf<SomeNormals, ClutchedLaws>::type;

/// Names typed tests after the law, not after its position in the list.
struct LawNames {
    template <class Law>
    static std::string GetName(int i) {
        if constexpr (requires { Law::description; }) {
            return std::to_string(i) + "_" + tidy(Law::description.name);
        } else {
            return std::to_string(i) + "_" + tidy(decltype(Law::normal)::description.name) + "_" +
                   tidy(decltype(Law::friction)::description.name);
        }
    }

private:
    static std::string tidy(std::string_view name) {
        std::string out(name);
        for (char& c : out)
            if (c == '-') c = '_';
        return out;
    }
};

inline bool coin() { return *rc::gen::arbitrary<bool>(); }

/// A law with every parameter drawn from its range, zero and the values left out among them, put to use: prepared, and
/// told of an impact where it asks for that.
template <class Law>
Law random_law() {
    Law law{};
    const bool fallbacks = coin();
    for (const auto& parameter : Law::parameters()) {
        double value = 0;
        if (parameter.fallback && fallbacks) {
            value = *parameter.fallback;
        } else if (parameter.may_be_zero() && *rc::gen::inRange(0, 5) == 0) {
            value = 0;
        } else if (parameter.at_most_one) {
            value = *rc::gen::inRange(0, 5) == 0 ? 1 : *uniform(0.02, 1);
        } else {
            value = parameter.unit == "1" ? *uniform(0.3, 2.5) : *decades(1e-2, 1e6);
        }
        law.*parameter.member = value;
    }
    prepare_law(law);
    if constexpr (requires { law.begin_impact(1.0); }) law.begin_impact(*decades(1e-4, 1e1));
    return law;
}

/// A random normal law in the states of an impact that has just begun.
template <class Law>
struct Landed {
    using S = typename Law::value_type;
    static constexpr auto states = static_cast<std::size_t>(NormalPart<Law>::states());

    Law law;
    std::array<S, states> x{};

    template <int Over = 0>
    [[nodiscard]] NormalForce<S> force(const S& s, const S& rate) const {
        return part().force(Over, s, rate, x);
    }
    [[nodiscard]] S load(const S& s, const S& rate) const { return part().load(s, rate, x); }
    [[nodiscard]] S stored_energy(const S& s) const { return part().stored_energy(s, x); }
    template <class T>
    [[nodiscard]] auto cast() const {
        Landed<decltype(law.template cast<T>())> other{law.template cast<T>()};
        for (std::size_t k = 0; k < states; ++k) other.x[k] = T(x[k]);
        return other;
    }

private:
    [[nodiscard]] NormalPart<Law> part() const { return {law}; }
};
template <class Law>
Landed<Law> random_landed_law() {
    Landed<Law> landed{random_law<Law>()};
    NormalPart<Law>{landed.law}.land(*decades(1e-4, 1e1), landed.x);
    return landed;
}

/// Whether the parameters of a normal law say that it dissipates nothing.
template <class Law>
bool is_elastic(const Law& law) {
    for (const auto& p : Law::parameters()) {
        if (p.key == "restitution") return law.*p.member == 1;
        if (p.key == "damping" || p.key == "damping_time" || p.key == "alpha") return law.*p.member == 0;
    }
    return true;
}

template <class Law>
Law random_contact_law() {
    return {random_law<decltype(Law::normal)>(), random_law<decltype(Law::friction)>()};
}

/// A vector of a length from some decades, pointing anywhere.
inline Vector2<double> random_vector(double shortest, double longest) {
    const double length = *decades(shortest, longest), angle = *uniform(0, 6.283185307179586);
    return {length * std::cos(angle), length * std::sin(angle)};
}

/// Where a sphere is and how it moves.
struct ContactState {
    double depth = *decades(1e-8, 1e-2);
    double rate = (coin() ? 1 : -1) * *decades(1e-4, 1e1);
    Vector2<double> V = random_vector(1e-4, 1e1);
    Vector2<double> u = random_vector(1e-8, 1e-2);

    double s() const { return std::sqrt(depth); }
};

/// The derivative of a function of one number at x, in long double: error of order h^4. `f` may return a vector.
template <class F>
auto difference(const F& f, long double x) {
    using Value = decltype(f(x));
    const long double h = 1e-4L * std::abs(x);
    const auto central = [&](long double step) { return Value((f(x + step) - f(x - step)) / (2 * step)); };
    const Value wide = central(h), narrow = central(h / 2);
    return Value((narrow * 4 - wide) / 3);
}

inline bool near(double a, double b, double tolerance) { return std::abs(a - b) <= tolerance; }

}  // namespace footfall::test
