// What looks on while a run is computed: samples, the account of energy, budget and progress.
#pragma once

#include <cmath>

#include "footfall/simulate/account.hpp"
#include "footfall/simulate/budget.hpp"
#include "footfall/simulate/contact_system.hpp"
#include "footfall/simulate/recorder.hpp"
#include "footfall/solve/watcher.hpp"

namespace footfall {

/// Records the samples that are due inside each step, and the account after it.
template <class System>
class RunRecording final : public Watcher<typename System::State> {
public:
    using State = typename System::State;
    using Value = typename System::Value;

    RunRecording(System& system, const GroundFrame<typename System::S>& frame, Recorder& recorder)
        : system_(system), frame_(frame), recorder_(recorder) {}

    void step(const SolverStep<State>& step) override {
        while (recorder_.next_sample() <= static_cast<double>(step.to())) {
            const Value due(recorder_.next_sample());
            State y = step.at(step.share_at(due));
            system_.relax(y, due - step.from());
            recorder_.sample(snapshot_of(system_.hybrid(), frame_, y));
        }
    }
    void reach(const State& y) override {
        const Ledger ledger = ledger_of(system_.hybrid(), y);
        if (!std::isfinite(ledger.total())) stop_for_overflow(static_cast<double>(value_of(y[system_.clock()])));
        recorder_.account(ledger);
        system_.see(y, ledger);
    }

private:
    System& system_;
    const GroundFrame<typename System::S>& frame_;
    Recorder& recorder_;
};

/// Ends a run that its caller or its budget no longer wants.
template <class State>
class Budget final : public Watcher<State> {
public:
    explicit Budget(const RunOptions& options) : options_(options) {}

    void look(const SolverCost& cost, const ValueOf<typename State::Scalar>& clock) override {
        const double now = static_cast<double>(clock);
        if (options_.progress && !options_.progress(now)) throw Interrupted("the run was interrupted");
        if (static_cast<double>(cost.evaluations) > options_.max_evaluations) stop_for_cost(now, options_);
    }

private:
    const RunOptions& options_;
};

}  // namespace footfall
