// The implicit method over plain numbers, compiled once.
#include "footfall/solve/radau.hpp"

namespace footfall {

template class RadauIIA<double>;
template class RadauIIA<long double>;

}  // namespace footfall
