#include "footfall/energy/channels.hpp"

namespace footfall {

std::string_view name_of(ChannelKind kind) noexcept {
    switch (kind) {
        case ChannelKind::held:
            return "held";
        case ChannelKind::taken:
            return "taken";
        case ChannelKind::unpaid:
            return "unpaid";
        case ChannelKind::worked:
            return "worked";
    }
    return "";
}

}  // namespace footfall
