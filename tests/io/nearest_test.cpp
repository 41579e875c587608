#include "io/nearest.hpp"

#include <gtest/gtest.h>

namespace footfall::io {
namespace {

const std::vector<std::string> words{"--set", "--tolerance", "--output", "kg", "t"};

TEST(Nearest, IsTheWordWithTheFewestLettersWrong) {
    EXPECT_EQ(nearest("--tolrance", words), "--tolerance");
    EXPECT_EQ(nearest("KG", words), "kg");
    EXPECT_EQ(nearest("--otuput", words), "--output");
}

TEST(Nearest, IsTheWordThatWasCutShort) {
    // --set has only two other letters.
    EXPECT_EQ(nearest("--tol", words), "--tolerance");
    EXPECT_EQ(nearest("--out", words), "--output");
}

TEST(Nearest, IsNothingWhereEveryLetterIsWrong) {
    EXPECT_EQ(nearest("5", {"2", "3", "4"}), "");
    EXPECT_EQ(nearest("xy", words), "");
    EXPECT_EQ(nearest("", words), "");
    EXPECT_EQ(nearest("velocity", words), "");
}

}  // namespace
}  // namespace footfall::io
