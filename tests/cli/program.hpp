// The program as a user runs it: words for a shell go in; its exit code and what it printed come out.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "io/temporary_folder.hpp"

namespace footfall::test {

using Json = nlohmann::ordered_json;

struct Result {
    int exit_code;  ///< as a shell gives it: 128 + the signal's number where one ended the program
    std::string out, err;
};

inline int exit_code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

/// The words are somewhere in the text.
inline bool contains(std::string_view text, std::string_view words) {
    return text.find(words) != std::string_view::npos;
}

/// A test of one command, with a folder to itself.
class ProgramTest : public ::testing::Test {
protected:
    TemporaryFolder folder;

    /// Runs `footfall` with words for a shell.
    Result footfall(const std::string& words) const {
        const std::filesystem::path out = folder / ".out", err = folder / ".err";
        const std::string command = FOOTFALL_CLI " " + words + " >" + out.string() + " 2>" + err.string();
        const int status = std::system(command.c_str());
        Result result{exit_code_of(status), read_text(out), read_text(err)};
        std::filesystem::remove(out);
        std::filesystem::remove(err);
        return result;
    }
};

/// A scenario: a ball that falls 10 cm onto elastic ground. Times in seconds.
inline std::string elastic_ball(const std::string& end, const std::string& sample, const std::string& tolerance) {
    return "[time]\nend = " + end + "\nsample = " + sample + "\n[solver]\ntolerance = " + tolerance + R"(
[body]
mass = "154 g"
inertia = "solid-sphere"
[[body.spheres]]
radius = "1.65 cm"
[body.initial]
position = [0, 0, 0.10]
[contact.normal]
law = "hertz"
stiffness = 8.5e6
)";
}

/// The values of one column of a table in JSON.
inline std::vector<double> column(const Json& columns, const std::string& name, const std::string& series = "") {
    for (const Json& c : columns) {
        if (c["name"] == name && c["series"] == series) return c["values"].get<std::vector<double>>();
    }
    ADD_FAILURE() << "no column " << series << "." << name;
    return {};
}

}  // namespace footfall::test
