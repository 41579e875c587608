// Fits parameters of normal laws to measurements of one sphere on one ground: restitution against speed, force against
// indentation, or force against time.
//
// Derivatives are exact: residuals are computed in dual numbers, through the law and, where an impact has to be
// followed, through its integration. A parameter that is fitted is searched in its logarithm.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "footfall/law/registry.hpp"
#include "footfall/math/error.hpp"
#include "footfall/study/least_squares.hpp"
#include "footfall/study/table.hpp"

namespace footfall {

enum class Measured {
    restitution,        ///< e against the speed of the impact, without gravity
    force_indentation,  ///< F_n against z, or against z and zdot
    force_time,         ///< F_n against t
};
[[nodiscard]] std::string_view name_of(Measured kind) noexcept;
/// The kind that has this name; nothing where none has.
[[nodiscard]] std::optional<Measured> measured_by_name(std::string_view name) noexcept;

/// Measurements. All columns have the same length; those that are optional may be empty.
struct FitData {
    Measured kind = Measured::restitution;
    std::string source;         ///< a file's name, for titles
    std::vector<double> x;      ///< speed [m/s] > 0, indentation [m], or time [s]
    std::vector<double> y;      ///< restitution in [0, 1], or force [N]
    std::vector<double> rate;   ///< zdot [m/s]; force_indentation only, optional
    std::vector<double> sigma;  ///< standard deviation of y, > 0; empty: the same, unknown one for all
    TableRemarks remarks;       ///< of the file that it was read from
};

/// A number that is given, or to be fitted.
struct FitValue {
    std::optional<double> value;      ///< or where the search begins; empty: found from the data
    bool free = false;                ///< fitted
    std::optional<double> low, high;  ///< bounds of a free one
};

/// A law of which some parameters are fitted.
struct FitLaw {
    struct Free {
        std::string key;  ///< of the parameter, "stiffness"
        FitValue value;
    };
    NormalLaw law;  ///< the value of a free parameter is not looked at
    std::vector<Free> free;
};

struct FitStudy {
    FitData data;
    std::vector<FitLaw> laws;
    /// Mass [kg] and speed into the ground [m/s], where an impact has to be followed: force against time, and force
    /// against indentation without a rate, need both; restitution needs the mass.
    std::optional<FitValue> mass, speed;
    FitValue touchdown{.value = 0.0};  ///< when the impact begins, in the data's time [s]
    /// Force against indentation was measured so slowly that the rate is 0.
    bool quasistatic = false;
    FitOptions options;
};

/// What one law makes of the data.
struct LawFit {
    NormalLaw law;               ///< with the estimates
    FitResult result;            ///< the law's free parameters, then mass, speed and touchdown where they count
    std::vector<double> model;   ///< the law's y for each x
    double rms = 0;              ///< of y - model, in the unit of y
    double aicc_difference = 0;  ///< to the best law; below 2 there is little to choose (Burnham & Anderson 2002)
    double weight = 0;           ///< Akaike's: how likely this one is the best of those compared
};

struct FitStudyResult {
    FitStudy study;
    std::vector<LawFit> fits;  ///< in the order of the laws asked for
    /// Index of the law with the smallest AICc.
    [[nodiscard]] std::size_t best() const;
};

/// Fits each law to the data. Throws InvalidInput where something needed is missing or out of its range; Interrupted.
[[nodiscard]] FitStudyResult fit(const FitStudy& study);

/// x, y, and for each law its model and residual.
[[nodiscard]] Table table(const FitStudyResult& result);

}  // namespace footfall
