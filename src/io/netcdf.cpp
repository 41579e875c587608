// A run as a NetCDF-4 file. The variables are listed in docs/cli.md.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <netcdf.h>
#include <netcdf_mem.h>

#include "footfall/io/output.hpp"
#include "footfall/version.hpp"
#include "io/atomic_file.hpp"
#include "io/columns.hpp"

namespace footfall {
namespace fs = std::filesystem;
namespace {

/// A dataset being written, in memory: with a file of its own HDF5 1.10 crashes where the disk is full. Variables are
/// all defined first and filled after, which NetCDF does fastest.
class Dataset {
public:
    explicit Dataset(AtomicFile& file) : file_(file) {
        constexpr std::size_t initial_bytes = 1 << 16;  // it grows
        expect(nc_create_mem("run.nc", NC_NETCDF4, initial_bytes, &id_));
        open_ = true;
    }
    ~Dataset() {
        if (open_) nc_abort(id_);
    }
    Dataset(const Dataset&) = delete;
    Dataset& operator=(const Dataset&) = delete;

    int dimension(const char* name, std::size_t length) {
        int dimension = 0;
        // NetCDF keeps the length 0 for dimensions that can grow; an empty one is one of those.
        expect(nc_def_dim(id_, name, length == 0 ? NC_UNLIMITED : length, &dimension));
        return dimension;
    }

    void attribute(const char* name, std::string_view text) { attribute(NC_GLOBAL, name, text); }
    void attribute(const char* name, double value) {
        expect(nc_put_att_double(id_, NC_GLOBAL, name, NC_DOUBLE, 1, &value));
    }
    void attribute(const char* name, std::int64_t value) {
        const long long wide = value;
        expect(nc_put_att_longlong(id_, NC_GLOBAL, name, NC_INT64, 1, &wide));
    }

    /// `gather` gives the values, the last dimension fastest, when the time to write them has come.
    void numbers(const std::string& name, std::string_view unit, std::string_view long_name,
                 const std::vector<int>& dimensions, std::function<std::vector<double>()> gather,
                 bool may_be_missing = false) {
        const int variable = define(name, NC_DOUBLE, dimensions, unit, long_name);
        if (may_be_missing) {
            const double missing = std::nan("");
            expect(nc_def_var_fill(id_, variable, NC_FILL, &missing));
        }
        // Contacts are at rest or in flight for much of a run: the values repeat and pack well.
        constexpr int shuffle = 1, deflate = 1, level = 1;
        if (!dimensions.empty()) expect(nc_def_var_deflate(id_, variable, shuffle, deflate, level));
        fills_.push_back([this, variable, gather = std::move(gather)] {
            const std::vector<double> values = gather();
            if (!values.empty()) expect(nc_put_var_double(id_, variable, values.data()));
        });
    }

    void indices(const std::string& name, std::string_view long_name, int dimension, std::vector<int> values) {
        const int variable = define(name, NC_INT, {dimension}, "1", long_name);
        fills_.push_back([this, variable, values = std::move(values)] {
            if (!values.empty()) expect(nc_put_var_int(id_, variable, values.data()));
        });
    }

    /// Small integers with a meaning, as the CF conventions describe them.
    void flags(const std::string& name, std::string_view long_name, const std::vector<int>& dimensions,
               std::string_view meanings, std::size_t count, std::vector<signed char> values) {
        const int variable = define(name, NC_BYTE, dimensions, "1", long_name);
        std::vector<signed char> flag_values(count);
        for (std::size_t i = 0; i < count; ++i) flag_values[i] = static_cast<signed char>(i);
        expect(nc_put_att_schar(id_, variable, "flag_values", NC_BYTE, count, flag_values.data()));
        attribute(variable, "flag_meanings", meanings);
        fills_.push_back([this, variable, values = std::move(values)] {
            if (!values.empty()) expect(nc_put_var_schar(id_, variable, values.data()));
        });
    }

    void labels(const std::string& name, std::string_view long_name, int dimension,
                std::span<const std::string_view> values) {
        const int variable = define(name, NC_STRING, {dimension}, "1", long_name);
        fills_.push_back([this, variable, values] {
            const std::vector<std::string> owned(values.begin(), values.end());
            std::vector<const char*> pointers;
            for (const std::string& label : owned) pointers.push_back(label.c_str());
            expect(nc_put_var_string(id_, variable, pointers.data()));
        });
    }

    void fill_and_write() {
        expect(nc_enddef(id_));
        for (const auto& fill : fills_) fill();
        NC_memio image{};
        open_ = false;
        expect(nc_close_memio(id_, &image));
        const std::unique_ptr<void, decltype(&std::free)> owner(image.memory, std::free);
        file_.write({static_cast<const char*>(image.memory), image.size});
    }

private:
    int define(const std::string& name, nc_type type, const std::vector<int>& dimensions, std::string_view unit,
               std::string_view long_name) {
        int variable = 0;
        expect(nc_def_var(id_, name.c_str(), type, static_cast<int>(dimensions.size()), dimensions.data(), &variable));
        attribute(variable, "units", unit);
        attribute(variable, "long_name", long_name);
        return variable;
    }

    void attribute(int variable, const char* name, std::string_view text) {
        expect(nc_put_att_text(id_, variable, name, text.size(), text.data()));
    }

    void expect(int status) const {
        if (status != NC_NOERR) file_.fail(fmt::format("NetCDF: {}", nc_strerror(status)));
    }

    AtomicFile& file_;
    int id_ = 0;
    bool open_ = false;
    std::vector<std::function<void()>> fills_;
};

struct Dimensions {
    int time, sphere, axis, quaternion, event, impact;

    [[nodiscard]] std::vector<int> with_components(std::vector<int> outer, columns::Shape shape) const {
        if (shape == columns::Shape::vector) outer.push_back(axis);
        if (shape == columns::Shape::quaternion) outer.push_back(quaternion);
        return outer;
    }
};

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
void table(Dataset& data, const std::string& name, const columns::Column<Of>& column,
           const std::vector<int>& dimensions, const std::vector<Record>& records, Select select,
           std::string_view whose = "", bool may_be_missing = false) {
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
void contact_table(Dataset& data, const std::string& name, const columns::Column<Of>& column, const Dimensions& dims,
                   std::size_t spheres, const std::vector<Snapshot>& samples, Select select) {
    const auto gather = [&column, &samples, spheres, select] {
        const std::size_t size = columns::size(column.shape);
        std::vector<double> values(samples.size() * spheres * size);
        double* out = values.data();
        for (const Snapshot& sample : samples) {
            for (std::size_t i = 0; i < spheres; ++i, out += size) column.read(select(sample.contacts.at(i)), out);
        }
        return values;
    };
    data.numbers(name, column.unit, std::string(column.long_name),
                 dims.with_components({dims.time, dims.sphere}, column.shape), gather);
}

/// Every parameter of one kind of law, for each sphere: `normal_stiffness(sphere)` and so on.
template <class Law, class OfContact>
void parameters(Dataset& data, const std::string& prefix, const Dimensions& dims,
                const std::vector<ContactParameters>& contacts, OfContact of_contact) {
    for (const auto& parameter : Law::parameters()) {
        const auto gather = [&contacts, of_contact, member = parameter.member] {
            std::vector<double> values;
            for (const ContactParameters& contact : contacts) {
                values.push_back(std::get<Law>(of_contact(contact)).*member);
            }
            return values;
        };
        data.numbers(fmt::format("{}_{}", prefix, parameter.key), parameter.unit,
                     fmt::format("{}, {}", parameter.symbol, parameter.description), {dims.sphere}, gather);
    }
}

void write_setup(Dataset& data, const Dimensions& dims, const Simulation& simulation) {
    const auto vector = [](const Eigen::Vector3d& v) {
        return [v] { return std::vector<double>{v.x(), v.y(), v.z()}; };
    };
    const std::vector<Sphere>& spheres = simulation.body.spheres;
    data.numbers("mass", "kg", "mass of the body", {}, [&] { return std::vector{simulation.body.mass}; });
    data.numbers("gravity", "m/s^2", "acceleration of gravity, world frame", {dims.axis}, vector(simulation.gravity));
    data.numbers("ground_normal", "1", "normal of the ground, world frame", {dims.axis},
                 vector(simulation.ground.normal));
    data.numbers("ground_height", "m", "distance of the ground from the world's origin along its normal", {},
                 [&] { return std::vector{simulation.ground.height}; });
    data.numbers("sphere_radius", "m", "radius", {dims.sphere}, [&spheres] {
        std::vector<double> values;
        for (const Sphere& sphere : spheres) values.push_back(sphere.radius);
        return values;
    });
    data.numbers("sphere_center", "m", "centre, from the centre of mass, in the body's frame", {dims.sphere, dims.axis},
                 [&spheres] {
                     std::vector<double> values;
                     for (const Sphere& sphere : spheres) {
                         values.insert(values.end(), sphere.center.begin(), sphere.center.end());
                     }
                     return values;
                 });

    // All contacts have the same kinds of law.
    const std::vector<ContactParameters>& contacts = simulation.contacts;
    const auto normal_of = [](const ContactParameters& c) -> const NormalLaw& { return c.normal; };
    const auto friction_of = [](const ContactParameters& c) -> const FrictionLaw& { return c.friction; };
    data.attribute("normal_law", name_of(contacts.front().normal));
    data.attribute("friction_law", name_of(contacts.front().friction));
    std::visit([&]<class Law>(const Law&) { parameters<Law>(data, "normal", dims, contacts, normal_of); },
               contacts.front().normal);
    std::visit([&]<class Law>(const Law&) { parameters<Law>(data, "friction", dims, contacts, friction_of); },
               contacts.front().friction);
}

void write_samples(Dataset& data, const Dimensions& dims, std::size_t spheres, const Run& run) {
    const std::vector<Snapshot>& samples = run.samples;
    data.numbers("time", "s", "time from the start of the run", {dims.time}, [&samples] {
        std::vector<double> values;
        for (const Snapshot& sample : samples) values.push_back(sample.time);
        return values;
    });
    for (const auto& column : columns::body) {
        table(data, std::string(column.name), column, dims.with_components({dims.time}, column.shape), samples,
              [](const Snapshot& s) -> const BodyState& { return s.body; });
    }

    std::vector<signed char> phases;
    for (const Snapshot& sample : samples) {
        for (const ContactSnapshot& contact : sample.contacts)
            phases.push_back(static_cast<signed char>(contact.phase));
    }
    data.flags("phase", "how the sphere touches the ground", {dims.time, dims.sphere}, meanings(columns::phases),
               columns::phases.size(), std::move(phases));
    for (const auto& column : columns::contact) {
        contact_table(data, std::string(column.name), column, dims, spheres, samples,
                      [](const ContactSnapshot& c) -> const ContactSnapshot& { return c; });
    }
    for (const auto& column : columns::contact_energy) {
        contact_table(data, fmt::format("sphere_energy_{}", column.name), column, dims, spheres, samples,
                      [](const ContactSnapshot& c) -> const ContactEnergy& { return c.energy; });
    }

    for (const auto& column : columns::body_energy) {
        table(data, fmt::format("energy_{}", column.name), column, {dims.time}, samples,
              [](const Snapshot& s) -> const Ledger& { return s.ledger; });
    }
    for (const auto& column : columns::contact_energy) {
        table(
            data, fmt::format("energy_{}", column.name), column, {dims.time}, samples,
            [](const Snapshot& s) -> const ContactEnergy& { return s.ledger.contact; }, "over all spheres: ");
    }
    data.numbers("energy_total", "J", "kinetic, potential, held and taken energy together", {dims.time}, [&samples] {
        std::vector<double> values;
        for (const Snapshot& sample : samples) values.push_back(sample.ledger.total());
        return values;
    });
    data.numbers("energy_residual", "1", "(energy_total - its initial value) / energy_scale", {dims.time}, [&run] {
        std::vector<double> values;
        for (const Snapshot& sample : run.samples) values.push_back(columns::residual(run, sample.ledger));
        return values;
    });
}

void write_events(Dataset& data, const Dimensions& dims, const std::vector<Event>& events) {
    std::vector<signed char> kinds;
    std::vector<int> spheres;
    for (const Event& event : events) {
        kinds.push_back(static_cast<signed char>(event.kind));
        spheres.push_back(event.sphere);
    }
    data.numbers("event_time", "s", "time of the event", {dims.event}, [&events] {
        std::vector<double> values;
        for (const Event& event : events) values.push_back(event.time);
        return values;
    });
    data.flags("event_kind", "what happened", {dims.event}, meanings(columns::event_kinds), columns::event_kinds.size(),
               std::move(kinds));
    data.indices("event_sphere", "sphere that it happened to", dims.event, std::move(spheres));
    for (const auto& column : columns::body) {
        table(
            data, fmt::format("event_{}", column.name), column, dims.with_components({dims.event}, column.shape),
            events, [](const Event& e) -> const BodyState& { return e.state.body; }, "at the event: ");
    }
    for (const auto& column : columns::contact) {
        table(
            data, fmt::format("event_{}", column.name), column, dims.with_components({dims.event}, column.shape),
            events, [](const Event& e) -> const ContactSnapshot& { return e.state.contacts.at(e.sphere); },
            "of event_sphere at the event: ");
    }
}

void write_impacts(Dataset& data, const Dimensions& dims, const std::vector<Impact>& impacts) {
    std::vector<int> spheres;
    for (const Impact& impact : impacts) spheres.push_back(impact.sphere);
    data.indices("impact_sphere", "sphere that touched the ground", dims.impact, std::move(spheres));
    for (const auto& column : columns::impact) {
        table(
            data, fmt::format("impact_{}", column.name), column, {dims.impact}, impacts,
            [](const Impact& i) -> const Impact& { return i; }, "", true);
    }
}

}  // namespace

void check_netcdf_file(const fs::path& file) { const AtomicFile attempt(file); }

void write_netcdf(const fs::path& file, const Scenario& scenario, const Run& run) {
    AtomicFile atomic(file);
    Dataset data(atomic);
    const std::size_t spheres = scenario.simulation.body.spheres.size();
    const Dimensions dims{.time = data.dimension("time", run.samples.size()),
                          .sphere = data.dimension("sphere", spheres),
                          .axis = data.dimension("axis", columns::axis_labels.size()),
                          .quaternion = data.dimension("quaternion", columns::quaternion_labels.size()),
                          .event = data.dimension("event", run.events.size()),
                          .impact = data.dimension("impact", run.impacts.size())};
    data.attribute("title", scenario.title);
    data.attribute("source", fmt::format("footfall {}", version));
    data.attribute("footfall_version", version);
    data.attribute("tolerance", scenario.simulation.options.tolerance);
    data.attribute("max_residual", run.max_residual);
    data.attribute("energy_scale", run.energy_scale);
    data.attribute("steps", run.cost.steps);
    data.attribute("rejected_steps", run.cost.rejected);
    data.attribute("stiff_steps", run.cost.stiff_steps);
    data.attribute("evaluations", run.cost.evaluations);

    data.labels("axis", "component of a vector", dims.axis, columns::axis_labels);
    data.labels("quaternion", "component of a quaternion, w the real one", dims.quaternion, columns::quaternion_labels);
    std::vector<int> indices(spheres);
    for (std::size_t i = 0; i < spheres; ++i) indices[i] = static_cast<int>(i);
    data.indices("sphere", "index of the sphere in the scenario", dims.sphere, std::move(indices));

    write_samples(data, dims, spheres, run);
    write_events(data, dims, run.events);
    write_impacts(data, dims, run.impacts);
    write_setup(data, dims, scenario.simulation);
    data.attribute("scenario", scenario.text);
    data.fill_and_write();
    atomic.finish();
    atomic.commit();
}

}  // namespace footfall
