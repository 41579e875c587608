// footfall oblique: a sphere that hits the ground at an angle, swept over the angle or the spin.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "checks.hpp"
#include "commands.hpp"
#include "footfall/body/body.hpp"
#include "footfall/io/law_text.hpp"
#include "footfall/io/oblique_data.hpp"
#include "footfall/io/printable.hpp"
#include "footfall/io/staged_files.hpp"
#include "footfall/io/table_output.hpp"
#include "footfall/io/units.hpp"
#include "footfall/study/damping.hpp"
#include "footfall/study/oblique.hpp"
#include "io/nearest.hpp"
#include "places.hpp"
#include "quantity.hpp"
#include "table_options.hpp"
#include "terminal.hpp"

namespace footfall::cli {
namespace {

constexpr double degree = std::numbers::pi / 180;

struct ObliqueArguments {
    std::string radius, mass, density, inertia = "solid";
    std::string speed, normal_speed;
    std::string angles = "0..85:5", spins = "0";
    std::string normal, friction;
    std::string gravity = "0";
    std::optional<double> restitution, poisson_ratio;
    double tolerance = ObliqueSphere{}.tolerance;
    std::optional<std::filesystem::path> csv, history;
    std::filesystem::path data;     ///< --fit
    TableInput input;               ///< how it is read
    std::vector<std::string> vary;  ///< --vary
    bool json = false;
};

/// An angle in degrees, or with its unit [rad].
double angle(std::string_view option, std::string_view text) {
    const double value = quantity(option, text, "rad");
    return parse_quantity(text).dimension == Dimension{} ? value * degree : value;
}

double spin(std::string_view option, std::string_view text) { return quantity(option, text, "rad/s"); }

/// "A,B,C" or "START..END:STEP", each read by `value`.
std::vector<double> read_list(std::string_view option, std::string_view text,
                              double (*value)(std::string_view, std::string_view)) {
    std::vector<double> list;
    const std::size_t dots = text.find("..");
    if (dots == std::string_view::npos) {
        for (;;) {
            const std::size_t comma = text.find(',');
            list.push_back(value(option, text.substr(0, comma)));
            if (comma == std::string_view::npos) return list;
            text.remove_prefix(comma + 1);
        }
    }
    const std::size_t colon = text.find(':', dots);
    if (colon == std::string_view::npos)
        throw InvalidInput(fmt::format("{}: '{}' has no step; write START..END:STEP", option, text));
    const double start = value(option, text.substr(0, dots));
    const double end = value(option, text.substr(dots + 2, colon - dots - 2));
    const double step = value(option, text.substr(colon + 1));
    constexpr double most = 1e6;
    const double steps = std::floor((end - start) / step + 1e-9);  // END counts although 0.1 is not exact
    if (!(steps >= 0 && steps < most))
        throw InvalidInput(
            fmt::format("{}: '{}' must lead from START to END in fewer than {} steps", option, text, most));
    for (int i = 0; i <= static_cast<int>(steps); ++i) list.push_back(start + i * step);
    return list;
}

double speed_of(const ObliqueArguments& arguments) {
    return arguments.speed.empty() ? quantity("--normal-speed", arguments.normal_speed, "m/s")
                                   : quantity("--speed", arguments.speed, "m/s");
}

ObliqueSphere sphere_of(const ObliqueArguments& arguments) {
    if (arguments.mass.empty() && arguments.density.empty()) throw InvalidInput("give --mass or --density");
    if (arguments.speed.empty() && arguments.normal_speed.empty()) throw InvalidInput("give --speed or --normal-speed");
    ObliqueSphere sphere;
    const double r = sphere.radius = quantity("--radius", arguments.radius, "m");
    sphere.mass = arguments.density.empty()
                      ? quantity("--mass", arguments.mass, "kg")
                      : quantity("--density", arguments.density, "kg/m^3") * 4 / 3 * std::numbers::pi * r * r * r;
    if (arguments.inertia == "hollow") {
        sphere.inertia = hollow_sphere_inertia(sphere.mass, r)(0, 0);
    } else if (arguments.inertia != "solid") {
        const std::vector<std::string> words{"solid", "hollow"};
        if (arguments.inertia.find_first_of("0123456789") == std::string::npos)
            throw InvalidInput(fmt::format("--inertia: '{}' is not allowed{} (one of {}, or a number in kg m^2)",
                                           arguments.inertia, io::did_you_mean(arguments.inertia, words),
                                           io::listed(words)));
        sphere.inertia = quantity("--inertia", arguments.inertia, "kg m^2");
    }
    sphere.contact = {parse_normal_law(arguments.normal), parse_friction_law(arguments.friction)};
    if (arguments.restitution) {
        sphere.contact.normal =
            with_restitution(sphere.contact.normal, sphere.mass, speed_of(arguments), *arguments.restitution);
    }
    sphere.gravity = quantity("--gravity", arguments.gravity, "m/s^2");
    sphere.tolerance = arguments.tolerance;
    return sphere;
}

Approach approach_of(const ObliqueArguments& arguments, double theta, double omega) {
    const double speed = speed_of(arguments);
    return arguments.speed.empty() ? approach_at_normal_speed(speed, theta, omega)
                                   : approach_at_speed(speed, theta, omega);
}

std::vector<Approach> approaches_of(const ObliqueArguments& arguments) {
    std::vector<Approach> approaches;
    const std::vector<double> angles = read_list("--angles", arguments.angles, angle);
    const std::vector<double> spins = read_list("--spins", arguments.spins, spin);
    constexpr std::size_t most = 1'000'000;  // each is a run of its own
    if (angles.size() > most / spins.size()) {
        throw InvalidInput(fmt::format("--angles, --spins: {} angles under {} spins are more than {} impacts",
                                       angles.size(), spins.size(), most));
    }
    for (const double omega : spins) {
        for (const double theta : angles) approaches.push_back(approach_of(arguments, theta, omega));
    }
    return approaches;
}

std::string as_json(const ObliqueSphere& sphere, const std::vector<ObliqueImpact>& impacts, const Table& table) {
    using Json = nlohmann::ordered_json;
    Json json = Json::parse(to_json(table));
    json["normal"] = law_text(sphere.contact.normal);
    json["friction"] = law_text(sphere.contact.friction);
    Json& histories = json["history"] = Json::array();
    for (const ObliqueImpact& impact : impacts) {
        Json history = Json::array();
        for (const ObliquePhase& part : impact.history) {
            history.push_back({{"phase", name_of(part.phase)}, {"start", part.start}, {"duration", part.duration}});
        }
        histories.push_back(std::move(history));
    }
    return json_text(json);
}

/// What most people come for; everything is in CSV and JSON.
Table main_columns(const Table& table) {
    Table chosen{table.title, {}};
    for (const std::string_view name :
         {"angle", "spin", "normal_restitution", "tangential_restitution", "contact_restitution", "rebound_angle",
          "contact_rebound_angle", "spin_after", "impulse_ratio", "psi1", "psi2", "psi1_maw", "psi2_maw"}) {
        for (const Column& column : table.columns) {
            if (column.name == name) chosen.columns.push_back(column);
        }
    }
    return chosen;
}

/// The phases of each impact in one line.
std::string history_text(const std::vector<ObliqueImpact>& impacts) {
    double longest = 0;
    for (const ObliqueImpact& impact : impacts)
        for (const ObliquePhase& part : impact.history) longest = std::max(longest, part.duration);
    double scale = 1;
    std::string_view unit = "s";
    for (const auto& [factor, name] : {std::pair{1e3, "ms"}, {1e6, "us"}, {1e9, "ns"}}) {
        if (longest * scale >= 1) break;
        scale = factor;
        unit = name;
    }
    std::string page = fmt::format("\nStick and slip, durations in {}\n\n", unit);
    constexpr std::size_t most = 60;
    for (std::size_t i = 0; i < impacts.size() && i < most; ++i) {
        const Approach& in = impacts[i].in;
        page += fmt::format("  {:>7.4g} deg {:>9.6g} rad/s ",
                            std::atan2(in.tangential_velocity, in.normal_speed) / degree, in.spin);
        for (const ObliquePhase& part : impacts[i].history) {
            page += fmt::format("  {} {:.4g}", name_of(part.phase), part.duration * scale);
        }
        page += '\n';
    }
    if (impacts.size() > most) page += fmt::format("  ... {} more\n", impacts.size() - most);
    return page;
}

/// Before anything runs: no output is an input or another output, and all can be written.
void check_places(const ObliqueArguments& arguments) {
    std::vector<Place> inputs, outputs;
    if (!arguments.data.empty()) inputs.push_back({"--fit", arguments.data});
    if (arguments.csv) outputs.push_back({"--csv", *arguments.csv});
    if (arguments.history) outputs.push_back({"--history", *arguments.history});
    keep_apart(inputs, outputs);
    for (const Place& output : outputs) check_csv_file(output.path);
}

int sweep(const ObliqueArguments& arguments) {
    check_places(arguments);
    const ObliqueSphere sphere = sphere_of(arguments);
    std::vector<ObliqueImpact> impacts;
    for (const Approach& approach : approaches_of(arguments)) impacts.push_back(oblique_impact(sphere, approach));
    const Table table = oblique_table(impacts, friction_coefficient(sphere.contact.friction), arguments.poisson_ratio);
    StagedFiles files;
    if (arguments.csv) files.add_csv(*arguments.csv, table);
    if (arguments.history) files.add_csv(*arguments.history, oblique_history(impacts));
    files.commit();
    if (arguments.json) {
        print(as_json(sphere, impacts, table) + "\n");
    } else {
        print(to_text(main_columns(table)) + history_text(impacts));
    }
    return ExitCode::success;
}

// Fitting -------------------------------------------------------------------------------------------------------------

/// Reads the data; where their signs are the other way round than the model's from the start, a warning says so.
ObliqueData read_data(const ObliqueArguments& arguments, const ObliqueSphere& sphere) {
    ObliqueData data = load_oblique_data(
        arguments.data, sphere, [&](double theta, double omega) { return approach_of(arguments, theta, omega); },
        arguments.input);
    for (const std::string& key : arguments.vary) {
        if (data.needs_coefficient && key.ends_with("coefficient"))
            throw InvalidInput(fmt::format("--vary {}: {} is in units of mu, so mu cannot be fitted to it", key,
                                           arguments.data.string()));
    }
    return data;
}

/// The data against the model: are most of them of the other sign?
bool signs_differ(const std::vector<double>& measured, const std::vector<double>& model) {
    return std::inner_product(measured.begin(), measured.end(), model.begin(), 0.0) < 0;
}

/// Refuses what is no "normal.KEY" or "friction.KEY" of these laws.
void check_vary(const std::vector<std::string>& keys, const ContactParameters& contact) {
    const std::vector<std::string> known = parameter_keys(contact);
    for (const std::string& key : keys) {
        if (std::find(known.begin(), known.end(), key) != known.end()) continue;
        throw InvalidInput(fmt::format("--vary: '{}' is no parameter of these laws{} (there are {})", key,
                                       io::did_you_mean(key, known), io::listed(known)));
    }
}

std::string fit_json(const ObliqueFit& fit, const ObliqueData& data) {
    const ObliqueMeasurement& measured = data.measured;
    using Json = nlohmann::ordered_json;
    Json estimates = Json::array();
    for (const FitEstimate& e : fit.result.estimates) {
        estimates.push_back({{"name", e.name},
                             {"unit", e.unit},
                             {"value", e.value},
                             {"standard_error", e.standard_error ? Json(*e.standard_error) : Json(nullptr)},
                             {"interval", e.interval ? Json{e.interval->low, e.interval->high} : Json(nullptr)}});
    }
    const Json json{{"observable", measured.observable},
                    {"unit", fit.unit},
                    {"estimates", std::move(estimates)},
                    {"correlation", fit.result.correlation},
                    {"rms", fit.result.rms},
                    {"aicc", fit.result.aicc},
                    {"notes", data.remarks.notes},
                    {"warnings", fit.result.warnings},
                    {"normal", law_text(fit.contact.normal)},
                    {"friction", law_text(fit.contact.friction)},
                    {"measured", measured.values},
                    {"model", fit.model}};
    return json_text(json);
}

std::string fit_text(const ObliqueFit& fit, const ObliqueData& data) {
    const ObliqueMeasurement& measured = data.measured;
    std::string page = fmt::format("{} measurements of {}, misfit {:.4g} (root mean square)\n", measured.values.size(),
                                   measured.observable, fit.result.rms);
    for (const std::string& note : data.remarks.notes) page += fmt::format("  {}\n", note);
    page += '\n';
    for (const FitEstimate& e : fit.result.estimates) {
        page += fmt::format("  {:<24} {:.6g}", e.name, e.value);
        if (e.standard_error) page += fmt::format(" +- {:.2g}", *e.standard_error);
        if (e.unit != "1") page += fmt::format(" {}", e.unit);
        if (e.interval) page += fmt::format("   95 % from {:.5g} to {:.5g}", e.interval->low, e.interval->high);
        page += '\n';
    }
    for (const FitCombination& c : fit.result.combinations)
        page += fmt::format("  determined: {} = {:.6g} +- {:.2g}\n", c.text, c.value, c.standard_error);
    for (const std::string& warning : fit.result.warnings) page += fmt::format("\nWarning: {}\n", warning);
    return page + fmt::format("\n  --normal {}\n  --friction {}\n", law_text(fit.contact.normal),
                              law_text(fit.contact.friction));
}

int fit(const ObliqueArguments& arguments) {
    if (arguments.vary.empty())
        throw InvalidInput("--fit needs --vary KEYS, such as friction.coefficient,friction.stiffness");
    work_on(arguments.data);
    check_places(arguments);
    const ObliqueSphere sphere = sphere_of(arguments);
    check_vary(arguments.vary, sphere.contact);
    const ObliqueData data = read_data(arguments, sphere);
    const ObliqueMeasurement& measured = data.measured;
    ObliqueFit result =
        in_context(arguments.data.string(), [&] { return fit_oblique(sphere, measured, arguments.vary); });
    std::vector<std::string>& warnings = result.result.warnings;
    warnings.insert(warnings.begin(), data.remarks.warnings.begin(), data.remarks.warnings.end());
    if (signs_differ(measured.values, result.model)) {
        warnings.push_back(
            fmt::format("{} has the other sign than in the model, where motion is along +x and top spin is positive; a "
                        "minus before "
                        "the column turns it: --column NAME=-COLUMN",
                        measured.observable));
    }
    if (arguments.csv) {
        write_csv(*arguments.csv, Table{"Measured and fitted",
                                        {{"measured", result.unit, measured.observable, measured.values},
                                         {"model", result.unit, measured.observable, result.model}}});
    }
    print(arguments.json ? fit_json(result, data) + "\n" : fit_text(result, data));
    return ExitCode::success;
}

}  // namespace

CLI::App* add_oblique(CLI::App& app, Command& command) {
    auto arguments = std::make_shared<ObliqueArguments>();
    ObliqueArguments& a = *arguments;
    CLI::App* oblique_app =
        app.add_subcommand("oblique", "A sphere that hits at an angle: rebound, spin, stick and slip");
    const auto option = [&](const char* name, std::string& value, const char* help, const char* type) {
        return oblique_app->add_option(name, value, help)->type_name(type);
    };
    option("--radius", a.radius, "Radius of the sphere", "LENGTH")->required();
    CLI::Option* mass = option("--mass", a.mass, "Mass of the sphere", "MASS");
    option("--density", a.density, "In place of the mass: that of a solid sphere", "DENSITY")->excludes(mass);
    option("--inertia", a.inertia, "About the centre: solid, hollow, or a number in kg m^2; by default solid", "KIND");
    CLI::Option* speed = option("--speed", a.speed, "Speed of the centre, the same at every angle", "SPEED");
    option("--normal-speed", a.normal_speed, "In place of the speed: its part towards the ground", "SPEED")
        ->excludes(speed);
    option("--angles", a.angles, "Angles of incidence from the normal, in degrees; by default 0..85:5", "LIST");
    option("--spins", a.spins, "Spins, rad/s, > 0 top spin; by default 0", "LIST");
    option("--normal", a.normal, "Normal law, NAME:key=value,...; see footfall laws", "LAW")->required();
    option("--friction", a.friction, "Friction law, likewise", "LAW")->required();
    oblique_app
        ->add_option("--restitution", a.restitution,
                     "Of a straight impact at the given speed: sets the normal law's damping")
        ->transform(number())
        ->type_name("NUMBER");
    oblique_app
        ->add_option("--poisson", a.poisson_ratio, "Poisson's ratio: adds psi_1 and psi_2 of Maw, Barber & Fawcett")
        ->transform(number())
        ->type_name("NU");
    option("--gravity", a.gravity, "Towards the ground, m/s^2; by default 0", "NUMBER");
    oblique_app->add_option("--tolerance", a.tolerance, "Relative tolerance, by default 1e-10")
        ->transform(tolerance())
        ->type_name("NUMBER");
    oblique_app->add_option("--csv", a.csv, "Write the table")->type_name("FILE");
    oblique_app->add_option("--history", a.history, "Write every phase of every impact")->type_name("FILE");
    CLI::Option* data =
        oblique_app->add_option("--fit", a.data, "Fit to a table: angle, spin or both, and a measured column of --csv")
            ->type_name("FILE");
    add_table_options(*oblique_app, a.input);
    oblique_app->add_option("--vary", a.vary, "What is fitted: friction.coefficient,friction.stiffness")
        ->delimiter(',')
        ->needs(data)
        ->type_name("KEYS");
    oblique_app->add_flag("--json", a.json, "Print JSON instead of the table");
    oblique_app->footer(
        "A LIST is A,B,C or START..END:STEP. Quantities are in SI units or carry their own: 2.5mm.\n"
        "Example:\n"
        "  footfall oblique --radius 2.5mm --density 4000 --speed 3.9 --angles 5..85:5 \\\n"
        "    --normal azad-featherstone:stiffness=2.675e10,damping=700 \\\n"
        "    --friction azad-featherstone:stiffness=4.01e10,damping=700,coefficient=0.092\n");
    oblique_app->final_callback([&command, arguments] {
        command = [arguments] { return arguments->data.empty() ? sweep(*arguments) : fit(*arguments); };
    });
    return oblique_app;
}

}  // namespace footfall::cli
