// A scenario and a run written by hand, every number different, for the tests of the outputs.
#pragma once

#include <vector>

#include "footfall/io/output.hpp"

namespace footfall::test {

/// 1, 2, 3, ... over a third: no two numbers of a run are the same, and none is a short decimal.
class Numbers {
public:
    double operator()() { return ++last_ / 3.0; }
    Eigen::Vector3d vector() {
        const double x = (*this)(), y = (*this)(), z = (*this)();
        return {x, y, z};
    }

private:
    int last_ = 0;
};

inline ContactEnergy some_energy(Numbers& next) {
    ContactEnergy energy;
    energy.normal_spring = next();
    energy.tangential_spring = next();
    energy.normal_damper = next();
    energy.tangential_damper = next();
    energy.clutch = next();
    energy.stiffness_change = -next();
    return energy;
}

inline Snapshot some_snapshot(Numbers& next, double time, std::vector<Phase> phases) {
    Snapshot snapshot;
    snapshot.time = time;
    snapshot.body.position = next.vector();
    snapshot.body.velocity = next.vector();
    snapshot.body.orientation = Eigen::Quaterniond(next(), next(), next(), next());
    snapshot.body.angular_velocity = next.vector();
    snapshot.ledger.kinetic = next();
    snapshot.ledger.potential = next();
    for (const Phase phase : phases) {
        ContactSnapshot contact;
        contact.phase = phase;
        contact.depth = next();
        contact.depth_rate = next();
        contact.normal_force = next();
        contact.friction_force = next.vector();
        contact.slip_velocity = next.vector();
        contact.bristle = next.vector();
        contact.energy = some_energy(next);
        snapshot.ledger.contact += contact.energy;
        snapshot.contacts.push_back(contact);
    }
    return snapshot;
}

/// Two spheres of different radius; friction parameters differ.
inline Scenario two_sphere_scenario() {
    Scenario scenario;
    scenario.title = "Two spheres, a title with µ in it";
    scenario.text = "title = \"Two spheres\"  # \"quoted\"\n[time]\nend = 0.3\n";
    Simulation& simulation = scenario.simulation;
    simulation.body.mass = 0.154;
    simulation.body.inertia = solid_sphere_inertia(0.154, 0.0165);
    simulation.body.spheres = {{{0.01, 0, -0.02}, 0.0165}, {{-0.03, 0.04, -0.02}, 0.02}};
    simulation.initial.velocity = {0.5, 0.5, 0};
    const AzadFeatherstoneNormal<> normal{8.5e6, 3.1e3};
    simulation.contacts = {{normal, AzadFeatherstoneFriction<>{{12.75e6, 3.1e3, 0.2, 0.1}}},
                           {normal, AzadFeatherstoneFriction<>{{11e6, 3.2e3, 0.3, 0.05}}}};
    simulation.options.end_time = 0.3;
    simulation.options.sample_period = 0.1;
    simulation.options.tolerance = 1e-11;
    return scenario;
}

/// Four samples, three events, two impacts: one over, one that lasts at the end.
inline Run two_sphere_run() {
    Numbers next;
    Run run;
    run.initial = some_snapshot(next, 0, {Phase::flight, Phase::flight});
    run.samples = {run.initial, some_snapshot(next, 0.1, {Phase::stick, Phase::flight}),
                   some_snapshot(next, 0.2, {Phase::recovering, Phase::slip}),
                   some_snapshot(next, 0.3, {Phase::flight, Phase::stick})};
    run.final = run.samples.back();
    run.events = {{0.05, EventKind::touchdown, 0, some_snapshot(next, 0.05, {Phase::stick, Phase::flight})},
                  {0.06, EventKind::touchdown, 1, some_snapshot(next, 0.06, {Phase::stick, Phase::slip})},
                  {0.21, EventKind::recovered, 0, some_snapshot(next, 0.21, {Phase::flight, Phase::slip})}};
    Impact over;
    over.sphere = 0;
    over.touchdown = 0.05;
    over.separation = 0.2 - 1e-3 / 3;
    over.recovered = 0.21;
    over.speed_in = 2;
    over.speed_out = 1.25;
    over.peak_normal_force = 100.0 / 3;
    over.peak_indentation = 1e-4 / 3;
    over.stick_time = 2e-4 / 3;
    Impact lasting;
    lasting.sphere = 1;
    lasting.touchdown = 0.06;
    lasting.speed_in = 1.0 / 3;
    lasting.peak_normal_force = 7;
    lasting.peak_indentation = 1e-5;
    run.impacts = {over, lasting};
    run.max_residual = 1e-13 / 3;
    run.energy_scale = 400;
    run.cost = {.steps = 1234, .rejected = 5, .evaluations = 5'000'000'000, .stiff_steps = 17, .wall_seconds = 0.0125};
    return run;
}

/// A run of which nothing but the start is known: no events, no impacts.
inline Run uneventful_run() {
    Numbers next;
    Run run;
    run.initial = some_snapshot(next, 0, {Phase::flight, Phase::flight});
    run.final = run.initial;
    run.samples = {run.initial};
    run.energy_scale = 1;
    return run;
}

}  // namespace footfall::test
