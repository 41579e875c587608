// What every reader of a file or of a line of text begins with.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace footfall::io {

/// The whole file. Throws std::system_error where it cannot be read, as a folder cannot.
[[nodiscard]] std::string read_file(const std::filesystem::path& file);

/// What is between the blanks at both ends; by default those of a line in a file, which may end as on Windows.
[[nodiscard]] std::string_view trimmed(std::string_view text, std::string_view blank = " \t\r");

/// A number and nothing else; it may be infinite or NaN.
[[nodiscard]] std::optional<double> plain_number(std::string_view text);

}  // namespace footfall::io
