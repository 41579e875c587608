// A normal law by itself, at given depths: its force and what its spring holds.
#pragma once

#include <array>
#include <span>

#include "footfall/law/registry.hpp"

namespace footfall::study {

template <class S>
class LawAlone {
public:
    /// With states of zero.
    explicit LawAlone(const NormalLawOver<S>& law) : law_(law, {}) {}
    /// With the states that it has of an impact that began at a speed [m/s].
    LawAlone(const NormalLawOver<S>& law, const S& speed) : LawAlone(law) {
        law_.land(at(S(0), speed), std::span(states_));
    }

    /// At a depth [m], > 0, and its rate [m/s].
    [[nodiscard]] NormalForce<S> force(const S& depth, const S& rate) const {
        return law_.normal_parts(at(depth, rate), states_);
    }
    /// At a depth [m], in J.
    [[nodiscard]] S stored_energy(const S& depth) const {
        return law_.held({Phase::slip}, at(depth, S(0)), states_).normal_spring;
    }

private:
    [[nodiscard]] static Touch<S> at(const S& depth, const S& rate) {
        return {root_of_depth(depth), rate, Vector2<S>::Zero()};
    }

    Pair<NormalLawOver<S>, NoFriction<S>> law_;
    std::array<S, most_normal_states> states_{};
};

}  // namespace footfall::study
