// The ledger and the snapshot of a state: numbers for a person, out of the flat state vector.
#pragma once

#include <algorithm>

#include "footfall/eigen/interop.hpp"
#include "footfall/plant/ground_frame.hpp"
#include "footfall/simulate/hybrid.hpp"
#include "footfall/simulate/run.hpp"

namespace footfall {

/// The energies of contact i at y, where it stands as `touch` says [J].
template <class Hybrid>
[[nodiscard]] ContactEnergy contact_energy(const Hybrid& hybrid, const typename Hybrid::State& y,
                                           const Touch<typename Hybrid::S>& touch, int i) {
    const auto held = hybrid.held(y, touch, i);
    ContactEnergy e;
    e.normal_spring = static_cast<double>(value_of(held.normal_spring));
    e.tangential_spring = static_cast<double>(value_of(held.tangential_spring));
    static_assert(integral_count(contact_channels) == taken_channels, "what laws give is what the ledger has");
    read_integrals(e, contact_channels, values_of(y), hybrid.taken(i));
    return e;
}

/// What the body holds at y; its contacts are left out.
template <class Hybrid>
[[nodiscard]] Ledger body_ledger(const Hybrid& hybrid, const typename Hybrid::State& y,
                                 const typename Hybrid::Motion& motion) {
    Ledger ledger;
    ledger.kinetic = static_cast<double>(value_of(hybrid.plant().kinetic_energy(motion)));
    ledger.potential = static_cast<double>(value_of(hybrid.plant().potential_energy(y, hybrid.follow())));
    return ledger;
}

/// The whole account at y [J].
template <class Hybrid>
[[nodiscard]] Ledger ledger_of(const Hybrid& hybrid, const typename Hybrid::State& y) {
    const auto& plant = hybrid.plant();
    const auto motion = plant.motion(y);
    Ledger ledger = body_ledger(hybrid, y, motion);
    for (int i = 0; i < hybrid.contacts(); ++i)
        ledger.contact += contact_energy(hybrid, y, plant.touch(y, motion, i), i);
    return ledger;
}

/// Everything at y, in the world's frame: one evaluation of every contact's law.
template <class Hybrid>
[[nodiscard]] Snapshot snapshot_of(const Hybrid& hybrid, const GroundFrame<typename Hybrid::S>& frame,
                                   const typename Hybrid::State& y) {
    using S = typename Hybrid::S;
    const auto number = [](const S& x) { return static_cast<double>(value_of(x)); };
    const auto& plant = hybrid.plant();
    const auto motion = plant.motion(y);
    Snapshot shot;
    shot.time = number(y[hybrid.clock()]);
    shot.body.position = frame.to_world(plant.position(y, hybrid.follow()));
    shot.body.velocity = frame.to_world(motion.velocity);
    shot.body.angular_velocity = frame.to_world(motion.angular_velocity);
    shot.body.orientation = frame.to_world(plant.quaternion(y));
    shot.ledger = body_ledger(hybrid, y, motion);
    const auto contacts = hybrid.contacts_at(y);
    shot.contacts.reserve(contacts.size());
    for (int i = 0; i < hybrid.contacts(); ++i) {
        const auto& [touch, response, load_rate, share] = contacts[static_cast<std::size_t>(i)];
        ContactSnapshot c;
        c.phase = hybrid.mode(i).phase;
        c.depth_rate = number(touch.depth_rate);
        c.slip_velocity = frame.to_world(touch.slip);
        c.bristle = frame.to_world(hybrid.law(i).bristle(hybrid.states(y, i)));
        if (hybrid.touches(i)) {
            c.depth = number(touch.root_depth * touch.root_depth);
            c.normal_force = std::max(0.0, number(response.push.normal));
            c.friction_force = frame.to_world(response.push.friction);
        } else {
            c.depth = number(plant.geometric_depth(y, motion, hybrid.follow(), i));
        }
        c.energy = contact_energy(hybrid, y, touch, i);
        shot.ledger.contact += c.energy;
        shot.contacts.push_back(c);
    }
    return shot;
}

}  // namespace footfall
