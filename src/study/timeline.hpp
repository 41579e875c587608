// What a rig prescribes at every moment, cut into intervals in which all of it is smooth.
//
// The normal direction is known beforehand, so touchdown, separation and lift-off are known too: they are ends of
// intervals, as are the kinks of the paths. Only stick and slip are left to be found while integrating.
//
// In an interval from a to b the independent variable is theta, from 0 to 1. Where the contact begins or ends at z = 0
// the force starts or ends as the root of the time, so there t = a + (b - a) theta^2 or its mirror image, and
// s = sqrt(z) is smooth in theta.
#pragma once

#include <utility>
#include <vector>

#include "footfall/law/phase.hpp"
#include "footfall/math/dual.hpp"
#include "footfall/math/vector.hpp"
#include "footfall/study/rig.hpp"
#include "study/rig_law.hpp"

namespace footfall {

struct Interval {
    double from = 0, to = 0;       ///< [s]
    Phase normal = Phase::flight;  ///< flight, recovering, or slip for a contact that carries a load
    bool from_surface = false;     ///< z = 0 at `from`, and a contact begins there
    bool to_surface = false;       ///< z = 0 at `to`, and a contact ends there
    double touchdown_speed = 0;    ///< zdot where from_surface [m/s]

    [[nodiscard]] double length() const noexcept { return to - from; }
};

/// All that is prescribed at one moment; rates are with respect to time.
struct Instant {
    double time = 0;
    double time_rate = 0;       ///< dt/dtheta
    double time_curvature = 0;  ///< d2t/dtheta2
    double s = 0, s_rate = 0;   ///< sqrt(z), zdot / (2 s); zero in flight
    double depth = 0, depth_rate = 0, depth_acceleration = 0;
    Vector2<double> slip{0, 0}, slip_rate{0, 0};  ///< V_sph where it is prescribed
    Vector2<double> displacement{0, 0};           ///< where it is prescribed
    Vector2<double> support{0, 0}, support_velocity{0, 0}, support_acceleration{0, 0};
    Vector2<double> force{0, 0}, force_rate{0, 0};
    Vector2<double> belt{0, 0}, belt_rate{0, 0};
};

/// Of theta against time: dt/dtheta and d2t/dtheta2 [s], and the time from and to the interval's ends [s].
struct Pace {
    double rate = 0, curvature = 0;
    double after = 0, before = 0;
};

class Timeline {
public:
    /// Throws InvalidInput where a load is not above zero all the time.
    Timeline(const Rig& rig, const RigLaw& law);

    [[nodiscard]] const std::vector<Interval>& intervals() const noexcept { return intervals_; }
    [[nodiscard]] Instant at(const Interval& interval, double theta) const;
    [[nodiscard]] static Pace pace(const Interval& interval, double theta) noexcept;
    /// theta at a time in the interval.
    [[nodiscard]] static double theta_of(const Interval& interval, double time);
    /// The longest step in theta that sees every cycle of the paths.
    [[nodiscard]] double longest_step(const Interval& interval) const;

    /// The largest depth [m], elastic force [N] and displacement or way of the drive [m] that the rig prescribes.
    [[nodiscard]] double largest_depth() const noexcept { return largest_depth_; }
    [[nodiscard]] double largest_load() const noexcept { return largest_load_; }

private:
    void plan();
    void plan_contacts(double from, double to);
    [[nodiscard]] double static_root_depth(double load) const;
    [[nodiscard]] double elastic_force(double s) const;
    [[nodiscard]] double stiffness(double s) const;
    [[nodiscard]] double load_guard(const PathValue& depth) const;
    [[nodiscard]] double spacing() const;
    template <class F>
    [[nodiscard]] std::vector<double> roots(F&& f, double from, double to) const;

    const Rig& rig_;
    RigLaw law_;
    decltype(std::declval<RigLaw>().cast<Dual<double, 1>>()) slopes_;
    std::vector<double> states_;                  // of the law, as an impact leaves them
    std::vector<Dual<double, 1>> slopes_states_;  // as a contact begins that is never without load
    double shortest_period_;
    std::vector<Interval> intervals_;
    double largest_depth_ = 0, largest_load_ = 0;
    mutable double last_load_ = 0, last_root_depth_ = 0;
    mutable double last_s_ = 0, last_stiffness_ = 0;
};

}  // namespace footfall
