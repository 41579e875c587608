// A measured curve of oblique impacts from a table.
#include "footfall/io/oblique_data.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "io/nearest.hpp"
#include "io/read.hpp"
#include "io/table_reader.hpp"

namespace footfall {
namespace {

using io::Sought;

constexpr double degree = std::numbers::pi / 180;

// The columns that say how a sphere came in, then psi2 and scaled_spin_after, then those of oblique_table.
enum Name : std::size_t { angle, spin, psi1, spin_ratio, psi2, scaled_spin_after, first_observable };

constexpr std::string_view what_is_needed = "needed are angle, spin or both, and one measured column";

/// Well-known names of what is measured of an impact.
std::vector<std::string_view> names_of(std::string_view observable) {
    if (observable == "normal_restitution") return {"e", "e_n", "en", "cor", "restitution"};
    if (observable == "tangential_restitution")
        return {"e_t", "et", "tangential_restitution_of_centre", "tangential_restitution_of_center"};
    if (observable == "contact_restitution") return {"beta", "β"};
    if (observable == "rebound_angle") return {"rebound_centre", "rebound_center", "rebound_angle_of_centre"};
    if (observable == "contact_rebound_angle") return {"rebound", "rebound_angle_of_contact_point"};
    if (observable == "spin_after")
        return {"omega", "ω", "final_omega", "omega_out", "omega_after", "final_spin", "rebound_spin", "spin_out"};
    return {};
}

std::vector<Sought> quantities() {
    std::vector<Sought> all{
        {.name = "angle",
         .unit = "deg",
         .names = {"theta", "θ", "incident", "incidence", "incident_angle", "incidence_angle", "impact_angle",
                   "angle_of_incidence"},
         .range = {0, 90, false, true},
         .hardly = 1.6},  // a right angle in radians
        {.name = "spin",
         .unit = "rad/s",
         .names = {"spin_in", "spin_before", "initial_spin", "omega_in", "omega_before", "omega_0"}},
        {.name = "psi1", .names = {"psi_1", "vst_over_muvcn"}, .range = io::not_negative},
        {.name = "spin_ratio", .names = {"s"}, .range = io::positive},
        {.name = "psi2", .names = {"psi_2"}},
        {.name = "scaled_spin_after", .names = {"r_omega_over_muvcn"}},
    };
    for (const ObliqueObservable& one : oblique_observables()) {
        all.push_back({.name = one.name, .unit = one.unit == "degree" ? "deg" : one.unit, .names = names_of(one.name)});
    }
    return all;
}

class Reader {
public:
    Reader(const std::filesystem::path& file, const ObliqueSphere& sphere, const MakeApproach& approach,
           const TableInput& input)
        : sphere_(sphere),
          approach_(approach),
          input_(input),
          sought_(quantities()),
          table_(io::read_file(file), file.string(), sought_, input, what_is_needed) {}

    ObliqueData read() {
        const std::vector<std::size_t> incoming = incoming_columns();
        const std::size_t measured = measured_column();
        std::vector<std::size_t> used = incoming;
        used.push_back(measured);
        const std::vector<std::vector<double>> values = table_.read(used);
        for (std::size_t row = 0; row < values.front().size(); ++row) {
            std::vector<double> in;
            for (std::size_t i = 0; i < incoming.size(); ++i) in.push_back(values[i][row]);
            data_.measured.approaches.push_back(approach_of(incoming, in));
            data_.measured.values.push_back(observed(measured, values.back()[row]));
        }
        data_.measured.observable = sought_[measured == psi2                ? observable("contact_velocity_after")
                                            : measured == scaled_spin_after ? observable("spin_after")
                                                                            : measured]
                                        .name;
        data_.remarks = std::move(table_.remarks());
        return std::move(data_);
    }

private:
    std::vector<std::size_t> incoming_columns() {
        std::vector<std::size_t> found;
        for (const std::size_t name : {angle, spin})
            if (table_.has(name)) found.push_back(name);
        for (const std::size_t name : {psi1, spin_ratio})
            if (found.empty() && table_.has(name)) found.push_back(name);
        if (found.empty()) {
            table_.refuse_header(fmt::format(
                "there is no column that says how the sphere came in: {}. --column angle=COLUMN says which column it "
                "is (docs/tables.md has all names)",
                what_is_needed));
        }
        return found;
    }

    std::size_t measured_column() {
        std::vector<std::size_t> found;
        std::vector<std::string> names, known;
        for (std::size_t i = psi2; i < sought_.size(); ++i) {
            known.emplace_back(sought_[i].name);
            if (!table_.has(i)) continue;
            if (input_.columns.contains(sought_[i].name)) return i;
            found.push_back(i);
            names.push_back(fmt::format("'{}'", sought_[i].name));
        }
        if (found.empty()) {
            table_.refuse_header(fmt::format(
                "there is no column that was measured: {}, one of {}. --column NAME=COLUMN says which column it is",
                what_is_needed, io::listed(known)));
        }
        if (found.size() > 1) {
            table_.refuse_header(fmt::format("there are {} measured columns, {}: choose one with --column NAME=COLUMN",
                                             found.size(), io::listed(names)));
        }
        return found.front();
    }

    [[nodiscard]] std::size_t observable(std::string_view name) const {
        const auto is = [name](const Sought& one) { return one.name == name; };
        return static_cast<std::size_t>(std::find_if(sought_.begin(), sought_.end(), is) - sought_.begin());
    }

    [[nodiscard]] double coefficient() {
        data_.needs_coefficient = true;
        if (const auto mu = friction_coefficient(sphere_.contact.friction)) return *mu;
        throw InvalidInput(
            "the table has psi1, psi2 or a spin in units of mu, and the friction law has no coefficient");
    }

    Approach approach_of(const std::vector<std::size_t>& columns, const std::vector<double>& values) {
        double theta = 0, omega = 0;
        for (std::size_t i = 0; i < columns.size(); ++i) {
            if (columns[i] == angle) theta = values[i] * degree;
            if (columns[i] == spin) omega = values[i];
            if (columns[i] == psi1) theta = std::atan(coefficient() * values[i]);
            if (columns[i] == spin_ratio) {
                const Approach straight = approach_(0, 0);
                if (!restitution_) restitution_ = oblique_impact(sphere_, straight).normal_restitution();
                omega =
                    3.5 * coefficient() * (1 + *restitution_) * straight.normal_speed / (sphere_.radius * values[i]);
            }
        }
        return approach_(theta, omega);
    }

    double observed(std::size_t column, double value) {
        const Approach& in = data_.measured.approaches.back();
        if (column == psi2) return coefficient() * in.normal_speed * value;
        if (column == scaled_spin_after) return coefficient() * in.normal_speed * value / sphere_.radius;
        return value;
    }

    const ObliqueSphere& sphere_;
    const MakeApproach& approach_;
    const TableInput& input_;
    std::vector<Sought> sought_;
    io::TableReader table_;
    std::optional<double> restitution_;  // of a straight impact
    ObliqueData data_;
};

}  // namespace

ObliqueData load_oblique_data(const std::filesystem::path& file, const ObliqueSphere& sphere,
                              const MakeApproach& approach, const TableInput& input) {
    return Reader(file, sphere, approach, input).read();
}

}  // namespace footfall
