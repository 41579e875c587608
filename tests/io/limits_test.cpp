// Inputs and runs of any size: what is bounded, and how that is told.
#include <algorithm>
#include <fstream>
#include <string>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "footfall/io/rig.hpp"
#include "footfall/io/scenario.hpp"
#include "footfall/study/drive.hpp"
#include "io/problems.hpp"
#include "io/read.hpp"
#include "io/temporary_folder.hpp"

namespace footfall {
namespace {

template <class Thrown, class Work>
std::string message_of(const Work& work) {
    try {
        work();
    } catch (const Thrown& error) {
        return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return "";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// Files ---------------------------------------------------------------------------------------------------------------

TEST(ReadFile, RefusesMoreThanItsLimitWithNameSizeAndLimit) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("large.toml", std::string((std::size_t{2} << 20) + 1, '#'));
    const std::string message = message_of<InvalidInput>([&] { (void)io::read_file(file, std::size_t{2} << 20); });
    EXPECT_TRUE(contains(message, file.string()));
    EXPECT_TRUE(contains(message, "it holds 2097153 bytes, and 2 MiB are the most")) << message;
    EXPECT_EQ(io::read_file(file, (std::size_t{2} << 20) + 1).size(), (std::size_t{2} << 20) + 1);
}

TEST(ReadFile, EndsWhereAFileDoesNot) {
    EXPECT_TRUE(contains(message_of<InvalidInput>([] { (void)load_scenario("/dev/zero"); }), "/dev/zero"));
    EXPECT_TRUE(contains(message_of<InvalidInput>([] { (void)load_rig("/dev/zero"); }), "16 MiB are the most"));
}

TEST(ReadFile, ReadsAPipeToItsEnd) {
    const test::TemporaryFolder folder;
    const std::string pipe = (folder / "pipe").string();
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    std::thread writer([&pipe] { std::ofstream(pipe) << std::string(100'000, 'x'); });
    EXPECT_EQ(io::read_file(pipe).size(), 100'000U);
    writer.join();
}

TEST(ReadFile, FolderIsAnErrorOfTheSystem) {
    EXPECT_TRUE(contains(message_of<std::system_error>([] { (void)io::read_file("/"); }), "cannot read /"));
    EXPECT_TRUE(
        contains(message_of<std::system_error>([] { (void)io::read_file(std::string(10'000, 'x')); }), "cannot read"));
}

// Lists of errors -----------------------------------------------------------------------------------------------------

TEST(ManyProblems, TwentyAreToldAndTheRestCounted) {
    std::string text;
    for (int i = 0; i < 5000; ++i) text += fmt::format("key{} = 1\n", i);
    try {
        (void)parse_scenario(text, "many.toml");
        FAIL() << "accepted";
    } catch (const ScenarioError& error) {
        const std::string message = error.what();
        EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 20) << message;
        // Three tables are missing, too.
        EXPECT_TRUE(contains(message, "many.toml: ... and 4983 more problems")) << message;
        EXPECT_EQ(error.problems().size(), 1000U);
        EXPECT_EQ(error.more(), 4003U);
    }
}

TEST(ManyProblems, TwentyOrFewerAreAllTold) {
    std::string text;
    for (int i = 0; i < 17; ++i) text += fmt::format("key{} = 1\n", i);
    const std::string message = message_of<ScenarioError>([&] { (void)parse_scenario(text); });
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 19);
    EXPECT_FALSE(contains(message, "more problem"));
}

TEST(LongText, IsCutInMessages) {
    const std::string word(1'000'000, 'x');
    for (const std::string& text : {word + " = 1", "[contact.normal]\nlaw = '" + word + "'", "[" + word + "]"}) {
        const std::string message = message_of<ScenarioError>([&] { (void)parse_scenario(text); });
        EXPECT_LT(message.size(), 3000U);
        EXPECT_TRUE(contains(message, "xxx...")) << message;
    }
}

TEST(Shown, IsOneLineOfUtf8) {
    EXPECT_EQ(io::shown("a\nb\tc\x1b[31m\xff\xc3"), "a\\nb\\tc\\x1b[31m\\xff\\xc3");
    // Sixty bytes end within the last letter.
    EXPECT_EQ(io::shown(std::string(59, 'x') + "\xc3\xa9 and more"), std::string(59, 'x') + "...");
    EXPECT_EQ(io::shown("µ"), "µ");
}

// Memory --------------------------------------------------------------------------------------------------------------

std::string ball(const std::string& time, const std::string& solver = "") {
    return "[time]\n" + time + "\n[solver]\n" + solver +
           "\n[body]\nmass = 0.154\ninertia = 'solid-sphere'\n[[body.spheres]]\nradius = 0.0165\n"
           "[body.initial]\nposition = [0, 0, 0.1]\n"
           "[contact.normal]\nlaw = 'azad-featherstone'\nstiffness = 8.5e6\ndamping = 3.1e3\n";
}

TEST(MemoryOfSamples, IsRefusedBeforeTheRunWithWhatToDo) {
    const std::string message =
        message_of<TooExpensive>([] { (void)run(parse_scenario(ball("end = 1\nsample = 1e-12")).simulation); });
    EXPECT_TRUE(contains(message, "1e+12 samples of 1 sphere")) << message;
    EXPECT_TRUE(contains(message, "more than the 4 GB of max_memory")) << message;
    EXPECT_TRUE(contains(message, "a longer sample period, a shorter run or fewer spheres, or raise max_memory"))
        << message;
}

TEST(MemoryOfSamples, IsAllowedUpToTheLimitThatIsGiven) {
    const std::string time = "end = 0.5\nsample = 1e-3";
    EXPECT_THROW((void)run(parse_scenario(ball(time, "max_memory = 1e5")).simulation), TooExpensive);
    EXPECT_EQ(run(parse_scenario(ball(time, "max_memory = 1e6")).simulation).samples.size(), 501U);
}

TEST(MemoryOfEvents, StopsTheRunOnItsWay) {
    const std::string message = message_of<TooExpensive>(
        [] { (void)run(parse_scenario(ball("end = 10\nsample = 0", "max_memory = 1e4")).simulation); });
    EXPECT_TRUE(contains(message, "it had kept")) << message;
    EXPECT_TRUE(contains(message, "had reached t = ")) << message;
}

TEST(MemoryOfEvents, OfARunThatTheMachineHasNoMemoryForIsTold) {
    const std::string message = message_of<TooExpensive>(
        [] { (void)run(parse_scenario(ball("end = 1\nsample = 1e-18", "max_memory = 1e300")).simulation); });
    EXPECT_TRUE(contains(message, "the machine has no more memory")) << message;
}

TEST(MemoryOfARig, IsBoundedLikeThatOfARun) {
    RigFile file = load_rig(FOOTFALL_SOURCE_DIR "/scenarios/rigs/breakaway.toml");
    file.rig.sample_period = 1e-12;
    const std::string message = message_of<TooExpensive>([&] { (void)drive(file.rig, file.laws); });
    EXPECT_TRUE(contains(message, "samples would take about")) << message;
    EXPECT_TRUE(contains(message, "more than the 4 GB of max_memory")) << message;
    file.rig.sample_period = 0.1;
    file.rig.max_memory = 100;
    EXPECT_THROW((void)drive(file.rig, file.laws), TooExpensive);
}

}  // namespace
}  // namespace footfall
