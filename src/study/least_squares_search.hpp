// The search of a fit for its minimum.
#pragma once

#include <optional>

#include "study/least_squares_model.hpp"

namespace footfall::least_squares {

struct Minimum {
    Vector coordinates;
    double cost = infinity;
    bool converged = false;
    int iterations = 0;
};

/// From one start; nothing where the model has no value there. `noise` is what the residuals are divided by in the
/// loss.
[[nodiscard]] std::optional<Minimum> minimise(const Model& model, const Vector& start, Loss loss, double noise,
                                              int max_iterations);

struct Search {
    Minimum best;
    int tried = 0, agreeing = 0;
};

/// From several starts.
[[nodiscard]] Search search(const Model& model, Loss loss, double noise, const FitOptions& options);

}  // namespace footfall::least_squares
