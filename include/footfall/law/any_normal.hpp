// A normal law that is chosen when the program runs. A run under it costs one predictable jump for each use of the law,
// and every friction law is compiled once instead of once for each normal law.
#pragma once

#include <type_traits>
#include <utility>
#include <variant>

#include "footfall/law/erased.hpp"
#include "footfall/law/normal/normal_force.hpp"
#include "footfall/law/registry.hpp"

namespace footfall {

/// Any of the registered normal laws, prepared, with the members that they share.
template <class S = double>
class AnyNormal {
public:
    using value_type = S;

    template <class Law>
        requires(!std::is_same_v<std::remove_cvref_t<Law>, AnyNormal>)
    constexpr AnyNormal(const Law& law) : AnyNormal(law, AsItIs{}) {
        prepare_law(law_);
    }

    /// f / s^Over before the clamp, s = sqrt(z).
    template <int Over = 0>
    [[nodiscard, gnu::always_inline]] constexpr NormalForce<S> force(const S& s, const S& z_rate) const noexcept {
        return std::visit([&](const auto& law) { return law.template force<Over>(s, z_rate); }, law_);
    }

    /// The unclamped force over its leading power of s.
    [[nodiscard, gnu::always_inline]] constexpr S load(const S& s, const S& z_rate) const noexcept {
        return std::visit([&](const auto& law) { return law.load(s, z_rate); }, law_);
    }

    /// Energy in the normal spring [J].
    [[nodiscard, gnu::always_inline]] constexpr S stored_energy(const S& s) const noexcept {
        return std::visit([&](const auto& law) { return law.stored_energy(s); }, law_);
    }

    /// Tells a law whose damping depends on it how fast an impact begins [m/s]; others need not know.
    constexpr void begin_impact(const S& speed) noexcept {
        std::visit(
            [&](auto& law) {
                if constexpr (requires { law.begin_impact(speed); }) law.begin_impact(speed);
            },
            law_);
    }

    template <class T>
    [[nodiscard]] constexpr AnyNormal<T> cast() const noexcept {
        return std::visit(
            [](const auto& law) { return AnyNormal<T>(law.template cast<T>(), typename AnyNormal<T>::AsItIs{}); },
            law_);
    }

private:
    template <class>
    friend class AnyNormal;

    /// What has been prepared stays so over another scalar.
    struct AsItIs {};
    template <class Law>
    constexpr AnyNormal(const Law& law, AsItIs /*prepared*/) : law_(law) {}

    NormalLawOver<S> law_;
};

}  // namespace footfall
