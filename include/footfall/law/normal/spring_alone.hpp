// A normal law that is pressed as slowly as it may be: its spring carries the load, and its damper does nothing.
#pragma once

#include <span>
#include <variant>

#include "footfall/law/normal/normal_force.hpp"
#include "footfall/law/normal/normal_part.hpp"

namespace footfall {

namespace detail {
/// The states of a law, as many as it has.
template <class Law>
struct StatesOf {};
template <HasNormalStates Law>
struct StatesOf<Law> {
    static constexpr int states = Law::states;
};
}  // namespace detail

/// The spring of a normal law. `x` are the law's states, where it has them.
template <class Law>
struct SpringAlone : detail::StatesOf<Law> {
    using value_type = typename Law::value_type;
    using S = value_type;

    Law law;

    explicit SpringAlone(Law l) : law(l) {}

    template <int Over = 0, class... X>
    [[nodiscard]] NormalForce<S> force(const S& s, const S& /*z_rate*/, const X&... x) const noexcept {
        return {law.template force<Over>(s, S(0), x...).elastic, S(0)};
    }
    template <class... X>
    [[nodiscard]] S load(const S& s, const S& /*z_rate*/, const X&... x) const noexcept {
        return law.load(s, S(0), x...);
    }
    template <class... X>
    [[nodiscard]] S stored_energy(const S& s, const X&... x) const noexcept {
        return law.stored_energy(s, x...);
    }
    void rates(const S& s, const S& z_rate, std::span<const S> x, std::span<S> out) const noexcept
        requires requires(const Law l) { l.rates(s, z_rate, x, out); }
    {
        law.rates(s, z_rate, x, out);
    }
    void land(const S& z_rate, std::span<S> x) const noexcept
        requires HasNormalStates<Law>
    {
        law.land(z_rate, x);
    }
    [[nodiscard]] double state_size(int i, const S& s) const noexcept
        requires HasNormalStates<Law>
    {
        return NormalPart<Law>{law}.state_size(i, s);
    }

    template <class T>
    [[nodiscard]] auto cast() const {
        return footfall::SpringAlone(law.template cast<T>());
    }
};

/// The springs of a variant of normal laws, and the laws themselves.
template <class Laws>
struct PressedLaws;
template <class... Laws>
struct PressedLaws<std::variant<Laws...>> {
    using type = std::variant<Laws..., SpringAlone<Laws>...>;
};
template <class Laws>
using PressedLaw = typename PressedLaws<Laws>::type;

}  // namespace footfall
