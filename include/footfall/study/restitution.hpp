// Restitution: how much of its speed a sphere keeps in one impact along the normal, under any normal law.
//
// e = speed out / speed in at the moment when the indentation returns to zero (`recovered`). Without gravity nothing
// acts on the sphere between the end of the force (14) and that moment, so e is the speed at zero force over the speed
// in, which is where Schwager & Poeschel (2008) end the contact as well.
// Source: Azad & Featherstone 2010, section 2.1, figures 2, 3, 4.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "footfall/law/registry.hpp"
#include "footfall/math/error.hpp"
#include "footfall/study/go_on.hpp"
#include "footfall/study/table.hpp"

namespace footfall {

struct ImpactOptions {
    double gravity = 0;        ///< towards the ground [m/s^2], >= 0
    double tolerance = 1e-12;  ///< of the run, from 1e-14 to 1e-3; the error of e is of this order
    GoOn go_on = nullptr;
};

/// One impact. Times count from touchdown.
struct NormalImpact {
    double speed = 0;                  ///< into the ground, at touchdown [m/s]
    double restitution = 0;            ///< e [1]; 0 where the sphere does not leave the ground again
    double peak_force = 0;             ///< [N]
    double peak_indentation = 0;       ///< [m]
    std::optional<double> separation;  ///< last time that the force reached zero [s]; empty: it has not
    std::optional<double> recovered;   ///< when the indentation returned to zero [s]; empty: it stays in the ground

    [[nodiscard]] bool bounced() const noexcept { return recovered.has_value(); }
};

/// The impact of a sphere of `mass` [kg], > 0, at `speed` [m/s], > 0. The radius plays no part but in the law's
/// parameters. Throws InvalidInput where a value is out of its range.
[[nodiscard]] NormalImpact normal_impact(const NormalLaw& law, double mass, double speed,
                                         const ImpactOptions& options = {});

/// The speed at touchdown [m/s] below which `gravity`, > 0, keeps the sphere on the ground: e = 0. To 1e-9 of its
/// value. 0 where it bounces however slow it is (an elastic law), as far as the tolerance can tell: down to 10
/// sqrt(tolerance) of the speed of a fall through the depth of rest. Empty where it bounces at no speed.
[[nodiscard]] std::optional<double> slowest_bounce(const NormalLaw& law, double mass, const ImpactOptions& options);

/// Where a curve of e against the logarithm of the speed is straight: around its inflection.
struct LogLinearRange {
    double speed = 0;        ///< at the inflection [m/s]
    double restitution = 0;  ///< there [1]
    double slope = 0;        ///< de / d ln v there [1]
    double slowest = 0;      ///< e stays within the deviation of the tangent from here ... [m/s]
    double fastest = 0;      ///< ... to here [m/s]
};
/// The range around the inflection between `from` and `to` [m/s], 0 < from < to, in which |e - tangent| <= `deviation`,
/// > 0. Without gravity. Empty where de / d ln v has no smallest value inside (from, to).
[[nodiscard]] std::optional<LogLinearRange> log_linear_range(const NormalLaw& law, double mass, double from, double to,
                                                             double deviation);

/// `count` speeds [m/s] from `from` to `to`, both included, 0 < from < to, count from 2 to 1e6.
[[nodiscard]] std::vector<double> linear_speeds(double from, double to, int count);
[[nodiscard]] std::vector<double> logarithmic_speeds(double from, double to, int count);

/// One curve of a study: a sphere on a ground.
struct RestitutionCase {
    std::string name;  ///< of the series in a table
    NormalLaw law;
    double mass = 0;    ///< m [kg], > 0
    double radius = 0;  ///< r [m], > 0: what the indentation is to stay small beside; infinity where it does not matter
};

struct RestitutionStudy {
    std::string title;
    std::vector<RestitutionCase> cases;
    std::vector<double> speeds;  ///< [m/s], each > 0
    ImpactOptions options;
};

struct RestitutionResult {
    RestitutionStudy study;
    std::vector<std::vector<NormalImpact>> impacts;      ///< [case][speed]
    std::vector<std::optional<double>> slowest_bounces;  ///< [case]; with gravity only, else empty
};

/// Every case at every speed. Throws InvalidInput, Interrupted.
[[nodiscard]] RestitutionResult restitution(const RestitutionStudy& study);

/// speed; for each case restitution, what theory says of it without gravity (viscoelastic_theory.hpp), peak force, peak
/// indentation and durations.
[[nodiscard]] Table table(const RestitutionResult& result);

/// The curves of the paper's figures 2 (three laws), 3 (damping coefficients, logarithmic) and 4 (four pairs of
/// materials). What the paper does not print is a choice, told in docs/restitution.md. Throws InvalidInput for others.
[[nodiscard]] RestitutionStudy paper_figure(int number);

}  // namespace footfall
