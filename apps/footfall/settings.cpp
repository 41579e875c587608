// Options that change a scenario or rig before it is read.
#include "settings.hpp"

#include <fmt/format.h>

#include "checks.hpp"

namespace footfall::cli {

void SettingArguments::add_to(CLI::App& command, const std::string& kind) {
    command.add_option("--tolerance", tolerance, fmt::format("Relative tolerance, in place of the {}'s", kind))
        ->check(cli::tolerance())
        ->type_name("NUMBER");
    command
        .add_option("--set", changes,
                    fmt::format("A key of the {} by its path, as if the file said so; again for others", kind))
        ->type_name("KEY=VALUE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

std::vector<Setting> SettingArguments::all(const std::string& tolerance_key) const {
    std::vector<Setting> settings;
    if (!normal.empty()) settings.push_back(normal_law_setting(normal, "--normal " + normal));
    if (!friction.empty()) settings.push_back(friction_law_setting(friction, "--friction " + friction));
    if (!tolerance.empty()) settings.push_back({tolerance_key, tolerance, "--tolerance " + tolerance});
    for (const std::string& text : changes) settings.push_back(parse_setting(text, "--set " + text));
    return settings;
}

}  // namespace footfall::cli
