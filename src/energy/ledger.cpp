#include "footfall/energy/ledger.hpp"

#include <cmath>

namespace footfall {

double Ledger::magnitude() const noexcept {
    return std::abs(kinetic) + std::abs(potential) + contact.stored() + contact.dissipated() +
           std::abs(contact.stiffness_change);
}

}  // namespace footfall
