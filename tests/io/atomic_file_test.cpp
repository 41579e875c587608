// Files that appear whole or not at all, with the rights of those before them, and what dead processes leave.
#include "io/atomic_file.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "footfall/io/output.hpp"
#include "footfall/io/staged_files.hpp"
#include "footfall/io/table_output.hpp"
#include "io/hand_made_run.hpp"
#include "io/temporary_folder.hpp"

namespace footfall::test {
namespace {

namespace fs = std::filesystem;

const footfall::Table rows{"A table", {{"x", "m", "where", {1, 2}}}};

class AtomicFiles : public ::testing::Test {
protected:
    TemporaryFolder folder;
    Scenario scenario = two_sphere_scenario();
    footfall::Run run = two_sphere_run();

    static struct stat status(const fs::path& file) {
        struct stat found {};
        EXPECT_EQ(::stat(file.c_str(), &found), 0) << file;
        return found;
    }
    static mode_t mode(const fs::path& file) { return status(file).st_mode & 07777U; }

    template <class Work>
    static std::string error_of(const Work& work) {
        try {
            work();
        } catch (const std::exception& error) {
            return error.what();
        }
        return "";
    }

    /// In a process that is killed in the midst of `work`, which leaves what it made.
    template <class Work>
    static void killed(const Work& work) {
        const pid_t child = ::fork();
        if (child == 0) {
            work();
            ::kill(::getpid(), SIGKILL);
        }
        int how = 0;
        ASSERT_EQ(::waitpid(child, &how, 0), child);
        ASSERT_TRUE(WIFSIGNALED(how));
    }
};

TEST_F(AtomicFiles, ANewFileHasTheRightsThatTheUmaskLeaves) {
    const mode_t before = ::umask(027);
    write_csv(folder / "new.csv", rows);
    write_csv(folder / "tables", scenario, run);
    ::umask(before);
    EXPECT_EQ(mode(folder / "new.csv"), 0640U);
    EXPECT_EQ(mode(folder / "tables"), 0750U);
    EXPECT_EQ(mode(folder / "tables" / "samples.csv"), 0640U);
}

TEST_F(AtomicFiles, AReplacedFileKeepsItsModeAndOwner) {
    const fs::path file = folder.write("old.csv", "older");
    ASSERT_EQ(::chmod(file.c_str(), 0604), 0);
    const bool privileged = ::geteuid() == 0;
    if (privileged) {
        ASSERT_EQ(::chown(file.c_str(), 1234, 2345), 0);
    }
    write_csv(file, rows);
    EXPECT_NE(read_text(file), "older");
    EXPECT_EQ(mode(file), 0604U);
    if (privileged) {
        EXPECT_EQ(status(file).st_uid, 1234U);
        EXPECT_EQ(status(file).st_gid, 2345U);
    }
}

TEST_F(AtomicFiles, AReplacedFolderOfTablesKeepsItsModeAndTheModesOfItsTables) {
    write_csv(folder / "tables", scenario, run);
    ASSERT_EQ(::chmod((folder / "tables").c_str(), 0705), 0);
    ASSERT_EQ(::chmod((folder / "tables" / "events.csv").c_str(), 0606), 0);
    write_csv(folder / "tables", scenario, run);
    EXPECT_EQ(mode(folder / "tables"), 0705U);
    EXPECT_EQ(mode(folder / "tables" / "events.csv"), 0606U);
}

TEST_F(AtomicFiles, AHardLinkKeepsTheOlderContentAndASymbolicOneLeadsToTheNew) {
    const fs::path file = folder.write("file.csv", "older");
    fs::create_hard_link(file, folder / "hard");
    fs::create_symlink("file.csv", folder / "soft");
    write_csv(folder / "soft", rows);
    EXPECT_EQ(read_text(folder / "hard"), "older");
    EXPECT_TRUE(fs::is_symlink(folder / "soft"));
    EXPECT_NE(read_text(file), "older");
}

TEST_F(AtomicFiles, WhatCannotBeReplacedIsNamedForWhatItIs) {
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_NE(error_of([&] { check_csv_file(folder / "pipe"); }).find("a pipe"), std::string::npos);
    EXPECT_NE(error_of([&] { check_csv_file("/dev/null"); }).find("a device"), std::string::npos);
    EXPECT_NE(error_of([&] { check_csv_file("/proc/self/fd/0"); }).find("an open stream"), std::string::npos);
    EXPECT_NE(error_of([&] { check_csv_file(folder.path()); }).find("a folder"), std::string::npos);
}

TEST_F(AtomicFiles, NothingAppearsBeforeAllIsComplete) {
    folder.write("one.csv", "older");
    {
        StagedFiles files;
        files.add_csv(folder / "one.csv", rows);
        files.add_netcdf(folder / "two.nc", scenario, run);
        files.add_csv(folder / "tables", scenario, run);
        EXPECT_EQ(read_text(folder / "one.csv"), "older");
        EXPECT_FALSE(fs::exists(folder / "two.nc"));
        EXPECT_FALSE(fs::exists(folder / "tables"));
    }
    EXPECT_EQ(folder.names(), (std::set<std::string>{"one.csv"}));
    StagedFiles files;
    files.add_csv(folder / "one.csv", rows);
    files.add_csv(folder / "tables", scenario, run);
    files.commit();
    EXPECT_EQ(folder.names(), (std::set<std::string>{"one.csv", "tables"}));
}

TEST_F(AtomicFiles, FoldersThatWereMadeForNothingAreRemoved) {
    {
        StagedFiles files;
        files.add_csv(folder / "a" / "b" / "tables", scenario, run);
        EXPECT_TRUE(fs::exists(folder / "a" / "b"));
    }
    EXPECT_TRUE(folder.names().empty());
}

TEST_F(AtomicFiles, OtherFilesInAFolderOfTablesStayTheSameFiles) {
    const fs::path tables = folder / "tables";
    for (const bool below : {false, true}) {  // with a folder in it the tables are moved one by one
        write_csv(tables, scenario, run);
        std::ofstream(tables / "notes.txt") << "notes";
        std::ofstream(tables / "samples.csv") << "older";
        if (below) fs::create_directory(tables / "more");
        const ino_t before = status(tables / "notes.txt").st_ino;
        const ino_t itself = status(tables).st_ino;
        write_csv(tables, scenario, run);
        EXPECT_EQ(status(tables / "notes.txt").st_ino, before);
        EXPECT_EQ(status(tables / "notes.txt").st_nlink, 1U);
        EXPECT_NE(read_text(tables / "samples.csv"), "older");
        EXPECT_EQ(status(tables).st_ino == itself, below);
        EXPECT_EQ(folder.names(), (std::set<std::string>{"tables"}));
        EXPECT_EQ(std::distance(fs::directory_iterator(tables), fs::directory_iterator()), below ? 5 : 4);
    }
}

TEST_F(AtomicFiles, TheFolderThatTheProgramIsInIsNotExchanged) {
    write_csv(folder.path(), scenario, run);
    const fs::path before = fs::current_path();
    fs::current_path(folder.path());
    const ino_t itself = status(".").st_ino;
    write_csv(".", scenario, run);
    EXPECT_EQ(status(folder.path()).st_ino, itself);
    EXPECT_TRUE(fs::exists("samples.csv"));
    fs::current_path(before);
}

TEST_F(AtomicFiles, WhatAKilledProcessLeftIsSweptByTheNextWrite) {
    killed([&] {
        auto* file = new io::AtomicFile(folder / "a.csv");
        file->writer().write("half");
        auto* tables = new StagedFiles;
        tables->add_csv(folder / "tables", scenario, run);
    });
    EXPECT_EQ(folder.names().size(), 2U);
    write_csv(folder / "b.csv", rows);
    EXPECT_EQ(folder.names(), (std::set<std::string>{"b.csv"}));
}

TEST_F(AtomicFiles, ASweepLeavesWhatIsAliveOrNotOurs) {
    io::AtomicFile alive(folder / "a.csv");
    folder.write(".footfall-00000000-1-0.tmp", "of another machine");
    folder.write(".footfall.tmp", "of the user");
    const std::set<std::string> before = folder.names();
    ASSERT_EQ(before.size(), 3U);
    { io::AtomicFile other(folder / "b.csv"); }
    EXPECT_EQ(folder.names(), before);
    io::Writer writer = alive.writer();
    writer.write("whole");
    writer.finish();
    alive.take_place();
    EXPECT_EQ(read_text(folder / "a.csv"), "whole");
}

TEST_F(AtomicFiles, TablesOfAProcessThatWasKilledWhileMovingThemAreAllMovedByTheNextWrite) {
    const fs::path tables = folder / "tables";
    fs::create_directories(tables / "more");
    for (const char* name : io::run_tables) std::ofstream(tables / name) << "older";
    killed([&] {
        auto* left = new io::Temporary(tables, io::Temporary::Kind::folder, 0700);
        for (const char* name : io::run_tables) std::ofstream(left->path() / name) << "new";
        fs::path ready = left->path();
        left->move(ready.replace_extension(".ready"));
        fs::rename(ready / "samples.csv", tables / "samples.csv");  // one of three
    });
    EXPECT_EQ(read_text(tables / "events.csv"), "older");
    write_csv(tables / "other.csv", rows);
    for (const char* name : io::run_tables) EXPECT_EQ(read_text(tables / name), "new") << name;
    EXPECT_EQ(std::distance(fs::directory_iterator(tables), fs::directory_iterator()), 5);
}

TEST_F(AtomicFiles, TablesOfAProcessThatWasKilledNeverReplaceNewerOnes) {
    const fs::path tables = folder / "tables";
    fs::create_directories(tables / "more");
    killed([&] {
        auto* left = new io::Temporary(tables, io::Temporary::Kind::folder, 0700);
        for (const char* name : io::run_tables) std::ofstream(left->path() / name) << "left over";
        fs::path ready = left->path();
        left->move(ready.replace_extension(".ready"));
    });
    std::ofstream(tables / "events.csv") << "newer";  // by hand, or by another program
    const fs::file_time_type later = fs::file_time_type::clock::now() + std::chrono::seconds(1);
    fs::last_write_time(tables / "events.csv", later);
    write_csv(tables / "other.csv", rows);
    EXPECT_EQ(read_text(tables / "events.csv"), "newer");
    EXPECT_EQ(read_text(tables / "samples.csv"), "left over");  // it was missing
    EXPECT_EQ(std::distance(fs::directory_iterator(tables), fs::directory_iterator()), 5);
}

}  // namespace
}  // namespace footfall::test
