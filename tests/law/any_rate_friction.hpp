// A friction law with internal states that is chosen when the program runs: one face for all of them, and the equations
// of motion are compiled once.
#pragma once

#include <concepts>
#include <span>
#include <type_traits>
#include <variant>

#include "footfall/law/erased.hpp"
#include "footfall/law/friction/rate_friction.hpp"
#include "footfall/law/registry.hpp"

namespace footfall {

/// Whether a law has a force over the load that follows from slip velocity and states alone.
template <class Law>
using IsRateFriction = std::bool_constant<RateFriction<Law>>;
/// Those of the registry.
template <class S>
using RateFrictionLawOver = LawsThat<FrictionLawOver<S>, IsRateFriction>;

/// Any of the registered laws with internal states (rate_friction.hpp says what the members mean). Spans of states have
/// the length `state_count()`.
template <class S = double>
class AnyRateFriction {
public:
    using value_type = S;

    template <RateFriction Law>
    constexpr AnyRateFriction(const Law& law) : law_(law) {}

    /// How many states each contact has.
    [[nodiscard]] constexpr int state_count() const noexcept {
        return std::visit([]<class Law>(const Law&) { return Law::states; }, law_);
    }

    /// The response in a phase, stick or slip; writes the rates of the states.
    [[nodiscard]] RateResponse<S> respond(Phase phase, const Vector2<S>& V, FrictionStates<S> x,
                                          std::span<S> rate) const noexcept {
        return std::visit(
            [&]<class Law>(const Law& law) {
                if constexpr (JumpingRateFriction<Law>) {
                    return law.respond(phase, V, x, rate);
                } else {
                    return law.respond(V, x, rate);
                }
            },
            law_);
    }

    /// w, what is stored over the load [m], >= 0.
    [[nodiscard]] S stored(Phase phase, FrictionStates<S> x) const noexcept {
        return std::visit(
            [&]<class Law>(const Law& law) {
                if constexpr (JumpingRateFriction<Law>) {
                    return law.stored(phase, x);
                } else {
                    return law.stored(x);
                }
            },
            law_);
    }

    /// The deflection to show a person [m]; zero for a law without states.
    [[nodiscard]] Vector2<S> bristle(FrictionStates<S> x) const noexcept {
        return std::visit(
            [&]<class Law>(const Law& law) -> Vector2<S> {
                if constexpr (requires { law.bristle(x); }) {
                    return law.bristle(x);
                } else if constexpr (Law::states >= 2) {
                    return vector_at<S>(x);
                } else {
                    return Vector2<S>::Zero();
                }
            },
            law_);
    }

    /// The phase of a new contact: slip for a smooth law.
    [[nodiscard]] constexpr Phase first_phase() const noexcept {
        return std::visit(
            []<class Law>(const Law&) {
                if constexpr (JumpingRateFriction<Law>) {
                    return Law::first_phase;
                } else {
                    return Phase::slip;
                }
            },
            law_);
    }

    /// Positive while the phase lasts; always, for a smooth law.
    [[nodiscard]] S margin(Phase phase, const Vector2<S>& V, FrictionStates<S> x) const noexcept {
        return std::visit(
            [&]<class Law>(const Law& law) {
                if constexpr (JumpingRateFriction<Law>) {
                    return law.margin(phase, V, x);
                } else {
                    return S(1);
                }
            },
            law_);
    }

    /// Where the margin has reached zero: writes the states that follow, returns the phase that follows.
    [[nodiscard]] Phase jump(Phase phase, const Vector2<S>& V, std::span<S> x) const noexcept {
        return std::visit(
            [&]<class Law>(const Law& law) {
                if constexpr (JumpingRateFriction<Law>) {
                    return law.jump(phase, V, x);
                } else {
                    return phase;
                }
            },
            law_);
    }

    /// The natural size of state i in its own unit, > 0.
    [[nodiscard]] double state_size(int i) const noexcept {
        return std::visit([&](const auto& law) { return law.state_size(i); }, law_);
    }

    template <class T>
    [[nodiscard]] constexpr AnyRateFriction<T> cast() const noexcept {
        return std::visit([](const auto& law) { return AnyRateFriction<T>(law.template cast<T>()); }, law_);
    }

private:
    RateFrictionLawOver<S> law_;
};

}  // namespace footfall
