#include "footfall/study/viscoelastic_theory.hpp"

#include <array>
#include <cmath>
#include <type_traits>

namespace footfall {
namespace {

/// e under (2), from a = lambda v / k.
double hunt_crossley_of(double a) noexcept {
    if (!(a > 0)) return 1;
    // The root below is lost in rounding where a is small; this is the expansion of the same equation.
    if (a < 1e-3) return 1 + a * (-2.0 / 3.0 + a * (4.0 / 9.0 - a * 44.0 / 135.0));
    // y = a e is the root in (0, 1) of y + log(1 - y) = log(1 + a) - a, whose left side falls from 0 to -infinity.
    const double right = std::log1p(a) - a;
    double low = 0, high = std::fmin(a, 1);
    double y = a < 1 ? a * (1 - a / 3) : 1 - std::exp(right - 1);
    for (int i = 0; i < 200; ++i) {
        const double miss = y + std::log1p(-y) - right;
        (miss > 0 ? low : high) = y;
        double next = y + miss * (1 - y) / y;  // Newton
        if (!(next > low && next < high)) next = (low + high) / 2;
        if (std::abs(next - y) <= 1e-16 * y) break;
        y = next;
    }
    return y / a;
}

}  // namespace

double viscoelastic_number(double normal_stiffness, double normal_damping, double mass, double speed) noexcept {
    const double &K_n = normal_stiffness, &D_n = normal_damping;
    return D_n / K_n * std::pow(K_n / mass, 0.4) * std::pow(speed, 0.2);
}

double zero_depth_series(double B) noexcept {
    constexpr double C_1 = 1.153448858095289, C_2 = 0.798266560944795, C_3 = 0.522882568088415, C_4 = 0.348742675260385;
    return 1 + B * (-C_1 + B * (C_2 + B * (-C_3 + B * C_4)));
}

double zero_force_series(double B) noexcept {
    constexpr std::array<double, 21> h{1.0,
                                       0.0,
                                       -1.153448858095288,
                                       0.0,
                                       0.7982665609447954,
                                       4.0 / 15.0,
                                       -0.5228825680884149,
                                       -0.4613795432381155,
                                       0.348742675260385,
                                       0.4523510512020507,
                                       -0.1464314653525777,
                                       -0.3677283008381452,
                                       -0.0432489830152763,
                                       0.2818042342185351,
                                       0.1478525877319158,
                                       -0.1794420601694365,
                                       -0.1784660334258645,
                                       0.06593358942445519,
                                       0.1713586193461883,
                                       0.02524981112215845,
                                       -0.1379233708623289};
    const double root = std::sqrt(B);
    double sum = 0;
    for (auto coefficient = h.rbegin(); coefficient != h.rend(); ++coefficient) sum = sum * root + *coefficient;
    return sum;
}

double zero_force_pade(double B) noexcept {
    const double x = std::sqrt(B);
    constexpr double a_1 = 0.501086, b_1 = 0.501086, b_2 = 1.15345, b_3 = 0.577977, b_4 = 0.532178;
    return (1 + a_1 * x) / (1 + x * (b_1 + x * (b_2 + x * (b_3 + x * b_4))));
}

double hunt_crossley_restitution(double stiffness, double damping, double speed) noexcept {
    return hunt_crossley_of(damping * speed / stiffness);
}

double linear_restitution(double mass, double stiffness, double damping) noexcept {
    const double beta = damping / (2 * mass), square = stiffness / mass - beta * beta;
    if (square > 0) {
        const double omega = std::sqrt(square);
        // The force is zero where tan(omega t) = 2 beta omega / (beta^2 - omega^2), omega t in (0, pi].
        return std::exp(-beta / omega * std::atan2(2 * beta * omega, beta * beta - omega * omega));
    }
    if (square == 0) return std::exp(-2.0);
    const double Omega = std::sqrt(-square);
    // (beta - Omega) = k / m / (beta + Omega), without the cancellation.
    return std::exp(-beta / Omega * std::log((beta + Omega) * (beta + Omega) * mass / stiffness));
}

std::vector<RestitutionTheory> theories_of(const NormalLaw& law, double mass) {
    std::vector<RestitutionTheory> theories;
    const auto viscoelastic = [&](const AzadFeatherstoneNormal<>& l) {
        const auto add = [&](const char* name, const char* description, double (*e)(double) noexcept) {
            theories.push_back({name, description, [l, mass, e](double speed) {
                                    return e(viscoelastic_number(l.stiffness, l.damping, mass, speed));
                                }});
        };
        add("ramirez", "Ramirez et al. 1999, four terms; contact until zero depth, which is not this law",
            zero_depth_series);
        add("schwager_poeschel", "Schwager & Poeschel 2008, series to B^10; contact until zero force; small speeds",
            zero_force_series);
        add("mueller_poeschel", "Mueller & Poeschel 2011, Pade approximant; contact until zero force", zero_force_pade);
    };
    const auto classical = [&](const HuntCrossleyNormal<>& l, auto at_speed) {
        if (l.n != l.p || l.q != 1) return;
        theories.push_back({"closed_form",
                            "Hunt & Crossley's (2), a (1 + e) = log((1 + a) / (1 - a e)), a = lambda v/k",
                            [at_speed](double speed) {
                                const HuntCrossleyNormal<> begun = at_speed(speed);
                                return hunt_crossley_restitution(begun.stiffness, begun.damping, speed);
                            }});
    };
    std::visit(
        [&]<class Law>(const Law& l) {
            const auto at_speed = [l](double speed) { return law_of_impact(l, speed); };
            using Computed = decltype(at_speed(1.0));
            if constexpr (std::is_same_v<Computed, AzadFeatherstoneNormal<>>) {
                viscoelastic(at_speed(1.0));
            } else if constexpr (std::is_same_v<Computed, HuntCrossleyNormal<>>) {
                classical(at_speed(1.0), at_speed);
            } else if constexpr (std::is_same_v<Computed, LinearNormal<>>) {
                theories.push_back({"closed_form",
                                    "the linear law until zero force; Schwager & Poeschel 2007, (15)-(17)",
                                    [l, mass](double) { return linear_restitution(mass, l.stiffness, l.damping); }});
            }
        },
        law);
    return theories;
}

}  // namespace footfall
