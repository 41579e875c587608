// What is left of a host's step where its budget has ended, taken at once.
//
// One step of the implicit Euler method for the normal forces, all contacts by Gauss and Seidel's iteration, and a drag
// for friction that stops a contact at most: stable for every stiffness, of no order worth speaking of. The impulses
// act where the rest begins, so that the host's positions move as the depths did.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "footfall/law/contact_step.hpp"
#include "footfall/law/erased.hpp"

namespace footfall::host {

template <class System>
class ImplicitRest {
public:
    using State = typename System::State;
    using Law = typename System::Law;

    explicit ImplicitRest(System& system)
        : system_(system),
          hybrid_(system.hybrid()),
          n_(static_cast<std::size_t>(3 * hybrid_.contacts())),
          velocity_(n_),
          impulse_(n_),
          modes_(static_cast<std::size_t>(hybrid_.contacts())) {}

    /// From y over `rest` [s]: y becomes the end of the host's step, and the contacts' modes with it. Where that would
    /// give energy to the motion, as the iteration has not converged or friction is rough, it is done again without
    /// friction, and at last as if the ground stopped what touches.
    void take(State& y, double rest) {
        const State begin = y;
        for (int i = 0; i < hybrid_.contacts(); ++i) modes_[static_cast<std::size_t>(i)] = hybrid_.mode(i);
        for (const Way way : {Way::all, Way::no_friction, Way::stop}) {
            if (way != Way::all) {
                y = begin;
                for (int i = 0; i < hybrid_.contacts(); ++i) system_.set_mode(i, modes_[static_cast<std::size_t>(i)]);
            }
            if (!(attempt(y, rest, way) > borne_)) return;
        }
    }

private:
    enum class Way { all, no_friction, stop };

    /// Returns the energy that motion and springs have been given [J].
    double attempt(State& y, double rest, Way way) {
        const double held_before = held(y);
        stops_ = way == Way::stop;
        start(y, rest);
        press_all(y, rest);
        friction_.assign(modes_.size(), ContactStep{});
        for (int i = 0; i < hybrid_.contacts(); ++i)
            friction_[static_cast<std::size_t>(i)] = rub(y, i, rest, way == Way::all);
        press_all(y, rest);
        const double work = impulsive_work(y);
        // What is carried is lifted first, and falls back.
        borne_ = 0;
        for (int i = 0; i < hybrid_.contacts(); ++i)
            borne_ += std::max(0.0, -impulse_[normal(i)] * system_.step().acceleration[normal(i)] * rest);
        for (int i = 0; i < hybrid_.contacts(); ++i) finish(y, i, rest);
        y[system_.clock()] += rest;
        y[hybrid_.plant().clock_component()] += rest;
        const double given = work + held(y) - held_before;
        // Damper and clutch have not taken more than is gone.
        double taken = 0;
        for (const ContactStep& f : friction_) taken += f.tangential_damper + f.clutch;
        const double share = taken > 0 ? std::clamp(-given / taken, 0.0, 1.0) : 0;
        for (int i = 0; i < hybrid_.contacts(); ++i) {
            const ContactStep& f = friction_[static_cast<std::size_t>(i)];
            y[hybrid_.taken(i) + by_tangential_damper] += share * f.tangential_damper;
            y[hybrid_.taken(i) + by_clutch] += share * f.clutch;
        }
        return given;
    }
    void press_all(const State& y, double rest) {
        constexpr int sweeps = 300;
        constexpr double settled = 1e-9;
        for (int sweep = 0; sweep < sweeps; ++sweep) {
            double change = 0, size = 0;
            for (int i = 0; i < hybrid_.contacts(); ++i) {
                change = std::max(change, std::abs(press(y, i, rest)));
                size = std::max(size, impulse_[normal(i)]);
            }
            if (!(change > settled * size)) return;
        }
    }
    [[nodiscard]] double held(const State& y) const {
        const auto motion = hybrid_.plant().motion(y);
        double sum = 0;
        for (int i = 0; i < hybrid_.contacts(); ++i) {
            const Held<double> h = hybrid_.held(y, hybrid_.plant().touch(y, motion, i), i);
            sum += h.normal_spring + h.tangential_spring;
        }
        return sum;
    }
    /// Of the impulses, which act before the free acceleration does [J].
    [[nodiscard]] double impulsive_work(const State& y) const {
        const auto motion = hybrid_.plant().motion(y);
        double work = 0;
        for (std::size_t k = 0; k < n_; ++k) {
            double response = 0;
            for (std::size_t l = 0; l < n_; ++l) response += delassus(k, l) * impulse_[l];
            work += impulse_[k] * (motion.velocity[k] + 0.5 * response);
        }
        return work;
    }

    static std::size_t normal(int i) noexcept { return static_cast<std::size_t>(3 * i + 2); }
    [[nodiscard]] double delassus(std::size_t row, std::size_t column) const {
        return system_.step().delassus[row * n_ + column];
    }

    void start(const State& y, double rest) {
        const auto motion = hybrid_.plant().motion(y);
        depth_.clear();
        for (std::size_t k = 0; k < n_; ++k) {
            velocity_[k] = motion.velocity[k] + system_.step().acceleration[k] * rest;
            impulse_[k] = 0;
        }
        for (int i = 0; i < hybrid_.contacts(); ++i) {
            const double s = y[hybrid_.plant().root_depth_component(i)];
            depth_.push_back(hybrid_.touches(i) ? s * s
                                                : hybrid_.plant().geometric_depth(y, motion, hybrid_.follow(), i));
        }
    }
    void add(std::size_t k, double impulse) {
        impulse_[k] += impulse;
        for (std::size_t row = 0; row < n_; ++row) velocity_[row] += delassus(row, k) * impulse;
    }

    /// Where contact i ends with this velocity along the normal.
    [[nodiscard]] double end_depth(int i, double v, double rest) const {
        return depth_[static_cast<std::size_t>(i)] - rest * v +
               0.5 * system_.step().acceleration[normal(i)] * rest * rest;
    }
    [[nodiscard]] Touch<double> touch_at_end(int i, double v, double rest) const {
        const auto at = static_cast<std::size_t>(3 * i);
        return {root_of_depth(end_depth(i, v, rest)), -v, {velocity_[at], velocity_[at + 1]}};
    }

    /// The normal impulse of contact i under those of the others; returns what it has changed by.
    double press(const State& y, int i, double rest) {
        const std::size_t k = normal(i);
        const double d = delassus(k, k), without = velocity_[k] - d * impulse_[k];
        const auto pressed = [&](double impulse) {
            const Touch<double> t = touch_at_end(i, without + d * impulse, rest);
            if (!(t.root_depth > 0)) return 0.0;
            return std::max(rest * hybrid_.law(i).normal_force(t, hybrid_.states(y, i)), 0.0);
        };
        // The force falls as the impulse grows, so that the two meet once.
        double low = 0, high = pressed(0);
        constexpr int halvings = 100;
        for (int h = 0; h < halvings && high - low > 1e-15 * high; ++h) {
            const double middle = 0.5 * (low + high);
            (pressed(middle) > middle ? low : high) = middle;
        }
        const double change = (stops_ ? stopping_impulse(i, without, rest) : 0.5 * (low + high)) - impulse_[k];
        if (!std::isfinite(change)) return 0;
        add(k, change);
        return change;
    }

    /// The normal impulse after which contact i is no deeper than it was. Its velocity is v at the end without it.
    [[nodiscard]] double stopping_impulse(int i, double v, double rest) const {
        const double d = delassus(normal(i), normal(i)), depth = depth_[static_cast<std::size_t>(i)];
        const double least = 0.5 * system_.step().acceleration[normal(i)] * rest + std::min(depth, 0.0) / rest;
        return d > 0 ? std::max((least - v) / d, 0.0) : 0.0;
    }

    /// Friction of contact i: the mean force at the velocity that it would have without, less where that would turn the
    /// velocity round.
    ContactStep rub(State& y, int i, double rest, bool acts) {
        const auto at = static_cast<std::size_t>(3 * i);
        const Law& law = hybrid_.law(i);
        const Touch<double> t = touch_at_end(i, velocity_[normal(i)], rest);
        const std::span<double> x = hybrid_.states(y, i);
        if (t.root_depth > 0 && !hybrid_.touches(i)) law.land(t, x);
        const std::vector<double> before(x.begin(), x.end());
        const Mode mode = law.mode_at(hybrid_.mode(i), t, x);
        ContactStep step{.phase = mode.phase};
        constexpr double rough = 1e-2;
        with_law(law.friction, [&]<class Friction>(const Friction& friction) {
            hold_friction(law, HeldFriction<Friction>(friction, rough), mode, t, rest, x, step);
        });
        if (step.left > 0 || !step.mean_friction_force.allFinite()) {
            std::copy(before.begin(), before.end(), x.begin());
            return {.phase = mode.phase};
        }
        const double force = step.mean_friction_force.norm(), speed = t.slip.norm();
        const double d = std::max(delassus(at, at), delassus(at + 1, at + 1));
        const double share = acts && speed > 0 ? speed / (speed + rest * d * force) : 0;
        add(at, share * rest * step.mean_friction_force.x());
        add(at + 1, share * rest * step.mean_friction_force.y());
        return step;
    }

    void finish(State& y, int i, double rest) {
        const auto& plant = hybrid_.plant();
        const Touch<double> t = touch_at_end(i, velocity_[normal(i)], rest);
        const double begins = y[system_.clock()];
        for (int k = 0; k < 3; ++k) {
            const double impulse = impulse_[static_cast<std::size_t>(3 * i + k)];
            y[System::Plant::velocity + 3 * i + k] = velocity_[static_cast<std::size_t>(3 * i + k)];
            y[hybrid_.follow() + plant.impulse(i) + k] += impulse;
            y[hybrid_.follow() + plant.impulse_moment(i) + k] += impulse * begins;
        }
        y[plant.root_depth_component(i)] = t.root_depth;
        const Law& law = hybrid_.law(i);
        const std::span<double> x = hybrid_.states(y, i);
        const Mode mode = law.mode_at({friction_[static_cast<std::size_t>(i)].phase}, t, x);
        // With the load states go that are over it. A contact that was stopped begins anew: no load goes with its
        // impulse.
        if (!mode.loaded() || stops_)
            hybrid_.book(y, i, law.cross(Law::load_guard, {Phase::slip}, t, 0, false, x).taken);
        system_.set_mode(i, mode);
    }

    System& system_;
    const typename System::HybridType& hybrid_;
    std::size_t n_;
    std::vector<double> velocity_, impulse_, depth_;
    bool stops_ = false;
    double borne_ = 0;
    std::vector<Mode> modes_;
    std::vector<ContactStep> friction_;
};

}  // namespace footfall::host
