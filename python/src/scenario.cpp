// A scenario and what it describes, to read.
#include "footfall/io/scenario.hpp"

#include <filesystem>
#include <string>

#include <nanobind/eigen/dense.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "bind.hpp"
#include "footfall/io/output.hpp"
#include "io/nearest.hpp"
#include "named_scenario.hpp"

namespace footfall::python {

void bind_scenario(nb::module_& module) {
    module.def(
        "did_you_mean",
        [](const std::string& word, const std::vector<std::string>& words) { return io::did_you_mean(word, words); },
        nb::arg("word"), nb::arg("words"),
        "\": did you mean 'WORD'?\" with the nearest of the words, or nothing where none is near.");
    nb::class_<Sphere>(module, "Sphere", "One sphere of a body.")
        .def_ro("center", &Sphere::center, "From the centre of mass, in the body's frame [m], shape (3,).")
        .def_ro("radius", &Sphere::radius, "r [m], > 0.");
    nb::class_<Body>(module, "Body", "A rigid body.")
        .def_ro("mass", &Body::mass, "m [kg], > 0.")
        .def_ro("inertia", &Body::inertia, "About the centre of mass, in the body's frame [kg m^2], shape (3, 3).")
        .def_ro("spheres", &Body::spheres, "What it touches the ground with; at least one.");
    nb::class_<Ground>(module, "Ground", "The plane normal . x = height.")
        .def_ro("normal", &Ground::normal, "Unit vector, world frame, shape (3,).")
        .def_ro("height", &Ground::height, "[m]");
    nb::class_<BodyState>(module, "BodyState", "Position and motion of a body, in the world's frame.")
        .def_ro("position", &BodyState::position, "Of the centre of mass [m], shape (3,).")
        .def_ro("velocity", &BodyState::velocity, "Of the centre of mass [m/s], shape (3,).")
        .def_prop_ro(
            "orientation",
            [](const BodyState& state) {
                const Eigen::Quaterniond& q = state.orientation;
                return Eigen::Vector4d(q.w(), q.x(), q.y(), q.z());
            },
            "Unit quaternion w, x, y, z from the body's frame to the world's, shape (4,).")
        .def_ro("angular_velocity", &BodyState::angular_velocity, "[rad/s], shape (3,).");
    nb::class_<ContactParameters>(module, "ContactParameters", "The laws of one sphere.")
        .def_ro("normal", &ContactParameters::normal, "A normal law of footfall.laws.")
        .def_ro("friction", &ContactParameters::friction, "A friction law of footfall.laws.");
    nb::class_<RunOptions>(module, "RunOptions", "How long and how exact a run is.")
        .def_ro("end_time", &RunOptions::end_time, "[s], > 0.")
        .def_ro("sample_period", &RunOptions::sample_period, "[s]; 0: only the first and the last moment.")
        .def_ro("tolerance", &RunOptions::tolerance, "Relative error of a step, from 1e-14 to 1e-3.")
        .def_ro("max_evaluations", &RunOptions::max_evaluations, "Of the equations of motion; more is TooExpensive.")
        .def_ro("max_memory", &RunOptions::max_memory, "Of samples and events [bytes]; more is TooExpensive.")
        .def_ro("allow_initial_penetration", &RunOptions::allow_initial_penetration);
    nb::class_<Simulation>(module, "Simulation", "One body over one ground, in SI units. To read; change the scenario.")
        .def_ro("body", &Simulation::body)
        .def_ro("ground", &Simulation::ground)
        .def_ro("gravity", &Simulation::gravity, "[m/s^2], world frame, shape (3,).")
        .def_ro("initial", &Simulation::initial)
        .def_ro("contacts", &Simulation::contacts, "The laws of each sphere, in the body's order.")
        .def_ro("options", &Simulation::options);
    nb::class_<NamedScenario>(module, "Scenario", "A scenario and the name that messages call it by.")
        .def_static(
            "load",
            [](const std::filesystem::path& file) {
                return NamedScenario{load_scenario(file), file.string()};
            },
            nb::arg("file"))
        .def_static(
            "parse",
            [](const std::string& text, const std::string& name) {
                return NamedScenario{parse_scenario(text, name), name};
            },
            nb::arg("text"), nb::arg("name"))
        .def_prop_ro("name", [](const NamedScenario& s) { return printable(s.name); })
        .def_prop_ro("title", [](const NamedScenario& s) { return s.scenario.title; })
        .def_prop_ro("text", [](const NamedScenario& s) { return s.scenario.text; })
        .def(
            "summary", [](const NamedScenario& s) { return summary(s.scenario); },
            "What the scenario describes, as a page for a person.")
        .def_prop_ro(
            "simulation", [](const NamedScenario& s) -> const Simulation& { return s.scenario.simulation; },
            nb::rv_policy::reference_internal);
}

}  // namespace footfall::python
