// Fits parameters of normal laws to measurements.
#include "footfall/study/fit.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "footfall/math/dual.hpp"
#include "footfall/math/value_of.hpp"
#include "study/drop_impact.hpp"
#include "study/law_alone.hpp"

namespace footfall {
namespace {

using study::Branch;
using study::DropImpact;
using Derivative = study::FitDual;

/// How many derivatives one pass carries.
constexpr std::size_t width = std::tuple_size_v<decltype(Derivative::gradient)>;

/// Where a function that is `true` at `low` and `false` at `high` turns, to rounding.
template <class Predicate>
double turning_point(double low, double high, const Predicate& holds) {
    constexpr int most = 100;  // halvings
    for (int i = 0; i < most; ++i) {
        const double middle = (low + high) / 2;
        if (!(middle > low && middle < high)) break;
        (holds(middle) ? low : high) = middle;
    }
    return low;
}

;

// Laws with parameters over another scalar ---------------------------------------------------------------------------

/// The law with the parameters of these keys replaced.
template <class S>
NormalLawOver<S> substitute(const NormalLaw& law, const std::vector<FitLaw::Free>& free, const S* values) {
    return std::visit(
        [&](const auto& base) -> NormalLawOver<S> {
            auto over = base.template cast<S>();
            const auto parameters = over.parameters();
            for (std::size_t i = 0; i < free.size(); ++i) {
                for (const auto& parameter : parameters) {
                    if (parameter.key == free[i].key) over.*parameter.member = values[i];
                }
            }
            return over;
        },
        law);
}

/// Calls `visit(parameter, law)` for the parameter of that key. Throws InvalidInput where there is none.
template <class Visit>
auto with_parameter(const NormalLaw& law, std::string_view key, const Visit& visit) {
    return std::visit(
        [&]<class Law>(const Law& l) {
            for (const auto& parameter : Law::parameters()) {
                if (parameter.key == key) return visit(parameter, l);
            }
            throw InvalidInput(fmt::format("normal law '{}' has no parameter '{}'", Law::description.name, key));
        },
        law);
}

/// Gives the parameter of that key a value.
void put(NormalLaw& law, std::string_view key, double value) {
    std::visit(
        [&]<class Law>(Law& l) {
            for (const auto& parameter : Law::parameters()) {
                if (parameter.key == key) l.*parameter.member = value;
            }
        },
        law);
}

// Residuals -----------------------------------------------------------------------------------------------------------

/// The arguments of a fit, in this order: the law's free parameters, then those of these that count.
struct Arguments {
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    std::size_t mass = none, speed = none, touchdown = none;  ///< places
    std::size_t count = 0;
};

/// One law and the data.
class LawModel {
public:
    LawModel(const FitStudy& study, const FitLaw& law) : study_(study), law_(law) {
        arguments_.count = law.free.size();
        if (study.data.kind == Measured::restitution) arguments_.mass = arguments_.count++;
        if (follows_one_impact()) {
            arguments_.mass = arguments_.count++;
            arguments_.speed = arguments_.count++;
        }
        // A place for what is given costs derivatives; where time begins takes no part in a product of powers.
        if (study.data.kind == Measured::force_time && study.touchdown.free) arguments_.touchdown = arguments_.count++;
        // Before the deepest point the sphere goes in, after it out.
        const auto& x = study.data.x;
        const auto deepest = std::max_element(x.begin(), x.end());
        branches_.assign(x.size(), Branch::unloading);
        std::fill_n(branches_.begin(), deepest - x.begin(), Branch::loading);
        // It goes in there too, where the deepest point of the parabola is still to come.
        const bool first = deepest == x.begin(), last = deepest + 1 == x.end();
        if (first || last || *(deepest + 1) > *(deepest - 1)) {
            branches_[static_cast<std::size_t>(deepest - x.begin())] = Branch::loading;
        }
    }

    [[nodiscard]] const Arguments& arguments() const { return arguments_; }

    [[nodiscard]] bool follows_one_impact() const {
        return study_.data.kind == Measured::force_time ||
               (study_.data.kind == Measured::force_indentation && study_.data.rate.empty() && !study_.quasistatic);
    }

    /// The law's y for each x at the arguments `a`; NaN where it has none.
    template <class S>
    void evaluate(const S* a, std::span<S> y) const {
        const NormalLawOver<S> law = substitute<S>(law_.law, law_.free, a);
        const bool followed = study_.data.kind == Measured::restitution ? restitutions(law, a, y)
                              : follows_one_impact()                    ? forces_of_impact(law, a, y)
                                                                        : forces_at_rates(law, y);
        if (!followed) std::fill(y.begin(), y.end(), S(std::nan("")));
    }

    void residuals(std::span<const double> x, std::span<double> r) const {
        evaluate<double>(x.data(), r);
        for (std::size_t i = 0; i < r.size(); ++i) r[i] = (r[i] - study_.data.y[i]) / sigma(i);
    }

    void jacobian(std::span<const double> x, std::span<double> r, std::span<double> J) const {
        std::vector<Derivative> a(x.size()), y(r.size());
        for (std::size_t first = 0; first < x.size(); first += width) {
            const std::size_t count = std::min(width, x.size() - first);
            for (std::size_t j = 0; j < x.size(); ++j) a[j] = x[j];
            for (std::size_t k = 0; k < count; ++k) {
                a[first + k] = Derivative::variable(x[first + k], static_cast<int>(k));
            }
            evaluate<Derivative>(a.data(), y);
            for (std::size_t i = 0; i < r.size(); ++i) {
                for (std::size_t k = 0; k < count; ++k) J[i * x.size() + first + k] = y[i].gradient[k] / sigma(i);
            }
        }
        for (std::size_t i = 0; i < r.size(); ++i) r[i] = (y[i].value - study_.data.y[i]) / sigma(i);
    }

    /// The law with the parameters that `x` begins with.
    [[nodiscard]] NormalLaw law_at(std::span<const double> x) const {
        NormalLaw law = law_.law;
        for (std::size_t i = 0; i < law_.free.size(); ++i) put(law, law_.free[i].key, x[i]);
        return law;
    }

private:
    /// Of an impact at each speed. False where one does not end.
    template <class S>
    [[nodiscard]] bool restitutions(const NormalLawOver<S>& law, const S* a, std::span<S> y) const {
        const std::vector<double>& speed = study_.data.x;
        for (std::size_t i = 0; i < y.size(); ++i) {
            const auto out = DropImpact<S>(law, a[arguments_.mass], S(speed[i])).speed_out();
            if (!out) return false;
            y[i] = *out / S(speed[i]);
        }
        return true;
    }

    /// At each depth, with the rate that was measured there. Always true.
    template <class S>
    [[nodiscard]] bool forces_at_rates(const NormalLawOver<S>& law, std::span<S> y) const {
        const FitData& data = study_.data;
        const study::LawAlone<S> begun(law, S(entry_speed()));
        for (std::size_t i = 0; i < y.size(); ++i) {
            y[i] = S(0);
            if (!(data.x[i] > 0)) continue;
            const double rate = data.rate.empty() ? 0 : data.rate[i];
            const S force = begun.force(S(data.x[i]), S(rate)).total();
            if (force > S(0)) y[i] = force;
        }
        return true;
    }

    /// Along one impact, at each time or depth. False where that cannot be followed.
    template <class S>
    [[nodiscard]] bool forces_of_impact(const NormalLawOver<S>& law, const S* a, std::span<S> y) const {
        const FitData& data = study_.data;
        const DropImpact<S> impact(law, a[arguments_.mass], a[arguments_.speed]);
        if (data.kind == Measured::force_indentation) return impact.force_at_depths(data.x, branches_, y);
        const bool fitted = arguments_.touchdown != Arguments::none;
        const S begin = fitted ? a[arguments_.touchdown] : S(study_.touchdown.value.value_or(0));
        std::vector<S> times;
        for (const double t : data.x) times.push_back(S(t) - begin);
        return impact.force_at_times(times, y);
    }

    [[nodiscard]] double sigma(std::size_t i) const { return study_.data.sigma.empty() ? 1 : study_.data.sigma[i]; }

    /// How fast the impact of a force-indentation trace began.
    [[nodiscard]] double entry_speed() const {
        if (study_.speed && study_.speed->value) return *study_.speed->value;
        const auto& rate = study_.data.rate;
        return rate.empty() ? 0 : *std::max_element(rate.begin(), rate.end());
    }

    const FitStudy& study_;
    const FitLaw& law_;
    Arguments arguments_;
    std::vector<Branch> branches_;
};

// Where the search begins ---------------------------------------------------------------------------------------------

/// The scales of the measured impacts: a depth [m], the force there [N], and a speed [m/s]; NaN where unknown.
struct Scales {
    double depth, force, speed;
};

Scales scales_of(const FitStudy& study) {
    const FitData& data = study.data;
    const double largest_x = *std::max_element(data.x.begin(), data.x.end());
    const double largest_y = *std::max_element(data.y.begin(), data.y.end());
    const double mass = study.mass && study.mass->value ? *study.mass->value : std::nan("");
    double speed = study.speed && study.speed->value ? *study.speed->value : std::nan("");
    switch (data.kind) {
        case Measured::force_indentation:
            if (!data.rate.empty()) speed = *std::max_element(data.rate.begin(), data.rate.end());
            return {largest_x, largest_y, speed};
        case Measured::force_time:
            // Hertz's impact: the spring holds all the energy, (2/5) F z = m v^2/2.
            return {1.25 * mass * speed * speed / largest_y, largest_y, speed};
        case Measured::restitution:
            break;
    }
    // Nothing says how stiff the ground is: take 1 % of the length that gravity would give the fastest impact a stop
    // in.
    const double depth = 1e-2 * largest_x * largest_x / 9.81;
    return {depth, 1.25 * mass * largest_x * largest_x / depth, largest_x};
}

/// A start for a parameter that was given none, with those before it already in `law`.
double start_of(const NormalLaw& law, std::string_view key, const FitStudy& study) {
    return with_parameter(law, key, [&]<class P, class Law>(const P& parameter, const Law& base) -> double {
        if (parameter.fallback) return *parameter.fallback;
        if (parameter.at_most_one) return 0.7;
        if (key == "mass" && study.mass && study.mass->value) return *study.mass->value;
        const Scales scales = scales_of(study);
        const bool spring = key == "stiffness";
        // The value with which the spring gives the force at its scale, or the damper a fifth of the spring's.
        const auto small = [&](double log_value) {
            Law trial = base;
            trial.*parameter.member = std::exp(log_value);
            const study::LawAlone<double> begun(trial, scales.speed);
            const auto half = begun.force(scales.depth / 2, scales.speed / 2);
            return spring ? begun.force(scales.depth, 0).total() < scales.force : half.dissipative < 0.2 * half.elastic;
        };
        const double low = std::log(1e-15), high = std::log(1e18);
        const bool scaled = std::isfinite(scales.depth) && scales.depth > 0 && (spring || std::isfinite(scales.speed));
        if (!scaled || !small(low) || small(high)) {
            throw InvalidInput(
                fmt::format("{}: a start cannot be found from these data; give one, as in {}=?1e6", key, key));
        }
        return std::exp(turning_point(low, high, small));
    });
}

FitParameter free_parameter(const std::string& name, std::string unit, const FitValue& value, double start) {
    FitParameter p{.name = name, .unit = std::move(unit), .start = start, .logarithmic = true, .fixed = !value.free};
    if (value.low) p.low = *value.low;
    if (value.high) p.high = *value.high;
    if (value.free && !value.value) p.start = std::clamp(start, p.low, p.high);
    return p;
}

std::vector<FitParameter> parameters_of(const FitStudy& study, const FitLaw& law, const Arguments& arguments) {
    std::vector<FitParameter> parameters;
    NormalLaw base = law.law;
    // What has a usual value is there before the starts of others are found with it.
    for (const FitLaw::Free& f : law.free) {
        with_parameter(base, f.key, [&](const auto& parameter, const auto&) {
            if (parameter.fallback) put(base, f.key, *parameter.fallback);
        });
    }
    for (const FitLaw::Free& f : law.free) {
        const bool by_bounds = !f.value.value && f.value.low && f.value.high && *f.value.low > 0;
        double start = f.value.value ? *f.value.value
                       : by_bounds   ? std::sqrt(*f.value.low * *f.value.high)
                                     : start_of(base, f.key, study);
        FitParameter p = with_parameter(base, f.key, [&](const auto& parameter, const auto&) {
            // A law may take a shorter way where an exponent has its usual value, on which no derivative is seen.
            if (parameter.fallback && start == *parameter.fallback) start = std::nextafter(start, 0.0);
            FitParameter made = free_parameter(f.key, std::string(parameter.unit), f.value, start);
            if (parameter.at_most_one) made.high = std::min(made.high, 1.0);
            return made;
        });
        if (!(p.start > 0)) throw InvalidInput(fmt::format("{}: the start {} must be greater than 0", f.key, p.start));
        put(base, f.key, p.start);
        parameters.push_back(std::move(p));
    }
    const auto add = [&](std::size_t place, const char* name, const char* unit, const std::optional<FitValue>& value) {
        if (place == Arguments::none || !value || !value->value) return;  // check() has seen that they are there
        parameters.push_back(free_parameter(name, unit, *value, *value->value));
    };
    add(arguments.mass, "mass", "kg", study.mass);
    add(arguments.speed, "speed", "m/s", study.speed);
    if (arguments.touchdown != Arguments::none) {
        FitParameter p{.name = "touchdown", .unit = "s", .start = study.touchdown.value.value_or(0)};
        if (study.touchdown.low) p.low = *study.touchdown.low;
        if (study.touchdown.high) p.high = *study.touchdown.high;
        parameters.push_back(p);
    }
    return parameters;
}

void check(const FitStudy& study) {
    const FitData& data = study.data;
    const std::string& who = data.source;
    if (study.laws.empty()) throw InvalidInput(fmt::format("{}: a fit needs at least one law", who));
    if (data.x.empty()) throw InvalidInput(fmt::format("{}: there are no data", who));
    const auto has_length = [&](const std::vector<double>& column) {
        return column.empty() || column.size() == data.x.size();
    };
    if (data.y.size() != data.x.size() || !has_length(data.rate) || !has_length(data.sigma)) {
        throw InvalidInput(fmt::format("{}: the columns differ in length", who));
    }
    const bool restitution = data.kind == Measured::restitution;
    for (std::size_t i = 0; i < data.x.size(); ++i) {
        const double x = data.x[i], y = data.y[i];
        if (!std::isfinite(x) || !std::isfinite(y))
            throw InvalidInput(fmt::format("{}: datum {} is not finite", who, i));
        if (restitution && !(x > 0)) throw InvalidInput(fmt::format("{}: speed {} must be greater than 0", who, x));
        if (restitution && !(y >= 0 && y <= 1)) {
            throw InvalidInput(fmt::format("{}: restitution {} must lie between 0 and 1", who, y));
        }
        if (!data.sigma.empty() && !(data.sigma[i] > 0)) {
            throw InvalidInput(fmt::format("{}: sigma {} must be greater than 0", who, data.sigma[i]));
        }
    }
    const auto positive = [&](const std::optional<FitValue>& value, const char* name) {
        if (value && value->value && !(*value->value > 0 && std::isfinite(*value->value))) {
            throw InvalidInput(fmt::format("{} {} must be greater than 0", name, *value->value));
        }
    };
    positive(study.mass, "mass");
    positive(study.speed, "speed");
    const auto needed = [&](const std::optional<FitValue>& value, const char* name, const char* unit) {
        if (value && value->value) return;
        throw InvalidInput(fmt::format("{}: {} [{}] is needed to follow an impact{}", who, name, unit,
                                       value ? "; where it is fitted it needs a start, as in ?1" : ""));
    };
    if (data.kind != Measured::force_indentation) needed(study.mass, "mass", "kg");
    if (data.kind == Measured::force_time) needed(study.speed, "speed", "m/s");
    if (!std::is_sorted(data.x.begin(), data.x.end()) && data.kind == Measured::force_time) {
        throw InvalidInput(fmt::format("{}: times must be in order", who));
    }
    if (data.kind == Measured::force_indentation && data.rate.empty() && !study.quasistatic &&
        !(study.mass && study.speed)) {
        throw InvalidInput(fmt::format(
            "{}: the rate of indentation is needed: as a column 'rate [m/s]', as the mass and the speed of the impact "
            "from which it follows, or as quasistatic where it is 0",
            who));
    }
}

LawFit fit_law(const FitStudy& study, const FitLaw& law) {
    const LawModel model(study, law);
    const LeastSquaresProblem problem{
        .parameters = parameters_of(study, law, model.arguments()),
        .residual_count = study.data.x.size(),
        .residuals = [&](std::span<const double> x, std::span<double> r) { model.residuals(x, r); },
        .jacobian = [&](std::span<const double> x, std::span<double> r,
                        std::span<double> J) { model.jacobian(x, r, J); }};
    LawFit fitted;
    fitted.result = fit_least_squares(problem, study.options);
    std::vector<double> x;
    for (const FitEstimate& e : fitted.result.estimates) x.push_back(e.value);
    fitted.law = model.law_at(x);
    fitted.model.resize(study.data.x.size());
    model.evaluate<double>(x.data(), fitted.model);
    double squares = 0;
    for (std::size_t i = 0; i < fitted.model.size(); ++i) squares += std::pow(study.data.y[i] - fitted.model[i], 2);
    fitted.rms = std::sqrt(squares / static_cast<double>(fitted.model.size()));
    return fitted;
}

}  // namespace

std::string_view name_of(Measured kind) noexcept {
    switch (kind) {
        case Measured::restitution:
            return "restitution";
        case Measured::force_indentation:
            return "force-indentation";
        case Measured::force_time:
            break;
    }
    return "force-time";
}

std::optional<Measured> measured_by_name(std::string_view name) noexcept {
    for (const Measured kind : {Measured::restitution, Measured::force_indentation, Measured::force_time})
        if (name_of(kind) == name) return kind;
    return std::nullopt;
}

std::size_t FitStudyResult::best() const {
    const auto less = [](const LawFit& a, const LawFit& b) { return a.result.aicc < b.result.aicc; };
    return static_cast<std::size_t>(std::min_element(fits.begin(), fits.end(), less) - fits.begin());
}

FitStudyResult fit(const FitStudy& study) {
    check(study);
    FitStudyResult result{.study = study};
    for (const FitLaw& law : study.laws) result.fits.push_back(fit_law(study, law));
    const double best = result.fits[result.best()].result.aicc;
    double sum = 0;
    for (LawFit& f : result.fits) {
        f.aicc_difference = f.result.aicc == best ? 0 : f.result.aicc - best;
        f.weight = std::exp(-f.aicc_difference / 2);  // Burnham & Anderson 2002, (2.9)
        sum += f.weight;
    }
    for (LawFit& f : result.fits) f.weight /= sum;
    return result;
}

Table table(const FitStudyResult& result) {
    const FitData& data = result.study.data;
    Table t{.title = fmt::format("{}: data, models and residuals", data.source)};
    const bool force = data.kind != Measured::restitution;
    const char* unit = force ? "N" : "1";
    const char* y = force ? "force" : "restitution";
    switch (data.kind) {
        case Measured::restitution:
            t.columns.push_back({"speed", "m/s", "speed of the impact", data.x});
            break;
        case Measured::force_indentation:
            t.columns.push_back({"indentation", "m", "indentation", data.x});
            break;
        case Measured::force_time:
            t.columns.push_back({"time", "s", "time", data.x});
            break;
    }
    if (!data.rate.empty()) t.columns.push_back({"rate", "m/s", "rate of indentation", data.rate});
    t.columns.push_back({y, unit, "measured", data.y});
    if (!data.sigma.empty()) t.columns.push_back({"sigma", unit, "standard deviation of the measured", data.sigma});
    // The same law may be there twice, with other parameters free.
    for (std::size_t i = 0; i < result.fits.size(); ++i) {
        const LawFit& f = result.fits[i];
        std::string series(name_of(f.law));
        const auto same = [&](const LawFit& other) { return other.law.index() == f.law.index(); };
        if (std::count_if(result.fits.begin(), result.fits.end(), same) > 1) series += fmt::format("-{}", i + 1);
        Column residual{"residual", unit, "measured less model", {}, series};
        for (std::size_t k = 0; k < data.y.size(); ++k) residual.values.push_back(data.y[k] - f.model[k]);
        t.columns.push_back({"model", unit, "the fitted law", f.model, series});
        t.columns.push_back(std::move(residual));
    }
    return t;
}

}  // namespace footfall
