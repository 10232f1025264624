#include <filesystem>

#include <gmock/gmock.h>

#include "tests/cli/program.h"

namespace reprise::test {
namespace {

using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;

TEST(TownCheck, DrivesThereForAMinute) {
    const Result result = reprise({"town", "check", "town2"});
    EXPECT_EQ(result.code, 0) << result.out;
    EXPECT_THAT(result.out, HasSubstr("ok   drives that ended early"));
    EXPECT_THAT(result.out, HasSubstr("3 drives of a minute, in traffic"));
}

/// SUMO's assertions end the program that they are in. Which network still brings one about nobody
/// knows beforehand: here another program stands in for the one that drives.
TEST(TownCheck, ADriveThatALibraryEndsIsAFailWithItsWords) {
    const Folder folder;
    const fs::path bin = fs::path(REPRISE_PROGRAM).parent_path();
    fs::create_directory(folder / "bin");
    fs::copy_file(bin / "reprise-town", folder / "bin/reprise-town");
    write_file(folder / "bin/reprise-run",
               "#!/bin/sh\n"
               "echo 'small.net.xml: a note' >&2\n"
               "echo \"reprise: ./src/microsim/MSLane.cpp:4258: getBidiLane() const: Assertion "
               "\\`size() == 1' failed.\" >&2\n"
               "echo 'reprise: a library stopped itself (its reason is above)' >&2\n"
               "exit 70\n");
    fs::permissions(folder / "bin/reprise-run", fs::perms::owner_all);
    const Result result =
        run_program(folder / "bin/reprise-town",
                    {"town", "check", source("scenarios/towns/town2/town2.net.xml")});
    EXPECT_EQ(result.code, 1) << result.out;
    EXPECT_THAT(result.out, HasSubstr("FAIL drives that ended early"));
    EXPECT_THAT(result.out,
                HasSubstr("drive 1: microsim/MSLane.cpp:4258: getBidiLane() const: Assertion "
                          "`size() == 1' failed."));
    EXPECT_THAT(result.out, HasSubstr("1 of 21 criteria do not hold"));
    EXPECT_THAT(result.out, Not(HasSubstr("a note")));
}

/// As well as what ends a drive in our own words.
TEST(TownCheck, ATownWithoutRoomForACarFails) {
    const Folder folder;
    write_file(
        folder / "stub.net.xml",
        R"(<net version="1.9"><edge id="r" from="A" to="B"><lane id="r_0" index="0" speed="13.89" length="3" shape="0,0 3,0"/></edge>)"
        R"(<junction id="A" type="dead_end" x="0" y="0" incLanes="" intLanes="" shape="0,0 0,-3"/>)"
        R"(<junction id="B" type="dead_end" x="3" y="0" incLanes="r_0" intLanes="" shape="3,0 3,-3"/></net>)");
    const Result result = reprise({"town", "check", "stub.net.xml"}, folder.path());
    EXPECT_EQ(result.code, 1) << result.out;
    EXPECT_THAT(result.out, HasSubstr("FAIL drives that ended early"));
    EXPECT_THAT(result.out, HasSubstr("drive 1: trial.lua:"));
}

TEST(CrowdedTown, IsToldAboutWithTheNumberThatItCarries) {
    const Folder folder;
    write_file(
        folder / "crowd.lua",
        "return scenario 'crowd' { town = 'town2', cars = 100, run = function() wait(1) end }");
    const std::string words = "crowd.lua: 100 cars are more than town2 carries, which is about 61";
    const auto run = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all{"run", "crowd.lua", "--for", "0.1", "-o", "a.mcap"};
        all.insert(all.end(), more.begin(), more.end());
        return reprise(all, folder.path());
    };
    const Result crowded = run({});
    EXPECT_EQ(crowded.code, 0) << crowded.out;
    EXPECT_THAT(crowded.out, HasSubstr(words));
    EXPECT_THAT(run({"--cars", "70"}).out, Not(HasSubstr("carries")));
    EXPECT_THAT(run({"--cars", "auto"}).out, Not(HasSubstr("carries")));
    EXPECT_THAT(reprise({"info", "a.mcap"}, folder.path()).out, HasSubstr("61 cars of traffic"));
    const Result mistake = run({"--cars", "some"});
    EXPECT_EQ(mistake.code, 2);
    EXPECT_THAT(mistake.out, HasSubstr("expected a whole number from 0 to 10000, or auto"));
}

}  // namespace
}  // namespace reprise::test
