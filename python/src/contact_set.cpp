// Contacts in the loop of a simulator in Python. footfall/contact_set.py gives arrays of the right types; their sizes
// and numbers are checked by the library.
#include "footfall/host/contact_set.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "arrays.hpp"
#include "bind.hpp"
#include "footfall/energy/channels.hpp"

namespace footfall::python {
namespace {

using Numbers = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Phases = nb::ndarray<const std::int8_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

std::span<const double> span_of(const Numbers& array) { return {array.data(), array.size()}; }
std::span<const double> span_of(const std::optional<Numbers>& array) {
    return array ? span_of(*array) : std::span<const double>();
}

nb::object numbers(std::span<const double> values) {
    return to_numpy(std::vector<double>(values.begin(), values.end()), {values.size()});
}
nb::object phases_of(const ContactSet& set) {
    std::vector<std::int8_t> phases;
    for (const Phase phase : set.phases()) phases.push_back(static_cast<std::int8_t>(phase));
    const std::size_t count = phases.size();
    return to_numpy(std::move(phases), {count});
}

ContactSet make(const std::vector<std::pair<NormalLaw, FrictionLaw>>& laws, double tolerance,
                std::int64_t max_evaluations) {
    std::vector<ContactParameters> contacts;
    for (const auto& [normal, friction] : laws) contacts.push_back({normal, friction});
    return ContactSet(std::move(contacts), {tolerance, max_evaluations});
}

/// What a step gives back, in the order in which contact_set.py takes it.
nb::tuple result(const ContactSet& set) {
    const ContactSetStep& step = set.last();
    nb::list events;
    for (const HostEvent& e : step.events)
        events.append(nb::make_tuple(e.time, e.contact, nb::str(name_of(e.kind).data(), name_of(e.kind).size())));
    std::vector<double> channels;
    for (const auto& channel : contact_channels)
        for (const ContactEnergy& e : step.energy) channels.push_back(e.*channel.member);
    return nb::make_tuple(numbers(step.impulse), numbers(step.double_impulse), numbers(step.angular_impulse),
                          numbers(set.states()), phases_of(set), events,
                          to_numpy(std::move(channels), {contact_channels.size(), step.energy.size()}),
                          step.held_before, step.contact_work, step.ground_work, step.residual, step.energy_scale,
                          step.unresolved_loss, step.unresolved_time, step.evaluations);
}

}  // namespace

void bind_contact_set(nb::module_& module) {
    nb::class_<ContactSet>(module, "ContactSet", "Contacts inside a host's step, over flat arrays.")
        .def(
            "__init__",
            [](ContactSet* self, const std::vector<std::pair<NormalLaw, FrictionLaw>>& laws, double tolerance,
               std::int64_t max_evaluations) { new (self) ContactSet(make(laws, tolerance, max_evaluations)); },
            nb::sig("def __init__(self, laws: list[tuple[object, object]], tolerance: float, max_evaluations: int) -> "
                    "None"))
        .def(
            "step",
            [](ContactSet& self, double dt, const Numbers& depth, const Numbers& velocity,
               const Numbers& free_acceleration, const Numbers& delassus, const std::optional<Numbers>& ground_velocity,
               const std::optional<Numbers>& frame_spin, const std::optional<Numbers>& radius,
               const std::optional<Numbers>& spin, const std::optional<Numbers>& rolling) {
                const HostStep host{dt,
                                    span_of(depth),
                                    span_of(velocity),
                                    span_of(free_acceleration),
                                    span_of(delassus),
                                    span_of(ground_velocity),
                                    span_of(frame_spin),
                                    span_of(radius),
                                    span_of(spin),
                                    span_of(rolling)};
                {
                    const nb::gil_scoped_release free;
                    self.step(host);
                }
                return result(self);
            },
            nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg().none(), nb::arg().none(), nb::arg().none(),
            nb::arg().none(), nb::arg().none(), nb::sig("def step(self, *arguments: object) -> tuple[object, ...]"))
        .def(
            "restore",
            [](ContactSet& self, const Numbers& states, const Phases& phases) {
                std::vector<Phase> restored;
                for (std::size_t i = 0; i < phases.size(); ++i)
                    restored.push_back(Phase{static_cast<std::uint8_t>(phases.data()[i])});
                self.restore(span_of(states), restored);
            },
            nb::sig("def restore(self, states: object, phases: object) -> None"))
        .def("reset", &ContactSet::reset)
        .def_prop_ro(
            "states", [](const ContactSet& self) { return numbers(self.states()); },
            nb::sig("def states(self) -> object"))
        .def_prop_ro("phase", &phases_of, nb::sig("def phase(self) -> object"))
        .def_prop_ro(
            "bristle",
            [](const ContactSet& self) {
                std::vector<double> all;
                for (int i = 0; i < self.contacts(); ++i) {
                    const Vector2<double> u = self.bristle(i);
                    all.push_back(u.x());
                    all.push_back(u.y());
                }
                return to_numpy(std::move(all), {static_cast<std::size_t>(self.contacts()), 2});
            },
            nb::sig("def bristle(self) -> object"));
}

}  // namespace footfall::python
