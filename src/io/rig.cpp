// From a rig file to a Rig.
#include "footfall/io/rig.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>

#include <fmt/format.h>

#include "io/document.hpp"
#include "io/nearest.hpp"
#include "io/read.hpp"
#include "io/scenario_keys.hpp"

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
         "points of a CSV file with a header, in SI units, straight between them",
         {{.name = "file",
           .form = Form::text,
           .required = true,
           .example = "\"path.csv\"",
           .description = "the file, beside this one"},
          {.name = "column",
           .form = Form::text,
           .required = true,
           .example = "\"displacement\"",
           .description = "the name of the column with the values"},
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

// Tables of points ----------------------------------------------------------------------------------------------------

std::vector<std::string> cells_of(std::string_view line) {
    std::vector<std::string> cells;
    for (;;) {
        const std::size_t comma = line.find(',');
        cells.emplace_back(io::trimmed(line.substr(0, comma)));
        if (comma == std::string_view::npos) return cells;
        line.remove_prefix(comma + 1);
    }
}

/// Reads two columns of a CSV file. Throws InvalidInput with file and line.
TablePart read_points(const std::filesystem::path& file, const std::string& time, const std::string& column) {
    std::ifstream stream(file);
    if (!stream || std::filesystem::is_directory(file))
        throw InvalidInput(fmt::format("cannot read {}", file.string()));
    TablePart table;
    std::optional<std::pair<std::size_t, std::size_t>> columns;
    std::size_t width = 0;
    std::string line;
    for (int number = 1; std::getline(stream, line); ++number) {
        const std::string_view content = io::trimmed(line);
        if (content.empty() || content.front() == '#') continue;
        const auto fail = [&](const std::string& what) {
            throw InvalidInput(fmt::format("{}:{}: {}", file.string(), number, what));
        };
        const std::vector<std::string> cells = cells_of(content);
        if (!columns) {
            const auto find = [&](const std::string& name) {
                for (std::size_t i = 0; i < cells.size(); ++i)
                    if (cells[i] == name) return i;
                fail(fmt::format("no column '{}'{} (columns here: {})", name, io::did_you_mean(name, cells),
                                 io::listed(cells)));
                return cells.size();
            };
            columns.emplace(find(time), find(column));
            width = cells.size();
            continue;
        }
        if (cells.size() != width) fail(fmt::format("{} cells, the header has {}", cells.size(), width));
        const auto value = [&](std::size_t i) {
            double x = 0;
            const std::string& cell = cells[i];
            const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), x);
            if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(x))
                fail(fmt::format("'{}' is not a finite number", cell));
            return x;
        };
        const double t = value(columns->first);
        if (!table.time.empty() && !(t > table.time.back()))
            fail(fmt::format("time {:.6g} s is not after {:.6g} s", t, table.time.back()));
        table.time.push_back(t);
        table.value.push_back(value(columns->second));
    }
    if (table.time.size() < 2) throw InvalidInput(fmt::format("{}: at least two rows are needed", file.string()));
    return table;
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
        rig.press = record.has("load") ? Press::load : Press::indentation;
        rig.pressing = line(record, rig.press == Press::load ? "load" : "indentation");
        if (record.has("velocity")) {
            rig.drag = Drag::velocity;
            rig.dragging = plane(record, "velocity");
        } else if (record.has("mass")) {
            rig.drag = Drag::mass;
            const Record& mass = record.table("mass");
            rig.mass = {mass.number("mass"),    mass.number("stiffness"), mass.number("damping"),
                        plane(mass, "support"), plane(mass, "force"),     plane(mass, "belt")};
        } else {
            rig.dragging = plane(record, "displacement");
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

    PathPart part(const Record& record) {
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
            return read_points(folder_ / record.text("file"), record.text("time"), record.text("column"));
        } catch (const InvalidInput& error) {
            problems_.add(record["file"].at, error.what());
            return ConstantPart{};
        }
    }

    Path line(const Record& record, std::string_view key) {
        Path path;
        for (const Record& each : record[key].records) path.add(part(each));
        return path;
    }

    PlanePath plane(const Record& record, std::string_view key) {
        PlanePath path;
        if (!record.has(key)) return path;
        for (const Record& each : record[key].records) {
            const Path along{{part(each)}};
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

RigFile parse_rig(const std::string& text, const std::filesystem::path& name) {
    const Document document(text, name.string());
    Problems problems(name.string());
    io::Choices choices;
    choices.normal_law = document.text("contact.normal.law");
    choices.friction_law = document.text("contact.friction.law");
    const Record root = document.read(table_of(choices), problems);
    problems.throw_if_any();
    RigFile file = Builder(root, name.parent_path(), problems).build();
    problems.throw_if_any();
    try {
        check(file.rig);
        check(file.laws, "contact");
    } catch (const InvalidInput& error) {
        problems.add(root.table("rig").at, error.what());
        problems.throw_if_any();
    }
    return file;
}

RigFile load_rig(const std::filesystem::path& file) { return parse_rig(io::read_file(file), file); }

}  // namespace footfall
