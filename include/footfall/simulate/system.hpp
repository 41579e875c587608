// The equations of motion of a body in contact, with every phase frozen: smooth between events.
//
// The independent variable is sigma, with dt = g dsigma. In flight g = 1. With contacts, 1/g = sum of 1/s_i over the
// spheres that touch, s_i = sqrt(z_i): for one contact dt = s dsigma, and nothing is singular where s = 0. The
// force starts as sqrt(t - t0), but it is polynomial in sigma. A contact that is dragged along F_n = 0 does not count:
// it neither begins nor ends there, and s falls as an exponential of time. Its depth follows from F_n = 0, not from the
// body's velocity, whose rounding would be all that is left of it.
//
// All vectors are in the ground's frame (ground_frame.hpp): the normal is the third axis.
#pragma once

#include <array>
#include <span>
#include <type_traits>
#include <vector>

#include "footfall/body/body.hpp"
#include "footfall/law/contact_law.hpp"
#include "footfall/math/dual.hpp"
#include "footfall/math/vector.hpp"
#include "footfall/simulate/ground_frame.hpp"
#include "footfall/simulate/layout.hpp"

namespace footfall {

/// One body on one plane, all contacts under the same kinds of law. `Law` is a ContactLaw over the scalar S.
template <class Law, int Spheres>
class System {
public:
    using S = typename Law::value_type;
    using LawType = Law;
    using LayoutType = Layout<Spheres, Law::has_states ? Eigen::Dynamic : 2>;
    using StateVector = State<S, LayoutType>;
    /// For each contact three quantities that are positive while its phase lasts: the load (14), the clutch (26), s.
    static constexpr int guards_per_contact = 3;
    static constexpr int load_guard = 0, clutch_guard = 1, depth_guard = 2;
    using Guards = Eigen::Array<S, Spheres == Eigen::Dynamic ? Eigen::Dynamic : guards_per_contact * Spheres, 1>;

    System(const Body& body, const Ground& ground, const Eigen::Vector3d& gravity, std::vector<Law> laws)
        : layout_{static_cast<int>(body.spheres.size()), friction_states_of(laws)},
          mass_(body.mass),
          inverse_mass_(S(1) / mass_),
          inverse_inertia_(body.inertia.inverse().cast<S>()),
          gravity_(GroundFrame<S>(ground.normal).to_ground(gravity)),
          height_(ground.height),
          laws_(std::move(laws)) {
        isotropic_ = body.inertia.isApprox(Eigen::Matrix3d(body.inertia(0, 0) * Eigen::Matrix3d::Identity()), 0.0);
        oriented_ = !isotropic_;
        for (const Sphere& sphere : body.spheres) {
            centers_.push_back(sphere.center.cast<S>());
            radii_.push_back(S(sphere.radius));
            oriented_ = oriented_ || !sphere.center.isZero(0);
        }
        if constexpr (Spheres == Eigen::Dynamic) {
            phases_.resize(laws_.size(), Phase::flight);
            drags_.resize(laws_.size(), false);
            contacts_.resize(laws_.size());
        }
    }

    [[nodiscard]] const LayoutType& layout() const noexcept { return layout_; }
    [[nodiscard]] const Vector3<S>& gravity() const noexcept { return gravity_; }
    [[nodiscard]] const Law& law(int i) const noexcept { return laws_[index(i)]; }
    [[nodiscard]] const S& radius(int i) const noexcept { return radii_[index(i)]; }
    [[nodiscard]] constexpr int spheres() const noexcept {
        return Spheres == Eigen::Dynamic ? layout_.spheres : Spheres;
    }
    [[nodiscard]] Phase phase(int i) const noexcept { return phases_[index(i)]; }
    void set_phase(int i, Phase phase) noexcept { phases_[index(i)] = phase; }
    /// Whether contact i, in Phase::recovering, is dragged along F_n = 0: with friction it would lift off, without it
    /// would press again. It has the share of the friction of Phase::slip that keeps F_n at zero (Filippov's motion on
    /// a border between two phases).
    [[nodiscard]] bool drags(int i) const noexcept { return drags_[index(i)]; }
    void set_drags(int i, bool drags) noexcept { drags_[index(i)] = drags; }
    [[nodiscard]] bool touches(int i) const noexcept { return phase(i) != Phase::flight; }
    /// Whether the motion depends on the body's orientation; that of one homogeneous ball does not.
    [[nodiscard]] bool oriented() const noexcept { return oriented_; }
    [[nodiscard]] bool in_flight() const noexcept {
        for (const Phase p : phases_)
            if (p != Phase::flight) return false;
        return true;
    }

    /// Tells the normal law of contact i how fast an impact begins [m/s], where it depends on that.
    void begin_impact(int i, const S& speed) noexcept {
        if constexpr (requires(Law law) { law.normal.begin_impact(speed); }) laws_[index(i)].normal.begin_impact(speed);
    }

    /// The same system over another scalar, for derivatives.
    template <class T>
    [[nodiscard]] auto cast() const;

    /// How a sphere moves against the ground.
    struct Kinematics {
        Vector3<S> center;  ///< from the centre of mass to the sphere's centre [m]
        S depth_rate;       ///< zdot [m/s]
        Vector2<S> slip;    ///< V_sph in the ground's plane [m/s]. (36)
    };

    /// Position, velocity and rotation, unpacked once for all spheres.
    struct Motion {
        Vector3<S> position, velocity, angular_velocity;
        Matrix3<S> rotation;
    };

    [[nodiscard, gnu::always_inline]] Motion motion(const StateVector& y) const noexcept {
        Motion m;
        m.position = y.template segment<3>(layout_.position()).matrix();
        m.velocity = y.template segment<3>(LayoutType::velocity).matrix();
        const Vector3<S> L = y.template segment<3>(LayoutType::momentum).matrix();
        if (oriented_) {
            const Quaternion<S> q(Vector4(y.template segment<4>(LayoutType::orientation).matrix()));
            m.rotation = q.toRotationMatrix();
        }
        m.angular_velocity = by_inverse_inertia(m, L);
        return m;
    }

    [[nodiscard, gnu::always_inline]] Kinematics kinematics(const Motion& m, int i) const noexcept {
        Kinematics k;
        k.center = Vector3<S>::Zero();
        // The lever arm is r, straight down from the centre.
        const S& r = radius(i);
        Vector3<S> at_contact = m.velocity;  // (36)
        at_contact.x() -= r * m.angular_velocity.y();
        at_contact.y() += r * m.angular_velocity.x();
        if (oriented_) {
            k.center = m.rotation * centers_[index(i)];
            at_contact += m.angular_velocity.cross(k.center);
        }
        k.depth_rate = -at_contact.z();
        k.slip = at_contact.template head<2>();
        return k;
    }

    /// z from the body's position: negative where the sphere is above the ground [m].
    [[nodiscard]] S geometric_depth(const Motion& m, const Kinematics& k, int i) const noexcept {
        return radius(i) + height_ - (m.position.z() + k.center.z());
    }

    /// The bristle u of contact i, or what a friction law with internal states shows in its place [m].
    [[nodiscard, gnu::always_inline]] Vector2<S> bristle(const StateVector& y, int i) const noexcept {
        if constexpr (Law::has_states) {
            return law(i).friction.bristle(friction_states(y, i));
        } else {
            return y.template segment<2>(layout_.bristle(i)).matrix();
        }
    }

    /// The internal states of the friction of contact i, where its law has such.
    [[nodiscard]] std::span<const S> friction_states(const StateVector& y, int i) const noexcept {
        return {&y[layout_.bristle(i)], static_cast<std::size_t>(layout_.friction_states)};
    }
    [[nodiscard]] std::span<S> friction_states(StateVector& y, int i) const noexcept {
        return {&y[layout_.bristle(i)], static_cast<std::size_t>(layout_.friction_states)};
    }

    struct NoStateRates {};
    using StateRates = std::conditional_t<Law::has_states, std::array<S, max_friction_states>, NoStateRates>;

    /// One contact at one moment.
    struct Contact {
        Kinematics kinematics;
        ContactResponse<S> response;
        S load_rate = S(0);      ///< d(F_n / s^ScalePower)/dt, where a plastic clutch asks for it
        S share = S(0);          ///< of the friction in slip, where the contact drags
        StateRates state_rates;  ///< of the internal states of friction
    };

    /// All contacts at y. Those in flight have their kinematics alone.
    [[nodiscard]] std::vector<Contact> contacts(const StateVector& y) const {
        std::vector<Contact> all(index(spheres()));
        act(all, y, motion(y));
        return all;
    }

    /// d(load guard)/dt of contact i at y, in its phase.
    [[nodiscard]] S load_rate(const StateVector& y, int i) const {
        std::vector<Contact> all(index(spheres()));
        const Motion m = motion(y);
        const Action total = act(all, y, m);
        const Kinematics& k = all[index(i)].kinematics;
        return load_rate(y, k, i, depth_acceleration(y, m, k, total));
    }

    /// What contact i does at y, in its phase; not for one that drags.
    [[nodiscard, gnu::always_inline]] ContactResponse<S> response(const StateVector& y, const Kinematics& k,
                                                                  int i) const noexcept {
        StateRates unused;
        return response(y, k, i, unused);
    }

    /// dy/dsigma and, where `guards` is given, what bounds the phases.
    void evaluate(const StateVector& y, StateVector& rate, Guards* guards = nullptr) const noexcept {
        if constexpr (Spheres == Eigen::Dynamic) {
            evaluate_with(contacts_, y, rate, guards);
        } else {
            std::array<Contact, Spheres> contacts;
            evaluate_with(contacts, y, rate, guards);
        }
    }

    /// s of contact i, never so near zero that a power of it in a denominator would overflow.
    [[nodiscard, gnu::always_inline]] S root_depth(const StateVector& y, int i) const noexcept {
        const S s = y[layout_.root_depth(i)];
        const S least(1e-60);
        return s < least && s > -least ? least : s;
    }

    /// g = dt/dsigma.
    [[nodiscard, gnu::always_inline]] S time_rate(const StateVector& y) const noexcept {
        if constexpr (Spheres == 1) {
            return touches(0) && !drags(0) ? root_depth(y, 0) : S(1);
        } else {
            S sum(0);
            for (int i = 0; i < spheres(); ++i)
                if (touches(i) && !drags(i)) sum += S(1) / root_depth(y, i);
            return sum == S(0) ? S(1) : S(1) / sum;
        }
    }

    [[nodiscard]] S kinetic_energy(const StateVector& y, const Motion& m) const noexcept {
        const Vector3<S> L = y.template segment<3>(LayoutType::momentum).matrix();
        return S(0.5) * (mass_ * m.velocity.squaredNorm() + m.angular_velocity.dot(L));  // (37)
    }
    [[nodiscard]] S potential_energy(const Motion& m) const noexcept { return -mass_ * gravity_.dot(m.position); }

private:
    using Vector4 = Eigen::Matrix<S, 4, 1>;
    template <class T>
    using PerContact =
        std::conditional_t<Spheres == Eigen::Dynamic, std::vector<T>,
                           std::array<T, static_cast<std::size_t>(Spheres == Eigen::Dynamic ? 0 : Spheres)>>;

    /// The forces of all contacts, and their torque about the centre of mass.
    struct Action {
        Vector3<S> force = Vector3<S>::Zero(), torque = Vector3<S>::Zero();
    };

    static constexpr std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }

    // All contacts have the same kind of law.
    static int friction_states_of([[maybe_unused]] const std::vector<Law>& laws) noexcept {
        if constexpr (Law::has_states) {
            return laws.front().friction.state_count();
        } else {
            return 2;
        }
    }

    template <class Contacts>
    [[gnu::always_inline]] void evaluate_with(Contacts& contacts, const StateVector& y, StateVector& rate,
                                              Guards* guards) const noexcept {
        const Motion m = motion(y);
        const Action total = act(contacts, y, m);
        const S g = time_rate(y);
        rate.template segment<3>(layout_.position()) = (m.velocity * g).array();
        rate.template segment<3>(LayoutType::velocity) = (acceleration(total) * g).array();
        rate.template segment<3>(LayoutType::momentum) = (total.torque * g).array();  // (35)
        rate.template segment<4>(LayoutType::orientation) = orientation_rate(y, m.angular_velocity * g);
        rate[layout_.time()] = g;
        for (int i = 0; i < spheres(); ++i) contact_rate(contacts[index(i)], y, rate, i, g);
        if (guards) fill_guards(contacts, y, m, *guards);
    }

    // What every contact does, and what that adds up to.
    template <class Contacts>
    [[gnu::always_inline]] Action act(Contacts& contacts, const StateVector& y, const Motion& m) const noexcept {
        Action total;
        bool plastic = false, drag = false;
        for (int i = 0; i < spheres(); ++i) {
            Contact& c = contacts[index(i)];
            c.kinematics = kinematics(m, i);
            if (!touches(i)) continue;
            if (drags(i)) c.kinematics.depth_rate = unloading_rate(root_depth(y, i), c.kinematics.depth_rate, i);
            c.response = response(y, c.kinematics, i, c.state_rates);
            add(total, c.response, c.kinematics, i);
            if constexpr (Law::has_clutch) {
                drag = drag || drags(i);
                plastic = plastic || (phase(i) == Phase::slip && law(i).friction.plastic());
            }
        }
        if constexpr (Law::has_clutch) {
            if (drag) drag_along(contacts, y, m, total);
            if (plastic) resolve_plastic_clutches(contacts, y, m, total);
        }
        if constexpr (Law::has_states) book_load_changes(contacts, y, m, total);
        return total;
    }

    [[nodiscard, gnu::always_inline]] ContactResponse<S> response(const StateVector& y, const Kinematics& k, int i,
                                                                  [[maybe_unused]] StateRates& rates) const noexcept {
        const S s = root_depth(y, i);
        if constexpr (Law::has_states) {
            const std::span<S> out(rates.data(), static_cast<std::size_t>(layout_.friction_states));
            return law(i).respond(phase(i), s, k.depth_rate, k.slip, friction_states(y, i), out);
        } else {
            return law(i).respond(phase(i), s, k.depth_rate, k.slip, bristle(y, i));
        }
    }

    // What is stored over the load, times how fast the load changes: no force pays for it.
    template <class Contacts>
    void book_load_changes(Contacts& contacts, const StateVector& y, const Motion& m,
                           const Action& total) const noexcept {
        for (int i = 0; i < spheres(); ++i) {
            if (phase(i) != Phase::stick && phase(i) != Phase::slip) continue;
            const S stored = law(i).friction.stored(phase(i), friction_states(y, i));
            if (!(stored > S(0))) continue;
            Contact& c = contacts[index(i)];
            c.load_rate = force_rate(y, m, c.kinematics, i, total);
            c.response.stiffness_change_power = -stored * c.load_rate;
        }
    }

    // d(F_n / s^ScalePower)/dt.
    [[nodiscard]] S force_rate(const StateVector& y, const Motion& m, const Kinematics& k, int i,
                               const Action& total) const noexcept {
        return along_motion(y, k, i, depth_acceleration(y, m, k, total),
                            [](const auto& normal, const auto& s, const auto& z_rate) {
                                return normal.template force<Law::ScalePower>(s, z_rate).total();
                            });
    }

    [[gnu::always_inline]] void add(Action& total, const ContactResponse<S>& r, const Kinematics& k,
                                    int i) const noexcept {
        const Vector3<S> f(r.friction_force.x(), r.friction_force.y(), r.normal_force);
        total.force += f;
        total.torque.x() += radius(i) * f.y();
        total.torque.y() -= radius(i) * f.x();
        if (oriented_) total.torque += k.center.cross(f);
    }
    [[nodiscard, gnu::always_inline]] Vector3<S> acceleration(const Action& total) const noexcept {
        return gravity_ + total.force * inverse_mass_;  // (34)
    }

    [[nodiscard, gnu::always_inline]] Vector3<S> by_inverse_inertia(const Motion& m, const Vector3<S>& v) const {
        if (isotropic_) return v * inverse_inertia_(0, 0);
        return m.rotation * (inverse_inertia_ * (m.rotation.transpose() * v));
    }

    // d(zdot)/dt of a contact.
    [[nodiscard]] S depth_acceleration(const StateVector& y, const Motion& m, const Kinematics& k,
                                       const Action& total) const noexcept {
        const Vector3<S>& omega = m.angular_velocity;
        const Vector3<S> L = y.template segment<3>(LayoutType::momentum).matrix();
        const Vector3<S> spin_up = by_inverse_inertia(m, Vector3<S>(total.torque - omega.cross(L)));
        return -(acceleration(total) + spin_up.cross(k.center) + omega.cross(omega.cross(k.center))).z();
    }

    // d/dt of a function of s and zdot, the normal law cast to dual numbers first.
    template <class F>
    [[nodiscard]] S along_motion(const StateVector& y, const Kinematics& k, int i, const S& z_accel,
                                 F&& quantity) const noexcept {
        using D = Dual<S, 1>;
        const S s = root_depth(y, i);
        const D moving_s(s, {k.depth_rate / (S(2) * s)}), moving_rate(k.depth_rate, {z_accel});
        return quantity(law(i).normal.template cast<D>(), moving_s, moving_rate).gradient[0];
    }
    [[nodiscard]] S load_rate(const StateVector& y, const Kinematics& k, int i, const S& z_accel) const noexcept {
        return along_motion(y, k, i, z_accel, [](const auto& normal, const auto& s, const auto& z_rate) {
            return normal.load(s, z_rate);
        });
    }

    // The zdot at which contact i has no load at s, near a given one.
    [[nodiscard]] S unloading_rate(const S& s, const S& z_rate, int i) const noexcept {
        using D = Dual<S, 1>;
        const D load = law(i).normal.template cast<D>().load(D(s), D::variable(z_rate, 0));
        return load.gradient[0] > S(0) ? S(z_rate - load.value / load.gradient[0]) : z_rate;
    }

    // Contacts that drag: the shares of their friction that keep every one of their loads at zero. The loads' rates are
    // linear in the shares.
    template <class Contacts>
    void drag_along(Contacts& contacts, const StateVector& y, const Motion& m, Action& total) const noexcept {
        std::vector<int> dragging;
        std::vector<ContactResponse<S>> slipping;
        for (int i = 0; i < spheres(); ++i) {
            if (!drags(i)) continue;
            const Kinematics& k = contacts[index(i)].kinematics;
            dragging.push_back(i);
            slipping.push_back(law(i).respond(Phase::slip, root_depth(y, i), k.depth_rate, k.slip, bristle(y, i)));
        }
        const auto n = static_cast<Eigen::Index>(dragging.size());
        Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> effect(n, n);
        Eigen::Matrix<S, Eigen::Dynamic, 1> without(n);
        for (Eigen::Index a = 0; a < n; ++a) {
            const int i = dragging[static_cast<std::size_t>(a)];
            const Kinematics& k = contacts[index(i)].kinematics;
            const S z_accel = depth_acceleration(y, m, k, total);
            without[a] = load_rate(y, k, i, z_accel);
            for (Eigen::Index b = 0; b < n; ++b) {
                const auto at = static_cast<std::size_t>(b);
                Action with = total;
                add(with, slipping[at], contacts[index(dragging[at])].kinematics, dragging[at]);
                effect(a, b) = load_rate(y, k, i, depth_acceleration(y, m, k, with)) - without[a];
            }
        }
        const Eigen::Matrix<S, Eigen::Dynamic, 1> shares = effect.partialPivLu().solve(-without);
        for (Eigen::Index a = 0; a < n; ++a) {
            const auto at = static_cast<std::size_t>(a);
            Contact& c = contacts[index(dragging[at])];
            c.share = shares[a];
            c.response = blend(c.response, slipping[at], c.share);
            add(total, c.response, c.kinematics, dragging[at]);
        }
    }

    // Every power is linear in the share, so the ledger closes.
    [[nodiscard]] static ContactResponse<S> blend(const ContactResponse<S>& from, const ContactResponse<S>& to,
                                                  const S& share) noexcept {
        ContactResponse<S> r = from;
        const auto mix = [&](auto& at, const auto& end) { at += share * (end - at); };
        mix(r.normal_force, to.normal_force);
        r.friction_force = share * to.friction_force;
        r.bristle_rate += share * (to.bristle_rate - from.bristle_rate);
        mix(r.normal_damper_power, to.normal_damper_power);
        mix(r.tangential_damper_power, to.tangential_damper_power);
        mix(r.clutch_power, to.clutch_power);
        return r;
    }

    // Where D_t = C_V = 0 the clutch's velocity depends on how fast its load changes, thus on the acceleration.
    template <class Contacts>
    void resolve_plastic_clutches(Contacts& contacts, const StateVector& y, const Motion& m,
                                  const Action& total) const noexcept {
        for (int i = 0; i < spheres(); ++i) {
            if (phase(i) != Phase::slip || !law(i).friction.plastic()) continue;
            Contact& c = contacts[index(i)];
            const Kinematics& k = c.kinematics;
            c.load_rate = force_rate(y, m, k, i, total);
            c.response =
                law(i).respond(Phase::slip, root_depth(y, i), k.depth_rate, k.slip, bristle(y, i), c.load_rate);
        }
    }

    [[nodiscard, gnu::always_inline]] Eigen::Array<S, 4, 1> orientation_rate(const StateVector& y,
                                                                             const Vector3<S>& w) const noexcept {
        // qdot = (1/2) (0, omega) q
        const auto q = y.template segment<4>(LayoutType::orientation);
        const S half(0.5);
        return {
            half * (w.x() * q[3] + w.y() * q[2] - w.z() * q[1]), half * (w.y() * q[3] + w.z() * q[0] - w.x() * q[2]),
            half * (w.z() * q[3] + w.x() * q[1] - w.y() * q[0]), -half * (w.x() * q[0] + w.y() * q[1] + w.z() * q[2])};
    }

    [[gnu::always_inline]] void contact_rate(const Contact& c, const StateVector& y, StateVector& rate, int i,
                                             const S& g) const noexcept {
        const int b = layout_.bristle(i), e = layout_.ledger(i);
        if (!touches(i)) {
            // s stays 0. The bristle recovers as an exponential that the simulator applies in closed form.
            rate[layout_.root_depth(i)] = S(0);
            if constexpr (Law::has_states) {
                for (int k = 0; k < layout_.friction_states; ++k) rate[b + k] = S(0);
            } else {
                rate[b] = rate[b + 1] = S(0);
            }
            for (int k = 0; k < LayoutType::ledger_per_contact; ++k) rate[e + k] = S(0);
            return;
        }
        const ContactResponse<S>& r = c.response;
        S share(0.5);  // g / (2 s)
        if (Spheres != 1 || drags(i)) share = g / (S(2) * root_depth(y, i));
        rate[layout_.root_depth(i)] = c.kinematics.depth_rate * share;
        if constexpr (Law::has_states) {
            for (int k = 0; k < layout_.friction_states; ++k) rate[b + k] = c.state_rates[index(k)] * g;
        } else {
            rate[b] = r.bristle_rate.x() * g;
            rate[b + 1] = r.bristle_rate.y() * g;
        }
        rate[e + LayoutType::normal_damper] = r.normal_damper_power * g;
        rate[e + LayoutType::tangential_damper] = r.tangential_damper_power * g;
        rate[e + LayoutType::clutch] = r.clutch_power * g;
        rate[e + LayoutType::stiffness_change] = r.stiffness_change_power * g;
    }

    template <class Contacts>
    [[gnu::always_inline]] void fill_guards(const Contacts& contacts, const StateVector& y, const Motion& m,
                                            Guards& guards) const noexcept {
        for (int i = 0; i < spheres(); ++i) {
            const Contact& c = contacts[index(i)];
            S& load = guards[guards_per_contact * i + load_guard];
            S& clutch = guards[guards_per_contact * i + clutch_guard];
            S& depth = guards[guards_per_contact * i + depth_guard];
            clutch = depth = S(1);
            if (!touches(i)) {
                load = -geometric_depth(m, c.kinematics, i);
                continue;
            }
            const S s = root_depth(y, i);
            const Law& l = law(i);
            depth = s;
            if (drags(i)) {  // to slip, to no friction
                load = S(1) - c.share;
                clutch = c.share;
                continue;
            }
            load = l.normal.load(s, c.kinematics.depth_rate);
            if (phase(i) == Phase::recovering) {
                load = -load;
                continue;
            }
            if constexpr (Law::has_clutch) {
                const S phi_n = l.normal.template force<Law::ScalePower>(s, c.kinematics.depth_rate).total();
                const Vector2<S>& V = c.kinematics.slip;
                clutch = phase(i) == Phase::stick
                             ? l.friction.cone_margin(phi_n, V, bristle(y, i))
                             : l.friction.slip_margin(l.friction.scale(s), phi_n, c.load_rate, V, bristle(y, i));
            } else if constexpr (Law::has_states) {
                clutch = l.friction.margin(phase(i), c.kinematics.slip, friction_states(y, i));
            }
        }
    }

    template <class, int>
    friend class System;
    System() = default;

    LayoutType layout_;
    S mass_, inverse_mass_;
    Matrix3<S> inverse_inertia_;
    bool isotropic_ = false;  // inertia is a multiple of the identity: omega = L / I
    bool oriented_ = false;   // the motion depends on the orientation
    Vector3<S> gravity_;
    S height_;
    std::vector<Vector3<S>> centers_;
    std::vector<S> radii_;
    std::vector<Law> laws_;
    PerContact<Phase> phases_{};
    PerContact<bool> drags_{};
    mutable std::vector<Contact> contacts_;  // scratch of evaluate, where its size is not known at compile time
};

template <class Law, int Spheres>
template <class T>
auto System<Law, Spheres>::cast() const {
    using Cast = decltype(std::declval<Law>().template cast<T>());
    System<Cast, Spheres> other;
    other.layout_ = layout_;
    other.mass_ = T(mass_);
    other.inverse_mass_ = T(inverse_mass_);
    other.inverse_inertia_ = inverse_inertia_.template cast<T>();
    other.isotropic_ = isotropic_;
    other.oriented_ = oriented_;
    other.gravity_ = gravity_.template cast<T>();
    other.height_ = T(height_);
    for (const auto& c : centers_) other.centers_.push_back(c.template cast<T>());
    for (const auto& r : radii_) other.radii_.push_back(T(r));
    for (const auto& l : laws_) other.laws_.push_back(l.template cast<T>());
    other.phases_ = phases_;
    other.drags_ = drags_;
    if constexpr (Spheres == Eigen::Dynamic) other.contacts_.resize(contacts_.size());
    return other;
}

}  // namespace footfall
