// The scenarios and rigs that come with footfall, by name.
#include "shipped.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "footfall/math/error.hpp"
#include "io/nearest.hpp"

namespace footfall::cli {
namespace {

std::span<const Shipped> files_of(FileKind kind) {
    return kind == FileKind::scenario ? shipped_scenarios() : shipped_rigs();
}
std::string_view word_for(FileKind kind) { return kind == FileKind::scenario ? "scenario" : "rig"; }
std::string_view command_for(FileKind kind) { return kind == FileKind::scenario ? "run" : "drive"; }

const Shipped* find(FileKind kind, std::string_view name) {
    const std::span<const Shipped> files = files_of(kind);
    const auto found = std::find_if(files.begin(), files.end(), [&](const Shipped& file) { return file.name == name; });
    return found == files.end() ? nullptr : &*found;
}

}  // namespace

std::optional<std::string> shipped_text(FileKind kind, const std::filesystem::path& file) {
    std::error_code none;
    if (std::filesystem::symlink_status(file, none).type() != std::filesystem::file_type::not_found) return {};
    const std::string written = file.string();
    if (const Shipped* shipped = find(kind, written)) return std::string(shipped->text);

    const FileKind other = kind == FileKind::scenario ? FileKind::rig : FileKind::scenario;
    const std::string name = file.stem().string();
    if (find(other, name)) {
        throw InvalidInput(fmt::format("cannot read {}: there is no such file, and '{}' is a {}: footfall {} {}",
                                       written, name, word_for(other), command_for(other), name));
    }
    std::vector<std::string> names;
    for (const Shipped& shipped : files_of(kind)) names.emplace_back(shipped.name);
    throw InvalidInput(
        fmt::format("cannot read {}: there is no such file, and no {} of this name comes with footfall{} "
                    "(footfall {} --list has their names)",
                    written, word_for(kind), io::did_you_mean(name, names), command_for(kind)));
}

std::string shipped_list(FileKind kind, std::string (*title)(std::string_view text)) {
    const std::span<const Shipped> files = files_of(kind);
    std::size_t width = 0;
    for (const Shipped& shipped : files) width = std::max(width, shipped.name.size());
    std::string list;
    for (const Shipped& shipped : files) list += fmt::format("{:<{}}  {}\n", shipped.name, width, title(shipped.text));
    return list;
}

}  // namespace footfall::cli
