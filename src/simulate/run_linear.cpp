#include "run_under.hpp"

namespace footfall {

template Run run_under<LinearNormal<>>(const Simulation&);

}  // namespace footfall
