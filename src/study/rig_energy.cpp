// The sums of a rig's account.
#include <cmath>

#include "footfall/study/drive.hpp"

namespace footfall {

double RigEnergy::held() const noexcept { return sum_of(*this, rig_channels, ChannelKind::held, contact.stored()); }
double RigEnergy::taken() const noexcept {
    return sum_of(*this, rig_channels, ChannelKind::taken, contact.dissipated());
}
double RigEnergy::worked() const noexcept { return sum_of(*this, rig_channels, ChannelKind::worked, contact.worked()); }

double RigEnergy::balance() const noexcept {
    double sum = contact.stored() + contact.dissipated() + contact.unpaid() - contact.worked();
    for (const auto& channel : rig_channels) {
        const double entry = this->*channel.member;
        sum += channel.kind == ChannelKind::worked ? -entry : entry;
    }
    return sum;
}

double RigEnergy::magnitude() const noexcept {
    double sum = 0;
    for (const auto& channel : contact_channels) sum += std::abs(contact.*channel.member);
    for (const auto& channel : rig_channels) sum += std::abs(this->*channel.member);
    return sum;
}

}  // namespace footfall
