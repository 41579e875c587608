// What the program shares with the person at the terminal: output, interruption, a progress bar.
#include "terminal.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <mutex>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include "commands.hpp"
#include "footfall/io/printable.hpp"
#include "footfall/io/staged_files.hpp"

namespace footfall::cli {
namespace {

using namespace std::chrono_literals;

/// Returns 0, or the error.
int write_all(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = ::write(descriptor, text.data(), text.size());
        if (written >= 0) {
            text.remove_prefix(static_cast<std::size_t>(written));
        } else if (errno == EAGAIN) {  // somebody has made the stream one that does not wait
            pollfd stream{descriptor, POLLOUT, 0};
            (void)::poll(&stream, 1, -1);
        } else if (errno != EINTR) {
            return errno;
        }
    }
    return 0;
}

// Never destroyed: the thread that ends the program may need it while main returns.
struct Shared {
    std::timed_mutex mutex;  ///< held by who writes to standard error
    std::string work;        ///< what work_on was told
    bool bar = false;        ///< a progress bar is shown
    bool broken_pipe_ends = false;
};
Shared& shared() {
    static Shared& one = *new Shared;
    return one;
}

constexpr const char* clear_line = "\r\033[K";

/// Waits for a signal and ends the program. Unlike a handler, a thread may wait for files that take their places.
void wait_for_signal(const sigset_t& signals) {
    int signal = 0;
    if (sigwait(&signals, &signal) != 0) return;
    // Whatever keeps this from its end (a network file system that hangs), a second signal does not wait for.
    std::signal(signal, SIG_DFL);
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);

    const bool written = discard_staged_files();
    constexpr auto patience = 100ms;  // somebody may be stuck in writing there
    const bool alone = shared().mutex.try_lock_for(patience);
    std::string text = alone && shared().bar ? clear_line : "";
    text += "footfall: ";
    if (alone && !shared().work.empty()) text += printable(shared().work) + ": ";
    text += written ? "interrupted; the files were written already\n" : "interrupted; nothing was written\n";
    pollfd screen{STDERR_FILENO, POLLOUT, 0};
    if (::poll(&screen, 1, static_cast<int>(patience.count())) == 1) (void)write_all(STDERR_FILENO, text);
    ::_exit(ExitCode::signalled + signal);
}

}  // namespace

void open_standard_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(stream, F_GETFD) != -1) continue;
        // The wrong way round, so that using it is an error as before. The lowest number that is free is this one.
        (void)::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    }
}

namespace {

void put(std::string_view text) {
    const int error = write_all(STDOUT_FILENO, text);
    if (error == 0) return;
    if (error == EPIPE && shared().broken_pipe_ends) {
        std::signal(SIGPIPE, SIG_DFL);
        (void)std::raise(SIGPIPE);
    }
    throw std::runtime_error("cannot write to standard output: " + (error == EBADF ? "it is closed"
                                                                    : error == EPIPE
                                                                        ? "nobody reads it any more"
                                                                        : std::generic_category().message(error)));
}

}  // namespace

void print(std::string_view text) { put(printable_lines(text)); }

void print_as_it_is(std::string_view text) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    if (::isatty(STDOUT_FILENO) == 1) return print(text);
    put(text);
}

void print_page(std::string page, std::span<const std::filesystem::path> written) {
    if (!written.empty()) page += "\nWritten\n";
    for (const std::filesystem::path& file : written) page += fmt::format("  {}\n", printable(file.native()));
    print(page);
}

void say(std::string_view text) {
    const std::lock_guard alone(shared().mutex);
    (void)write_all(STDERR_FILENO, printable_lines(text));
}

void end_on_signals() {
    std::signal(SIGXFSZ, SIG_IGN);
    shared().broken_pipe_ends = std::signal(SIGPIPE, SIG_IGN) != SIG_IGN;
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction now {};
        if (sigaction(signal, nullptr, &now) == 0 && now.sa_handler != SIG_IGN) sigaddset(&signals, signal);
    }
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);  // in every thread that is made from here on
    try {
        std::thread(wait_for_signal, signals).detach();
    } catch (const std::system_error&) {
        // No thread to be had: signals end the program as they end any, and the next write sweeps up.
        pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
    }
}

void work_on(const std::filesystem::path& file) {
    const std::lock_guard alone(shared().mutex);
    shared().work = file.native();
}

ProgressBar::ProgressBar(double end, bool wanted) : end_(end), wanted_(wanted && ::isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::update(double time) {
    if (!wanted_) return;
    const Clock::time_point now = Clock::now();
    if (now - start_ < 1s || now - last_ < 100ms) return;
    last_ = now;

    constexpr int length = 40;
    const double done = std::clamp(time / end_, 0.0, 1.0);
    const int full = static_cast<int>(done * length);
    std::string bar;
    for (int i = 0; i < length; ++i) bar += i < full ? "█" : "░";
    std::string rest;
    if (done > 0) {
        const double elapsed = std::chrono::duration<double>(now - start_).count();
        rest = fmt::format(", about {:.0f} s left", elapsed * (1 - done) / done);
    }
    const std::lock_guard alone(shared().mutex);
    shared().bar = true;
    (void)write_all(STDERR_FILENO,
                    fmt::format("\r{} {:3.0f} %  {:.4g} of {:.4g} s{}\033[K", bar, 100 * done, time, end_, rest));
}

void ProgressBar::clear() {
    const std::lock_guard alone(shared().mutex);
    if (!shared().bar) return;
    (void)write_all(STDERR_FILENO, clear_line);
    shared().bar = false;
}

}  // namespace footfall::cli
