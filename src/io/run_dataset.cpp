// The contents of a run's file, from the tables in columns.hpp.
#include "io/run_dataset.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "footfall/io/printable.hpp"
#include "footfall/version.hpp"
#include "io/columns.hpp"

namespace footfall::io {
namespace {

using Names = std::vector<std::string>;

/// The dataset as it grows.
class Builder {
public:
    explicit Builder(RunDataset& data) : data_(data) {}

    void dimension(const char* name, std::size_t length) { data_.dimensions.emplace_back(name, length); }
    void attribute(const char* name, std::string_view text) { data_.attributes.emplace_back(name, std::string(text)); }
    void attribute(const char* name, double value) { data_.attributes.emplace_back(name, value); }
    void attribute(const char* name, std::int64_t value) { data_.attributes.emplace_back(name, value); }

    void numbers(std::string name, std::string_view units, std::string long_name, Names dimensions,
                 Gather<double> gather, bool may_be_missing = false) {
        data_.variables.push_back({.name = std::move(name),
                                   .dimensions = std::move(dimensions),
                                   .units = std::string(units),
                                   .long_name = std::move(long_name),
                                   .values = std::move(gather),
                                   .may_be_missing = may_be_missing});
    }
    void indices(std::string name, std::string long_name, std::string dimension, Gather<int> gather) {
        data_.variables.push_back({.name = std::move(name),
                                   .dimensions = {std::move(dimension)},
                                   .units = "1",
                                   .long_name = std::move(long_name),
                                   .values = std::move(gather)});
    }
    void flags(std::string name, std::string long_name, Names dimensions, std::string meanings, std::size_t count,
               Gather<signed char> gather) {
        data_.variables.push_back({.name = std::move(name),
                                   .dimensions = std::move(dimensions),
                                   .units = "1",
                                   .long_name = std::move(long_name),
                                   .values = std::move(gather),
                                   .flag_meanings = std::move(meanings),
                                   .flag_count = count});
    }
    void labels(std::string name, std::string long_name, std::span<const std::string_view> values) {
        Names dimensions{name};
        data_.variables.push_back({.name = std::move(name),
                                   .dimensions = std::move(dimensions),
                                   .units = "1",
                                   .long_name = std::move(long_name),
                                   .values = values});
    }

private:
    RunDataset& data_;
};

Names with_components(Names outer, columns::Shape shape) {
    if (shape == columns::Shape::vector) outer.emplace_back("axis");
    if (shape == columns::Shape::quaternion) outer.emplace_back("quaternion");
    return outer;
}

/// `of(record)` for every record, when the values are asked for.
template <class Value = double, class Record, class Of>
Gather<Value> each(const std::vector<Record>& records, Of of) {
    return [&records, of] {
        std::vector<Value> values;
        values.reserve(records.size());
        for (const Record& record : records) values.push_back(of(record));
        return values;
    };
}

/// "touchdown stick slip ...": the names of enumerators, as flag_meanings wants them.
template <class Enumerators>
std::string meanings(const Enumerators& enumerators) {
    std::string names;
    for (const auto value : enumerators) {
        if (!names.empty()) names += ' ';
        names += name_of(value);
    }
    return names;
}

/// One column over a list of records; `select(record)` is the object that the column reads.
template <class Of, class Record, class Select>
void table(Builder& data, const std::string& name, const columns::Column<Of>& column, const Names& dimensions,
           const std::vector<Record>& records, Select select, std::string_view whose = "",
           bool may_be_missing = false) {
    const std::string long_name = fmt::format("{}{}", whose, column.long_name);
    const auto gather = [&column, &records, select] {
        const std::size_t size = columns::size(column.shape);
        std::vector<double> values(records.size() * size);
        for (std::size_t i = 0; i < records.size(); ++i) column.read(select(records[i]), values.data() + i * size);
        return values;
    };
    data.numbers(name, column.unit, long_name, dimensions, gather, may_be_missing);
}

/// One column of every sphere's contact over the samples.
template <class Of, class Select>
void contact_table(Builder& data, const std::string& name, const columns::Column<Of>& column, std::size_t spheres,
                   const std::vector<Snapshot>& samples, Select select) {
    const auto gather = [&column, &samples, spheres, select] {
        const std::size_t size = columns::size(column.shape);
        std::vector<double> values(samples.size() * spheres * size);
        double* out = values.data();
        for (const Snapshot& sample : samples) {
            for (std::size_t i = 0; i < spheres; ++i, out += size) column.read(select(sample.contacts.at(i)), out);
        }
        return values;
    };
    data.numbers(name, column.unit, std::string(column.long_name), with_components({"time", "sphere"}, column.shape),
                 gather);
}

/// "normal_spring: held: normal spring, ...": the channels in their order, for readers that do not have the table.
std::string channel_list() {
    std::string list;
    for (const ContactChannel& c : contact_channels)
        list += fmt::format("{}{}: {}: {}", list.empty() ? "" : ", ", c.name, name_of(c.kind), c.label);
    return list;
}

/// The laws of one `part` of the contacts, normal or friction: their names, and every parameter for each sphere,
/// `normal_stiffness(sphere)` and so on. Where the spheres are under different laws the law's name is in that of the
/// variable, and NaN stands for the spheres that are not under it.
template <class Variant, class OfContact>
void write_laws(Builder& data, const std::string& part, const std::vector<ContactParameters>& contacts, OfContact of) {
    std::string names;
    for_each_law<Variant>([&]<class Law>(const Law&) {
        const std::size_t under = contacts_under<Law>(contacts, of).size();
        if (under == 0) return;
        const bool all = under == contacts.size();
        names += (names.empty() ? "" : ", ") + std::string(Law::description.name);
        std::string prefix = part;
        if (!all) prefix += fmt::format("_{}", Law::description.name);
        std::replace(prefix.begin(), prefix.end(), '-', '_');
        for (const auto& parameter : Law::parameters()) {
            const auto gather = [&contacts, of, member = parameter.member] {
                std::vector<double> values;
                for (const ContactParameters& contact : contacts) {
                    const Law* law = std::get_if<Law>(&of(contact));
                    values.push_back(law ? law->*member : std::numeric_limits<double>::quiet_NaN());
                }
                return values;
            };
            data.numbers(fmt::format("{}_{}", prefix, parameter.key), parameter.unit,
                         fmt::format("{}, {}", parameter.symbol, parameter.description), {"sphere"}, gather, !all);
        }
    });
    data.attribute((part + "_law").c_str(), names);
}

void write_setup(Builder& data, const Simulation& simulation) {
    const auto vector = [](const Eigen::Vector3d& v) {
        return [v] { return std::vector<double>{v.x(), v.y(), v.z()}; };
    };
    const std::vector<Sphere>& spheres = simulation.body.spheres;
    data.numbers("mass", "kg", "mass of the body", {}, [mass = simulation.body.mass] { return std::vector{mass}; });
    data.numbers("gravity", "m/s^2", "acceleration of gravity, world frame", {"axis"}, vector(simulation.gravity));
    data.numbers("ground_normal", "1", "normal of the ground, world frame", {"axis"}, vector(simulation.ground.normal));
    data.numbers("ground_height", "m", "distance of the ground from the world's origin along its normal", {},
                 [height = simulation.ground.height] { return std::vector{height}; });
    data.numbers("sphere_radius", "m", "radius", {"sphere"}, each(spheres, [](const Sphere& s) { return s.radius; }));
    data.numbers("sphere_center", "m", "centre, from the centre of mass, in the body's frame", {"sphere", "axis"},
                 [&spheres] {
                     std::vector<double> values;
                     for (const Sphere& sphere : spheres) {
                         values.insert(values.end(), sphere.center.begin(), sphere.center.end());
                     }
                     return values;
                 });

    const std::vector<ContactParameters>& contacts = simulation.contacts;
    write_laws<NormalLaw>(data, "normal", contacts,
                          [](const ContactParameters& c) -> const NormalLaw& { return c.normal; });
    write_laws<FrictionLaw>(data, "friction", contacts,
                            [](const ContactParameters& c) -> const FrictionLaw& { return c.friction; });
}

void write_samples(Builder& data, std::size_t spheres, const Run& run) {
    const std::vector<Snapshot>& samples = run.samples;
    data.numbers("time", "s", "time from the start of the run", {"time"},
                 each(samples, [](const Snapshot& s) { return s.time; }));
    for (const auto& column : columns::body) {
        table(data, std::string(column.name), column, with_components({"time"}, column.shape), samples,
              [](const Snapshot& s) -> const BodyState& { return s.body; });
    }

    data.flags("phase", "how the sphere touches the ground", {"time", "sphere"}, meanings(columns::phases),
               columns::phases.size(), [&samples] {
                   std::vector<signed char> phases;
                   for (const Snapshot& sample : samples) {
                       for (const ContactSnapshot& contact : sample.contacts) {
                           phases.push_back(static_cast<signed char>(contact.phase));
                       }
                   }
                   return phases;
               });
    for (const auto& column : columns::contact) {
        contact_table(data, std::string(column.name), column, spheres, samples,
                      [](const ContactSnapshot& c) -> const ContactSnapshot& { return c; });
    }
    for (const auto& column : columns::contact_energy) {
        contact_table(data, fmt::format("sphere_energy_{}", column.name), column, spheres, samples,
                      [](const ContactSnapshot& c) -> const ContactEnergy& { return c.energy; });
    }

    for (const auto& column : columns::body_energy) {
        table(data, fmt::format("energy_{}", column.name), column, {"time"}, samples,
              [](const Snapshot& s) -> const Ledger& { return s.ledger; });
    }
    for (const auto& column : columns::contact_energy) {
        table(
            data, fmt::format("energy_{}", column.name), column, {"time"}, samples,
            [](const Snapshot& s) -> const ContactEnergy& { return s.ledger.contact; }, "over all spheres: ");
    }
    data.numbers("energy_total", "J", "kinetic, potential, held and taken energy together", {"time"},
                 each(samples, [](const Snapshot& s) { return s.ledger.total(); }));
    data.numbers("energy_residual", "1", "(energy_total - its initial value) / energy_scale", {"time"},
                 each(samples, [&run](const Snapshot& s) { return columns::residual(run, s.ledger); }));
}

void write_events(Builder& data, const std::vector<Event>& events) {
    data.numbers("event_time", "s", "time of the event", {"event"},
                 each(events, [](const Event& e) { return e.time; }));
    data.flags("event_kind", "what happened", {"event"}, meanings(columns::event_kinds), columns::event_kinds.size(),
               each<signed char>(events, [](const Event& e) { return static_cast<signed char>(e.kind); }));
    data.indices("event_sphere", "sphere that it happened to", "event",
                 each<int>(events, [](const Event& e) { return e.sphere; }));
    for (const auto& column : columns::body) {
        table(
            data, fmt::format("event_{}", column.name), column, with_components({"event"}, column.shape), events,
            [](const Event& e) -> const BodyState& { return e.state.body; }, "at the event: ");
    }
    for (const auto& column : columns::contact) {
        table(
            data, fmt::format("event_{}", column.name), column, with_components({"event"}, column.shape), events,
            [](const Event& e) -> const ContactSnapshot& {
                return e.state.contacts.at(static_cast<std::size_t>(e.sphere));
            },
            "of event_sphere at the event: ");
    }
}

void write_impacts(Builder& data, const std::vector<Impact>& impacts) {
    data.indices("impact_sphere", "sphere that touched the ground", "impact",
                 each<int>(impacts, [](const Impact& i) { return i.sphere; }));
    for (const auto& column : columns::impact) {
        table(
            data, fmt::format("impact_{}", column.name), column, {"impact"}, impacts,
            [](const Impact& i) -> const Impact& { return i; }, "", true);
    }
}

}  // namespace

RunDataset run_dataset(const Scenario& scenario, const Run& run) {
    RunDataset made;
    Builder data(made);
    const std::size_t spheres = scenario.simulation.body.spheres.size();
    data.dimension("time", run.samples.size());
    data.dimension("sphere", spheres);
    data.dimension("axis", columns::axis_labels.size());
    data.dimension("quaternion", columns::quaternion_labels.size());
    data.dimension("event", run.events.size());
    data.dimension("impact", run.impacts.size());

    data.attribute("title", printable(scenario.title));
    data.attribute("source", fmt::format("footfall {}", version));
    data.attribute("footfall_version", version);
    data.attribute("energy_channels", channel_list());
    data.attribute("tolerance", scenario.simulation.options.tolerance);
    data.attribute("max_residual", run.max_residual);
    data.attribute("energy_scale", run.energy_scale);
    data.attribute("steps", run.cost.steps);
    data.attribute("rejected_steps", run.cost.rejected);
    data.attribute("stiff_steps", run.cost.stiff_steps);
    data.attribute("evaluations", run.cost.evaluations);

    data.labels("axis", "component of a vector", columns::axis_labels);
    data.labels("quaternion", "component of a quaternion, w the real one", columns::quaternion_labels);
    data.indices("sphere", "index of the sphere in the scenario", "sphere", [spheres] {
        std::vector<int> indices(spheres);
        std::iota(indices.begin(), indices.end(), 0);
        return indices;
    });
    write_samples(data, spheres, run);
    write_events(data, run.events);
    write_impacts(data, run.impacts);
    write_setup(data, scenario.simulation);
    data.attribute("scenario", scenario.text);
    return made;
}

}  // namespace footfall::io
