#include "run_under.hpp"

namespace footfall {

template Run run_under<AnyNormal<>, AnyRateFriction<>>(const Simulation&);

}  // namespace footfall
