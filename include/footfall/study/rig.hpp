// A virtual test rig: one contact, pressed and dragged along prescribed paths, or carrying a mass that is dragged.
//
// The normal direction is prescribed as an indentation z(t) or as a load F_n(t). A load is applied as slowly as the
// friction literature means it: the depth is the one at which the normal spring alone carries it, and the normal damper
// does nothing. The tangential direction is prescribed as the slip displacement or the slip velocity of the contact, or
// a mass is held by a spring and a damper to a support, driven by a force, over ground that moves like a belt.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "footfall/math/vector.hpp"
#include "footfall/study/go_on.hpp"
#include "footfall/study/table.hpp"

namespace footfall {

/// A value that does not change.
struct ConstantPart {
    double value = 0;
};

/// Zero until `start`, then linear, and `change` from start + duration on.
struct RampPart {
    double change = 0;
    double start = 0;     ///< [s], >= 0
    double duration = 1;  ///< [s], > 0
};

/// amplitude sin(2 pi frequency (t - start) + phase) for a number of cycles; before and after, its value at the ends.
struct SinePart {
    double amplitude = 0;
    double frequency = 1;                                     ///< [Hz], > 0
    double phase = 0;                                         ///< [rad]
    double start = 0;                                         ///< [s], >= 0
    double cycles = std::numeric_limits<double>::infinity();  ///< > 0; a fraction is allowed
};

/// Like a sine, but straight between its extremes: it rises from 0 at `start`.
struct TrianglePart {
    double amplitude = 0;
    double frequency = 1;                                     ///< [Hz], > 0
    double start = 0;                                         ///< [s], >= 0
    double cycles = std::numeric_limits<double>::infinity();  ///< > 0; a fraction is allowed
};

/// Straight between given points; before and after them, the value of the first and of the last.
struct TablePart {
    std::vector<double> time;   ///< [s], increasing, at least two
    std::vector<double> value;  ///< one for each time
};

using PathPart = std::variant<ConstantPart, RampPart, SinePart, TrianglePart, TablePart>;

/// A function of time and its first two derivatives, at one time.
struct PathValue {
    double value = 0, rate = 0, acceleration = 0;
};

/// A function of time: the sum of its parts. Between `breaks` it is smooth.
class Path {
public:
    Path() = default;
    Path(std::vector<PathPart> parts) : parts_(std::move(parts)) {}

    void add(PathPart part) { parts_.push_back(std::move(part)); }
    [[nodiscard]] const std::vector<PathPart>& parts() const noexcept { return parts_; }
    [[nodiscard]] bool empty() const noexcept { return parts_.empty(); }

    /// The path at `time` [s], on the smooth piece that the time `inside` lies in.
    [[nodiscard]] PathValue at(double time, double inside) const;
    [[nodiscard]] PathValue at(double time) const { return at(time, time); }
    /// Times up to `end` at which a derivative may jump, in no order [s].
    [[nodiscard]] std::vector<double> breaks(double end) const;
    /// The shortest period in it [s]; infinite where there is none.
    [[nodiscard]] double shortest_period() const noexcept;

    /// The path times a factor.
    [[nodiscard]] Path scaled(double factor) const;

private:
    std::vector<PathPart> parts_;
};

/// A path in the ground's plane, by components.
using PlanePath = std::array<Path, 2>;

/// How the contact is pressed.
enum class Press {
    indentation,  ///< the path is z [m]; negative above the ground
    load,         ///< the path is F_n [N], > 0
};

/// How the contact is dragged.
enum class Drag {
    displacement,  ///< the path is the slip displacement [m]; its rate is V_sph
    velocity,      ///< the path is the slip velocity V_sph [m/s]
    mass,          ///< a mass moves over the ground
};

/// A mass over the ground, which may move under it like a belt.
struct HeldMass {
    double mass = 0;       ///< [kg], > 0
    double stiffness = 0;  ///< of the spring to the support [N/m], >= 0
    double damping = 0;    ///< of the damper beside it [N s/m], >= 0
    PlanePath support;     ///< displacement of the spring's far end [m]
    PlanePath force;       ///< on the mass [N]
    PlanePath belt;        ///< velocity of the ground [m/s]
};

struct Rig {
    std::string title;
    double end_time = 1;       ///< [s], > 0
    double sample_period = 0;  ///< [s], > 0; 0: end_time / 1000
    double tolerance = 1e-10;  ///< relative error of a step, from 1e-14 to 1e-3
    double max_evaluations = 1e8;
    double max_memory = 4e9;  ///< what the samples and events of one run may take [bytes], >= 1
    Press press = Press::load;
    Path pressing;  ///< [m] or [N], as `press` says
    Drag drag = Drag::displacement;
    PlanePath dragging;  ///< [m] or [m/s], as `drag` says; unused with a mass
    HeldMass mass;       ///< used where `drag` says so
    GoOn go_on = nullptr;
    TableRemarks remarks;  ///< of the tables that its paths were read from

    [[nodiscard]] double period() const noexcept { return sample_period > 0 ? sample_period : end_time / 1000; }
};

/// Throws InvalidInput unless every field of the rig can be used.
void check(const Rig& rig);

}  // namespace footfall
