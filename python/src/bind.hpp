// The parts that footfall._core is made of. Each binds one thing; module.cpp calls them in order.
#pragma once

#include <stdexcept>
#include <string_view>

#include <nanobind/nanobind.h>

namespace footfall::python {

namespace nb = nanobind;

/// Text for a person. Names of files may be no UTF-8; their other bytes are shown as escapes.
inline nb::str printable(std::string_view text) {
    return nb::steal<nb::str>(
        PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "backslashreplace"));
}

/// Becomes Python's MemoryError; the message says what was asked for.
class OutOfMemory : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// C++ errors become the exceptions of footfall.errors.
void bind_errors(nb::module_& module);
/// A class for every registered law, in the submodule `laws`.
void bind_laws(nb::module_& module);
/// The channels of energy, in the order of every output.
void bind_channels(nb::module_& module);
/// The contact law over arrays.
void bind_contact(nb::module_& module);
/// Contacts in the loop of a simulator.
void bind_contact_set(nb::module_& module);
void bind_scenario(nb::module_& module);
void bind_run(nb::module_& module);
void bind_studies(nb::module_& module);

}  // namespace footfall::python
