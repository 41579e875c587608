// The modes of a contact, and what is reported where they change.
#pragma once

#include <cstdint>
#include <string_view>

#include "footfall/law/phase.hpp"

namespace footfall {

/// What does not change between two events of a contact.
struct Mode {
    Phase phase = Phase::flight;
    /// In Phase::recovering: the contact goes along F_n = 0. With friction it would lift off, without it would press
    /// again; it has the share of the friction of Phase::slip that keeps F_n at zero (Filippov's motion on a border
    /// between two phases).
    bool drags = false;

    [[nodiscard]] constexpr bool touches() const noexcept { return phase != Phase::flight; }
    /// The ground presses: F_n is what the normal law gives.
    [[nodiscard]] constexpr bool loaded() const noexcept { return phase == Phase::stick || phase == Phase::slip; }
    [[nodiscard]] constexpr bool operator==(const Mode&) const noexcept = default;
};

enum class EventKind : std::uint8_t {
    touchdown,   ///< the normal force begins: z rises through 0, or a recovering contact is loaded again
    stick,       ///< the clutch takes hold
    slip,        ///< the clutch lets go
    separation,  ///< F_n reaches 0
    recovered,   ///< z returns to 0
};
[[nodiscard]] constexpr std::string_view name_of(EventKind kind) noexcept {
    switch (kind) {
        case EventKind::touchdown:
            return "touchdown";
        case EventKind::stick:
            return "stick";
        case EventKind::slip:
            return "slip";
        case EventKind::separation:
            return "separation";
        case EventKind::recovered:
            return "recovered";
    }
    return "";
}

}  // namespace footfall
