// What the program writes: never over what it reads, and nothing that a terminal would obey.
#include <algorithm>
#include <chrono>
#include <fstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "cli/program.hpp"

namespace footfall::test {
namespace {

namespace fs = std::filesystem;

const std::string ball = elastic_ball("0.15", "1e-3", "1e-8");
const std::string rig = R"([rig]
end = 1
load = [{ shape = "constant", value = 10 }]
displacement = [{ shape = "table", file = "path.csv", time = "t", column = "x", direction = 0 }]
[contact.normal]
law = "hertz"
stiffness = 1e8
[contact.friction]
law = "dahl"
stiffness = 1e4
coefficient = 0.4
)";
const std::string bounces = "speed [m/s],restitution\n0.5,0.83\n1,0.76\n2,0.66\n4,0.55\n";
const std::string laws =
    " --normal azad-featherstone:stiffness=2.675e10,damping=700"
    " --friction azad-featherstone:stiffness=4.01e10,damping=700,coefficient=0.092 ";
const std::string oblique = "oblique --radius 2.5mm --density 4000 --speed 3.9 --angles 40" + laws;
const std::string fit = " --mass '154 g' --normal 'azad-featherstone:stiffness=8.5e6,damping=?' ";

class OutputsCli : public ProgramTest {
protected:
    /// Runs in the folder: names on the command line are relative to it.
    Result here(const std::string& words, const std::string& streams = "") const {
        const fs::path out = folder / ".out", err = folder / ".err";
        const std::string command = fmt::format("cd '{}' && ( '{}' {} ) >.out 2>.err", folder.path().string(),
                                                FOOTFALL_CLI, words + " " + streams);
        const int status = std::system(command.c_str());
        Result result{exit_code_of(status), read_text(out), read_text(err)};
        fs::remove(out);
        fs::remove(err);
        return result;
    }
    void refuses(const std::string& words, const std::string& one, const std::string& other) const {
        const Result result = here(words);
        EXPECT_EQ(result.exit_code, 2) << words << result.err;
        EXPECT_EQ(result.out, "");
        EXPECT_TRUE(contains(result.err, one) && contains(result.err, other)) << result.err;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    }
};

TEST_F(OutputsCli, AnOutputThatIsAnInputIsRefusedUnderAnyNameAndStaysAsItWas) {
    folder.write("a.toml", ball);
    folder.write("d.csv", bounces);
    folder.write("rig.toml", rig);
    folder.write("path.csv", "t,x\n0,0\n1,1e-4\n");
    folder.write("rebounds.csv", "angle,tangential_restitution\n10,0.7\n40,0.6\n");
    fs::create_symlink("a.toml", folder / "soft.toml");
    fs::create_hard_link(folder / "a.toml", folder / "hard.toml");
    fs::create_directory(folder / "below");
    fs::create_symlink("..", folder / "below" / "up");
    const std::string absolute = (folder / "a.toml").string();
    for (const std::string& name : {std::string("a.toml"), std::string("./a.toml"), std::string("soft.toml"),
                                    std::string("hard.toml"), std::string("below/up/a.toml"), absolute}) {
        refuses("run a.toml -o " + name, "--output", "SCENARIO");
        EXPECT_EQ(read_text(folder / "a.toml"), ball) << name;
    }
    refuses("run soft.toml -o a.toml", "--output", "SCENARIO");
    refuses("fit d.csv --csv ./d.csv" + fit, "--csv", "DATA");
    refuses("drive rig.toml --csv rig.toml", "--csv", "RIG");
    refuses("drive rig.toml --csv path.csv", "--csv", "a table of the rig");
    refuses(oblique + "--fit rebounds.csv --vary friction.coefficient --csv rebounds.csv", "--csv", "--fit");
    EXPECT_EQ(read_text(folder / "d.csv"), bounces);
    fs::create_directory(folder / "tables");
    fs::create_symlink("../a.toml", folder / "tables" / "events.csv");
    refuses("run a.toml --csv tables", "--csv", "SCENARIO");
    folder.write("samples.csv", ball);
    refuses("run samples.csv --csv .", "--csv", "SCENARIO");
    EXPECT_EQ(read_text(folder / "samples.csv"), ball);
}

TEST_F(OutputsCli, TwoOutputsOnOnePlaceAreRefused) {
    folder.write("a.toml", ball);
    fs::create_directory(folder / "real");
    fs::create_symlink("real", folder / "link");
    refuses("run a.toml --csv tables -o tables", "--csv", "--output");
    refuses("run a.toml --csv real -o link/impacts.csv", "--csv", "--output");
    refuses(oblique + "--csv o.csv --history ./o.csv", "--csv", "--history");
    refuses(oblique + "--csv real/o.csv --history link/o.csv", "--csv", "--history");
    EXPECT_EQ(folder.names(), (std::set<std::string>{"a.toml", "link", "real"}));
}

TEST_F(OutputsCli, TablesAreWrittenIntoFoldersThatCannotBeExchanged) {
    folder.write("a.toml", ball);
    const std::set<std::string> tables{"samples.csv", "events.csv", "impacts.csv"};
    for (const int older : {0, 1, 2}) {
        const fs::path place = folder / fmt::format("with-{}", older);
        fs::create_directories(place / "sub");  // a folder in it forbids the exchange
        auto name = tables.begin();
        for (int i = 0; i < older; ++i) folder.write(fmt::format("with-{}/{}", older, *name++), "older");
        const Result result = here(fmt::format("run a.toml -q --csv with-{}", older));
        EXPECT_EQ(result.exit_code, 0) << result.err;
        std::set<std::string> there;
        for (const auto& entry : fs::directory_iterator(place)) there.insert(entry.path().filename().string());
        std::set<std::string> wanted = tables;
        wanted.insert("sub");
        EXPECT_EQ(there, wanted);
        for (const std::string& table : tables) EXPECT_NE(read_text(place / table), "older");
    }
    fs::create_directory(folder / "current");
    EXPECT_EQ(here("--version", fmt::format("; cd current && '{}' run ../a.toml -q --csv .", FOOTFALL_CLI)).exit_code,
              0);
    EXPECT_TRUE(fs::exists(folder / "current" / "impacts.csv"));
}

TEST_F(OutputsCli, TablesThatAreOneFileByALinkAreRefused) {
    folder.write("a.toml", ball);
    fs::create_directory(folder / "tables");
    folder.write("all.csv", "older");
    fs::create_symlink("../all.csv", folder / "tables" / "samples.csv");
    fs::create_symlink("../all.csv", folder / "tables" / "events.csv");
    refuses("run a.toml --csv tables", "--csv", "the same file");
    EXPECT_EQ(read_text(folder / "all.csv"), "older");
}

TEST_F(OutputsCli, StandardOutputIsNoInputAndNoOutput) {
    folder.write("a.toml", ball);
    Result result = here("--version", fmt::format("; '{}' run a.toml --json >> a.toml", FOOTFALL_CLI));
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_TRUE(contains(result.err, "standard output goes to a.toml, which is SCENARIO")) << result.err;
    EXPECT_EQ(read_text(folder / "a.toml"), ball);
    result = here("--version", fmt::format("; '{}' run a.toml --json -o same.nc > same.nc", FOOTFALL_CLI));
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_TRUE(contains(result.err, "which is --output")) << result.err;
}

TEST_F(OutputsCli, AShippedNameIsNoInputThatAnOutputCouldOverwrite) {
    EXPECT_EQ(here("run single-impact -q -o single-impact").exit_code, 0);
    EXPECT_TRUE(fs::exists(folder / "single-impact"));
}

TEST_F(OutputsCli, WhatIsPrintedForAFileIsTheFileByteForByte) {
    std::string text = ball;
    text.replace(text.find("sample"), 0, "\t");
    text.replace(text.find("[solver]"), 0, "# \xE2\x80\xAE turned\r\n");
    folder.write("a.toml", "\xEF\xBB\xBF" + text);
    const Result result = here("run a.toml --print");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, text);
}

TEST_F(OutputsCli, EveryCommandAsksWhetherItsOutputCanBeWrittenBeforeItRuns) {
    folder.write("d.csv", bounces);
    for (const std::string& words :
         {"fit d.csv --csv none/x.csv" + fit, oblique + "--csv none/x.csv", oblique + "--history none/x.csv",
          std::string("restitution --mass 0.154 --normal azad-featherstone:stiffness=8.5e6,damping=3.1e3 "
                      "--points 200000 --csv none/x.csv")}) {
        const auto began = std::chrono::steady_clock::now();
        const Result result = here(words);
        EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(3)) << words;
        EXPECT_EQ(result.exit_code, 1) << words;
        EXPECT_EQ(result.err, "footfall: cannot write none/x.csv: the folder none does not exist\n");
    }
}

TEST_F(OutputsCli, SeveralOutputsAppearTogetherOrNotAtAll) {
    folder.write("a.toml", elastic_ball("0.15", "2e-5", "1e-8"));
    const std::string words = "run a.toml -q -o a.nc --csv tables";
    ASSERT_EQ(here(words).exit_code, 0);
    const auto size = fs::file_size(folder / "a.nc");
    ASSERT_LT(2 * size, fs::file_size(folder / "tables" / "samples.csv"));
    folder.write("a.nc", "older");
    folder.write("tables/samples.csv", "older");
    // The NetCDF file fits, the tables, which are written after it, do not. `ulimit -f` counts blocks of 512 or 1024.
    const Result result =
        here("--version", fmt::format("; ulimit -f {}; '{}' {}", size / 512 + 1, FOOTFALL_CLI, words));
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.err, "footfall: cannot write tables/samples.csv: File too large\n");
    EXPECT_EQ(read_text(folder / "a.nc"), "older");
    EXPECT_EQ(read_text(folder / "tables" / "samples.csv"), "older");
}

TEST_F(OutputsCli, ClosedAndFullStreamsChangeNoExitCodeButTheirOwn) {
    folder.write("a.toml", ball);
    const std::string wrong = "run none.toml", right = "run a.toml", quiet = "run a.toml -q -o a.nc";
    for (const std::string& streams : {std::string("2>&-"), std::string("2>/dev/full"), std::string("2>&- >&- <&-")}) {
        EXPECT_EQ(here(wrong, streams).exit_code, 2) << streams;
        EXPECT_EQ(here("walk", streams).exit_code, 2) << streams;
        EXPECT_EQ(here(quiet, streams).exit_code, 0) << streams;
    }
    for (const std::string& words : {right, std::string("--help"), std::string("run --help"), std::string("--version"),
                                     std::string("laws"), std::string("schema")}) {
        for (const char* streams : {">&-", ">/dev/full"}) {
            const Result result = here(words, streams);
            EXPECT_EQ(result.exit_code, 1) << words << streams;
            EXPECT_EQ(result.err.find("footfall: cannot write to standard output: "), 0U) << words << result.err;
        }
    }
}

TEST_F(OutputsCli, NoMessageGoesIntoAFileThatTookTheNumberOfAClosedStream) {
    folder.write("a.toml", ball);
    ASSERT_EQ(here("run a.toml -q --csv tables").exit_code, 0);
    const std::string whole = read_text(folder / "tables" / "samples.csv");
    // The radius is far smaller than the depth, so that a warning is said.
    const std::string words = "restitution --mass 1 --radius 1e-9 --points 3 --normal hertz:stiffness=1e6 --csv e.csv";
    ASSERT_EQ(here(words).exit_code, 0);
    const std::string table = read_text(folder / "e.csv");
    EXPECT_EQ(here(words, "2>&- <&-").exit_code, 0);
    EXPECT_EQ(read_text(folder / "e.csv"), table);
    EXPECT_EQ(here("run a.toml --csv tables", ">&- 2>&-").exit_code, 1);
    EXPECT_EQ(read_text(folder / "tables" / "samples.csv"), whole);
}

TEST_F(OutputsCli, ABrokenPipeEndsQuietlyAsOtherToolsDo) {
    const std::string command =
        fmt::format("bash -c \"'{}' laws --json | true; echo \\${{PIPESTATUS[0]}}\" >'{}' 2>'{}'", FOOTFALL_CLI,
                    (folder / "code").string(), (folder / "err").string());
    // The reader is gone before the first byte, or has room for all of it.
    ASSERT_EQ(std::system(command.c_str()), 0);
    EXPECT_EQ(read_text(folder / "err"), "");
    const std::string slow =
        fmt::format("bash -c \"( sleep 0.3; '{}' laws ) | true; echo \\${{PIPESTATUS[0]}}\" >'{}' 2>'{}'", FOOTFALL_CLI,
                    (folder / "code").string(), (folder / "err").string());
    ASSERT_EQ(std::system(slow.c_str()), 0);
    EXPECT_EQ(read_text(folder / "code"), "141\n");
}

TEST_F(OutputsCli, NoControlCharacterReachesATerminal) {
    const auto harmless = [](const std::string& text) {
        return std::none_of(text.begin(), text.end(),
                            [](char c) {
                                const auto byte = static_cast<unsigned char>(c);
                                return byte == 0x7f || (byte < 0x20 && byte != '\n');
                            }) &&
               !contains(text, "\u202e") && !contains(text, "\u009b");
    };
    const std::string title = "title = \"a\\u001b[31m\\u0007\\u202e\\u009b1m\\nfootfall: b\"\n";
    folder.write("a.toml", title + ball);
    const Result run = here("run a.toml -o \"$(printf 'n\\033[1m\\nc\\377.nc')\"");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_TRUE(harmless(run.out)) << run.out;
    EXPECT_TRUE(contains(run.out, "a\\x1b[31m\\x07\\u202e\\u009b1m\\nfootfall: b\n")) << run.out;
    EXPECT_TRUE(contains(run.out, "n\\x1b[1m\\nc\\xff.nc\n")) << run.out;

    for (const std::string& words :
         {std::string("run \"$(printf 'x\\033]0;t\\007\\nfootfall: all is well')\""),
          std::string("run a.toml \"--$(printf '\\033[1m\\n')\""),
          "fit d.csv" + fit + "--loss \"$(printf 'a\\nb\\033')\"",
          std::string("restitution --mass 1 --normal \"$(printf 'hertz\\n\\033:stiffness=1')\""),
          std::string("restitution --mass \"$(printf '1\\n\\033kg')\" --normal hertz:stiffness=1")}) {
        const Result result = here(words);
        EXPECT_EQ(result.exit_code, 2) << words;
        EXPECT_TRUE(harmless(result.err)) << result.err;
        EXPECT_LE(std::count(result.err.begin(), result.err.end(), '\n'), 2) << result.err;
    }
    folder.write("b.toml", ball + "\"k\\u001by\\n\" = 1\n");
    const Result key = here("run b.toml");
    EXPECT_EQ(key.exit_code, 2);
    EXPECT_TRUE(harmless(key.err)) << key.err;
    EXPECT_EQ(std::count(key.err.begin(), key.err.end(), '\n'), 1) << key.err;
}

TEST_F(OutputsCli, JsonIsUtf8WhateverTheNamesOfFilesAre) {
    const std::string name = "d\xff\x1b.csv";
    folder.write(name, bounces);
    const Result result = here("fit \"$(printf 'd\\377\\033.csv')\" --json" + fit);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(Json::parse(result.out)["data"].get<std::string>().find("d\xef\xbf\xbd\x1b.csv"), 0U) << result.out;
}

}  // namespace
}  // namespace footfall::test
