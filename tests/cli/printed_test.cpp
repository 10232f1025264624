// What is printed from files that others wrote does nothing to a terminal.
#include <fstream>

#include <gmock/gmock.h>

#include "tests/cli/program.h"

namespace reprise::test {
namespace {

using testing::HasSubstr;

/// Whether a terminal that gets these bytes only shows them; said byte by byte, apart from the
/// program's own decoder. ESC, BEL, CR, C1, U+202A..202E, U+2066..2069, broken UTF-8.
::testing::AssertionResult is_tame(const std::string& text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = [&](std::size_t k) {
            return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0U;
        };
        const bool control =
            (byte(0) < 0x20 && byte(0) != '\n' && byte(0) != '\t') || byte(0) == 0x7f;
        const bool c1 = byte(0) == 0xc2 && byte(1) < 0xa0;
        const bool turns =
            byte(0) == 0xe2 && ((byte(1) == 0x80 && byte(2) >= 0xa8 && byte(2) <= 0xae) ||
                                (byte(1) == 0x81 && byte(2) >= 0xa6 && byte(2) <= 0xa9));
        if (control || c1 || turns || byte(0) >= 0xf8)
            return ::testing::AssertionFailure()
                   << "byte " << i << ": " << testing::PrintToString(text.substr(i, 40));
    }
    return ::testing::AssertionSuccess();
}

class Printed : public testing::Test {
  protected:
    void SetUp() override {
        const Result made = run_program(REPRISE_HOSTILE_TRACE, {folder_ / "h.mcap"});
        ASSERT_EQ(made.code, 0) << made.out;
        const std::string whole = read_file(folder_ / "h.mcap");
        write_file(folder_ / "cut.mcap", whole.substr(0, whole.size() - 100));
    }

    const Folder folder_;
};

TEST_F(Printed, TracesDoNothingToATerminal) {
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"info", "h.mcap"},
          {"info", "h.mcap", "--long"},
          {"info", "h.mcap", "--json"},
          {"stats", "h.mcap"},
          {"stats", "h.mcap", "--json"},
          {"score", "h.mcap"},
          {"score", "h.mcap", "--json"},
          {"cat", "h.mcap"},
          {"cat", "h.mcap", "--fields", "events.text", "--format", "csv"},
          {"query", "h.mcap", "select * from events"},
          {"query", "h.mcap", "select * from events", "--format", "jsonl"},
          {"diff", "h.mcap", "h.mcap"},
          {"diff", "h.mcap", "h.mcap", "--json"},
          {"export", "h.mcap", "--to", "jsonl", "-o", "-"},
          {"show", "h.mcap", "-o", "-"},
          {"slice", "h.mcap", "--ticks", "1..70", "-o", "s.mcap"},
          {"strip", "h.mcap", "--level", "core", "-o", "c.mcap"},
          {"recover", "cut.mcap", "-o", "r.mcap"},
          {"verify", "h.mcap"},
          {"expand", "h.mcap", "-o", "x.mcap"},
          {"run", "h.mcap", "-o", "again.mcap"},
          {"render", "h.mcap", "-o", "pictures", "--every", "69", "--size", "64x48"}}) {
        const Result result = reprise(words, folder_.path());
        EXPECT_TRUE(is_tame(result.out)) << words[0];
        EXPECT_FALSE(result.out.empty()) << words[0];
        if (words[0] == "info" && words.size() == 2) {
            EXPECT_THAT(result.out, HasSubstr("failed\\x1b[2J\\xc2\\x9b"));
            EXPECT_THAT(result.out, testing::Not(HasSubstr("\nreprise: verified")));
        }
    }
}

TEST_F(Printed, NamesOfFilesDoNothingToATerminal) {
    const std::string name = "a\x1b[2J\xe2\x80\xae.mcap";
    write_file(folder_ / name, "no trace");
    for (const std::string command : {"info", "verify", "stats", "cat"})
        EXPECT_TRUE(is_tame(reprise({command, name}, folder_.path()).out)) << command;
    EXPECT_TRUE(is_tame(reprise({"info", "none" + name}, folder_.path()).out));
    EXPECT_TRUE(is_tame(reprise({"no\x1b[2Jcommand"}, folder_.path()).out));
    EXPECT_TRUE(is_tame(reprise({"info", "--no\x1b[2Joption"}, folder_.path()).out));
}

TEST_F(Printed, MapsAndGoldensDoNothingToATerminal) {
    const std::string bad = "\x1b[2J\xe2\x80\xae";
    std::string map = read_file(source("tests/towns/village.osm"));
    map.replace(map.find("Mill Lane"), 9, "M\xe2\x80\xae");
    write_file(folder_ / "street.osm", map);
    std::string wrong = map;
    wrong.replace(wrong.find("v=\"20 mph\""), 10, "v=\"9999 \xe2\x80\xae\"");
    write_file(folder_ / "wrong.osm", wrong);
    write_file(
        folder_ / "net.net.xml",
        "<net version='1.9\xe2\x80\xae'><edge id='" + std::string("\xe2\x80\xae") + "'/></net>");
    write_file(folder_ / "road.xodr", "<OpenDRIVE><road length='\xe2\x80\xae'/></OpenDRIVE>");
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"town", "import", "street.osm", "-o", "t"},
          {"town", "import", "wrong.osm", "-o", "w"},
          {"town", "import", "road.xodr", "-o", "r"},
          {"town", "check", "net.net.xml"},
          {"town", "check", "street.osm"},
          {"town", "check", "street.osm", "--json"},
          {"town", "show", "no" + bad, "-o", "x.png"}})
        EXPECT_TRUE(is_tame(reprise(words, folder_.path()).out)) << words[1] << " " << words[2];
    write_file(folder_ / "x.lua", "return scenario 'x' { run = function() end }");
    write_file(folder_ / "x.golden", "golden 1 " + bad);
    for (const std::string command : {"test", "golden"})
        EXPECT_TRUE(is_tame(reprise({command, "x.lua"}, folder_.path()).out)) << command;
}

}  // namespace
}  // namespace reprise::test
