// The studies, each as a function that returns its table: what footfall/studies.py labels.
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "arrays.hpp"
#include "bind.hpp"
#include "footfall/io/fit_data.hpp"
#include "footfall/io/fit_report.hpp"
#include "footfall/io/rig.hpp"
#include "footfall/material/coefficients.hpp"
#include "footfall/material/presets.hpp"
#include "footfall/study/damping.hpp"
#include "footfall/study/drive.hpp"
#include "footfall/study/fit.hpp"
#include "footfall/study/oblique.hpp"
#include "footfall/study/restitution.hpp"
#include "footfall/study/table.hpp"
#include "progress.hpp"

namespace footfall::python {
namespace {

nb::str text(std::string_view s) { return nb::str(s.data(), s.size()); }

/// (title, [(name, unit, description, series, values), ...])
nb::tuple as_columns(Table&& table) {
    nb::list columns;
    for (Column& column : table.columns) {
        const std::size_t length = column.values.size();
        columns.append(nb::make_tuple(column.name, column.unit, column.description, column.series,
                                      to_numpy(std::move(column.values), {length})));
    }
    return nb::make_tuple(table.title, columns);
}

double or_nan(const std::optional<double>& value) noexcept {
    return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

using NamedLaws = std::vector<std::pair<std::string, NormalLaw>>;

nb::tuple restitution_of(RestitutionStudy study) {
    study.options.go_on = unless_interrupted();
    RestitutionResult result;
    {
        const nb::gil_scoped_release free;
        result = restitution(study);
    }
    std::vector<double> slowest;
    for (const auto& speed : result.slowest_bounces) slowest.push_back(or_nan(speed));
    const std::size_t length = slowest.size();
    return nb::make_tuple(as_columns(table(result)), to_numpy(std::move(slowest), {length}));
}

void bind_restitution(nb::module_& module) {
    module.def(
        "restitution",
        [](const std::string& title, const NamedLaws& laws, double mass, double radius, std::vector<double> speeds,
           double gravity, double tolerance) {
            RestitutionStudy study{
                .title = title, .speeds = std::move(speeds), .options = {.gravity = gravity, .tolerance = tolerance}};
            for (const auto& [name, law] : laws) study.cases.push_back({name, law, mass, radius});
            return restitution_of(std::move(study));
        },
        nb::arg("title"), nb::arg("laws"), nb::arg("mass"), nb::arg("radius"), nb::arg("speeds"), nb::arg("gravity"),
        nb::arg("tolerance"));
    module.def(
        "restitution_figure",
        [](int number, double tolerance) {
            RestitutionStudy study = paper_figure(number);
            study.options.tolerance = tolerance;
            return restitution_of(std::move(study));
        },
        nb::arg("number"), nb::arg("tolerance"));
}

void bind_oblique(nb::module_& module) {
    module.def(
        "oblique",
        [](double mass, double radius, std::optional<double> inertia, const NormalLaw& normal,
           const FrictionLaw& friction, double gravity, double tolerance, double speed, bool is_normal_speed,
           const std::vector<double>& angles, const std::vector<double>& spins, std::optional<double> poisson_ratio) {
            const ObliqueSphere sphere{.mass = mass,
                                       .radius = radius,
                                       .inertia = inertia,
                                       .contact = {.normal = normal, .friction = friction},
                                       .gravity = gravity,
                                       .tolerance = tolerance,
                                       .go_on = unless_interrupted()};
            std::vector<ObliqueImpact> impacts;
            {
                const nb::gil_scoped_release free;
                for (std::size_t i = 0; i < angles.size(); ++i) {
                    impacts.push_back(oblique_impact(sphere, is_normal_speed
                                                                 ? approach_at_normal_speed(speed, angles[i], spins[i])
                                                                 : approach_at_speed(speed, angles[i], spins[i])));
                }
            }
            return nb::make_tuple(as_columns(oblique_table(impacts, friction_coefficient(friction), poisson_ratio)),
                                  as_columns(oblique_history(impacts)));
        },
        nb::arg("mass"), nb::arg("radius"), nb::arg("inertia").none(), nb::arg("normal"), nb::arg("friction"),
        nb::arg("gravity"), nb::arg("tolerance"), nb::arg("speed"), nb::arg("is_normal_speed"), nb::arg("angles"),
        nb::arg("spins"), nb::arg("poisson_ratio").none());
}

void bind_drive(nb::module_& module) {
    nb::class_<RigFile>(module, "RigFile")
        .def_static(
            "load", [](const std::filesystem::path& file) { return load_rig(file); }, nb::arg("file"))
        .def_static(
            "parse", [](const std::string& given, const std::string& name) { return parse_rig(given, name); },
            nb::arg("text"), nb::arg("name"))
        .def_prop_ro("normal", [](const RigFile& file) -> const NormalLaw& { return file.laws.normal; })
        .def_prop_ro("friction", [](const RigFile& file) -> const FrictionLaw& { return file.laws.friction; });
    module.def(
        "drive",
        [](const RigFile& file, const std::string& name,
           const std::vector<std::pair<std::string, std::pair<NormalLaw, FrictionLaw>>>& laws,
           std::optional<double> tolerance) {
            Rig rig = file.rig;
            if (tolerance) rig.tolerance = *tolerance;
            rig.go_on = unless_interrupted();
            std::vector<NamedDrive> runs;
            nb::list summaries;
            for (const auto& [series, pair] : laws) {
                {
                    const nb::gil_scoped_release free;
                    try {
                        runs.push_back({series, drive(rig, {.normal = pair.first, .friction = pair.second})});
                    } catch (const InvalidInput& error) {
                        throw InvalidInput(fmt::format("{}: {}: {}", name, series, error.what()));
                    } catch (const TooExpensive& error) {
                        throw TooExpensive(fmt::format("{}: {}: {}", name, series, error.what()));
                    }
                }
                const Drive& run = runs.back().drive;
                nb::dict summary;
                summary["largest_normal_force"] = run.largest_normal_force;
                summary["largest_friction_force"] = run.largest_friction_force;
                summary["max_residual"] = run.max_residual;
                summary["stick_slip"] = nb::none();
                if (run.stick_slip) {
                    nb::dict swing;
                    swing["period"] = run.stick_slip->period;
                    swing["amplitude"] = run.stick_slip->amplitude;
                    swing["greatest"] = run.stick_slip->greatest;
                    swing["least"] = run.stick_slip->least;
                    swing["sticking"] = run.stick_slip->sticking;
                    summary["stick_slip"] = swing;
                }
                summaries.append(summary);
            }
            return nb::make_tuple(as_columns(drive_table(rig, runs)), summaries, rig.remarks.warnings);
        },
        nb::arg("rig"), nb::arg("name"), nb::arg("laws"), nb::arg("tolerance").none());
}

void bind_material(nb::module_& module) {
    module.def("material_presets", [] {
        nb::list all;
        for (const MaterialPreset& preset : material_presets()) {
            nb::dict one;
            one["name"] = text(preset.name);
            one["description"] = text(preset.description);
            one["youngs_modulus"] = preset.material.youngs_modulus;
            one["poisson_ratio"] = preset.material.poisson_ratio;
            one["density"] = preset.density;
            one["youngs_modulus_source"] = text(preset.youngs_modulus_source);
            one["poisson_ratio_source"] = text(preset.poisson_ratio_source);
            one["density_source"] = text(preset.density_source);
            all.append(one);
        }
        return all;
    });
    module.def(
        "material_preset",
        [](const std::string& name) {
            const MaterialPreset& preset = material_preset(name);
            return nb::make_tuple(preset.material.youngs_modulus, preset.material.poisson_ratio, preset.density);
        },
        nb::arg("name"));
    module.def(
        "effective_modulus",
        [](std::pair<double, double> sphere, std::pair<double, double> ground) {
            return effective_modulus({sphere.first, sphere.second}, {ground.first, ground.second});
        },
        nb::arg("sphere"), nb::arg("ground"));
    module.def("damping_time", &damping_time, nb::arg("alpha"), nb::arg("effective_modulus"), nb::arg("radius"));
    module.def("normal_stiffness", &normal_stiffness, nb::arg("effective_modulus"), nb::arg("radius"));
    module.def(
        "contact_coefficients",
        [](std::pair<double, double> sphere, std::pair<double, double> ground, double radius, double time,
           bool mindlin) {
            const ContactCoefficients c =
                contact_coefficients({sphere.first, sphere.second}, {ground.first, ground.second}, radius, time,
                                     mindlin ? TangentialStiffness::mindlin : TangentialStiffness::paper);
            nb::dict all;
            all["effective_modulus"] = c.effective_modulus;
            all["effective_shear_modulus"] = c.effective_shear_modulus;
            all["damping_time"] = c.damping_time;
            all["alpha"] = c.alpha;
            all["normal_stiffness"] = c.normal_stiffness;
            all["normal_damping"] = c.normal_damping;
            all["tangential_stiffness"] = c.tangential_stiffness;
            all["tangential_damping"] = c.tangential_damping;
            return all;
        },
        nb::arg("sphere"), nb::arg("ground"), nb::arg("radius"), nb::arg("damping_time"), nb::arg("mindlin"));
    module.def(
        "with_restitution",
        [](const NormalLaw& law, double mass, double speed, double restitution) {
            return with_restitution(law, mass, speed, restitution);
        },
        nb::arg("law"), nb::arg("mass"), nb::arg("speed"), nb::arg("restitution"));
}

void bind_fit(nb::module_& module) {
    module.def(
        "fit",
        [](const std::optional<std::filesystem::path>& file, const std::string& csv,
           const std::map<std::string, std::string, std::less<>>& table_columns,
           const std::vector<std::pair<std::string, std::string>>& where, bool skip_bad_rows,
           const std::optional<std::string>& kind, double gravity, const std::vector<std::string>& laws,
           const std::optional<std::string>& mass, const std::optional<std::string>& speed,
           const std::string& touchdown, bool quasistatic, const std::string& loss, int starts, double confidence,
           bool noise_is_known) {
            FitInput input{{table_columns, where, skip_bad_rows}, std::nullopt, gravity};
            if (kind) input.kind = measured_by_name(*kind);
            FitStudy study{.data = file ? load_fit_data(*file, input) : parse_fit_data(csv, "data", input)};
            for (const std::string& law : laws) study.laws.push_back(parse_fit_law(law));
            const auto value = [](const char* name, const std::string& given, const char* unit) {
                try {
                    return parse_fit_value(given, unit);
                } catch (const InvalidInput& error) {
                    throw InvalidInput(fmt::format("{}: {}", name, error.what()));
                }
            };
            if (mass) study.mass = value("mass", *mass, "kg");
            if (speed) study.speed = value("speed", *speed, "m/s");
            study.touchdown = value("touchdown", touchdown, "s");
            study.quasistatic = quasistatic;
            if (noise_is_known && study.data.sigma.empty()) {
                throw InvalidInput("sigma_is_true: there is no column sigma");
            }
            study.options.loss = loss == "huber" ? Loss::huber : loss == "cauchy" ? Loss::cauchy : Loss::none;
            study.options.starts = starts;
            study.options.confidence = confidence;
            study.options.noise_is_known = noise_is_known;
            study.options.go_on = unless_interrupted();
            FitStudyResult result;
            {
                const nb::gil_scoped_release free;
                result = fit(study);
            }
            nb::list fits;
            for (const LawFit& one : result.fits) {
                nb::list estimates;
                for (const FitEstimate& e : one.result.estimates) {
                    const bool known = e.interval.has_value();
                    estimates.append(nb::make_tuple(e.name, e.unit, e.value, or_nan(e.standard_error),
                                                    known ? e.interval->low : or_nan({}),
                                                    known ? e.interval->high : or_nan({}), e.fixed, e.at_bound));
                }
                nb::list combinations;
                for (const FitCombination& c : one.result.combinations) {
                    combinations.append(
                        nb::make_tuple(c.text, c.value, c.standard_error, c.interval.low, c.interval.high));
                }
                nb::dict entry;
                entry["law"] = one.law;
                entry["estimates"] = estimates;
                entry["correlation"] = one.result.correlation;
                entry["combinations"] = combinations;
                entry["warnings"] = one.result.warnings;
                entry["rms"] = one.rms;
                entry["aicc"] = one.result.aicc;
                entry["aicc_difference"] = one.aicc_difference;
                entry["weight"] = one.weight;
                entry["converged"] = one.result.converged;
                fits.append(entry);
            }
            const TableRemarks& remarks = result.study.data.remarks;
            return nb::make_tuple(as_columns(table(result)), fits, result.best(), report(result), remarks.notes,
                                  remarks.warnings);
        },
        nb::arg("file").none(), nb::arg("csv"), nb::arg("columns"), nb::arg("where"), nb::arg("skip_bad_rows"),
        nb::arg("kind").none(), nb::arg("gravity"), nb::arg("laws"), nb::arg("mass").none(), nb::arg("speed").none(),
        nb::arg("touchdown"), nb::arg("quasistatic"), nb::arg("loss"), nb::arg("starts"), nb::arg("confidence"),
        nb::arg("noise_is_known"));
}

}  // namespace

void bind_studies(nb::module_& module) {
    nb::module_ studies = module.def_submodule("studies", "The studies as tables, for footfall.studies.");
    bind_restitution(studies);
    bind_oblique(studies);
    bind_drive(studies);
    bind_material(studies);
    bind_fit(studies);
}

}  // namespace footfall::python
