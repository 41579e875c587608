// A sphere that hits the ground at an angle, with or without spin: how it leaves again, under any pair of laws.
//
// The motion is planar: the centre moves along +x over the ground z = 0 and the spin is about the y axis, positive
// where the sphere would roll forward (top spin). V = v_x - r omega is the velocity of the contact point, the sphere's
// bottom. Angles are measured from the ground's normal.
//
// Sources of the quantities: Maw, Barber & Fawcett 1976 (psi_1, psi_2), Walton & Braun 1986 (restitution of the contact
// point), Kharaz, Gorham & Salman 2001 (restitution and rebound angle of the centre), Chung & Ooi 2011 (rebound angle
// of the contact point; psi_1 and psi_2 without Poisson's ratio).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "footfall/energy/channels.hpp"
#include "footfall/law/phase.hpp"
#include "footfall/law/registry.hpp"
#include "footfall/math/error.hpp"
#include "footfall/study/go_on.hpp"
#include "footfall/study/least_squares.hpp"
#include "footfall/study/table.hpp"

namespace footfall {

/// A sphere, and what it falls on.
struct ObliqueSphere {
    double mass = 0;                ///< m [kg], > 0
    double radius = 0;              ///< r [m], > 0
    std::optional<double> inertia;  ///< about the centre [kg m^2], > 0; (2/5) m r^2 where it is left out
    ContactParameters contact;
    double gravity = 0;        ///< along -z [m/s^2], >= 0
    double tolerance = 1e-10;  ///< of the run, from 1e-14 to 1e-3
    GoOn go_on = nullptr;
};

/// How a sphere comes in.
struct Approach {
    double normal_speed = 0;         ///< V_n, towards the ground [m/s], > 0
    double tangential_velocity = 0;  ///< of the centre, v_x [m/s]
    double spin = 0;                 ///< omega [rad/s], > 0 is top spin
};

/// The approach of a centre at `speed` [m/s] and `angle` [rad] from the normal, 0 <= angle < pi/2.
[[nodiscard]] Approach approach_at_speed(double speed, double angle, double spin = 0);
/// The same with the speed's normal part given instead.
[[nodiscard]] Approach approach_at_normal_speed(double normal_speed, double angle, double spin = 0);

/// One stretch of an impact in which the contact does not change how it touches.
struct ObliquePhase {
    Phase phase = Phase::slip;
    double start = 0;     ///< from touchdown [s]
    double duration = 0;  ///< [s]
};

/// One impact, from touchdown to the return of the indentation to zero. What comes out is NaN where the sphere does not
/// leave the ground (gravity may hold it).
struct ObliqueImpact {
    Approach in;
    double radius = 0;               ///< r [m]
    double normal_speed = 0;         ///< away from the ground, after [m/s]
    double tangential_velocity = 0;  ///< of the centre, after [m/s]
    double spin = 0;                 ///< after [rad/s]
    double impulse_ratio =
        0;  ///< friction's impulse against +x over the normal impulse [1]; mu where it slides throughout
    double peak_normal_force = 0;  ///< [N]
    double duration = 0;           ///< from touchdown to the last moment of normal force [s]
    double dissipated = 0;         ///< by dampers and clutch, over the kinetic energy before [1]
    ContactEnergy energy;          ///< of the contact at the end, over the kinetic energy before [1]
    double residual = 0;           ///< the largest of the ledger [1]
    std::vector<ObliquePhase> history;

    /// V = v_x - r omega, velocity of the contact point before and after [m/s].
    [[nodiscard]] double contact_velocity_before() const noexcept { return in.tangential_velocity - radius * in.spin; }
    [[nodiscard]] double contact_velocity() const noexcept { return tangential_velocity - radius * spin; }

    /// e_n, normal speed after over before [1].
    [[nodiscard]] double normal_restitution() const noexcept { return normal_speed / in.normal_speed; }
    /// e_t = v_x'/v_x of the centre [1]; NaN where v_x = 0. Kharaz, Gorham & Salman 2001.
    [[nodiscard]] double tangential_restitution() const noexcept;
    /// beta = -V'/V of the contact point [1], -1 without friction, 0 where it ends rolling; NaN where V = 0. It leaves
    /// [-1, 1] only where the law makes energy (`energy.unpaid() < 0`). Walton & Braun 1986.
    [[nodiscard]] double contact_restitution() const noexcept;
    /// Between the normal and the velocity of the centre after [rad], < 0 where it goes back.
    [[nodiscard]] double rebound_angle() const noexcept;
    /// Between the normal and the velocity of the contact point after [rad], < 0 where that goes back.
    [[nodiscard]] double contact_rebound_angle() const noexcept;
    /// Time spent in a phase [s].
    [[nodiscard]] double time_in(Phase phase) const noexcept;
};

/// Computes one impact. Throws InvalidInput where the sphere, its laws or the approach cannot be used; Interrupted.
[[nodiscard]] ObliqueImpact oblique_impact(const ObliqueSphere& sphere, const Approach& approach);

/// mu of sliding, the parameter `coefficient` or `kinetic_coefficient` of a friction law; nothing where the law has
/// none or it is 0.
[[nodiscard]] std::optional<double> friction_coefficient(const FrictionLaw& law);

/// kappa = 2(1 - nu)/(2 - nu) [1], the ratio of tangential to normal stiffness of a contact of like materials. Mindlin
/// 1949. Throws InvalidInput unless -1 < nu <= 0.5.
[[nodiscard]] double mindlin_ratio(double poisson_ratio);

/// Impacts as a table, one row each, angles in degrees. `coefficient` is mu: with it
///   psi1 = V/(mu V_n), psi2 = V'/(mu V_n)                                              Chung & Ooi 2011
/// and with a Poisson's ratio as well
///   psi1_maw = kappa psi1, psi2_maw = kappa psi2, kappa = 2(1 - nu)/(2 - nu)           Maw, Barber & Fawcett 1976
/// V_n being the normal speed before, also in psi2.
[[nodiscard]] Table oblique_table(std::span<const ObliqueImpact> impacts, std::optional<double> coefficient,
                                  std::optional<double> poisson_ratio);

/// Every phase of every impact, one row each: `row` counts the impacts from 0, `phase` is 0 while it slips, 1 while it
/// sticks, 2 while the ground recovers without force.
[[nodiscard]] Table oblique_history(std::span<const ObliqueImpact> impacts);

/// A column of oblique_table that can be measured, and its unit there ("degree", "1", "rad/s").
struct ObliqueObservable {
    std::string_view name, unit;
};
[[nodiscard]] std::span<const ObliqueObservable> oblique_observables();

/// A measured curve: one observable of several impacts.
struct ObliqueMeasurement {
    std::string observable;  ///< one of oblique_observables: "spin_after"
    std::vector<Approach> approaches;
    std::vector<double> values;  ///< one for each approach, in the table's unit
};

struct ObliqueFit {
    FitResult result;
    ContactParameters contact;  ///< the laws with the estimates in them
    std::string unit;           ///< of the observable
    std::vector<double> model;  ///< the observable under these laws, one for each approach
};

/// The parameters of these laws as fit_oblique calls them: "normal.stiffness", "friction.coefficient".
[[nodiscard]] std::vector<std::string> parameter_keys(const ContactParameters& contact);

/// Fits parameters of the laws, such as "friction.coefficient" and "friction.stiffness", to a measured curve by least
/// squares, from the values in `start`, which must be > 0. Throws InvalidInput where an observable or a parameter is
/// unknown, and what oblique_impact and fit_least_squares throw.
[[nodiscard]] ObliqueFit fit_oblique(const ObliqueSphere& start, const ObliqueMeasurement& measured,
                                     std::span<const std::string> keys, const FitOptions& options = {});

}  // namespace footfall
