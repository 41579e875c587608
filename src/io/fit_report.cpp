// What a fit found, for a person and as JSON.
#include "footfall/io/fit_report.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "footfall/io/law_text.hpp"
#include "footfall/io/printable.hpp"
#include "footfall/io/units.hpp"
#include "footfall/version.hpp"
#include "io/table_remarks.hpp"
#include "io/text.hpp"

namespace footfall {
namespace {

using Json = nlohmann::ordered_json;
using text::Align;

/// The SI unit of a product of powers; empty where a factor's unit depends on other parameters.
std::string unit_of(const FitCombination& combination, const std::vector<FitEstimate>& estimates) {
    Dimension sum;
    for (std::size_t i = 0; i < estimates.size(); ++i) {
        const double e = combination.exponents[i];
        if (e == 0) continue;
        try {
            const Dimension d = parse_unit(estimates[i].unit).dimension;
            sum.mass += e * d.mass, sum.length += e * d.length, sum.time += e * d.time, sum.angle += e * d.angle;
        } catch (const InvalidInput&) {
            return "";
        }
    }
    // Exponents are found to some digits only; a power that is 0 but for those is none.
    for (double* power : {&sum.mass, &sum.length, &sum.time, &sum.angle}) *power = std::round(*power * 1e4) / 1e4;
    if (sum == Dimension{}) return "";
    std::string unit = describe(sum);
    if (constexpr std::string_view unnamed = "a quantity in "; unit.starts_with(unnamed))
        return unit.substr(unnamed.size());
    if (const std::size_t bracket = unit.find('('); bracket != std::string::npos && unit.ends_with(')')) {
        unit = unit.substr(bracket + 1, unit.size() - bracket - 2);  // "a velocity (m/s)"
    }
    return unit;
}

/// A value with as many digits as its error leaves it, at least three.
std::string value_text(double value, const std::optional<double>& error) {
    int digits = 5;
    if (error && *error > 0 && value != 0) {
        digits = std::clamp(2 + static_cast<int>(std::ceil(std::log10(std::abs(value) / *error))), 3, 10);
    }
    return text::number(value, digits);
}

std::string interval_text(const std::optional<double>& error, const std::optional<FitInterval>& interval) {
    if (!interval || !std::isfinite(interval->low)) return "";
    return fmt::format("{} to {}", value_text(interval->low, error), value_text(interval->high, error));
}

std::string unit_text(const std::string& unit) { return unit == "1" ? "" : unit; }

std::string measured_text(const FitData& data) {
    switch (data.kind) {
        case Measured::restitution:
            return "restitution against speed";
        case Measured::force_indentation:
            return "force against indentation";
        case Measured::force_time:
            break;
    }
    return "force against time";
}

std::string law_report(const FitStudyResult& result, const LawFit& fit) {
    const FitResult& r = fit.result;
    const auto formula = std::visit([](const auto& l) { return l.description.formula; }, fit.law);
    std::string page = fmt::format("{}   {}\n", name_of(fit.law), formula);
    text::Table table({Align::left, Align::right, Align::right, Align::left, Align::left});
    table.head(
        {"", "estimate", "std. error", fmt::format("{:g} % interval", 100 * result.study.options.confidence), "unit"});
    for (const FitEstimate& e : r.estimates) {
        std::string error = e.fixed ? "given" : e.at_bound ? "at bound" : "unknown";
        if (e.standard_error) error = text::number(*e.standard_error, 3);
        table.row({e.name, e.fixed ? text::number(e.value) : value_text(e.value, e.standard_error), error,
                   interval_text(e.standard_error, e.interval), unit_text(e.unit)});
    }
    if (!r.combinations.empty()) table.rule();
    for (const FitCombination& c : r.combinations) {
        table.row({c.text, value_text(c.value, c.standard_error), text::number(c.standard_error, 3),
                   interval_text(c.standard_error, c.interval), unit_of(c, r.estimates)});
    }
    page += table.str();
    for (std::size_t i = 0; i < r.estimates.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (std::isnan(r.correlation[i][j])) continue;
            page += fmt::format("  correlation of {} and {}: {:.3f}\n", r.estimates[j].name, r.estimates[i].name,
                                r.correlation[i][j]);
        }
    }
    const std::string unit = result.study.data.kind == Measured::restitution ? "" : " N";
    page += fmt::format("  rms of the residuals {}{}; AICc {:.2f}; {} data, {} degrees of freedom\n",
                        text::number(fit.rms, 4), unit, r.aicc, r.residuals.size(), r.degrees_of_freedom);
    if (result.study.options.starts > 1) {
        page += fmt::format("  {} of {} starts came to this minimum\n", r.starts_agreeing, result.study.options.starts);
    }
    for (const std::string& warning : r.warnings) page += text::hanging("Warning: " + warning);
    page += fmt::format("  --normal \"{}\"\n", law_text(fit.law));
    return page;
}

// JSON ----------------------------------------------------------------------------------------------------------------

/// A number; null where there is none, or where JSON has no word for it.
Json finite(std::optional<double> value) { return value && std::isfinite(*value) ? Json(*value) : Json(nullptr); }

Json estimate_of(const FitEstimate& e) {
    const auto bound = [&e](double FitInterval::*end) {
        return e.interval ? finite((*e.interval).*end) : Json(nullptr);
    };
    return {{"name", e.name},
            {"unit", e.unit},
            {"value", finite(e.value)},
            {"fixed", e.fixed},
            {"at_bound", e.at_bound},
            {"standard_error", finite(e.standard_error)},
            {"low", bound(&FitInterval::low)},
            {"high", bound(&FitInterval::high)}};
}

Json combination_of(const FitCombination& c, const std::vector<FitEstimate>& estimates) {
    Json exponents = Json::object();
    for (std::size_t i = 0; i < c.exponents.size(); ++i) {
        if (c.exponents[i] != 0) exponents[estimates[i].name] = c.exponents[i];
    }
    return {{"text", c.text},
            {"exponents", exponents},
            {"unit", unit_of(c, estimates)},
            {"value", finite(c.value)},
            {"standard_error", finite(c.standard_error)},
            {"low", finite(c.interval.low)},
            {"high", finite(c.interval.high)}};
}

/// `each(item)` for every item of a list.
template <class List, class Each>
Json array_of(const List& list, const Each& each) {
    Json array = Json::array();
    for (const auto& item : list) array.push_back(each(item));
    return array;
}

Json law_fit_of(const LawFit& fit, const FitData& data) {
    const FitResult& r = fit.result;
    Json residuals = Json::array();
    for (std::size_t i = 0; i < data.y.size(); ++i) residuals.push_back(finite(data.y[i] - fit.model[i]));
    return {{"law", name_of(fit.law)},
            {"text", law_text(fit.law)},
            {"estimates", array_of(r.estimates, estimate_of)},
            {"combinations",
             array_of(r.combinations, [&r](const FitCombination& c) { return combination_of(c, r.estimates); })},
            {"correlation", array_of(r.correlation, [](const auto& line) { return array_of(line, finite); })},
            {"rms", finite(fit.rms)},
            {"noise", finite(r.noise)},
            {"degrees_of_freedom", r.degrees_of_freedom},
            {"aicc", finite(r.aicc)},
            {"aicc_difference", finite(fit.aicc_difference)},
            {"weight", finite(fit.weight)},
            {"condition", finite(r.condition)},
            {"warnings", r.warnings},
            {"converged", r.converged},
            {"iterations", r.iterations},
            {"evaluations", r.evaluations},
            {"starts_tried", r.starts_tried},
            {"starts_agreeing", r.starts_agreeing},
            {"residuals", residuals}};
}

}  // namespace

std::string report(const FitStudyResult& result) {
    const FitData& data = result.study.data;
    std::string page = fmt::format("{}: {}, {} data\n", printable(data.source), measured_text(data), data.x.size());
    page += io::remarks_text(data.remarks);
    for (const LawFit& fit : result.fits) page += "\n" + law_report(result, fit);
    if (result.fits.size() > 1) {
        page += "\nThe laws side by side\n";
        text::Table table({Align::left, Align::right, Align::right, Align::right, Align::right});
        table.head({"", "rms", "AICc", "difference", "weight"});
        for (const LawFit& fit : result.fits) {
            table.row({std::string(name_of(fit.law)), text::number(fit.rms, 4), fmt::format("{:.2f}", fit.result.aicc),
                       fmt::format("{:.2f}", fit.aicc_difference), fmt::format("{:.3f}", fit.weight)});
        }
        page += table.str();
    }
    return page;
}

std::string to_json(const FitStudyResult& result) {
    const FitData& data = result.study.data;
    Json laws = Json::array();
    for (const LawFit& fit : result.fits) laws.push_back(law_fit_of(fit, data));
    const Json json{{"data", data.source},
                    {"kind", name_of(data.kind)},
                    {"count", data.x.size()},
                    {"notes", data.remarks.notes},
                    {"warnings", io::warnings_json(data.remarks)},
                    {"confidence", result.study.options.confidence},
                    {"best", name_of(result.fits[result.best()].law)},
                    {"laws", laws},
                    {"version", version}};
    return json_text(json);
}

}  // namespace footfall
