// The tables of a run, parsed again.
#include <charconv>
#include <map>

#include <gtest/gtest.h>

#include "footfall/io/output.hpp"
#include "io/hand_made_run.hpp"
#include "io/temporary_folder.hpp"

namespace footfall::test {
namespace {

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> cells(1);
    for (const char c : line) {
        if (c == ',') {
            cells.emplace_back();
        } else {
            cells.back() += c;
        }
    }
    return cells;
}

/// Rows as maps from heading to cell. Every row must have as many cells as the heading.
std::vector<std::map<std::string, std::string>> parse(const std::filesystem::path& file) {
    std::istringstream stream(read_text(file));
    std::string line;
    std::getline(stream, line);
    const std::vector<std::string> head = split(line);
    std::vector<std::map<std::string, std::string>> rows;
    while (std::getline(stream, line)) {
        const std::vector<std::string> cells = split(line);
        EXPECT_EQ(cells.size(), head.size()) << line;
        auto& row = rows.emplace_back();
        for (std::size_t i = 0; i < cells.size(); ++i) {
            EXPECT_TRUE(row.emplace(head[i], cells[i]).second) << "two columns named " << head[i];
        }
    }
    return rows;
}

/// The whole of a cell as a number.
double number(const std::string& cell) {
    double value = 0;
    const auto result = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    EXPECT_EQ(result.ptr, cell.data() + cell.size()) << cell;
    return value;
}

class OutputCsv : public ::testing::Test {
protected:
    TemporaryFolder folder;
    Scenario scenario = two_sphere_scenario();
    footfall::Run run = two_sphere_run();
};

TEST_F(OutputCsv, MakesTheFolderAndThreeTables) {
    write_csv(folder / "a" / "b", scenario, run);
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "a" / "b")) {
        names.insert(entry.path().filename());
    }
    EXPECT_EQ(names, (std::set<std::string>{"events.csv", "impacts.csv", "samples.csv"}));
}

TEST_F(OutputCsv, SamplesReadBackExactly) {
    write_csv(folder.path(), scenario, run);
    const auto rows = parse(folder / "samples.csv");
    ASSERT_EQ(rows.size(), run.samples.size());
    for (std::size_t t = 0; t < rows.size(); ++t) {
        const auto at = [&](const char* heading) { return number(rows[t].at(heading)); };
        const Snapshot& sample = run.samples[t];
        EXPECT_EQ(at("time [s]"), sample.time);
        EXPECT_EQ(at("position_z [m]"), sample.body.position.z());
        EXPECT_EQ(at("orientation_w [1]"), sample.body.orientation.w());
        EXPECT_EQ(at("angular_velocity_x [rad/s]"), sample.body.angular_velocity.x());
        EXPECT_EQ(at("depth_0 [m]"), sample.contacts[0].depth);
        EXPECT_EQ(at("friction_force_1_y [N]"), sample.contacts[1].friction_force.y());
        EXPECT_EQ(at("energy_stiffness_change_1 [J]"), sample.contacts[1].energy.stiffness_change);
        EXPECT_EQ(at("energy_potential [J]"), sample.ledger.potential);
        EXPECT_EQ(at("energy_normal_damper [J]"), sample.ledger.contact.normal_damper);
        EXPECT_EQ(at("energy_total [J]"), sample.ledger.total());
    }
    EXPECT_EQ(rows[2].at("phase_0"), "recovering");
    EXPECT_EQ(rows[2].at("phase_1"), "slip");
}

TEST_F(OutputCsv, EventsNameTheirKindAndSphere) {
    write_csv(folder.path(), scenario, run);
    const auto rows = parse(folder / "events.csv");
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[1].at("kind"), "touchdown");
    EXPECT_EQ(rows[1].at("sphere"), "1");
    EXPECT_EQ(rows[2].at("kind"), "recovered");
    EXPECT_EQ(number(rows[2].at("time [s]")), 0.21);
    EXPECT_EQ(number(rows[1].at("depth [m]")), run.events[1].state.contacts[1].depth);
}

TEST_F(OutputCsv, ImpactsLeaveACellEmptyForWhatHasNotHappened) {
    write_csv(folder.path(), scenario, run);
    const auto rows = parse(folder / "impacts.csv");
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(number(rows[0].at("separation [s]")), *run.impacts[0].separation);
    EXPECT_EQ(number(rows[0].at("restitution [1]")), 0.625);
    EXPECT_EQ(number(rows[0].at("peak_indentation [m]")), run.impacts[0].peak_indentation);
    for (const char* heading : {"separation [s]", "recovered [s]", "speed_out [m/s]", "restitution [1]"}) {
        EXPECT_EQ(rows[1].at(heading), "") << heading;
    }
    EXPECT_EQ(number(rows[1].at("speed_in [m/s]")), 1.0 / 3);
}

TEST_F(OutputCsv, RefusesAFolderThatIsAFile) {
    const auto file = folder.write("file", "older");
    EXPECT_THROW(check_csv_directory(file), std::runtime_error);
    EXPECT_THROW(write_csv(file, scenario, run), std::runtime_error);
    EXPECT_THROW(write_csv(file / "below", scenario, run), std::runtime_error);
    EXPECT_EQ(read_text(file), "older");
}

TEST_F(OutputCsv, AskingBeforeTheRunMakesNothing) {
    check_csv_directory(folder / "new");
    EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace footfall::test
