// The scenarios and rigs that come with footfall, by name. They are in the program itself: it has them wherever it is.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace footfall::cli {

/// One of the files in scenarios/, as it was when the program was built.
struct Shipped {
    std::string_view name;
    std::string_view text;
};

// In the order of their names; CMake writes them, cmake/FootfallShipped.cmake.
[[nodiscard]] std::span<const Shipped> shipped_scenarios();
[[nodiscard]] std::span<const Shipped> shipped_rigs();

enum class FileKind { scenario, rig };

/// Where there is no file of this name, the text of the shipped one that has it as its name; nothing where there is a
/// file. Throws InvalidInput where there is neither, with the nearest name.
[[nodiscard]] std::optional<std::string> shipped_text(FileKind kind, const std::filesystem::path& file);

/// The names with their titles, a line each; `title` reads it from the text.
[[nodiscard]] std::string shipped_list(FileKind kind, std::string (*title)(std::string_view text));

}  // namespace footfall::cli
