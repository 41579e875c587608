// The contact law of one sphere, for a loop of one's own: `evaluate` gives everything from numbers, nothing is kept.
#pragma once

#include "footfall/law/contact_response.hpp"
#include "footfall/law/pair.hpp"

namespace footfall {

/// A normal law and a friction law over the same scalar.
///
///   ContactLaw<AzadFeatherstoneNormal<>, AzadFeatherstoneFriction<>> law{{K_n, D_n}, {{K_t, D_t, mu, C_V}}};
template <class Normal, class Friction>
using ContactLaw = Pair<Normal, Friction>;

}  // namespace footfall
