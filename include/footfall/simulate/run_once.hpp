// One run of a body under contact laws, over any scalar: what a test of the method needs, too.
#pragma once

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

#include "footfall/plant/free_body.hpp"
#include "footfall/simulate/contact_system.hpp"
#include "footfall/simulate/peaks.hpp"
#include "footfall/simulate/run_watchers.hpp"

namespace footfall {

/// The state that a body starts from, in the ground's frame; no contact has begun.
template <class Hybrid>
[[nodiscard]] typename Hybrid::State initial_state(const Hybrid& hybrid, const Simulation& simulation,
                                                   const GroundFrame<typename Hybrid::S>& frame) {
    using Plant = typename Hybrid::PlantType;
    const BodyState& b = simulation.initial;
    const Eigen::Matrix3d R = b.orientation.toRotationMatrix();
    const Eigen::Vector3d momentum = R * simulation.body.inertia * R.transpose() * b.angular_velocity;
    typename Hybrid::State y = Hybrid::State::Zero(hybrid.size());
    y.template segment<3>(Plant::velocity) = to_eigen(frame.to_ground(b.velocity)).array();
    y.template segment<3>(Plant::momentum) = to_eigen(frame.to_ground(momentum)).array();
    y.template segment<4>(Plant::orientation) = frame.to_ground(b.orientation).coeffs().array();
    y.template segment<3>(hybrid.follow()) = to_eigen(frame.to_ground(b.position)).array();
    return y;
}

/// A run under one law for each sphere; `Contacts` and `States` as of Hybrid.
template <class Law, int Contacts = Eigen::Dynamic, int States = Eigen::Dynamic>
class SimulationRun {
public:
    using S = typename Law::value_type;
    using HybridType = Hybrid<FreeBody<S, Contacts>, Law, States>;
    using System = ContactSystem<HybridType>;

    SimulationRun(const Simulation& simulation, std::vector<Law> laws)
        : options_(simulation.options),
          frame_(simulation.ground.normal),
          system_(HybridType(FreeBody<S, Contacts>(simulation.body, simulation.ground, simulation.gravity),
                             std::move(laws)),
                  simulation.body, simulation.ground, simulation.gravity, simulation.options.tolerance),
          recorder_(simulation.options),
          recording_(system_, frame_, recorder_),
          peaks_(system_.hybrid(), recorder_),
          budget_(options_),
          solver_(system_),
          start_(initial_state(system_.hybrid(), simulation, frame_)) {
        solver_.add(recording_);
        solver_.add(peaks_);
        solver_.add(budget_);
        // A look costs little beside this many evaluations of one contact.
        constexpr int evaluations_between_looks = 128;
        solver_.look_every(evaluations_between_looks / system_.hybrid().contacts());
    }

    [[nodiscard]] Solver<System>& solver() noexcept { return solver_; }
    [[nodiscard]] const HybridType& hybrid() const noexcept { return system_.hybrid(); }

    [[nodiscard]] Run run() {
        const auto started = std::chrono::steady_clock::now();
        refuse_the_hopeless();
        system_.listen(
            {.begin = [this](const auto& y) { recorder_.begin(snapshot(y)); },
             .event = [this](EventKind kind, int i, const auto& y) { recorder_.event(kind, i, snapshot(y)); },
             .jacobian = [this](int size, const auto& y) { check_memory(size, y); }});
        solver_.run(start_, ValueOf<S>(options_.end_time));
        const SolverCost& spent = solver_.cost();
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
        recorder_.end(snapshot(solver_.state()),
                      {spent.steps, spent.rejected, spent.evaluations, spent.stiff_steps, seconds});
        return std::move(recorder_.run());
    }

private:
    using State = typename HybridType::State;

    [[nodiscard]] Snapshot snapshot(const State& y) const { return snapshot_of(system_.hybrid(), frame_, y); }

    void check_memory(int size, const State& y) const {
        const double needed = recorder_.bytes() + implicit_bytes(size);
        if (needed > options_.max_memory)
            stop_for_stiffness(needed, static_cast<std::size_t>(system_.hybrid().contacts()),
                               static_cast<double>(value_of(y[system_.clock()])), options_);
    }

    // A body that comes to lie on the ground swings on its contact at about sqrt(g / static depth), and a radian of
    // that costs one step. It may never come to lie, or come to rest so fully that the implicit method strides over it,
    // so only a run that is out of reach by far is refused before it starts.
    void refuse_the_hopeless() const {
        const double pressing = -static_cast<double>(value_of(system_.hybrid().plant().gravity().z()));
        if (!(pressing > 0)) return;
        const double rate = std::sqrt(pressing / system_.scales().static_depth());
        const double estimate = Solver<System>::evaluations_of_a_step * rate * options_.end_time;
        constexpr double far = 100;
        if (estimate > far * options_.max_evaluations) refuse_cost(estimate, rate, options_);
    }

    RunOptions options_;
    GroundFrame<S> frame_;
    System system_;
    Recorder recorder_;
    RunRecording<System> recording_;
    Peaks<HybridType> peaks_;
    Budget<State> budget_;
    Solver<System> solver_;
    State start_;
};

}  // namespace footfall
