#include "run_under.hpp"

namespace footfall {

template Run run_under<AzadFeatherstoneNormal<>>(const Simulation&);

}  // namespace footfall
