// The swing of a mass that is held by a spring on a moving belt: stick-slip, told from its turns.
#pragma once

#include <optional>
#include <vector>

#include "footfall/study/drive.hpp"
#include "study/timeline.hpp"

namespace footfall {

/// Watches the deflection of a held mass for its greatest and least values.
class Swing {
public:
    Swing(const Rig& rig, const Timeline& timeline);

    /// There is something to watch: a mass on a spring, and a belt or support that moves at the end.
    [[nodiscard]] bool watches() const noexcept { return speed_ > 0; }
    /// How fast the mass moves along the belt's way relative to the support [m/s].
    [[nodiscard]] double rate(const Vector2<double>& velocity, const Instant& now) const {
        return along_.dot(velocity - now.support_velocity);
    }
    /// How far it is along that way from the support [m].
    [[nodiscard]] double deflection(const Vector2<double>& position, const Instant& now) const {
        return along_.dot(position - now.support);
    }
    /// The deflection has turned at a greatest or least value.
    void turn(double time, double deflection, bool greatest) { turns_.push_back({time, deflection, greatest}); }

    /// The slip velocity below which a mass goes with the belt, under a law that does not say when it sticks [m/s].
    [[nodiscard]] double slow() const noexcept { return slow_share * speed_; }
    /// It goes with the belt from one time to another [s]; told in order.
    void with_belt(double from, double to);

    /// Between the first and the last greatest deflection of the later half; empty where it does not swing.
    [[nodiscard]] std::optional<StickSlip> result() const;

private:
    struct Turn {
        double time, deflection;
        bool greatest;
    };
    struct Stay {
        double from, to;  // [s]
    };
    static constexpr double slow_share = 0.01;

    [[nodiscard]] std::vector<Turn> large_turns() const;

    double half_time_;
    double speed_ = 0;
    Vector2<double> along_{0, 0};
    std::vector<Turn> turns_;
    std::vector<Stay> stays_;
};

}  // namespace footfall
