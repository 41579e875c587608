// The paths of a test rig.
#include "footfall/study/rig.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

#include <fmt/format.h>

#include "footfall/math/error.hpp"

namespace footfall {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double turn = 2 * std::numbers::pi;
constexpr double most_breaks = 1e6;

double end_of(double start, double cycles, double frequency) { return start + cycles / frequency; }

PathValue at(const ConstantPart& p, double, double) { return {p.value, 0, 0}; }

PathValue at(const RampPart& p, double time, double inside) {
    if (inside < p.start) return {};
    if (inside >= p.start + p.duration) return {p.change, 0, 0};
    return {p.change * ((time - p.start) / p.duration), p.change / p.duration, 0};
}

PathValue at(const SinePart& p, double time, double inside) {
    const double last = end_of(p.start, p.cycles, p.frequency);
    if (inside < p.start) return {p.amplitude * std::sin(p.phase), 0, 0};
    if (inside >= last) return {p.amplitude * std::sin(turn * p.cycles + p.phase), 0, 0};
    const double w = turn * p.frequency, angle = w * (time - p.start) + p.phase;
    return {p.amplitude * std::sin(angle), p.amplitude * w * std::cos(angle), -p.amplitude * w * w * std::sin(angle)};
}

/// The triangle after a number of cycles: the straight piece k, between its extremes at (k - 1/2)/2 and (k + 1/2)/2
/// cycles.
double triangle(double cycles, double piece) { return (std::fmod(piece, 2) == 0 ? 1 : -1) * 4 * (cycles - piece / 2); }

PathValue at(const TrianglePart& p, double time, double inside) {
    const double last = end_of(p.start, p.cycles, p.frequency);
    if (inside < p.start) return {};
    const auto piece_of = [](double cycles) { return std::floor(2 * cycles + 0.5); };
    if (inside >= last) return {p.amplitude * triangle(p.cycles, piece_of(p.cycles)), 0, 0};
    const double piece = piece_of(p.frequency * (inside - p.start));
    const double slope = (std::fmod(piece, 2) == 0 ? 4 : -4) * p.amplitude * p.frequency;
    return {p.amplitude * triangle(p.frequency * (time - p.start), piece), slope, 0};
}

PathValue at(const TablePart& p, double time, double inside) {
    if (inside < p.time.front()) return {p.value.front(), 0, 0};
    if (inside >= p.time.back()) return {p.value.back(), 0, 0};
    const auto after = std::upper_bound(p.time.begin(), p.time.end(), inside);
    const auto k = static_cast<std::size_t>(after - p.time.begin());
    const double slope = (p.value[k] - p.value[k - 1]) / (p.time[k] - p.time[k - 1]);
    return {p.value[k - 1] + slope * (time - p.time[k - 1]), slope, 0};
}

void add_breaks(const ConstantPart&, double, std::vector<double>&) {}
void add_breaks(const RampPart& p, double, std::vector<double>& breaks) {
    breaks.insert(breaks.end(), {p.start, p.start + p.duration});
}
void add_breaks(const SinePart& p, double, std::vector<double>& breaks) {
    breaks.insert(breaks.end(), {p.start, end_of(p.start, p.cycles, p.frequency)});
}
void add_breaks(const TrianglePart& p, double end, std::vector<double>& breaks) {
    const double last = end_of(p.start, p.cycles, p.frequency);
    breaks.insert(breaks.end(), {p.start, last});
    for (double k = 0;; ++k) {
        const double time = p.start + (2 * k + 1) / (4 * p.frequency);
        if (!(time < std::min(last, end))) return;
        breaks.push_back(time);
    }
}
void add_breaks(const TablePart& p, double, std::vector<double>& breaks) {
    breaks.insert(breaks.end(), p.time.begin(), p.time.end());
}

double period_of(const PathPart& part) {
    return std::visit(
        [](const auto& p) {
            if constexpr (requires { p.frequency; }) return 1 / p.frequency;
            return infinity;
        },
        part);
}

void require(bool good, const std::string& what, double value, std::string_view allowed) {
    if (!good) throw InvalidInput(fmt::format("{}: {:.6g} is not allowed: must be {}", what, value, allowed));
}

void check_start(double start, const std::string& who) {
    require(start >= 0 && std::isfinite(start), who + ": start", start, "finite and >= 0");
}

void check_part(const ConstantPart& p, const std::string& who, double /*end*/) {
    require(std::isfinite(p.value), who + ": value", p.value, "finite");
}
void check_part(const RampPart& p, const std::string& who, double /*end*/) {
    check_start(p.start, who);
    require(std::isfinite(p.change), who + ": change", p.change, "finite");
    require(p.duration > 0 && std::isfinite(p.duration), who + ": duration", p.duration, "finite and > 0");
}
/// What a sine and a triangle have in common.
template <class Wave>
void check_wave(const Wave& p, const std::string& who, double end) {
    check_start(p.start, who);
    require(std::isfinite(p.amplitude), who + ": amplitude", p.amplitude, "finite");
    require(p.frequency > 0 && std::isfinite(p.frequency), who + ": frequency", p.frequency, "finite and > 0");
    require(p.cycles > 0, who + ": cycles", p.cycles, "> 0");
    require(p.frequency * end < most_breaks, who + ": frequency", p.frequency,
            fmt::format("below {:.3g}, so that the run has fewer than {:.0e} cycles", most_breaks / end, most_breaks));
}
void check_part(const SinePart& p, const std::string& who, double end) {
    check_wave(p, who, end);
    require(std::isfinite(p.phase), who + ": phase", p.phase, "finite");
}
void check_part(const TrianglePart& p, const std::string& who, double end) { check_wave(p, who, end); }
void check_part(const TablePart& p, const std::string& who, double /*end*/) {
    if (p.time.size() != p.value.size())
        throw InvalidInput(fmt::format("{}: a table has {} times and {} values", who, p.time.size(), p.value.size()));
    if (p.time.size() < 2) throw InvalidInput(who + ": a table needs at least two points");
    for (std::size_t k = 0; k < p.time.size(); ++k) {
        require(std::isfinite(p.time[k]) && (k == 0 || p.time[k] > p.time[k - 1]), who + ": time", p.time[k],
                "finite and after the one before it");
        require(std::isfinite(p.value[k]), who + ": value", p.value[k], "finite");
    }
}

void check_path(const Path& path, const std::string& who, double end) {
    for (const PathPart& part : path.parts()) std::visit([&](const auto& p) { check_part(p, who, end); }, part);
}
void check_path(const PlanePath& path, const std::string& who, double end) {
    for (const Path& component : path) check_path(component, who, end);
}

}  // namespace

PathValue Path::at(double time, double inside) const {
    PathValue sum;
    for (const PathPart& part : parts_) {
        const PathValue v = std::visit([&](const auto& p) { return footfall::at(p, time, inside); }, part);
        sum.value += v.value;
        sum.rate += v.rate;
        sum.acceleration += v.acceleration;
    }
    return sum;
}

std::vector<double> Path::breaks(double end) const {
    std::vector<double> all;
    for (const PathPart& part : parts_) std::visit([&](const auto& p) { add_breaks(p, end, all); }, part);
    std::erase_if(all, [&](double time) { return !(time <= end); });
    return all;
}

double Path::shortest_period() const noexcept {
    double shortest = infinity;
    for (const PathPart& part : parts_) shortest = std::min(shortest, period_of(part));
    return shortest;
}

Path Path::scaled(double factor) const {
    Path result = *this;
    for (PathPart& part : result.parts_)
        std::visit(
            [&]<class Part>(Part& p) {
                if constexpr (std::is_same_v<Part, ConstantPart>) {
                    p.value *= factor;
                } else if constexpr (std::is_same_v<Part, RampPart>) {
                    p.change *= factor;
                } else if constexpr (std::is_same_v<Part, TablePart>) {
                    for (double& value : p.value) value *= factor;
                } else {
                    p.amplitude *= factor;
                }
            },
            part);
    return result;
}

void check(const Rig& rig) {
    require(rig.end_time > 0 && std::isfinite(rig.end_time), "end", rig.end_time, "finite and > 0");
    require(rig.sample_period >= 0 && std::isfinite(rig.sample_period), "sample", rig.sample_period, "finite and >= 0");
    require(rig.tolerance >= 1e-14 && rig.tolerance <= 1e-3, "tolerance", rig.tolerance, "from 1e-14 to 1e-3");
    require(rig.max_evaluations >= 1, "max_evaluations", rig.max_evaluations, ">= 1");
    require(rig.max_memory >= 1, "max_memory", rig.max_memory, ">= 1 byte");
    check_path(rig.pressing, rig.press == Press::load ? "load" : "indentation", rig.end_time);
    if (rig.drag != Drag::mass) {
        check_path(rig.dragging, rig.drag == Drag::velocity ? "velocity" : "displacement", rig.end_time);
        return;
    }
    const HeldMass& m = rig.mass;
    require(m.mass > 0 && std::isfinite(m.mass), "mass", m.mass, "finite and > 0");
    require(m.stiffness >= 0 && std::isfinite(m.stiffness), "mass: stiffness", m.stiffness, "finite and >= 0");
    require(m.damping >= 0 && std::isfinite(m.damping), "mass: damping", m.damping, "finite and >= 0");
    check_path(m.support, "support", rig.end_time);
    check_path(m.force, "force", rig.end_time);
    check_path(m.belt, "belt", rig.end_time);
}

}  // namespace footfall
