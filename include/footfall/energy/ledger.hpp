// Where every joule is: what the body and the springs hold, what each channel has taken.
#pragma once

#include <array>

#include "footfall/energy/channels.hpp"

namespace footfall {

/// The whole account at one moment [J].
struct Ledger {
    double kinetic = 0;     ///< (37), without its first term
    double potential = 0;   ///< -m g . c: zero at the world's origin
    ContactEnergy contact;  ///< over all contacts

    /// What (15) says is constant.
    [[nodiscard]] double total() const noexcept;
    /// The size of the account: the sum of its entries without their signs. Residuals are relative to the
    /// largest that a run has seen.
    [[nodiscard]] double magnitude() const noexcept;
};

/// The ledger's own entries, in the order of every output; they stand before those of the contacts.
inline constexpr std::array body_channels{
    Channel<Ledger>{"kinetic", "", "J", "kinetic energy", ChannelKind::held, &Ledger::kinetic},
    Channel<Ledger>{"potential", "", "J", "potential energy, zero at the world's origin", ChannelKind::held,
                    &Ledger::potential},
};

}  // namespace footfall
