// The law of the contact of a rig, whichever it is.
#pragma once

#include <variant>

#include "footfall/law/normal/spring_alone.hpp"
#include "footfall/law/registry.hpp"
#include "footfall/study/rig.hpp"

namespace footfall {

using RigLaw = Pair<PressedLaw<NormalLaw>, FrictionLaw>;

/// A prescribed load is applied as slowly as it may be: then the normal law's spring alone acts.
[[nodiscard]] inline RigLaw rig_law(const Rig& rig, const ContactParameters& laws) {
    using Normal = PressedLaw<NormalLaw>;
    const Normal normal =
        std::visit([&](const auto& law) { return rig.press == Press::load ? Normal(SpringAlone(law)) : Normal(law); },
                   laws.normal);
    return {normal, laws.friction};
}

}  // namespace footfall
