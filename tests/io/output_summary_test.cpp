// The page that a person reads, and the numbers and tables it is made of.
#include <gtest/gtest.h>

#include "footfall/io/output.hpp"
#include "io/hand_made_run.hpp"
#include "io/text.hpp"

namespace footfall::test {
namespace {

std::vector<std::string> lines_of(const std::string& page) {
    std::vector<std::string> lines(1);
    for (const char c : page) {
        if (c == '\n') {
            lines.emplace_back();
        } else {
            lines.back() += c;
        }
    }
    return lines;
}

bool contains(const std::string& page, std::string_view words) { return page.find(words) != std::string::npos; }

/// The one line that contains `words`.
std::string line_with(const std::string& page, std::string_view words) {
    std::vector<std::string> found;
    for (const std::string& line : lines_of(page)) {
        if (contains(line, words)) found.push_back(line);
    }
    EXPECT_EQ(found.size(), 1U) << words << " in\n" << page;
    return found.empty() ? "" : found.front();
}

TEST(Text, GivenNumbersAreShort) {
    EXPECT_EQ(text::number(8.5e6), "8.5e6");
    EXPECT_EQ(text::number(3100), "3100");
    EXPECT_EQ(text::number(0.2), "0.2");
    EXPECT_EQ(text::number(1e-12), "1e-12");
    EXPECT_EQ(text::number(-9.81), "-9.81");
    EXPECT_EQ(text::number(8537129.123456789), "8.53713e6");
    EXPECT_EQ(text::number(999999.9), "1e6");
    EXPECT_EQ(text::number(0), "0");
}

TEST(Text, QuantitiesHaveFourDigitsAndAPrefix) {
    EXPECT_EQ(text::quantity(0.00031236, "m"), "312.4 µm");
    EXPECT_EQ(text::quantity(-1.25, "m/s"), "-1.250 m/s");
    EXPECT_EQ(text::quantity(12346, "N"), "12.35 kN");
    EXPECT_EQ(text::quantity(0, "s"), "0 s");
    EXPECT_EQ(text::quantity(-0.0, "s"), "0 s");
    EXPECT_EQ(text::quantity(999.96, "J"), "1.000 kJ");
    EXPECT_EQ(text::quantity(1e-3, "J"), "1.000 mJ");
    EXPECT_EQ(text::quantity(1e-20, "J"), "1.000e-20 J");
}

TEST(Text, CountsAreGrouped) {
    EXPECT_EQ(text::count(999), "999");
    EXPECT_EQ(text::count(1000), "1,000");
    EXPECT_EQ(text::count(5'000'000'000), "5,000,000,000");
}

TEST(Text, TablesAlignNumbersAndUnitsWhateverTheirBytes) {
    text::Table table({text::Align::left, text::Align::unit});
    table.head({"what", "much"});
    table.row({"a", "12.5 µm"});
    table.row({"bb", "1 m"});
    table.row({"c", "–"});
    EXPECT_EQ(table.str(),
              "  what     much\n"
              "  ────  ───────\n"
              "  a     12.5 µm\n"
              "  bb       1 m\n"
              "  c           –\n");
}

TEST(Text, WrapsBetweenWords) {
    EXPECT_EQ(text::wrap("aa bb ccc", 5), (std::vector<std::string>{"aa bb", "ccc"}));
    EXPECT_EQ(text::wrap("toolong b", 3), (std::vector<std::string>{"toolong", "b"}));
}

TEST(OutputSummary, SaysWhatWasRun) {
    const std::string page = summary(two_sphere_scenario(), two_sphere_run());
    EXPECT_EQ(page.find("Two spheres, a title with µ in it\n"), 0U);
    EXPECT_TRUE(contains(line_with(page, "Body"), "154 g"));
    EXPECT_TRUE(contains(page, "0: radius 16.5 mm, at (0.01, 0, -0.02) m"));
    EXPECT_TRUE(contains(page, "K_n = 8.5e6 N/m^1.5, D_n = 3100 N s/m^1.5"));
    EXPECT_TRUE(contains(line_with(page, "sphere 0: K_t"), "mu = 0.2, C_V = 0.1 N s/m"));
    EXPECT_TRUE(contains(line_with(page, "sphere 1: K_t"), "mu = 0.3, C_V = 0.05 N s/m"));
    EXPECT_TRUE(contains(page, "tolerance of 1e-11"));
}

TEST(OutputSummary, SharedParametersAreSaidOnce) {
    Scenario scenario = two_sphere_scenario();
    scenario.simulation.contacts[1] = scenario.simulation.contacts[0];
    line_with(summary(scenario, two_sphere_run()), "K_t = 1.275e7");
}

TEST(OutputSummary, NamesTheSpheresOfEachLaw) {
    Scenario scenario = two_sphere_scenario();
    scenario.simulation.contacts[1].normal = LinearNormal<>{4e4, 7};
    const std::string page = summary(scenario, two_sphere_run());
    EXPECT_TRUE(contains(page, "azad-featherstone, sphere 0"));
    EXPECT_TRUE(contains(page, "linear, sphere 1"));
    EXPECT_TRUE(contains(page, "k = 40000 N/m, d = 7 N s/m"));
}

TEST(OutputSummary, HasALineForEachImpact) {
    const std::string page = summary(two_sphere_scenario(), two_sphere_run());
    const std::string over = line_with(page, "0.6250"), lasting = line_with(page, "lasting  ");
    for (const char* cell : {"0.050000000", "160.0 ms", "66.67 µs", "2.000 m/s", "1.250 m/s", "33.33 N", "33.33 µm"}) {
        EXPECT_TRUE(contains(over, cell)) << cell << " in " << over;
    }
    for (const char* cell : {"0.060000000", "333.3 mm/s", "–", "7.000 N", "10.00 µm"}) {
        EXPECT_TRUE(contains(lasting, cell)) << cell << " in " << lasting;
    }
}

TEST(OutputSummary, LedgerGivesAmountsSharesAndResidual) {
    footfall::Run run = two_sphere_run();
    run.initial.ledger = {};
    run.initial.ledger.kinetic = 0.2;
    run.final.ledger = {};
    run.final.ledger.kinetic = 0.05;
    run.final.ledger.contact.normal_damper = 0.15;
    run.energy_scale = 0.2;
    const std::string page = summary(two_sphere_scenario(), run);
    const std::string kinetic = line_with(page, "kinetic"), damper = line_with(page, "normal damper");
    EXPECT_TRUE(contains(kinetic, "200.000") && contains(kinetic, "50.000") && contains(kinetic, "25.000 %"))
        << kinetic;
    EXPECT_TRUE(contains(damper, "150.000") && contains(damper, "75.000 %")) << damper;
    EXPECT_TRUE(contains(line_with(page, "residual"), "3.3e-14 at most"));
}

TEST(OutputSummary, SaysWhenTheLawHasMadeEnergyAndHowMuch) {
    footfall::Run run = two_sphere_run();
    run.final.ledger.contact.stiffness_change = -0.67e-3;
    EXPECT_TRUE(contains(summary(two_sphere_scenario(), run), "The tangential law has made 670.0 µJ"));
    for (const double harmless : {0.0, 0.67e-3}) {
        run.final.ledger.contact.stiffness_change = harmless;
        EXPECT_FALSE(contains(summary(two_sphere_scenario(), run), "has made"));
    }
}

TEST(OutputSummary, StaysAPageHoweverMuchHasHappened) {
    footfall::Run run = two_sphere_run();
    const Event event = run.events.front();
    const Impact impact = run.impacts.front();
    run.events.assign(10'000, event);
    run.impacts.assign(5'000, impact);
    const std::string page = summary(two_sphere_scenario(), run);
    const std::vector<std::string> lines = lines_of(page);
    EXPECT_LT(lines.size(), 100U);
    for (const std::string& line : lines) EXPECT_LE(text::width(line), 100U) << line;
    EXPECT_TRUE(contains(page, "10,000 touchdown"));
    EXPECT_TRUE(contains(page, "… 9,985 more …"));
}

TEST(OutputSummary, SaysSoWhereNothingHasHappened) {
    const std::string page = summary(two_sphere_scenario(), uneventful_run());
    EXPECT_TRUE(contains(page, "no sphere touched the ground"));
}

TEST(OutputSummary, APageOfAScenarioIsTheHeadOfItsRuns) {
    const std::string head = summary(two_sphere_scenario());
    EXPECT_TRUE(summary(two_sphere_scenario(), two_sphere_run()).starts_with(head));
    EXPECT_TRUE(contains(head, "K_t = 1.275e7"));
    EXPECT_FALSE(contains(head, "touchdown"));
}

}  // namespace
}  // namespace footfall::test
