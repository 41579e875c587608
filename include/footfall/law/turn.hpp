// What a frame that turns does to the states of friction: those that are vectors of the contact's plane keep still in
// the plane, so that their components turn against the frame. Nothing is stored or taken by it.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "footfall/law/erased.hpp"
#include "footfall/law/friction/friction_part.hpp"
#include "footfall/math/vector.hpp"

namespace footfall {

/// How many vectors of the plane the states of a friction law begin with; what follows are plain numbers. A law of
/// which not all states are vectors says how many are, by a member of this name.
template <class Law>
inline constexpr int vector_states = [] {
    if constexpr (requires { Law::vector_states; }) {
        return Law::vector_states;
    } else {
        static_assert(FrictionPart<Law>::states() % 2 == 0, "vector_states is missing");
        return FrictionPart<Law>::states() / 2;
    }
}();

/// The states of a friction law, or of a variant of laws, in a frame that has turned by an angle about the normal
/// [rad].
template <class Law, class S>
void turn_frame(const Law& friction, const S& angle, std::span<S> x) noexcept {
    using std::cos, std::sin;
    const S c = cos(angle), s = sin(angle);
    with_law(friction, [&]<class Known>(const Known&) {
        for (int k = 0; k < vector_states<Known>; ++k) {
            const auto at = 2 * static_cast<std::size_t>(k);
            const Vector2<S> u = vector_at<S>(x, at);
            put_vector(x, at, Vector2<S>(c * u.x() + s * u.y(), c * u.y() - s * u.x()));
        }
    });
}

/// Whether a friction law, or that in a variant of laws, asks for spin, rolling and radius, and may give torques.
template <class Law>
[[nodiscard]] bool sees_turning(const Law& friction) noexcept {
    return with_law(friction, []<class Known>(const Known&) { return CoupledFriction<Known>; });
}

}  // namespace footfall
