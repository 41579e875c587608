// Simulations that the tests start from, and how they look at what comes back.
#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "footfall/simulate/run.hpp"

namespace footfall::test {

/// The ball of Azad & Featherstone 2010, sections 2.2 and 4.
inline constexpr double ball_mass = 0.154;     // kg
inline constexpr double ball_radius = 0.0165;  // m
inline constexpr double gravity = 9.81;        // m/s^2

inline AzadFeatherstoneNormal<> paper_normal() { return {8.5e6, 3.1e3}; }
inline AzadFeatherstoneFriction<> paper_friction() { return {{12.75e6, 3.1e3, 0.2, 0.1}}; }

/// The paper's ball with its bottom `gap` above the ground z = 0 [m].
inline Simulation paper_ball(double gap, double end_time, double tolerance = 1e-12) {
    Simulation s;
    s.body.mass = ball_mass;
    s.body.inertia = solid_sphere_inertia(ball_mass, ball_radius);
    s.body.spheres = {{.radius = ball_radius}};
    s.initial.position = {0, 0, ball_radius + gap};
    s.contacts = {{paper_normal(), paper_friction()}};
    s.options.end_time = end_time;
    s.options.tolerance = tolerance;
    return s;
}

/// A foot on four spheres at the corners of 20 cm by 8 cm, flat, with its soles `gap` above the ground z = 0 [m].
/// Spheres 0 and 1 are the heel, at -x; 0 and 2 are on the left, at +y.
inline Simulation foot(double gap, double end_time, double tolerance = 1e-12) {
    Simulation s;
    s.body.mass = 1.2;
    s.body.inertia = Eigen::Vector3d(1.6e-3, 5.6e-3, 6.5e-3).asDiagonal();
    for (const double x : {-0.1, 0.1})
        for (const double y : {0.04, -0.04}) s.body.spheres.push_back({.center = {x, y, -0.03}, .radius = 0.015});
    s.initial.position = {0, 0, 0.045 + gap};
    s.contacts.assign(4, {AzadFeatherstoneNormal<>{2e6, 4e3}, AzadFeatherstoneFriction<>{{3e6, 4e3, 0.5, 0.1}}});
    s.options.end_time = end_time;
    s.options.tolerance = tolerance;
    return s;
}

/// The foot with its toes up and sideways speed: heel, then toe.
inline Simulation heel_first(double end_time, double tolerance = 1e-12) {
    Simulation s = foot(0.04, end_time, tolerance);
    s.initial.orientation =
        Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(0.03, Eigen::Vector3d::UnitX());
    s.initial.velocity = {0.3, 0.15, -0.4};
    s.initial.angular_velocity = {0.2, 0.5, -0.3};
    return s;
}

/// How many events of a kind there are.
inline std::size_t count(const Run& run, EventKind kind) {
    std::size_t n = 0;
    for (const Event& event : run.events) n += event.kind == kind ? 1u : 0u;
    return n;
}

/// The first event of a kind, if any.
inline const Event* first(const Run& run, EventKind kind, int sphere = 0) {
    for (const Event& event : run.events)
        if (event.kind == kind && event.sphere == sphere) return &event;
    return nullptr;
}

inline bool finite(const Snapshot& shot) {
    return shot.body.position.allFinite() && shot.body.velocity.allFinite() && shot.body.angular_velocity.allFinite() &&
           shot.body.orientation.coeffs().allFinite() && std::isfinite(shot.ledger.total());
}

/// Angular momentum about the centre of mass, in the world's frame [kg m^2/s].
inline Eigen::Vector3d angular_momentum(const Body& body, const BodyState& state) {
    const Eigen::Matrix3d R = state.orientation.toRotationMatrix();
    return R * body.inertia * R.transpose() * state.angular_velocity;
}

/// The derivative in the middle of five values that are `period` apart, with an error of order period^4.
template <class F>
auto rate_at(const F& value, std::size_t i, double period) {
    using Value = std::remove_cvref_t<decltype(value(i))>;
    return Value(((value(i - 2) - value(i + 2)) + 8.0 * (value(i + 1) - value(i - 1))) / (12 * period));
}

/// Whether no event lies within some sample periods of sample i: after a touchdown the force rises as a root of time.
inline bool smooth_around(const Run& run, std::size_t i, double period) {
    if (i < 2 || i + 2 >= run.samples.size()) return false;
    for (const Event& event : run.events)
        if (std::abs(event.time - run.samples[i].time) < 30 * period) return false;
    return true;
}

}  // namespace footfall::test
