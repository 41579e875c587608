// The table of the channels, and that every output has what is in it.
#include "footfall/energy/channels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "footfall/io/output.hpp"
#include "footfall/io/rig.hpp"
#include "footfall/study/drive.hpp"
#include "io/hand_made_run.hpp"
#include "io/run_dataset.hpp"
#include "io/temporary_folder.hpp"

namespace footfall {
namespace {

constexpr std::array kinds{ChannelKind::held, ChannelKind::taken, ChannelKind::unpaid, ChannelKind::worked};

TEST(Channels, AreAllMembersOfAContactsEnergyAndEachOnce) {
    EXPECT_EQ(contact_channels.size() * sizeof(double), sizeof(ContactEnergy))
        << "a member without a row, or the reverse";
    ContactEnergy energy;
    std::set<std::string_view> names;
    for (const ContactChannel& channel : contact_channels) {
        EXPECT_EQ(energy.*channel.member, 0) << channel.name << " has the member of another";
        energy.*channel.member = 1;
        EXPECT_TRUE(names.insert(channel.name).second) << channel.name;
        EXPECT_TRUE(channel.description.starts_with("energy ")) << channel.description;
    }
}

TEST(Channels, EachCountsInTheSumOfItsKindAlone) {
    for (const ContactChannel& channel : contact_channels) {
        ContactEnergy energy;
        energy.*channel.member = 3;
        const std::array sums{energy.stored(), energy.dissipated(), energy.unpaid(), energy.worked()};
        for (std::size_t i = 0; i < kinds.size(); ++i)
            EXPECT_EQ(sums[i], channel.kind == kinds[i] ? 3 : 0) << channel.name;
        ContactEnergy twice = energy;
        twice += energy;
        EXPECT_EQ(twice.*channel.member, 6) << channel.name;
    }
}

// What is worked from outside is what the rest has got: the balance of a rig has no other entry.
TEST(Channels, BalanceOfARigIsWhatIsHeldAndTakenLessWhatIsWorked) {
    const auto check = [](const auto& channel, const RigEnergy& energy) {
        EXPECT_EQ(energy.balance(), channel.kind == ChannelKind::worked ? -5 : 5) << channel.name;
        EXPECT_EQ(energy.magnitude(), 5) << channel.name;
        EXPECT_EQ(energy.held(), channel.kind == ChannelKind::held ? 5 : 0) << channel.name;
        EXPECT_EQ(energy.taken(), channel.kind == ChannelKind::taken ? 5 : 0) << channel.name;
        EXPECT_EQ(energy.worked(), channel.kind == ChannelKind::worked ? 5 : 0) << channel.name;
    };
    for (const auto& channel : rig_channels) {
        RigEnergy energy;
        energy.*channel.member = 5;
        check(channel, energy);
    }
    for (const auto& channel : contact_channels) {
        RigEnergy energy;
        energy.contact.*channel.member = 5;
        check(channel, energy);
    }
}

TEST(Channels, AreInTheTablesOfARun) {
    const test::TemporaryFolder folder;
    write_csv(folder.path(), test::two_sphere_scenario(), test::two_sphere_run());
    const std::string samples = test::read_text(folder / "samples.csv");
    const std::string head = "," + samples.substr(0, samples.find('\n')) + ",";
    const auto expect = [&](std::string_view name, std::string_view suffix, std::string_view unit) {
        const std::string heading =
            std::string(",energy_").append(name).append(suffix).append(" [").append(unit) + "],";
        EXPECT_NE(head.find(heading), head.npos) << heading;
    };
    for (const ContactChannel& channel : contact_channels)
        for (const char* suffix : {"", "_0", "_1"}) expect(channel.name, suffix, channel.unit);
    for (const auto& channel : body_channels) expect(channel.name, "", channel.unit);
}

TEST(Channels, AreInTheDatasetOfARun) {
    const footfall::Run run = test::two_sphere_run();
    const Scenario scenario = test::two_sphere_scenario();
    const io::RunDataset data = io::run_dataset(scenario, run);
    const auto last = [&](const std::string& name) {
        const auto at = std::find_if(data.variables.begin(), data.variables.end(),
                                     [&](const io::Variable& v) { return v.name == name; });
        if (at == data.variables.end()) return std::nan("");
        return std::get<io::Gather<double>>(at->values)().back();
    };
    const Snapshot& end = run.samples.back();
    for (const ContactChannel& channel : contact_channels) {
        const std::string name(channel.name);
        EXPECT_EQ(last("energy_" + name), end.ledger.contact.*channel.member) << name;
        EXPECT_EQ(last("sphere_energy_" + name), end.contacts.back().energy.*channel.member) << name;
    }
    for (const auto& channel : body_channels)
        EXPECT_EQ(last("energy_" + std::string(channel.name)), end.ledger.*channel.member) << channel.name;
}

TEST(Channels, AreInTheJsonOfARun) {
    const footfall::Run run = test::two_sphere_run();
    const auto energy = nlohmann::json::parse(to_json(test::two_sphere_scenario(), run))["energy"];
    for (const ContactChannel& channel : contact_channels)
        EXPECT_EQ(energy.value(std::string(channel.name), 0.0), run.final.ledger.contact.*channel.member)
            << channel.name;
    for (const auto& channel : body_channels)
        EXPECT_EQ(energy.value(std::string(channel.name), 0.0), run.final.ledger.*channel.member) << channel.name;
}

TEST(Channels, AreInTheSummaryOfARun) {
    const std::string page = summary(test::two_sphere_scenario(), test::two_sphere_run());
    for (const ContactChannel& channel : contact_channels) {
        std::string words(channel.name);
        std::replace(words.begin(), words.end(), '_', ' ');
        EXPECT_NE(page.find(words), page.npos) << words;
    }
}

TEST(Channels, AreInTheTableAndTheJsonOfARig) {
    RigRun run;
    run.laws = {AzadFeatherstoneNormal<>{}, AzadFeatherstoneFriction<>{}};
    run.named.name = "one";
    RigEnergy& energy = run.named.drive.samples.emplace_back().energy;
    double next = 0;
    for (const auto& channel : contact_channels) energy.contact.*channel.member = ++next;
    for (const auto& channel : rig_channels) energy.*channel.member = ++next;
    Rig rig;
    rig.drag = Drag::mass;
    const Table table = drive_table(rig, {run.named});
    const auto json = nlohmann::json::parse(to_json(rig, std::vector<RigRun>{run}))["runs"][0]["energy"];
    const auto expect = [&](const auto& channel, double value) {
        const std::string name(channel.name);
        EXPECT_EQ(json.value(name, 0.0), value) << name;
        const auto column =
            std::find_if(table.columns.begin(), table.columns.end(), [&](const Column& c) { return c.name == name; });
        ASSERT_NE(column, table.columns.end()) << name;
        EXPECT_EQ(column->values, std::vector{value}) << name;
        EXPECT_EQ(column->unit, channel.unit) << name;
    };
    for (const auto& channel : contact_channels) expect(channel, energy.contact.*channel.member);
    for (const auto& channel : rig_channels) expect(channel, energy.*channel.member);
}

}  // namespace
}  // namespace footfall
