#include "footfall/study/restitution.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <fmt/format.h>

#include "footfall/simulate/run.hpp"
#include "footfall/study/viscoelastic_theory.hpp"
#include "study/law_alone.hpp"

namespace footfall {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void require(bool allowed, std::string_view name, double value, std::string_view unit, std::string_view range) {
    if (!allowed) throw InvalidInput(fmt::format("{} is {} {}; it must be {}", name, value, unit, range));
}

void require_positive(std::string_view name, double value, std::string_view unit) {
    require(std::isfinite(value) && value > 0, name, value, unit, "finite and > 0");
}

void check_range(double from, double to) {
    require_positive("slowest speed", from, "m/s");
    require(std::isfinite(to) && to > from, "fastest speed", to, "m/s", "finite and above the slowest");
}

/// A depth [m] of the size that an impact reaches: where the spring holds the energy that the impact brings, within a
/// factor of two.
double depth_scale(const NormalLaw& law, double mass, double speed, double gravity) {
    const study::LawAlone<double> normal(law);
    const auto reaches = [&](double z) { return normal.stored_energy(z) >= mass * (speed * speed / 2 + gravity * z); };
    constexpr double smallest = 1e-280, largest = 1e100;
    double z = 1e-3;
    while (reaches(z) && z > smallest) z /= 2;
    while (!reaches(z) && z < largest) z *= 2;
    return z;
}

/// The sphere has less energy than at rest at z = 0, so that it cannot return there, and is past its deepest point.
bool stays(const Run& run, const Simulation& simulation) {
    const Ledger& ledger = run.final.ledger;
    const double at_surface = -simulation.body.mass * simulation.gravity.z() * simulation.body.spheres[0].radius;
    const double energy = ledger.kinetic + ledger.contact.normal_spring + ledger.potential;
    const ContactSnapshot& contact = run.final.contacts.front();
    const Impact& impact = run.impacts.front();
    const bool sinking = contact.depth_rate > 1e-9 * impact.speed_in && contact.depth >= impact.peak_indentation;
    return energy < at_surface && !sinking;
}

}  // namespace

NormalImpact normal_impact(const NormalLaw& law, double mass, double speed, const ImpactOptions& options) {
    ask(options.go_on);  // a run as short as most impacts does not
    require_positive("mass", mass, "kg");
    require_positive("speed", speed, "m/s");
    require(std::isfinite(options.gravity) && options.gravity >= 0, "gravity", options.gravity, "m/s^2",
            "finite and >= 0");
    check(ContactParameters{law, NoFriction<>{}}, "impact");

    const double depth = depth_scale(law, mass, speed, options.gravity);
    const double gap = options.gravity > 0 ? std::min(depth, speed * speed / (4 * options.gravity)) : depth;
    const double approach = std::sqrt(speed * speed - 2 * options.gravity * gap);
    const double time = depth / std::max(speed, std::sqrt(options.gravity * depth));

    Simulation simulation;
    simulation.body.mass = mass;
    // No radius enters the equations of a central impact. One of the size of the impact resolves its times as well as
    // everything else, since the run measures positions against the radius.
    simulation.body.spheres = {{.radius = depth}};
    simulation.body.inertia = solid_sphere_inertia(mass, depth);
    simulation.gravity = {0, 0, -options.gravity};
    simulation.initial.position = {0, 0, depth + gap};
    simulation.initial.velocity = {0, 0, -approach};
    simulation.contacts = {{law, NoFriction<>{}}};
    simulation.options.tolerance = options.tolerance;
    simulation.options.progress = progress_of(options.go_on);

    NormalImpact result;
    result.speed = speed;
    // An elastic impact takes about three times `time`; heavy damping can take any multiple of it.
    constexpr double longest = 1e12;
    for (double end = 8; end < longest; end *= 8) {
        simulation.options.end_time = end * time;
        const Run done = run(simulation);
        if (done.impacts.empty()) continue;
        const Impact& impact = done.impacts.front();
        if (!impact.recovered && !(options.gravity > 0 && stays(done, simulation))) continue;
        result.peak_force = impact.peak_normal_force;
        result.peak_indentation = impact.peak_indentation;
        if (impact.recovered) {
            result.restitution = impact.restitution().value_or(0);
            result.recovered = *impact.recovered - impact.touchdown;
            if (impact.separation) result.separation = *impact.separation - impact.touchdown;
        }
        return result;
    }
    throw std::runtime_error(
        fmt::format("the impact at {} m/s under '{}' has not ended after {:g} s", speed, name_of(law), longest * time));
}

std::optional<double> slowest_bounce(const NormalLaw& law, double mass, const ImpactOptions& options) {
    require_positive("mass", mass, "kg");
    require_positive("gravity", options.gravity, "m/s^2");
    check(ContactParameters{law, NoFriction<>{}}, "impact");
    const auto bounces = [&](double speed) { return normal_impact(law, mass, speed, options).bounced(); };

    constexpr double fastest = 1e8, factor = 4;
    // Below this, the error of the run's energy may decide whether it bounces.
    const double slowest = 10 * std::sqrt(options.tolerance);
    const double unit = std::sqrt(options.gravity * depth_scale(law, mass, 0, options.gravity));  // of a fall into rest
    double high = unit;
    while (!bounces(high)) {
        if (high > fastest * unit) return std::nullopt;
        high *= factor;
    }
    double low = high / factor;
    while (bounces(low)) {
        if (low < slowest * unit) return 0.0;
        high = low;
        low /= factor;
    }
    // e rises from zero as a root, so only whether it bounces can be asked for.
    while (high / low > 1 + 1e-9) {
        const double middle = std::sqrt(low * high);
        (bounces(middle) ? high : low) = middle;
    }
    return high;
}

std::optional<LogLinearRange> log_linear_range(const NormalLaw& law, double mass, double from, double to,
                                               double deviation) {
    check_range(from, to);
    require_positive("deviation", deviation, "");
    const ImpactOptions exact{.gravity = 0, .tolerance = 1e-13};
    const auto e = [&](double x) { return normal_impact(law, mass, std::exp(x), exact).restitution; };
    const auto slope = [&](double x) {
        constexpr double h = 0.05;  // a difference of fourth order
        return (8 * (e(x + h) - e(x - h)) - (e(x + 2 * h) - e(x - 2 * h))) / (12 * h);
    };

    // A coarse look first: the slope may have no smallest value inside, or rounding where e is all but 1.
    constexpr int points = 33;
    const double start = std::log(from), step = (std::log(to) - start) / (points - 1);
    std::vector<double> slopes;
    for (int i = 0; i < points; ++i) slopes.push_back(slope(start + i * step));
    const auto least = std::min_element(slopes.begin(), slopes.end());
    if (least == slopes.begin() || least == slopes.end() - 1 || !(*least < -1e-9)) return std::nullopt;
    const double near = start + static_cast<double>(least - slopes.begin()) * step;
    const auto [x0, s0] = boost::math::tools::brent_find_minima(slope, near - step, near + step, 20);

    LogLinearRange range{.speed = std::exp(x0), .restitution = e(x0), .slope = s0, .slowest = from, .fastest = to};
    const auto excess = [&, x0 = x0, s0 = s0](double x) {
        return std::abs(e(x) - range.restitution - s0 * (x - x0)) - deviation;
    };
    const auto reach = [&](double direction, double end) {
        constexpr double stride = 0.25;
        for (double x = x0; x != end;) {
            const double next = direction > 0 ? std::min(x + stride, end) : std::max(x - stride, end);
            if (excess(next) > 0) {
                std::uintmax_t iterations = 60;
                const auto bracket =
                    boost::math::tools::toms748_solve(excess, std::min(x, next), std::max(x, next),
                                                      boost::math::tools::eps_tolerance<double>(30), iterations);
                return std::midpoint(bracket.first, bracket.second);
            }
            x = next;
        }
        return end;
    };
    range.slowest = std::exp(reach(-1, start));
    range.fastest = std::exp(reach(1, std::log(to)));
    return range;
}

namespace {

void check_speeds(double from, double to, int count) {
    check_range(from, to);
    constexpr int most = 1'000'000;  // each is an impact to simulate
    if (count < 2 || count > most)
        throw InvalidInput(fmt::format("the number of speeds is {}; it must be from 2 to {}", count, most));
}

}  // namespace

std::vector<double> linear_speeds(double from, double to, int count) {
    check_speeds(from, to, count);
    std::vector<double> speeds;
    for (int i = 0; i < count; ++i) speeds.push_back(std::lerp(from, to, static_cast<double>(i) / (count - 1)));
    return speeds;
}

std::vector<double> logarithmic_speeds(double from, double to, int count) {
    check_speeds(from, to, count);
    std::vector<double> speeds;
    const double steps = count - 1;
    for (int i = 0; i < count; ++i) speeds.push_back(from * std::pow(to / from, i / steps));
    speeds.back() = to;
    return speeds;
}

RestitutionResult restitution(const RestitutionStudy& study) {
    if (study.cases.empty()) throw InvalidInput("there is no law to compute the restitution of");
    if (study.speeds.empty()) throw InvalidInput("there is no speed to compute the restitution at");
    RestitutionResult result{.study = study, .impacts = {}, .slowest_bounces = {}};
    for (const RestitutionCase& one : study.cases) {
        require(one.radius > 0, "radius", one.radius, "m", "> 0");
        std::vector<NormalImpact> curve;
        for (const double speed : study.speeds) curve.push_back(normal_impact(one.law, one.mass, speed, study.options));
        result.impacts.push_back(std::move(curve));
        result.slowest_bounces.push_back(study.options.gravity > 0 ? slowest_bounce(one.law, one.mass, study.options)
                                                                   : std::nullopt);
    }
    return result;
}

Table table(const RestitutionResult& result) {
    const RestitutionStudy& study = result.study;
    Table table{.title = study.title, .columns = {{"speed", "m/s", "speed into the ground", study.speeds, ""}}};
    const auto add = [&](std::string_view name, std::string_view unit, std::string_view description,
                         const std::function<double(const NormalImpact&)>& value) {
        for (std::size_t i = 0; i < study.cases.size(); ++i) {
            Column column{std::string(name), std::string(unit), std::string(description), {}, study.cases[i].name};
            for (const NormalImpact& impact : result.impacts[i]) column.values.push_back(value(impact));
            table.columns.push_back(std::move(column));
        }
    };
    add("restitution", "1", "speed out over speed in", [](const NormalImpact& i) { return i.restitution; });
    for (const RestitutionCase& one : study.cases) {
        for (const RestitutionTheory& theory : theories_of(one.law, one.mass)) {
            Column column{theory.name, "1", theory.description, {}, one.name};
            for (const double speed : study.speeds) column.values.push_back(theory.restitution(speed));
            table.columns.push_back(std::move(column));
        }
    }
    add("peak_force", "N", "largest normal force", [](const NormalImpact& i) { return i.peak_force; });
    add("peak_indentation", "m", "largest indentation", [](const NormalImpact& i) { return i.peak_indentation; });
    add("separation", "s", "from touchdown until the force is zero",
        [](const NormalImpact& i) { return i.separation.value_or(nan); });
    add("recovered", "s", "from touchdown until the indentation is zero",
        [](const NormalImpact& i) { return i.recovered.value_or(nan); });
    return table;
}

}  // namespace footfall
