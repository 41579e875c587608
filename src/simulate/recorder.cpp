#include "footfall/simulate/recorder.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "footfall/simulate/budget.hpp"

namespace footfall {

void Recorder::begin(Snapshot initial) {
    const std::size_t spheres = initial.contacts.size();
    const double samples = sample_count(options_.sample_period, options_.end_time);
    samples_bytes_ = samples * (sizeof(Snapshot) + contacts_bytes(spheres));
    if (samples_bytes_ > options_.max_memory) refuse_memory(samples_bytes_, spheres, options_);
    run_.samples.reserve(static_cast<std::size_t>(samples));
    open_.assign(initial.contacts.size(), -1);
    stuck_since_.assign(initial.contacts.size(), 0.0);
    run_.initial = std::move(initial);
    run_.samples.push_back(run_.initial);
    sampled_ = 1;
    account(run_.initial.ledger);
}

void Recorder::end(Snapshot last, const Cost& cost) {
    for (std::size_t i = 0; i < open_.size(); ++i) {
        Impact* impact = open_impact(static_cast<int>(i));
        if (impact && last.contacts[i].phase == Phase::stick) impact->stick_time += last.time - stuck_since_[i];
    }
    account(last.ledger);
    if (run_.samples.back().time < last.time) run_.samples.push_back(last);
    run_.final = std::move(last);
    run_.max_residual = run_.energy_scale > 0 ? largest_error_ / run_.energy_scale : 0;
    run_.cost = cost;
}

double Recorder::next_sample() const noexcept {
    if (!(options_.sample_period > 0)) return std::numeric_limits<double>::infinity();
    const double due = static_cast<double>(sampled_) * options_.sample_period;
    // The last sample is the end itself.
    return due < options_.end_time * (1 - 1e-12) ? due : std::numeric_limits<double>::infinity();
}

void Recorder::sample(Snapshot shot) {
    shot.time = static_cast<double>(sampled_) * options_.sample_period;
    run_.samples.push_back(std::move(shot));
    ++sampled_;
}

double Recorder::bytes() const noexcept {
    // A full list moves to a larger place, and is there twice meanwhile.
    const double events = static_cast<double>(run_.events.size());
    const double moving = run_.events.size() == run_.events.capacity() ? events : 0;
    return samples_bytes_ + events * (sizeof(Event) + contacts_bytes(open_.size())) + moving * sizeof(Event) +
           static_cast<double>(run_.impacts.size()) * sizeof(Impact);
}

void Recorder::event(EventKind kind, int sphere, Snapshot shot) {
    if (const double needed = bytes(); needed > options_.max_memory)
        stop_for_events(needed, run_.events.size(), shot.time, options_);
    // What happens at the very start of a step may come out by a rounding before what began it.
    shot.time = std::max(shot.time, run_.events.empty() ? run_.initial.time : run_.events.back().time);
    const auto i = static_cast<std::size_t>(sphere);
    const double time = shot.time;
    Impact* impact = open_impact(sphere);
    const auto unstick = [&] {
        if (impact && stuck_since_[i] >= 0) impact->stick_time += time - stuck_since_[i];
        stuck_since_[i] = -1;
    };
    switch (kind) {
        case EventKind::touchdown:
            if (impact) {  // loaded again before it had recovered: the same visit goes on
                impact->separation.reset();
            } else {
                Impact fresh;
                fresh.sphere = sphere;
                fresh.touchdown = time;
                fresh.speed_in = shot.contacts[i].depth_rate;
                open_[i] = static_cast<int>(run_.impacts.size());
                run_.impacts.push_back(fresh);
            }
            stuck_since_[i] = -1;
            break;
        case EventKind::stick:
            stuck_since_[i] = time;
            break;
        case EventKind::slip:
            unstick();
            break;
        case EventKind::separation:
            unstick();
            if (impact) impact->separation = time;
            break;
        case EventKind::recovered:
            if (impact) {
                impact->recovered = time;
                impact->speed_out = -shot.contacts[i].depth_rate;
            }
            open_[i] = -1;
            break;
    }
    run_.events.push_back({time, kind, sphere, std::move(shot)});
}

void Recorder::reached(int sphere, double depth, double normal_force) noexcept {
    if (Impact* impact = open_impact(sphere)) {
        impact->peak_indentation = std::max(impact->peak_indentation, depth);
        impact->peak_normal_force = std::max(impact->peak_normal_force, normal_force);
    }
}

void Recorder::account(const Ledger& ledger) noexcept {
    run_.energy_scale = std::max(run_.energy_scale, ledger.magnitude());
    largest_error_ = std::max(largest_error_, std::abs(ledger.total() - run_.initial.ledger.total()));
}

Impact* Recorder::open_impact(int sphere) noexcept {
    const int index = open_[static_cast<std::size_t>(sphere)];
    return index < 0 ? nullptr : &run_.impacts[static_cast<std::size_t>(index)];
}

const Impact* Recorder::impact(int sphere) const noexcept {
    const int index = open_[static_cast<std::size_t>(sphere)];
    return index < 0 ? nullptr : &run_.impacts[static_cast<std::size_t>(index)];
}

}  // namespace footfall
