// No text from elsewhere is an instruction to a terminal.
#include "footfall/io/printable.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <rapidcheck/gtest.h>

namespace footfall::test {
namespace {

TEST(Printable, WritesControlCharactersOut) {
    EXPECT_EQ(printable("a\x1b[31m\a\n\r\t\x7f"), "a\\x1b[31m\\x07\\n\\r\\t\\x7f");
    EXPECT_EQ(printable("\xc2\x9b"
                        "31m"),
              "\\u009b31m");
    EXPECT_EQ(printable("a\u202etxt.\u2066\u2028\u200f"), "a\\u202etxt.\\u2066\\u2028\\u200f");
}

TEST(Printable, LeavesTextAsItIs) {
    const std::string text = "Kugel, Ø 3 µm, 球, \xf0\x9f\x8f\x80, \\n";
    EXPECT_EQ(printable(text), text);
    EXPECT_EQ(printable_lines("a\nb"), "a\nb");
}

TEST(Printable, WritesBytesThatAreNoUtf8Out) {
    EXPECT_EQ(printable("a\xff"), "a\\xff");
    EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf") << "overlong";
    EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "a surrogate";
    EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "above U+10FFFF";
    EXPECT_EQ(printable("\xe2\x82"), "\\xe2\\x82") << "cut off";
}

TEST(Printable, JsonReadsBackAsTheSameText) {
    const nlohmann::ordered_json json{{"t", "a\x1b\u009b\u202e\n\U000e0041 \xc3\x98"}};
    const std::string text = json_text(json);
    for (const char* raw : {"\x1b", "\u009b", "\u202e", "\U000e0041"}) {
        EXPECT_EQ(text.find(raw), std::string::npos) << text;
    }
    EXPECT_EQ(nlohmann::ordered_json::parse(text), json);
}

RC_GTEST_PROP(Printable, AnyBytesBecomeValidUtf8WithoutControlCharacters, (const std::string& bytes)) {
    const std::string shown = printable(bytes);
    RC_ASSERT(printable(shown) == shown);
    RC_ASSERT(!nlohmann::ordered_json(shown).dump().empty());  // throws where it is not UTF-8
    RC_ASSERT(nlohmann::ordered_json::parse(json_text(nlohmann::ordered_json(bytes))).is_string());
}

}  // namespace
}  // namespace footfall::test
