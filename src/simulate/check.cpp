#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "footfall/simulate/run.hpp"
#include "footfall/surface/plane.hpp"

namespace footfall {

namespace {

void check(const RunOptions& o) {
    if (!(o.end_time > 0) || !std::isfinite(o.end_time))
        throw InvalidInput(fmt::format("options: end_time is {} s; it must be > 0 and finite", o.end_time));
    if (!(o.sample_period >= 0) || !std::isfinite(o.sample_period))
        throw InvalidInput(fmt::format("options: sample_period is {} s; it must be >= 0 and finite", o.sample_period));
    if (!(o.tolerance >= 1e-14 && o.tolerance <= 1e-3))
        throw InvalidInput(fmt::format("options: tolerance is {}; it must be from 1e-14 to 1e-3", o.tolerance));
    if (!(o.max_evaluations >= 1))
        throw InvalidInput(fmt::format("options: max_evaluations is {}; it must be >= 1", o.max_evaluations));
    if (!(o.max_memory >= 1))
        throw InvalidInput(fmt::format("options: max_memory is {} bytes; it must be >= 1", o.max_memory));
}

void check(const BodyState& b) {
    if (!b.position.allFinite()) throw InvalidInput("initial: position is not finite");
    if (!b.velocity.allFinite()) throw InvalidInput("initial: velocity is not finite");
    if (!b.angular_velocity.allFinite()) throw InvalidInput("initial: angular_velocity is not finite");
    if (!b.orientation.coeffs().allFinite() || std::abs(b.orientation.norm() - 1) > 1e-12)
        throw InvalidInput(
            fmt::format("initial: orientation has length {}; it must be a unit quaternion", b.orientation.norm()));
}

void check_contacts(const Simulation& s) {
    if (s.contacts.size() != s.body.spheres.size())
        throw InvalidInput(fmt::format("contacts: there are {} for {} spheres; each sphere needs one",
                                       s.contacts.size(), s.body.spheres.size()));
    for (std::size_t i = 0; i < s.contacts.size(); ++i) {
        const ContactParameters& c = s.contacts[i];
        check(c, fmt::format("sphere {}", i));
    }
}

void check_penetration(const Simulation& s) {
    if (s.options.allow_initial_penetration) return;
    for (std::size_t i = 0; i < s.body.spheres.size(); ++i) {
        const Sphere& sphere = s.body.spheres[i];
        const double depth = initial_depth(s, i);
        if (depth > initial_depth_rounding(s))
            throw InvalidInput(fmt::format(
                "initial: sphere {} (radius {} m) starts {} m inside the ground; raise the body, or allow it with "
                "allow_initial_penetration, and the spring starts loaded",
                i, sphere.radius, depth));
    }
}

}  // namespace

double initial_depth(const Simulation& s, std::size_t sphere) {
    const Sphere& p = s.body.spheres[sphere];
    const Eigen::Vector3d center = s.initial.position + s.initial.orientation * p.center;
    return depth_in_plane(s.ground.normal.dot(center), p.radius, s.ground.height);
}

double initial_depth_rounding(const Simulation& s) {
    double extent = s.initial.position.norm() + std::abs(s.ground.height);
    for (const Sphere& p : s.body.spheres) extent = std::max(extent, p.center.norm() + p.radius);
    return 64 * std::numeric_limits<double>::epsilon() * extent;
}

void check(const Simulation& simulation) {
    check(simulation.body);
    check(simulation.ground);
    if (!simulation.gravity.allFinite()) throw InvalidInput("gravity is not finite");
    check(simulation.initial);
    check(simulation.options);
    check_contacts(simulation);
    check_penetration(simulation);
}

}  // namespace footfall
