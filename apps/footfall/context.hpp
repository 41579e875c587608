// Errors that say what they are about: an option, a file, a line of it.
#pragma once

#include <string_view>

#include <fmt/format.h>

#include "footfall/math/error.hpp"
#include "footfall/simulate/run.hpp"

namespace footfall::cli {

/// What `work` returns. Where it throws InvalidInput or TooExpensive, "`about`: " stands before what that says.
template <class Work>
auto in_context(std::string_view about, const Work& work) {
    try {
        return work();
    } catch (const InvalidInput& error) {
        throw InvalidInput(fmt::format("{}: {}", about, error.what()));
    } catch (const TooExpensive& error) {
        throw TooExpensive(fmt::format("{}: {}", about, error.what()));
    }
}

}  // namespace footfall::cli
