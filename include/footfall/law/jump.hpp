// What happens to a contact at an event.
#pragma once

#include <array>
#include <cstddef>

#include "footfall/law/mode.hpp"
#include "footfall/law/push.hpp"

namespace footfall {

/// What a crossed guard, or the beginning of a contact, has changed besides the states.
template <class S>
struct Jump {
    Mode mode;
    Taken<S> taken{};                   ///< at once [J]
    std::array<EventKind, 2> events{};  ///< to report, in the new mode
    int event_count = 0;

    void report(EventKind kind) noexcept { events[static_cast<std::size_t>(event_count++)] = kind; }
};

}  // namespace footfall
