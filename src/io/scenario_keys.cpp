// The keys of a scenario file: this is the only place that lists them. The keys of the laws come from the laws.
#include "io/scenario_keys.hpp"

#include <algorithm>
#include <type_traits>

#include <fmt/format.h>

namespace footfall::io {
namespace {

constexpr double quarter_turn = 1.5707963267948966;  // pi / 2

/// How a number with this unit may be written.
std::string example_of(std::string_view unit, bool plain) {
    if (unit == "1") return "0.5";
    return plain ? "1e6" : fmt::format("\"1e3 {}\"", unit);
}

constexpr std::string_view comes_from_material =
    "[contact.material] gives this coefficient: give either the materials or the coefficients";

/// The keys of a law's parameters. Where `common` is false, they are for one sphere: each may be left out, and is then
/// the same as for all.
template <class Law>
std::vector<Key> parameter_keys(bool common, bool materials) {
    std::vector<Key> keys;
    for (const auto& parameter : Law::parameters()) {
        Key key;
        key.name = parameter.key;
        key.unit = parameter.unit;
        key.plain = parameter.unit_depends;
        key.range = parameter.may_be_zero() ? not_negative : positive;
        if (parameter.at_most_one) key.range.high = 1;
        key.description = fmt::format("{}, {}", parameter.symbol, parameter.description);
        if (parameter.may_be_zero()) key.description += fmt::format("; 0: {}", parameter.when_zero);
        key.example = example_of(parameter.unit, parameter.unit_depends);
        if (materials && from_material<Law>(parameter)) {
            key.refused = comes_from_material;
        } else if (common) {
            key.required = !parameter.fallback;
            if (parameter.fallback) key.fallback = {*parameter.fallback};
        }
        keys.push_back(std::move(key));
    }
    return keys;
}

template <class Variant>
std::vector<std::string> law_names(bool materials) {
    std::vector<std::string> names;
    for_each_law<Variant>([&](const auto& law) {
        using Law = std::remove_cvref_t<decltype(law)>;
        if (!materials || FromMaterial<Law>::known || Law::parameters().empty()) {
            names.emplace_back(law.description.name);
        }
    });
    return names;
}

/// [contact.normal] and [contact.friction].
template <class Variant>
Table law_table(const std::string& description, bool materials) {
    Table table{.description = description,
                .keys = {{.name = "law",
                          .form = Form::choice,
                          .required = true,
                          .choices = law_names<Variant>(materials),
                          .choices_where = materials ? "with [contact.material], " : "",
                          .example = "\"azad-featherstone\"",
                          .description = "the law"}},
                .selector = "law"};
    for_each_law<Variant>([&](const auto& law) {
        using Law = std::remove_cvref_t<decltype(law)>;
        if (materials && !FromMaterial<Law>::known && !Law::parameters().empty()) return;
        table.alternatives.push_back({std::string(law.description.name), std::string(law.description.formula),
                                      parameter_keys<Law>(true, materials)});
    });
    return table;
}

/// [body.spheres.normal] and [body.spheres.friction]: some parameters of the law that all spheres have. Where there is
/// no such law, the alternatives hold the keys of every law.
template <class Variant>
Table override_table(std::string_view kind, const std::optional<std::string>& chosen, bool materials) {
    const std::vector<std::string> names = law_names<Variant>(false);
    const bool known = chosen && std::find(names.begin(), names.end(), *chosen) != names.end();
    Table table{.description = fmt::format("Parameters of this sphere in place of those of [contact.{}]", kind)};
    for_each_law<Variant>([&](const auto& law) {
        using Law = std::remove_cvref_t<decltype(law)>;
        std::vector<Key> keys = parameter_keys<Law>(false, materials);
        if (!known) {
            table.alternatives.push_back({std::string(law.description.name), "", std::move(keys)});
        } else if (*chosen == law.description.name) {
            table.keys = std::move(keys);
            if (table.keys.empty()) {
                table.without_keys =
                    fmt::format("[contact.{}] has the law '{}', which has no parameters", kind, law.description.name);
            }
        }
    });
    table.keys.push_back({.name = "law",
                          .refused = fmt::format("all spheres have the law of [contact.{}]; a sphere may only have "
                                                 "other parameters",
                                                 kind)});
    return table;
}

Table material_side(std::string description) {
    return {.description = std::move(description),
            .keys = {{.name = "youngs_modulus",
                      .unit = "Pa",
                      .range = positive,
                      .required = true,
                      .example = "\"210 GPa\"",
                      .description = "E, Young's modulus"},
                     {.name = "poisson_ratio",
                      .range = {-1, 0.5, true, false},
                      .required = true,
                      .example = "0.3",
                      .description = "nu, Poisson's ratio"}}};
}

Table material_table() {
    return {.description = "What both sides are made of, in place of stiffness and damping, (8)-(12), (20)-(24)",
            .keys = {{.name = "sphere",
                      .form = Form::table,
                      .required = true,
                      .description = "what the spheres are made of",
                      .tables = {material_side("What the spheres are made of")}},
                     {.name = "ground",
                      .form = Form::table,
                      .required = true,
                      .description = "what the ground is made of",
                      .tables = {material_side("What the ground is made of")}},
                     {.name = "damping_coefficient",
                      .unit = "N s/m^2.5",
                      .range = not_negative,
                      .example = "\"1.5e4 N s/m^2.5\"",
                      .description = "alpha of (11): D_A = alpha z^(-1/2), D_n = D_t = 4 pi r alpha"},
                     {.name = "damping_time",
                      .unit = "s",
                      .range = not_negative,
                      .example = "\"0.2 ms\"",
                      .description = "tau = D_A / K_A, so D_n = (3/2) tau K_n and D_t = tau K_t"}},
            .one_of = {{{"damping_coefficient", "damping_time"}, true}}};
}

Table contact_table(const Choices& choices) {
    return {.description = "How the spheres and the ground push each other",
            .keys = {{.name = "allow_initial_penetration",
                      .form = Form::flag,
                      .example = "true",
                      .description = "spheres may start in the ground, their springs loaded"},
                     {.name = "normal",
                      .form = Form::table,
                      .required = true,
                      .description = "the normal force of all spheres",
                      .tables = {law_table<NormalLaw>("The normal force of all spheres", choices.materials)}},
                     {.name = "friction",
                      .form = Form::table,
                      .description = "the friction of all spheres; left out: law = \"none\"",
                      .tables = {law_table<FrictionLaw>("The friction of all spheres", choices.materials)}},
                     {.name = "material",
                      .form = Form::table,
                      .description = "stiffness and damping from materials",
                      .tables = {material_table()}}}};
}

Table sphere_table(const Choices& choices) {
    return {.description = "One sphere of the body",
            .keys = {{.name = "radius",
                      .unit = "m",
                      .range = positive,
                      .required = true,
                      .example = "\"1.65 cm\"",
                      .description = "r, radius"},
                     {.name = "center",
                      .form = Form::numbers,
                      .unit = "m",
                      .fallback = {0, 0, 0},
                      .example = "[\"5 cm\", 0, 0]",
                      .description = "from the centre of mass, in the body's frame"},
                     {.name = "normal",
                      .form = Form::table,
                      .description = "its own parameters of the normal force",
                      .tables = {override_table<NormalLaw>("normal", choices.normal_law, choices.materials)}},
                     {.name = "friction",
                      .form = Form::table,
                      .description = "its own parameters of the friction",
                      .tables = {override_table<FrictionLaw>("friction", choices.friction_law, choices.materials)}}}};
}

Table rotation_table() {
    return {.description = "A turn from the world's axes to the body's",
            .keys = {{.name = "axis",
                      .form = Form::numbers,
                      .nonzero = true,
                      .required = true,
                      .example = "[0, 1, 0]",
                      .description = "of any length, in the world's frame"},
                     {.name = "angle",
                      .unit = "rad",
                      .required = true,
                      .example = "\"20 deg\"",
                      .description = "right-handed about the axis"}}};
}

Table initial_table() {
    return {
        .description = "Where the body starts, and how fast, in the world's frame",
        .keys = {{.name = "position",
                  .form = Form::numbers,
                  .unit = "m",
                  .required = true,
                  .example = "[0, 0, \"10 cm\"]",
                  .description = "c, centre of mass"},
                 {.name = "velocity",
                  .form = Form::numbers,
                  .unit = "m/s",
                  .fallback = {0, 0, 0},
                  .example = "[0.5, 0.5, 0]",
                  .description = "of the centre of mass"},
                 {.name = "orientation",
                  .form = Form::numbers,
                  .length = 4,
                  .nonzero = true,
                  .fallback = {1, 0, 0, 0},
                  .example = "[1, 0, 0, 0]",
                  .description = "unit quaternion w, x, y, z from the body's frame to the world's; it is normalised "
                                 "where its length is 1 to within 1e-6, and refused otherwise"},
                 {.name = "rotation",
                  .form = Form::table,
                  .description = "the orientation as axis and angle",
                  .tables = {rotation_table()}},
                 {.name = "angular_velocity",
                  .form = Form::numbers,
                  .unit = "rad/s",
                  .fallback = {0, 0, 0},
                  .example = "[0, \"120 rpm\", 0]",
                  .description = "omega, in the world's frame"}},
        .one_of = {{{"orientation", "rotation"}}}};
}

Table body_table(const Choices& choices) {
    return {
        .description = "The rigid body",
        .keys = {{.name = "mass",
                  .unit = "kg",
                  .range = positive,
                  .required = true,
                  .example = "\"154 g\"",
                  .description = "m, mass"},
                 {.name = "inertia",
                  .form = Form::inertia,
                  .unit = "kg m^2",
                  .required = true,
                  .choices = {"solid-sphere", "hollow-sphere"},
                  .example = "\"solid-sphere\"",
                  .description = "about the centre of mass, in the body's frame: of the one sphere, which is at the "
                                 "centre then; three principal moments; or a symmetric 3x3 tensor. Positive "
                                 "definite, and no principal moment above the sum of the other two"},
                 {.name = "spheres",
                  .form = Form::tables,
                  .required = true,
                  .description = "the spheres that the body touches the ground with",
                  .tables = {sphere_table(choices)}},
                 {.name = "initial",
                  .form = Form::table,
                  .required = true,
                  .description = "where the body starts",
                  .tables = {initial_table()}}}};
}

Table time_table() {
    return {.description = "How long to run and what to record",
            .keys = {{.name = "end",
                      .unit = "s",
                      .range = positive,
                      .required = true,
                      .example = "1.0",
                      .description = "duration of the run"},
                     {.name = "sample",
                      .unit = "s",
                      .range = not_negative,
                      .fallback_text = "end / 1000",
                      .example = "\"0.1 ms\"",
                      .description = "output period; 0: the first and the last moment only"}}};
}

Table solver_table() {
    return {.description = "How exactly to run",
            .keys = {{.name = "tolerance",
                      .range = {1e-14, 1e-3},
                      .fallback = {1e-10},
                      .example = "1e-10",
                      .description = "relative error of a step"},
                     {.name = "max_evaluations",
                      .range = {1},
                      .fallback = {1e8},
                      .example = "1e9",
                      .description = "a run that needs more evaluations of the equations of motion is refused"},
                     {.name = "max_memory",
                      .range = {1},
                      .fallback = {4e9},
                      .example = "16e9",
                      .description = "bytes; a run whose samples and events take more memory is refused"}}};
}

Table gravity_table() {
    return {.description = "Gravity",
            .keys = {{.name = "acceleration",
                      .form = Form::numbers,
                      .unit = "m/s^2",
                      .fallback = {0, 0, -9.81},
                      .example = "[0, 0, -9.81]",
                      .description = "of free fall, in the world's frame"}}};
}

Table ground_table() {
    return {.description = "The ground: the plane of the points x with normal . x = height",
            .keys = {{.name = "normal",
                      .form = Form::numbers,
                      .nonzero = true,
                      .fallback = {0, 0, 1},
                      .example = "[0, 0, 1]",
                      .description = "towards the body's side, in the world's frame; of any length"},
                     {.name = "slope",
                      .unit = "rad",
                      .range = {-quarter_turn, quarter_turn},
                      .example = "\"20 deg\"",
                      .description = "the angle at which the ground falls towards +x: normal = [sin, 0, cos]"},
                     {.name = "height",
                      .unit = "m",
                      .fallback = {0},
                      .example = "0",
                      .description = "of the plane above the world's origin, along the normal"}},
            .one_of = {{{"normal", "slope"}}}};
}

}  // namespace

Table scenario_table(const Choices& choices) {
    return {.description = "A scenario of footfall: one body over one ground",
            .keys = {{.name = "title", .form = Form::text, .example = "\"A ball\"", .description = "one line about it"},
                     table_key("time", time_table(), true),
                     table_key("solver", solver_table()),
                     table_key("gravity", gravity_table()),
                     table_key("ground", ground_table()),
                     table_key("body", body_table(choices), true),
                     table_key("contact", contact_table(choices), true)}};
}

}  // namespace footfall::io
