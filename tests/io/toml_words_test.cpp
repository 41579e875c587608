// What is not TOML, as it is told.
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "footfall/io/scenario.hpp"
#include "io/toml_scan.hpp"

namespace footfall {
namespace {

ScenarioProblem problem_of(const std::string& text) {
    try {
        (void)parse_scenario(text, "ball.toml");
    } catch (const ScenarioError& error) {
        return error.problems().front();
    }
    ADD_FAILURE() << "accepted: " << text;
    return {};
}

struct Case {
    std::string text;
    int line, column;
    std::string part;  ///< of the message
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.text; }

class NotToml : public testing::TestWithParam<Case> {};

TEST_P(NotToml, IsToldInPlainWordsAtItsPlace) {
    const ScenarioProblem problem = problem_of(GetParam().text);
    EXPECT_EQ(problem.line, GetParam().line) << problem.message;
    EXPECT_EQ(problem.column, GetParam().column) << problem.message;
    EXPECT_NE(problem.message.find(GetParam().part), std::string::npos) << problem.message;
    for (const char* foreign : {"Error while", "parsing", "saw", "encountered", "end-of-file", "codepoint", "redefine",
                                "prohibited", "terminator", "key-value"}) {
        EXPECT_EQ(problem.message.find(foreign), std::string::npos) << problem.message;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Values, NotToml,
    testing::Values(Case{"a = 154 g", 1, 9, "with its unit it is in quotes: \"154 g\""},
                    Case{"a = 10%", 1, 7, "with its unit it is in quotes: \"10%\""},
                    Case{"a = 1,5", 1, 6, "a decimal point, not a comma"}, Case{"a =", 1, 4, "a value is missing"},
                    Case{"a = 1\nb = # two\n", 2, 5, "a value is missing"},
                    Case{"a = .5", 1, 5, "digits on both sides of the decimal point"},
                    Case{"a = 1.2.3", 1, 8, "'1.2.3' is no number"}, Case{"a = 01", 1, 7, "no extra zero"},
                    Case{"a = 1e999", 1, 10, "1e999 is too large"},
                    Case{"a = True", 1, 5, "write true, in small letters"}, Case{"a = yes", 1, 5, "'yes' is no value"},
                    Case{"a = 0x", 1, 7, "'0x' is no number"}, Case{"a == 3", 1, 4, "one '=', not two"},
                    Case{"a = 1 b = 2", 1, 7, "one key and its value to a line"},
                    Case{"a = 'it's'", 1, 9, "unexpected 's' behind the string"}));

INSTANTIATE_TEST_SUITE_P(Strings, NotToml,
                         testing::Values(Case{"a = 1\nb = \"x\nc = 2\n", 2, 5, "is not closed with \""},
                                         Case{"a = 'x\n", 1, 5, "is not closed with '"},
                                         Case{"a = \"\"\"x\n\ny", 1, 5, "is not closed with \""},
                                         Case{"a = \"C:\\qx\"", 1, 9, "write a backslash as \\\\"},
                                         Case{"a = \"\\u12\"", 1, 10, "four hexadecimal digits"},
                                         Case{"a = \"\x01\"", 1, 6, "a control character in a string"},
                                         Case{"a = \"\xff\"", 1, 5, "not UTF-8"}));

INSTANTIATE_TEST_SUITE_P(Keys, NotToml,
                         testing::Values(Case{"a = 1\na = 2", 2, 5, "'a' is there twice"},
                                         Case{"mass 3", 1, 6, "'=' is missing after 'mass'"},
                                         Case{"mass: 3", 1, 5, "write 'mass = ...', not ':'"},
                                         Case{"mass", 1, 5, "'=' is missing after 'mass'"},
                                         Case{"= 3", 1, 1, "the key before '=' is missing"},
                                         Case{"a.=1", 1, 3, "a name is missing beside the dot"},
                                         Case{"// words", 1, 1, "a comment begins with '#'"},
                                         Case{"\xc3\xa9 = 1", 1, 1, "other letters than A to Z need quotes"},
                                         Case{"a = 1\na.b = 2", 2, 1, "has a value already"}));

INSTANTIATE_TEST_SUITE_P(Tables, NotToml,
                         testing::Values(Case{"[a]\n[b]\n[a]", 3, 1, "the table [a] is there twice"},
                                         Case{"[[a]]\n[a]", 2, 1, "is written [[a]]"},
                                         Case{"[a]\n[[a]]", 2, 1, "[[a]], too"},
                                         Case{"a = 1\n[a]", 2, 1, "'a' has a value already"},
                                         Case{"[time\nend = 1\n", 1, 1, "'[' is not closed"},
                                         Case{"[a]]", 1, 4, "unexpected ']'"},
                                         Case{"[a b]", 1, 4, "the name of a table ends with ']'"},
                                         Case{"[]", 1, 2, "the name of the table between the brackets is missing"},
                                         Case{"[a] b = 1", 1, 5, "keys of a table begin on the next line"},
                                         Case{"a = {b = 1}\n[a.c]", 2, 6, "cannot be added"}));

INSTANTIATE_TEST_SUITE_P(Lists, NotToml,
                         testing::Values(Case{"a = [1, 2\nb = 3\n", 1, 5, "'[' is not closed"},
                                         Case{"a = [1 2]", 1, 8, "expected ',' or ']'"},
                                         Case{"a = [1,,2]", 1, 8, "a value is missing between the commas"},
                                         Case{"a = {b = 1 c = 2}", 1, 12, "expected ',' or '}'"},
                                         Case{"a = {b = 1", 1, 5, "'{' is not closed"},
                                         Case{"a = {b = 1,}", 1, 12, "one too many"},
                                         Case{"a = {b = 1\n}", 1, 11, "on one line"}));

// A parser that calls itself for each part of a key or each bracket would run out of its stack.
TEST(DeepToml, IsRefusedWithItsPlaceBeforeItIsParsed) {
    const auto repeated = [](const std::string& piece, int times) {
        std::string text;
        for (int i = 0; i < times; ++i) text += piece;
        return text;
    };
    constexpr int deep = 40'000;
    for (const std::string& text : std::vector<std::string>{
             repeated("a.", deep) + "a = 1", repeated("'a'.", deep) + "a = 1", repeated("\"a\" . ", deep) + "a = 1",
             "[" + repeated("a.", deep) + "a]", "[[" + repeated("a.", deep) + "a]]", "a = " + repeated("[", deep),
             "a = " + repeated("[", deep) + repeated("]", deep), "a = " + repeated("{a = ", deep),
             "a = " + repeated("[{a = ", deep), "a = [" + repeated("\n# ]]]\n['''\n]''', ", deep),
             "a = \"\"\"\\\"\"\"\"\"\nb = " + repeated("[", deep)}) {
        const ScenarioProblem problem = problem_of(text);
        EXPECT_NE(problem.message.find("nested deeper than 32"), std::string::npos)
            << text.substr(0, 40) << ": " << problem.message;
    }
    EXPECT_EQ(problem_of("x = 1\n" + repeated("a.", deep) + "a = 1").line, 2);
}

TEST(DeepToml, AsDeepAsIsAllowedIsRead) {
    std::string dotted = "a";
    std::string brackets;
    for (int i = 0; i < io::deepest_toml - 1; ++i) {
        dotted += ".a";
        brackets += "[";
    }
    EXPECT_NE(problem_of(dotted + " = " + brackets + std::string(brackets.size(), ']')).message.find("unknown key 'a'"),
              std::string::npos);
}

// What looks like brackets, dots and quotes inside strings and comments counts for nothing.
TEST(TomlScan, LooksOnlyAtWhatIsOutsideOfStringsAndComments) {
    const std::string many(100, '[');
    const std::string dots(100, '.');
    for (const std::string& text : std::vector<std::string>{
             "a = \"" + many + dots + "\"", "a = '" + many + "\\'", "a = \"\\\"" + many + "\"", "# " + many + "'\"\n",
             "a = \"\"\"\n" + many + "\n\"\" \\\"\"\" " + many + "\"\"\"", "a = '''\n" + many + "''" + many + "'''''",
             "a = \"\"\n# '\n", "a = ''''a'''' # \"", "a = \"\\\\\" # \"\n", "\"a.b\".'c[' = 1.5"}) {
        const io::TomlScan scan = io::scan_toml(text);
        EXPECT_FALSE(scan.too_deep) << text;
        EXPECT_FALSE(scan.unclosed) << text;
    }
}

TEST(TomlScan, SaysWhatIsOpenAtTheEnd) {
    const auto open = [](const std::string& text) {
        const io::TomlScan scan = io::scan_toml(text);
        return scan.unclosed ? std::to_string(scan.unclosed->at.line) + ":" + std::to_string(scan.unclosed->at.column) +
                                   scan.unclosed->what
                             : "";
    };
    EXPECT_EQ(open("a = [\n  [1, 2],\n  {b = 1\n"), "3:3{");
    EXPECT_EQ(open("\xc3\xa9 = \"x\nb = 1"), "1:5\"");
    EXPECT_EQ(open("a = '''\n''\n"), "1:5'");
    EXPECT_EQ(open("a = [1, 2]\n"), "");
}

}  // namespace
}  // namespace footfall
