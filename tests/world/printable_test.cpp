#include "world/printable.h"

#include <gtest/gtest.h>

namespace reprise::world {
namespace {

TEST(Printable, LeavesTextsOfAllLanguagesAsTheyAre) {
    for (const char* text : {"", "cut_in.lua:12", "a\tb", "Grüße", "日本語", "שלום", "🚗", "é"})
        EXPECT_EQ(printable(text), text);
}

TEST(Printable, WritesOutWhatATerminalWouldObey) {
    EXPECT_EQ(printable("a\x1b[2Jb"), "a\\x1b[2Jb");
    EXPECT_EQ(printable("\r\n\x07\x7f"), "\\x0d\\x0a\\x07\\x7f");
    EXPECT_EQ(printable("\xc2\x9b"), "\\xc2\\x9b") << "C1: CSI in one character";
    EXPECT_EQ(printable(std::string_view("\0", 1)), "\\x00");
    EXPECT_EQ(printable("\xe2\x80\xae"), "\\xe2\\x80\\xae") << "right-to-left override";
    for (char last = '\xa8'; last <= '\xae'; ++last)
        EXPECT_EQ(printable(std::string("\xe2\x80") + last).size(), 12U);
    for (char last = '\xa6'; last <= '\xa9'; ++last)
        EXPECT_EQ(printable(std::string("\xe2\x81") + last).size(), 12U);
    EXPECT_EQ(printable("\xe2\x80\xaf"), "\xe2\x80\xaf") << "a narrow space is harmless";
}

TEST(Printable, WritesOutBrokenUtf8) {
    EXPECT_EQ(printable("\xff"), "\\xff");
    EXPECT_EQ(printable("\xc3"), "\\xc3") << "cut off";
    EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf") << "overlong";
    EXPECT_EQ(printable("\xe0\x80\xaf"), "\\xe0\\x80\\xaf") << "overlong";
    EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "surrogate";
    EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "beyond Unicode";
}

TEST(Printable, KeepsLinesWhereTheyAreWanted) {
    EXPECT_EQ(printable_lines("a\nb\x1b\r\n"), "a\nb\\x1b\\x0d\n");
}

}  // namespace
}  // namespace reprise::world
