// Random hosts: a linear one that moves under random forces, with random contacts under random laws.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

#include "footfall/host/contact_set.hpp"

namespace footfall::test {

class Draw {
public:
    explicit Draw(std::uint64_t seed) : engine_(seed) {}
    double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine_); }
    double decades(double from, double to) { return std::exp(uniform(std::log(from), std::log(to))); }
    double normal() { return std::normal_distribution<double>()(engine_); }
    std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(engine_); }
    bool one_in(std::size_t n) { return below(n) == 0; }

private:
    std::mt19937_64 engine_;
};

/// A law with every parameter drawn from where materials are and far beyond: stiffness over ten decades.
template <class Law>
Law random_host_law(Draw& draw) {
    Law law{};
    double stiffness = 1, static_coefficient = 1;
    for (const auto& p : Law::parameters()) {
        const std::string_view unit = p.unit, key = p.key;
        double value = 0;
        if (p.fallback && (key == "n" || key == "p" || key == "q" || key == "exponent" || draw.one_in(2))) {
            value = *p.fallback;
        } else if (p.may_be_zero() && draw.one_in(5)) {
            value = 0;
        } else if (key == "stiffness") {
            value = stiffness = unit.starts_with("N") ? draw.decades(1e2, 1e12) : draw.decades(1e2, 1e6);
        } else if (key == "viscous" && unit == "N s/m") {
            value = draw.decades(1e-3, 1e1);
        } else if (unit.starts_with("N s")) {
            value = stiffness * draw.decades(1e-6, 1e-2);
        } else if (unit == "m/s") {
            value = draw.decades(1e-4, 1e-1);
        } else if (unit == "s") {
            value = draw.decades(1e-7, 1e-3);
        } else if (unit == "m") {
            value = draw.decades(1e-4, 1e-3);
        } else if (key == "static_coefficient") {
            value = static_coefficient = draw.uniform(0.05, 1);
        } else if (key == "kinetic_coefficient") {  // laws with a Stribeck curve that rises have no end
            value = draw.uniform(0.3, 1) * static_coefficient;
        } else if (unit == "1") {
            value = draw.uniform(0.05, 1);
        } else {
            value = draw.decades(1e-3, 1e1);
        }
        law.*p.member = value;
    }
    return law;
}
template <class Variant>
Variant random_host_law_of(Draw& draw) {
    std::vector<Variant> one_of_each;
    for_each_law<Variant>([&]<class Law>(const Law&) { one_of_each.emplace_back(random_host_law<Law>(draw)); });
    return one_of_each[draw.below(one_of_each.size())];
}
inline ContactParameters random_contact(Draw& draw) {
    return {random_host_law_of<NormalLaw>(draw), random_host_law_of<FrictionLaw>(draw)};
}

/// Coordinates q with the mass matrix M and J, both constant: what a set holds frozen is exact. The points of contact
/// are at x0 + J q.
class LinearHost {
public:
    /// `contacts` of them on `coordinates`: with fewer than three for each contact D is singular.
    LinearHost(Draw& draw, std::size_t contacts, std::size_t coordinates) : n_(3 * contacts), m_(coordinates) {
        const double mass = draw.decades(1e-2, 1e2);
        inverse_mass_.resize(m_);
        for (double& w : inverse_mass_) w = 1 / (mass * draw.decades(0.3, 3));
        jacobian_.resize(n_ * m_);
        for (double& j : jacobian_) j = draw.normal();
        position_.resize(n_);
        velocity_.resize(m_);
        force_.resize(m_);
        for (double& u : velocity_) u = draw.normal() * draw.decades(1e-3, 2);
        for (std::size_t k = 0; k < m_; ++k) force_[k] = draw.normal() * 9.81 / inverse_mass_[k];
        for (std::size_t i = 0; i < contacts; ++i)
            position_[3 * i + 2] = draw.one_in(3) ? -1e-4 * draw.decades(1e-3, 10) : 1e-3 * draw.decades(1e-3, 10);
        set_up();
    }

    /// One that is made by hand.
    LinearHost(std::vector<double> inverse_mass, std::vector<double> jacobian, std::vector<double> position,
               std::vector<double> velocity_of_coordinates, std::vector<double> force)
        : n_(position.size()),
          m_(inverse_mass.size()),
          inverse_mass_(std::move(inverse_mass)),
          jacobian_(std::move(jacobian)),
          position_(std::move(position)),
          velocity_(std::move(velocity_of_coordinates)),
          force_(std::move(force)) {
        set_up();
    }

    [[nodiscard]] HostStep given(double dt) const {
        HostStep step;
        step.dt = dt;
        step.depth = depth;
        step.velocity = velocity;
        step.free_acceleration = acceleration;
        step.delassus = delassus;
        return step;
    }
    /// Kinetic energy, and that of the constant forces [J].
    [[nodiscard]] double energy() const {
        double e = -work_;
        for (std::size_t k = 0; k < m_; ++k) e += 0.5 * velocity_[k] * velocity_[k] / inverse_mass_[k];
        return e;
    }
    void move(double dt, const std::vector<double>& impulse, const std::vector<double>& double_impulse) {
        std::vector<double> dq(m_);
        for (std::size_t k = 0; k < m_; ++k) {
            double J = dt * force_[k], JJ = 0.5 * dt * dt * force_[k];
            for (std::size_t a = 0; a < n_; ++a) {
                J += jacobian_[a * m_ + k] * impulse[a];
                JJ += jacobian_[a * m_ + k] * double_impulse[a];
            }
            dq[k] = dt * velocity_[k] + inverse_mass_[k] * JJ;
            velocity_[k] += inverse_mass_[k] * J;
            work_ += force_[k] * dq[k];
        }
        for (std::size_t a = 0; a < n_; ++a)
            for (std::size_t k = 0; k < m_; ++k) position_[a] += jacobian_[a * m_ + k] * dq[k];
        look();
    }

    [[nodiscard]] double coordinate_velocity(std::size_t k) const { return velocity_[k]; }
    [[nodiscard]] double position(std::size_t a) const { return position_[a]; }

    std::vector<double> depth, velocity, acceleration, delassus;

private:
    void set_up() {
        delassus.assign(n_ * n_, 0.0);
        for (std::size_t a = 0; a < n_; ++a)
            for (std::size_t b = 0; b < n_; ++b)
                for (std::size_t k = 0; k < m_; ++k)
                    delassus[a * n_ + b] += jacobian_[a * m_ + k] * inverse_mass_[k] * jacobian_[b * m_ + k];
        depth.resize(n_ / 3);
        velocity.resize(n_);
        acceleration.resize(n_);
        look();
    }
    void look() {
        for (std::size_t a = 0; a < n_; ++a) {
            velocity[a] = acceleration[a] = 0;
            for (std::size_t k = 0; k < m_; ++k) {
                velocity[a] += jacobian_[a * m_ + k] * velocity_[k];
                acceleration[a] += jacobian_[a * m_ + k] * inverse_mass_[k] * force_[k];
            }
        }
        for (std::size_t i = 0; i < depth.size(); ++i) depth[i] = -position_[3 * i + 2];
    }

    std::size_t n_, m_;
    std::vector<double> inverse_mass_, jacobian_, position_, velocity_, force_;
    double work_ = 0;
};

}  // namespace footfall::test
