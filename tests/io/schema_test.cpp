#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <toml++/toml.h>

#include "footfall/io/scenario.hpp"
#include "footfall/law/registry.hpp"
#include "io/json_schema.hpp"

namespace footfall {
namespace {

using test::conforms;
using test::Json;

std::string read(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

Json json_of(const std::string& toml_text) {
    std::ostringstream text;
    text << toml::json_formatter{toml::parse(std::string_view(toml_text), std::string_view("test"))};
    return Json::parse(text.str());
}

const Json& schema() {
    static const Json parsed = Json::parse(scenario_schema());
    return parsed;
}

TEST(ScenarioSchema, ShippedScenariosConform) {
    int seen = 0;
    for (const auto& entry : std::filesystem::directory_iterator(FOOTFALL_SOURCE_DIR "/scenarios")) {
        if (entry.is_directory()) continue;  // the rigs of footfall drive
        EXPECT_TRUE(conforms(json_of(read(entry.path())), schema())) << entry.path();
        ++seen;
    }
    EXPECT_GE(seen, 11);
}

/// The reader and the schema agree about these.
struct Case {
    const char* change;  ///< added to a table of a valid scenario
    bool valid;
};

TEST(ScenarioSchema, RefusesWhatTheReaderRefuses) {
    const std::string start =
        "time.end = 1\n"
        "body.mass = 1\nbody.inertia = [1, 1, 1]\nbody.initial.position = [0, 0, 1]\n"
        "contact.normal.law = 'linear'\ncontact.normal.stiffness = 1\n";
    const std::string end = "[[body.spheres]]\nradius = 0.1\n";
    const Case cases[]{
        {"contact.normal.damping = 0", true},
        {"contact.normal.damping = '3 N s/m'", true},
        {"contact.normal.damping = -1", false},
        {"contact.normal.damping = 'three'", false},
        {"contact.normal.damping = []", false},
        {"", false},  // no damping
        {"contact.normal.damping = 0\ncontact.normal.n = 1.5", false},
        {"contact.normal.damping = 0\ncontact.friction.law = 'none'", true},
        {"contact.normal.damping = 0\ncontact.friction.law = 'nothing'", false},
        {"contact.normal.damping = 0\ncontact.friction.law = 'azad-featherstone'", false},
        {"contact.normal.damping = 0\ncontact.stick = 1", false},
        {"contact.normal.damping = 0\ncontact.allow_initial_penetration = 1", false},
        {"contact.normal.damping = 0\nground.slope = 0.1", true},
        {"contact.normal.damping = 0\nground.slope = 2", false},
        {"contact.normal.damping = 0\nground.slope = 0.1\nground.normal = [0, 0, 1]", false},
        {"contact.normal.damping = 0\nsolver.tolerance = 1e-14", true},
        {"contact.normal.damping = 0\nsolver.tolerance = 1e-15", false},
        {"contact.normal.damping = 0\nbody.initial.velocity = [1, 2]", false},
        {"contact.normal.damping = 0\nbody.initial.rotation = {axis = [0, 0, 1], angle = '3 deg'}", true},
        {"contact.normal.damping = 0\nbody.initial.rotation = {axis = [0, 0, 1]}", false},
        {"contact.normal.damping = 0\nbody.sphere = 1", false},
        {"contact.normal.damping = 0\ngravity = 9.81", false},
        {"contact.normal.damping = 0\ntitle = 'x'", true},
        {"contact.normal.damping = 0\ntitle = 1", false},
        {"contact.normal.damping = 0\n"
         "contact.material = {damping_time = 1, sphere = {youngs_modulus = 1, poisson_ratio = 0}, "
         "ground = {youngs_modulus = 1, poisson_ratio = 0}}",
         false},  // the linear law does not know materials
    };
    for (const Case& c : cases) {
        const std::string text = start + c.change + "\n" + end;
        bool accepted = true;
        try {
            (void)parse_scenario(text);
        } catch (const ScenarioError&) {
            accepted = false;
        }
        EXPECT_EQ(accepted, c.valid) << c.change;
        EXPECT_EQ(conforms(json_of(text), schema()), c.valid) << c.change;
    }
}

TEST(ScenarioSchema, WantsNoCoefficientsWithMaterials) {
    const std::string side = "{youngs_modulus = '1 MPa', poisson_ratio = 0.3}";
    const auto text = [&side](const std::string& normal, const std::string& damping) {
        return "time.end = 1\n[body]\nmass = 1\ninertia = 'solid-sphere'\ninitial.position = [0, 0, 1]\n"
               "[[body.spheres]]\nradius = 0.1\n[contact]\nnormal = {law = 'azad-featherstone'" +
               normal + "}\nmaterial = {sphere = " + side + ", ground = " + side + damping + "}\n";
    };
    EXPECT_TRUE(conforms(json_of(text("", ", damping_time = 0")), schema()));
    EXPECT_TRUE(conforms(json_of(text("", ", damping_coefficient = 0")), schema()));
    EXPECT_FALSE(conforms(json_of(text(", stiffness = 1", ", damping_time = 0")), schema()));
    EXPECT_FALSE(conforms(json_of(text("", "")), schema()));
    EXPECT_FALSE(conforms(json_of(text("", ", damping_time = 0, damping_coefficient = 0")), schema()));
}

template <class Variant>
void expect_every_parameter(const Json& table) {
    for_each_law<Variant>([&table](const auto& law) {
        const auto is_law = [&law](const Json& alternative) {
            return alternative["properties"]["law"]["const"] == std::string(law.description.name);
        };
        const auto found = std::find_if(table["anyOf"].begin(), table["anyOf"].end(), is_law);
        ASSERT_NE(found, table["anyOf"].end()) << law.description.name;
        EXPECT_EQ((*found)["properties"].size(), 1 + law.parameters().size());
        for (const auto& parameter : law.parameters()) {
            const Json& property = (*found)["properties"][std::string(parameter.key)];
            ASSERT_TRUE(property.is_object()) << parameter.key;
            const auto description = property["description"].template get<std::string>();
            EXPECT_NE(description.find(parameter.description), std::string::npos) << description;
            if (parameter.unit != "1") {
                EXPECT_NE(description.find(parameter.unit), std::string::npos) << description;
            }
            EXPECT_NE(description.find(parameter.range()), std::string::npos) << description;
        }
    });
}

TEST(ScenarioSchema, HasEveryParameterOfEveryLaw) {
    const Json contact = schema()["properties"]["contact"]["else"]["properties"];
    expect_every_parameter<NormalLaw>(contact["normal"]);
    expect_every_parameter<FrictionLaw>(contact["friction"]);
}

TEST(ScenarioReference, IsWhatTheDocumentationPrints) {
    const std::string begin = "<!-- reference: begin. Written by scenario_reference(); a test compares. -->\n";
    const std::string end = "<!-- reference: end -->";
    const std::filesystem::path file = FOOTFALL_SOURCE_DIR "/docs/scenario.md";
    std::string page = read(file);
    const auto first = page.find(begin);
    const auto last = page.find(end);
    ASSERT_NE(first, std::string::npos);
    ASSERT_NE(last, std::string::npos);
    const auto from = first + begin.size();
    if (std::getenv("FOOTFALL_UPDATE_REFERENCE")) {
        std::ofstream(file) << page.replace(from, last - from, scenario_reference());
        return;
    }
    EXPECT_TRUE(page.substr(from, last - from) == scenario_reference())
        << file << " is out of date: run this test with FOOTFALL_UPDATE_REFERENCE=1 in the environment";
}

}  // namespace
}  // namespace footfall
