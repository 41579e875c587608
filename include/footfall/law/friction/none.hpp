// No friction: the ground is perfectly slippery.
#pragma once

#include <array>

#include "footfall/law/friction/spring_damper_clutch.hpp"

namespace footfall {

template <class S = double>
struct NoFriction {
    using value_type = S;
    static constexpr bool has_bristle = false;
    static constexpr int ScalePower = 0;

    template <class T>
    [[nodiscard]] constexpr NoFriction<T> cast() const noexcept {
        return {};
    }

    static constexpr LawDescription description{.name = "none",
                                                .formula = "F_f = 0",
                                                .source = "the frictionless limit",
                                                .limits = "no tangential force at all"};

    static constexpr auto parameters() noexcept { return std::array<Parameter<NoFriction>, 0>{}; }
};

}  // namespace footfall
