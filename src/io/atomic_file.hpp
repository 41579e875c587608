// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace footfall {

/// Writes under a temporary name beside the target, and takes the target's place when the content is complete.
/// Until then an older file of that name stays as it is; without `commit` nothing remains.
class AtomicFile {
public:
    /// Creates the temporary file. Throws std::runtime_error, naming the target, where that cannot be done or where
    /// the target is something that must not be replaced.
    explicit AtomicFile(const std::filesystem::path& target);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Appends bytes. Throws std::runtime_error, naming the target.
    void write(std::string_view bytes);

    /// Brings the content to the disk. Throws std::runtime_error, naming the target.
    void finish();

    /// Gives the finished content the target's name. Throws std::runtime_error, naming the target.
    void commit();

    /// Throws std::runtime_error: "cannot write TARGET: reason".
    [[noreturn]] void fail(std::string_view reason) const;

private:
    std::filesystem::path target_;
    std::filesystem::path place_;  ///< the target with symbolic links followed
    std::filesystem::path temporary_;
    int descriptor_ = -1;
};

/// Throws std::runtime_error: "cannot write TARGET: reason".
[[noreturn]] void fail_to_write(const std::filesystem::path& target, std::string_view reason);

}  // namespace footfall
