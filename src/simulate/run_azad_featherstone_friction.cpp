#include "run_under.hpp"

namespace footfall {

template Run run_under<AnyNormal<>, AzadFeatherstoneFriction<>>(const Simulation&);

}  // namespace footfall
