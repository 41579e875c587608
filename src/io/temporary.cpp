// Files and folders under temporary names, which nobody else touches while their process lives.
#include "io/temporary.hpp"

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <sys/xattr.h>
#include <unistd.h>

namespace footfall::io {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view unfinished = ".tmp";  ///< at the end of a name: of no use to anybody
constexpr std::string_view complete = ".ready";  ///< a folder whose tables are complete and go to their places

// Never destroyed: a thread that ends the program may need them while main returns.
struct Registry {
    std::recursive_mutex mutex;
    std::set<const Temporary*> live;
    bool any_taken = false;
};
Registry& registry() {
    static Registry& one = *new Registry;
    return one;
}

/// Tells this machine from others that see the same folder.
std::string host_mark() {
    std::string name;
    std::getline(std::ifstream("/etc/machine-id"), name);
    utsname system{};
    if (::uname(&system) == 0) name += system.nodename;
    std::uint32_t hash = 2166136261U;  // FNV-1a
    for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
    return fmt::format("{:08x}", hash);
}
const std::string& prefix() {
    static const std::string& one = *new std::string(".footfall-" + host_mark() + "-");
    return one;
}

template <class Call>
int again_where_interrupted(const Call& call) {
    int result = 0;
    do {
        result = call();
    } while (result == -1 && errno == EINTR);
    return result;
}

bool same_entry(const struct stat& a, const struct stat& b) { return a.st_dev == b.st_dev && a.st_ino == b.st_ino; }

/// The names in a folder; none where it cannot be read.
std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    const std::unique_ptr<DIR, int (*)(DIR*)> stream(::opendir(folder.c_str()), ::closedir);
    if (!stream) return names;
    while (const dirent* entry = ::readdir(stream.get())) {
        const std::string_view name = entry->d_name;
        if (name != "." && name != "..") names.emplace_back(name);
    }
    return names;
}

/// Opens what a process left, if it was this user's and nobody holds its lock; -1 otherwise.
int open_if_dead(const fs::path& left) {
    struct stat named {};
    if (::lstat(left.c_str(), &named) != 0 || named.st_uid != ::geteuid()) return -1;
    const bool folder = S_ISDIR(named.st_mode);
    if (!folder && !S_ISREG(named.st_mode)) return -1;
    const int how = (folder ? O_RDONLY | O_DIRECTORY : O_RDWR | O_NONBLOCK) | O_NOFOLLOW | O_CLOEXEC;
    const int descriptor = ::open(left.c_str(), how);
    if (descriptor < 0) return -1;
    struct stat opened {};
    // Another sweep may have been faster, and the name another file's by now.
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0 && ::fstat(descriptor, &opened) == 0 &&
        ::lstat(left.c_str(), &named) == 0 && same_entry(opened, named)) {
        return descriptor;
    }
    ::close(descriptor);
    return -1;
}

/// Copies an access list, or takes away one that the folder gave.
void adopt_access_list(const char* name, int descriptor, const fs::path& from) {
    std::vector<char> list(1 << 16);  // the longest value that an attribute has
    const ssize_t size = ::getxattr(from.c_str(), name, list.data(), list.size());
    if (size > 0) {
        (void)::fsetxattr(descriptor, name, list.data(), static_cast<std::size_t>(size), 0);
    } else {
        (void)::fremovexattr(descriptor, name);
    }
}

}  // namespace

std::recursive_mutex& commit_mutex() { return registry().mutex; }

Temporary::Temporary(const fs::path& folder, Kind kind, mode_t mode) : kind_(kind) {
    static std::atomic<unsigned> next = 0;
    const std::lock_guard hold(commit_mutex());  // no file is made without being known
    for (;;) {
        const fs::path candidate = folder / fmt::format("{}{}-{}{}", prefix(), ::getpid(), next++, unfinished);
        if (kind == Kind::folder && ::mkdir(candidate.c_str(), mode) != 0) {
            if (errno == EEXIST || errno == EINTR) continue;
            throw std::system_error(errno, std::generic_category());
        }
        const int how = kind == Kind::file ? O_RDWR | O_CREAT | O_EXCL : O_RDONLY | O_DIRECTORY;
        descriptor_ =
            again_where_interrupted([&] { return ::open(candidate.c_str(), how | O_NOFOLLOW | O_CLOEXEC, mode); });
        if (descriptor_ < 0) {
            const int error = errno;
            if (kind == Kind::file && error == EEXIST) continue;
            if (kind == Kind::folder) ::rmdir(candidate.c_str());
            throw std::system_error(error, std::generic_category());
        }
        path_ = candidate;
        if (lock()) break;
        ::close(descriptor_);
    }
    registry().live.insert(this);
}

bool Temporary::lock() {
    // A file system without locks has no sweeps either: nothing is known to be dead there.
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) return errno != EWOULDBLOCK;
    struct stat opened {
    }, named{};
    return ::fstat(descriptor_, &opened) == 0 && ::lstat(path_.c_str(), &named) == 0 && same_entry(opened, named);
}

Temporary::~Temporary() {
    const std::lock_guard hold(commit_mutex());
    registry().live.erase(this);
    if (!path_.empty()) {
        if (kind_ == Kind::file) {
            ::unlink(path_.c_str());
        } else {
            remove_folder(path_);
        }
    }
    ::close(descriptor_);
}

int Temporary::take(const fs::path& place) {
    const std::lock_guard hold(commit_mutex());
    if (const int error = rename_entry(path_, place); error != 0) return error;
    path_.clear();
    registry().any_taken = true;
    return 0;
}

int Temporary::exchange(const fs::path& place) {
    const std::lock_guard hold(commit_mutex());
    if (const int error = rename_entry(path_, place, RENAME_EXCHANGE); error != 0) return error;
    registry().any_taken = true;
    return 0;
}

int Temporary::move(const fs::path& to) {
    const std::lock_guard hold(commit_mutex());
    if (const int error = rename_entry(path_, to); error != 0) return error;
    path_ = to;
    return 0;
}

void Temporary::leave() {
    const std::lock_guard hold(commit_mutex());
    path_.clear();
}

bool discard_temporaries() {
    commit_mutex().lock();  // for ever
    for (const Temporary* one : registry().live) {
        if (one->path_.empty()) continue;
        if (one->kind_ == Temporary::Kind::file) {
            ::unlink(one->path_.c_str());
        } else {
            remove_folder(one->path_);
        }
    }
    return registry().any_taken;
}

/// Removes from a folder of complete tables those that were written again in their place since.
static void drop_overtaken(const fs::path& ready, const fs::path& folder) {
    for (const char* table : run_tables) {
        struct stat kept {
        }, there{};
        if (::lstat((ready / table).c_str(), &kept) != 0 || ::stat((folder / table).c_str(), &there) != 0) continue;
        const bool newer = there.st_mtim.tv_sec != kept.st_mtim.tv_sec ? there.st_mtim.tv_sec > kept.st_mtim.tv_sec
                                                                       : there.st_mtim.tv_nsec > kept.st_mtim.tv_nsec;
        if (newer) ::unlink((ready / table).c_str());
    }
}

void sweep(const fs::path& folder) noexcept {
    try {
        for (const std::string& name : names_in(folder)) {
            if (!name.starts_with(prefix())) continue;
            const bool ready = name.ends_with(complete);
            if (!ready && !name.ends_with(unfinished)) continue;
            const fs::path left = folder / name;
            const int descriptor = open_if_dead(left);
            if (descriptor < 0) continue;
            struct stat entry {};
            if (::fstat(descriptor, &entry) == 0 && S_ISREG(entry.st_mode)) {
                ::unlink(left.c_str());
            } else if (ready) {
                drop_overtaken(left, folder);
                move_tables(left, folder);
            } else {
                remove_folder(left);
            }
            ::close(descriptor);
        }
    } catch (const std::exception&) {  // what is left over is no reason not to write
    }
}

int move_tables(const fs::path& ready, const fs::path& folder) {
    for (const char* table : run_tables) {
        struct stat entry {};
        if (::lstat((ready / table).c_str(), &entry) != 0) continue;  // it is in its place
        fs::path place = folder / table;
        struct stat there {};
        if (::lstat(place.c_str(), &there) == 0 && S_ISLNK(there.st_mode)) {
            std::error_code error;
            place = fs::canonical(place, error);
            if (error) return error.value();
        }
        const std::lock_guard hold(commit_mutex());
        if (const int failed = rename_entry(ready / table, place); failed != 0) return failed;
        registry().any_taken = true;
    }
    ::rmdir(ready.c_str());
    return 0;
}

void remove_folder(const fs::path& folder) noexcept {
    try {
        for (const std::string& name : names_in(folder)) {
            const fs::path entry = folder / name;
            struct stat status {};
            if (::lstat(entry.c_str(), &status) != 0 || S_ISDIR(status.st_mode)) continue;
            if (is_run_table(name) || status.st_nlink > 1) ::unlink(entry.c_str());
        }
        ::rmdir(folder.c_str());
    } catch (const std::exception&) {  // it is swept another time
    }
}

int rename_entry(const fs::path& from, const fs::path& to, unsigned flags) {
    const int result = again_where_interrupted([&] {
        return flags == 0 ? ::rename(from.c_str(), to.c_str())
                          : ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), flags);
    });
    return result == 0 ? 0 : errno;
}

int sync_folder(const fs::path& folder) {
    const int descriptor = again_where_interrupted(
        [&] { return ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
    if (descriptor < 0) return errno == EACCES ? 0 : errno;  // one may write into a folder that one may not read
    const int result = again_where_interrupted([&] { return ::fsync(descriptor); });
    const int error = result == 0 || errno == EINVAL || errno == ENOTSUP ? 0 : errno;
    ::close(descriptor);
    return error;
}

bool adopt_rights(int descriptor, const fs::path& from) {
    struct stat old {
    }, made{};
    if (::stat(from.c_str(), &old) != 0 || ::fstat(descriptor, &made) != 0) return false;
    bool group_kept = old.st_gid == made.st_gid;
    if (!group_kept) group_kept = ::fchown(descriptor, static_cast<uid_t>(-1), old.st_gid) == 0;
    bool owner_kept = old.st_uid == made.st_uid;
    if (!owner_kept) owner_kept = ::fchown(descriptor, old.st_uid, static_cast<gid_t>(-1)) == 0;
    if (group_kept) {
        adopt_access_list("system.posix_acl_access", descriptor, from);
        if (S_ISDIR(made.st_mode)) adopt_access_list("system.posix_acl_default", descriptor, from);
    }
    mode_t mode = old.st_mode & 07777U;
    if (!group_kept) mode &= ~static_cast<mode_t>(070) | ((mode & 07U) << 3U);
    if (!group_kept || !owner_kept) mode &= ~static_cast<mode_t>(S_ISUID | S_ISGID);
    if (::fchmod(descriptor, mode) != 0) return false;
    return owner_kept && group_kept;
}

}  // namespace footfall::io
