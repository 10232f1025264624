#include <algorithm>
#include <cstdlib>

#include <gmock/gmock.h>

#include "tests/cli/program.h"

namespace reprise::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Records a short drive.
std::string record(const Folder& folder,
                   const std::string& name,
                   const std::string& seed,
                   const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"run",
                                   source("scenarios/free_drive.lua"),
                                   "-o",
                                   folder / name,
                                   "--seed",
                                   seed,
                                   "--for",
                                   "8"};
    words.insert(words.end(), more.begin(), more.end());
    const Result result = reprise(words);
    EXPECT_EQ(result.code, 0) << result.out;
    return folder / name;
}

TEST(Run, TwoProcessesWithOneSeedWriteTheSameBytes) {
    const Folder folder;
    const std::string one = record(folder, "a.mcap", "7");
    const std::string other = record(folder, "b.mcap", "7");
    EXPECT_TRUE(read_file(one) == read_file(other));
    const Result diff = reprise({"diff", one, other});
    EXPECT_EQ(diff.code, 0);
    EXPECT_THAT(diff.out, HasSubstr("equal: 160 ticks"));
}

TEST(Diff, NamesTickStageAndFieldOfAnotherSeed) {
    const Folder folder;
    const Result diff =
        reprise({"diff", record(folder, "a.mcap", "7"), record(folder, "b.mcap", "8")});
    EXPECT_EQ(diff.code, 1);
    EXPECT_THAT(diff.out, HasSubstr("tick 1"));
    EXPECT_THAT(diff.out, HasSubstr("stage"));
    EXPECT_THAT(diff.out, HasSubstr("field"));
    EXPECT_THAT(diff.out, HasSubstr("seed"));
}

TEST(Verify, NeedsNothingButTheTrace) {
    const Folder folder;
    const Folder empty;
    std::filesystem::copy(record(folder, "a.mcap", "7"), empty / "a.mcap");
    const Result verify = reprise({"verify", "a.mcap"}, empty.path());
    EXPECT_EQ(verify.code, 0) << verify.out;
    EXPECT_THAT(verify.out, HasSubstr("equal at every one of 160 ticks"));
    EXPECT_THAT(empty.files(), testing::ElementsAre("a.mcap"));
}

TEST(Verify, ReportsANudgedInputAtItsTick) {
    const Folder folder;
    const Result verify = reprise({"verify", record(folder, "a.mcap", "7", {"--nudge", "101"})});
    EXPECT_EQ(verify.code, 1);
    EXPECT_THAT(verify.out, HasSubstr("tick 101"));
    EXPECT_THAT(verify.out, HasSubstr("controls"));
    EXPECT_THAT(verify.out, HasSubstr("steer"));
}

TEST(Diff, ReportsANudgedInputAtItsTick) {
    const Folder folder;
    const Result diff = reprise(
        {"diff", record(folder, "a.mcap", "7"), record(folder, "b.mcap", "7", {"--nudge", "77"})});
    EXPECT_EQ(diff.code, 1);
    EXPECT_THAT(diff.out, HasSubstr("tick 77"));
    EXPECT_THAT(diff.out, HasSubstr("steer"));
}

TEST(Verify, ReportsAFlippedBit) {
    const Folder folder;
    const std::string path = record(folder, "a.mcap", "7");
    std::string bytes = read_file(path);
    bytes[bytes.size() * 3 / 4] = static_cast<char>(bytes[bytes.size() * 3 / 4] ^ 4);
    write_file(path, bytes);
    const Result verify = reprise({"verify", path});
    EXPECT_EQ(verify.code, 1) << verify.out;
    EXPECT_THAT(verify.out, HasSubstr("tick"));
}

TEST(Info, SaysWhatRanAndHowToRunItAgain) {
    const Folder folder;
    const Result info = reprise({"info", record(folder, "a.mcap", "7")});
    EXPECT_EQ(info.code, 0);
    for (const char* word :
         {"free_drive", "town1", "seed", "100 cars", "clear_noon", "160 ticks", "again"})
        EXPECT_THAT(info.out, HasSubstr(word));
}

TEST(Run, EveryShippedScenarioPassesItsChecks) {
    const Folder folder;
    for (const char* scenario : {"cut_in", "child_runs_out"}) {
        const std::string name = std::string("scenarios/") + scenario + ".lua";
        const Result run = reprise({"run", source(name), "-o", folder / "t.mcap"});
        EXPECT_EQ(run.code, 0) << run.out;
        EXPECT_THAT(run.out, HasSubstr("passed"));
        EXPECT_THAT(run.out, Not(HasSubstr("FAIL")));
    }
}

TEST(Programs, TheThinOneLoadsNeitherSumoNorOpenCv) {
    const Folder folder;
    const std::string list = folder / "libraries";
    ASSERT_EQ(std::system(("ldd " REPRISE_PROGRAM " > " + list).c_str()), 0);
    const std::string libraries = read_file(list);
    for (const char* heavy : {"sumo", "opencv", "embree", "Bullet", "lua"})
        EXPECT_THAT(libraries, Not(HasSubstr(heavy)));
    EXPECT_LT(std::count(libraries.begin(), libraries.end(), '\n'), 15);
}

}  // namespace
}  // namespace reprise::test
