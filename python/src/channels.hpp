// What Python calls the channels of energy.
#pragma once

#include <string>

#include "footfall/energy/channels.hpp"

namespace footfall::python {

/// The array of a Response: it has the energy of a channel that holds it, else its rate.
inline std::string response_name(const ContactChannel& channel) {
    return std::string(channel.name) + (channel.is_integral() ? "_power" : "");
}

}  // namespace footfall::python
