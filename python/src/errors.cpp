// C++ errors as Python exceptions, with the same message.
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "bind.hpp"
#include "footfall/io/scenario.hpp"
#include "footfall/io/table_input.hpp"
#include "footfall/math/error.hpp"
#include "footfall/simulate/run.hpp"

namespace footfall::python {
namespace {

constexpr const char* no_memory = "what was asked for needs more memory than there is";

void raise(const char* type, const char* message) {
    const nb::object exception = nb::module_::import_("footfall.errors").attr(type);
    PyErr_SetObject(exception.ptr(), printable(message).ptr());
}

/// (line, column, message) of each problem goes with the exception.
void raise(const ScenarioError& error, const std::string& message) {
    nb::list problems;
    for (const ScenarioProblem& problem : error.problems()) {
        problems.append(nb::make_tuple(problem.line, problem.column, printable(problem.message)));
    }
    const nb::object type = nb::module_::import_("footfall.errors").attr("ScenarioError");
    const nb::object exception = type(printable(message), problems);
    PyErr_SetObject(type.ptr(), exception.ptr());
}

/// A file that cannot be read: OSError's own subclass for the reason, with our message.
void raise(const std::system_error& error, const std::string& message) {
    const int number = error.code().value();
    const nb::object os_error = nb::module_::import_("builtins").attr("OSError");
    const nb::object type = nb::borrow(os_error(number, "").type());
    const nb::object exception = type(printable(message));
    exception.attr("errno") = number;
    PyErr_SetObject(type.ptr(), exception.ptr());
}

}  // namespace

void bind_errors(nb::module_& /*module*/) {
    nb::register_exception_translator([](const std::exception_ptr& thrown, void* /*payload*/) {
        try {
            std::rethrow_exception(thrown);
        } catch (const BadRows& error) {
            raise(error, fmt::format("{}\nskip_bad_rows=True leaves such rows out", error.what()));
        } catch (const ScenarioError& error) {
            raise(error, error.what());
        } catch (const InvalidInput& error) {
            raise("InvalidInput", error.what());
        } catch (const TooExpensive& error) {
            raise("TooExpensive", error.what());
        } catch (const Interrupted& error) {
            raise("Interrupted", error.what());
        } catch (const std::filesystem::filesystem_error& error) {
            // Its what() begins with the words of the library.
            raise(error, error.path1().string() + ": " + error.code().message());
        } catch (const std::system_error& error) {
            raise(error, error.what());
        } catch (const OutOfMemory& error) {
            PyErr_SetObject(PyExc_MemoryError, printable(error.what()).ptr());
        } catch (const std::bad_alloc&) {
            PyErr_SetString(PyExc_MemoryError, no_memory);
        } catch (const std::length_error&) {
            PyErr_SetString(PyExc_MemoryError, no_memory);
        }
    });
}

}  // namespace footfall::python
