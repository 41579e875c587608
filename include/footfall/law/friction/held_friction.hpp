// A friction law while depth, load and slip velocity are held: how its states go on, and what that takes.
#pragma once

#include <algorithm>
#include <limits>
#include <span>

#include "footfall/law/friction/friction_part.hpp"
#include "footfall/law/phase.hpp"
#include "footfall/math/vector.hpp"

namespace footfall {

/// What a contact does over one time step.
struct ContactStep {
    Phase phase = Phase::flight;                                    ///< at the end of the step
    double normal_force = 0;                                        ///< F_n [N], >= 0, held over the step
    Vector2<double> mean_friction_force = Vector2<double>::Zero();  ///< F_f, its mean over the step [N]
    double tangential_damper = 0;                                   ///< taken by the damper over the step [J]
    double clutch = 0;                                              ///< taken by the clutch over the step [J]
    double left = 0;  ///< time that the step has not covered [s]: > 0 where it took too many sub-steps

    /// What follows from something that is not a number; the states become that too.
    [[nodiscard]] static ContactStep nothing(std::span<double> x) noexcept {
        constexpr double nan = std::numeric_limits<double>::quiet_NaN();
        std::fill(x.begin(), x.end(), nan);
        return {Phase::flight, nan, {nan, nan}, nan, nan};
    }
};

/// One friction law over double, held:
///   HeldFriction(law, tolerance)
///   advance(load, touch, dt, x, step)   from step.phase: advances the states x and the phase, and books what is taken
template <class Law>
class HeldFriction;

template <>
class HeldFriction<NoFriction<>> {
public:
    HeldFriction(const NoFriction<>& /*law*/, double /*tolerance*/) noexcept {}

    void advance(const Load<double>& /*load*/, const Touch<double>& /*touch*/, double /*dt*/, std::span<double> /*x*/,
                 ContactStep& /*step*/) const noexcept {}
};

}  // namespace footfall
