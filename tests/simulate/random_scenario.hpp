// Random valid scenarios, and what must be true of each of their runs.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>

#include <fmt/core.h>

#include "footfall/simulate/run.hpp"

namespace footfall::soak {

/// Draws a scenario: sizes, masses, speeds and parameters over many decades, laws of every kind, one to six spheres,
/// slopes, spins, starts in the air, on the ground and in it. Stiffness and damping are drawn relative to the impact
/// they meet, so that every regime from elastic to creeping is visited at every scale.
class RandomScenario {
public:
    explicit RandomScenario(std::uint64_t seed) : random_(seed) {}

    Simulation draw() {
        radius_ = decades(-3, 0);
        speed_ = decades(-2, 1);
        const int spheres = chance(0.4) ? 1 : static_cast<int>(uniform(2, 7));
        Simulation s;
        draw_ground(s);
        draw_body(s, spheres);
        depth_ = radius_ * decades(-5, -1.3);
        period_ = depth_ / speed_;
        const int normal = static_cast<int>(uniform(0, 3)), friction = static_cast<int>(uniform(0, 3));
        draw_exponents();
        for (int i = 0; i < spheres; ++i) s.contacts.push_back({draw_normal(normal), draw_friction(friction)});
        draw_start(s);
        s.options.tolerance = 1e-10;
        s.options.sample_period = s.options.end_time / 64;
        s.options.max_evaluations = 2e7;
        return s;
    }

private:
    double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    double decades(double low, double high) { return std::pow(10.0, uniform(low, high)); }
    bool chance(double p) { return uniform(0, 1) < p; }
    Eigen::Vector3d direction() {
        std::normal_distribution<double> n;
        return Eigen::Vector3d(n(random_), n(random_), n(random_)).normalized();
    }

    void draw_ground(Simulation& s) {
        if (chance(0.5)) {
            const double slope = uniform(0, std::numbers::pi / 3), around = uniform(0, 2 * std::numbers::pi);
            s.ground.normal =
                Eigen::Vector3d(std::sin(slope) * std::cos(around), std::sin(slope) * std::sin(around), std::cos(slope))
                    .normalized();
        }
        if (chance(0.5)) s.ground.height = uniform(-1, 1);
        s.gravity = chance(0.1) ? Eigen::Vector3d::Zero() : Eigen::Vector3d(0, 0, -9.81 * decades(-1, 1));
    }

    void draw_body(Simulation& s, int spheres) {
        mass_ = decades(2, 4.3) * 4.0 / 3.0 * std::numbers::pi * std::pow(radius_, 3) * spheres;
        s.body.mass = mass_;
        const bool ball = spheres == 1 && chance(0.7);
        double extent = radius_;
        for (int i = 0; i < spheres; ++i) {
            Sphere sphere;
            sphere.radius = radius_ * (chance(0.5) ? 1.0 : uniform(0.5, 2));
            if (!ball) sphere.center = direction() * radius_ * uniform(0.1, 8);
            extent = std::max(extent, sphere.center.norm() + sphere.radius);
            s.body.spheres.push_back(sphere);
        }
        if (spheres == 4 && chance(0.5)) {  // a flat foot: its spheres land together
            const double a = radius_ * uniform(1, 6), b = radius_ * uniform(1, 6);
            for (int i = 0; i < 4; ++i)
                s.body.spheres[static_cast<std::size_t>(i)] = {{i & 1 ? a : -a, i & 2 ? b : -b, 0}, radius_};
            flat_ = true;
        }
        if (ball) {
            s.body.inertia = solid_sphere_inertia(mass_, radius_);
            return;
        }
        // Moments of a distribution of mass with these variances along its axes: always those of a body.
        const Eigen::Vector3d variance =
            Eigen::Vector3d(uniform(0.05, 1), uniform(0.05, 1), uniform(0.05, 1)) * mass_ * extent * extent * 0.2;
        const Eigen::Vector3d moments(variance[1] + variance[2], variance[0] + variance[2], variance[0] + variance[1]);
        const Eigen::Matrix3d R =
            Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), direction()).toRotationMatrix();
        s.body.inertia = R * moments.asDiagonal() * R.transpose();
        s.body.inertia = (0.5 * (s.body.inertia + s.body.inertia.transpose())).eval();
    }

    void draw_exponents() {
        general_ = chance(0.3);
        n_ = uniform(1, 2.5);
        p_ = uniform(0.5, 2.5);
        q_ = chance(0.7) ? 1.0 : uniform(1, 2);
    }

    NormalLaw draw_normal(int kind) {
        const double energy = mass_ * speed_ * speed_;
        const double loss = chance(0.1) ? 0.0 : decades(-4, 1.5);
        switch (kind) {
            case 0: {
                const double K = 1.25 * energy / std::pow(depth_, 2.5);
                return AzadFeatherstoneNormal<>{K, loss * K * period_};
            }
            case 1: {
                HuntCrossleyNormal<> law;
                if (general_) law.n = n_, law.p = p_, law.q = q_;
                law.stiffness = 0.5 * (law.n + 1) * energy / std::pow(depth_, law.n + 1);
                law.damping = loss * law.stiffness * std::pow(depth_, law.n - law.p) / std::pow(speed_, law.q);
                return law;
            }
            default: {
                const double k = energy / (depth_ * depth_);
                return LinearNormal<>{k, loss * k * period_};
            }
        }
    }

    FrictionLaw draw_friction(int kind) {
        const double k = mass_ * speed_ * speed_ / (depth_ * depth_) * decades(-1.5, 1.5);
        const double damping = chance(0.1) ? 0.0 : decades(-3, 1.5) * period_;
        const double mu = chance(0.1) ? 0.0 : decades(-2, 0.5);
        const double viscous = chance(0.4) ? 0.0 : mass_ / period_ * decades(-5, 1);
        switch (kind) {
            case 0:
                return NoFriction<>{};
            case 1: {
                const double K = k / std::sqrt(depth_);
                return AzadFeatherstoneFriction<>{{K, K * damping, mu, viscous}};
            }
            default:
                return LinearFriction<>{{k, k * damping, mu, viscous}};
        }
    }

    void draw_start(Simulation& s) {
        const Eigen::Vector3d& n = s.ground.normal;
        s.initial.orientation = flat_ ? Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), n)
                                      : Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), direction());
        s.initial.orientation.normalize();
        Eigen::Vector3d v = direction() * speed_;
        if (v.dot(n) > 0 && !chance(0.1)) v -= 2 * v.dot(n) * n;
        if (chance(0.1)) v = Eigen::Vector3d::Zero();
        s.initial.velocity = v;
        if (chance(0.6)) s.initial.angular_velocity = direction() * speed_ / radius_ * decades(-1, 1);
        double gap = chance(0.15) ? 0.0 : radius_ * decades(-6, 0.3);
        if (chance(0.05)) {
            gap = -0.5 * depth_;
            s.options.allow_initial_penetration = true;
        }
        double deepest = -1e300;
        for (std::size_t i = 0; i < s.body.spheres.size(); ++i) deepest = std::max(deepest, initial_depth(s, i));
        s.initial.position = n * (deepest + gap);
        const double falling = -v.dot(n), g = -s.gravity.dot(n);
        double fall = 0;
        if (gap > 0 && (falling > 0 || g > 0))
            fall = g > 0 ? (std::sqrt(falling * falling + 2 * g * gap) - falling) / g : gap / falling;
        fall = std::min(fall, 1e3 * period_ + 10 * radius_ / speed_);
        s.options.end_time = 1.1 * fall + period_ * decades(0.5, 2.5);
    }

    std::mt19937_64 random_;
    double radius_ = 1, speed_ = 1, mass_ = 1, depth_ = 1, period_ = 1;
    bool flat_ = false, general_ = false;
    double n_ = 1.5, p_ = 1.5, q_ = 1;
};

inline bool finite(const Snapshot& s) {
    bool good = std::isfinite(s.time) && s.body.position.allFinite() && s.body.velocity.allFinite() &&
                s.body.angular_velocity.allFinite() && s.body.orientation.coeffs().allFinite() &&
                std::isfinite(s.ledger.total());
    for (const ContactSnapshot& c : s.contacts)
        good = good && std::isfinite(c.depth) && std::isfinite(c.normal_force) && c.normal_force >= 0 &&
               c.friction_force.allFinite() && c.bristle.allFinite();
    return good;
}

/// What of a run is not in the order of time; empty where all is.
inline std::string disorder(const Run& run) {
    for (std::size_t k = 1; k < run.samples.size(); ++k)
        if (!(run.samples[k - 1].time < run.samples[k].time)) return fmt::format("sample {} is out of order", k);
    for (std::size_t k = 1; k < run.events.size(); ++k)
        if (!(run.events[k - 1].time <= run.events[k].time))
            return fmt::format("event {} ({} at {} s) is before the last ({} at {} s)", k, name_of(run.events[k].kind),
                               run.events[k].time, name_of(run.events[k - 1].kind), run.events[k - 1].time);
    for (std::size_t k = 0; k < run.events.size(); ++k)
        if (run.events[k].time != run.events[k].state.time)
            return fmt::format("event {} has another time than its state", k);
    for (std::size_t k = 1; k < run.impacts.size(); ++k)
        if (!(run.impacts[k - 1].touchdown <= run.impacts[k].touchdown))
            return fmt::format("impact {} is out of order", k);
    return "";
}

/// What is wrong with a run; empty where nothing is.
inline std::string verdict(const Run& run, double tolerance) {
    if (const std::string wrong = disorder(run); !wrong.empty()) return wrong;
    if (run.max_residual > 1e-8) return fmt::format("residual {:.2e} is above 1e-8", run.max_residual);
    // A channel is integrated to the tolerance, so it may waver by that much where it stands still.
    const double slack = 10 * tolerance * run.energy_scale;
    for (std::size_t k = 0; k < run.samples.size(); ++k) {
        if (!finite(run.samples[k])) return fmt::format("sample {} is not finite", k);
        if (k == 0) continue;
        for (std::size_t i = 0; i < run.samples[k].contacts.size(); ++i) {
            const ContactEnergy &a = run.samples[k - 1].contacts[i].energy, &b = run.samples[k].contacts[i].energy;
            if (b.normal_damper < a.normal_damper - slack)
                return fmt::format("normal damper of sphere {} gives back", i);
            if (b.tangential_damper < a.tangential_damper - slack)
                return fmt::format("tangential damper of sphere {} gives back", i);
            if (b.clutch < a.clutch - slack) return fmt::format("clutch of sphere {} gives back", i);
        }
    }
    return finite(run.final) ? "" : "the final state is not finite";
}

}  // namespace footfall::soak
