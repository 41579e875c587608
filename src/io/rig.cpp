// From a rig file to a Rig.
#include "footfall/io/rig.hpp"

#include <array>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "io/document.hpp"
#include "io/read.hpp"
#include "io/scenario_keys.hpp"
#include "io/table_reader.hpp"

namespace footfall {
namespace {

using io::Document;
using io::Entry;
using io::Form;
using io::Key;
using io::Problems;
using io::Record;
using io::Table;

// The keys ------------------------------------------------------------------------------------------------------------

Key number_key(std::string name, std::string unit, std::string example, std::string description) {
    return {.name = std::move(name),
            .unit = std::move(unit),
            .example = std::move(example),
            .description = std::move(description)};
}
Key required(Key key) {
    key.required = true;
    return key;
}
Key with_default(Key key, double fallback) {
    key.fallback = {fallback};
    return key;
}
Key within(Key key, io::Range range) {
    key.range = range;
    return key;
}

/// One part of a path whose values have this unit.
Table part_table(const std::string& unit, bool in_plane) {
    const std::string example = fmt::format("\"1 {}\"", unit);
    const Key start = within(with_default(number_key("start", "s", "\"1 s\"", "when it begins"), 0), io::not_negative);
    const Key frequency =
        within(required(number_key("frequency", "Hz", "\"1 Hz\"", "cycles in a second")), io::positive);
    const Key cycles = within(number_key("cycles", "1", "2.5", "how many; left out: to the end"), io::positive);
    const Key amplitude = required(number_key("amplitude", unit, example, "half the way between the extremes"));

    Table table{.description = "One part of a path; the parts add up",
                .keys = {{.name = "shape",
                          .form = Form::choice,
                          .required = true,
                          .choices = {"constant", "ramp", "sine", "triangle", "table"},
                          .example = "\"sine\"",
                          .description = "how it runs"}},
                .selector = "shape"};
    if (in_plane)
        table.keys.push_back(
            with_default(number_key("direction", "rad", "\"90 deg\"", "in the plane, from the first axis"), 0));
    table.alternatives = {
        {"constant", "a value that does not change", {required(number_key("value", unit, example, "the value"))}},
        {"ramp",
         "0 until `start`, then linear, and `change` from start + duration on",
         {required(number_key("change", unit, example, "what it changes the path by")), start,
          within(required(number_key("duration", "s", "\"1 s\"", "how long it takes")), io::positive)}},
        {"sine",
         "amplitude sin(2 pi frequency (t - start) + phase)",
         {amplitude, frequency, with_default(number_key("phase", "rad", "\"90 deg\"", "phase at `start`"), 0), start,
          cycles}},
        {"triangle", "like a sine, but straight between its extremes", {amplitude, frequency, start, cycles}},
        {"table",
         "points of a table with a header, straight between them; numbers without a unit are in SI units",
         {{.name = "file",
           .form = Form::text,
           .required = true,
           .example = "\"path.csv\"",
           .description = "the file, beside this one"},
          {.name = "column",
           .form = Form::text,
           .required = true,
           .example = "\"displacement\"",
           .description = "the name of the column with the values, and its unit if the table has none: \"x [mm]\""},
          {.name = "time",
           .form = Form::text,
           .fallback_text = "time",
           .example = "\"time\"",
           .description = "the name of the column with the times"}}}};
    return table;
}

Key path_key(std::string name, const std::string& unit, bool in_plane, std::string description) {
    Key key{.name = std::move(name), .form = Form::tables, .description = std::move(description)};
    key.tables.push_back(part_table(unit, in_plane));
    return key;
}

Table mass_table() {
    return {
        .description = "A mass over the ground, held by a spring and a damper",
        .keys = {
            within(required(number_key("mass", "kg", "\"1 kg\"", "m, mass")), io::positive),
            within(with_default(number_key("stiffness", "N/m", "\"1e3 N/m\"", "of the spring to the support"), 0),
                   io::not_negative),
            within(with_default(number_key("damping", "N s/m", "\"1 N s/m\"", "of the damper beside the spring"), 0),
                   io::not_negative),
            path_key("support", "m", true, "displacement of the spring's far end"),
            path_key("force", "N", true, "a force on the mass"),
            path_key("belt", "m/s", true, "velocity of the ground")}};
}

Table rig_table() {
    Key mass = io::table_key("mass", mass_table());
    mass.description = "a mass over the ground";
    Key sample = within(number_key("sample", "s", "\"1 ms\"", "output period"), io::positive);
    sample.fallback_text = "end / 1000";
    return {.description = "How the contact is driven",
            .keys = {within(required(number_key("end", "s", "\"1 s\"", "how long to drive")), io::positive),
                     std::move(sample),
                     within(with_default(number_key("tolerance", "1", "1e-10", "relative error of a step"), 1e-10),
                            {1e-14, 1e-3}),
                     within(with_default(number_key("max_evaluations", "1", "1e9",
                                                    "a run that needs more evaluations is stopped"),
                                         1e8),
                            {1}),
                     within(with_default(number_key("max_memory", "1", "16e9",
                                                    "bytes; a run whose samples and events take more is refused"),
                                         4e9),
                            {1}),
                     path_key("indentation", "m", false, "z; negative above the ground"),
                     path_key("load", "N", false, "F_n, > 0; the depth follows without inertia or damping"),
                     path_key("displacement", "m", true, "slip displacement"),
                     path_key("velocity", "m/s", true, "slip velocity"), std::move(mass)},
            .one_of = {{{"indentation", "load"}, true}, {{"displacement", "velocity", "mass"}}}};
}

Table table_of(const io::Choices& choices) {
    // The laws are chosen as in a scenario.
    Table contact{.description = "The laws of the contact"};
    for (const Key& key : io::scenario_table(choices).keys) {
        if (key.name != "contact") continue;
        for (const Key& part : key.tables.front().keys)
            if (part.name == "normal" || part.name == "friction") contact.keys.push_back(part);
    }
    return {.description = "A test rig of footfall",
            .keys = {{.name = "title", .form = Form::text, .example = "\"A loop\"", .description = "one line about it"},
                     io::table_key("rig", rig_table(), true),
                     io::table_key("contact", std::move(contact), true)}};
}

// The paths of a rig: their keys, and what a table of points holds for each.
const io::Sought indentation{.name = "indentation", .unit = "m", .plausible = 0.1};
const io::Sought load{.name = "load", .unit = "N"};
const io::Sought displacement{.name = "displacement", .unit = "m"};
const io::Sought velocity{.name = "velocity", .unit = "m/s"};
const io::Sought support{.name = "support", .unit = "m"};
const io::Sought force{.name = "force", .unit = "N"};
const io::Sought belt{.name = "belt", .unit = "m/s"};

// Tables of points ----------------------------------------------------------------------------------------------------

/// Reads the times and the values of a path from a table; `unit` is that of the values. Throws ScenarioError with file
/// and line, or std::system_error.
TablePart read_points(const std::filesystem::path& file, const std::string& time, const std::string& column,
                      const io::Sought& sought, TableRemarks& remarks) {
    enum : std::size_t { of_time, of_value };
    TableInput input{.columns = {{std::string(sought.name), column}}, .where = {}};
    // The default is a time by any of its names.
    if (time != "time") input.columns.emplace("time", time);
    io::TableReader table(io::read_file(file), file.string(),
                          {{.name = "time",
                            .unit = "s",
                            .names = {"t", "elapsed", "elapsed_time", "timestamp"},
                            .order = io::Sought::Order::rising},
                           sought},
                          input, "needed are a time and the column of the path");
    if (!table.has(of_time)) table.refuse_header("there is no column 'time'; `time` names it");
    std::vector<std::vector<double>> values = table.read(std::array{std::size_t{of_time}, std::size_t{of_value}});
    if (values[of_time].size() < 2) throw InvalidInput(fmt::format("{}: at least two rows are needed", file.string()));
    // Which columns are read is for the rig to say; the others are not named.
    for (std::string& warning : table.remarks().warnings) remarks.warnings.push_back(std::move(warning));
    return {std::move(values[of_time]), std::move(values[of_value])};
}

// The rig -------------------------------------------------------------------------------------------------------------

class Builder {
public:
    Builder(const Record& root, std::filesystem::path folder, Problems& problems)
        : root_(root), folder_(std::move(folder)), problems_(problems) {}

    RigFile build() {
        const Record& record = root_.table("rig");
        Rig& rig = made_.rig;
        rig.title = root_.text("title");
        rig.end_time = record.number("end");
        if (record.has("sample")) rig.sample_period = record.number("sample");
        rig.tolerance = record.number("tolerance");
        rig.max_evaluations = record.number("max_evaluations");
        rig.max_memory = record.number("max_memory");
        rig.press = record.has("load") ? Press::load : Press::indentation;
        rig.pressing = rig.press == Press::load ? line(record, load) : line(record, indentation);
        if (record.has("velocity")) {
            rig.drag = Drag::velocity;
            rig.dragging = plane(record, velocity);
        } else if (record.has("mass")) {
            rig.drag = Drag::mass;
            const Record& mass = record.table("mass");
            rig.mass = {mass.number("mass"),  mass.number("stiffness"), mass.number("damping"),
                        plane(mass, support), plane(mass, force),       plane(mass, belt)};
        } else {
            rig.dragging = plane(record, displacement);
        }
        const Record& contact = root_.table("contact");
        made_.laws.normal = law<NormalLaw>(contact.table("normal"));
        if (contact.has("friction")) made_.laws.friction = law<FrictionLaw>(contact.table("friction"));
        return std::move(made_);
    }

private:
    template <class Variant>
    static Variant law(const Record& record) {
        Variant made{};
        for_each_law<Variant>([&](auto law) {
            if (law.description.name != record.text("law")) return;
            for (const auto& parameter : decltype(law)::parameters())
                law.*(parameter.member) = record.number(parameter.key);
            made = law;
        });
        return made;
    }

    PathPart part(const Record& record, const io::Sought& sought) {
        const std::string& shape = record.text("shape");
        if (shape == "constant") return ConstantPart{record.number("value")};
        if (shape == "ramp")
            return RampPart{record.number("change"), record.number("start"), record.number("duration")};
        const auto cycles = [&] { return record.has("cycles") ? record.number("cycles") : SinePart{}.cycles; };
        if (shape == "sine")
            return SinePart{record.number("amplitude"), record.number("frequency"), record.number("phase"),
                            record.number("start"), cycles()};
        if (shape == "triangle")
            return TrianglePart{record.number("amplitude"), record.number("frequency"), record.number("start"),
                                cycles()};
        try {
            made_.tables.push_back(folder_ / record.text("file"));
            return read_points(made_.tables.back(), record.text("time"), record.text("column"), sought,
                               made_.rig.remarks);
        } catch (const ScenarioError& error) {
            for (const ScenarioProblem& problem : error.problems()) {
                problems_.add(record["file"].at, fmt::format("{}:{}:{}: {}", (folder_ / record.text("file")).string(),
                                                             problem.line, problem.column, problem.message));
            }
        } catch (const InvalidInput& error) {
            problems_.add(record["file"].at, error.what());
        } catch (const std::system_error& error) {
            problems_.add(record["file"].at, error.what());
        }
        return ConstantPart{};
    }

    Path line(const Record& record, const io::Sought& sought) {
        Path path;
        for (const Record& each : record[sought.name].records) path.add(part(each, sought));
        return path;
    }

    PlanePath plane(const Record& record, const io::Sought& sought) {
        PlanePath path;
        if (!record.has(sought.name)) return path;
        for (const Record& each : record[sought.name].records) {
            const Path along{{part(each, sought)}};
            const double angle = each.number("direction");
            // A right angle in degrees is not one in binary: what remains of it is nothing.
            const auto share = [](double x) { return std::abs(x) < 1e-15 ? 0.0 : x; };
            for (const auto& [component, factor] :
                 {std::pair{0, share(std::cos(angle))}, std::pair{1, share(std::sin(angle))}}) {
                const Path scaled = along.scaled(factor);
                if (factor != 0) path[static_cast<std::size_t>(component)].add(scaled.parts().front());
            }
        }
        return path;
    }

    const Record& root_;
    std::filesystem::path folder_;
    Problems& problems_;
    RigFile made_;
};

}  // namespace

RigFile parse_rig(const std::string& text, const std::filesystem::path& name, const std::vector<Setting>& settings) {
    const Document document(text, name.string(), settings);
    Problems problems(name.string());
    io::Choices choices;
    choices.normal_law = document.text("contact.normal.law");
    choices.friction_law = document.text("contact.friction.law");
    const Record root = document.read(table_of(choices), problems);
    problems.throw_if_any();
    RigFile file = Builder(root, name.parent_path(), problems).build();
    problems.throw_if_any();
    file.text = settings.empty() ? text : document.written(settings);
    file.friction_left_out = !document.has("contact.friction");
    try {
        check(file.rig);
        check(file.laws, "contact");
    } catch (const InvalidInput& error) {
        problems.add(root.table("rig").at, error.what());
        problems.throw_if_any();
    }
    return file;
}

RigFile load_rig(const std::filesystem::path& file, const std::vector<Setting>& settings) {
    return parse_rig(io::read_file(file, io::largest_toml), file, settings);
}

}  // namespace footfall
