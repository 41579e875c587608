// What theory says of restitution without gravity.
//
// For the paper's law, the viscoelastic sphere, e depends on one number only,
//
//   B = beta v^(1/5),  beta = (D_n / K_n) (K_n / m)^(2/5),
//
// which is the beta v^(1/5) of the sources below with D_n = (3/2) A K_n. They differ in where the contact ends:
//   at zero depth: Ramirez, Poeschel, Brilliantov & Schwager 1999; the force pulls at the end. Not this law.
//   at zero force: Schwager & Poeschel 2008, Mueller & Poeschel 2011; the law with the clamp (14).
// The two agree up to B^2 and part at B^(5/2).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "footfall/law/registry.hpp"

namespace footfall {

/// B [1] of the paper's law with K_n [N/m^1.5] and D_n [N s/m^1.5] at the impact of a mass [kg] at a speed [m/s].
[[nodiscard]] double viscoelastic_number(double normal_stiffness, double normal_damping, double mass,
                                         double speed) noexcept;

/// e = 1 - C_1 B + C_2 B^2 - C_3 B^3 + C_4 B^4, contact until zero depth. Ramirez et al. 1999, with C_3 and C_4
/// computed anew (docs/restitution.md).
[[nodiscard]] double zero_depth_series(double B) noexcept;

/// e = 1 + sum of h_k B^(k/2), k = 2 ... 20, contact until zero force. Schwager & Poeschel 2008; the coefficients are
/// computed anew (docs/restitution.md). For small B only.
[[nodiscard]] double zero_force_series(double B) noexcept;

/// The Pade approximant [1/4] in B^(1/2) to that series, for every B. Mueller & Poeschel 2011.
[[nodiscard]] double zero_force_pade(double B) noexcept;

/// Hunt & Crossley's (2) at `speed` [m/s]: e solves a (1 + e) = log((1 + a) / (1 - a e)), a = lambda v / k.
/// Any n = p > 0 and any mass: separating the variables z and zdot, they cancel. Marhefka & Orin 1999.
[[nodiscard]] double hunt_crossley_restitution(double stiffness, double damping, double speed) noexcept;

/// The linear law with the clamp: contact until zero force, over- and underdamped. Any speed. Schwager & Poeschel 2007,
/// (15)-(17). Mass [kg], k [N/m], d [N s/m].
[[nodiscard]] double linear_restitution(double mass, double stiffness, double damping) noexcept;

/// One theory of one law.
struct RestitutionTheory {
    std::string name;                           ///< of a column
    std::string description;                    ///< with its source and where its contact ends
    std::function<double(double)> restitution;  ///< e at a speed [m/s], > 0
};

/// Every theory of e(v) for this law and mass [kg]; none for a law without one.
[[nodiscard]] std::vector<RestitutionTheory> theories_of(const NormalLaw& law, double mass);

}  // namespace footfall
