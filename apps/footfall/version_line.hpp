// What --version prints.
#pragma once

#include <string>

namespace footfall::cli {

/// "footfall 0.1.0 (abcdef123)"; "abcdef123+" where files were changed after that commit; the version alone where it
/// was not built from a clone.
[[nodiscard]] std::string version_line();

}  // namespace footfall::cli
