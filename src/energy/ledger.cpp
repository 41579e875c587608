#include "footfall/energy/ledger.hpp"

namespace footfall {

double Ledger::total() const noexcept {
    const double body = sum_of(*this, body_channels, ChannelKind::held);
    return body + contact.stored() + contact.unpaid() + contact.dissipated() - contact.worked();
}

double Ledger::magnitude() const noexcept {
    double sum = size_of(*this, body_channels, ChannelKind::held);
    for (const ChannelKind kind : {ChannelKind::held, ChannelKind::taken, ChannelKind::unpaid, ChannelKind::worked})
        sum += size_of(contact, contact_channels, kind);
    return sum;
}

}  // namespace footfall
