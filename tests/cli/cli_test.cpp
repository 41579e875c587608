// The program itself: exit codes, what goes to which stream, interruption.
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <regex>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/program.hpp"
#include "footfall/law/registry.hpp"
#include "footfall/version.hpp"

extern char** environ;

namespace footfall::test {
namespace {

using Words = std::vector<std::string>;

/// The ball of the paper's section 4 without friction; `time` is the table [time].
std::string scenario(const std::string& time = "end = 0.15\nsample = 1e-3\n", const std::string& solver = "",
                     const std::string& damping = "3.1e3") {
    return "title = \"A ball\"\n[time]\n" + time + "[solver]\ntolerance = 1e-9\n" + solver +
           "[body]\nmass = \"154 g\"\ninertia = \"solid-sphere\"\n"
           "[[body.spheres]]\nradius = \"1.65 cm\"\n"
           "[body.initial]\nposition = [0, 0, 0.10]\nvelocity = [0.5, 0.5, 0]\n"
           "[contact.normal]\nlaw = \"azad-featherstone\"\nstiffness = 8.5e6\ndamping = " +
           damping + "\n";
}

/// Bounces without loss for longer than anyone waits.
const std::string endless = scenario("end = 1e5\nsample = 0\n", "max_evaluations = 1e15\n", "0");

/// A terminal, whose screen the test reads.
class Terminal {
public:
    Terminal() { EXPECT_EQ(::openpty(&screen_, &inside_, nullptr, nullptr, nullptr), 0); }
    ~Terminal() {
        leave();
        ::close(screen_);
    }
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    [[nodiscard]] int inside() const { return inside_; }
    /// After this, the program alone has the terminal, and the screen ends with it.
    void leave() {
        if (inside_ >= 0) ::close(std::exchange(inside_, -1));
    }
    /// All that has been shown until `words` came up, or until the program ended.
    const std::string& read_until(std::string_view words) {
        char buffer[4096];
        while (!contains(shown_, words)) {
            const ssize_t count = ::read(screen_, buffer, sizeof buffer);
            if (count <= 0) break;
            shown_.append(buffer, static_cast<std::size_t>(count));
        }
        return shown_;
    }

private:
    int screen_ = -1, inside_ = -1;
    std::string shown_;
};

class Cli : public ::testing::Test {
protected:
    TemporaryFolder folder;

    /// Starts the program with its streams in files, or with standard error on `terminal`.
    pid_t start(const Words& words, int terminal = -1) const {
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        const std::string out = (folder / ".out").string(), err = (folder / ".err").string();
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        if (terminal >= 0) posix_spawn_file_actions_adddup2(&actions, terminal, STDERR_FILENO);
        Words owned{FOOTFALL_CLI};
        owned.insert(owned.end(), words.begin(), words.end());
        std::vector<char*> arguments;
        for (std::string& word : owned) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        // What runs the tests in the background may ignore Ctrl-C, and the program would go on doing so.
        posix_spawnattr_t attributes;
        posix_spawnattr_init(&attributes);
        sigset_t asked;
        sigemptyset(&asked);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&asked, signal);
        posix_spawnattr_setsigdefault(&attributes, &asked);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
        pid_t child = -1;
        EXPECT_EQ(posix_spawn(&child, FOOTFALL_CLI, &actions, &attributes, arguments.data(), environ), 0);
        posix_spawnattr_destroy(&attributes);
        posix_spawn_file_actions_destroy(&actions);
        return child;
    }

    Result finish(pid_t child) const {
        int status = 0;
        EXPECT_EQ(::waitpid(child, &status, 0), child);
        Result result{exit_code_of(status), read_text(folder / ".out"), read_text(folder / ".err")};
        std::filesystem::remove(folder / ".out");
        std::filesystem::remove(folder / ".err");
        return result;
    }

    Result footfall(const Words& words) const { return finish(start(words)); }
};

TEST_F(Cli, PrintsItsVersionEverywhere) {
    // The commit is that of the clone, if there is one.
    const std::regex line("footfall " + std::string(version) + R"(( \([0-9a-f]{9}\+?\))?\n)");
    for (const Words& words :
         {Words{"--version"}, {"run", "--version"}, {"laws", "--version"}, {"schema", "--version"}}) {
        const Result result = footfall(words);
        EXPECT_EQ(result.exit_code, 0);
        EXPECT_TRUE(std::regex_match(result.out, line)) << result.out;
        EXPECT_EQ(result.err, "");
    }
}

// A run of a machine's memory is refused as any other that costs too much, and a deep key does not end the program.
TEST_F(Cli, InputsWithoutMeasureEndWithAMessage) {
    const std::string dense = folder.write("dense.toml", scenario("end = 1\nsample = 1e-12\n")).string();
    const Result refused = footfall({"run", dense, "--json"});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_TRUE(contains(refused.err, dense + ": the run would keep about")) << refused.err;
    EXPECT_TRUE(contains(refused.err, "raise max_memory")) << refused.err;

    std::string deep = "a";
    for (int i = 0; i < 40'000; ++i) deep += ".a";
    const Result nested = footfall({"run", folder.write("deep.toml", deep + " = 1\n").string()});
    EXPECT_EQ(nested.exit_code, 2);
    EXPECT_TRUE(contains(nested.err, "deep.toml:1:66: nested deeper")) << nested.err;

    const Result zeros = footfall({"run", "/dev/zero"});
    EXPECT_EQ(zeros.exit_code, 2);
    EXPECT_TRUE(contains(zeros.err, "16 MiB are the most")) << zeros.err;
}

TEST_F(Cli, HelpsEverywhereAndDocumentsItsExitCodes) {
    for (const Words& words : {Words{"--help"}, {"run", "--help"}, {"laws", "--help"}, {"schema", "--help"}}) {
        const Result result = footfall(words);
        EXPECT_EQ(result.exit_code, 0);
        EXPECT_TRUE(contains(result.out, "Exit codes:")) << result.out;
        EXPECT_EQ(result.err, "");
    }
    EXPECT_TRUE(contains(footfall({"run", "--help"}).out, "--csv DIR"));
}

TEST_F(Cli, WrongUsageExitsWithTwoAndSaysWhy) {
    const std::string file = folder.write("ball.toml", scenario()).string();
    for (const Words& words : {Words{},
                               {"walk"},
                               {"run"},
                               {"run", file, "--speed"},
                               {"run", file, "--csv"},
                               {"run", file, "--json", "--quiet"},
                               {"run", file, "--tolerance", "small"},
                               {"schema", "extra"}}) {
        const Result result = footfall(words);
        EXPECT_EQ(result.exit_code, 2) << ::testing::PrintToString(words);
        EXPECT_EQ(result.out, "");
        EXPECT_EQ(result.err.find("footfall: "), 0U) << result.err;
    }
    EXPECT_TRUE(contains(footfall({"walk"}).err, "walk"));
}

TEST_F(Cli, AScenarioErrorExitsWithTwoAndNamesItsPlace) {
    const std::string text = scenario("end = 0.15\nsampel = 1e-3\n");
    const std::string file = folder.write("ball.toml", text).string();
    const Result result = footfall({"run", file});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err.find("footfall: " + file + ":4:1: "), 0U) << result.err;
    EXPECT_TRUE(contains(result.err, "sample")) << result.err;
}

TEST_F(Cli, AMissingScenarioExitsWithTwo) {
    const Result result = footfall({"run", (folder / "none.toml").string()});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.err.find("footfall: "), 0U) << result.err;
    EXPECT_TRUE(contains(result.err, "none.toml")) << result.err;
}

TEST_F(Cli, AToleranceOutOfRangeExitsWithTwo) {
    const std::string file = folder.write("ball.toml", scenario()).string();
    const Result result = footfall({"run", file, "--tolerance", "0.5"});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.err.find("footfall: --tolerance: '0.5' is not allowed: must be from 1e-14 to 1e-3"), 0U)
        << result.err;
}

TEST_F(Cli, TheSummaryGoesToStandardOutput) {
    const std::string file = folder.write("ball.toml", scenario()).string();
    const Result result = footfall({"run", file});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(result.out.find("A ball\n"), 0U);
    for (const char* part : {"Events", "touchdown", "Impacts", "At the end", "Energy", "Cost"}) {
        EXPECT_TRUE(contains(result.out, part)) << part;
    }
}

TEST_F(Cli, JsonIsAllThereIsOnStandardOutput) {
    const std::string file = folder.write("ball.toml", scenario()).string();
    const Result result = footfall({"run", file, "--json", "-o", (folder / "ball.nc").string()});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    const Json json = Json::parse(result.out);
    Words names;
    for (const auto& item : json.items()) names.push_back(item.key());
    EXPECT_EQ(names,
              (Words{"final", "events", "impacts", "energy", "steps", "evaluations", "wall_seconds", "version"}));
    EXPECT_EQ(json["final"]["time"], 0.15);
    EXPECT_EQ(json["events"][0]["kind"], "touchdown");
    // Free fall from 0.10 m to the radius: nothing but gravity until then.
    EXPECT_NEAR(json["events"][0]["time"].get<double>(), std::sqrt(2 * (0.10 - 0.0165) / 9.81), 1e-9);
    EXPECT_TRUE(std::filesystem::exists(folder / "ball.nc"));
}

TEST_F(Cli, WritesTheFilesItIsAskedForAndNoOthers) {
    const std::string file = folder.write("ball.toml", scenario()).string();
    const Result result =
        footfall({"run", file, "--output", (folder / "ball.nc").string(), "--csv", (folder / "tables").string(), "-q"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out + result.err, "");
    EXPECT_EQ(folder.names(), (std::set<std::string>{"ball.nc", "ball.toml", "tables"}));
    for (const char* table : {"samples.csv", "events.csv", "impacts.csv"}) {
        EXPECT_TRUE(std::filesystem::exists(folder / "tables" / table)) << table;
    }
}

TEST_F(Cli, AToleranceOnTheCommandLineReplacesTheScenarios) {
    const std::string file = folder.write("ball.toml", scenario()).string();
    const auto steps = [&](const char* tolerance) {
        return Json::parse(footfall({"run", file, "--json", "--tolerance", tolerance}).out)["steps"].get<int>();
    };
    EXPECT_GT(steps("1e-12"), steps("1e-6"));
}

TEST_F(Cli, OutputThatCannotBeWrittenExitsWithOneAndLeavesNothing) {
    const std::string file = folder.write("ball.toml", scenario()).string();
    const std::string other = folder.write("other", "older").string();
    for (const Words& output :
         {Words{"-o", (folder / "none" / "ball.nc").string()}, {"-o", "/dev/null"}, {"--csv", other}}) {
        const Result result = footfall({"run", file, output[0], output[1]});
        EXPECT_EQ(result.exit_code, 1);
        EXPECT_EQ(result.out, "");
        EXPECT_EQ(result.err.find("footfall: cannot write " + output[1] + ": "), 0U) << result.err;
    }
    EXPECT_EQ(folder.names(), (std::set<std::string>{"ball.toml", "other"}));
    EXPECT_EQ(read_text(other), "older");
}

TEST_F(Cli, ShowsItsProgressOnATerminalAndStopsCleanlyWhenInterrupted) {
    const std::string file = folder.write("ball.toml", endless).string();
    folder.write("ball.nc", "older");
    for (const int signal : {SIGINT, SIGTERM}) {
        Terminal terminal;
        const pid_t child = start({"run", file, "-o", (folder / "ball.nc").string()}, terminal.inside());
        terminal.leave();
        EXPECT_TRUE(contains(terminal.read_until(" % "), "of 1e+05 s"));
        ::kill(child, signal);
        const std::string screen = terminal.read_until("nothing was written");
        const Result result = finish(child);
        EXPECT_EQ(result.exit_code, 128 + signal);
        EXPECT_EQ(result.out, "");
        EXPECT_TRUE(contains(screen, "\r\033[Kfootfall: " + file + ": interrupted; nothing was written")) << screen;
        EXPECT_EQ(folder.names(), (std::set<std::string>{"ball.nc", "ball.toml"}));
        EXPECT_EQ(read_text(folder / "ball.nc"), "older");
    }
}

TEST_F(Cli, ShowsNoProgressWhereThereIsNoTerminalOrWhenItIsQuiet) {
    using namespace std::chrono_literals;
    const std::string file = folder.write("ball.toml", endless).string();
    const pid_t child = start({"run", file});
    Terminal terminal;
    const pid_t quiet = start({"run", file, "--quiet"}, terminal.inside());
    terminal.leave();
    std::this_thread::sleep_for(1500ms);
    ::kill(child, SIGINT);
    ::kill(quiet, SIGINT);
    EXPECT_EQ(terminal.read_until("written").find("footfall: "), 0U);
    int status = 0;
    EXPECT_EQ(::waitpid(quiet, &status, 0), quiet);
    EXPECT_EQ(exit_code_of(status), 130);
    EXPECT_EQ(finish(child).err, "footfall: " + file + ": interrupted; nothing was written\n");
}

TEST_F(Cli, ListsEveryLawWithItsParameters) {
    const Result result = footfall({"laws"});
    EXPECT_EQ(result.exit_code, 0);
    for (const char* words : {"azad-featherstone", "hunt-crossley", "linear", "none", "K_n z^1.5 + D_n z^0.5 zdot",
                              "N s/m^1.5", "Featherstone 2008", "no friction at all", ">= 0", "by default 1.5"}) {
        EXPECT_TRUE(contains(result.out, words)) << words;
    }

    const Json json = Json::parse(footfall({"laws", "--json"}).out);
    ASSERT_EQ(json["normal"].size(), std::variant_size_v<footfall::NormalLaw>);
    ASSERT_EQ(json["friction"].size(), std::variant_size_v<footfall::FrictionLaw>);
    const Json& paper = json["normal"][0];
    EXPECT_EQ(paper["name"], "azad-featherstone");
    EXPECT_EQ(paper["parameters"][0]["symbol"], "K_n");
    EXPECT_EQ(paper["parameters"][0]["range"], "> 0");
    EXPECT_TRUE(paper["parameters"][0]["when_zero"].is_null());
    EXPECT_TRUE(paper["parameters"][1]["when_zero"].is_string());
}

TEST_F(Cli, PrintsAJsonSchema) {
    const Result result = footfall({"schema"});
    EXPECT_EQ(result.exit_code, 0);
    const Json schema = Json::parse(result.out);
    EXPECT_TRUE(contains(schema["$schema"].get<std::string>(), "json-schema.org"));
    EXPECT_TRUE(schema["properties"].contains("contact"));
}

TEST_F(Cli, AFullStandardOutputExitsWithOne) {
    const std::string command = std::string(FOOTFALL_CLI) + " laws > /dev/full 2> " + (folder / "err").string();
    EXPECT_EQ(exit_code_of(std::system(command.c_str())), 1);
    EXPECT_TRUE(contains(read_text(folder / "err"), "standard output"));
}

}  // namespace
}  // namespace footfall::test
