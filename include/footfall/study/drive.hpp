// What a rig measures: one contact along its paths, and every joule that goes in.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "footfall/energy/ledger.hpp"
#include "footfall/law/phase.hpp"
#include "footfall/law/registry.hpp"
#include "footfall/math/vector.hpp"
#include "footfall/simulate/run.hpp"
#include "footfall/study/rig.hpp"
#include "footfall/study/table.hpp"

namespace footfall {

/// The account of a rig [J]. What the drive has done is what the rest holds or has taken.
struct RigEnergy {
    ContactEnergy contact;
    double kinetic = 0;         ///< of the mass
    double holding_spring = 0;  ///< held by the spring to the support
    double holding_damper = 0;  ///< taken by the damper beside it
    double pressing_work = 0;   ///< done by the drive along the normal: the integral of F_n zdot dt
    double dragging_work = 0;   ///< done by the drive in the plane: on the contact, or on mass, support and belt

    // Over the contact and what holds the mass.
    [[nodiscard]] double held() const noexcept;
    [[nodiscard]] double taken() const noexcept;
    [[nodiscard]] double worked() const noexcept;
    /// What is held and has been taken, with P, less what the drive has done: constant.
    [[nodiscard]] double balance() const noexcept;
    /// The size of the account: its entries without their signs, summed.
    [[nodiscard]] double magnitude() const noexcept;
};

/// The rig's own entries, in the order of every output; they stand behind those of the contact.
inline constexpr std::array rig_channels{
    Channel<RigEnergy>{"kinetic", "", "J", "energy of the mass", ChannelKind::held, &RigEnergy::kinetic},
    Channel<RigEnergy>{"holding_spring", "", "J", "held by the spring to the support", ChannelKind::held,
                       &RigEnergy::holding_spring},
    Channel<RigEnergy>{"holding_damper", "", "J", "taken by the damper beside it", ChannelKind::taken,
                       &RigEnergy::holding_damper},
    Channel<RigEnergy>{"pressing_work", "", "J", "done by the drive along the normal", ChannelKind::worked,
                       &RigEnergy::pressing_work},
    Channel<RigEnergy>{"dragging_work", "", "J", "done by the drive in the plane", ChannelKind::worked,
                       &RigEnergy::dragging_work},
};

/// A driven contact at one moment; vectors are in the ground's plane.
struct RigState {
    double time = 0;  ///< [s]
    Phase phase = Phase::flight;
    double depth = 0;                         ///< z [m], > 0 indentation
    double depth_rate = 0;                    ///< zdot [m/s]
    double normal_force = 0;                  ///< F_n [N], >= 0
    Eigen::Vector2d friction_force{0, 0};     ///< F_f [N], on the body
    Eigen::Vector2d slip_displacement{0, 0};  ///< the integral of V_sph from the start [m]
    Eigen::Vector2d slip_velocity{0, 0};      ///< V_sph [m/s]
    Eigen::Vector2d bristle{0, 0};            ///< u, or what the friction law has in its place [m]
    Eigen::Vector2d position{0, 0};           ///< of the mass [m]; without one, zero
    Eigen::Vector2d velocity{0, 0};           ///< of the mass [m/s]
    Eigen::Vector2d holding_force{0, 0};      ///< of spring and damper on the mass [N]
    RigEnergy energy;
};

struct RigEvent {
    double time = 0;  ///< [s]
    EventKind kind = EventKind::touchdown;
    RigState state;  ///< in the phase that the event begins
};

/// How a mass on a belt goes on, from the later half of its run.
struct StickSlip {
    int cycles = 0;        ///< how many the numbers are means of
    double period = 0;     ///< between two greatest deflections of the spring [s]
    double amplitude = 0;  ///< half the way between the greatest and the least deflection [m]
    double greatest = 0;   ///< greatest deflection, against the way that the belt drags [m]
    double least = 0;      ///< least deflection [m]
    /// Share of the time in Phase::stick; under a law without that phase, in which the mass goes with the belt to
    /// within 1 % of its speed [1].
    double sticking = 0;
};

/// One run of a rig under one pair of laws.
struct Drive {
    std::vector<RigState> samples;  ///< at multiples of the sample period, the first and the last moment included
    std::vector<RigEvent> events;
    double largest_normal_force = 0;      ///< at any time, whatever the sample period [N]
    double largest_friction_force = 0;    ///< at any time, whatever the sample period [N]
    std::optional<StickSlip> stick_slip;  ///< where a mass swings against a moving belt or support
    double energy_scale = 0;              ///< the largest magnitude of the account [J]
    double max_residual = 0;              ///< the largest |balance - initial balance| / energy_scale after a step
    Cost cost;
};

/// Drives one contact along the rig's paths. Under a normal law whose damping depends on the speed of impact, that is
/// zdot where z rises through 0. Throws InvalidInput, TooExpensive, Interrupted.
[[nodiscard]] Drive drive(const Rig& rig, const ContactParameters& laws);

/// A run with the name that its columns get.
struct NamedDrive {
    std::string name;
    Drive drive;
};

/// The samples of runs of one rig, side by side: shared columns once, those of each run with its name as their series.
[[nodiscard]] Table drive_table(const Rig& rig, const std::vector<NamedDrive>& runs);

}  // namespace footfall
