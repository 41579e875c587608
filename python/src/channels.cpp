// The table of the channels of energy, from which footfall/_channels.py makes names, attributes and legends.
#include "channels.hpp"

#include <string>
#include <string_view>

#include <fmt/format.h>

#include "bind.hpp"

namespace footfall::python {
namespace {

nb::str text(std::string_view value) { return nb::str(value.data(), value.size()); }

// Python makes the attributes of Energy and of Response from the table. Type checkers cannot follow that: they read
// them in the stubs of these two, of which there are no objects.
struct EnergyChannels {};
struct ResponseChannels {};

template <class Fields>
void attribute(nb::class_<Fields>& fields, const std::string& name, std::string_view type, const std::string& doc) {
    const std::string signature = fmt::format("def {}(self, /) -> {}", name, type);
    fields.def_prop_ro(
        name.c_str(), [](const Fields& /*none*/) { return nb::none(); }, nb::sig(signature.c_str()), doc.c_str());
}

}  // namespace

void bind_channels(nb::module_& module) {
    nb::class_<ContactChannel>(module, "Channel", "A channel of energy of a contact.")
        .def_prop_ro("name", [](const ContactChannel& c) { return text(c.name); })
        .def_prop_ro(
            "symbol", [](const ContactChannel& c) { return text(c.symbol); }, "Of docs/theory.md; may be empty.")
        .def_prop_ro("unit", [](const ContactChannel& c) { return text(c.unit); })
        .def_prop_ro(
            "kind", [](const ContactChannel& c) { return text(name_of(c.kind)); }, "held, taken, unpaid or worked.")
        .def_prop_ro(
            "label", [](const ContactChannel& c) { return text(c.label); }, "For a legend.")
        .def_prop_ro("description", [](const ContactChannel& c) { return text(c.description); })
        .def_prop_ro(
            "response", [](const ContactChannel& c) { return text(response_name(c)); },
            "Its array in a Response: the energy where it is held, else its rate.");
    nb::list channels;
    for (const ContactChannel& channel : contact_channels)
        channels.append(nb::cast(&channel, nb::rv_policy::reference));
    module.attr("CHANNELS") = nb::tuple(channels);

    nb::class_<EnergyChannels> energy(module, "EnergyChannels", "The channels of a footfall.Energy.");
    nb::class_<ResponseChannels> response(module, "ResponseChannels", "The channels of a footfall.Response.");
    for (const ContactChannel& channel : contact_channels) {
        const std::string doc(channel.description);
        attribute(energy, std::string(channel.name), "float", doc);
        attribute(response, response_name(channel), "numpy.typing.NDArray[numpy.float64]", doc);
    }
}

}  // namespace footfall::python
