// What the values of options are checked against, with messages that say what is allowed.
#include "checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "footfall/io/units.hpp"
#include "io/nearest.hpp"

namespace footfall::cli {
namespace {

// The range that every solver of the library has.
constexpr double least_tolerance = 1e-14, largest_tolerance = 1e-3;

/// Checks with `check`, which gets the value of the text and gives what is wrong with it, or nothing. The text becomes
/// the plain number ("20 %" is 0.2), which is what is read then.
template <class Check>
CLI::Validator number_that(Check check) {
    // CLI11 puts a validator's name into the help, where the name of the type stands already.
    return {[check](std::string& text) -> std::string {
                try {
                    const double value = plain_or_si(text, "1");
                    const std::string wrong = check(value);
                    if (!wrong.empty()) return fmt::format("'{}' is not allowed: must be {}", text, wrong);
                    text = fmt::format("{}", value);
                    return {};
                } catch (const InvalidInput& error) {
                    return error.what();
                }
            },
            ""};
}

}  // namespace

CLI::Validator number() {
    return number_that([](double) { return std::string(); });
}

CLI::Validator tolerance() {
    return number_that([](double value) {
        const bool allowed = value >= least_tolerance && value <= largest_tolerance;
        return std::string(allowed ? "" : "from 1e-14 to 1e-3");
    });
}

CLI::Validator whole_number(int low, int high) {
    return number_that([low, high](double value) -> std::string {
        if (value == std::floor(value) && value >= low && value <= high) return {};
        return high == std::numeric_limits<int>::max() ? fmt::format("a whole number >= {}", low)
                                                       : fmt::format("a whole number from {} to {}", low, high);
    });
}

CLI::Validator one_of(std::vector<std::string> words) {
    return {[words = std::move(words)](const std::string& text) -> std::string {
                if (std::find(words.begin(), words.end(), text) != words.end()) return {};
                return fmt::format("'{}' is not allowed{} (one of {})", text, io::did_you_mean(text, words),
                                   io::listed(words));
            },
            ""};
}

}  // namespace footfall::cli
