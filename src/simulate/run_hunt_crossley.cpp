#include "run_under.hpp"

namespace footfall {

template Run run_under<HuntCrossleyNormal<>>(const Simulation&);

}  // namespace footfall
