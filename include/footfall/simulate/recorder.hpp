// Keeps what a run gives back: samples, events, impacts, the ledger's residual.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "footfall/simulate/run.hpp"

namespace footfall {

class Recorder {
public:
    explicit Recorder(RunOptions options) : options_(std::move(options)) {}

    /// Throws TooExpensive where the samples to come would take more than RunOptions::max_memory.
    void begin(Snapshot initial);
    void end(Snapshot last, const Cost& cost);

    /// When the next sample is due [s]; later than any time where none is.
    [[nodiscard]] double next_sample() const noexcept;
    void sample(Snapshot shot);

    /// Throws TooExpensive where the events take more than RunOptions::max_memory leaves.
    void event(EventKind kind, int sphere, Snapshot shot);

    /// A depth and a force that contact `sphere` has reached.
    void reached(int sphere, double depth, double normal_force) noexcept;

    /// The impact that contact `sphere` is in, or nothing.
    [[nodiscard]] const Impact* impact(int sphere) const noexcept;

    /// What is kept: all samples, those to come included, and the events so far [bytes].
    [[nodiscard]] double bytes() const noexcept;

    /// The account after a step.
    void account(const Ledger& ledger) noexcept;

    [[nodiscard]] Run& run() noexcept { return run_; }

private:
    [[nodiscard]] Impact* open_impact(int sphere) noexcept;

    RunOptions options_;
    double samples_bytes_ = 0;
    std::int64_t sampled_ = 0;  // samples taken so far
    std::vector<int> open_;     // index of each sphere's impact in run_.impacts, or -1
    std::vector<double> stuck_since_;
    double largest_error_ = 0;  // [J]
    Run run_;
};

}  // namespace footfall
