// Contacts in the loop of a simulator of your own, their host, which steps at a millisecond or two.
//
// A force that is held over such a step makes energy. A set integrates the contacts' own equations inside the step,
// with the host's effective mass and free acceleration frozen, and gives back the impulse of each contact and its
// double impulse, which the positions need. For a host with the velocities u and the mass matrix M, and J from u to the
// velocities of the contact points, each step is
//
//   u += dt M^-1 (forces but for the contacts') + M^-1 J^T impulse
//   q += dt (u before the step) + (dt^2/2) M^-1 (forces but for the contacts') + M^-1 J^T double_impulse
//
// Vectors of a contact are in its own frame: two tangents, which you choose, and the ground's normal.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "footfall/energy/channels.hpp"
#include "footfall/law/mode.hpp"
#include "footfall/law/phase.hpp"
#include "footfall/law/registry.hpp"

namespace footfall {

struct ContactSetOptions {
    /// Of what is integrated inside a step, relative to the energy that its motion and springs have; 1e-13 to 1e-2.
    double tolerance = 1e-6;
    /// Evaluations of the contacts' equations in a step, after which the rest of it is taken by one implicit step;
    /// >= 1.
    std::int64_t max_evaluations = 20'000;
};

/// What a host gives for a step of n contacts. The arrays are read by `step` alone.
struct HostStep {
    double dt = 0;                              ///< [s], >= 0
    std::span<const double> depth;              ///< z, n numbers [m], > 0 in the ground; -infinity is far above it
    std::span<const double> velocity;           ///< of the contact points against the ground, 3n [m/s]; the third
                                                ///< component of each is along the normal, > 0 away from the ground
    std::span<const double> free_acceleration;  ///< what `velocity` would change by, without the contacts, 3n [m/s^2]
    std::span<const double> delassus;           ///< J M^-1 J^T, 3n x 3n [1/kg], symmetric; may be singular

    // These may be left out.
    std::span<const double> ground_velocity;  ///< 3n [m/s], for the account alone; 0
    std::span<const double> frame_spin;       ///< how fast each frame turns about its normal, n [rad/s]; 0
    std::span<const double> radius;           ///< of the spheres, n [m], > 0; for laws with torques, as are
    std::span<const double> spin;             ///< about the normal against the ground, n [rad/s]
    std::span<const double> rolling;          ///< in the plane against the ground, 2n [rad/s]
};

/// Something that happens to a contact inside a step.
struct HostEvent {
    double time;  ///< since the step's start [s]
    int contact;
    EventKind kind;
};

/// What a step gives back.
struct ContactSetStep {
    std::vector<double> impulse;          ///< integral of the force on the body, 3n [N s]
    std::vector<double> double_impulse;   ///< integral of the impulse so far, 3n [N s^2]
    std::vector<double> angular_impulse;  ///< of torques that laws give, rolling, rolling, spin, 3n [N m s]
    std::vector<HostEvent> events;        ///< in order of time
    /// Of each contact: what is held at the end, and what has been taken within the step.
    std::vector<ContactEnergy> energy;
    /// What springs and bristles held at the start, at the depth and the velocity that the host has given [J].
    double held_before = 0;
    double contact_work =
        0;  ///< of the contact forces and torques on the bodies, in their motion against the ground [J]
    double ground_work = 0;  ///< of the contact forces on the bodies, in the ground's own motion [J]
    /// What the account misses: held + taken + unpaid + contact_work - held_before [J].
    double residual = 0;
    double energy_scale = 0;     ///< what `residual` and the tolerance are relative to [J]
    double unresolved_time = 0;  ///< at the end of the step, taken by one implicit step [s]; 0: all was resolved
    double unresolved_loss = 0;  ///< what the implicit step has taken and no channel accounts for [J]
    std::int64_t evaluations = 0;
};

class ContactSet {
public:
    /// One law for each contact. Throws InvalidInput where a law or an option cannot be used.
    explicit ContactSet(std::vector<ContactParameters> laws, const ContactSetOptions& options = {});
    ContactSet(const ContactSet& other);
    ContactSet& operator=(const ContactSet& other);
    ContactSet(ContactSet&&) noexcept;
    ContactSet& operator=(ContactSet&&) noexcept;
    ~ContactSet();

    /// Advances the contacts over one step of the host. The result is the set's own, until the next step. The same
    /// states, phases and arguments give the same result, bit for bit. Throws InvalidInput, and then nothing has
    /// changed.
    const ContactSetStep& step(const HostStep& host);

    [[nodiscard]] int contacts() const noexcept;
    [[nodiscard]] const std::vector<ContactParameters>& laws() const noexcept;
    [[nodiscard]] const ContactSetOptions& options() const noexcept;
    /// The last step's result.
    [[nodiscard]] const ContactSetStep& last() const noexcept;

    /// What the contacts remember: the states of their laws, those of contact i from state_offsets()[i] on, and their
    /// phases. With these a set can be restored.
    [[nodiscard]] std::span<const double> states() const noexcept;
    [[nodiscard]] std::span<const std::size_t> state_offsets() const noexcept;  ///< n + 1
    [[nodiscard]] std::span<const Phase> phases() const noexcept;
    /// u of contact i, or what its law has to show in its place [m], in the contact's frame.
    [[nodiscard]] Vector2<double> bristle(int i) const;
    /// Throws InvalidInput where the sizes are not those of the set, or a state is not finite.
    void restore(std::span<const double> states, std::span<const Phase> phases);
    /// As a new set.
    void reset();

private:
    class Inside;
    std::unique_ptr<Inside> inside_;
};

}  // namespace footfall
