#include "study/swing.hpp"

#include <algorithm>
#include <cmath>

namespace footfall {

Swing::Swing(const Rig& rig, const Timeline& timeline) : half_time_(rig.end_time / 2) {
    if (rig.drag != Drag::mass || !(rig.mass.stiffness > 0)) return;
    const Instant end = timeline.at(timeline.intervals().back(), 0.5);
    const Vector2<double> drawn = end.belt - end.support_velocity;
    speed_ = drawn.norm();
    if (speed_ > 0) along_ = drawn / speed_;
}

void Swing::with_belt(double from, double to) {
    if (to < half_time_) return;
    if (!stays_.empty() && from <= stays_.back().to) {
        stays_.back().to = to;
    } else {
        stays_.push_back({from, to});
    }
}

std::optional<StickSlip> Swing::result() const {
    std::vector<Turn> turns = large_turns();
    while (!turns.empty() && !turns.front().greatest) turns.erase(turns.begin());
    while (!turns.empty() && !turns.back().greatest) turns.pop_back();
    if (turns.size() < 3) return std::nullopt;
    StickSlip s;
    s.cycles = static_cast<int>(turns.size() / 2);
    for (std::size_t i = 0; i + 1 < turns.size(); ++i)
        (turns[i].greatest ? s.greatest : s.least) += turns[i].deflection / s.cycles;
    const double from = turns.front().time, to = turns.back().time;
    s.period = (to - from) / s.cycles;
    s.amplitude = (s.greatest - s.least) / 2;
    for (const Stay& stay : stays_)
        s.sticking += std::max(std::min(stay.to, to) - std::max(stay.from, from), 0.0) / (to - from);
    return s;
}

/// The turns of the later half that come after a way of more than a quarter of the whole swing, by turns greatest and
/// least: a mass that swings on its contact as well has small ones in between.
std::vector<Swing::Turn> Swing::large_turns() const {
    std::vector<Turn> late, large;
    for (const Turn& t : turns_)
        if (t.time >= half_time_) late.push_back(t);
    if (late.empty()) return large;
    const auto [least, greatest] = std::minmax_element(
        late.begin(), late.end(), [](const Turn& a, const Turn& b) { return a.deflection < b.deflection; });
    const double way = (greatest->deflection - least->deflection) / 4;
    for (const Turn& t : late) {
        if (large.empty()) {
            large.push_back(t);
            continue;
        }
        if (large.back().greatest == t.greatest) {
            // Another of the same kind, with nothing large in between: the farther one counts.
            if ((t.deflection > large.back().deflection) == t.greatest) large.back() = t;
        } else if (std::abs(t.deflection - large.back().deflection) > way) {
            large.push_back(t);
        }
    }
    return large;
}

}  // namespace footfall
