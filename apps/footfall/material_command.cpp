// footfall material: from what things are made of, or from one measured bounce, to the coefficients of a law.
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "checks.hpp"
#include "commands.hpp"
#include "footfall/io/law_text.hpp"
#include "footfall/io/printable.hpp"
#include "footfall/material/coefficients.hpp"
#include "footfall/material/presets.hpp"
#include "footfall/study/damping.hpp"
#include "io/nearest.hpp"
#include "quantity.hpp"
#include "terminal.hpp"

namespace footfall::cli {
namespace {

using Json = nlohmann::ordered_json;

struct MaterialArguments {
    std::string sphere, ground, radius, mass;
    std::string alpha, damping_time, restitution, speed;
    std::string normal;
    std::string tangential = "paper";
    std::string friction;
    bool list = false;
    bool json = false;
};

/// A side of the contact. Without a density, the mass has to be given where it is needed.
struct Side {
    std::string name;
    Material material;
    std::optional<double> density;
    std::string source;
};

/// "E=210 GPa,nu=0.3,density=7850 kg/m^3"
Side read_own(std::string_view option, const std::string& text) {
    Side side{"own values", {}, {}, "given"};
    bool has_E = false, has_nu = false;
    for (std::string_view rest = text;;) {
        const std::size_t comma = rest.find(',');
        const std::string_view setting = rest.substr(0, comma);
        const std::size_t equals = setting.find('=');
        const std::string_view key = setting.substr(0, equals);
        const std::string_view value = equals == std::string_view::npos ? "" : setting.substr(equals + 1);
        if (key == "E") {
            side.material.youngs_modulus = quantity(option, value, "Pa");
            has_E = true;
        } else if (key == "nu") {
            side.material.poisson_ratio = quantity(option, value, "1");
            has_nu = true;
        } else if (key == "density") {
            side.density = quantity(option, value, "kg/m^3");
        } else {
            throw InvalidInput(
                fmt::format("{}: unknown key '{}' in '{}'; a material is a name of --list, or "
                            "\"E=210 GPa,nu=0.3\" with, where needed, \",density=7850 kg/m^3\"",
                            option, key, text));
        }
        if (comma == std::string_view::npos) break;
        rest.remove_prefix(comma + 1);
    }
    if (!has_E || !has_nu) throw InvalidInput(fmt::format("{}: '{}' needs both E and nu", option, text));
    return side;
}

Side read_side(std::string_view option, const std::string& text) {
    if (text.find('=') != std::string::npos) return read_own(option, text);
    std::vector<std::string> names;
    for (const MaterialPreset& preset : material_presets()) {
        names.emplace_back(preset.name);
        if (preset.name != text) continue;
        return {text, preset.material, preset.density,
                fmt::format("{}: E {}; nu {}; density {}", preset.description, preset.youngs_modulus_source,
                            preset.poisson_ratio_source, preset.density_source)};
    }
    throw InvalidInput(fmt::format("{}: unknown material '{}'{} (materials: {}; or give \"E=210 GPa,nu=0.3\")", option,
                                   text, io::did_you_mean(text, names), io::listed(names)));
}

std::string listed(bool json) {
    if (json) {
        Json all = Json::array();
        for (const MaterialPreset& p : material_presets()) {
            all.push_back({{"name", p.name},
                           {"description", p.description},
                           {"youngs_modulus", p.material.youngs_modulus},
                           {"youngs_modulus_source", p.youngs_modulus_source},
                           {"poisson_ratio", p.material.poisson_ratio},
                           {"poisson_ratio_source", p.poisson_ratio_source},
                           {"density", p.density},
                           {"density_source", p.density_source}});
        }
        return json_text(Json{{"materials", all}}) + "\n";
    }
    std::string page = "Materials: Young's modulus, Poisson's ratio, density, and where they come from\n";
    for (const MaterialPreset& p : material_presets()) {
        page += fmt::format("\n  {} ({})\n", p.name, p.description);
        page += fmt::format("    E    {:>8.6g} GPa     {}\n", p.material.youngs_modulus / 1e9, p.youngs_modulus_source);
        page += fmt::format("    nu   {:>8.6g}         {}\n", p.material.poisson_ratio, p.poisson_ratio_source);
        page += fmt::format("    rho  {:>8.6g} kg/m^3  {}\n", p.density, p.density_source);
    }
    return page;
}

double required(std::string_view option, const std::string& text, std::string_view unit, std::string_view why) {
    if (text.empty()) throw InvalidInput(fmt::format("{} is missing: {}", option, why));
    return quantity(option, text, unit);
}

/// Under a law with its stiffness: the damping of one measured bounce.
int from_law(const MaterialArguments& arguments) {
    const double mass = required("--mass", arguments.mass, "kg", "it comes with --normal");
    const double e = required("--restitution", arguments.restitution, "1", "--normal finds the damping from it");
    const double speed = required("--speed", arguments.speed, "m/s", "the restitution was measured at one");
    const NormalLaw law = with_restitution(parse_normal_law(arguments.normal), mass, speed, e);
    if (arguments.json) {
        print(json_text(Json{{"law", law_text(law)}, {"mass", mass}, {"speed", speed}, {"restitution", e}}) + "\n");
        return ExitCode::success;
    }
    std::string page = fmt::format("# restitution {} at {} m/s for {} kg\n# {}\n\n[contact.normal]\nlaw = \"{}\"\n", e,
                                   speed, mass, law_text(law), name_of(law));
    std::visit(
        [&]<class Law>(const Law& l) {
            for (const auto& p : Law::parameters()) page += fmt::format("{} = {}\n", p.key, l.*p.member);
        },
        law);
    print(page);
    return ExitCode::success;
}

int from_materials(const MaterialArguments& arguments) {
    const Side sphere = read_side("--sphere", arguments.sphere), ground = read_side("--ground", arguments.ground);
    const double radius = required("--radius", arguments.radius, "m", "the coefficients depend on it");
    const double modulus = effective_modulus(sphere.material, ground.material);
    const int given = static_cast<int>(!arguments.alpha.empty()) + static_cast<int>(!arguments.damping_time.empty()) +
                      static_cast<int>(!arguments.restitution.empty());
    if (given != 1) {
        throw InvalidInput(fmt::format("{}: give one of --alpha, --damping-time, or --restitution with --speed",
                                       given == 0 ? "no damping is given" : "the damping is given more than once"));
    }
    double time = 0;
    std::string told;
    if (!arguments.alpha.empty()) {
        time = damping_time(quantity("--alpha", arguments.alpha, "N s/m^2.5"), modulus, radius);
        told = "alpha as given";
    } else if (!arguments.damping_time.empty()) {
        time = quantity("--damping-time", arguments.damping_time, "s");
        told = "tau as given";
    } else {
        const double e = quantity("--restitution", arguments.restitution, "1");
        const double speed = required("--speed", arguments.speed, "m/s", "the restitution was measured at one");
        if (arguments.mass.empty() && !sphere.density) {
            throw InvalidInput("--mass is missing: the sphere's material has no density to compute it from");
        }
        const double mass = arguments.mass.empty()
                                ? 4.0 / 3.0 * std::numbers::pi * radius * radius * radius * *sphere.density
                                : quantity("--mass", arguments.mass, "kg");
        const AzadFeatherstoneNormal<> elastic{normal_stiffness(modulus, radius), 0};
        const NormalLaw law = with_restitution(elastic, mass, speed, e);
        time = std::get<AzadFeatherstoneNormal<>>(law).damping / (1.5 * elastic.stiffness);
        told = fmt::format("from restitution {} at {} m/s for {:.6g} kg, without gravity", e, speed, mass);
    }
    const auto choice = arguments.tangential == "mindlin" ? TangentialStiffness::mindlin : TangentialStiffness::paper;
    const ContactCoefficients c = contact_coefficients(sphere.material, ground.material, radius, time, choice);

    if (arguments.json) {
        const auto side = [](const Side& s) {
            return Json{{"name", s.name},
                        {"youngs_modulus", s.material.youngs_modulus},
                        {"poisson_ratio", s.material.poisson_ratio},
                        {"source", s.source}};
        };
        const Json json{{"sphere", side(sphere)},
                        {"ground", side(ground)},
                        {"radius", radius},
                        {"tangential", arguments.tangential},
                        {"effective_modulus", c.effective_modulus},
                        {"effective_shear_modulus", c.effective_shear_modulus},
                        {"damping_time", c.damping_time},
                        {"alpha", c.alpha},
                        {"normal", {{"stiffness", c.normal_stiffness}, {"damping", c.normal_damping}}},
                        {"friction", {{"stiffness", c.tangential_stiffness}, {"damping", c.tangential_damping}}}};
        print(json_text(json) + "\n");
        return ExitCode::success;
    }
    std::string page = fmt::format("# {} sphere of radius {} m on {}\n", sphere.name, radius, ground.name);
    for (const Side* side : {&sphere, &ground}) page += fmt::format("# {}: {}\n", side->name, side->source);
    page += fmt::format("# E* = {:.6g} Pa (9), damping {}: tau = {:.6g} s, alpha = {:.6g} N s/m^2.5\n",
                        c.effective_modulus, told, c.damping_time, c.alpha);
    page += choice == TangentialStiffness::paper
                ? "# K_t of the paper, 1.5 K_n (23), D_t = D_n (24); --tangential mindlin for that of the Poisson's "
                  "ratios\n"
                : fmt::format(
                      "# K_t = 8 G* sqrt(r), G* = {:.6g} Pa (Mindlin & Deresiewicz 1953), {:.4f} of the paper's; "
                      "D_t = tau K_t\n",
                      c.effective_shear_modulus, 4 * c.effective_shear_modulus / c.effective_modulus);
    page += fmt::format(
        "\n[contact.normal]\nlaw = \"azad-featherstone\"\nstiffness = {}  # K_n, N/m^1.5\n"
        "damping = {}  # D_n, N s/m^1.5\n",
        c.normal_stiffness, c.normal_damping);
    page += fmt::format(
        "\n[contact.friction]\nlaw = \"azad-featherstone\"\nstiffness = {}  # K_t, N/m^1.5\n"
        "damping = {}  # D_t, N s/m^1.5\n",
        c.tangential_stiffness, c.tangential_damping);
    page += arguments.friction.empty()
                ? "# coefficient = MU  # mu: no property of the two materials alone; measure it, or give --friction\n"
                : fmt::format("coefficient = {}  # mu\n", quantity("--friction", arguments.friction, "1"));
    print(page);
    return ExitCode::success;
}

int run_material(const MaterialArguments& arguments) {
    if (arguments.list) {
        print(listed(arguments.json));
        return ExitCode::success;
    }
    if (!arguments.normal.empty()) return from_law(arguments);
    if (arguments.sphere.empty() || arguments.ground.empty()) {
        throw InvalidInput("--sphere and --ground are required, or --normal, or --list");
    }
    return from_materials(arguments);
}

}  // namespace

CLI::App* add_material(CLI::App& app, Command& command) {
    auto arguments = std::make_shared<MaterialArguments>();
    CLI::App* sub = app.add_subcommand("material", "Coefficients from two materials, or from one measured bounce");
    const auto text = [&](const char* name, std::string& target, const char* description, const char* type) {
        return sub->add_option(name, target, description)->type_name(type);
    };
    CLI::Option* sphere =
        text("--sphere", arguments->sphere, "What the sphere is made of: a name, or E=...,nu=...", "MATERIAL");
    CLI::Option* ground = text("--ground", arguments->ground, "What the ground is made of", "MATERIAL");
    CLI::Option* radius = text("--radius", arguments->radius, "Radius of the sphere", "LENGTH");
    text("--mass", arguments->mass, "Its mass; by default that of a solid sphere of its material", "MASS");
    CLI::Option* alpha = text("--alpha", arguments->alpha, "Damping: alpha of (11), N s/m^2.5", "ALPHA");
    CLI::Option* time =
        text("--damping-time", arguments->damping_time, "Damping: tau = D_A / K_A, the A of Brilliantov", "TIME");
    text("--restitution", arguments->restitution, "Damping: a restitution measured at --speed", "E");
    text("--speed", arguments->speed, "The speed of that impact", "SPEED");
    text("--normal", arguments->normal, "In place of materials: a law whose damping is to be found", "LAW")
        ->excludes(sphere, ground, radius, alpha, time);
    sub->add_option("--tangential", arguments->tangential, "K_t: the paper's, or Mindlin's, which depends on nu")
        ->type_name("paper|mindlin")
        ->check(one_of({"paper", "mindlin"}));
    text("--friction", arguments->friction, "mu, written into the friction law", "NUMBER");
    sub->add_flag("--list", arguments->list, "List the materials with their sources");
    sub->add_flag("--json", arguments->json, "Print JSON instead of TOML");
    sub->footer(
        "Example:\n"
        "  footfall material --sphere steel --ground brass --radius \"1.27 cm\" --restitution 0.6 --speed \"1 m/s\"\n"
        "  footfall material --normal hunt-crossley:stiffness=8.5e6,damping=0 --mass \"154 g\" \\\n"
        "    --restitution 0.7 --speed \"2 m/s\"\n");
    sub->final_callback([&command, arguments] { command = [arguments] { return run_material(*arguments); }; });
    return sub;
}

}  // namespace footfall::cli
