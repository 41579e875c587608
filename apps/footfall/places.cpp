// Which files a command reads and writes, and that none of them is written over another.
#include "places.hpp"

#include <system_error>

#include <fmt/format.h>

#include "footfall/io/printable.hpp"
#include "footfall/math/error.hpp"

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

}  // namespace

std::vector<Place> table_places(const std::string& option, const fs::path& folder) {
    std::vector<Place> places{{option, folder}};
    for (const char* table : {"samples.csv", "events.csv", "impacts.csv"}) places.push_back({option, folder / table});
    return places;
}

void keep_apart(const std::vector<Place>& inputs, const std::vector<Place>& outputs) {
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const Place& output = outputs[i];
        for (const Place& input : inputs) {
            if (!same_place(output.path, input.path)) continue;
            throw InvalidInput(fmt::format("{} would write over {}, which is read: {}; give the output another name",
                                           output.option, input.option, names(output, input)));
        }
        for (std::size_t j = 0; j < i; ++j) {
            if (output.option == outputs[j].option || !same_place(output.path, outputs[j].path)) continue;
            throw InvalidInput(fmt::format("{} and {} are the same file: {}; give each a name of its own",
                                           outputs[j].option, output.option, names(outputs[j], output)));
        }
    }
}

}  // namespace footfall::cli
