#include <filesystem>

#include <gmock/gmock.h>

#include "tests/cli/program.h"

// A file of points beside a scenario travels in its trace.
namespace reprise::test {
namespace {

using testing::HasSubstr;

class TrajectoryFiles : public testing::Test {
  protected:
    void SetUp() override {
        write_file(folder_ / "lead.csv", "t,x,y\n1,112,-4.8\n3,135,-3\n5,160,-1.6\n");
        write_file(folder_ / "lead.lua", R"(
            return scenario 'lead' { town = 'straight', duration = 8, run = function()
                local lead = spawn{ name = 'lead', model = 'sedan', x = 100, y = -4.8,
                                    heading_deg = 0, driver = 'manual' }
                lead:follow 'lead.csv'
                wait_until(function() return not lead:following() end)
                if math.abs(lead:x() - 160) > 0.001 then error(lead:x()) end
            end })");
        run({"run", "lead.lua", "-o", "lead.mcap"});
        std::filesystem::remove(folder_ / "lead.csv");  // nobody needs it from here on
    }

    std::string run(const std::vector<std::string>& words, int code = 0) {
        const Result result = reprise(words, folder_.path());
        EXPECT_EQ(result.code, code) << result.out;
        return result.out;
    }

    const Folder folder_;
};

TEST_F(TrajectoryFiles, AreInTheTrace) {
    EXPECT_THAT(run({"verify", "lead.mcap"}), HasSubstr("equal at every one of"));
    run({"run", "lead.mcap", "-o", "again.mcap"});
    EXPECT_THAT(run({"diff", "lead.mcap", "again.mcap"}), HasSubstr("equal"));
}

TEST_F(TrajectoryFiles, ComeThroughStripAndExpand) {
    run({"strip", "lead.mcap", "--level", "inputs", "-o", "small.mcap"});
    run({"expand", "small.mcap", "-o", "whole.mcap"});
    EXPECT_TRUE(read_file(folder_ / "lead.mcap") == read_file(folder_ / "whole.mcap"));
}

TEST_F(TrajectoryFiles, OfABranchToo) {
    write_file(folder_ / "away.csv", "t,x,y\n2,150,-4.8\n");
    write_file(folder_ / "away.lua",
               "return scenario 'away' { run = function() local lead = actor 'lead'\n"
               "lead:follow 'away.csv' wait(3) end }");
    run({"branch", "lead.mcap", "--at", "2.5s", "--script", "away.lua", "-o", "away.mcap"});
    std::filesystem::remove(folder_ / "away.csv");
    EXPECT_THAT(run({"verify", "away.mcap"}), HasSubstr("equal at every one of"));
}

TEST_F(TrajectoryFiles, ThatAreMissingAreSaid) {
    EXPECT_THAT(run({"run", "lead.lua", "-o", "none.mcap"}, 2),
                HasSubstr("no file 'lead.csv' came with the scenario"));
}

TEST_F(TrajectoryFiles, AreAtMostAMegabyte) {
    write_file(folder_ / "lead.csv", std::string(1'200'000, '1'));
    EXPECT_THAT(run({"run", "lead.lua", "-o", "none.mcap"}, 2),
                HasSubstr("'lead.csv', which the scenario names, is larger than 1 MB"));
}

}  // namespace
}  // namespace reprise::test
