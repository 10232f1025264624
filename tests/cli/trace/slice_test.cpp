#include <algorithm>

#include <gmock/gmock.h>

#include "tests/cli/program.h"

namespace reprise::test {
namespace {

using testing::HasSubstr;

/// A recorded drive of 100 ticks, its start and the rest of it.
class SliceCommand : public testing::Test {
  protected:
    void SetUp() override {
        write_file(folder_ / "drive.lua", R"(
            return scenario 'drive' { town = 'town1', cars = 5, seed = 3, run = function()
                spawn{ name = 'ego', model = 'sedan' }
                wait_ticks(100)
            end })");
        run({"run", "drive.lua", "-o", "t.mcap"}, 0);
        run({"slice", "t.mcap", "--ticks", "..40", "-o", "head.mcap"}, 0);
        run({"slice", "t.mcap", "--ticks", "41..", "-o", "tail.mcap"}, 0);
    }

    std::string run(const std::vector<std::string>& words, int code) {
        const Result result = reprise(words, folder_.path());
        EXPECT_EQ(result.code, code) << result.out;
        return result.out;
    }

    const Folder folder_;
};

TEST_F(SliceCommand, MergedIsTheRunByteForByte) {
    EXPECT_THAT(run({"merge", "head.mcap", "tail.mcap", "-o", "whole.mcap"}, 0),
                HasSubstr("the whole run as it was recorded"));
    EXPECT_TRUE(read_file(folder_ / "whole.mcap") == read_file(folder_ / "t.mcap"));
}

TEST_F(SliceCommand, ManyAreMergedInAnyOrder) {
    run({"slice", "head.mcap", "--ticks", "21..40", "-o", "middle.mcap"}, 0);
    run({"slice", "head.mcap", "--ticks", "..20", "-o", "start.mcap"}, 0);
    run({"merge", "tail.mcap", "start.mcap", "middle.mcap", "-o", "whole.mcap"}, 0);
    EXPECT_TRUE(read_file(folder_ / "whole.mcap") == read_file(folder_ / "t.mcap"));
    EXPECT_THAT(run({"merge", "tail.mcap", "start.mcap", "-o", "x.mcap"}, 2),
                HasSubstr("cannot join start.mcap (ticks 1 to 20) and tail.mcap (ticks 41 to "));
    EXPECT_THAT(run({"merge", "head.mcap", "-o", "x.mcap"}, 2),
                HasSubstr("merge: expected two slices or more"));
}

TEST_F(SliceCommand, FromTheStartIsVerifiedStrippedAndExpanded) {
    EXPECT_THAT(run({"verify", "head.mcap"}, 0), HasSubstr("equal at every one of 40 ticks"));
    run({"strip", "head.mcap", "-o", "small.mcap", "--level", "inputs"}, 0);
    EXPECT_THAT(run({"info", "small.mcap"}, 0), HasSubstr("slice     ticks 1 to 40 of "));
    run({"expand", "small.mcap", "-o", "again.mcap"}, 0);
    EXPECT_TRUE(read_file(folder_ / "again.mcap") == read_file(folder_ / "head.mcap"));
}

TEST_F(SliceCommand, FromLaterOnIsReadAndRendered) {
    EXPECT_THAT(run({"info", "tail.mcap"}, 0), HasSubstr("slice     ticks 41 to "));
    EXPECT_THAT(run({"cat", "tail.mcap", "--ticks", "41..42"}, 0), HasSubstr("\"tick\":\"41\""));
    EXPECT_THAT(run({"stats", "tail.mcap"}, 0), HasSubstr("61 ticks, 3.05 s"));
    run({"render", "tail.mcap", "-o", "pictures", "--size", "8x6", "--to", "42"}, 0);
    // Less of it is a slice still.
    run({"strip", "t.mcap", "-o", "core.mcap", "--level", "core"}, 0);
    run({"slice", "core.mcap", "--ticks", "41..", "-o", "core_tail.mcap"}, 0);
    run({"strip", "tail.mcap", "-o", "tail_core.mcap", "--level", "core"}, 0);
    EXPECT_TRUE(read_file(folder_ / "core_tail.mcap") == read_file(folder_ / "tail_core.mcap"));
}

TEST_F(SliceCommand, FromLaterOnIsNotSimulatedAndSaysSoInALine) {
    const std::vector<std::vector<std::string>> refused{
        {"verify", "tail.mcap"},
        {"run", "tail.mcap", "-o", "x.mcap"},
        {"expand", "tail.mcap", "-o", "x.mcap"},
        {"branch", "tail.mcap", "--at", "50t", "--script", "drive.lua", "-o", "x.mcap"},
        {"diff", "t.mcap", "tail.mcap"},
        {"diff", "tail.mcap", "t.mcap", "--json"},
        {"strip", "tail.mcap", "-o", "x.mcap", "--level", "inputs"},
        {"recover", "tail.mcap", "-o", "x.mcap"}};
    for (const auto& words : refused) {
        const std::string out = run(words, 2);
        EXPECT_THAT(out, HasSubstr("tail.mcap: a slice that begins at tick 41; ")) << words[0];
        EXPECT_EQ(std::count(out.begin(), out.end(), '\n'), 1) << out;
    }
    for (const std::string& file : folder_.files())
        EXPECT_THAT(file, testing::Not(HasSubstr("x.mcap")));
}

TEST_F(SliceCommand, OfInputsBeginsAtTickOne) {
    run({"strip", "t.mcap", "-o", "inputs.mcap", "--level", "inputs"}, 0);
    run({"slice", "inputs.mcap", "--ticks", "1..40", "-o", "start.mcap"}, 0);
    run({"strip", "head.mcap", "-o", "small.mcap", "--level", "inputs"}, 0);
    EXPECT_TRUE(read_file(folder_ / "start.mcap") == read_file(folder_ / "small.mcap"));
    EXPECT_THAT(run({"slice", "inputs.mcap", "--ticks", "41..", "-o", "x.mcap"}, 2),
                HasSubstr("`reprise expand inputs.mcap -o FULL.mcap` makes the rest again"));
}

}  // namespace
}  // namespace reprise::test
