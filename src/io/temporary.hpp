// Files and folders under temporary names, which nobody else touches while their process lives.
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <mutex>
#include <string_view>

#include <sys/types.h>

namespace footfall::io {

/// The tables of a run, in the order in which they take their places.
inline constexpr std::array run_tables{"samples.csv", "events.csv", "impacts.csv"};
[[nodiscard]] inline bool is_run_table(std::string_view name) {
    return std::find(run_tables.begin(), run_tables.end(), name) != run_tables.end();
}

/// Held while files take their places, so that a program that is being ended ends before or after, not between.
[[nodiscard]] std::recursive_mutex& commit_mutex();

/// A new file or folder in a folder, named `.footfall-HOST-PID-N.tmp` and locked (flock) until its process ends: one
/// that nobody holds the lock of was left by a process that was killed.
class Temporary {
public:
    enum class Kind { file, folder };

    /// Makes it; `mode` is what open and mkdir take. Throws std::system_error.
    Temporary(const std::filesystem::path& folder, Kind kind, mode_t mode);
    /// Removes it, unless it has taken a place.
    ~Temporary();
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] int descriptor() const { return descriptor_; }

    /// Gives it this name, in place of what has it. Returns 0, or the error.
    int take(const std::filesystem::path& place);
    /// Exchanges it with the folder of this name; what was there is then the temporary one. Returns 0, or the error.
    int exchange(const std::filesystem::path& place);
    /// Gives it another name at which it is still temporary. Returns 0, or the error.
    int move(const std::filesystem::path& to);
    /// Leaves it for a later sweep.
    void leave();

private:
    friend bool discard_temporaries();
    /// False where a sweep took it before it was locked.
    bool lock();

    std::filesystem::path path_;  ///< empty where it has taken its place
    Kind kind_;
    int descriptor_ = -1;
};

/// What discard_staged_files does.
bool discard_temporaries();

/// Removes what dead processes of this user on this machine have left in `folder`, and puts tables of a run that were
/// complete, but not all in their places, there. What cannot be told to be dead stays.
void sweep(const std::filesystem::path& folder) noexcept;

/// Moves the tables in `ready`, a folder in `folder`, to their places in that folder, through links where they are
/// such, and removes it. Returns 0, or the error of the first that could not be moved.
int move_tables(const std::filesystem::path& ready, const std::filesystem::path& folder);

/// Removes the tables of a run in a folder, whatever else is there under another name as well, and the folder where
/// nothing remains.
void remove_folder(const std::filesystem::path& folder) noexcept;

/// As rename, with the flags of renameat2; again where a signal came. Returns 0, or the error.
int rename_entry(const std::filesystem::path& from, const std::filesystem::path& to, unsigned flags = 0);

/// Brings the names in a folder to the disk. Returns 0, or the error; a file system that cannot is none.
int sync_folder(const std::filesystem::path& folder);

/// Gives an open file or folder the owner, the group, the mode and the access list of another. Where the group cannot
/// be kept, the new one may do no more than everybody. Returns false where the owner is another.
bool adopt_rights(int descriptor, const std::filesystem::path& from);

}  // namespace footfall::io
