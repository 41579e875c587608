#include "footfall/law/mode.hpp"

namespace footfall {

std::string_view name_of(EventKind kind) noexcept {
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
