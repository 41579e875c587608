// footfall fit as a user runs it: streams, exit codes, files.
#include <string>

#include <gtest/gtest.h>

#include "cli/program.hpp"

namespace footfall::test {
namespace {

class FitCli : public ProgramTest {
protected:
    const std::string data = std::string(FOOTFALL_SOURCE_DIR) + "/data/synthetic/";
    const std::string paper = " --normal azad-featherstone:stiffness=?,damping=?";

    [[nodiscard]] Result fit(const std::string& arguments) const { return footfall("fit " + arguments); }
};

TEST_F(FitCli, ReportsTheTraceThatIsShipped) {
    const Result result = fit(data + "force-time.csv --mass '154 g' --speed '1 m/s'" + paper);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    for (const char* part : {"force against time, 200 data", "azad-featherstone", "stiffness", "95 % interval",
                             "correlation of stiffness and damping", "AICc"}) {
        EXPECT_TRUE(contains(result.out, part)) << part << result.out;
    }
    EXPECT_FALSE(contains(result.out, "Warning"));
}

TEST_F(FitCli, JsonIsAllThereIsAndHasTheTruthInItsIntervals) {
    const Result result = fit(data + "force-time.csv --mass '154 g' --speed '1 m/s' --json" + paper +
                              " --normal hunt-crossley:stiffness=?,damping=?");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Json json = Json::parse(result.out);
    EXPECT_EQ(json["kind"], "force-time");
    EXPECT_EQ(json["best"], "azad-featherstone");
    ASSERT_EQ(json["laws"].size(), 2U);
    const Json& estimates = json["laws"][0]["estimates"];
    // The truth is in the file's own header; the noise is 1 %.
    EXPECT_NEAR(estimates[0]["value"].get<double>() / 8.5e6, 1, 0.01);
    EXPECT_NEAR(estimates[1]["value"].get<double>() / 3.1e3, 1, 0.02);
    EXPECT_LT(estimates[0]["low"].get<double>(), estimates[0]["value"].get<double>());
    EXPECT_TRUE(estimates[2]["standard_error"].is_null());
    EXPECT_EQ(json["laws"][0]["residuals"].size(), 200U);
    EXPECT_GT(json["laws"][1]["aicc_difference"].get<double>(), 100);
}

// One of the starts fails, of which the solver had a log of its own.
TEST_F(FitCli, ASearchThatFailsOnItsWayPrintsNoWordsOfTheSolver) {
    const std::string table =
        "speed [m/s],restitution\n"
        "3.571134,0.712525\n"
        "3.571134,0.701646\n"
        "3.571134,0.702742\n"
        "3.571134,0.709279\n"
        "3.571134,0.713604\n"
        "3.284966,0.719848\n"
        "3.284966,0.716050\n"
        "3.284966,0.726135\n"
        "3.284966,0.732369\n"
        "3.284966,0.719848\n"
        "2.971363,0.745356\n"
        "2.971363,0.739369\n"
        "2.971363,0.742369\n"
        "2.971363,0.751295\n"
        "2.971363,0.740870\n"
        "2.620496,0.746420\n"
        "2.620496,0.744504\n"
        "2.620496,0.736788\n"
        "2.620496,0.744504\n"
        "2.620496,0.761577\n"
        "2.214723,0.698570\n"
        "2.214723,0.721110\n"
        "2.214723,0.707107\n"
        "2.214723,0.726636\n"
        "2.214723,0.721110\n";
    const Result result = fit(folder.write("table.csv", table).string() +
                              " --mass 58g --normal falcon:stiffness=1e6,damping=?,exponent=?");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err, "");
    EXPECT_TRUE(contains(result.out, "3 of 4 starts came to this minimum")) << result.out;
}

TEST_F(FitCli, SaysWhatRestitutionAloneCanTell) {
    const Result result = fit(data + "restitution.csv --mass '154 g'" + paper);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(contains(result.out, "damping stiffness^(-3/5) mass^(-2/5)   0.4")) << result.out;
    EXPECT_TRUE(contains(result.out, "do not determine stiffness and damping one by one")) << result.out;
}

TEST_F(FitCli, FitsALoopWithItsRateAndWritesTheResiduals) {
    const std::string csv = (folder / "residuals.csv").string();
    const Result result = fit(data + "force-indentation.csv --loss huber --csv " + csv + paper);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(contains(result.out, "Written\n  " + csv));
    const std::string table = read_text(csv);
    EXPECT_TRUE(contains(table, "azad-featherstone.residual")) << table.substr(0, 400);
}

TEST_F(FitCli, WrongDataAndWrongOptionsExitWithTwo) {
    const std::string bad = folder.write("bad.csv", "speed [m/s],restitution\n0.1,0.9\n0.2,1.9\n").string();
    Result result = fit(bad + " --mass 1" + paper);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err,
              "footfall: " + bad +
                  ":3:5: restitution is '1.9'; allowed is from 0 to 1\n--skip-bad-rows leaves such rows out\n");
    for (const std::string& arguments :
         {data + "restitution.csv" + paper,   // no mass
          data + "restitution.csv --mass 1",  // no law
          data + "restitution.csv --mass 1 --normal azad-featherstone:stiffness=1,damping=1",
          data + "restitution.csv --mass '1 m'" + paper, data + "restitution.csv --mass 1 --loss square" + paper,
          data + "restitution.csv --mass 1 --sigma-is-true" + paper, (folder / "none.csv").string() + paper}) {
        result = fit(arguments);
        EXPECT_EQ(result.exit_code, 2) << arguments << result.out;
        EXPECT_EQ(result.err.find("footfall: "), 0U) << result.err;
        EXPECT_EQ(result.out, "");
    }
}

TEST_F(FitCli, SaysWhatItMadeOfALaboratorysTable) {
    const std::string file =
        folder.write("lab.csv", "no;v_in [mm/s];COR;remark\n1;100;0,779;\n2;200;0,75;good\n3;400;x;\n4;800;0,7;\n")
            .string();
    const Result refused = fit(file + " --mass 154g --normal azad-featherstone:stiffness=8.5e6,damping=?");
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_TRUE(contains(refused.err, "lab.csv:4:7: restitution is 'x'; allowed is a finite number")) << refused.err;
    EXPECT_TRUE(contains(refused.err, "--skip-bad-rows leaves such rows out")) << refused.err;
    const Result result =
        fit(file + " --skip-bad-rows --mass 154g --normal azad-featherstone:stiffness=8.5e6,damping=?");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    for (const char* words :
         {"restitution against speed, 3 data", "Read: speed in mm/s from 'v_in [mm/s]', restitution from 'COR'.",
          "Columns that are not used: no, remark.", "1 of 4 rows could not be used and were left out: line 4.",
          "Decimal commas."})
        EXPECT_TRUE(contains(result.out, words)) << words << "\n" << result.out;
    const Json json = Json::parse(fit(file + " --json --column speed=no --skip-bad-rows --mass 154g --normal "
                                             "azad-featherstone:stiffness=8.5e6,damping=?")
                                      .out);
    EXPECT_EQ(json["notes"].size(), 4U);
    EXPECT_TRUE(json["warnings"].empty());
}

TEST_F(FitCli, WrongTableOptionsExitWithTwo) {
    const std::string file = data + "restitution.csv --mass 154g --normal azad-featherstone:stiffness=8.5e6,damping=? ";
    for (const auto& [words, reason] : std::vector<std::pair<std::string, std::string>>{
             {"--column speed", "'speed' is not allowed: write QUANTITY=COLUMN"},
             {"--column sped=v", "unknown quantity 'sped': did you mean 'speed'?"},
             {"--column speed=v", "no column 'v'"},
             {"--column speed=a --column speed=b", "speed is given twice"},
             {"--where =1", "write COLUMN=VALUE"},
             {"--where series=1", "no column 'series'"},
             {"--kind force", "force"},
             {"--gravity -1", "gravity"}}) {
        const Result result = fit(file + words);
        EXPECT_EQ(result.exit_code, 2) << words;
        EXPECT_TRUE(contains(result.err, reason)) << result.err;
    }
}

TEST_F(FitCli, HelpEndsWithAnExample) {
    const Result result = fit("--help");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_TRUE(contains(result.out, "Example:\n  footfall fit data/synthetic/restitution.csv"));
}

}  // namespace
}  // namespace footfall::test
