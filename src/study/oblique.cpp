#include "footfall/study/oblique.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "footfall/simulate/run.hpp"

namespace footfall {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double degree = std::numbers::pi / 180;

void require_positive(double value, const char* what, const char* unit) {
    if (!(value > 0) || !std::isfinite(value))
        throw InvalidInput(fmt::format("{} is {} {}; it must be > 0 and finite", what, value, unit));
}

void check_angle(double angle) {
    if (!(angle >= 0 && angle < std::numbers::pi / 2))
        throw InvalidInput(
            fmt::format("angle of incidence is {} degrees; it must be from 0 to below 90, measured from the normal",
                        angle / degree));
}

void check(const ObliqueSphere& sphere, const Approach& approach) {
    require_positive(sphere.mass, "mass", "kg");
    require_positive(sphere.radius, "radius", "m");
    if (sphere.inertia) require_positive(*sphere.inertia, "inertia", "kg m^2");
    require_positive(approach.normal_speed, "normal speed", "m/s");
    if (!std::isfinite(approach.tangential_velocity)) throw InvalidInput("tangential velocity is not finite");
    if (!std::isfinite(approach.spin)) throw InvalidInput("spin is not finite");
    if (!(sphere.gravity >= 0) || !std::isfinite(sphere.gravity))
        throw InvalidInput(fmt::format("gravity is {} m/s^2; it must be >= 0 and finite", sphere.gravity));
}

Simulation simulation_of(const ObliqueSphere& sphere, const Approach& approach) {
    Simulation s;
    s.body.mass = sphere.mass;
    s.body.inertia = sphere.inertia ? Eigen::Matrix3d(*sphere.inertia * Eigen::Matrix3d::Identity())
                                    : solid_sphere_inertia(sphere.mass, sphere.radius);
    s.body.spheres = {{.radius = sphere.radius}};
    s.gravity = {0, 0, -sphere.gravity};
    s.initial.position = {0, 0, sphere.radius};
    s.initial.velocity = {approach.tangential_velocity, 0, -approach.normal_speed};
    s.initial.angular_velocity = {0, approach.spin, 0};
    s.contacts = {sphere.contact};
    s.options.tolerance = sphere.tolerance;
    s.options.progress = progress_of(sphere.go_on);
    return s;
}

const Event* end_of_impact(const Run& run) {
    const auto found =
        std::ranges::find_if(run.events, [](const Event& event) { return event.kind == EventKind::recovered; });
    return found == run.events.end() ? nullptr : &*found;
}

/// The run up to the end of its first impact, and some way on. How long that takes is not known beforehand: a flight
/// over a radius is longer than most impacts and costs nothing, and what is not over by then gets twice the time.
Run run_impact(Simulation& simulation, double speed, double gravity) {
    double time = simulation.body.spheres[0].radius / speed;
    if (gravity > 0) time = std::min(time, speed / gravity);  // it is back on the ground after 2 e v/g
    constexpr int doublings = 12;
    for (int i = 0;; ++i, time *= 2) {
        simulation.options.end_time = time;
        Run result = run(simulation);
        if (end_of_impact(result) != nullptr || i == doublings) return result;
    }
}

/// Phases of the first impact, up to `end`; events of one time leave nothing between them.
std::vector<ObliquePhase> phases_of(const Run& run, double end) {
    std::vector<ObliquePhase> history;
    const double touchdown = run.events.front().time;
    for (std::size_t i = 0; i < run.events.size() && run.events[i].time < end; ++i) {
        const Event& event = run.events[i];
        const double next = i + 1 < run.events.size() ? std::min(run.events[i + 1].time, end) : end;
        if (!(next > event.time)) continue;
        const Phase phase = event.state.contacts[0].phase;
        if (!history.empty() && history.back().phase == phase) {
            history.back().duration += next - event.time;
        } else {
            history.push_back({phase, event.time - touchdown, next - event.time});
        }
    }
    return history;
}

}  // namespace

Approach approach_at_speed(double speed, double angle, double spin) {
    require_positive(speed, "speed", "m/s");
    check_angle(angle);
    return {speed * std::cos(angle), speed * std::sin(angle), spin};
}

Approach approach_at_normal_speed(double normal_speed, double angle, double spin) {
    require_positive(normal_speed, "normal speed", "m/s");
    check_angle(angle);
    return {normal_speed, normal_speed * std::tan(angle), spin};
}

double ObliqueImpact::tangential_restitution() const noexcept {
    return in.tangential_velocity != 0 ? tangential_velocity / in.tangential_velocity : nan;
}
double ObliqueImpact::contact_restitution() const noexcept {
    const double V = contact_velocity_before();
    return V != 0 ? -contact_velocity() / V : nan;
}
double ObliqueImpact::rebound_angle() const noexcept { return std::atan2(tangential_velocity, normal_speed); }
double ObliqueImpact::contact_rebound_angle() const noexcept { return std::atan2(contact_velocity(), normal_speed); }
double ObliqueImpact::time_in(Phase phase) const noexcept {
    double time = 0;
    for (const ObliquePhase& part : history) time += part.phase == phase ? part.duration : 0;
    return time;
}

ObliqueImpact oblique_impact(const ObliqueSphere& sphere, const Approach& approach) {
    ask(sphere.go_on);  // a run as short as most impacts does not
    check(sphere, approach);
    Simulation simulation = simulation_of(sphere, approach);
    const Run result = run_impact(simulation, approach.normal_speed, sphere.gravity);
    const Event* end = end_of_impact(result);
    const Event& begin = result.events.at(0);
    const Impact& impact = result.impacts.at(0);
    const Snapshot& after = end != nullptr ? end->state : result.final;
    const double kinetic = begin.state.ledger.kinetic;
    const ContactEnergy& energy = after.ledger.contact;

    ObliqueImpact o;
    o.in = approach;
    o.radius = sphere.radius;
    o.peak_normal_force = impact.peak_normal_force;
    o.dissipated = energy.dissipated() / kinetic;
    for (const auto& channel : contact_channels) o.energy.*channel.member = energy.*channel.member / kinetic;
    o.residual = result.max_residual;
    o.history = phases_of(result, after.time);
    if (end == nullptr) {
        o.normal_speed = o.tangential_velocity = o.spin = o.impulse_ratio = o.duration = nan;
        return o;
    }
    o.normal_speed = after.body.velocity.z();
    o.tangential_velocity = after.body.velocity.x();
    o.spin = after.body.angular_velocity.y();
    o.duration = impact.separation.value_or(after.time) - begin.time;
    const double fallen = sphere.gravity * (after.time - begin.time);  // what the weight has done to the speed
    o.impulse_ratio =
        (approach.tangential_velocity - o.tangential_velocity) / (approach.normal_speed + o.normal_speed + fallen);
    return o;
}

std::optional<double> friction_coefficient(const FrictionLaw& law) {
    return std::visit(
        [](const auto& l) -> std::optional<double> {
            for (const auto& parameter : l.parameters()) {
                const bool sliding = parameter.key == "coefficient" || parameter.key == "kinetic_coefficient";
                if (sliding && l.*parameter.member > 0) return l.*parameter.member;
            }
            return std::nullopt;
        },
        law);
}

double mindlin_ratio(double poisson_ratio) {
    if (!(poisson_ratio > -1 && poisson_ratio <= 0.5))
        throw InvalidInput(fmt::format("Poisson's ratio is {}; it must be above -1 and at most 0.5", poisson_ratio));
    return 2 * (1 - poisson_ratio) / (2 - poisson_ratio);
}

namespace {

/// A column of the table that needs nothing but the impact.
struct Quantity {
    std::string_view name, unit, description;
    double (*of)(const ObliqueImpact&);
    bool measurable = true;  ///< it can be fitted to
};

using I = ObliqueImpact;
constexpr std::array before{
    Quantity{"angle", "degree", "angle of incidence of the centre",
             [](const I& i) { return std::atan2(i.in.tangential_velocity, i.in.normal_speed) / degree; }, false},
    Quantity{"spin", "rad/s", "spin before, > 0 top spin", [](const I& i) { return i.in.spin; }, false},
    Quantity{"normal_speed", "m/s", "normal speed before, V_n", [](const I& i) { return i.in.normal_speed; }, false},
    Quantity{"tangential_velocity", "m/s", "tangential velocity of the centre before",
             [](const I& i) { return i.in.tangential_velocity; }, false},
    Quantity{"contact_velocity", "m/s", "tangential velocity of the contact point before, V",
             [](const I& i) { return i.contact_velocity_before(); }, false},
};
constexpr std::array after{
    Quantity{"normal_restitution", "1", "e_n, normal speed after over before",
             [](const I& i) { return i.normal_restitution(); }},
    Quantity{"tangential_restitution", "1", "e_t, tangential velocity of the centre after over before",
             [](const I& i) { return i.tangential_restitution(); }},
    Quantity{"contact_restitution", "1", "beta = -V'/V of the contact point",
             [](const I& i) { return i.contact_restitution(); }},
    Quantity{"rebound_angle", "degree", "of the centre", [](const I& i) { return i.rebound_angle() / degree; }},
    Quantity{"contact_rebound_angle", "degree", "of the contact point",
             [](const I& i) { return i.contact_rebound_angle() / degree; }},
    Quantity{"spin_after", "rad/s", "spin after, > 0 top spin", [](const I& i) { return i.spin; }},
    Quantity{"normal_speed_after", "m/s", "normal speed after", [](const I& i) { return i.normal_speed; }},
    Quantity{"tangential_velocity_after", "m/s", "tangential velocity of the centre after",
             [](const I& i) { return i.tangential_velocity; }},
    Quantity{"contact_velocity_after", "m/s", "tangential velocity of the contact point after, V'",
             [](const I& i) { return i.contact_velocity(); }},
    Quantity{"impulse_ratio", "1", "impulse of friction against the motion over the normal impulse",
             [](const I& i) { return i.impulse_ratio; }},
};
constexpr std::array course{
    Quantity{"duration", "s", "from touchdown to the last moment of normal force",
             [](const I& i) { return i.duration; }},
    Quantity{"slip_time", "s", "time spent slipping", [](const I& i) { return i.time_in(Phase::slip); }},
    Quantity{"stick_time", "s", "time spent sticking", [](const I& i) { return i.time_in(Phase::stick); }},
    Quantity{"peak_force", "N", "largest normal force", [](const I& i) { return i.peak_normal_force; }},
    Quantity{"dissipated", "1", "energy lost in dampers and clutch, over the kinetic energy before",
             [](const I& i) { return i.dissipated; }, false},
};

}  // namespace

Table oblique_table(std::span<const ObliqueImpact> impacts, std::optional<double> coefficient,
                    std::optional<double> poisson_ratio) {
    Table table{"Oblique impact of a sphere, angles from the normal", {}};
    const auto add = [&](std::string_view name, std::string_view unit, std::string_view description, const auto& of) {
        Column column{std::string(name), std::string(unit), std::string(description), {}};
        for (const ObliqueImpact& impact : impacts) column.values.push_back(of(impact));
        table.columns.push_back(std::move(column));
    };
    const auto add_all = [&](const auto& quantities) {
        for (const Quantity& q : quantities) add(q.name, q.unit, q.description, q.of);
    };
    add_all(before);
    add_all(after);
    if (coefficient) {
        const double mu = *coefficient;
        const auto psi1 = [mu](const I& i) { return i.contact_velocity_before() / (mu * i.in.normal_speed); };
        const auto psi2 = [mu](const I& i) { return i.contact_velocity() / (mu * i.in.normal_speed); };
        add("psi1", "1", "V/(mu V_n)", psi1);
        add("psi2", "1", "V'/(mu V_n)", psi2);
        if (poisson_ratio) {
            const double kappa = mindlin_ratio(*poisson_ratio);
            add("psi1_maw", "1", "kappa V/(mu V_n), psi_1 of Maw, Barber & Fawcett",
                [&](const I& i) { return kappa * psi1(i); });
            add("psi2_maw", "1", "kappa V'/(mu V_n), psi_2 of Maw, Barber & Fawcett",
                [&](const I& i) { return kappa * psi2(i); });
        }
    }
    add_all(course);
    for (const auto& channel : contact_channels) {
        if (channel.kind != ChannelKind::unpaid) continue;
        const std::string description =
            fmt::format("{} over the kinetic energy before; where < 0, the law has made energy", channel.symbol);
        add(channel.name, "1", description, [&channel](const I& i) { return i.energy.*channel.member; });
    }
    add("residual", "1", "largest residual of the ledger", [](const I& i) { return i.residual; });
    return table;
}

Table oblique_history(std::span<const ObliqueImpact> impacts) {
    Column row{"row", "1", "which impact, from 0", {}};
    Column phase{"phase", "1", "0 slip, 1 stick, 2 recovering without force", {}};
    Column start{"start", "s", "from touchdown", {}};
    Column duration{"duration", "s", "how long it lasts", {}};
    for (std::size_t i = 0; i < impacts.size(); ++i) {
        for (const ObliquePhase& part : impacts[i].history) {
            row.values.push_back(static_cast<double>(i));
            phase.values.push_back(part.phase == Phase::slip ? 0 : part.phase == Phase::stick ? 1 : 2);
            start.values.push_back(part.start);
            duration.values.push_back(part.duration);
        }
    }
    return {"Stick and slip", {std::move(row), std::move(phase), std::move(start), std::move(duration)}};
}

// Fitting to measurements ---------------------------------------------------------------------------------------------

namespace {

/// Those quantities that can be measured.
std::vector<const Quantity*> measurable() {
    std::vector<const Quantity*> all;
    for (const auto& list : {std::span<const Quantity>(after), std::span<const Quantity>(course)})
        for (const Quantity& q : list)
            if (q.measurable) all.push_back(&q);
    return all;
}

const Quantity& observable(std::string_view name) {
    std::vector<std::string_view> known;
    for (const Quantity* q : measurable()) {
        if (q->name == name) return *q;
        known.push_back(q->name);
    }
    throw InvalidInput(fmt::format("'{}' is nothing that an oblique impact is measured by; there are {}", name,
                                   fmt::join(known, ", ")));
}

/// Where one parameter of the laws lives, and what it is called.
struct Place {
    double* value;
    std::string_view unit;
};

template <class Variant>
std::optional<Place> find_in(Variant& law, std::string_view key) {
    return std::visit(
        [&](auto& l) -> std::optional<Place> {
            for (const auto& parameter : l.parameters()) {
                if (parameter.key == key) return Place{&(l.*parameter.member), parameter.unit};
            }
            return std::nullopt;
        },
        law);
}

/// "friction.coefficient", "normal.damping"
Place place_of(ContactParameters& contact, std::string_view key) {
    const std::size_t dot = key.find('.');
    const std::string_view law = key.substr(0, dot), rest = dot == key.npos ? std::string_view{} : key.substr(dot + 1);
    std::optional<Place> place;
    if (law == "normal") place = find_in(contact.normal, rest);
    if (law == "friction") place = find_in(contact.friction, rest);
    if (place) return *place;

    throw InvalidInput(
        fmt::format("'{}' is no parameter of these laws; there are {}", key, fmt::join(parameter_keys(contact), ", ")));
}

}  // namespace

std::vector<std::string> parameter_keys(const ContactParameters& contact) {
    std::vector<std::string> keys;
    const auto add = [&keys](std::string_view kind, const auto& any) {
        std::visit(
            [&](const auto& law) {
                for (const auto& parameter : law.parameters())
                    keys.push_back(fmt::format("{}.{}", kind, parameter.key));
            },
            any);
    };
    add("normal", contact.normal);
    add("friction", contact.friction);
    return keys;
}

std::span<const ObliqueObservable> oblique_observables() {
    static const std::vector<ObliqueObservable> all = [] {
        std::vector<ObliqueObservable> list;
        for (const Quantity* q : measurable()) list.push_back({q->name, q->unit});
        return list;
    }();
    return all;
}

ObliqueFit fit_oblique(const ObliqueSphere& start, const ObliqueMeasurement& measured,
                       std::span<const std::string> keys, const FitOptions& options) {
    const Quantity& quantity = observable(measured.observable);
    if (measured.approaches.size() != measured.values.size())
        throw InvalidInput(
            fmt::format("there are {} approaches for {} values", measured.approaches.size(), measured.values.size()));
    ObliqueFit fit{.result = {}, .contact = start.contact, .unit = std::string(quantity.unit), .model = {}};
    LeastSquaresProblem problem;
    problem.residual_count = measured.values.size();
    for (const std::string& key : keys) {
        const Place place = place_of(fit.contact, key);
        if (!(*place.value > 0))
            throw InvalidInput(
                fmt::format("{} is {}; a parameter that is fitted must start above 0", key, *place.value));
        problem.parameters.push_back(
            {.name = key, .unit = std::string(place.unit), .start = *place.value, .low = 0, .logarithmic = true});
    }
    const auto model = [&](std::span<const double> x) {
        ObliqueSphere sphere = start;
        for (std::size_t i = 0; i < keys.size(); ++i) {
            if (!std::isfinite(x[i])) {
                throw InvalidInput(fmt::format(
                    "the fit runs away: {} grows beyond any number, so these data do not determine it; give it, or "
                    "start elsewhere",
                    keys[i]));
            }
            *place_of(sphere.contact, keys[i]).value = x[i];
        }
        std::vector<double> values;
        for (const Approach& approach : measured.approaches)
            values.push_back(quantity.of(oblique_impact(sphere, approach)));
        return values;
    };
    problem.residuals = [&](std::span<const double> x, std::span<double> residuals) {
        const std::vector<double> values = model(x);
        for (std::size_t i = 0; i < values.size(); ++i) residuals[i] = values[i] - measured.values[i];
    };
    fit.result = fit_least_squares(problem, options);
    std::vector<double> best;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        best.push_back(fit.result.estimates[i].value);
        *place_of(fit.contact, keys[i]).value = best.back();
    }
    fit.model = model(best);
    return fit;
}

}  // namespace footfall
