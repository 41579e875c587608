// What the data of a fit say at its minimum: errors, correlations, what is not determined, and a word about each.
#pragma once

#include "study/least_squares_model.hpp"

namespace footfall::least_squares {

/// Fills in what follows from the residuals and the Jacobian at x. `scale` is what the residuals were divided by inside
/// the loss.
void account(const LeastSquaresProblem& problem, const Model& model, const FitOptions& options, const Vector& x,
             double scale, FitResult& result);

}  // namespace footfall::least_squares
