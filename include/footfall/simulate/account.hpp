// The ledger and the snapshot of a state: numbers for a person, out of the flat state vector.
#pragma once

#include "footfall/simulate/run.hpp"
#include "footfall/simulate/system.hpp"

namespace footfall {

/// The energies of contact i at y [J].
template <class System>
[[nodiscard]] ContactEnergy contact_energy(const System& system, const typename System::StateVector& y,
                                           const typename System::Motion& motion, int i) {
    using Layout = std::remove_cvref_t<decltype(system.layout())>;
    const auto taken = [&](int channel) { return static_cast<double>(y[system.layout().ledger(i) + channel]); };
    ContactEnergy e;
    e.normal_damper = taken(Layout::normal_damper);
    e.tangential_damper = taken(Layout::tangential_damper);
    e.clutch = taken(Layout::clutch);
    e.stiffness_change = taken(Layout::stiffness_change);
    const auto r = system.response(y, system.kinematics(motion, i), i);
    e.normal_spring = static_cast<double>(r.normal_spring);
    e.tangential_spring = static_cast<double>(r.tangential_spring);
    return e;
}

/// The whole account at y [J].
template <class System>
[[nodiscard]] Ledger ledger_of(const System& system, const typename System::StateVector& y) {
    const auto motion = system.motion(y);
    Ledger ledger;
    ledger.kinetic = static_cast<double>(system.kinetic_energy(y, motion));
    ledger.potential = static_cast<double>(system.potential_energy(motion));
    for (int i = 0; i < system.spheres(); ++i) ledger.contact += contact_energy(system, y, motion, i);
    return ledger;
}

/// Everything at y, in the world's frame.
template <class System>
[[nodiscard]] Snapshot snapshot_of(const System& system, const GroundFrame<typename System::S>& frame,
                                   const typename System::StateVector& y) {
    using Layout = std::remove_cvref_t<decltype(system.layout())>;
    const auto motion = system.motion(y);
    Snapshot shot;
    shot.time = static_cast<double>(y[system.layout().time()]);
    shot.body.position = frame.to_world(motion.position);
    shot.body.velocity = frame.to_world(motion.velocity);
    shot.body.angular_velocity = frame.to_world(motion.angular_velocity);
    const Eigen::Matrix<typename System::S, 4, 1> q = y.template segment<4>(Layout::orientation).matrix();
    shot.body.orientation = frame.to_world(Quaternion<typename System::S>(q));
    const auto contacts = system.contacts(y);
    shot.contacts.reserve(contacts.size());
    for (int i = 0; i < system.spheres(); ++i) {
        const auto& k = contacts[static_cast<std::size_t>(i)].kinematics;
        const auto& r = contacts[static_cast<std::size_t>(i)].response;
        ContactSnapshot c;
        c.phase = system.phase(i);
        c.depth_rate = static_cast<double>(k.depth_rate);
        c.slip_velocity = frame.to_world(k.slip);
        c.bristle = frame.to_world(system.bristle(y, i));
        if (system.touches(i)) {
            const auto s = y[system.layout().root_depth(i)];
            c.depth = static_cast<double>(s * s);
            c.normal_force = std::max(0.0, static_cast<double>(r.normal_force));
            c.friction_force = frame.to_world(r.friction_force);
        } else {
            c.depth = static_cast<double>(system.geometric_depth(motion, k, i));
        }
        c.energy = contact_energy(system, y, motion, i);
        shot.contacts.push_back(c);
    }
    shot.ledger = ledger_of(system, y);
    return shot;
}

}  // namespace footfall
