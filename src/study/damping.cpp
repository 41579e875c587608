#include "footfall/study/damping.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include <boost/math/tools/toms748_solve.hpp>
#include <fmt/format.h>

#include "study/law_alone.hpp"

namespace footfall {
namespace {

/// Calls `visit(law, parameter)` with a copy of the law and its damping parameter; returns whether there is one.
template <class Visit>
bool visit_damping(const NormalLaw& any, Visit&& visit) {
    return std::visit(
        [&]<class Law>(Law law) {
            for (const auto& parameter : Law::parameters()) {
                if (!parameter.may_be_zero()) continue;
                const auto dissipates = [&](double value) {
                    Law probe = law;
                    probe.*parameter.member = value;
                    return study::LawAlone<double>(probe).force(1, 1).dissipative != 0;
                };
                if (dissipates(0) || !dissipates(1)) continue;
                visit(law, parameter);
                return true;
            }
            return false;
        },
        any);
}

}  // namespace

std::optional<std::string_view> damping_key(const NormalLaw& law) {
    std::optional<std::string_view> key;
    visit_damping(law, [&](const auto& /*law*/, const auto& parameter) { key = parameter.key; });
    return key;
}

NormalLaw with_restitution(const NormalLaw& law, double mass, double speed, double restitution, double tolerance) {
    if (!(restitution > 0 && restitution <= 1)) {
        throw InvalidInput(fmt::format(
            "restitution is {}; it must be > 0 and <= 1: no damping gives more speed than came in, and without gravity "
            "every impact ends with some",
            restitution));
    }
    NormalLaw result = law;
    const ImpactOptions options{.gravity = 0, .tolerance = tolerance};
    const bool found = visit_damping(law, [&](auto damped, const auto& parameter) {
        double& damping = damped.*parameter.member;
        const auto e = [&](double value) {
            damping = value;
            return normal_impact(damped, mass, speed, options).restitution;
        };
        const auto refuse = [&](std::string_view reach) {
            throw InvalidInput(fmt::format("no {} ({}) of the law '{}' gives the restitution {} at {} m/s: {}",
                                           parameter.key, parameter.symbol, damped.description.name, restitution, speed,
                                           reach));
        };
        const double elastic = e(0);
        if (restitution >= elastic - tolerance) {
            if (restitution > elastic + tolerance) refuse(fmt::format("without damping it is {}", elastic));
            damping = 0;
            result = damped;
            return;
        }

        // The damping whose force is that of the spring, where an elastic impact is at half of its energy.
        damping = 0;
        const double deepest = normal_impact(damped, mass, speed, options).peak_indentation;
        damping = 1;
        const auto force = study::LawAlone<double>(damped).force(deepest / 2, speed);
        const double unit = std::abs(force.elastic / force.dissipative);

        constexpr double factor = 4, most = 1e7;
        double high = unit / 16, low = 0, least = elastic;
        for (double reached = e(high); reached > restitution; reached = e(high)) {
            least = std::min(least, reached);
            low = high;
            high *= factor;
            if (high > most * unit) refuse(fmt::format("down to {:.6g} can be reached", least));
        }
        // In the logarithm of e, which is nearly straight in the damping.
        const auto miss = [&](double value) { return std::log(e(value) / restitution); };
        std::uintmax_t iterations = 100;
        const auto [below, above] = boost::math::tools::toms748_solve(
            miss, low, high, boost::math::tools::eps_tolerance<double>(44), iterations);
        damping = std::midpoint(below, above);
        result = damped;
    });
    if (!found) {
        throw InvalidInput(
            fmt::format("the law '{}' has no damping parameter whose value could be found from a "
                        "restitution",
                        name_of(law)));
    }
    return result;
}

}  // namespace footfall
