// footfall._core: the C++ library as the Python package uses it. What users import is in python/footfall.
#include "bind.hpp"
#include "footfall/version.hpp"

NB_MODULE(_core, module) {
    module.doc() = "The C++ library of footfall. Use `import footfall`.";
    module.attr("__version__") = nanobind::str(footfall::version.data(), footfall::version.size());
    footfall::python::bind_errors(module);
    footfall::python::bind_laws(module);
    footfall::python::bind_channels(module);
    footfall::python::bind_contact(module);
    footfall::python::bind_contact_set(module);
    footfall::python::bind_scenario(module);
    footfall::python::bind_run(module);
    footfall::python::bind_studies(module);
}
