// The NetCDF file of a run, read back with NetCDF's own interface.
#include <cmath>
#include <cstring>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <netcdf.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include "footfall/io/output.hpp"
#include "footfall/version.hpp"
#include "io/hand_made_run.hpp"
#include "io/temporary_folder.hpp"

namespace footfall::test {
namespace {

/// A NetCDF file opened for reading.
class Reader {
public:
    explicit Reader(const std::filesystem::path& file) { expect(nc_open(file.c_str(), NC_NOWRITE, &id_)); }
    ~Reader() { nc_close(id_); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    [[nodiscard]] std::size_t length(const char* dimension) const {
        int number = 0;
        std::size_t length = 0;
        expect(nc_inq_dimid(id_, dimension, &number));
        expect(nc_inq_dimlen(id_, number, &length));
        return length;
    }

    [[nodiscard]] std::vector<std::string> variables() const {
        int count = 0;
        expect(nc_inq_nvars(id_, &count));
        std::vector<std::string> names;
        for (int i = 0; i < count; ++i) {
            char name[NC_MAX_NAME + 1];
            expect(nc_inq_varname(id_, i, name));
            names.emplace_back(name);
        }
        return names;
    }

    [[nodiscard]] std::vector<std::string> dimensions(const std::string& variable) const {
        int count = 0;
        int numbers[NC_MAX_VAR_DIMS];
        expect(nc_inq_var(id_, number(variable), nullptr, nullptr, &count, numbers, nullptr));
        std::vector<std::string> names;
        for (int i = 0; i < count; ++i) {
            char name[NC_MAX_NAME + 1];
            expect(nc_inq_dimname(id_, numbers[i], name));
            names.emplace_back(name);
        }
        return names;
    }

    [[nodiscard]] std::vector<double> numbers(const std::string& variable) const {
        std::size_t size = 1;
        for (const std::string& dimension : dimensions(variable)) size *= length(dimension.c_str());
        std::vector<double> values(size);
        expect(nc_get_var_double(id_, number(variable), values.data()));
        return values;
    }

    [[nodiscard]] std::vector<std::string> labels(const std::string& variable) const {
        std::vector<char*> pointers(length(dimensions(variable).at(0).c_str()));
        expect(nc_get_var_string(id_, number(variable), pointers.data()));
        std::vector<std::string> values(pointers.begin(), pointers.end());
        expect(nc_free_string(pointers.size(), pointers.data()));
        return values;
    }

    /// Of the variable, or of the file where that is empty.
    [[nodiscard]] std::string text(const std::string& variable, const char* attribute) const {
        const int of = variable.empty() ? NC_GLOBAL : number(variable);
        std::size_t length = 0;
        if (nc_inq_attlen(id_, of, attribute, &length) != NC_NOERR) return "";
        std::string value(length, '\0');
        expect(nc_get_att_text(id_, of, attribute, value.data()));
        return value;
    }

    [[nodiscard]] std::vector<double> attribute(const std::string& variable, const char* name) const {
        const int of = variable.empty() ? NC_GLOBAL : number(variable);
        std::size_t length = 0;
        expect(nc_inq_attlen(id_, of, name, &length));
        std::vector<double> values(length);
        expect(nc_get_att_double(id_, of, name, values.data()));
        return values;
    }

private:
    static void expect(int status) { EXPECT_EQ(status, NC_NOERR) << nc_strerror(status); }
    [[nodiscard]] int number(const std::string& variable) const {
        int number = 0;
        const int status = nc_inq_varid(id_, variable.c_str(), &number);
        EXPECT_EQ(status, NC_NOERR) << variable << ": " << nc_strerror(status);
        return number;
    }

    int id_ = 0;
};

using Names = std::vector<std::string>;

class OutputNetcdf : public ::testing::Test {
protected:
    TemporaryFolder folder;
    Scenario scenario = two_sphere_scenario();
    footfall::Run run = two_sphere_run();
};

TEST_F(OutputNetcdf, HasOneDimensionForEachKindOfList) {
    write_netcdf(folder / "run.nc", scenario, run);
    const Reader file(folder / "run.nc");
    EXPECT_EQ(file.length("time"), 4U);
    EXPECT_EQ(file.length("sphere"), 2U);
    EXPECT_EQ(file.length("axis"), 3U);
    EXPECT_EQ(file.length("quaternion"), 4U);
    EXPECT_EQ(file.length("event"), 3U);
    EXPECT_EQ(file.length("impact"), 2U);
    EXPECT_EQ(file.labels("axis"), (Names{"x", "y", "z"}));
    EXPECT_EQ(file.labels("quaternion"), (Names{"w", "x", "y", "z"}));
    EXPECT_EQ(file.dimensions("position"), (Names{"time", "axis"}));
    EXPECT_EQ(file.dimensions("orientation"), (Names{"time", "quaternion"}));
    EXPECT_EQ(file.dimensions("friction_force"), (Names{"time", "sphere", "axis"}));
    EXPECT_EQ(file.dimensions("sphere_energy_clutch"), (Names{"time", "sphere"}));
    EXPECT_EQ(file.dimensions("energy_clutch"), (Names{"time"}));
    EXPECT_EQ(file.dimensions("event_bristle"), (Names{"event", "axis"}));
}

TEST_F(OutputNetcdf, EveryVariableHasUnitsAndALongName) {
    write_netcdf(folder / "run.nc", scenario, run);
    const Reader file(folder / "run.nc");
    const Names variables = file.variables();
    EXPECT_GT(variables.size(), 50U);
    for (const std::string& variable : variables) {
        EXPECT_NE(file.text(variable, "units"), "") << variable;
        EXPECT_NE(file.text(variable, "long_name"), "") << variable;
    }
    EXPECT_EQ(file.text("time", "units"), "s");
    EXPECT_EQ(file.text("depth_rate", "units"), "m/s");
    EXPECT_EQ(file.text("friction_stiffness", "units"), "N/m^1.5");
}

TEST_F(OutputNetcdf, HoldsTheSamplesExactly) {
    write_netcdf(folder / "run.nc", scenario, run);
    const Reader file(folder / "run.nc");
    const auto time = file.numbers("time"), position = file.numbers("position"),
               orientation = file.numbers("orientation"), angular = file.numbers("angular_velocity"),
               velocity = file.numbers("velocity"), depth = file.numbers("depth"), rate = file.numbers("depth_rate"),
               force = file.numbers("normal_force"), friction = file.numbers("friction_force"),
               slip = file.numbers("slip_velocity"), bristle = file.numbers("bristle"), phase = file.numbers("phase"),
               held = file.numbers("sphere_energy_normal_spring"), taken = file.numbers("sphere_energy_clutch"),
               kinetic = file.numbers("energy_kinetic"), clutch = file.numbers("energy_clutch"),
               total = file.numbers("energy_total"), residual = file.numbers("energy_residual");
    const double initial = run.initial.ledger.total();
    for (std::size_t t = 0; t < run.samples.size(); ++t) {
        const Snapshot& sample = run.samples[t];
        EXPECT_EQ(time[t], sample.time);
        EXPECT_EQ(orientation[4 * t], sample.body.orientation.w());
        EXPECT_EQ(orientation[4 * t + 3], sample.body.orientation.z());
        EXPECT_EQ(kinetic[t], sample.ledger.kinetic);
        EXPECT_EQ(clutch[t], sample.contacts[0].energy.clutch + sample.contacts[1].energy.clutch);
        EXPECT_EQ(total[t], sample.ledger.total());
        EXPECT_DOUBLE_EQ(residual[t], (total[t] - initial) / 400);
        for (int i = 0; i < 3; ++i) {
            EXPECT_EQ(position[3 * t + i], sample.body.position[i]);
            EXPECT_EQ(velocity[3 * t + i], sample.body.velocity[i]);
            EXPECT_EQ(angular[3 * t + i], sample.body.angular_velocity[i]);
        }
        for (std::size_t s = 0; s < 2; ++s) {
            const ContactSnapshot& contact = sample.contacts[s];
            EXPECT_EQ(depth[2 * t + s], contact.depth);
            EXPECT_EQ(rate[2 * t + s], contact.depth_rate);
            EXPECT_EQ(force[2 * t + s], contact.normal_force);
            EXPECT_EQ(phase[2 * t + s], static_cast<double>(contact.phase));
            EXPECT_EQ(held[2 * t + s], contact.energy.normal_spring);
            EXPECT_EQ(taken[2 * t + s], contact.energy.clutch);
            for (int i = 0; i < 3; ++i) {
                EXPECT_EQ(friction[3 * (2 * t + s) + i], contact.friction_force[i]);
                EXPECT_EQ(slip[3 * (2 * t + s) + i], contact.slip_velocity[i]);
                EXPECT_EQ(bristle[3 * (2 * t + s) + i], contact.bristle[i]);
            }
        }
    }
    EXPECT_EQ(file.text("phase", "flag_meanings"), "flight stick slip recovering");
    EXPECT_EQ(file.attribute("phase", "flag_values"), (std::vector<double>{0, 1, 2, 3}));
}

TEST_F(OutputNetcdf, HoldsEveryChannelOfTheLedger) {
    write_netcdf(folder / "run.nc", scenario, run);
    const Reader file(folder / "run.nc");
    const Ledger& last = run.samples.back().ledger;
    const auto at_end = [&](const char* name) { return file.numbers(name).back(); };
    EXPECT_EQ(at_end("energy_potential"), last.potential);
    EXPECT_EQ(at_end("energy_normal_spring"), last.contact.normal_spring);
    EXPECT_EQ(at_end("energy_tangential_spring"), last.contact.tangential_spring);
    EXPECT_EQ(at_end("energy_normal_damper"), last.contact.normal_damper);
    EXPECT_EQ(at_end("energy_tangential_damper"), last.contact.tangential_damper);
    EXPECT_EQ(at_end("energy_stiffness_change"), last.contact.stiffness_change);
    EXPECT_EQ(at_end("energy_tangential_spring_paper"), last.contact.tangential_spring + last.contact.stiffness_change);
    const ContactEnergy& second = run.samples.back().contacts[1].energy;
    EXPECT_EQ(at_end("sphere_energy_tangential_spring"), second.tangential_spring);
    EXPECT_EQ(at_end("sphere_energy_normal_damper"), second.normal_damper);
    EXPECT_EQ(at_end("sphere_energy_tangential_damper"), second.tangential_damper);
    EXPECT_EQ(at_end("sphere_energy_stiffness_change"), second.stiffness_change);
}

TEST_F(OutputNetcdf, HoldsEventsWithTheStateOfTheirSphere) {
    write_netcdf(folder / "run.nc", scenario, run);
    const Reader file(folder / "run.nc");
    EXPECT_EQ(file.numbers("event_time"), (std::vector<double>{0.05, 0.06, 0.21}));
    EXPECT_EQ(file.numbers("event_kind"), (std::vector<double>{0, 0, 4}));
    EXPECT_EQ(file.text("event_kind", "flag_meanings"), "touchdown stick slip separation recovered");
    EXPECT_EQ(file.numbers("event_sphere"), (std::vector<double>{0, 1, 0}));
    EXPECT_EQ(file.numbers("event_depth")[1], run.events[1].state.contacts[1].depth);
    EXPECT_EQ(file.numbers("event_position")[3 + 2], run.events[1].state.body.position.z());
}

TEST_F(OutputNetcdf, MarksWhatHasNotHappenedAsMissing) {
    write_netcdf(folder / "run.nc", scenario, run);
    const Reader file(folder / "run.nc");
    for (const char* name : {"impact_separation", "impact_recovered", "impact_speed_out", "impact_restitution"}) {
        EXPECT_FALSE(std::isnan(file.numbers(name)[0])) << name;
        EXPECT_TRUE(std::isnan(file.numbers(name)[1])) << name;
        EXPECT_TRUE(std::isnan(file.attribute(name, "_FillValue").at(0))) << name;
    }
    EXPECT_EQ(file.numbers("impact_restitution")[0], 0.625);
    EXPECT_EQ(file.numbers("impact_sphere"), (std::vector<double>{0, 1}));
    EXPECT_EQ(file.numbers("impact_touchdown"), (std::vector<double>{0.05, 0.06}));
    EXPECT_EQ(file.numbers("impact_peak_normal_force"), (std::vector<double>{100.0 / 3, 7}));
    EXPECT_EQ(file.numbers("impact_stick_time"), (std::vector<double>{2e-4 / 3, 0}));
}

TEST_F(OutputNetcdf, SaysWhatWasRun) {
    write_netcdf(folder / "run.nc", scenario, run);
    const Reader file(folder / "run.nc");
    EXPECT_EQ(file.text("", "title"), scenario.title);
    EXPECT_EQ(file.text("", "scenario"), scenario.text);
    EXPECT_EQ(file.text("", "footfall_version"), version);
    EXPECT_EQ(file.text("", "normal_law"), "azad-featherstone");
    EXPECT_EQ(file.attribute("", "tolerance").at(0), 1e-11);
    EXPECT_EQ(file.attribute("", "max_residual").at(0), run.max_residual);
    EXPECT_EQ(file.attribute("", "steps").at(0), 1234);
    EXPECT_EQ(file.attribute("", "evaluations").at(0), 5e9);
    EXPECT_EQ(file.numbers("sphere_radius"), (std::vector<double>{0.0165, 0.02}));
    EXPECT_EQ(file.numbers("sphere_center"), (std::vector<double>{0.01, 0, -0.02, -0.03, 0.04, -0.02}));
    EXPECT_EQ(file.numbers("friction_coefficient"), (std::vector<double>{0.2, 0.3}));
}

TEST_F(OutputNetcdf, SaysWhichSphereIsUnderWhichLaw) {
    scenario.simulation.contacts[1].normal = LinearNormal<>{4e4, 7};
    scenario.simulation.contacts[0].friction = NoFriction<>{};
    write_netcdf(folder / "run.nc", scenario, run);
    const Reader file(folder / "run.nc");
    EXPECT_EQ(file.text("", "normal_law"), "azad-featherstone, linear");
    EXPECT_EQ(file.numbers("normal_linear_stiffness")[1], 4e4);
    EXPECT_EQ(file.numbers("normal_linear_damping")[1], 7);
    EXPECT_TRUE(std::isnan(file.numbers("normal_linear_damping")[0]));
    EXPECT_FALSE(std::isnan(file.numbers("normal_azad_featherstone_stiffness")[0]));
    EXPECT_TRUE(std::isnan(file.numbers("normal_azad_featherstone_stiffness")[1]));
    EXPECT_EQ(file.text("", "friction_law").substr(0, 6), "none, ");
}

TEST_F(OutputNetcdf, ListsTheChannelsOfEnergyInTheirOrder) {
    write_netcdf(folder / "run.nc", scenario, run);
    const std::string list = Reader(folder / "run.nc").text("", "energy_channels");
    std::size_t at = 0;
    for (const ContactChannel& channel : contact_channels) {
        const std::string entry = fmt::format("{}: {}: {}", channel.name, name_of(channel.kind), channel.label);
        EXPECT_EQ(list.substr(at, entry.size()), entry);
        at += entry.size() + 2;
    }
    EXPECT_EQ(at, list.size() + 2);
}

TEST_F(OutputNetcdf, HoldsARunWithoutEvents) {
    write_netcdf(folder / "run.nc", scenario, uneventful_run());
    const Reader file(folder / "run.nc");
    EXPECT_EQ(file.length("time"), 1U);
    EXPECT_EQ(file.length("event"), 0U);
    EXPECT_EQ(file.length("impact"), 0U);
}

TEST_F(OutputNetcdf, ReplacesAnOlderFileAndLeavesNothingElse) {
    folder.write("run.nc", "older");
    write_netcdf(folder / "run.nc", scenario, run);
    EXPECT_EQ(Reader(folder / "run.nc").length("time"), 4U);
    EXPECT_EQ(folder.names(), (std::set<std::string>{"run.nc"}));
}

TEST_F(OutputNetcdf, WritesThroughASymbolicLink) {
    folder.write("target.nc", "older");
    std::filesystem::create_symlink("target.nc", folder / "link.nc");
    write_netcdf(folder / "link.nc", scenario, run);
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.nc"));
    EXPECT_EQ(Reader(folder / "target.nc").length("time"), 4U);
}

/// The message of what `write` throws, which must be a std::runtime_error.
template <class Write>
std::string error_of(Write write) {
    try {
        write();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return "";
}

TEST_F(OutputNetcdf, NamesAFolderThatDoesNotExist) {
    const auto file = folder / "missing" / "run.nc";
    const std::string message = error_of([&] { write_netcdf(file, scenario, run); });
    EXPECT_NE(message.find(file.string()), std::string::npos) << message;
    EXPECT_NE(message.find("does not exist"), std::string::npos) << message;
    EXPECT_EQ(error_of([&] { check_netcdf_file(file); }), message);
    EXPECT_TRUE(folder.names().empty());
}

TEST_F(OutputNetcdf, RefusesToReplaceWhatIsNotAFile) {
    EXPECT_NE(error_of([&] { write_netcdf(folder.path(), scenario, run); }).find("it is a folder"), std::string::npos);
    EXPECT_NE(error_of([&] { write_netcdf("/dev/null", scenario, run); }).find("not a regular file"),
              std::string::npos);
    folder.write("file", "");
    EXPECT_NE(error_of([&] { write_netcdf(folder / "file" / "run.nc", scenario, run); }).find("is not a folder"),
              std::string::npos);
    std::filesystem::create_symlink("nowhere.nc", folder / "link.nc");
    EXPECT_NE(error_of([&] { write_netcdf(folder / "link.nc", scenario, run); }).find("leads to no file"),
              std::string::npos);
    EXPECT_EQ(folder.names(), (std::set<std::string>{"file", "link.nc"}));
}

TEST_F(OutputNetcdf, RefusesAFolderThatCannotBeWritten) {
    if (::geteuid() == 0) GTEST_SKIP() << "every folder can be written by this user";
    std::filesystem::permissions(folder.path(),
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    const std::string message = error_of([&] { write_netcdf(folder / "run.nc", scenario, run); });
    EXPECT_NE(message.find("Permission denied"), std::string::npos) << message;
    std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
    EXPECT_TRUE(folder.names().empty());
}

/// Lets this process write files of at most `bytes`, as a full disk would.
void limit_file_size(rlim_t bytes) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, bytes};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
}

TEST_F(OutputNetcdf, KeepsTheOlderFileWhereTheDiskIsFull) {
    folder.write("run.nc", "older");
    const auto write = [&] {
        limit_file_size(20'000);
        try {
            write_netcdf(folder / "run.nc", scenario, run);
        } catch (const std::runtime_error& error) {
            std::fputs(error.what(), stderr);
            ::_exit(7);
        }
        ::_exit(0);
    };
    EXPECT_EXIT(write(), ::testing::ExitedWithCode(7), "cannot write .*run.nc: File too large");
    EXPECT_EQ(read_text(folder / "run.nc"), "older");
    EXPECT_EQ(folder.names(), (std::set<std::string>{"run.nc"}));
}

TEST_F(OutputNetcdf, KeepsTheOlderTablesWhereTheDiskIsFull) {
    for (const char* name : {"samples.csv", "events.csv", "impacts.csv"}) folder.write(name, "older");
    const auto write = [&] {
        limit_file_size(1'000);
        try {
            write_csv(folder.path(), scenario, run);
        } catch (const std::runtime_error& error) {
            std::fputs(error.what(), stderr);
            ::_exit(7);
        }
        ::_exit(0);
    };
    EXPECT_EXIT(write(), ::testing::ExitedWithCode(7), "cannot write .*samples.csv: File too large");
    EXPECT_EQ(folder.names(), (std::set<std::string>{"events.csv", "impacts.csv", "samples.csv"}));
    for (const std::string& name : folder.names()) EXPECT_EQ(read_text(folder / name), "older") << name;
}

TEST_F(OutputNetcdf, SeveralThreadsWriteAtOnce) {
    write_netcdf(folder / "alone.nc", scenario, run);
    const std::string expected = read_text(folder / "alone.nc");
    constexpr int count = 8, times = 5;
    std::vector<std::thread> threads;
    for (int i = 0; i < count; ++i) {
        threads.emplace_back([&, i] {
            for (int k = 0; k < times; ++k) {
                write_netcdf(folder / fmt::format("{}.nc", i), scenario, run);
                check_netcdf_file(folder / "alone.nc");
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (int i = 0; i < count; ++i) EXPECT_EQ(read_text(folder / fmt::format("{}.nc", i)), expected) << i;
    EXPECT_EQ(folder.names().size(), count + 1U);
}

}  // namespace
}  // namespace footfall::test
