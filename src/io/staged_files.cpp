// Files that are written together.
#include "footfall/io/staged_files.hpp"

#include <mutex>

#include "io/atomic_file.hpp"

namespace footfall {

StagedFiles::StagedFiles() = default;
StagedFiles::~StagedFiles() = default;

void StagedFiles::commit() {
    {
        const std::lock_guard hold(io::commit_mutex());
        for (const auto& part : parts_) part->take_place();
    }
    for (const auto& part : parts_) part->settle();
    parts_.clear();
}

bool discard_staged_files() { return io::discard_temporaries(); }

}  // namespace footfall
