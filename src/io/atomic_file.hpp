// Files and folders that appear whole or not at all.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/temporary.hpp"

namespace footfall::io {

/// Something complete under a temporary name.
class Staged {
public:
    virtual ~Staged() = default;
    /// Gives it its place. Throws std::runtime_error, naming the target.
    virtual void take_place() = 0;
    /// Brings the place to the disk. Throws std::runtime_error, naming the target.
    virtual void settle() = 0;
};

/// An open file that is being filled; it belongs to somebody else. Messages name `target`.
class Writer {
public:
    Writer(std::filesystem::path target, int descriptor) : target_(std::move(target)), descriptor_(descriptor) {}

    /// Appends bytes. Throws std::runtime_error, naming the target.
    void write(std::string_view bytes);
    /// Brings the content to the disk. Throws std::runtime_error, naming the target.
    void finish();
    [[nodiscard]] const std::filesystem::path& target() const { return target_; }

private:
    std::filesystem::path target_;
    int descriptor_;
};

/// Writes under a temporary name beside the target, and takes the target's place when the content is complete, with
/// the rights of what was there. Until then an older file of that name stays as it is.
class AtomicFile : public Staged {
public:
    /// Creates the temporary file. Throws std::runtime_error, naming the target, where that cannot be done or where
    /// the target is something that must not be replaced.
    explicit AtomicFile(const std::filesystem::path& target);

    [[nodiscard]] Writer writer() const { return {target_, temporary_->descriptor()}; }
    void take_place() override;
    void settle() override;

private:
    std::filesystem::path target_;
    std::filesystem::path place_;  ///< the target with symbolic links followed
    std::unique_ptr<Temporary> temporary_;
};

/// The folder of a run's tables, which appear together: see docs/cli.md, "Files that are written".
class AtomicTables : public Staged {
public:
    /// Makes a temporary folder for them, and the folders above the target that are missing. Throws
    /// std::runtime_error, naming the target.
    explicit AtomicTables(const std::filesystem::path& target);
    ~AtomicTables() override;
    AtomicTables(const AtomicTables&) = delete;
    AtomicTables& operator=(const AtomicTables&) = delete;

    /// Makes one of run_tables. Throws std::runtime_error, naming it.
    [[nodiscard]] Writer table(const char* name);
    void take_place() override;
    void settle() override;

private:
    bool exchange();
    [[noreturn]] void fail(int error) const;

    std::filesystem::path target_;
    std::filesystem::path place_;              ///< the target with symbolic links followed
    std::filesystem::path parent_;             ///< that of the place
    std::vector<std::filesystem::path> made_;  ///< folders that were missing, outermost first
    bool exists_ = false;
    bool exchangeable_ = false;  ///< there is nothing in the place that an exchange would harm
    bool taken_ = false;
    std::unique_ptr<Temporary> temporary_;
    std::map<std::string, int> descriptors_;
};

/// Throws what AtomicTables would throw for a folder that cannot be made or written, and makes nothing.
void check_tables(const std::filesystem::path& target);

/// Throws std::runtime_error: "cannot write TARGET: reason".
[[noreturn]] void fail_to_write(const std::filesystem::path& target, std::string_view reason);

/// What `work` returns; where the memory does not suffice for it, throws std::runtime_error that says what was being
/// written and how to make it smaller.
template <class Work>
auto within_memory(const std::filesystem::path& target, std::string_view remedy, const Work& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        fail_to_write(target, "the memory does not suffice to prepare it; " + std::string(remedy));
    }
}

}  // namespace footfall::io
