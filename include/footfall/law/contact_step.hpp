// One contact over a time step of somebody else's simulator.
//
// Depth, its rate and the slip velocity V are those that the host holds over its step; the load and the mode follow
// from them. The states of friction then relax on their own, often much faster than the step: HeldFriction says how
// each kind of law advances them, stably for every step (friction/held_clutch.hpp, friction/held_states.hpp).
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <variant>

#include "footfall/law/friction/held_clutch.hpp"
#include "footfall/law/friction/held_friction.hpp"
#include "footfall/law/friction/held_states.hpp"
#include "footfall/law/pair.hpp"

namespace footfall {

/// Advances the states x of a contact's friction over dt [s], > 0, in a mode, with how it stands held at t; writes what
/// that gives into `step`. `friction` is the HeldFriction of the law's own, a Pair's over double.
template <class Law, class Friction>
void hold_friction(const Law& law, const HeldFriction<Friction>& friction, Mode mode, const Touch<double>& t, double dt,
                   std::span<double> x, ContactStep& step) noexcept {
    const Load<double> load{law.scale_at(t.root_depth), mode.touches() ? law.load_at(t, x).over_scale : 0};
    friction.advance(load, t, dt, x.subspan(static_cast<std::size_t>(law.normal_state_count())), step);
    law.deepen(t, dt, x);
}

/// Advances contacts under one law: a Pair over double.
template <class Law>
class ContactStepper {
public:
    /// `tolerance`, of each sub-step, is relative to the size of the states of friction, and of the force where they
    /// are a bristle: from 1e-12 to 1e-2.
    explicit ContactStepper(const Law& law, double tolerance = 1e-4) : law_(law), friction_(law.friction, tolerance) {}

    /// Advances `x`, the states of a contact, over `dt` [s], > 0, with depth [m], its rate [m/s] and the slip velocity
    /// V [m/s] held. `was` is the phase in which the contact has been, flight where that is not known. States of
    /// friction other than a bristle become those of a new contact where there is no load; where ground joins the patch
    /// unstrained, what joins in dt does so at its end, and no bristle is left in flight. Where one of the numbers is
    /// not finite, nor is what comes out. A step of which something is `left` has no meaning: take shorter ones.
    [[nodiscard]] ContactStep operator()(Phase was, double depth, double depth_rate, const Vector2<double>& V,
                                         std::span<double> x, double dt) const noexcept {
        bool finite = std::isfinite(depth) && std::isfinite(depth_rate) && V.allFinite();
        for (const double state : x) finite = finite && std::isfinite(state);
        if (!finite) return ContactStep::nothing(x);
        const Touch<double> t{root_of_depth(depth), depth_rate, V};
        const Mode mode = law_.mode_at({was}, t, x);
        ContactStep step{.phase = mode.phase};
        if (mode.loaded()) step.normal_force = law_.normal_force(t, x);
        hold_friction(law_, friction_, mode, t, dt, x, step);
        return step;
    }

private:
    Law law_;
    HeldFriction<decltype(Law::friction)> friction_;
};

}  // namespace footfall
