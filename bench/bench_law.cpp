// One evaluation of the contact law for a stream of independent contacts: ContactLaw::evaluate against the same
// arithmetic written by hand, both as one scalar loop over plain arrays. The results must agree.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/timing.hpp"
#include "footfall/law/contact_law.hpp"
#include "footfall/law/friction/azad_featherstone.hpp"
#include "footfall/law/normal/azad_featherstone.hpp"

namespace {

/// Known at run time only, as in use.
struct Parameters {
    double K_n, D_n, K_t, D_t, mu, C_V;
};
volatile double unknown_to_the_compiler = 1;

Parameters section_4() {
    const double one = unknown_to_the_compiler;
    return {8.5e6 * one, 3.1e3 * one, 12.75e6 * one, 3.1e3 * one, 0.2 * one, 0.1 * one};
}

/// Contacts in the layout that a stream of them has: an array for each quantity.
struct Contacts {
    std::vector<double> z, zdot, Vx, Vy, ux, uy;
};

struct Forces {
    explicit Forces(std::size_t n) : F_n(n), Fx(n), Fy(n), udotx(n), udoty(n) {}
    std::vector<double> F_n, Fx, Fy, udotx, udoty;
};

/// What the ledger needs besides the forces.
struct Energies {
    explicit Energies(std::size_t n)
        : normal_spring(n),
          tangential_spring(n),
          normal_damper(n),
          tangential_damper(n),
          clutch(n),
          stiffness_change(n) {}
    std::vector<double> normal_spring, tangential_spring, normal_damper, tangential_damper, clutch, stiffness_change;
};

using Law = footfall::ContactLaw<footfall::AzadFeatherstoneNormal<>, footfall::AzadFeatherstoneFriction<>>;

Law law_of(const Parameters& p) { return {{p.K_n, p.D_n}, {{p.K_t, p.D_t, p.mu, p.C_V}}}; }

template <bool WithEnergies>
void through_the_library(const Law law, const Contacts& c, Forces& f, Energies& e) {
    for (std::size_t i = 0; i < c.z.size(); ++i) {
        const auto r = law.evaluate(c.z[i], c.zdot[i], {c.Vx[i], c.Vy[i]}, {c.ux[i], c.uy[i]});
        f.F_n[i] = r.normal_force;
        f.Fx[i] = r.friction_force.x();
        f.Fy[i] = r.friction_force.y();
        f.udotx[i] = r.bristle_rate.x();
        f.udoty[i] = r.bristle_rate.y();
        if constexpr (WithEnergies) {
            e.normal_spring[i] = r.normal_spring;
            e.tangential_spring[i] = r.tangential_spring;
            e.normal_damper[i] = r.normal_damper_power;
            e.tangential_damper[i] = r.tangential_damper_power;
            e.clutch[i] = r.clutch_power;
            e.stiffness_change[i] = r.stiffness_change_power;
        }
    }
}

template <bool WithEnergies>
void by_hand(const Parameters p, const Contacts& c, Forces& f, Energies& e) {
    const auto [K_n, D_n, K_t, D_t, mu, C_V] = p;
    const double recovery = K_t / D_t;
    for (std::size_t i = 0; i < c.z.size(); ++i) {
        const double z = c.z[i], zdot = c.zdot[i], Vx = c.Vx[i], Vy = c.Vy[i], ux = c.ux[i], uy = c.uy[i];
        double F_n = 0, Fx = 0, Fy = 0, udotx = -recovery * ux, udoty = -recovery * uy;
        double spring = 0, bristle = 0, damper = 0, tangential = 0, clutch = 0, change = 0;
        if (z > 0) {
            const double s = std::sqrt(z);
            const double f_n = K_n * z + D_n * zdot;
            if (f_n > 0) {
                F_n = s * f_n;
                const double fx = -(K_t * ux + D_t * Vx), fy = -(K_t * uy + D_t * Vy);
                const double f_stick = std::sqrt(fx * fx + fy * fy);
                if (f_stick > mu * f_n) {
                    const double D_ts = D_t * s;
                    const double share = (D_ts * mu * f_n + C_V * f_stick) / ((D_ts + C_V) * f_stick);
                    const double px = share * fx, py = share * fy;
                    udotx = -(px + K_t * ux) / D_t;
                    udoty = -(py + K_t * uy) / D_t;
                    Fx = s * px;
                    Fy = s * py;
                    if constexpr (WithEnergies) clutch = -(Fx * (Vx - udotx) + Fy * (Vy - udoty));
                } else {
                    Fx = s * fx;
                    Fy = s * fy;
                    udotx = Vx;
                    udoty = Vy;
                }
                if constexpr (WithEnergies) damper = D_n * s * zdot * zdot;
            } else if constexpr (WithEnergies) {
                damper = -K_n * z * s * zdot;
            }
            if constexpr (WithEnergies) {
                const double u2 = ux * ux + uy * uy;
                spring = 0.4 * K_n * z * z * s;
                bristle = 0.5 * K_t * s * u2;
                tangential = D_t * s * (udotx * udotx + udoty * udoty);
                change = -0.25 * K_t * zdot * u2 / s;
            }
        }
        f.F_n[i] = F_n;
        f.Fx[i] = Fx;
        f.Fy[i] = Fy;
        f.udotx[i] = udotx;
        f.udoty[i] = udoty;
        if constexpr (WithEnergies) {
            e.normal_spring[i] = spring;
            e.tangential_spring[i] = bristle;
            e.normal_damper[i] = damper;
            e.tangential_damper[i] = tangential;
            e.clutch[i] = clutch;
            e.stiffness_change[i] = change;
        }
    }
}

enum class Mix { slip, stick, all };

/// Contacts drawn from the sizes that the paper's run has, kept where they are in the phases asked for.
Contacts draw(Mix mix, std::size_t n) {
    std::mt19937_64 random(2010);
    std::uniform_real_distribution<double> sign(-1, 1);
    const Law law = law_of(section_4());
    Contacts c;
    while (c.z.size() < n) {
        const double z = 1e-3 * (mix == Mix::all ? sign(random) : std::abs(sign(random))), zdot = sign(random);
        const double V = mix == Mix::stick ? 0.05 : 0.5, u = mix == Mix::stick ? 1e-5 : 5e-5;
        const footfall::Vector2<double> slip(V * sign(random), V * sign(random)),
            bristle(u * sign(random), u * sign(random));
        const footfall::Phase phase = law.evaluate(z, zdot, slip, bristle).phase;
        if (mix == Mix::slip && phase != footfall::Phase::slip) continue;
        if (mix == Mix::stick && phase != footfall::Phase::stick) continue;
        c.z.push_back(z);
        c.zdot.push_back(zdot);
        c.Vx.push_back(slip.x());
        c.Vy.push_back(slip.y());
        c.ux.push_back(bristle.x());
        c.uy.push_back(bristle.y());
    }
    return c;
}

/// The largest difference, relative to the largest value.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0, apart = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        largest = std::max({largest, std::abs(a[i]), std::abs(b[i])});
        apart = std::max(apart, std::abs(a[i] - b[i]));
    }
    return largest > 0 ? apart / largest : 0;
}

double difference(const Forces& a, const Forces& b) {
    return std::max({difference(a.F_n, b.F_n), difference(a.Fx, b.Fx), difference(a.Fy, b.Fy),
                     difference(a.udotx, b.udotx), difference(a.udoty, b.udoty)});
}

double difference(const Energies& a, const Energies& b) {
    return std::max({difference(a.normal_spring, b.normal_spring), difference(a.tangential_spring, b.tangential_spring),
                     difference(a.normal_damper, b.normal_damper), difference(a.tangential_damper, b.tangential_damper),
                     difference(a.clutch, b.clutch), difference(a.stiffness_change, b.stiffness_change)});
}

/// Whether both ways gave the same.
template <bool WithEnergies>
bool compare(const std::string& name, const Contacts& contacts) {
    constexpr int repeats = 50;
    const std::size_t n = contacts.z.size();
    const Parameters parameters = section_4();
    const Law law = law_of(parameters);
    Forces library_forces(n), hand_forces(n);
    Energies library_energies(n), hand_energies(n);
    const std::vector<std::function<void()>> ways{
        [&] {
            for (int k = 0; k < repeats; ++k)
                through_the_library<WithEnergies>(law, contacts, library_forces, library_energies);
        },
        [&] {
            for (int k = 0; k < repeats; ++k) by_hand<WithEnergies>(parameters, contacts, hand_forces, hand_energies);
        }};
    std::vector<double> seconds = bench::median_times(ways, 51);
    for (double& s : seconds) s *= 1e9 / (static_cast<double>(n) * repeats);
    const double apart = std::max(difference(library_forces, hand_forces), difference(library_energies, hand_energies));
    fmt::print("{:<44}{:>12.2f}{:>12.2f}{:>8.2f}{:>14.1e}\n", name, seconds[0], seconds[1], seconds[0] / seconds[1],
               apart);
    return apart < 1e-14;
}

}  // namespace

int main() {
    constexpr std::size_t n = 2048;  // all arrays stay in the cache
    fmt::print(
        "One evaluation of the contact law, ns of processor time; medians. The target is a ratio of at most 1.3.\n\n");
    fmt::print("{:<44}{:>12}{:>12}{:>8}{:>14}\n", "", "library", "by hand", "ratio", "difference");
    const Contacts slip = draw(Mix::slip, n), stick = draw(Mix::stick, n), all = draw(Mix::all, n);
    bool same = compare<false>("forces, slipping", slip);
    same &= compare<false>("forces, sticking", stick);
    same &= compare<false>("forces, every phase at random", all);
    same &= compare<true>("forces and ledger, slipping", slip);
    same &= compare<true>("forces and ledger, sticking", stick);
    same &= compare<true>("forces and ledger, every phase at random", all);
    if (!same) fmt::print("\nThe library and the loop by hand do not give the same results.\n");
    return same ? 0 : 1;
}
