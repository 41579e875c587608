// The swing of a mass that is held by a spring on a moving belt: stick-slip, told from its turns.
#pragma once

#include <optional>
#include <vector>

#include "footfall/study/drive.hpp"
#include "study/driven_contact.hpp"
#include "study/timeline.hpp"

namespace footfall {

/// Watches the deflection of a held mass for its greatest and least values.
class Swing {
public:
    Swing(const Rig& rig, const Timeline& timeline);

    /// There is something to watch: a mass on a spring, and a belt or support that moves at the end.
    [[nodiscard]] bool watches() const noexcept { return speed_ > 0; }
    /// How fast the mass moves along the belt's way relative to the support [m/s].
    [[nodiscard]] double rate(const DrivenState& y, const Instant& now) const;
    /// How far it is along that way from the support [m].
    [[nodiscard]] double deflection(const DrivenState& y, const Instant& now) const;
    /// The deflection has turned at a greatest or least value.
    void turn(double time, double deflection, bool greatest) { turns_.push_back({time, deflection, greatest}); }

    /// Between the first and the last greatest deflection of the later half; empty where it does not swing.
    [[nodiscard]] std::optional<StickSlip> result(const std::vector<RigState>& samples) const;

private:
    struct Turn {
        double time, deflection;
        bool greatest;
    };
    [[nodiscard]] std::vector<Turn> large_turns() const;

    double half_time_;
    double speed_ = 0;
    Eigen::Vector2d along_{0, 0};
    std::vector<Turn> turns_;
};

}  // namespace footfall
