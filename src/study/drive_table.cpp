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

const RigEnergy& account(const RigEnergy& energy, const Channel<RigEnergy>& /*of*/) { return energy; }
const ContactEnergy& account(const RigEnergy& energy, const Channel<ContactEnergy>& /*of*/) { return energy.contact; }

/// An entry of the account: "P, taken by the changing stiffness".
template <class Of>
Quantity entry(const Channel<Of>& channel) {
    const std::string symbol = channel.symbol.empty() ? "" : std::string(channel.symbol) + ", ";
    return {std::string(channel.name), std::string(channel.unit), symbol + std::string(channel.brief),
            [&channel](const RigState& s) { return account(s.energy, channel).*channel.member; }};
}

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
                                [](const State& s) { return s.holding_force.y(); }}});
    }
    // What holds the mass is there where there is one; what the drive has done stands behind the contact.
    for (const Channel<RigEnergy>& channel : rig_channels)
        if (channel.kind != ChannelKind::worked && rig.drag == Drag::mass) all.push_back(entry(channel));
    for (const Channel<ContactEnergy>& channel : contact_channels) all.push_back(entry(channel));
    for (const Channel<RigEnergy>& channel : rig_channels)
        if (channel.kind == ChannelKind::worked) all.push_back(entry(channel));
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
