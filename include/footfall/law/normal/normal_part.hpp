// What a contact law asks of its normal part, for every normal law, with states or without.
//
// A normal law with states declares them:
//   states                              how many
//   force<Over>(s, zdot, x), load(s, zdot, x), stored_energy(s, x)   as without states
//   land(zdot, x)                       writes the states of an impact that begins at zdot [m/s]
//   state_size(i) or state_size(i, s)   the natural size of state i in its own unit, > 0, where s is reached
//   rates(s, zdot, x, out)              optional: how they change; without it they stay as they are
// What moving states take from the spring is in NormalForce::relaxation.
#pragma once

#include <span>

#include "footfall/law/normal/normal_force.hpp"

namespace footfall {

template <class Law>
concept HasNormalStates = requires { Law::states; };

/// One normal law behind the face that all share. `x` are its states, `over` is the power of s that the force is over:
/// 0 or 1.
template <class Law>
struct NormalPart {
    using S = typename Law::value_type;
    using States = std::span<const S>;

    const Law& law;

    [[nodiscard]] static constexpr int states() noexcept {
        if constexpr (HasNormalStates<Law>) {
            return Law::states;
        } else {
            return 0;
        }
    }

    /// How many of them change while an impact lasts: all or none.
    [[nodiscard]] static constexpr int moving_states() noexcept {
        if constexpr (requires(const Law l, const S& s, States x, std::span<S> out) { l.rates(s, s, x, out); }) {
            return states();
        } else {
            return 0;
        }
    }

    [[nodiscard, gnu::always_inline]] NormalForce<S> force(int over, const S& s, const S& z_rate,
                                                           States x) const noexcept {
        return over == 0 ? force_over<0>(s, z_rate, x) : force_over<1>(s, z_rate, x);
    }
    [[nodiscard, gnu::always_inline]] S load(const S& s, const S& z_rate, States x) const noexcept {
        if constexpr (HasNormalStates<Law>) {
            return law.load(s, z_rate, x);
        } else {
            return law.load(s, z_rate);
        }
    }
    [[nodiscard]] S stored_energy(const S& s, States x) const noexcept {
        if constexpr (HasNormalStates<Law>) {
            return law.stored_energy(s, x);
        } else {
            return law.stored_energy(s);
        }
    }
    void rates([[maybe_unused]] const S& s, [[maybe_unused]] const S& z_rate, [[maybe_unused]] States x,
               std::span<S> out) const noexcept {
        if constexpr (requires { law.rates(s, z_rate, x, out); }) {
            law.rates(s, z_rate, x, out);
        } else {
            for (S& rate : out) rate = S(0);
        }
    }
    void land([[maybe_unused]] const S& z_rate, [[maybe_unused]] std::span<S> x) const noexcept {
        if constexpr (HasNormalStates<Law>) law.land(z_rate, x);
    }
    [[nodiscard]] double state_size([[maybe_unused]] int i, [[maybe_unused]] const S& s) const noexcept {
        if constexpr (requires { law.state_size(i, s); }) {
            return law.state_size(i, s);
        } else if constexpr (HasNormalStates<Law>) {
            return law.state_size(i);
        } else {
            return 1;
        }
    }

private:
    template <int Over>
    [[nodiscard, gnu::always_inline]] NormalForce<S> force_over(const S& s, const S& z_rate, States x) const noexcept {
        if constexpr (HasNormalStates<Law>) {
            return law.template force<Over>(s, z_rate, x);
        } else {
            return law.template force<Over>(s, z_rate);
        }
    }
};

}  // namespace footfall
