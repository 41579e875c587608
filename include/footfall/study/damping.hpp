// The inverse of restitution: the damping with which a law has a given restitution at a given speed.
#pragma once

#include <optional>
#include <string_view>

#include "footfall/law/registry.hpp"
#include "footfall/math/error.hpp"
#include "footfall/study/restitution.hpp"

namespace footfall {

/// The key of the law's damping parameter: the one without which the law dissipates nothing. Empty where there is none
/// (an elastic law, or one that takes the restitution itself).
[[nodiscard]] std::optional<std::string_view> damping_key(const NormalLaw& law);

/// `law` with the damping at which a sphere of `mass` [kg] that comes in at `speed` [m/s] leaves with `restitution`
/// times that speed, 0 < restitution <= 1, without gravity. The damping that `law` has plays no part.
/// Throws InvalidInput where the law has no damping parameter, or where none of its values gives that restitution,
/// saying which ones can be reached.
[[nodiscard]] NormalLaw with_restitution(const NormalLaw& law, double mass, double speed, double restitution,
                                         double tolerance = 1e-12);

}  // namespace footfall
