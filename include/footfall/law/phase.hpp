// How one sphere touches the ground.
#pragma once

#include <cstdint>
#include <string_view>

namespace footfall {

enum class Phase : std::uint8_t {
    flight,      ///< z <= 0: no contact
    stick,       ///< z > 0, F_n > 0, the clutch holds
    slip,        ///< z > 0, F_n > 0, the clutch slips (always, where there is no clutch)
    recovering,  ///< z > 0 but F_n = 0: the clamp (14) holds, the ground rises with the sphere
};
[[nodiscard]] constexpr std::string_view name_of(Phase phase) noexcept {
    switch (phase) {
        case Phase::flight:
            return "flight";
        case Phase::stick:
            return "stick";
        case Phase::slip:
            return "slip";
        case Phase::recovering:
            return "recovering";
    }
    return "";
}

}  // namespace footfall
