#include "study/timeline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <boost/math/tools/toms748_solve.hpp>
#include <fmt/format.h>

#include "footfall/math/error.hpp"

namespace footfall {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double eps = std::numeric_limits<double>::epsilon();
// Looks for zeros between kinks: in a cycle, in an interval, and at most.
constexpr double looks_per_cycle = 64, fewest_looks = 256, most_looks = 2e7;

double shortest_of(const Rig& rig) {
    double shortest = rig.pressing.shortest_period();
    const auto see = [&](const PlanePath& path) {
        for (const Path& p : path) shortest = std::min(shortest, p.shortest_period());
    };
    if (rig.drag == Drag::mass) {
        see(rig.mass.support);
        see(rig.mass.force);
        see(rig.mass.belt);
    } else {
        see(rig.dragging);
    }
    return shortest;
}

std::vector<double> kinks_of(const Rig& rig) {
    std::vector<double> kinks{0, rig.end_time};
    const auto take = [&](const Path& path) {
        const std::vector<double> breaks = path.breaks(rig.end_time);
        kinks.insert(kinks.end(), breaks.begin(), breaks.end());
    };
    const auto take_both = [&](const PlanePath& path) { std::for_each(path.begin(), path.end(), take); };
    take(rig.pressing);
    if (rig.drag == Drag::mass) {
        take_both(rig.mass.support);
        take_both(rig.mass.force);
        take_both(rig.mass.belt);
    } else {
        take_both(rig.dragging);
    }
    std::sort(kinks.begin(), kinks.end());
    const double nothing = 64 * eps * rig.end_time;
    std::erase_if(kinks, [&](double t) { return t < 0; });
    kinks.erase(std::unique(kinks.begin(), kinks.end(), [&](double a, double b) { return b - a <= nothing; }),
                kinks.end());
    kinks.back() = rig.end_time;
    return kinks;
}

Vector2<double> values(const PathValue& x, const PathValue& y) { return {x.value, y.value}; }
Vector2<double> rates(const PathValue& x, const PathValue& y) { return {x.rate, y.rate}; }
Vector2<double> accelerations(const PathValue& x, const PathValue& y) { return {x.acceleration, y.acceleration}; }

/// theta at its two ends is kept from being exactly there, so that s is never a zero in a denominator.
constexpr double least_theta = 1e-100;

}  // namespace

Timeline::Timeline(const Rig& rig, const RigLaw& law)
    : rig_(rig),
      law_(law),
      slopes_(law_.cast<Dual<double, 1>>()),
      states_(static_cast<std::size_t>(law_.states())),
      slopes_states_(states_.size()),
      shortest_period_(shortest_of(rig)) {
    plan();
}

double Timeline::elastic_force(double s) const { return law_.normal_force({s, 0, {0, 0}}, states_); }

/// Its derivative [N/m^0.5].
double Timeline::stiffness(double s) const {
    using D = Dual<double, 1>;
    if (s == last_s_) return last_stiffness_;
    last_s_ = s;
    last_stiffness_ = slopes_.normal_force({D::variable(s, 0), D(0), Vector2<D>::Zero()}, slopes_states_).gradient[0];
    return last_stiffness_;
}

/// Positive where the contact carries a load.
double Timeline::load_guard(const PathValue& depth) const {
    std::array<double, RigLaw::guards> guards{};
    const Touch<double> touch{std::sqrt(std::max(depth.value, 0.0)), depth.rate, {0, 0}};
    law_.fill_guards({Phase::slip}, touch, states_, 0, guards);
    return guards[RigLaw::load_guard];
}

double Timeline::spacing() const { return shortest_period_ / looks_per_cycle; }

/// The zeros of f between two times where it changes its sign, without the ends.
template <class F>
std::vector<double> Timeline::roots(F&& f, double from, double to) const {
    const double looks = std::clamp(std::ceil((to - from) / spacing()), fewest_looks, most_looks);
    const double nothing = 1e-13 * (to - from) + 4 * eps * to;
    std::vector<double> found;
    double before = from, f_before = f(from);
    for (double k = 1; k <= looks; ++k) {
        const double time = k < looks ? from + (to - from) * (k / looks) : to;
        const double f_time = f(time);
        if (f_time == 0 && k < looks) continue;
        if ((f_before < 0) != (f_time < 0) && f_before != 0) {
            std::uintmax_t iterations = 100;
            const auto r = boost::math::tools::toms748_solve(f, before, time, f_before, f_time,
                                                             boost::math::tools::eps_tolerance<double>(), iterations);
            const double root = (r.first + r.second) / 2;
            if (root - from > nothing && to - root > nothing) found.push_back(root);
        }
        before = time;
        f_before = f_time;
    }
    return found;
}

void Timeline::plan() {
    const std::vector<double> kinks = kinks_of(rig_);
    for (std::size_t k = 0; k + 1 < kinks.size(); ++k) {
        const double from = kinks[k], to = kinks[k + 1], inside = (from + to) / 2;
        const auto pressing = [&](double t) { return rig_.pressing.at(t, inside); };
        const double looks = std::clamp(std::ceil((to - from) / spacing()), fewest_looks, most_looks);
        double least = infinity, size = 0, most = -infinity;
        for (double i = 0; i <= looks; ++i) {
            const double value = pressing(from + (to - from) * (i / looks)).value;
            least = std::min(least, value);
            most = std::max(most, value);
            size = std::max(size, std::abs(value));
        }
        if (rig_.press == Press::load) {
            if (!(least > 0))
                throw InvalidInput(
                    fmt::format("load: {:.6g} N between {:.6g} s and {:.6g} s is not allowed: must be "
                                "> 0 all the time; lift the contact with an indentation path",
                                least, from, to));
            intervals_.push_back({from, to, Phase::slip, false, false, 0});
            largest_load_ = std::max(largest_load_, most);
            (void)static_root_depth(least);
            const double s = static_root_depth(most);
            largest_depth_ = std::max(largest_depth_, s * s);
            continue;
        }
        if (most > 0) {
            largest_depth_ = std::max(largest_depth_, most);
            largest_load_ = std::max(largest_load_, elastic_force(std::sqrt(most)));
        }
        std::vector<double> cuts = roots([&](double t) { return pressing(t).value; }, from, to);
        // Where the path turns round on the surface without passing through it, s has a kink all the same.
        for (const double t : roots([&](double time) { return pressing(time).rate; }, from, to))
            if (std::abs(pressing(t).value) <= 1e-12 * size) cuts.push_back(t);
        cuts.push_back(from);
        cuts.push_back(to);
        std::sort(cuts.begin(), cuts.end());
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i) plan_contacts(cuts[i], cuts[i + 1]);
    }
}

void Timeline::plan_contacts(double from, double to) {
    const double inside = (from + to) / 2;
    const auto depth = [&](double t) { return rig_.pressing.at(t, inside); };
    if (!(depth(inside).value > 0)) {
        intervals_.push_back({from, to, Phase::flight, false, false, 0});
        return;
    }
    const double surface = 1e-12 * depth(inside).value;
    const bool from_surface = depth(from).value <= surface, to_surface = depth(to).value <= surface;
    const double speed = depth(from).rate;
    // A law whose damping depends on the speed of impact.
    const bool lands = from_surface || intervals_.empty();
    if (lands && speed > 0) law_.land({0, speed, {0, 0}}, states_);

    const auto load = [&](double t) { return load_guard(depth(t)); };
    std::vector<double> cuts = roots(load, from, to);
    cuts.insert(cuts.begin(), from);
    cuts.push_back(to);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        const bool first = i == 0, last = i + 2 == cuts.size();
        const Phase phase = load((cuts[i] + cuts[i + 1]) / 2) > 0 ? Phase::slip : Phase::recovering;
        intervals_.push_back({cuts[i], cuts[i + 1], phase, first && from_surface, last && to_surface,
                              first && lands ? std::max(speed, 0.0) : 0});
    }
}

double Timeline::static_root_depth(double load) const {
    if (load == last_load_) return last_root_depth_;
    const auto missing = [&](double log_s) { return elastic_force(std::exp(log_s)) - load; };
    double low = -100, high = 50;
    if (!(missing(low) < 0 && missing(high) > 0)) {
        throw InvalidInput(fmt::format(
            "a load of {:.6g} N: the normal law's spring carries it at no depth from {:.0e} m to {:.0e} m; the load or "
            "the stiffness has the wrong size",
            load, std::exp(2 * low), std::exp(2 * high)));
    }
    std::uintmax_t iterations = 200;
    const auto r =
        boost::math::tools::toms748_solve(missing, low, high, boost::math::tools::eps_tolerance<double>(), iterations);
    last_load_ = load;
    last_root_depth_ = std::exp((r.first + r.second) / 2);
    return last_root_depth_;
}

Pace Timeline::pace(const Interval& interval, double theta) noexcept {
    const double length = interval.length();
    const double x = std::max(theta, least_theta), y = std::max(1 - theta, least_theta);
    if (interval.from_surface && interval.to_surface)
        return {6 * length * x * y, 6 * length * (1 - 2 * x), length * x * x * (3 - 2 * x),
                length * y * y * (3 - 2 * y)};
    if (interval.from_surface) return {2 * length * x, 2 * length, length * x * x, length * y * (1 + x)};
    if (interval.to_surface) return {2 * length * y, -2 * length, length * x * (1 + y), length * y * y};
    return {length, 0, length * x, length * y};
}

Instant Timeline::at(const Interval& interval, double theta) const {
    const double length = interval.length();
    const Pace pace = Timeline::pace(interval, theta);
    const double after = pace.after, before = pace.before;
    Instant now;
    now.time_rate = pace.rate;
    now.time_curvature = pace.curvature;
    now.time = after < before ? interval.from + after : interval.to - before;
    if (theta <= 0) now.time = interval.from;
    if (theta >= 1) now.time = interval.to;
    const double inside = (interval.from + interval.to) / 2;
    const auto look = [&](const Path& path) { return path.at(now.time, inside); };

    const PathValue press = look(rig_.pressing);
    if (rig_.press == Press::load) {
        now.s = static_root_depth(press.value);
        now.s_rate = press.rate / stiffness(now.s);
        now.depth = now.s * now.s;
        now.depth_rate = 2 * now.s * now.s_rate;
    } else {
        now.depth = press.value;
        now.depth_rate = press.rate;
        now.depth_acceleration = press.acceleration;
        if (interval.normal != Phase::flight) {
            // So near to the surface that the path's own rounding would show in the root, the depth is its Taylor
            // polynomial there.
            constexpr double near = 1e-8;
            double z = now.depth;
            if (interval.from_surface && after < near * length)
                z = after * (now.depth_rate - after * now.depth_acceleration / 2);
            else if (interval.to_surface && before < near * length)
                z = before * (-now.depth_rate - before * now.depth_acceleration / 2);
            now.s = std::sqrt(std::max(z, 1e-300));
            now.s_rate = now.depth_rate / (2 * now.s);
        }
    }
    if (rig_.drag == Drag::mass) {
        const HeldMass& m = rig_.mass;
        const PathValue support_x = look(m.support[0]), support_y = look(m.support[1]);
        const PathValue force_x = look(m.force[0]), force_y = look(m.force[1]);
        const PathValue belt_x = look(m.belt[0]), belt_y = look(m.belt[1]);
        now.support = values(support_x, support_y);
        now.support_velocity = rates(support_x, support_y);
        now.support_acceleration = accelerations(support_x, support_y);
        now.force = values(force_x, force_y);
        now.force_rate = rates(force_x, force_y);
        now.belt = values(belt_x, belt_y);
        now.belt_rate = rates(belt_x, belt_y);
    } else {
        const PathValue drag_x = look(rig_.dragging[0]), drag_y = look(rig_.dragging[1]);
        const bool velocity = rig_.drag == Drag::velocity;
        now.slip = velocity ? values(drag_x, drag_y) : rates(drag_x, drag_y);
        now.slip_rate = velocity ? rates(drag_x, drag_y) : accelerations(drag_x, drag_y);
        now.displacement = values(drag_x, drag_y);
    }
    return now;
}

double Timeline::theta_of(const Interval& interval, double time) {
    const double share = std::clamp((time - interval.from) / interval.length(), 0.0, 1.0);
    if (interval.from_surface && interval.to_surface) {
        // x^2 (3 - 2 x) = share: x = 1/2 - sin(asin(1 - 2 share) / 3)
        return std::clamp(0.5 - std::sin(std::asin(1 - 2 * share) / 3), 0.0, 1.0);
    }
    if (interval.from_surface) return std::sqrt(share);
    if (interval.to_surface) return 1 - std::sqrt(1 - share);
    return share;
}

double Timeline::longest_step(const Interval& interval) const {
    return std::min(1.0, shortest_period_ / (8 * interval.length()));
}

}  // namespace footfall
