// Reading measurements and what is to be fitted: units, order, comments, and every kind of mistake at its place.
#include "footfall/io/fit_data.hpp"

#include <gtest/gtest.h>

#include "io/temporary_folder.hpp"

namespace footfall::test {
namespace {

bool contains(const std::string& text, std::string_view words) { return text.find(words) != std::string::npos; }

std::string error_of(std::string_view text) {
    try {
        (void)parse_fit_data(text, "ball.csv");
    } catch (const ScenarioError& error) {
        return error.what();
    }
    return "";
}

TEST(FitData, ReadsRestitutionCurvesWithCommentsAndBlankLines) {
    const FitData data = parse_fit_data(
        "# a ball\n\nspeed [m/s], restitution, sigma\n0.1, 0.9, 0.01\n# between\r\n 2e-1 ,0.8,0.02\r\n", "ball.csv");
    EXPECT_EQ(data.kind, Measured::restitution);
    EXPECT_EQ(data.source, "ball.csv");
    EXPECT_EQ(data.x, (std::vector<double>{0.1, 0.2}));
    EXPECT_EQ(data.y, (std::vector<double>{0.9, 0.8}));
    EXPECT_EQ(data.sigma, (std::vector<double>{0.01, 0.02}));
    EXPECT_TRUE(data.rate.empty());
}

TEST(FitData, ConvertsUnitsAndTakesColumnsInAnyOrder) {
    const FitData loop = parse_fit_data("force [kN],rate [cm/s],indentation [um]\n0.5,-20,29\n", "loop.csv");
    EXPECT_EQ(loop.kind, Measured::force_indentation);
    EXPECT_DOUBLE_EQ(loop.x[0], 29e-6);
    EXPECT_DOUBLE_EQ(loop.y[0], 500);
    EXPECT_DOUBLE_EQ(loop.rate[0], -0.2);
    const FitData trace = parse_fit_data("time [ms],force,sigma [mN]\n1,-0.5,20\n1,3,20\n", "trace.csv");
    EXPECT_EQ(trace.kind, Measured::force_time);
    EXPECT_DOUBLE_EQ(trace.x[0], 1e-3);
    EXPECT_DOUBLE_EQ(trace.sigma[1], 0.02);
}

TEST(FitData, NamesTheLineTheColumnAndWhatIsAllowed) {
    const std::string head = "# comment\nspeed [m/s],restitution,sigma\n";
    EXPECT_EQ(error_of(head + "0.1,0.9,1\n0.2,fast,1\n"),
              "ball.csv:4:5: restitution is 'fast'; allowed is a finite number");
    EXPECT_EQ(error_of(head + "-0.1,0.9,1\n"), "ball.csv:3:1: speed is '-0.1'; allowed is > 0");
    EXPECT_EQ(error_of(head + "0.1, 1.2,1\n"), "ball.csv:3:6: restitution is '1.2'; allowed is from 0 to 1");
    EXPECT_EQ(error_of(head + "0.1,0.9,0\n"), "ball.csv:3:9: sigma is '0'; allowed is > 0");
    EXPECT_EQ(error_of(head + "0.1,0.9\n"), "ball.csv:3:1: 2 values, where the header has 3 columns");
    EXPECT_EQ(error_of(head + "0.1,nan,1\n"), "ball.csv:3:5: restitution is 'nan'; allowed is a finite number");
    EXPECT_EQ(error_of(head + "0.1,,1\n"), "ball.csv:3:5: restitution is ''; allowed is a finite number");
    EXPECT_EQ(error_of("time [s],force [N]\n2,1\n1,1\n"),
              "ball.csv:3:1: time is '1'; allowed is not before the row above");
}

TEST(FitData, SaysEverythingThatIsWrongAtOnce) {
    const std::string message = error_of("speed [m/s],restitution\n-1,2\n1,0.5\n1\n");
    EXPECT_TRUE(contains(message, "ball.csv:2:1: ") && contains(message, "ball.csv:2:4: ") &&
                contains(message, "ball.csv:4:1: "))
        << message;
}

TEST(FitData, SaysWhatIsWrongWithTheHeader) {
    EXPECT_TRUE(contains(error_of("sped [m/s],restitution\n1,1\n"),
                         "ball.csv:1:1: unknown column 'sped': did you mean 'speed'?"));
    EXPECT_TRUE(contains(error_of("speed [m/s]\n1\n"), "needed are speed and restitution, or"));
    EXPECT_TRUE(contains(error_of("speed [m],restitution\n1,1\n"),
                         "ball.csv:1:1: 'speed [m]': expected a velocity (m/s), got a length (m)"));
    EXPECT_TRUE(contains(error_of("speed [m/s,restitution\n1,1\n"), "a unit stands in brackets"));
    EXPECT_TRUE(contains(error_of("speed,speed,restitution\n1,1,1\n"), "ball.csv:1:7: column 'speed' is there twice"));
    EXPECT_TRUE(contains(error_of("# nothing\n"), "no header line"));
    EXPECT_TRUE(contains(error_of("speed,restitution\n"), "no rows of data"));
}

TEST(FitData, AFileThatIsNotThereIsASystemError) {
    const TemporaryFolder folder;
    EXPECT_THROW((void)load_fit_data(folder / "none.csv"), std::system_error);
    EXPECT_THROW((void)load_fit_data(folder.path()), std::system_error);
    const auto file = folder.write("ball.csv", "speed,restitution\n1,0.5\n");
    EXPECT_EQ(load_fit_data(file).source, file.string());
}

TEST(FitLawText, MarksWhatIsToBeFitted) {
    const FitLaw law = parse_fit_law("hunt-crossley: stiffness = ? , damping=?3.1e6, n=1.5, p=?0.3..2");
    const auto& base = std::get<HuntCrossleyNormal<>>(law.law);
    EXPECT_EQ(base.n, 1.5);
    EXPECT_EQ(base.q, 1);
    ASSERT_EQ(law.free.size(), 3U);
    EXPECT_EQ(law.free[0].key, "stiffness");
    EXPECT_TRUE(law.free[0].value.free && !law.free[0].value.value && !law.free[0].value.low);
    EXPECT_EQ(law.free[1].value.value, 3.1e6);
    EXPECT_EQ(law.free[2].value.low, 0.3);
    EXPECT_EQ(law.free[2].value.high, 2);
}

TEST(FitLawText, TakesUnits) {
    const FitLaw law = parse_fit_law("azad-featherstone:stiffness=8.5 MN/m^1.5,damping=?1 kN s/m^1.5..4 kN s/m^1.5");
    EXPECT_DOUBLE_EQ(std::get<AzadFeatherstoneNormal<>>(law.law).stiffness, 8.5e6);
    EXPECT_DOUBLE_EQ(*law.free[0].value.low, 1e3);
    EXPECT_DOUBLE_EQ(*law.free[0].value.high, 4e3);
    const FitValue mass = parse_fit_value("? 154 g", "kg");
    EXPECT_TRUE(mass.free);
    EXPECT_DOUBLE_EQ(*mass.value, 0.154);
    EXPECT_FALSE(parse_fit_value("0.154", "kg").free);
}

TEST(FitLawText, RefusesWhatCannotBeFitted) {
    const auto fails = [](std::string_view text, std::string_view words) {
        try {
            (void)parse_fit_law(text);
            ADD_FAILURE() << text;
        } catch (const InvalidInput& error) {
            EXPECT_TRUE(contains(error.what(), words)) << error.what();
        }
    };
    fails("azad-featherstone:stiffness=1,damping=1", "nothing is to be fitted");
    fails("azad-fetherstone:stiffness=?,damping=?", "did you mean 'azad-featherstone'");
    fails("azad-featherstone:stifness=?,damping=?", "did you mean 'stiffness'");
    fails("azad-featherstone:stiffness=?", "damping");
    fails("azad-featherstone:stiffness=?-1,damping=?", "allowed is > 0");
    fails("azad-featherstone:stiffness=?2..1,damping=?", "the lower bound must come first");
    fails("azad-featherstone:stiffness=?8 kg,damping=?", "stiffness: expected");
    fails("flores:stiffness=?,restitution=?1.5", "allowed is > 0 and <= 1");
}

}  // namespace
}  // namespace footfall::test
