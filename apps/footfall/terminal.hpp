// What the program shares with the person at the terminal: output, interruption, a progress bar.
#pragma once

#include <chrono>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace footfall::cli {

/// Prints to standard output. Throws std::runtime_error where it cannot be written.
void print(std::string_view text);

/// Prints a page and, under it, the names of the files that were written, if there are any. Throws as print does.
void print_page(std::string page, std::span<const std::filesystem::path> written);

/// While it lives, SIGINT and SIGTERM are remembered instead of ending the program; a second one ends it.
class SignalGuard {
public:
    SignalGuard();
    ~SignalGuard();
    SignalGuard(const SignalGuard&) = delete;
    SignalGuard& operator=(const SignalGuard&) = delete;

    /// The signal that has come, or 0.
    [[nodiscard]] static int received() noexcept;
};

/// A bar on standard error, if that is a terminal, for what takes longer than a second. It leaves nothing behind.
class ProgressBar {
public:
    /// `end` is the time at which the run ends [s].
    ProgressBar(double end, bool wanted);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// The run has reached `time` [s].
    void update(double time);
    void clear();

private:
    using Clock = std::chrono::steady_clock;
    double end_;
    bool wanted_;
    bool shown_ = false;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_ = start_;
};

}  // namespace footfall::cli
