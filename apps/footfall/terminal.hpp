// What the program shares with the person at the terminal: output, interruption, a progress bar.
#pragma once

#include <chrono>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace footfall::cli {

/// Gives the program the three standard streams where its caller closed one: writing to it fails, and no file that is
/// opened later takes its number and with it what is said there. Call first.
void open_standard_streams();

/// Prints text to standard output, line by line as a terminal may have it. Throws std::runtime_error where it cannot be
/// written; where its reader has gone, the program ends as SIGPIPE ends one.
void print(std::string_view text);

/// Prints a file's text for another file, byte for byte but for a byte order mark; on a terminal as print does.
void print_as_it_is(std::string_view text);

/// Prints a page and, under it, the names of the files that were written, if there are any. Throws as print does.
void print_page(std::string page, std::span<const std::filesystem::path> written);

/// Prints a line, or lines, to standard error, as a terminal may have them. Where nobody listens, nothing happens.
void say(std::string_view text);

/// From here on SIGINT, SIGTERM and SIGHUP end the program at once, at any moment, with 128 and the signal's number:
/// what is under temporary names is removed, and files take their places all or not at all. One that was ignored stays
/// so. A write to a pipe that nobody reads, or to a file that may not grow, is an error and no signal. Call once.
void end_on_signals();

/// What the message of an interruption begins with: the file that is being worked on.
void work_on(const std::filesystem::path& file);

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
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_ = start_;
};

}  // namespace footfall::cli
