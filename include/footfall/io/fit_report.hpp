// What a fit found, for a person and as JSON.
#pragma once

#include <string>

#include "footfall/study/fit.hpp"

namespace footfall {

/// A page of text, at most 100 characters wide: for each law its estimates with errors and intervals, what is known
/// where not all is, correlations, warnings; then the laws side by side.
[[nodiscard]] std::string report(const FitStudyResult& result);

/// One JSON object. Every number reads back exactly; what does not exist is null.
[[nodiscard]] std::string to_json(const FitStudyResult& result);

}  // namespace footfall
