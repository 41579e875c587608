#include "run_under.hpp"

namespace footfall {

template Run run_under<AnyNormal<>, NoFriction<>>(const Simulation&);

}  // namespace footfall
