// Alone in its file, as the only one that is compiled again after a commit.
#include "version_line.hpp"

#include <string_view>

#include <fmt/format.h>

#include "commit.hpp"
#include "footfall/version.hpp"

namespace footfall::cli {

std::string version_line() {
    if (std::string_view(commit).empty()) return fmt::format("footfall {}", version);
    return fmt::format("footfall {} ({})", version, commit);
}

}  // namespace footfall::cli
