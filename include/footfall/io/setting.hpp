// Changes of a scenario or rig file before it is read: as if the file said so, with the same checks.
#pragma once

#include <string>
#include <string_view>

namespace footfall {

/// A value at a key.
struct Setting {
    std::string key;    ///< dotted path with indices from 0: "body.spheres[1].radius"
    std::string value;  ///< TOML; a word, or a number with a unit, is a string without quotes around it
    std::string place;  ///< what errors name in place of a line of the file: "--set time.end=2"
    /// The value is a law of all spheres: what single spheres have of their own in its place is taken out.
    bool for_all_spheres = false;
};

/// "KEY=VALUE". Throws InvalidInput, naming `place`, where it is not of this form.
[[nodiscard]] Setting parse_setting(std::string_view text, std::string place);

/// [contact.normal] is this law, "NAME:key=value,..." (law_text.hpp). The names are checked when the file is read.
/// Throws InvalidInput, naming `place`, where it is not of this form.
[[nodiscard]] Setting normal_law_setting(std::string_view law, std::string place);

/// Likewise [contact.friction].
[[nodiscard]] Setting friction_law_setting(std::string_view law, std::string place);

}  // namespace footfall
