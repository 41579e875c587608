// The samples of a rig's runs as columns.
#include <functional>
#include <string>

#include "footfall/study/drive.hpp"

namespace footfall {
namespace {

struct Quantity {
    std::string name, unit, description;
    std::function<double(const RigState&)> of;
};

/// What a run shows beside what is prescribed.
std::vector<Quantity> quantities(const Rig& rig) {
    using State = RigState;
    std::vector<Quantity> all{
        {"phase", "1", "0 flight, 1 stick, 2 slip, 3 recovering",
         [](const State& s) { return static_cast<int>(s.phase); }},
        {"depth", "m", "z, indentation", [](const State& s) { return s.depth; }},
        {"normal_force", "N", "F_n", [](const State& s) { return s.normal_force; }},
        {"friction_force_x", "N", "F_f, on the body", [](const State& s) { return s.friction_force.x(); }},
        {"friction_force_y", "N", "F_f, on the body", [](const State& s) { return s.friction_force.y(); }},
        {"slip_displacement_x", "m", "the integral of V_sph", [](const State& s) { return s.slip_displacement.x(); }},
        {"slip_displacement_y", "m", "the integral of V_sph", [](const State& s) { return s.slip_displacement.y(); }},
        {"slip_velocity_x", "m/s", "V_sph", [](const State& s) { return s.slip_velocity.x(); }},
        {"slip_velocity_y", "m/s", "V_sph", [](const State& s) { return s.slip_velocity.y(); }},
        {"bristle_x", "m", "u", [](const State& s) { return s.bristle.x(); }},
        {"bristle_y", "m", "u", [](const State& s) { return s.bristle.y(); }},
    };
    if (rig.drag == Drag::mass) {
        all.insert(all.end(), {{"position_x", "m", "of the mass", [](const State& s) { return s.position.x(); }},
                               {"position_y", "m", "of the mass", [](const State& s) { return s.position.y(); }},
                               {"velocity_x", "m/s", "of the mass", [](const State& s) { return s.velocity.x(); }},
                               {"velocity_y", "m/s", "of the mass", [](const State& s) { return s.velocity.y(); }},
                               {"holding_force_x", "N", "of spring and damper, on the mass",
                                [](const State& s) { return s.holding_force.x(); }},
                               {"holding_force_y", "N", "of spring and damper, on the mass",
                                [](const State& s) { return s.holding_force.y(); }},
                               {"kinetic", "J", "energy of the mass", [](const State& s) { return s.energy.kinetic; }},
                               {"holding_spring", "J", "held by the spring to the support",
                                [](const State& s) { return s.energy.holding_spring; }},
                               {"holding_damper", "J", "taken by the damper beside it",
                                [](const State& s) { return s.energy.holding_damper; }}});
    }
    all.insert(all.end(),
               {{"normal_spring", "J", "held by the normal spring",
                 [](const State& s) { return s.energy.contact.normal_spring; }},
                {"tangential_spring", "J", "W, held by the bristle",
                 [](const State& s) { return s.energy.contact.tangential_spring; }},
                {"normal_damper", "J", "taken by the normal damper",
                 [](const State& s) { return s.energy.contact.normal_damper; }},
                {"tangential_damper", "J", "taken by the tangential damper",
                 [](const State& s) { return s.energy.contact.tangential_damper; }},
                {"clutch", "J", "taken by the clutch", [](const State& s) { return s.energy.contact.clutch; }},
                {"stiffness_change", "J", "P, taken by the changing stiffness",
                 [](const State& s) { return s.energy.contact.stiffness_change; }},
                {"pressing_work", "J", "done by the drive along the normal",
                 [](const State& s) { return s.energy.pressing_work; }},
                {"dragging_work", "J", "done by the drive in the plane",
                 [](const State& s) { return s.energy.dragging_work; }}});
    return all;
}

Column column(const Quantity& quantity, const std::vector<RigState>& samples, const std::string& series) {
    Column c{quantity.name, quantity.unit, quantity.description, {}, series};
    c.values.reserve(samples.size());
    for (const RigState& s : samples) c.values.push_back(quantity.of(s));
    return c;
}

}  // namespace

Table drive_table(const Rig& rig, const std::vector<NamedDrive>& runs) {
    Table table{rig.title, {}};
    if (runs.empty()) return table;
    table.columns.push_back(
        column({"time", "s", "time", [](const RigState& s) { return s.time; }}, runs.front().drive.samples, ""));
    for (const NamedDrive& run : runs)
        for (const Quantity& quantity : quantities(rig))
            table.columns.push_back(column(quantity, run.drive.samples, runs.size() > 1 ? run.name : ""));
    return table;
}

}  // namespace footfall
