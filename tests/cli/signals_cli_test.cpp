// Whatever the program is at, a signal ends it within a second, and nothing is half written.
#include <chrono>
#include <csignal>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/program.hpp"

namespace footfall::test {
namespace {

using namespace std::chrono_literals;
using Words = std::vector<std::string>;

class SignalsCli : public ProgramTest {
protected:
    /// The exit code where `signal` comes after `delay`; what is said goes to `err`.
    Result ended(const Words& words, int signal, std::chrono::milliseconds delay, bool ignored = false) const {
        const std::string err = (folder / ".err").string();
        const pid_t child = ::fork();
        if (child == 0) {
            for (const int each : {SIGINT, SIGTERM, SIGHUP}) std::signal(each, SIG_DFL);
            if (ignored) std::signal(signal, SIG_IGN);
            if (::chdir(folder.path().c_str()) != 0) ::_exit(99);
            ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
            ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
            std::vector<char*> arguments{const_cast<char*>("footfall")};
            for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
            arguments.push_back(nullptr);
            ::execv(FOOTFALL_CLI, arguments.data());
            ::_exit(98);
        }
        std::this_thread::sleep_for(delay);
        const auto sent = std::chrono::steady_clock::now();
        ::kill(child, signal);
        if (ignored) {
            std::this_thread::sleep_for(300ms);
            EXPECT_EQ(::waitpid(child, nullptr, WNOHANG), 0) << "it went on";
            ::kill(child, SIGTERM);
        }
        int status = 0;
        EXPECT_EQ(::waitpid(child, &status, 0), child);
        EXPECT_LT(std::chrono::steady_clock::now() - sent, ignored ? 2s : 1s);
        EXPECT_TRUE(WIFEXITED(status)) << "it ended itself";
        Result result{exit_code_of(status), "", read_text(err)};
        std::filesystem::remove(err);
        return result;
    }
};

const std::string normal = "azad-featherstone:stiffness=8.5e6,damping=3.1e3";
const std::string friction = "azad-featherstone:stiffness=12.75e6,damping=3.1e3,coefficient=0.2";

TEST_F(SignalsCli, EveryCommandEndsWithinASecond) {
    folder.write("rig.toml", R"([rig]
end = 1e4
max_evaluations = 1e12
load = [{ shape = "constant", value = 10 }]
displacement = [{ shape = "sine", amplitude = 1e-4, frequency = 50, direction = 0 }]
[contact.normal]
law = "hertz"
stiffness = 1e8
[contact.friction]
law = "dahl"
stiffness = 1e4
coefficient = 0.4
)");
    std::string data = "angle,tangential_restitution\n";
    for (int i = 1; i < 2000; ++i) data += std::to_string(i * 0.04) + ",0.7\n";
    folder.write("rebounds.csv", data);
    folder.write("o.csv", "older");
    ASSERT_EQ(::mkfifo((folder / "never").c_str(), 0600), 0);
    const Words oblique{"oblique",  "--radius", "2.5mm",      "--density", "4000",  "--speed", "3.9",
                        "--normal", normal,     "--friction", friction,    "--csv", "o.csv"};
    const auto with = [](Words words, const Words& more) {
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };
    const std::vector<Words> all{
        {"restitution", "--mass", "0.154", "--normal", normal, "--points", "100000", "--csv", "o.csv"},
        with(oblique, {"--angles", "0..85:0.0005"}),
        with(oblique, {"--fit", "rebounds.csv", "--vary", "friction.coefficient,friction.stiffness"}),
        {"drive", "rig.toml", "--csv", "o.csv"},
        {"run", "never"},  // nobody writes into this pipe
        {"fit", "never", "--mass", "1", "--normal", "hertz:stiffness=?"},
    };
    for (const Words& words : all) {
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
            const Result result = ended(words, signal, 300ms);
            EXPECT_EQ(result.exit_code, 128 + signal) << ::testing::PrintToString(words) << result.err;
            EXPECT_TRUE(contains(result.err, "interrupted; nothing was written")) << result.err;
            EXPECT_EQ(read_text(folder / "o.csv"), "older");
            EXPECT_EQ(folder.names(), (std::set<std::string>{"never", "o.csv", "rebounds.csv", "rig.toml"}));
        }
    }
}

TEST_F(SignalsCli, ASignalThatWasIgnoredStaysSo) {
    ASSERT_EQ(::mkfifo((folder / "never").c_str(), 0600), 0);
    EXPECT_EQ(ended({"run", "never"}, SIGHUP, 200ms, true).exit_code, 143) << "as nohup wants it";
    EXPECT_EQ(ended({"run", "never"}, SIGINT, 200ms, true).exit_code, 143) << "as a shell wants it in the background";
}

TEST_F(SignalsCli, WritingIsInterruptedToo) {
    folder.write("a.toml", elastic_ball("0.5", "1e-6", "1e-6"));
    folder.write("a.nc", "older");
    // The run itself is short: most of these come while tables or NetCDF are being written.
    for (const auto delay : {300ms, 600ms, 900ms, 1200ms}) {
        const Result result = ended({"run", "a.toml", "-q", "-o", "a.nc", "--csv", "tables"}, SIGTERM, delay);
        EXPECT_EQ(result.exit_code, 143) << delay.count() << result.err;
        EXPECT_EQ(folder.names(), (std::set<std::string>{"a.nc", "a.toml"}));
        EXPECT_EQ(read_text(folder / "a.nc"), "older");
    }
}

}  // namespace
}  // namespace footfall::test
