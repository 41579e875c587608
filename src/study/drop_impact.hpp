// One impact along the normal without gravity under any normal law, over double or over dual numbers, which give its
// derivatives with respect to the law's parameters, the mass and the speed.
#pragma once

#include <optional>
#include <span>

#include "footfall/law/registry.hpp"
#include "footfall/math/dual.hpp"

namespace footfall::study {

/// A place in a sample of which the force is wanted.
enum class Branch { loading, unloading };

/// Derivatives that a fit carries in one pass.
using FitDual = Dual<double, 4>;

/// S is double or FitDual. Steps are chosen by the values alone; the derivatives then have an error of the same order
/// as the values, times how fast they grow.
template <class S>
class DropImpact {
public:
    /// A law with its parameters over S, mass [kg] and speed into the ground [m/s], both > 0. `tolerance` is of a step.
    DropImpact(const NormalLawOver<S>& law, const S& mass, const S& speed, double tolerance = 1e-11);

    /// -zdot where contact ends (14) [m/s]; empty where it cannot be followed to there: after too many steps, or where
    /// its numbers are too far apart for double precision.
    [[nodiscard]] std::optional<S> speed_out() const;

    /// The force [N] at times since touchdown [s], in order; before touchdown and after the end it is 0. False where
    /// the impact cannot be followed.
    [[nodiscard]] bool force_at_times(std::span<const S> times, std::span<S> forces) const;

    /// The force [N] at indentations [m], on the way in or out. Deeper than the impact goes, it is the elastic force,
    /// which the others meet at the deepest point. False where the impact cannot be followed.
    [[nodiscard]] bool force_at_depths(std::span<const double> depths, std::span<const Branch> branches,
                                       std::span<S> forces) const;

private:
    Pair<NormalLawOver<S>, NoFriction<S>> law_;
    S mass_, speed_;
    double tolerance_;
};

extern template class DropImpact<double>;
extern template class DropImpact<FitDual>;

}  // namespace footfall::study
