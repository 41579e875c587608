// The oracle's ball as the library's simulation. The one place where the two meet, so that the oracles themselves share
// nothing with the library.
#pragma once

#include "footfall/simulate/run.hpp"
#include "paper_sphere.hpp"

namespace oracle {

/// The run of `ball` from `start` to the time `end` [s], by the library.
inline footfall::Simulation simulation_of(const Ball<double>& ball, const State<double>& start, double end,
                                          double tolerance) {
    footfall::Simulation simulation;
    simulation.body.mass = ball.m;
    simulation.body.inertia = footfall::solid_sphere_inertia(ball.m, ball.r);
    simulation.body.spheres = {{.radius = ball.r}};
    simulation.gravity = {0, 0, -ball.g};
    simulation.initial.position = {start[cx], start[cy], start[cz]};
    simulation.initial.velocity = {start[vx], start[vy], start[vz]};
    simulation.initial.angular_velocity = {start[wx], start[wy], start[wz]};
    simulation.contacts = {{footfall::AzadFeatherstoneNormal<>{ball.K_n, ball.D_n},
                            footfall::AzadFeatherstoneFriction<>{{ball.K_t, ball.D_t, ball.mu, ball.C_V}}}};
    simulation.options.end_time = end;
    simulation.options.tolerance = tolerance;
    return simulation;
}

}  // namespace oracle
