#include "footfall/law/phase.hpp"

namespace footfall {

std::string_view name_of(Phase phase) noexcept {
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
