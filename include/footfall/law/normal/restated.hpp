// A normal law that is another one in parameters of its own. Its file has the parameters and says which law they make;
// the force, where its sign changes and the energy are computed there, and not a second time.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "footfall/law/normal/normal_force.hpp"

namespace footfall {

/// `Parameters` with the members of a normal law. `Parameters::restated()` is the same law as one that has them.
template <class Parameters>
struct RestatedNormal : Parameters {
    using S = typename Parameters::value_type;

    /// f / s^Over before the clamp, s = sqrt(z).
    template <int Over = 0>
    [[nodiscard]] constexpr NormalForce<S> force(const S& s, const S& z_rate) const noexcept {
        return this->restated().template force<Over>(s, z_rate);
    }

    /// The unclamped force over its leading power of s.
    [[nodiscard]] constexpr S load(const S& s, const S& z_rate) const noexcept {
        return this->restated().load(s, z_rate);
    }

    /// Energy in the normal spring [J].
    [[nodiscard]] constexpr S stored_energy(const S& s) const noexcept { return this->restated().stored_energy(s); }

    // The same with states of the contact, where the parameters that are restated follow from them.
    template <int Over = 0>
    [[nodiscard]] constexpr NormalForce<S> force(const S& s, const S& z_rate, std::span<const S> x) const noexcept
        requires requires { Parameters::states; }
    {
        return this->restated(x).template force<Over>(s, z_rate);
    }
    [[nodiscard]] constexpr S load(const S& s, const S& z_rate, std::span<const S> x) const noexcept
        requires requires { Parameters::states; }
    {
        return this->restated(x).load(s, z_rate);
    }
    [[nodiscard]] constexpr S stored_energy(const S& s, std::span<const S> x) const noexcept
        requires requires { Parameters::states; }
    {
        return this->restated(x).stored_energy(s);
    }
};

/// The law that computes the force of an impact that begins at `speed` [m/s]: the law itself, or the one that it
/// restates.
template <class Law, class S = typename Law::value_type>
[[nodiscard]] constexpr auto law_of_impact(const Law& law, [[maybe_unused]] const S& speed) noexcept {
    if constexpr (requires(Law begun) {
                      begun.land(speed, std::span<S>());
                      law.restated(std::span<const S>());
                  }) {
        std::array<S, static_cast<std::size_t>(Law::states)> states{};
        law.land(speed, std::span<S>(states));
        return law.restated(std::span<const S>(states));
    } else if constexpr (requires { law.restated(); }) {
        return law.restated();
    } else {
        return law;
    }
}

}  // namespace footfall
