// The JSON of a run, parsed again.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "footfall/io/output.hpp"
#include "footfall/version.hpp"
#include "io/hand_made_run.hpp"

namespace footfall::test {
namespace {

using Json = nlohmann::ordered_json;
using Names = std::vector<std::string>;

Names keys(const Json& object) {
    Names names;
    for (const auto& item : object.items()) names.push_back(item.key());
    return names;
}

class OutputJson : public ::testing::Test {
protected:
    footfall::Run run = two_sphere_run();
    Json json = Json::parse(to_json(two_sphere_scenario(), run));
};

TEST_F(OutputJson, HasTheDocumentedFieldsAndNoOthers) {
    EXPECT_EQ(keys(json),
              (Names{"final", "events", "impacts", "energy", "steps", "evaluations", "wall_seconds", "version"}));
    EXPECT_EQ(keys(json["final"]), (Names{"time", "position", "velocity", "angular_velocity", "orientation"}));
    EXPECT_EQ(keys(json["events"][0]), (Names{"time", "kind", "sphere"}));
    EXPECT_EQ(keys(json["impacts"][0]),
              (Names{"sphere", "touchdown", "separation", "recovered", "speed_in", "speed_out", "restitution",
                     "peak_normal_force", "peak_indentation", "stick_time"}));
    EXPECT_EQ(keys(json["energy"]), (Names{"initial", "kinetic", "potential", "normal_spring", "tangential_spring",
                                           "normal_damper", "tangential_damper", "clutch", "stiffness_change",
                                           "tangential_spring_paper", "residual", "max_residual"}));
}

TEST_F(OutputJson, NumbersReadBackExactly) {
    const BodyState& body = run.final.body;
    EXPECT_EQ(json["final"]["time"], 0.3);
    EXPECT_EQ(json["final"]["position"].get<std::vector<double>>(),
              (std::vector<double>{body.position.x(), body.position.y(), body.position.z()}));
    EXPECT_EQ(json["final"]["velocity"][1].get<double>(), body.velocity.y());
    EXPECT_EQ(json["final"]["angular_velocity"][2].get<double>(), body.angular_velocity.z());
    EXPECT_EQ(
        json["final"]["orientation"].get<std::vector<double>>(),
        (std::vector<double>{body.orientation.w(), body.orientation.x(), body.orientation.y(), body.orientation.z()}));
    EXPECT_EQ(json["impacts"][0]["separation"].get<double>(), *run.impacts[0].separation);
    EXPECT_EQ(json["impacts"][0]["restitution"].get<double>(), 0.625);
    EXPECT_EQ(json["impacts"][1]["peak_indentation"].get<double>(), 1e-5);
    const Ledger& ledger = run.final.ledger;
    const Json& energy = json["energy"];
    EXPECT_EQ(energy["initial"].get<double>(), run.initial.ledger.total());
    EXPECT_EQ(energy["kinetic"].get<double>(), ledger.kinetic);
    EXPECT_EQ(energy["potential"].get<double>(), ledger.potential);
    EXPECT_EQ(energy["normal_spring"].get<double>(), ledger.contact.normal_spring);
    EXPECT_EQ(energy["tangential_spring"].get<double>(), ledger.contact.tangential_spring);
    EXPECT_EQ(energy["normal_damper"].get<double>(), ledger.contact.normal_damper);
    EXPECT_EQ(energy["tangential_damper"].get<double>(), ledger.contact.tangential_damper);
    EXPECT_EQ(energy["clutch"].get<double>(), ledger.contact.clutch);
    EXPECT_EQ(energy["stiffness_change"].get<double>(), ledger.contact.stiffness_change);
    EXPECT_EQ(energy["tangential_spring_paper"].get<double>(),
              ledger.contact.tangential_spring + ledger.contact.stiffness_change);
    EXPECT_EQ(energy["residual"].get<double>(), run.residual());
    EXPECT_EQ(energy["max_residual"].get<double>(), run.max_residual);
    EXPECT_EQ(json["steps"], 1234);
    EXPECT_EQ(json["evaluations"], 5'000'000'000);
    EXPECT_EQ(json["wall_seconds"].get<double>(), 0.0125);
    EXPECT_EQ(json["version"], version);
}

// Programs compare the text of two runs.
TEST_F(OutputJson, IsIndentedByTwoLikeAnyOtherJsonAndEndsWithItsBrace) {
    EXPECT_EQ(to_json(two_sphere_scenario(), run), json.dump(2));
    run.events.clear();
    run.impacts.clear();
    const std::string empty = to_json(two_sphere_scenario(), run);
    EXPECT_EQ(empty, Json::parse(empty).dump(2));
}

TEST_F(OutputJson, SaysHowLongEachImpactStuck) {
    EXPECT_EQ(json["impacts"][0]["stick_time"].get<double>(), run.impacts[0].stick_time);
    EXPECT_EQ(json["impacts"][1]["stick_time"].get<double>(), run.impacts[1].stick_time);
    EXPECT_GT(run.impacts[0].stick_time, 0);
}

TEST_F(OutputJson, EventsHaveTheirNames) {
    ASSERT_EQ(json["events"].size(), 3U);
    EXPECT_EQ(json["events"][1], (Json{{"time", 0.06}, {"kind", "touchdown"}, {"sphere", 1}}));
    EXPECT_EQ(json["events"][2]["kind"], "recovered");
}

TEST_F(OutputJson, WhatHasNotHappenedIsNull) {
    for (const char* field : {"separation", "recovered", "speed_out", "restitution"}) {
        EXPECT_TRUE(json["impacts"][0][field].is_number()) << field;
        EXPECT_TRUE(json["impacts"][1][field].is_null()) << field;
    }
}

TEST_F(OutputJson, ListsAreListsWhenTheyAreEmpty) {
    const Json empty = Json::parse(to_json(two_sphere_scenario(), uneventful_run()));
    EXPECT_EQ(empty["events"], Json::array());
    EXPECT_EQ(empty["impacts"], Json::array());
}

}  // namespace
}  // namespace footfall::test
