// What a run gives back.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "footfall/body/body.hpp"
#include "footfall/energy/ledger.hpp"
#include "footfall/law/mode.hpp"
#include "footfall/simulate/simulation.hpp"

namespace footfall {

/// One contact at one moment. Vectors are in the world's frame.
struct ContactSnapshot {
    Phase phase = Phase::flight;
    double depth = 0;         ///< z [m], > 0 indentation; negative in flight: minus the gap
    double depth_rate = 0;    ///< zdot [m/s], > 0 loading
    double normal_force = 0;  ///< F_n [N], >= 0, along the ground's normal
    Eigen::Vector3d friction_force = Eigen::Vector3d::Zero();  ///< F_f [N], in the ground's plane, on the body
    Eigen::Vector3d slip_velocity = Eigen::Vector3d::Zero();   ///< V_sph [m/s], of the sphere's bottom point
    Eigen::Vector3d bristle = Eigen::Vector3d::Zero();         ///< u [m], in the ground's plane
    ContactEnergy energy;
};

/// Everything at one moment.
struct Snapshot {
    double time = 0;  ///< [s]
    BodyState body;
    std::vector<ContactSnapshot> contacts;  ///< one for each sphere
    Ledger ledger;
};

struct Event {
    double time = 0;  ///< [s]
    EventKind kind = EventKind::touchdown;
    int sphere = 0;  ///< index into Body::spheres
    Snapshot state;  ///< at that time, in the phase that the event begins
};

/// One visit of a sphere to the ground. What has not happened by the end of the run is empty.
struct Impact {
    int sphere = 0;
    double touchdown = 0;              ///< [s]
    std::optional<double> separation;  ///< last time that F_n reached 0 before `recovered` [s]
    std::optional<double> recovered;   ///< [s]
    double speed_in = 0;               ///< zdot at touchdown [m/s]
    std::optional<double> speed_out;   ///< -zdot at `recovered` [m/s]
    double peak_normal_force = 0;      ///< [N], so far
    double peak_indentation = 0;       ///< [m], so far
    double stick_time = 0;             ///< time spent in Phase::stick [s]

    /// speed_out / speed_in; empty where either is missing or the sphere started on the ground.
    [[nodiscard]] std::optional<double> restitution() const noexcept {
        if (!speed_out || !(speed_in > 0)) return std::nullopt;
        return *speed_out / speed_in;
    }
};

/// What a run cost, all its attempts together.
struct Cost {
    std::int64_t steps = 0;        ///< accepted
    std::int64_t rejected = 0;     ///< rejected for their error
    std::int64_t evaluations = 0;  ///< of the equations of motion, those for Jacobians included
    std::int64_t stiff_steps = 0;  ///< those of `steps` that the implicit method took
    double wall_seconds = 0;

    Cost& operator+=(const Cost& other) noexcept {
        steps += other.steps;
        rejected += other.rejected;
        evaluations += other.evaluations;
        stiff_steps += other.stiff_steps;
        wall_seconds += other.wall_seconds;
        return *this;
    }
};

struct Run {
    std::vector<Snapshot> samples;  ///< every sample_period from 0, and at the end
    std::vector<Event> events;      ///< in order of time
    std::vector<Impact> impacts;    ///< in order of touchdown
    Snapshot initial;
    Snapshot final;
    double max_residual = 0;  ///< largest |total - initial total| over all steps, relative to `energy_scale`
    double energy_scale = 0;  ///< largest Ledger::magnitude seen [J]
    Cost cost;

    /// (total - initial total) / energy_scale at the end.
    [[nodiscard]] double residual() const noexcept {
        return energy_scale > 0 ? (final.ledger.total() - initial.ledger.total()) / energy_scale : 0;
    }
};

/// The run would need, or has needed, more evaluations or memory than RunOptions::max_evaluations or max_memory allows.
class TooExpensive : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// RunOptions::progress asked for the end.
class Interrupted : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// How deep a sphere starts in the ground [m]; negative above it.
[[nodiscard]] double initial_depth(const Simulation& simulation, std::size_t sphere);
/// Depths up to this are rounding of the positions given: the sphere starts on the ground [m].
[[nodiscard]] double initial_depth_rounding(const Simulation& simulation);

/// Throws InvalidInput unless every field of the simulation can be used.
void check(const Simulation& simulation);

/// Runs a simulation. Throws InvalidInput (before the run), TooExpensive, Interrupted.
[[nodiscard]] Run run(const Simulation& simulation);

}  // namespace footfall
