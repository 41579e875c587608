// A scenario with the name that stands for it in messages: its file, or what the caller calls it.
#pragma once

#include <string>

#include "footfall/io/scenario.hpp"

namespace footfall::python {

struct NamedScenario {
    Scenario scenario;
    std::string name;
};

}  // namespace footfall::python
