// The two laws of a contact, whichever they are, and where the states of each are among those of the contact.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>

#include "footfall/law/erased.hpp"
#include "footfall/law/friction/friction_part.hpp"
#include "footfall/law/normal/normal_part.hpp"
#include "footfall/law/touch.hpp"
#include "footfall/math/value_of.hpp"

namespace footfall {

/// The most states that a normal law has.
inline constexpr int most_normal_states = 8;

/// What Pair (pair.hpp) is made of.
template <class Normal, class Friction>
class PairParts {
public:
    using S = typename ScalarOf<Normal>::type;
    using States = std::span<const S>;

    Normal normal;
    Friction friction;

    PairParts(Normal n, Friction f) : normal(std::move(n)), friction(std::move(f)) {
        of_normal([&](const auto& part) { normal_states_ = part.states(); });
        of_friction([&](const auto& part) {
            friction_states_ = part.states();
            scale_power_ = part.scale_power;
        });
    }

    [[nodiscard]] int states() const noexcept { return normal_state_count() + friction_state_count(); }
    /// Those of the normal law, which come first.
    [[nodiscard]] constexpr int normal_state_count() const noexcept {
        if constexpr (is_erased<Normal>) {
            return normal_states_;
        } else {
            return NormalPart<Normal>::states();
        }
    }
    /// The numbers that a caller keeps for the bristle of a contact, behind the states of the normal law: the states of
    /// friction, or two that nothing depends on.
    [[nodiscard]] constexpr int bristle_size() const noexcept {
        if constexpr (is_erased<Friction>) {
            return of_friction([](const auto& part) { return part.bristle_size; });
        } else {
            return FrictionPart<Friction>::bristle_size;
        }
    }
    /// Numbers that no contact has more of, both together.
    static constexpr int most_states = [] {
        int most = 0;
        if constexpr (is_erased<Normal>) {
            most += most_normal_states;
        } else {
            most += NormalPart<Normal>::states();
        }
        if constexpr (is_erased<Friction>) {
            most += max_friction_states;
        } else {
            most += FrictionPart<Friction>::bristle_size;
        }
        return most;
    }();

    /// F_n, before the clamp [N], and its two parts.
    [[nodiscard]] S normal_force(const Touch<S>& t, States x) const noexcept { return normal_parts(t, x).total(); }
    [[nodiscard]] NormalForce<S> normal_parts(const Touch<S>& t, States x) const noexcept {
        return of_normal([&](const auto& part) { return part.force(0, t.root_depth, t.depth_rate, normal_states(x)); });
    }

    /// The root depth s > 0 at which the spring carries a force [N], > 0, or holds an energy [J], > 0; to a few digits.
    [[nodiscard]] double root_depth_under(double force) const {
        return reaches([&](double s) { return static_cast<double>(value_of(elastic_force(S(s)))); }, force);
    }
    [[nodiscard]] double root_depth_holding(double energy) const {
        const std::array<S, most_normal_states> none{};
        return reaches(
            [&](double s) {
                return static_cast<double>(value_of(
                    of_normal([&](const auto& part) { return part.stored_energy(S(s), normal_states(none)); })));
            },
            energy);
    }

protected:
    static constexpr std::size_t count(int n) noexcept { return static_cast<std::size_t>(n); }

    template <class Visit>
    [[gnu::always_inline]] decltype(auto) of_normal(Visit&& visit) const {
        return with_law(
            normal, [&]<class Law>(const Law& law)
                        __attribute__((always_inline)) { return visit(NormalPart<Law>{law}); });
    }
    template <class Visit>
    [[gnu::always_inline]] decltype(auto) of_friction(Visit&& visit) const {
        return with_law(
            friction, [&]<class Law>(const Law& law)
                          __attribute__((always_inline)) { return visit(FrictionPart<Law>{law}); });
    }
    [[nodiscard]] constexpr int friction_state_count() const noexcept {
        if constexpr (is_erased<Friction>) {
            return friction_states_;
        } else {
            return FrictionPart<Friction>::states();
        }
    }
    [[nodiscard]] constexpr int scale_power() const noexcept {
        if constexpr (is_erased<Friction>) {
            return scale_power_;
        } else {
            return FrictionPart<Friction>::scale_power;
        }
    }
    [[nodiscard]] States normal_states(States x) const noexcept { return x.first(count(normal_state_count())); }
    [[nodiscard]] std::span<S> normal_states(std::span<S> x) const noexcept {
        return x.first(count(normal_state_count()));
    }
    [[nodiscard]] States friction_states(States x) const noexcept { return x.subspan(count(normal_state_count())); }
    [[nodiscard]] std::span<S> friction_states(std::span<S> x) const noexcept {
        return x.subspan(count(normal_state_count()));
    }

    /// Of the normal law at rest, its states zero [N].
    [[nodiscard]] S elastic_force(const S& s) const noexcept {
        const std::array<S, most_normal_states> none{};
        return of_normal([&](const auto& part) { return part.force(0, s, S(0), normal_states(none)).elastic; });
    }

private:
    /// The s at which an increasing function reaches a value.
    template <class F>
    [[nodiscard]] static double reaches(F&& f, double value) {
        double low = -140, high = 140;  // log of s
        for (int k = 0; k < 40; ++k) {
            const double middle = 0.5 * (low + high);
            (f(std::exp(middle)) < value ? low : high) = middle;
        }
        return std::exp(0.5 * (low + high));
    }

    // Of laws that are chosen when the program runs.
    int normal_states_ = 0, friction_states_ = 0, scale_power_ = 0;
};

}  // namespace footfall
