#include "host/check_step.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "footfall/math/error.hpp"

namespace footfall::host {
namespace {

std::string place(std::string_view name, std::size_t at, std::size_t width) {
    return width == 1 ? fmt::format("{}[{}]", name, at) : fmt::format("{}[{}][{}]", name, at / width, at % width);
}

bool all_finite(std::span<const double> values) noexcept {
    // 0 x is NaN where x is not finite: additions are cheaper than a branch for each number.
    double zero = 0;
    for (const double x : values) zero += 0 * x;
    return zero == 0;
}

/// `width` numbers for each of `rows`.
void check_array(std::string_view name, std::span<const double> values, std::size_t rows, std::size_t width,
                 std::string_view unit) {
    if (values.size() != rows * width)
        throw InvalidInput(fmt::format("{}: has {} numbers; must have {}, {} for each of {} {}", name, values.size(),
                                       rows * width, width, rows, width == rows ? "rows" : "contacts"));
    if (all_finite(values)) return;
    for (std::size_t k = 0; k < values.size(); ++k)
        if (!std::isfinite(values[k]))
            throw InvalidInput(fmt::format("{} is {} {}; must be finite", place(name, k, width), values[k], unit));
}

void check_optional(std::string_view name, std::span<const double> values, std::size_t contacts, std::size_t width,
                    std::string_view unit) {
    if (!values.empty()) check_array(name, values, contacts, width, unit);
}

void check_depth(std::span<const double> depth, std::size_t contacts) {
    if (depth.size() != contacts)
        throw InvalidInput(
            fmt::format("depth: has {} numbers; must have {}, 1 for each contact", depth.size(), contacts));
    for (std::size_t i = 0; i < contacts; ++i)
        if (!(depth[i] < std::numeric_limits<double>::infinity()))
            throw InvalidInput(
                fmt::format("depth[{}] is {} m; must be finite, or minus infinity far above the ground", i, depth[i]));
}

/// Whether the matrix can be a J M^-1 J^T, as far as two entries can tell.
void check_delassus(std::span<const double> D, std::size_t contacts) {
    const std::size_t n = 3 * contacts;
    check_array("delassus", D, n, n, "1/kg");
    for (std::size_t i = 0; i < n; ++i)
        if (D[i * n + i] < 0)
            throw InvalidInput(
                fmt::format("delassus[{0}][{0}] is {1} 1/kg; the diagonal of J M^-1 J^T is >= 0", i, D[i * n + i]));
    constexpr double rounding = 1e-6;  // of sqrt(D_ii D_jj): a host's matrices come out of factorizations
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const double a = D[i * n + j], b = D[j * n + i], square = D[i * n + i] * D[j * n + j];
            if (!((a - b) * (a - b) <= rounding * rounding * square))
                throw InvalidInput(
                    fmt::format("delassus[{0}][{1}] is {2} and [{1}][{0}] is {3} 1/kg; J M^-1 J^T is "
                                "symmetric",
                                i, j, a, b));
            if (!(a * a <= (1 + rounding) * square))
                throw InvalidInput(
                    fmt::format("delassus[{0}][{1}] is {2} 1/kg, more than the root of {3} [{0}][{0}] times {4} "
                                "[{1}][{1}]; J M^-1 J^T of masses > 0 has none such",
                                i, j, a, D[i * n + i], D[j * n + j]));
        }
    }
}

}  // namespace

void check_step(const HostStep& host, std::size_t contacts, int asks, std::string_view law) {
    if (!(host.dt >= 0) || !std::isfinite(host.dt))
        throw InvalidInput(fmt::format("dt is {} s; must be >= 0 and finite", host.dt));
    check_depth(host.depth, contacts);
    check_array("velocity", host.velocity, contacts, 3, "m/s");
    check_array("free_acceleration", host.free_acceleration, contacts, 3, "m/s^2");
    check_delassus(host.delassus, contacts);
    check_optional("ground_velocity", host.ground_velocity, contacts, 3, "m/s");
    check_optional("frame_spin", host.frame_spin, contacts, 1, "rad/s");
    check_optional("radius", host.radius, contacts, 1, "m");
    check_optional("spin", host.spin, contacts, 1, "rad/s");
    check_optional("rolling", host.rolling, contacts, 2, "rad/s");
    if (asks >= 0 && (host.radius.empty() || host.spin.empty() || host.rolling.empty()))
        throw InvalidInput(
            fmt::format("contact {} is under the friction law '{}', whose force depends on how the sphere turns: "
                        "give radius, spin and rolling",
                        asks, law));
    for (std::size_t i = 0; i < host.radius.size(); ++i)
        if (!(host.radius[i] > 0))
            throw InvalidInput(fmt::format("radius[{}] is {} m; must be > 0", i, host.radius[i]));
}

void check_options(const ContactSetOptions& options) {
    constexpr double tightest = 1e-13, loosest = 1e-2;
    if (!(options.tolerance >= tightest && options.tolerance <= loosest))
        throw InvalidInput(fmt::format("tolerance is {}; must be from {} to {}", options.tolerance, tightest, loosest));
    if (options.max_evaluations < 1)
        throw InvalidInput(fmt::format("max_evaluations is {}; must be >= 1", options.max_evaluations));
}

Phase phase_at(std::size_t i, int number) {
    if (number < 0 || number > static_cast<int>(Phase::recovering))
        throw InvalidInput(
            fmt::format("phases[{}] is {}; must be one of 0 flight, 1 stick, 2 slip, 3 recovering", i, number));
    return static_cast<Phase>(number);
}

}  // namespace footfall::host
