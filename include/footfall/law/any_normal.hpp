// A normal law that is chosen when the program runs. A run under it costs one predictable jump for each use of the law,
// and every friction law is compiled once instead of once for each normal law.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

#include "footfall/law/erased.hpp"
#include "footfall/law/normal/normal_force.hpp"
#include "footfall/law/normal/normal_part.hpp"
#include "footfall/law/registry.hpp"

namespace footfall {

/// Any of the registered normal laws, prepared, with the members that they share. The states of a law that has them are
/// those of the impact that was begun last, as it began; of one that moves them on, `force` and `load` also take
/// others.
template <class S = double>
class AnyNormal {
public:
    using value_type = S;
    using States = std::span<const S>;

    template <class Law>
        requires(!std::is_same_v<std::remove_cvref_t<Law>, AnyNormal>)
    constexpr AnyNormal(const Law& law) : AnyNormal(law, AsItIs{}) {
        prepare_law(law_);
        begin_impact(S(0));
    }

    /// f / s^Over before the clamp, s = sqrt(z).
    template <int Over = 0>
    [[nodiscard, gnu::always_inline]] constexpr NormalForce<S> force(const S& s, const S& z_rate) const noexcept {
        return force<Over>(s, z_rate, begun_);
    }
    template <int Over = 0>
    [[nodiscard, gnu::always_inline]] constexpr NormalForce<S> force(const S& s, const S& z_rate,
                                                                     States x) const noexcept {
        return visit([&](const auto& part) { return part.force(Over, s, z_rate, x); });
    }

    /// The unclamped force over its leading power of s.
    [[nodiscard, gnu::always_inline]] constexpr S load(const S& s, const S& z_rate) const noexcept {
        return load(s, z_rate, begun_);
    }
    [[nodiscard, gnu::always_inline]] constexpr S load(const S& s, const S& z_rate, States x) const noexcept {
        return visit([&](const auto& part) { return part.load(s, z_rate, x); });
    }

    /// Energy in the normal spring [J].
    [[nodiscard, gnu::always_inline]] constexpr S stored_energy(const S& s) const noexcept {
        return visit([&](const auto& part) { return part.stored_energy(s, begun_); });
    }

    /// Begins an impact at a speed [m/s], which the damping of some laws depends on.
    constexpr void begin_impact(const S& speed) noexcept {
        visit([&](const auto& part) { part.land(speed, begun_); });
    }

    // States that change while the impact lasts --------------------------------------------------------------------

    /// The most that a registered law has.
    static constexpr int most_moving_states = [] {
        int most = 0;
        for_each_law<NormalLaw>([&]<class Law>(const Law&) {
            if (NormalPart<Law>::moving_states() > most) most = NormalPart<Law>::moving_states();
        });
        return most;
    }();
    /// How many this law has.
    [[nodiscard]] constexpr int moving_states() const noexcept {
        if constexpr (most_moving_states == 0) return 0;
        return visit([](const auto& part) { return part.moving_states(); });
    }
    /// All states of the law as the impact began.
    [[nodiscard]] constexpr States begun() const noexcept { return begun_; }
    /// The natural size of state k in its own unit, for a contact that reaches the root depth s [m^0.5].
    [[nodiscard]] double state_size(int k, const S& s) const noexcept {
        return visit([&](const auto& part) { return part.state_size(k, s); });
    }
    /// How the states x change.
    void rates(const S& s, const S& z_rate, States x, std::span<S> out) const noexcept {
        visit([&](const auto& part) { part.rates(s, z_rate, x, out); });
    }

    template <class T>
    [[nodiscard]] constexpr AnyNormal<T> cast() const noexcept {
        AnyNormal<T> other = std::visit(
            [](const auto& law) { return AnyNormal<T>(law.template cast<T>(), typename AnyNormal<T>::AsItIs{}); },
            law_);
        for (std::size_t k = 0; k < begun_.size(); ++k) other.begun_[k] = T(begun_[k]);
        return other;
    }

private:
    template <class>
    friend class AnyNormal;

    /// What has been prepared stays so over another scalar.
    struct AsItIs {};
    template <class Law>
    constexpr AnyNormal(const Law& law, AsItIs /*prepared*/) : law_(law) {}

    template <class Visit>
    [[gnu::always_inline]] constexpr decltype(auto) visit(Visit&& visit) const {
        return std::visit([&]<class Law>(const Law& law) { return visit(NormalPart<Law>{law}); }, law_);
    }

    static constexpr int most_states = [] {
        int most = 0;
        for_each_law<NormalLaw>([&]<class Law>(const Law&) {
            if (NormalPart<Law>::states() > most) most = NormalPart<Law>::states();
        });
        return most;
    }();

    NormalLawOver<S> law_;
    std::array<S, static_cast<std::size_t>(most_states)> begun_{};
};

}  // namespace footfall
