// What a run's tables hold: the name, unit and meaning of every quantity, said once for NetCDF and CSV.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "footfall/energy/ledger.hpp"
#include "footfall/simulate/run.hpp"

namespace footfall::columns {

inline constexpr std::array<std::string_view, 3> axis_labels{"x", "y", "z"};
inline constexpr std::array<std::string_view, 4> quaternion_labels{"w", "x", "y", "z"};

inline constexpr std::array phases{Phase::flight, Phase::stick, Phase::slip, Phase::recovering};
inline constexpr std::array event_kinds{EventKind::touchdown, EventKind::stick, EventKind::slip, EventKind::separation,
                                        EventKind::recovered};

/// How many numbers a quantity has.
enum class Shape { scalar, vector, quaternion };

[[nodiscard]] constexpr std::span<const std::string_view> labels(Shape shape) noexcept {
    if (shape == Shape::vector) return axis_labels;
    if (shape == Shape::quaternion) return quaternion_labels;
    return {};
}
[[nodiscard]] constexpr std::size_t size(Shape shape) noexcept {
    return shape == Shape::scalar ? 1 : labels(shape).size();
}

/// One quantity of an `Of`.
template <class Of>
struct Column {
    std::string_view name;
    std::string_view unit;  ///< as UDUNITS reads it; "1" where there is none
    std::string_view long_name;
    Shape shape;
    void (*read)(const Of&, double* out);  ///< writes size(shape) numbers
};

inline void put(const Eigen::Vector3d& v, double* out) noexcept { out[0] = v.x(), out[1] = v.y(), out[2] = v.z(); }

/// NaN stands for what has not happened.
[[nodiscard]] inline double or_nan(const std::optional<double>& value) noexcept {
    return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

inline constexpr std::array body{
    Column<BodyState>{"position", "m", "position of the centre of mass, world frame", Shape::vector,
                      [](const BodyState& b, double* out) { put(b.position, out); }},
    Column<BodyState>{"velocity", "m/s", "velocity of the centre of mass, world frame", Shape::vector,
                      [](const BodyState& b, double* out) { put(b.velocity, out); }},
    Column<BodyState>{"orientation", "1", "orientation, unit quaternion from the body's frame to the world's",
                      Shape::quaternion,
                      [](const BodyState& b, double* out) {
                          const Eigen::Quaterniond& q = b.orientation;
                          out[0] = q.w(), out[1] = q.x(), out[2] = q.y(), out[3] = q.z();
                      }},
    Column<BodyState>{"angular_velocity", "rad/s", "angular velocity, world frame", Shape::vector,
                      [](const BodyState& b, double* out) { put(b.angular_velocity, out); }},
};

inline constexpr std::array contact{
    Column<ContactSnapshot>{"depth", "m", "indentation of the ground; negative in flight: minus the gap", Shape::scalar,
                            [](const ContactSnapshot& c, double* out) { *out = c.depth; }},
    Column<ContactSnapshot>{"depth_rate", "m/s", "rate of indentation; positive while loading", Shape::scalar,
                            [](const ContactSnapshot& c, double* out) { *out = c.depth_rate; }},
    Column<ContactSnapshot>{"normal_force", "N", "normal force on the body, along the ground's normal", Shape::scalar,
                            [](const ContactSnapshot& c, double* out) { *out = c.normal_force; }},
    Column<ContactSnapshot>{"friction_force", "N", "friction force on the body, world frame", Shape::vector,
                            [](const ContactSnapshot& c, double* out) { put(c.friction_force, out); }},
    Column<ContactSnapshot>{"slip_velocity", "m/s",
                            "velocity of the sphere's bottom point in the ground's plane, world frame", Shape::vector,
                            [](const ContactSnapshot& c, double* out) { put(c.slip_velocity, out); }},
    Column<ContactSnapshot>{"bristle", "m", "tangential deformation of the ground, world frame", Shape::vector,
                            [](const ContactSnapshot& c, double* out) { put(c.bristle, out); }},
};

template <const auto& channels, std::size_t i, class Of>
void read_channel(const Of& energy, double* out) {
    *out = energy.*channels[i].member;
}

/// The energies of a contact: its channels, and the sums that stand behind them.
inline constexpr auto contact_energy = []<std::size_t... i, std::size_t... k>(std::index_sequence<i...>,
                                                                              std::index_sequence<k...>) {
    return std::array{
        Column<ContactEnergy>{contact_channels[i].name, contact_channels[i].unit, contact_channels[i].description,
                              Shape::scalar, &read_channel<contact_channels, i, ContactEnergy>}...,
        Column<ContactEnergy>{contact_sums[k].name, contact_sums[k].unit, contact_sums[k].description, Shape::scalar,
                              [](const ContactEnergy& e, double* out) { *out = (e.*contact_sums[k].value)(); }}...};
}(std::make_index_sequence<contact_channels.size()>(), std::make_index_sequence<contact_sums.size()>());

/// Of the whole ledger; the sums of `contact_energy` over the spheres stand beside them.
inline constexpr auto body_energy = []<std::size_t... i>(std::index_sequence<i...>) {
    return std::array{Column<Ledger>{body_channels[i].name, body_channels[i].unit, body_channels[i].brief,
                                     Shape::scalar, &read_channel<body_channels, i, Ledger>}...};
}(std::make_index_sequence<body_channels.size()>());

inline constexpr std::array impact{
    Column<Impact>{"touchdown", "s", "time of touchdown", Shape::scalar,
                   [](const Impact& i, double* out) { *out = i.touchdown; }},
    Column<Impact>{"separation", "s", "last time before recovery that the normal force reached zero", Shape::scalar,
                   [](const Impact& i, double* out) { *out = or_nan(i.separation); }},
    Column<Impact>{"recovered", "s", "time at which the indentation returned to zero", Shape::scalar,
                   [](const Impact& i, double* out) { *out = or_nan(i.recovered); }},
    Column<Impact>{"speed_in", "m/s", "speed into the ground at touchdown", Shape::scalar,
                   [](const Impact& i, double* out) { *out = i.speed_in; }},
    Column<Impact>{"speed_out", "m/s", "speed out of the ground at recovery", Shape::scalar,
                   [](const Impact& i, double* out) { *out = or_nan(i.speed_out); }},
    Column<Impact>{"restitution", "1", "speed_out / speed_in", Shape::scalar,
                   [](const Impact& i, double* out) { *out = or_nan(i.restitution()); }},
    Column<Impact>{"peak_normal_force", "N", "largest normal force", Shape::scalar,
                   [](const Impact& i, double* out) { *out = i.peak_normal_force; }},
    Column<Impact>{"peak_indentation", "m", "largest indentation", Shape::scalar,
                   [](const Impact& i, double* out) { *out = i.peak_indentation; }},
    Column<Impact>{"stick_time", "s", "time spent sticking", Shape::scalar,
                   [](const Impact& i, double* out) { *out = i.stick_time; }},
};

/// (total - initial total) / energy_scale.
[[nodiscard]] inline double residual(const Run& run, const Ledger& ledger) noexcept {
    return run.energy_scale > 0 ? (ledger.total() - run.initial.ledger.total()) / run.energy_scale : 0;
}

}  // namespace footfall::columns
