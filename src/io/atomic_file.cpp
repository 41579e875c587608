// Files that appear whole or not at all.
#include "io/atomic_file.hpp"

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace footfall {
namespace fs = std::filesystem;
namespace {

std::string describe(int error) { return std::generic_category().message(error); }

/// The folder that the target stands in.
fs::path folder_of(const fs::path& target) { return target.has_parent_path() ? target.parent_path() : fs::path("."); }

fs::path follow_links(const fs::path& target) {
    std::error_code error;
    if (!fs::is_symlink(target, error)) return target;
    fs::path place = fs::canonical(target, error);
    if (error) fail_to_write(target, "it is a symbolic link that leads to no file");
    return place;
}

}  // namespace

void fail_to_write(const fs::path& target, std::string_view reason) {
    throw std::runtime_error(fmt::format("cannot write {}: {}", target.string(), reason));
}

AtomicFile::AtomicFile(const fs::path& target) : target_(target), place_(follow_links(target)) {
    if (!place_.has_filename()) fail("it names a folder, not a file");
    std::error_code error;
    const fs::path folder = folder_of(place_);
    const fs::file_status folder_status = fs::status(folder, error);
    if (!fs::exists(folder_status)) fail(fmt::format("the folder {} does not exist", folder.string()));
    if (!fs::is_directory(folder_status)) fail(fmt::format("{} is not a folder", folder.string()));

    // Renaming over a device or a pipe would replace it, and a write-protected file is protected for a reason.
    const fs::file_status status = fs::status(place_, error);
    if (fs::is_directory(status)) fail("it is a folder");
    if (fs::exists(status)) {
        if (!fs::is_regular_file(status)) fail("it is not a regular file");
        if (::access(place_.c_str(), W_OK) != 0) fail(describe(errno));
    }

    for (int attempt = 0; temporary_.empty(); ++attempt) {
        const fs::path candidate = folder / fmt::format(".footfall-{}-{}.tmp", ::getpid(), attempt);
        descriptor_ = ::open(candidate.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ >= 0) {
            temporary_ = candidate;
        } else if (errno != EEXIST) {
            fail(fmt::format("no file can be made in the folder {}: {}", folder.string(), describe(errno)));
        }
    }
}

AtomicFile::~AtomicFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written >= 0) {
            bytes.remove_prefix(static_cast<std::size_t>(written));
        } else if (errno != EINTR) {
            fail(describe(errno));
        }
    }
}

void AtomicFile::finish() {
    // Without this a crash of the machine could leave the new name with no content.
    if (::fsync(descriptor_) != 0) fail(describe(errno));
    if (::close(std::exchange(descriptor_, -1)) != 0) fail(describe(errno));
}

void AtomicFile::commit() {
    if (::rename(temporary_.c_str(), place_.c_str()) != 0) fail(describe(errno));
    temporary_.clear();
}

void AtomicFile::fail(std::string_view reason) const { fail_to_write(target_, reason); }

}  // namespace footfall
