// Which files a command reads and writes, and that none of them is written over another.
#include "places.hpp"

#include <system_error>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "footfall/io/printable.hpp"
#include "footfall/math/error.hpp"
#include "io/temporary.hpp"

namespace footfall::cli {
namespace fs = std::filesystem;
namespace {

bool same_place(const fs::path& a, const fs::path& b) {
    std::error_code error;
    // By device and number, so that no name and no link hides it.
    if (fs::exists(a, error) && fs::exists(b, error)) return fs::equivalent(a, b, error);
    const fs::path real_a = fs::weakly_canonical(fs::absolute(a, error), error);
    if (error) return false;  // such a path cannot be written or read either
    const fs::path real_b = fs::weakly_canonical(fs::absolute(b, error), error);
    if (error) return false;
    const auto plain = [](const fs::path& path) { return path.has_filename() ? path : path.parent_path(); };
    return plain(real_a) == plain(real_b);
}

/// "d.csv", or "d.csv and ./d.csv" where that is not the same name.
std::string names(const Place& a, const Place& b) {
    const std::string one = printable(a.path.native()), other = printable(b.path.native());
    return one == other ? one : fmt::format("{} and {}", one, other);
}

bool is_link(const fs::path& path) {
    std::error_code error;
    return fs::is_symlink(fs::symlink_status(path, error));
}

/// The path is the file that standard output goes to.
bool is_standard_output(const fs::path& path) {
    struct stat file {
    }, output{};
    return ::stat(path.c_str(), &file) == 0 && ::fstat(STDOUT_FILENO, &output) == 0 && S_ISREG(output.st_mode) &&
           file.st_dev == output.st_dev && file.st_ino == output.st_ino;
}

}  // namespace

std::vector<Place> table_places(const std::string& option, const fs::path& folder) {
    std::vector<Place> places{{option, folder}};
    for (const char* table : io::run_tables) places.push_back({option, folder / table});
    return places;
}

void keep_apart(const std::vector<Place>& inputs, const std::vector<Place>& outputs) {
    for (const std::vector<Place>* places : {&inputs, &outputs}) {
        for (const Place& place : *places) {
            if (!is_standard_output(place.path)) continue;
            throw InvalidInput(fmt::format("standard output goes to {}, which is {}: give it another file",
                                           printable(place.path.native()), place.option));
        }
    }
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const Place& output = outputs[i];
        for (const Place& input : inputs) {
            if (!same_place(output.path, input.path)) continue;
            throw InvalidInput(fmt::format("{} would write over {}, which is read: {}; give the output another name",
                                           output.option, input.option, names(output, input)));
        }
        for (std::size_t j = 0; j < i; ++j) {
            // Tables of one folder are one file only where a link makes them so; a hard link is replaced by a file.
            const bool linked = is_link(output.path) || is_link(outputs[j].path);
            if (output.option == outputs[j].option && !linked) continue;
            if (!same_place(output.path, outputs[j].path)) continue;
            throw InvalidInput(fmt::format("{} and {} are the same file: {}; give each a name of its own",
                                           outputs[j].option, output.option, names(outputs[j], output)));
        }
    }
}

}  // namespace footfall::cli
