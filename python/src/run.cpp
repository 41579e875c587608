// A run as named arrays: what RUN.nc holds, for footfall/results.py to label.
#include "footfall/simulate/run.hpp"

#include <new>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arrays.hpp"
#include "bind.hpp"
#include "footfall/io/output.hpp"
#include "io/run_dataset.hpp"
#include "named_scenario.hpp"
#include "progress.hpp"

namespace footfall::python {
namespace {

/// What a run that finds no memory has asked for.
std::string out_of_memory(const std::string& name, const Simulation& simulation) {
    const RunOptions& options = simulation.options;
    if (!(options.sample_period > 0)) return fmt::format("{}: the run needs more memory than there is", name);
    return fmt::format("{}: the run needs more memory than there is: {:.3g} samples, one every {} s for {} s", name,
                       options.end_time / options.sample_period + 1, options.sample_period, options.end_time);
}

/// The run of a scenario, its errors named as the command line names them.
Run run_named(const NamedScenario& named, std::optional<double> tolerance, const nb::object& progress) {
    Simulation simulation = named.scenario.simulation;
    if (tolerance) simulation.options.tolerance = *tolerance;
    simulation.options.progress = progress_of(progress);
    const nb::gil_scoped_release free;
    try {
        return run(simulation);
    } catch (const InvalidInput& error) {
        throw InvalidInput(fmt::format("{}: {}", named.name, error.what()));
    } catch (const TooExpensive& error) {
        throw TooExpensive(fmt::format("{}: {}", named.name, error.what()));
    } catch (const Interrupted&) {
        throw Interrupted(fmt::format("{}: interrupted", named.name));
    } catch (const std::bad_alloc&) {
        throw OutOfMemory(out_of_memory(named.name, simulation));
    } catch (const std::length_error&) {
        throw OutOfMemory(out_of_memory(named.name, simulation));
    }
}

nb::dict attributes_of(const io::Variable& variable) {
    nb::dict attributes;
    attributes["units"] = variable.units;
    attributes["long_name"] = variable.long_name;
    if (variable.flag_count > 0) {
        std::vector<std::int8_t> flags(variable.flag_count);
        for (std::size_t i = 0; i < flags.size(); ++i) flags[i] = static_cast<std::int8_t>(i);
        attributes["flag_values"] = to_numpy(std::move(flags), {variable.flag_count});
        attributes["flag_meanings"] = variable.flag_meanings;
    }
    return attributes;
}

nb::object values_of(const io::Gather<double>& gather, const std::vector<std::size_t>& shape) {
    return to_numpy(gather(), shape);
}
nb::object values_of(const io::Gather<int>& gather, const std::vector<std::size_t>& shape) {
    return to_numpy(gather(), shape);
}
nb::object values_of(const io::Gather<signed char>& gather, const std::vector<std::size_t>& shape) {
    return to_numpy(gather(), shape);
}
nb::object values_of(const std::span<const std::string_view>& labels, const std::vector<std::size_t>& /*shape*/) {
    nb::list list;
    for (const std::string_view label : labels) list.append(nb::str(label.data(), label.size()));
    return list;
}

/// (attributes, [(name, dimensions, values, attributes), ...])
nb::tuple as_arrays(const io::RunDataset& data) {
    nb::dict attributes;
    for (const auto& [name, value] : data.attributes) {
        std::visit([&, &key = name](const auto& v) { attributes[key.c_str()] = v; }, value);
    }
    const auto length_of = [&](const std::string& dimension) {
        for (const auto& [name, length] : data.dimensions) {
            if (name == dimension) return length;
        }
        return std::size_t{0};
    };
    nb::list variables;
    for (const io::Variable& variable : data.variables) {
        std::vector<std::size_t> shape;
        for (const std::string& dimension : variable.dimensions) shape.push_back(length_of(dimension));
        const nb::object values = std::visit([&](const auto& v) { return values_of(v, shape); }, variable.values);
        variables.append(nb::make_tuple(variable.name, variable.dimensions, values, attributes_of(variable)));
    }
    return nb::make_tuple(attributes, variables);
}

}  // namespace

void bind_run(nb::module_& module) {
    module.def(
        "run",
        [](const NamedScenario& scenario, std::optional<double> tolerance, const nb::object& progress) {
            const Run result = run_named(scenario, tolerance, progress);
            NamedScenario as_run = scenario;
            if (tolerance) as_run.scenario.simulation.options.tolerance = *tolerance;
            return nb::make_tuple(as_arrays(io::run_dataset(as_run.scenario, result)), result.cost.wall_seconds,
                                  summary(as_run.scenario, result));
        },
        nb::arg("scenario"), nb::arg("tolerance").none(), nb::arg("progress").none(),
        "Runs a scenario: ((attributes, variables), wall_seconds, the page for a person).");
}

}  // namespace footfall::python
