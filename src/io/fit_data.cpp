// Measurements from a table: which of its columns are what, and what the fit wants made of them.
#include "footfall/io/fit_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "io/nearest.hpp"
#include "io/read.hpp"
#include "io/table_reader.hpp"

namespace footfall {
namespace {

using io::Sought;

// The file ------------------------------------------------------------------------------------------------------------

/// The quantities that measurements may be made of.
enum Name : std::size_t {
    speed,
    restitution,
    speed_out,
    drop_height,
    rebound_height,
    bounce_time,
    flight_time,
    indentation,
    rate,
    time,
    force,
    sigma,
};

// What no sphere does in a laboratory: a number beyond it without a unit was meant in another one.
constexpr double fast = 100;         // m/s
constexpr double deep = 0.1;         // m
constexpr double long_contact = 10;  // s
constexpr double high = 10;          // m

const std::vector<Sought> quantities{
    {.name = "speed",
     .unit = "m/s",
     .names = {"v",
               "V",
               "velocity",
               "v_in",
               "vin",
               "v_i",
               "v_0",
               "v0",
               "v_1",
               "v1",
               "v_n",
               "vn",
               "v_before",
               "v_impact",
               "impact_velocity",
               "speed_in",
               "velocity_in",
               "impact_speed",
               "approach_speed",
               "approach_velocity",
               "normal_speed",
               "normal_velocity",
               "initial_speed",
               "initial_velocity",
               "incident_speed",
               "incident_velocity",
               "incoming_speed",
               "incoming_velocity",
               "inbound_speed",
               "inbound_velocity",
               "speed_before",
               "velocity_before",
               "touchdown_speed",
               "touchdown_velocity"},
     .range = io::positive,
     .plausible = fast},
    {.name = "restitution",
     .names = {"e", "e_n", "en", "cor", "coefficient_of_restitution", "restitution_coefficient", "coeff_of_restitution",
               "coef_of_restitution", "normal_restitution"},
     .range = {0, 1}},
    {.name = "speed_out",
     .unit = "m/s",
     .names = {"v_out",
               "vout",
               "v_r",
               "vr",
               "v_f",
               "v_2",
               "v2",
               "v_after",
               "v_rebound",
               "velocity_out",
               "rebound_speed",
               "rebound_velocity",
               "speed_after",
               "velocity_after",
               "exit_speed",
               "exit_velocity",
               "final_speed",
               "final_velocity",
               "outgoing_speed",
               "outgoing_velocity",
               "outbound_speed",
               "outbound_velocity",
               "separation_speed",
               "separation_velocity"},
     .range = io::not_negative,
     .plausible = fast},
    {.name = "drop_height",
     .unit = "m",
     .names = {"height", "h", "h_0", "h0", "h_drop", "fall_height", "release_height", "initial_height"},
     .range = io::positive,
     .plausible = high},
    {.name = "rebound_height",
     .unit = "m",
     .names = {"h_r", "hr", "h_rebound", "h_bounce", "rebound", "bounce_height", "return_height"},
     .range = io::not_negative,
     .plausible = high},
    {.name = "bounce_time",
     .unit = "s",
     .names = {"bounce_times", "time_of_bounce", "t_bounce"},
     .order = Sought::Order::rising},
    {.name = "flight_time",
     .unit = "s",
     .names = {"flight_times", "time_of_flight", "t_flight", "time_between_bounces", "flight_duration"},
     .range = io::positive},
    {.name = "indentation",
     .unit = "m",
     .names = {"z", "depth", "delta", "δ", "displacement", "disp", "normal_disp", "normal_displacement", "penetration",
               "penetration_depth", "indentation_depth", "compression", "deformation", "deflection", "overlap",
               "stroke"},
     .plausible = deep},
    {.name = "rate",
     .unit = "m/s",
     .names = {"indentation_rate", "depth_rate", "penetration_rate", "compression_rate", "deformation_rate", "zdot"}},
    {.name = "time",
     .unit = "s",
     .names = {"t", "elapsed", "elapsed_time", "timestamp"},
     .order = Sought::Order::not_falling,
     .plausible = long_contact},
    {.name = "force",
     .unit = "N",
     .names = {"F", "f", "f_n", "fn", "load", "normal_force", "normal_load", "contact_force", "impact_force",
               "axial_force", "axial_load"}},
    {.name = "sigma",
     .unit = "",
     .names = {"σ", "sd", "std", "stdev", "stddev", "std_dev", "standard_deviation", "uncertainty"},
     .range = io::positive},
};

constexpr std::string_view what_is_needed =
    "needed are speed and restitution, or indentation and force, or time and force";

/// One way in which a table can say what it measures.
struct Way {
    Measured kind;
    std::vector<Name> columns;
};

// In the order of preference: what is measured directly comes first.
const std::vector<Way>& ways() {
    static const std::vector<Way> all{{Measured::restitution, {speed, restitution}},
                                      {Measured::restitution, {speed, speed_out}},
                                      {Measured::restitution, {drop_height, restitution}},
                                      {Measured::restitution, {drop_height, rebound_height}},
                                      {Measured::restitution, {speed, rebound_height}},
                                      {Measured::restitution, {drop_height, speed_out}},
                                      {Measured::restitution, {bounce_time}},
                                      {Measured::restitution, {flight_time}},
                                      {Measured::force_indentation, {indentation, force}},
                                      {Measured::force_time, {time, force}}};
    return all;
}

class Reader {
public:
    Reader(std::string_view text, const std::string& name, const FitInput& input)
        : input_(input), table_(std::string(text), name, quantities, input, what_is_needed), name_(name) {}

    FitData read() {
        const Way& way = choose();
        data_.source = name_;
        data_.kind = way.kind;
        // The standard deviation has the unit of what it belongs to.
        table_.set_unit(sigma, way.kind == Measured::restitution ? "1" : "N");
        std::vector<std::size_t> used(way.columns.begin(), way.columns.end());
        if (way.kind == Measured::force_indentation && table_.has(rate)) used.push_back(rate);
        const bool weighted = table_.has(sigma) && way.columns.size() > 1;
        if (weighted) used.push_back(sigma);
        // A standard deviation that has no unit of its own is in that of its column.
        if (way.columns.size() > 1) table_.share_unit(sigma, way.columns[1]);
        if (way.columns.size() == 1) {
            table_.keep_all_rows(
                "bad rows of successive bounces cannot be left out: without one, two flights would be one");
        }
        std::vector<std::vector<double>> values = table_.read(used, check_of(way));
        if (weighted) {
            data_.sigma = std::move(values.back());
            values.pop_back();
        }
        if (way.columns.size() == 1) {
            from_bounces(way.columns.front(), values.front());
        } else if (way.kind == Measured::restitution) {
            from_impacts(way, values);
        } else {
            data_.x = std::move(values[0]);
            data_.y = std::move(values[1]);
            if (values.size() > 2) data_.rate = std::move(values[2]);
        }
        note_formulas(way);
        data_.remarks = std::move(table_.remarks());
        return std::move(data_);
    }

private:
    /// What the columns measure, and by which of them.
    const Way& choose() {
        std::vector<const Way*> fitting;
        std::vector<std::string> kinds;
        for (const Way& way : ways()) {
            const auto there = [&](Name name) { return table_.has(name); };
            if (input_.kind && way.kind != *input_.kind) continue;
            if (!std::all_of(way.columns.begin(), way.columns.end(), there)) continue;
            // Where there is a speed or a height, a time alone says nothing of restitution.
            const std::array others{speed, restitution, speed_out, drop_height, rebound_height};
            if (way.columns.size() == 1 && std::any_of(others.begin(), others.end(), there)) continue;
            if (fitting.empty() || fitting.back()->kind != way.kind) kinds.emplace_back(name_of(way.kind));
            fitting.push_back(&way);
        }
        if (fitting.empty()) {
            table_.refuse_header(fmt::format(
                "the columns do not fit together{}: {}; or speeds before and after, drop and rebound heights, or times "
                "of bounces. --column NAME=COLUMN says which column is one of these (docs/tables.md has all names)",
                input_.kind ? fmt::format(" for {} data", name_of(*input_.kind)) : "", what_is_needed));
        }
        if (kinds.size() > 1) {
            table_.refuse_header(fmt::format(
                "the columns can be read in more than one way: choose with --kind, one of {}", io::listed(kinds)));
        }
        return *fitting.front();
    }

    /// Of a column that is a speed, or a height that is fallen or reached: v = sqrt(2 g h).
    [[nodiscard]] double speed_of(Name column, double value) const {
        const bool height = column == drop_height || column == rebound_height;
        return height ? std::sqrt(2 * input_.gravity * value) : value;
    }

    /// Of a row of impacts: a quantity before and one after, or restitution itself.
    [[nodiscard]] double restitution_of(const Way& way, std::span<const double> row) const {
        if (way.columns[1] == restitution) return row[1];
        return speed_of(way.columns[1], row[1]) / speed_of(way.columns[0], row[0]);
    }

    [[nodiscard]] io::RowCheck check_of(const Way& way) const {
        if (way.kind != Measured::restitution || way.columns.size() < 2) return {};
        return [this, &way](std::span<const double> row) -> std::optional<std::string> {
            const double e = restitution_of(way, row);
            if (e <= 1) return std::nullopt;
            return fmt::format("restitution is {:.4g}, from {} {:g} and {} {:g}; allowed is from 0 to 1", e,
                               quantities[way.columns[0]].name, row[0], quantities[way.columns[1]].name, row[1]);
        };
    }

    void from_impacts(const Way& way, const std::vector<std::vector<double>>& values) {
        for (std::size_t i = 0; i < values[0].size(); ++i) {
            data_.x.push_back(speed_of(way.columns[0], values[0][i]));
            data_.y.push_back(restitution_of(way, std::array{values[0][i], values[1][i]}));
        }
    }

    /// Between bounces the ball flies for T: it leaves, and comes back, at g T/2.
    void from_bounces(Name column, std::vector<double> values) {
        if (column == bounce_time) {
            std::adjacent_difference(values.begin(), values.end(), values.begin());
            values.erase(values.begin());
        }
        if (values.size() < 2)
            throw InvalidInput(
                fmt::format("{}: there must be two flights at least, between three bounces; each bounce between two "
                            "flights gives one restitution",
                            name_));
        for (std::size_t i = 1; i < values.size(); ++i) {
            const double before = values[i - 1], after = values[i];
            if (after > before) {
                throw InvalidInput(
                    fmt::format("{}: flight {} lasts {:g} s, longer than the {:g} s of the one before it: each must be "
                                "shorter than "
                                "the last; the bounces of one ball, from one drop, are wanted",
                                name_, i + 1, after, before));
            }
            data_.x.push_back(input_.gravity * before / 2);
            data_.y.push_back(after / before);
        }
    }

    void note_formulas(const Way& way) {
        if (way.kind != Measured::restitution) return;
        const auto has = [&way](Name name) {
            return std::find(way.columns.begin(), way.columns.end(), name) != way.columns.end();
        };
        std::string formula;
        if (has(drop_height) || has(rebound_height)) formula = "speeds are sqrt(2 g height)";
        if (way.columns.size() == 1) formula = "speeds are g/2 times the times of flight";
        if (formula.empty()) return;
        table_.remarks().notes.push_back(fmt::format("Computed: {}, with g = {:g} m/s^2.", formula, input_.gravity));
    }

    const FitInput& input_;
    io::TableReader table_;
    std::string name_;
    FitData data_;
};

}  // namespace

FitData load_fit_data(const std::filesystem::path& file, const FitInput& input) {
    return parse_fit_data(io::read_file(file), file.string(), input);
}

FitData parse_fit_data(std::string_view text, const std::string& name, const FitInput& input) {
    if (!(std::isfinite(input.gravity) && input.gravity > 0))
        throw InvalidInput(fmt::format("gravity: {} m/s^2 is not allowed: must be > 0 and finite", input.gravity));
    return Reader(text, name, input).read();
}

}  // namespace footfall
