// Random valid scenarios, and what must be true of each of their runs.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/core.h>

#include "footfall/simulate/run.hpp"
#include "tried_laws.hpp"

namespace footfall::soak {

/// Which laws are drawn.
enum class Laws {
    every,   ///< of the registry
    clutch,  ///< the paper's, Hunt & Crossley's and the linear normal law; friction with a clutch, and none
};

/// Draws a scenario: sizes, masses, speeds and parameters over many decades, laws of every kind, one to six spheres,
/// slopes, spins, starts in the air, on the ground and in it. Every parameter of a law is drawn relative to the impact
/// that it meets, so that every regime from elastic to creeping is visited at every scale.
class RandomScenario {
public:
    /// `mixed`: each sphere of a body has laws of its own.
    /// Where every law is drawn from, `friction` is the name of the friction law of all contacts; empty: any.
    explicit RandomScenario(std::uint64_t seed, Laws laws = Laws::every, bool mixed = false, std::string friction = "")
        : random_(seed), laws_(laws), mixed_(mixed), friction_(std::move(friction)) {}

    Simulation draw() {
        radius_ = decades(-3, 0);
        speed_ = decades(-2, 1);
        const int spheres = chance(0.4) ? 1 : static_cast<int>(uniform(2, 7));
        Simulation s;
        draw_ground(s);
        draw_body(s, spheres);
        depth_ = radius_ * decades(-5, -1.3);
        period_ = depth_ / speed_;
        NormalLaw normal = draw_kind<NormalLaw>(normal_kinds());
        FrictionLaw friction = draw_kind<FrictionLaw>(friction_kinds());
        draw_exponents();
        for (int i = 0; i < spheres; ++i) {
            if (mixed_ && i > 0) {
                normal = draw_kind<NormalLaw>(normal_kinds());
                friction = draw_kind<FrictionLaw>(friction_kinds());
            }
            draw_normal(normal);
            draw_friction(friction);
            s.contacts.push_back({normal, friction});
        }
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

    /// The laws to draw from, without parameters yet.
    [[nodiscard]] std::vector<NormalLaw> normal_kinds() const {
        if (laws_ == Laws::clutch) return {AzadFeatherstoneNormal<>{}, HuntCrossleyNormal<>{}, LinearNormal<>{}};
        return all_of<NormalLaw>();
    }
    [[nodiscard]] std::vector<FrictionLaw> friction_kinds() const {
        if (laws_ == Laws::clutch) return {NoFriction<>{}, AzadFeatherstoneFriction<>{}, LinearFriction<>{}};
        std::vector<FrictionLaw> kinds = all_of<FrictionLaw>();
        if (!friction_.empty()) std::erase_if(kinds, [this](const auto& law) { return name_of(law) != friction_; });
        return kinds;
    }
    template <class Variant>
    static std::vector<Variant> all_of() {
        std::vector<Variant> all;
        for_each_law<Variant>([&](const auto& law) { all.push_back(law); });
        return all;
    }
    template <class Variant>
    Variant draw_kind(const std::vector<Variant>& kinds) {
        return kinds[static_cast<std::size_t>(uniform(0, static_cast<double>(kinds.size())))];
    }

    // ---- normal laws: the spring holds half of the impact's energy m v^2 at the depth ------------------------------

    void draw_normal(NormalLaw& law) {
        const double energy = mass_ * speed_ * speed_;
        const double loss = chance(0.1) ? 0.0 : decades(-4, 1.5);
        std::visit(
            [&](auto& l) {
                if constexpr (requires { draw_into(l, energy, loss); }) {
                    draw_into(l, energy, loss);
                } else {
                    draw_parameters(l, energy, loss);
                }
            },
            law);
    }
    void draw_into(AzadFeatherstoneNormal<>& law, double energy, double loss) const {
        const double K = 1.25 * energy / std::pow(depth_, 2.5);
        law = {K, loss * K * period_};
    }
    void draw_into(HuntCrossleyNormal<>& law, double energy, double loss) const {
        law = {};
        if (general_) law.n = n_, law.p = p_, law.q = q_;
        law.stiffness = 0.5 * (law.n + 1) * energy / std::pow(depth_, law.n + 1);
        law.damping = loss * law.stiffness * std::pow(depth_, law.n - law.p) / std::pow(speed_, law.q);
    }
    void draw_into(LinearNormal<>& law, double energy, double loss) const {
        const double k = energy / (depth_ * depth_);
        law = {k, loss * k * period_};
    }
    /// `loss` is what the damper gives over what the spring does, at this depth and speed. Both are proportional to
    /// their parameter.
    template <class Law>
    void draw_parameters(Law& law, double energy, double loss) {
        law = {};
        double Law::*lossy = nullptr;
        for (const auto& p : Law::parameters()) {
            double& value = law.*p.member;
            if (p.key == "stiffness") {
                value = 1;
            } else if (p.key == "damping" || p.key == "damping_time" || p.key == "alpha") {
                lossy = p.member;
                value = 1;
            } else if (p.key == "restitution") {
                value = loss > 0 ? uniform(0.05, 1) : 1.0;
            } else if (p.key == "mass") {
                value = mass_ * decades(-1, 0);
            } else if (p.key == "slowest_impact") {
                value = speed_ * decades(-6, -1);
            } else if (p.key == "n") {
                value = general_ ? n_ : p.fallback.value();
            } else if (p.key == "exponent") {
                value = general_ ? uniform(0, 1) : p.fallback.value();
            } else {
                value = draw_by_unit(p);
            }
        }
        const double s = std::sqrt(depth_);
        const Touch<double> touch{s, speed_, {}};
        const std::array<double, most_normal_states> none{};
        const auto pair = [&] { return Pair<NormalLaw, NoFriction<>>(law, {}); };
        const double stored = pair().held({Phase::slip}, touch, none).normal_spring;  // at a stiffness of 1
        law.stiffness = 0;
        const double rest = pair().held({Phase::slip}, touch, none).normal_spring;
        law.stiffness = stored > rest ? 0.5 * energy / (stored - rest) : 1;
        if (!lossy) return;
        const NormalForce<double> f = pair().normal_parts(touch, none);
        law.*lossy = loss * f.elastic / f.dissipative;
    }

    // ---- friction laws ---------------------------------------------------------------------------------------------

    void draw_friction(FrictionLaw& law) {
        Friction f;
        f.stiffness = mass_ * speed_ * speed_ / (depth_ * depth_) * decades(-1.5, 1.5);
        f.relaxation = chance(0.1) ? 0.0 : decades(-3, 1.5) * period_;
        f.mu = chance(0.1) ? 0.0 : decades(-2, 0.5);
        f.viscous = chance(0.4) ? 0.0 : mass_ / period_ * decades(-5, 1);
        std::visit(
            [&](auto& l) {
                if constexpr (requires { draw_into(l, f); }) {
                    draw_into(l, f);
                } else {
                    draw_parameters(l, f);
                }
            },
            law);
    }
    /// What a clutch would have.
    struct Friction {
        double stiffness = 0;   ///< [N/m]
        double relaxation = 0;  ///< damping over stiffness [s]
        double mu = 0;
        double viscous = 0;  ///< [N s/m]
    };
    void draw_into(NoFriction<>& /*law*/, const Friction& /*f*/) const {}
    void draw_into(AzadFeatherstoneFriction<>& law, const Friction& f) const {
        const double K = f.stiffness / std::sqrt(depth_);
        law = {{K, K * f.relaxation, f.mu, f.viscous}};
    }
    void draw_into(AzadFeatherstonePassiveFriction<>& law, const Friction& f) const {
        const double K = f.stiffness / std::sqrt(depth_);
        law = {{K, K * f.relaxation, f.mu, f.viscous}};
    }
    void draw_into(LinearFriction<>& law, const Friction& f) const {
        law = {{f.stiffness, f.stiffness * f.relaxation, f.mu, f.viscous}};
    }
    /// Every snap of a bond is an event: as many as a run can do.
    void draw_into(HaessigFriedlandFriction<>& law, const Friction& f) {
        law.reach = depth_ * decades(-0.5, 1);
        law.stiffness = std::max(f.mu, least_mu) / law.reach;
    }
    /// Laws over the load, which is about m v^2 / z.
    template <class Law>
    void draw_parameters(Law& law, const Friction& f) {
        const double load = mass_ * speed_ * speed_ / depth_, mu = std::max(f.mu, least_mu);
        const double sigma = f.stiffness / load;
        law = {};
        for (const auto& p : Law::parameters()) {
            double& value = law.*p.member;
            if (p.key == "stiffness") {
                value = sigma;
            } else if (p.key == "damping") {
                value = sigma * f.relaxation;
            } else if (p.key == "viscous") {
                value = f.viscous / load;
            } else if (p.key == "coefficient") {
                value = p.may_be_zero() ? f.mu : mu;
            } else if (p.key == "kinetic_coefficient") {
                value = mu;
            } else if (p.key == "static_coefficient") {
                value = chance(0.2) ? mu : mu * uniform(0.8, 2);
            } else if (p.key == "stribeck_coefficient" || p.key == "slow_coefficient") {
                value = chance(0.2) ? 0.0 : mu * uniform(0, 1);
            } else if (p.key == "stiction") {
                value = chance(0.2) ? 0.0 : uniform(0, 1);
            } else if (p.key == "elastic_share" || p.key == "fast_share") {
                value = chance(0.2) ? 1.0 : uniform(0.05, 1);
            } else if (p.key == "reach" || p.key == "slow_length") {
                value = mu / sigma;
            } else if (p.key == "stribeck_velocity" || p.key == "rounding_speed") {
                value = speed_ * decades(-3, 0);
            } else if (p.key == "memory_time" || p.key == "rise_time") {
                value = period_ * decades(-2, 2);
            } else {
                value = draw_by_unit(p);
            }
        }
    }
    /// What no rule knows by its key: by its unit, about its natural size in this impact.
    template <class Law>
    double draw_by_unit(const Parameter<Law>& p) {
        if (p.fallback && chance(0.3)) return *p.fallback;
        if (p.may_be_zero() && chance(0.1)) return 0;
        if (p.at_most_one) return uniform(0.02, 1);
        if (p.unit_depends)
            throw std::logic_error(fmt::format("no rule draws {} of {}, whose unit depends on other parameters", p.key,
                                               Law::description.name));
        return test::Scale{.mass = mass_, .length = depth_, .time = period_}.of(p.unit) * decades(-1, 1);
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

    static constexpr double least_mu = 0.01;  ///< where a law has no frictionless limit

    std::mt19937_64 random_;
    Laws laws_;
    bool mixed_;
    std::string friction_;
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

/// What is wrong with a run of the simulation; empty where nothing is.
inline std::string verdict(const Run& run, const Simulation& simulation) {
    if (const std::string wrong = disorder(run); !wrong.empty()) return wrong;
    if (run.max_residual > 1e-8) return fmt::format("residual {:.2e} is above 1e-8", run.max_residual);
    // A channel is integrated to the tolerance, so it may waver by that much where it stands still.
    const double slack = 10 * simulation.options.tolerance * run.energy_scale;
    // What the changing stiffness takes follows |zdot|. Inside an implicit step at rest the interpolant's zdot is known
    // to some tolerances only, where a stiff bristle makes much of it; at the step's ends it is right.
    const double interpolated_slack = 100 * slack;
    for (std::size_t k = 0; k < run.samples.size(); ++k) {
        if (!finite(run.samples[k])) return fmt::format("sample {} is not finite", k);
        if (k == 0) continue;
        for (std::size_t i = 0; i < run.samples[k].contacts.size(); ++i) {
            const ContactEnergy &a = run.samples[k - 1].contacts[i].energy, &b = run.samples[k].contacts[i].energy;
            if (b.normal_damper < a.normal_damper - slack)
                return fmt::format("normal damper of sphere {} gives back", i);
            if (b.tangential_damper < a.tangential_damper - slack)
                return fmt::format("tangential damper of sphere {} gives back", i);
            if (clutch_only_takes(simulation.contacts[i].friction) && b.clutch < a.clutch - slack)
                return fmt::format("clutch of sphere {} gives back", i);
            if (std::holds_alternative<AzadFeatherstonePassiveFriction<>>(simulation.contacts[i].friction) &&
                b.stiffness_change < a.stiffness_change - interpolated_slack)
                return fmt::format("changing stiffness of sphere {} makes energy", i);
        }
    }
    return finite(run.final) ? "" : "the final state is not finite";
}

}  // namespace footfall::soak
