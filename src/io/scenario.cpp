// From a scenario file to a Simulation: the checks that need more than one key, and the defaults that depend on others.
#include "footfall/io/scenario.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <type_traits>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "footfall/material/material.hpp"
#include "footfall/simulate/run.hpp"
#include "io/document.hpp"
#include "io/read.hpp"
#include "io/scenario_keys.hpp"

namespace footfall {
namespace {

using io::Document;
using io::Entry;
using io::Problems;
using io::Record;

// What the numbers of a file may be off by, relative to their size: decimals are seldom exact.
constexpr double symmetry_slack = 1e-9;
constexpr double moments_slack = 1e-12;
constexpr double quaternion_slack = 1e-6;

/// What [contact.material] says.
class Materials {
public:
    explicit Materials(const Record& record)
        : modulus_(effective_modulus(side(record.table("sphere")), side(record.table("ground")))) {
        if (record.has("damping_time")) time_ = record.number("damping_time");
        if (record.has("damping_coefficient")) alpha_ = record.number("damping_coefficient");
    }

    void give(AzadFeatherstoneNormal<>& law, double radius) const {
        law.stiffness = normal_stiffness(modulus_, radius);   // (10)
        law.damping = normal_damping(alpha(radius), radius);  // (12)
    }
    /// Of the paper's friction law and its passive twin.
    void give(SpringDamperClutch<double, 1>& law, double radius) const {
        law.stiffness = tangential_stiffness(modulus_, radius);   // (23)
        law.damping = tangential_damping(alpha(radius), radius);  // (24)
    }

private:
    static Material side(const Record& record) {
        return {record.number("youngs_modulus"), record.number("poisson_ratio")};
    }
    [[nodiscard]] double alpha(double radius) const {
        return time_ ? damping_coefficient(*time_, modulus_, radius) : alpha_;
    }

    double modulus_;
    double alpha_ = 0;
    std::optional<double> time_;
};

/// The law that `common` chooses, with its parameters, those in `own` (if any) and those that materials give.
template <class Variant>
Variant make_law(const Record& common, const Record* own, const std::optional<Materials>& materials, double radius) {
    Variant made{};
    for_each_law<Variant>([&](auto law) {
        using Law = decltype(law);
        if (law.description.name != common.text("law")) return;
        for (const auto& parameter : Law::parameters()) {
            if (materials && io::from_material<Law>(parameter)) continue;
            const Record& source = own && own->has(parameter.key) ? *own : common;
            law.*(parameter.member) = source.number(parameter.key);
        }
        if constexpr (io::FromMaterial<Law>::known) {
            if (materials) materials->give(law, radius);
        }
        made = law;
    });
    return made;
}

class Builder {
public:
    Builder(const Record& root, Problems& problems) : root_(root), problems_(problems) {}

    Simulation build() {
        simulation_.gravity = root_.table("gravity").vector("acceleration");
        build_options();
        build_ground();
        build_body();
        build_initial();
        build_contacts();
        refuse_penetration();
        return simulation_;
    }

private:
    void build_options() {
        RunOptions& options = simulation_.options;
        const Record& time = root_.table("time");
        options.end_time = time.number("end");
        options.sample_period = time.has("sample") ? time.number("sample") : options.end_time / 1000;
        const Record& solver = root_.table("solver");
        options.tolerance = solver.number("tolerance");
        options.max_evaluations = solver.number("max_evaluations");
        options.max_memory = solver.number("max_memory");
        options.allow_initial_penetration = root_.table("contact").flag("allow_initial_penetration");
    }

    void build_ground() {
        const Record& ground = root_.table("ground");
        simulation_.ground.height = ground.number("height");
        if (ground.has("slope")) {
            const double slope = ground.number("slope");
            simulation_.ground.normal = {std::sin(slope), 0, std::cos(slope)};
        } else {
            simulation_.ground.normal = ground.vector("normal").stableNormalized();
        }
    }

    void build_body() {
        const Record& record = root_.table("body");
        Body& body = simulation_.body;
        body.mass = record.number("mass");
        for (const Record& sphere : record["spheres"].records) {
            body.spheres.push_back({sphere.vector("center"), sphere.number("radius")});
        }
        build_inertia(record["inertia"]);
    }

    void build_inertia(const Entry& entry) {
        Body& body = simulation_.body;
        if (!entry.text.empty()) {
            if (body.spheres.size() != 1 || !body.spheres[0].center.isZero(0)) {
                problems_.add(entry.at,
                              fmt::format("body.inertia: '{}' is for a body of one sphere at its centre; give "
                                          "three moments or a 3x3 tensor in kg m^2",
                                          entry.text));
                return;
            }
            const double radius = body.spheres[0].radius;
            body.inertia = entry.text == "solid-sphere" ? solid_sphere_inertia(body.mass, radius)
                                                        : hollow_sphere_inertia(body.mass, radius);
        } else if (entry.numbers.size() == 3) {
            body.inertia = Eigen::Vector3d::Map(entry.numbers.data()).asDiagonal();
        } else {
            body.inertia = Eigen::Matrix3d::Map(entry.numbers.data());  // rows or columns: it is symmetric
        }
        check_inertia(entry);
    }

    /// A rigid body's inertia is symmetric, and the sum of two principal moments exceeds the third by twice a second
    /// moment of its mass, which cannot be negative.
    void check_inertia(const Entry& entry) {
        Eigen::Matrix3d& inertia = simulation_.body.inertia;
        const double size = inertia.cwiseAbs().maxCoeff();
        if ((inertia - inertia.transpose()).cwiseAbs().maxCoeff() > symmetry_slack * size) {
            problems_.add(entry.at, "body.inertia: the tensor is not symmetric");
            return;
        }
        const Eigen::Matrix3d symmetric = (inertia + inertia.transpose()) / 2;
        inertia = symmetric;
        if (!(size > 0)) {
            problems_.add(entry.at, "body.inertia: the tensor is zero: every principal moment must be > 0");
            return;
        }
        const Eigen::Vector3d moments =
            Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
        const std::string said = fmt::format("the principal moments are {:.6g}, {:.6g} and {:.6g} kg m^2", moments[0],
                                             moments[1], moments[2]);
        if (!(moments[0] > 0)) {
            problems_.add(entry.at, fmt::format("body.inertia: {}: all must be > 0", said));
        } else if (moments[2] > moments[0] + moments[1] + moments_slack * size) {
            problems_.add(entry.at,
                          fmt::format("body.inertia: {}: no body has one above the sum of the other two", said));
        }
    }

    void build_initial() {
        const Record& record = root_.table("body").table("initial");
        BodyState& state = simulation_.initial;
        state.position = record.vector("position");
        state.velocity = record.vector("velocity");
        state.angular_velocity = record.vector("angular_velocity");
        if (record.has("rotation")) {
            const Record& rotation = record.table("rotation");
            state.orientation = Eigen::AngleAxisd(rotation.number("angle"), rotation.vector("axis").stableNormalized());
        } else {
            const std::vector<double>& q = record["orientation"].numbers;
            state.orientation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
            const double norm = state.orientation.coeffs().stableNorm();
            if (std::abs(norm - 1) > quaternion_slack) {
                problems_.add(record["orientation"].at,
                              fmt::format("body.initial.orientation: a quaternion of length {:.6g} is not allowed: "
                                          "must be 1",
                                          norm));
            }
        }
        state.orientation.normalize();
    }

    void build_contacts() {
        const Record& contact = root_.table("contact");
        // A law without parameters stands in for a table that is left out.
        Record no_friction{contact.at, {}};
        no_friction.entries["law"].text = NoFriction<>::description.name;
        const Record& friction = contact.has("friction") ? contact.table("friction") : no_friction;

        std::optional<Materials> materials;
        try {
            if (contact.has("material")) materials.emplace(contact.table("material"));
            for (const Record& sphere : root_.table("body")["spheres"].records) {
                const double radius = sphere.number("radius");
                const auto own = [&sphere](std::string_view kind) {
                    return sphere.has(kind) ? &sphere.table(kind) : nullptr;
                };
                simulation_.contacts.push_back(
                    {make_law<NormalLaw>(contact.table("normal"), own("normal"), materials, radius),
                     make_law<FrictionLaw>(friction, own("friction"), materials, radius)});
            }
        } catch (const InvalidInput& error) {
            // Each property is in its range by now; together they can still be beyond a double.
            problems_.add(contact["material"].at, fmt::format("contact.material: {}", error.what()));
        }
    }

    void refuse_penetration() {
        if (simulation_.options.allow_initial_penetration) return;
        for (std::size_t i = 0; i < simulation_.body.spheres.size(); ++i) {
            const double depth = initial_depth(simulation_, i);
            if (depth <= initial_depth_rounding(simulation_)) continue;
            problems_.add(root_.table("body").table("initial")["position"].at,
                          fmt::format("body.initial.position: sphere {} starts {:.6g} m in the ground; raise the body, "
                                      "or set allow_initial_penetration = true in [contact]",
                                      i, depth));
        }
    }

    const Record& root_;
    Problems& problems_;
    Simulation simulation_;
};

io::Choices choices_of(const Document& document) {
    io::Choices choices;
    choices.materials = document.has("contact.material");
    choices.normal_law = document.text("contact.normal.law");
    choices.friction_law = document.text("contact.friction.law");
    if (!document.has("contact.friction")) choices.friction_law = NoFriction<>::description.name;
    return choices;
}

}  // namespace

Scenario parse_scenario(std::string text, const std::string& name, const std::vector<Setting>& settings) {
    const Document document(text, name, settings);
    Problems problems(name);
    const Record root = document.read(scenario_table(choices_of(document)), problems);
    problems.throw_if_any();
    if (!settings.empty()) text = document.written(settings);
    Scenario scenario{root.text("title"), Builder(root, problems).build(), std::move(text),
                      !document.has("contact.friction")};
    problems.throw_if_any();
    try {
        check(scenario.simulation);
    } catch (const InvalidInput& error) {
        // What the library refuses beyond the checks above has no one place in the file.
        problems.add(root.at, error.what());
        problems.throw_if_any();
    }
    return scenario;
}

Scenario load_scenario(const std::filesystem::path& file, const std::vector<Setting>& settings) {
    return parse_scenario(io::read_file(file, io::largest_toml), file.string(), settings);
}

}  // namespace footfall
