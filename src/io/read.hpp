// What every reader of a file or of a line of text begins with.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace footfall::io {

/// The most that is read of a scenario or rig [bytes]: two hundred thousand spheres.
inline constexpr std::size_t largest_toml = std::size_t{16} << 20;
/// The most that is read of a table [bytes].
inline constexpr std::size_t largest_table = std::size_t{256} << 20;

/// The whole file, or what a pipe gives. Throws std::system_error where it cannot be read, as a folder cannot, and
/// InvalidInput where it holds more than `limit` bytes, or never ends.
[[nodiscard]] std::string read_file(const std::filesystem::path& file, std::size_t limit = largest_table);

/// What is between the blanks at both ends; by default those of a line in a file, which may end as on Windows.
[[nodiscard]] std::string_view trimmed(std::string_view text, std::string_view blank = " \t\r");

/// A number and nothing else; it may be infinite or NaN.
[[nodiscard]] std::optional<double> plain_number(std::string_view text);

}  // namespace footfall::io
