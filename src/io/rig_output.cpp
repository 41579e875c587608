// What a rig measures, as JSON and as a page of text.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "footfall/io/law_text.hpp"
#include "footfall/io/printable.hpp"
#include "footfall/io/rig.hpp"
#include "footfall/io/table_output.hpp"
#include "footfall/version.hpp"
#include "io/table_remarks.hpp"
#include "io/text.hpp"

namespace footfall {
namespace {

using Json = nlohmann::ordered_json;
using text::Align;
using text::quantity;

Json energy_of(const RigEnergy& energy) {
    Json json = Json::object();
    for (const auto& channel : contact_channels) json[std::string(channel.name)] = energy.contact.*channel.member;
    for (const auto& channel : rig_channels) json[std::string(channel.name)] = energy.*channel.member;
    return json;
}

Json stick_slip_of(const Drive& run) {
    if (!run.stick_slip) return nullptr;
    const StickSlip& s = *run.stick_slip;
    return {{"cycles", s.cycles},     {"period", s.period}, {"amplitude", s.amplitude},
            {"greatest", s.greatest}, {"least", s.least},   {"sticking", s.sticking}};
}

Json run_of(const RigRun& run) {
    const Drive& drive = run.named.drive;
    Json events = Json::array();
    for (const RigEvent& event : drive.events) events.push_back({{"time", event.time}, {"kind", name_of(event.kind)}});
    return {{"name", run.named.name},
            {"normal", law_text(run.laws.normal)},
            {"friction", law_text(run.laws.friction)},
            {"events", events},
            {"largest_normal_force", drive.largest_normal_force},
            {"largest_friction_force", drive.largest_friction_force},
            {"stick_slip", stick_slip_of(drive)},
            {"energy", energy_of(drive.samples.back().energy)},
            {"max_residual", drive.max_residual},
            {"steps", drive.cost.steps},
            {"evaluations", drive.cost.evaluations},
            {"wall_seconds", drive.cost.wall_seconds}};
}

std::vector<NamedDrive> named(const std::vector<RigRun>& runs) {
    std::vector<NamedDrive> all;
    for (const RigRun& run : runs) all.push_back(run.named);
    return all;
}

// For a person --------------------------------------------------------------------------------------------------------

std::string forces_and_energies(const std::vector<RigRun>& runs) {
    text::Table table(
        {Align::left, Align::unit, Align::unit, Align::unit, Align::unit, Align::unit, Align::unit, Align::right});
    table.head({"\nrun", "largest\nF_n", "largest\nF_f", "work\ndone", "\ntaken", "still\nheld",
                "P, no force\npays for", "\nresidual"});
    for (const RigRun& run : runs) {
        const Drive& d = run.named.drive;
        const RigEnergy &e = d.samples.back().energy, &start = d.samples.front().energy;
        table.row({run.named.name, quantity(d.largest_normal_force, "N"), quantity(d.largest_friction_force, "N"),
                   quantity(e.worked(), "J"), quantity(e.taken(), "J"), quantity(e.held() - start.held(), "J"),
                   quantity(e.contact.unpaid(), "J"), fmt::format("{:.1e}", d.max_residual)});
    }
    return table.str();
}

std::string stick_slips(const std::vector<RigRun>& runs) {
    text::Table table({Align::left, Align::unit, Align::unit, Align::unit, Align::unit, Align::right, Align::right});
    table.head({"\nrun", "\nperiod", "\namplitude", "greatest\ndeflection", "least\ndeflection", "with\nthe belt",
                "\ncycles"});
    bool any = false;
    for (const RigRun& run : runs) {
        if (!run.named.drive.stick_slip) {
            table.row({run.named.name, "steady", "", "", "", "", ""});
            continue;
        }
        const StickSlip& s = *run.named.drive.stick_slip;
        any = true;
        table.row({run.named.name, quantity(s.period, "s"), quantity(s.amplitude, "m"), quantity(s.greatest, "m"),
                   quantity(s.least, "m"), fmt::format("{:.0f} %", 100 * s.sticking), text::count(s.cycles)});
    }
    return any ? "\nSwing of the mass, later half of the run\n\n" + table.str() : "";
}

std::string events_of(const RigRun& run) {
    constexpr std::size_t most = 16;
    text::Table table({Align::right, Align::left, Align::unit, Align::unit, Align::unit});
    table.head({"time [s]", "event", "F_n", "F_f", "slip"});
    const std::vector<RigEvent>& events = run.named.drive.events;
    for (std::size_t i = 0; i < std::min(most, events.size()); ++i) {
        const RigEvent& event = events[i];
        table.row({fmt::format("{:.9f}", event.time), std::string(name_of(event.kind)),
                   quantity(event.state.normal_force, "N"), quantity(event.state.friction_force.norm(), "N"),
                   quantity(event.state.slip_velocity.norm(), "m/s")});
    }
    if (events.size() > most)
        table.note(fmt::format("   … {} more …", text::count(static_cast<long long>(events.size() - most))));
    return fmt::format("\nEvents\n\n{}", table.str());
}

}  // namespace

std::string to_json(const Rig& rig, const std::vector<RigRun>& runs) {
    Json list = Json::array();
    for (const RigRun& run : runs) list.push_back(run_of(run));
    const Json json{{"title", rig.title},
                    {"warnings", io::warnings_json(rig.remarks)},
                    {"runs", list},
                    {"samples", Json::parse(to_json(drive_table(rig, named(runs))))["columns"]},
                    {"version", version}};
    return json_text(json);
}

std::string summary(const Rig& rig, const std::vector<RigRun>& runs) {
    std::string page = rig.title.empty() ? "" : printable(rig.title) + "\n\n";
    page += io::remarks_text(rig.remarks);
    for (const RigRun& run : runs) {
        for (const std::string& line : text::wrap(fmt::format("{}: normal {}; friction {}", run.named.name,
                                                              law_text(run.laws.normal), law_text(run.laws.friction)),
                                                  96))
            page += "  " + line + "\n";
    }
    page += "\n" + forces_and_energies(runs);
    if (rig.drag == Drag::mass) page += stick_slips(runs);
    if (runs.size() == 1) page += events_of(runs.front());
    return page;
}

}  // namespace footfall
