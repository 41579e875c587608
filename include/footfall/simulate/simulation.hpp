// What a run needs to know: a body, the ground, the laws, where it starts, how long and how exactly.
#pragma once

#include <functional>
#include <vector>

#include "footfall/body/body.hpp"
#include "footfall/law/registry.hpp"

namespace footfall {

/// How exact and how long a run is, and what it records.
struct RunOptions {
    double end_time = 1;                     ///< [s], > 0
    double sample_period = 0;                ///< [s], > 0; 0 records no samples but the first and the last
    double tolerance = 1e-10;                ///< relative error of a step, from 1e-14 to 1e-3
    bool allow_initial_penetration = false;  ///< spheres may start in the ground, their springs loaded
    /// A run that would need more evaluations of the equations of motion is refused before it starts where
    /// the estimate says so, and stopped with an error where only the run itself shows it.
    double max_evaluations = 1e8;
    /// What a run may keep in memory [bytes], >= 1: its samples and its events, each with every sphere's contact, and
    /// what the implicit method works on. Checked likewise.
    double max_memory = 4e9;
    /// Called now and then with the time reached [s]; returning false ends the run with Interrupted.
    std::function<bool(double)> progress;
};

/// One body over one ground. Every field is in SI units.
struct Simulation {
    Body body;
    Ground ground;
    Eigen::Vector3d gravity{0, 0, -9.81};  ///< [m/s^2], world
    BodyState initial;
    /// One for each sphere of the body, in its order; they may be under different laws.
    std::vector<ContactParameters> contacts;
    RunOptions options;
};

}  // namespace footfall
