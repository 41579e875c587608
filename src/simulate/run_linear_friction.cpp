#include "run_under.hpp"

namespace footfall {

template Run run_under<AnyNormal<>, LinearFriction<>>(const Simulation&);

}  // namespace footfall
