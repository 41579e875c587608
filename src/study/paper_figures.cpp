// The paper's figures of restitution, as studies. What the paper does not print is our choice: docs/restitution.md.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "footfall/material/presets.hpp"
#include "footfall/study/damping.hpp"
#include "footfall/study/restitution.hpp"

namespace footfall {
namespace {

constexpr double mass = 0.154, radius = 0.0165;          // section 2.2
constexpr AzadFeatherstoneNormal<> paper{8.5e6, 3.1e3};  // figure 7
constexpr HuntCrossleyNormal<> classical{8.5e6, 3.1e6};  // figure 6

/// The linear law that is as deep at 1 m/s as Hertz's, and keeps as much speed there as the paper's law.
NormalLaw linear_beside_the_paper() {
    constexpr double speed = 1;
    const double deepest = std::pow(1.25 * mass * speed * speed / paper.stiffness, 0.4);  // (2/5) K_n z^(5/2) = m v^2/2
    const LinearNormal<> elastic{mass * speed * speed / (deepest * deepest), 0};          // k z^2 / 2 = m v^2 / 2
    return with_restitution(elastic, mass, speed, normal_impact(paper, mass, speed).restitution);
}

RestitutionStudy figure_2() {
    return {.title = "Figure 2: restitution against speed under three laws",
            .cases = {{"paper", paper, mass, radius},
                      {"classical", classical, mass, radius},
                      {"linear", linear_beside_the_paper(), mass, radius}},
            .speeds = logarithmic_speeds(1e-2, 10, 50),  // e falls fastest at the slow end
            .options = {}};
}

RestitutionStudy figure_3() {
    RestitutionStudy study{.title = "Figure 3: restitution against the logarithm of speed",
                           .cases = {},
                           .speeds = logarithmic_speeds(1e-3, 10, 50),
                           .options = {}};
    for (const double damping : {1e3, 3.1e3, 1e4, 3.1e4}) {
        study.cases.push_back(
            {fmt::format("D_n={:g}", damping), AzadFeatherstoneNormal<>{paper.stiffness, damping}, mass, radius});
    }
    study.cases.push_back({"classical", classical, mass, radius});
    return study;
}

RestitutionStudy figure_4() {
    struct Pair {
        const char* name;
        const char* ground;
        double radius;
        double restitution;  ///< at 1 m/s: chosen
    };
    RestitutionStudy study{.title = "Figure 4: restitution of a steel sphere on four grounds",
                           .cases = {},
                           .speeds = logarithmic_speeds(1e-2, 10, 50),
                           .options = {}};
    const MaterialPreset& steel = material_preset("steel");
    for (const Pair& pair : {Pair{"A cast-iron", "cast-iron", 0.0127, 0.7}, Pair{"B cork", "cork", 0.0165, 0.5},
                             Pair{"C brass", "brass", 0.0127, 0.6}, Pair{"D lead", "lead", 0.0127, 0.25}}) {
        const double weight = 4.0 / 3.0 * std::numbers::pi * pair.radius * pair.radius * pair.radius * steel.density;
        const double modulus = effective_modulus(steel.material, material_preset(pair.ground).material);
        const AzadFeatherstoneNormal<> elastic{normal_stiffness(modulus, pair.radius), 0};
        study.cases.push_back({pair.name, with_restitution(elastic, weight, 1, pair.restitution), weight, pair.radius});
    }
    return study;
}

}  // namespace

RestitutionStudy paper_figure(int number) {
    if (number == 2) return figure_2();
    if (number == 3) return figure_3();
    if (number == 4) return figure_4();
    throw InvalidInput(fmt::format("figure {} has no curves of restitution; there are 2, 3 and 4", number));
}

}  // namespace footfall
