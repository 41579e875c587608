// Files and folders that appear whole or not at all.
#include "io/atomic_file.hpp"

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <linux/magic.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include "footfall/io/printable.hpp"

namespace footfall::io {
namespace fs = std::filesystem;
namespace {

std::string describe(int error) { return std::generic_category().message(error); }

/// Why a complete file could not take its place, and what to do.
std::string why_no_rename(int error) {
    switch (error) {
        case EXDEV:
        case EBUSY:
            return "it is a mount point, or on another file system than its folder, so it cannot be replaced; write to "
                   "another place and copy it from there";
        case ENOENT:
            return "its folder was removed meanwhile";
        case EPERM:
        case EACCES:
            return fmt::format("its folder does not let this user replace it ({})", describe(error));
        default:
            return describe(error);
    }
}

/// The folder that the target stands in.
fs::path folder_of(const fs::path& target) { return target.has_parent_path() ? target.parent_path() : fs::path("."); }

/// Links that lead to open files of a process, such as /dev/stdout at its end.
bool in_proc(const fs::path& link) {
    struct statfs system {};
    return ::statfs(folder_of(link).c_str(), &system) == 0 && system.f_type == PROC_SUPER_MAGIC;
}

fs::path follow_links(const fs::path& target) {
    constexpr int most = 40;  // as the kernel allows
    std::error_code error;
    fs::path place = target;
    for (int links = 0; fs::is_symlink(fs::symlink_status(place, error)); ++links) {
        if (in_proc(place)) {
            fail_to_write(target,
                          "it is an open stream of a program, which cannot be replaced; name a file, or see --json for "
                          "what standard output can have");
        }
        if (links == most || !fs::exists(place, error)) {
            fail_to_write(target, "it is a symbolic link that leads to no file");
        }
        const fs::path next = fs::read_symlink(place, error);
        if (error) fail_to_write(target, describe(error.value()));
        place = folder_of(place) / next;  // an absolute one replaces the folder
    }
    return place;
}

/// Throws where something that is not a plain file, or that this user may not write, has the place.
void refuse_what_must_stay(const fs::path& target, const fs::path& place) {
    std::error_code error;
    const fs::file_status status = fs::status(place, error);
    if (!fs::exists(status)) return;
    constexpr const char* advice = "which cannot be replaced by a file; name a plain file and copy it from there";
    switch (status.type()) {
        case fs::file_type::regular:
            break;
        case fs::file_type::directory:
            fail_to_write(target, "it is a folder");
        case fs::file_type::character:
        case fs::file_type::block:
            fail_to_write(target, fmt::format("it is not a regular file but a device, {}", advice));
        case fs::file_type::fifo:
            fail_to_write(target, fmt::format("it is not a regular file but a pipe, {}", advice));
        case fs::file_type::socket:
            fail_to_write(target, fmt::format("it is not a regular file but a socket, {}", advice));
        default:
            fail_to_write(target, "it is not a regular file");
    }
    // A write-protected file is protected for a reason.
    if (::access(place.c_str(), W_OK) != 0) fail_to_write(target, describe(errno));
    // In a folder such as /tmp only the owner of a file, or of the folder, may replace it.
    struct stat file {
    }, folder{};
    if (::stat(place.c_str(), &file) != 0 || ::stat(folder_of(place).c_str(), &folder) != 0) return;
    const uid_t user = ::geteuid();
    if ((folder.st_mode & S_ISVTX) != 0 && user != 0 && user != file.st_uid && user != folder.st_uid) {
        fail_to_write(target, why_no_rename(EPERM));
    }
}

void refuse_folder(const fs::path& target, const fs::path& folder) {
    std::error_code error;
    const fs::file_status status = fs::status(folder, error);
    if (!fs::exists(status))
        fail_to_write(target, fmt::format("the folder {} does not exist", printable(folder.native())));
    if (!fs::is_directory(status)) fail_to_write(target, fmt::format("{} is not a folder", printable(folder.native())));
}

std::unique_ptr<Temporary> temporary_in(const fs::path& target, const fs::path& folder, Temporary::Kind kind,
                                        mode_t mode) {
    sweep(folder);
    try {
        return std::make_unique<Temporary>(folder, kind, mode);
    } catch (const std::system_error& error) {
        fail_to_write(target, fmt::format("no file can be made in the folder {}: {}", printable(folder.native()),
                                          describe(error.code().value())));
    }
}

constexpr mode_t for_everybody = 0666;  // less the umask
constexpr mode_t for_the_owner = 0600;  // until it has the rights of the older one

void sync(const fs::path& target, const fs::path& folder) {
    if (const int error = sync_folder(folder); error != 0) {
        fail_to_write(target, fmt::format("it is in its place, but the folder cannot be brought to the disk: {}",
                                          describe(error)));
    }
}

}  // namespace

void fail_to_write(const fs::path& target, std::string_view reason) {
    throw std::runtime_error(fmt::format("cannot write {}: {}", printable(target.native()), reason));
}

void Writer::write(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written > 0) {
            bytes.remove_prefix(static_cast<std::size_t>(written));
        } else if (written == 0 || errno != EINTR) {
            fail_to_write(target_, describe(written == 0 ? ENOSPC : errno));
        }
    }
}

void Writer::finish() {
    // Without this a crash of the machine could leave the new name with no content.
    int result = 0;
    do {
        result = ::fsync(descriptor_);
    } while (result != 0 && errno == EINTR);
    if (result != 0) fail_to_write(target_, describe(errno));
}

// One file ------------------------------------------------------------------------------------------------------------

AtomicFile::AtomicFile(const fs::path& target) : target_(target), place_(follow_links(target)) {
    if (!place_.has_filename()) fail_to_write(target_, "it names a folder, not a file");
    const fs::path folder = folder_of(place_);
    refuse_folder(target_, folder);
    refuse_what_must_stay(target_, place_);
    std::error_code error;
    const bool replaces = fs::exists(place_, error);
    temporary_ = temporary_in(target_, folder, Temporary::Kind::file, replaces ? for_the_owner : for_everybody);
    if (replaces) adopt_rights(temporary_->descriptor(), place_);
}

void AtomicFile::take_place() {
    if (const int error = temporary_->take(place_); error != 0) fail_to_write(target_, why_no_rename(error));
}

void AtomicFile::settle() { sync(target_, folder_of(place_)); }

// The tables of a run -------------------------------------------------------------------------------------------------

namespace {

/// More things than this in one folder are somebody's work, not a run's results.
constexpr std::size_t most_neighbours = 200;

bool is_mount_point(const fs::path& folder) {
    struct statx status {};
    if (::statx(AT_FDCWD, folder.c_str(), 0, STATX_TYPE, &status) != 0) return true;
    if ((status.stx_attributes_mask & STATX_ATTR_MOUNT_ROOT) == 0) return true;  // an old kernel does not say
    return (status.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0;
}

/// This process is at work in `folder`, or below it.
bool holds_working_folder(const fs::path& folder) {
    std::error_code error;
    for (fs::path at = fs::current_path(error); !error; at = at.parent_path()) {
        if (fs::equivalent(at, folder, error)) return true;
        if (!at.has_relative_path()) return false;
    }
    return true;
}

/// The folder can be exchanged for another that has its files: nobody's work there is disturbed.
bool can_be_exchanged(const fs::path& folder, const fs::path& parent) {
    if (::access(parent.c_str(), W_OK | X_OK) != 0 || is_mount_point(folder) || holds_working_folder(folder)) {
        return false;
    }
    std::error_code error;
    std::size_t count = 0;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const fs::file_type type = entry->symlink_status(error).type();
        if (error || type == fs::file_type::directory || ++count > most_neighbours) return false;
        const std::string name = entry->path().filename();
        const bool table = is_run_table(name);
        if (table && type == fs::file_type::symlink) return false;
    }
    return !error;
}

/// A link from the folder to a table on another file system could not be followed by a rename.
void refuse_links_that_lead_away(const fs::path& target, const fs::path& folder) {
    struct stat here {};
    if (::stat(folder.c_str(), &here) != 0) return;
    for (const char* name : run_tables) {
        const fs::path table = target / name;
        const fs::path place = follow_links(folder / name);
        refuse_what_must_stay(table, place);
        struct stat there {};
        if (::stat(folder_of(place).c_str(), &there) == 0 && there.st_dev != here.st_dev) {
            fail_to_write(table,
                          "it is a symbolic link to another file system, where tables that appear together cannot be "
                          "moved to; remove the link, or make the folder itself the link");
        }
    }
}

/// Whoever moves tables to their places one by one does so alone.
class FolderLock {
public:
    explicit FolderLock(const fs::path& folder)
        : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
        constexpr int tries = 50;
        constexpr useconds_t pause = 10'000;  // us; in all less than anybody waits after Ctrl-C
        for (int i = 0; descriptor_ >= 0 && i < tries; ++i) {
            // Without locks (some network file systems) there is nothing to wait for.
            free_ = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
            if (free_) break;
            ::usleep(pause);
        }
    }
    ~FolderLock() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

    explicit operator bool() const { return free_; }

private:
    int descriptor_;
    bool free_ = true;
};

/// Gives `copy` a second name for everything in `folder` but the tables. False where that cannot be.
bool link_neighbours(const fs::path& folder, const fs::path& copy) {
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename();
        if (is_run_table(name)) continue;
        if (name.starts_with(".footfall-")) return false;  // another footfall is at work there
        if (::linkat(AT_FDCWD, entry->path().c_str(), AT_FDCWD, (copy / name).c_str(), 0) != 0) return false;
    }
    return !error;
}

/// What came into the old folder while the new one was made goes after the rest.
void fetch_latecomers(const fs::path& old, const fs::path& folder) {
    std::error_code error;
    for (fs::directory_iterator entry(old, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename();
        if (is_run_table(name)) continue;
        struct stat left {
        }, there{};
        const bool known = ::lstat((folder / name).c_str(), &there) == 0;
        if (::lstat(entry->path().c_str(), &left) != 0) continue;
        if (!known || left.st_ino != there.st_ino) (void)rename_entry(entry->path(), folder / name);
    }
}

}  // namespace

void check_tables(const fs::path& target) {
    std::error_code error;
    fs::path existing = fs::absolute(target, error);
    while (!fs::exists(existing, error) && existing.has_relative_path()) existing = existing.parent_path();
    if (!fs::is_directory(existing, error)) {
        fail_to_write(target, fmt::format("{} is not a folder", printable(existing.native())));
    }
    if (::access(existing.c_str(), W_OK | X_OK) != 0) {
        fail_to_write(target, fmt::format("the folder {}: {}", printable(existing.native()), describe(errno)));
    }
    if (fs::is_directory(target, error)) refuse_links_that_lead_away(target, fs::canonical(target, error));
}

AtomicTables::AtomicTables(const fs::path& target) : target_(target) {
    check_tables(target);
    std::error_code error;
    place_ = fs::weakly_canonical(fs::absolute(target, error), error);
    if (error) fail(error.value());
    if (!place_.has_filename() && place_.has_relative_path()) place_ = place_.parent_path();  // "DIR/"
    parent_ = place_.parent_path();
    exists_ = fs::is_directory(place_, error);
    if (!exists_) {
        std::vector<fs::path> missing;
        for (fs::path at = parent_; !fs::exists(at, error); at = at.parent_path()) missing.push_back(at);
        std::reverse(missing.begin(), missing.end());
        for (const fs::path& folder : missing) {
            fs::create_directory(folder, error);
            if (error) fail(error.value());
            made_.push_back(folder);
        }
    }
    if (exists_) {
        sweep(parent_);
        sweep(place_);
    }
    // The folder that appears has its rights from the umask, or from the older one.
    constexpr mode_t everybody = 0777, owner = 0700;
    if (!exists_) {
        temporary_ = temporary_in(target_, parent_, Temporary::Kind::folder, everybody);
        return;
    }
    exchangeable_ = can_be_exchanged(place_, parent_);
    if (exchangeable_) {
        temporary_ = temporary_in(target_, parent_, Temporary::Kind::folder, owner);
        exchangeable_ = adopt_rights(temporary_->descriptor(), place_);
    }
    if (!exchangeable_) temporary_ = temporary_in(target_, place_, Temporary::Kind::folder, owner);
}

AtomicTables::~AtomicTables() {
    for (const auto& [name, descriptor] : descriptors_) ::close(descriptor);
    temporary_.reset();
    if (taken_) return;
    for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder) ::rmdir(folder->c_str());
}

void AtomicTables::fail(int error) const { fail_to_write(target_, describe(error)); }

Writer AtomicTables::table(const char* name) {
    const fs::path place = place_ / name;
    std::error_code error;
    const bool replaces = exists_ && fs::exists(place, error);
    const int descriptor = ::open((temporary_->path() / name).c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC,
                                  replaces ? for_the_owner : for_everybody);
    if (descriptor < 0) fail_to_write(target_ / name, describe(errno));
    descriptors_[name] = descriptor;
    if (replaces) adopt_rights(descriptor, place);
    return {target_ / name, descriptor};
}

bool AtomicTables::exchange() {
    if (!exchangeable_ || !can_be_exchanged(place_, parent_)) return false;
    if (!link_neighbours(place_, temporary_->path()) || ::fsync(temporary_->descriptor()) != 0 ||
        temporary_->exchange(place_) != 0) {
        // The links do not go where the tables go now.
        std::error_code error;
        for (fs::directory_iterator entry(temporary_->path(), error), end; !error && entry != end;
             entry.increment(error)) {
            const std::string name = entry->path().filename();
            if (!is_run_table(name)) {
                ::unlink(entry->path().c_str());
            }
        }
        return false;
    }
    fetch_latecomers(temporary_->path(), place_);
    return true;
}

void AtomicTables::take_place() {
    const std::lock_guard hold(commit_mutex());
    if (!exists_) {
        const int error = temporary_->take(place_);
        taken_ = error == 0;
        if (taken_) return;
        // Another process may have made the folder meanwhile.
        if (error != ENOTEMPTY && error != EEXIST) fail_to_write(target_, why_no_rename(error));
    }
    taken_ = exchange();
    if (taken_) return;
    // One by one, out of a folder whose name says that they are complete: whoever comes next can go on.
    const FolderLock alone(place_);
    if (!alone) fail_to_write(target_, "another process is writing tables there");
    fs::path ready = place_ / temporary_->path().filename();
    ready.replace_extension(".ready");
    if (const int error = temporary_->move(ready); error != 0) fail_to_write(target_, why_no_rename(error));
    if (const int error = move_tables(ready, place_); error != 0) {
        struct stat entry {};
        const bool begun = ::lstat((ready / run_tables[0]).c_str(), &entry) != 0;
        if (!begun) fail_to_write(target_, why_no_rename(error));
        temporary_->leave();
        fail_to_write(target_, fmt::format("not every table is in its place, the rest is in {}: {}",
                                           printable(ready.native()), why_no_rename(error)));
    }
    taken_ = true;
}

void AtomicTables::settle() {
    sync(target_, place_);
    sync(target_, parent_);
}

}  // namespace footfall::io
