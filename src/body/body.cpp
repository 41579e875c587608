#include "footfall/body/body.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <fmt/core.h>

#include "footfall/math/error.hpp"

namespace footfall {

namespace {

void check_inertia(const Eigen::Matrix3d& inertia) {
    if (!inertia.allFinite()) throw InvalidInput("body: inertia has an entry that is not finite");
    const double size = inertia.cwiseAbs().maxCoeff();
    if (!inertia.isApprox(inertia.transpose(), 1e-12))
        throw InvalidInput("body: inertia is not symmetric; an inertia tensor is");
    const Eigen::Vector3d moments =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
    if (!(moments.minCoeff() > 0))
        throw InvalidInput(fmt::format("body: inertia has the principal moments {}, {}, {} kg m^2; each must be > 0",
                                       moments[0], moments[1], moments[2]));
    // The moments are in increasing order. Flat bodies reach equality, rounding takes them a little past it.
    if (moments[2] > moments[0] + moments[1] + 1e-12 * size)
        throw InvalidInput(
            fmt::format("body: inertia has the principal moments {}, {}, {} kg m^2; no body has one larger than the "
                        "sum of the others",
                        moments[0], moments[1], moments[2]));
}

}  // namespace

void check(const Body& body) {
    if (!(body.mass > 0) || !std::isfinite(body.mass))
        throw InvalidInput(fmt::format("body: mass is {} kg; it must be > 0 and finite", body.mass));
    check_inertia(body.inertia);
    if (body.spheres.empty()) throw InvalidInput("body: it has no sphere; it needs at least one to touch the ground");
    for (std::size_t i = 0; i < body.spheres.size(); ++i) {
        const Sphere& s = body.spheres[i];
        if (!(s.radius > 0) || !std::isfinite(s.radius))
            throw InvalidInput(fmt::format("body: sphere {}: radius is {} m; it must be > 0 and finite", i, s.radius));
        if (!s.center.allFinite()) throw InvalidInput(fmt::format("body: sphere {}: center is not finite", i));
    }
}

void check(const Ground& ground) {
    if (!ground.normal.allFinite() || std::abs(ground.normal.norm() - 1) > 1e-12)
        throw InvalidInput(fmt::format("ground: normal has length {}; it must be a unit vector", ground.normal.norm()));
    if (!std::isfinite(ground.height)) throw InvalidInput("ground: height is not finite");
}

}  // namespace footfall
