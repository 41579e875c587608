#include "run_under.hpp"

namespace footfall {

template Run run_under<AzadFeatherstoneNormal<>, AzadFeatherstoneFriction<>>(const Simulation&);

}  // namespace footfall
