#include "footfall/io/table_output.hpp"

#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "footfall/math/error.hpp"
#include "footfall/version.hpp"
#include "io/temporary_folder.hpp"
#include "io/text.hpp"

namespace footfall {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Table small() {
    return {"Restitution\nof a ball",
            {{"speed", "m/s", "impact speed", {0.1, 1.0 / 3.0}, ""},
             {"restitution", "1", "speed out over speed in", {0.75, nan}, "paper"},
             {"restitution", "1", "speed out over speed in", {1, 1e-300}, "a:b=1,c=\"2\""}}};
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

TEST(TableCsv, HasCommentsAHeaderAndRowsThatReadBack) {
    const test::TemporaryFolder folder;
    write_csv(folder / "table.csv", small());
    const std::vector<std::string> lines = lines_of(test::read_text(folder / "table.csv"));
    ASSERT_EQ(lines.size(), 8u);
    EXPECT_EQ(lines[0], "# Restitution of a ball");
    EXPECT_EQ(lines[1], "# footfall " + std::string(version));
    EXPECT_EQ(lines[2], "# speed [m/s]: impact speed");
    EXPECT_EQ(lines[3], "# paper.restitution [1]: speed out over speed in");
    EXPECT_EQ(lines[5], "speed,paper.restitution,\"a:b=1,c=\"\"2\"\".restitution\"");
    EXPECT_EQ(lines[6], "0.1,0.75,1");
    EXPECT_EQ(lines[7], "0.3333333333333333,,1e-300");
    EXPECT_EQ(folder.names(), std::set<std::string>{"table.csv"});
}

TEST(TableCsv, NamesAFileThatCannotBeWritten) {
    const test::TemporaryFolder folder;
    try {
        write_csv(folder / "missing" / "table.csv", small());
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("table.csv"), std::string::npos);
    }
}

TEST(TableJson, ReadsBackExactlyWithNullForWhatDoesNotExist) {
    const auto json = nlohmann::json::parse(to_json(small()));
    EXPECT_EQ(json["version"], version);
    ASSERT_EQ(json["columns"].size(), 3u);
    EXPECT_EQ(json["columns"][0]["values"][1], 1.0 / 3.0);
    EXPECT_EQ(json["columns"][1]["series"], "paper");
    EXPECT_TRUE(json["columns"][1]["values"][1].is_null());
    EXPECT_EQ(json["columns"][2]["unit"], "1");
}

TEST(TableText, AlignsColumnsAndNumbersLongSeries) {
    Table table = small();
    table.columns[2].series = "a law with a very long name";
    const std::string text = to_text(table);
    EXPECT_NE(text.find("(2) a law with a very long name"), std::string::npos);
    const std::vector<std::string> lines = lines_of(text);
    // Every number ends where its heading ends.
    ASSERT_GE(lines.size(), 2u);
    EXPECT_EQ(lines.back().size(), lines[lines.size() - 2].size());
    EXPECT_NE(lines[lines.size() - 2].find("0.1         0.75            1"), std::string::npos);
    EXPECT_NE(lines.back().find("0.333333            -       1e-300"), std::string::npos);
}

TEST(TableText, IsNeverWiderThanAHundredCharactersAndLosesNoColumn) {
    Table table{"wide", {}};
    for (int i = 0; i < 40; ++i) {
        table.columns.push_back({"column_" + std::to_string(i), "N s/m^1.5", "", {1e-7 * i}, i == 0 ? "" : "law"});
    }
    for (const bool series : {true, false}) {
        if (!series) {
            for (Column& column : table.columns) column.series.clear();
        }
        const std::string text = to_text(table);
        for (const std::string& line : lines_of(text)) EXPECT_LE(text::width(line), 100u) << line;
        for (const Column& column : table.columns) EXPECT_NE(text.find(column.name), std::string::npos) << column.name;
    }
}

TEST(TableText, LeavesOutTheMiddleOfALongTableAndSaysSo) {
    Table table{"long", {{"row", "1", "", {}, ""}}};
    for (int i = 0; i < 1000; ++i) table.columns[0].values.push_back(i);
    const std::string text = to_text(table, 11);
    EXPECT_NE(text.find("989 rows left out"), std::string::npos);
    for (const char* kept : {"\n    5\n", "\n  995\n", "\n  999\n"})
        EXPECT_NE(text.find(kept), std::string::npos) << kept;
    for (const char* dropped : {"\n    6\n", "\n  994\n"}) EXPECT_EQ(text.find(dropped), std::string::npos) << dropped;
    EXPECT_EQ(to_text(table, 1000).find("left out"), std::string::npos);
}

TEST(TableOutput, RefusesColumnsOfDifferentLengths) {
    Table table = small();
    table.columns[1].values.pop_back();
    EXPECT_THROW((void)to_text(table), InvalidInput);
    EXPECT_THROW((void)to_json(table), InvalidInput);
    const test::TemporaryFolder folder;
    EXPECT_THROW(write_csv(folder / "table.csv", table), InvalidInput);
    EXPECT_TRUE(folder.names().empty());
}

TEST(TableOutput, ShowsATableWithoutRowsOrColumns) {
    EXPECT_EQ(to_text({"nothing", {}}), "nothing\n");
    EXPECT_NE(to_text({"nothing", {{"speed", "m/s", "", {}, ""}}}).find("speed"), std::string::npos);
}

}  // namespace
}  // namespace footfall
