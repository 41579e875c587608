// What the program shares with the person at the terminal: output, interruption, a progress bar.
#include "terminal.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

namespace footfall::cli {
namespace {

volatile std::sig_atomic_t received_signal = 0;

void remember(int signal) { received_signal = signal; }

void handle(int signal, void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    sigemptyset(&action.sa_mask);
    // After the first one the default returns, so that a second one always ends the program.
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
    sigaction(signal, &action, nullptr);
}

}  // namespace

void print(std::string_view text) {
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    if (!written) {
        throw std::runtime_error("cannot write to standard output: " + std::generic_category().message(errno));
    }
}

void print_page(std::string page, std::span<const std::filesystem::path> written) {
    if (!written.empty()) page += "\nWritten\n";
    for (const std::filesystem::path& file : written) page += fmt::format("  {}\n", file.string());
    print(page);
}

SignalGuard::SignalGuard() {
    received_signal = 0;
    handle(SIGINT, remember);
    handle(SIGTERM, remember);
}

SignalGuard::~SignalGuard() {
    handle(SIGINT, SIG_DFL);
    handle(SIGTERM, SIG_DFL);
}

int SignalGuard::received() noexcept { return received_signal; }

ProgressBar::ProgressBar(double end, bool wanted) : end_(end), wanted_(wanted && ::isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::update(double time) {
    using namespace std::chrono_literals;
    if (!wanted_) return;
    const Clock::time_point now = Clock::now();
    if (now - start_ < 1s || now - last_ < 100ms) return;
    last_ = now;
    shown_ = true;

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
    fmt::print(stderr, "\r{} {:3.0f} %  {:.4g} of {:.4g} s{}\033[K", bar, 100 * done, time, end_, rest);
    std::fflush(stderr);
}

void ProgressBar::clear() {
    if (!shown_) return;
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
    shown_ = false;
}

}  // namespace footfall::cli
