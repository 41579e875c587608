// A command line that cannot be used: what the program says of it.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "cli/program.hpp"

namespace footfall::test {
namespace {

struct Wrong {
    std::string words;
    std::string said;  ///< the error, from its start
};

class UsageCli : public ProgramTest {
protected:
    void expect(const std::vector<Wrong>& table) const {
        for (const Wrong& wrong : table) {
            const Result result = footfall(wrong.words);
            EXPECT_EQ(result.exit_code, 2) << wrong.words;
            EXPECT_EQ(result.out, "") << wrong.words;
            EXPECT_EQ(result.err.find("footfall: " + wrong.said), 0u) << wrong.words << "\n" << result.err;
        }
    }
};

TEST_F(UsageCli, AnUnknownWordIsMetWithTheNearest) {
    expect(
        {{"runn", "unknown command 'runn': did you mean 'run'? (commands: run, restitution, "},
         {"--versoin", "unknown option '--versoin': did you mean '--version'?"},
         {"ball.toml", "unknown command 'ball.toml': did you mean 'footfall run ball.toml'?"},
         {"run ball.toml --tol 1e-5", "unknown option '--tol': did you mean '--tolerance'? (options: --help, --output"},
         {"run ball.toml --tolerence=1e-5", "unknown option '--tolerence': did you mean '--tolerance'?"},
         {"--tolerance 1e-5 run ball.toml",
          "--tolerance stands before the command: write footfall run ... --tolerance\n"},
         // The misspelt option is said rather than the one that is missing for it.
         {"oblique --raduis 1cm", "unknown option '--raduis': did you mean '--radius'?"},
         {"fit x.csv -n hertz:stiffness=? --loss hubert",
          "--loss: 'hubert' is not allowed: did you mean 'huber'? (one of none, huber, cauchy)"},
         {"material --tangential midlin", "--tangential: 'midlin' is not allowed: did you mean 'mindlin'?"},
         {"material --sphere steal --ground brass", "--sphere: unknown material 'steal': did you mean 'steel'?"},
         {"restitution --figure 5", "--figure: '5' is not allowed (one of 2, 3, 4)"},
         {"laws hetrz", "unknown law 'hetrz': did you mean 'hertz'? (laws: azad-featherstone, "},
         {"oblique --radius 1 --mass 1 --speed 1 --normal hertz:stiffness=1e5 --friction none --inertia sollid",
          "--inertia: 'sollid' is not allowed: did you mean 'solid'?"},
         {"oblique --radius 1 --mass 1 --speed 1 --normal hertz:stiffness=1e5 --friction daal:a=1",
          "unknown friction law 'daal': did you mean 'dahl'?"},
         {"oblique --radius 1 --mass 1 --speed 1 --normal hertz:stiffness=1e5 --friction "
          "dahl:stiffness=1e3,coefficient=1 "
          "--fit x.csv --vary friction.coeficient",
          "--vary: 'friction.coeficient' is no parameter of these laws: did you mean 'friction.coefficient'? (there "
          "are "},
         {"restitution --mass 1 --normal azad-featherstone:stifness=1",
          "normal law 'azad-featherstone': unknown parameter 'stifness': did you mean 'stiffness'?"}});
}

TEST_F(UsageCli, SaysWhatIsMissing) {
    expect({{"run", "SCENARIO is required: a TOML file, or the name of a scenario of --list\n"},
            {"fit", "DATA and --normal are required\n"},
            {"oblique", "--radius, --normal and --friction are required\n"},
            {"run ball.toml --csv", "--csv needs a value: --csv DIR\n"},
            {"run ball.toml --csv=", "--csv needs a value: --csv DIR\n"},
            {"run ball.toml -o", "--output needs a value: --output RUN.nc\n"},
            {"run ball.toml --csv --json", "--csv needs a value: --csv DIR; '--json' is an option\n"},
            {"run ball.toml --csv ''", "--csv is empty\n"},
            {"run ''", "SCENARIO is empty\n"}});
}

TEST_F(UsageCli, SaysWhatIsTooMuch) {
    expect({{"run ball.toml b.toml", "unexpected argument 'b.toml': footfall run takes one SCENARIO and options\n"},
            {"run -- ball.toml b.toml", "unexpected argument 'b.toml'"},
            {"schema x", "unexpected argument 'x': footfall schema takes only options\n"},
            {"run ball.toml --json --quiet", "--json and --quiet cannot be given together\n"},
            {"run ball.toml --list", "SCENARIO and --list cannot be given together\n"},
            {"run ball.toml --json=yes", "--json takes no value\n"},
            {"run ball.toml --tolerance 1e-5 --tolerance 1e-6", "--tolerance is given 2 times: give it once\n"},
            {"drive drift --friction none --friction none --tolerance abc", "--tolerance: 'abc' is not a number\n"},
            {"oblique --radius 1 --normal a --friction b --vary c", "--vary needs --fit beside it\n"}});
}

TEST_F(UsageCli, SaysWhichNumbersAreAllowed) {
    for (const std::string command : {"run x", "drive x", "restitution", "oblique"}) {
        expect({{command + " --tolerance abc", "--tolerance: 'abc' is not a number\n"},
                {command + " --tolerance nan", "--tolerance: 'nan' is not a number\n"},
                {command + " --tolerance 0", "--tolerance: '0' is not allowed: must be from 1e-14 to 1e-3\n"},
                {command + " --tolerance -1", "--tolerance: '-1' is not allowed: must be from 1e-14 to 1e-3\n"}});
    }
    expect({{"restitution --points 1", "--points: '1' is not allowed: must be a whole number >= 2\n"},
            {"restitution --points 2.5", "--points: '2.5' is not allowed: must be a whole number >= 2\n"},
            {"restitution --mass '3 onces' --normal hertz:stiffness=1",
             "--mass: cannot read the unit 'onces': unknown unit 'onces': did you mean 'ounces'?"},
            {"fit x -n a --starts 0", "--starts: '0' is not allowed: must be a whole number from 1 to 10000\n"}});
}

TEST_F(UsageCli, QuantitiesHaveUnitsWithAndWithoutASpace) {
    const auto table = [&](const std::string& words) {
        const Result result = footfall("restitution --normal hertz:stiffness=1e6 --points 2 --json " + words);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return result.out;
    };
    const std::string plain = table("--mass 0.154 --from 0.01 --to 1 --tolerance 1e-10");
    EXPECT_EQ(table("--mass 154g --from 1cm/s --to '100 cm/s' --tolerance 1e-8%"), plain);
    EXPECT_EQ(table("--mass '154 grams' --from '1 cm/s' --to 1m/s --tolerance '1e-10'"), plain);
}

}  // namespace
}  // namespace footfall::test
