// What the file of a run holds, before it is a file: dimensions, attributes and labelled variables, as NetCDF and
// xarray know them. NetCDF and Python both write what stands here.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "footfall/io/scenario.hpp"
#include "footfall/simulate/run.hpp"

namespace footfall::io {

/// Values of a variable, the last dimension fastest.
template <class Value>
using Gather = std::function<std::vector<Value>()>;

/// One labelled array. Its values are gathered when the time to write them has come.
struct Variable {
    std::string name;
    std::vector<std::string> dimensions;
    std::string units;  ///< as UDUNITS reads it; "1" where there is none
    std::string long_name;
    /// Numbers, indices, small integers with a meaning, or labels.
    std::variant<Gather<double>, Gather<int>, Gather<signed char>, std::span<const std::string_view>> values;
    /// What the small integers 0, 1, ... mean, as the CF conventions write it.
    std::string flag_meanings = {};
    std::size_t flag_count = 0;
    bool may_be_missing = false;  ///< NaN stands for what has not happened
};

struct RunDataset {
    std::vector<std::pair<std::string, std::size_t>> dimensions;  ///< name, length
    std::vector<std::pair<std::string, std::variant<std::string, double, std::int64_t>>> attributes;
    std::vector<Variable> variables;
};

/// The whole run. `scenario` and `run` must outlive what is returned.
[[nodiscard]] RunDataset run_dataset(const Scenario& scenario, const Run& run);

}  // namespace footfall::io
