// What a golden is to pin, runs without one, and runs over and over.
#include <gmock/gmock.h>

#include "tests/cli/program.h"

namespace reprise::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

constexpr const char* two_cars = R"(return scenario 'two' {
    town = 'straight', duration = 4, seed = 7,
    params = { ego_speed = 10, other_speed = 10, word = 'hello', least = 5 },
    run = function(p)
        local lane = 'east_0'
        local ego = spawn{ name = 'ego', model = 'sedan', lane = lane, s = 6, speed = p.ego_speed }
        local other = spawn{ name = 'other', model = 'suv', driver = 'traffic', lane = 'east_1', s = 60, speed = p.other_speed }
        check.min('gap', function() return gap(ego, other) end, p.least)
        ego:set_speed(p.ego_speed)
        other:set_speed(p.other_speed)
        wait(3)
        print(p.word)
    end,
}
)";

class Pins : public testing::Test {
  protected:
    void accept(const std::string& pins) {
        write_file(folder_ / "two.lua", two_cars);
        const Result first =
            call({"accept", "two.lua", "--because", "first golden", "--pin", pins});
        ASSERT_EQ(first.code, 0) << first.out;
    }

    Result call(const std::vector<std::string>& words) { return reprise(words, folder_.path()); }

    void edit(const std::string& before, const std::string& after) {
        std::string text = read_file(folder_ / "two.lua");
        const auto at = text.find(before);
        ASSERT_NE(at, std::string::npos) << before;
        write_file(folder_ / "two.lua", text.replace(at, before.size(), after));
    }

    /// Exit status of `reprise test` with this text in place of that.
    int code_with(const std::string& before, const std::string& after) {
        edit(before, after);
        const int code = call({"test", "two.lua"}).code;
        edit(after, before);
        return code;
    }

    Folder folder_;
};

TEST_F(Pins, CodeWithoutEffectLeavesAGoldenGreen) {
    accept("numbers");
    edit("local lane",
         "local unused = {}\n for i = 1, 1000 do unused[i] = 'text' .. i end\n local lane");
    const Result result = call({"test", "two.lua"});
    EXPECT_EQ(result.code, 0) << result.out;
    EXPECT_THAT(result.out,
                HasSubstr("equal, verdict passed; the scenario's text changed without"));
}

TEST_F(Pins, VerdictAloneIsComparedWhereOnlyItIsPinned) {
    accept("verdict");
    EXPECT_EQ(code_with("ego_speed = 10", "ego_speed = 11"), 0);
    EXPECT_EQ(code_with("'hello'", "'good day'"), 0);
    EXPECT_EQ(code_with("least = 5", "least = 500"), 1);
    EXPECT_THAT(read_file(folder_ / "two.golden"), Not(HasSubstr("\"states\": [")));
}

TEST_F(Pins, EventsAreComparedWithoutNumbers) {
    accept("events");
    EXPECT_EQ(code_with("ego_speed = 10", "ego_speed = 11"), 0);
    EXPECT_EQ(code_with("'hello'", "'good day'"), 1);
    EXPECT_EQ(code_with("wait(3)", "wait(3.2)"), 1);
}

TEST_F(Pins, AnActorIsComparedByItsName) {
    accept("ego");
    EXPECT_EQ(code_with("other_speed = 10", "other_speed = 12"), 0);
    EXPECT_EQ(code_with("ego_speed = 10", "ego_speed = 11"), 1);
    EXPECT_EQ(code_with("name = 'ego'", "name = 'we'"), 1) << "it is not there any more";
}

TEST_F(Pins, StayWhatTheyWereWhenTheRunIsAcceptedAgain) {
    accept("verdict");
    edit("least = 5", "least = 500");
    ASSERT_EQ(call({"accept", "two.lua", "--because", "it must fail now"}).code, 0);
    EXPECT_THAT(read_file(folder_ / "two.golden"), HasSubstr("\"pins\": [\n\"verdict\"\n]"));
    ASSERT_EQ(call({"accept", "two.lua", "--because", "all of it", "--pin", "numbers"}).code, 0);
    EXPECT_EQ(code_with("ego_speed = 10", "ego_speed = 11"), 1);
}

TEST_F(Pins, UnknownOnesAreRefusedWithTheChoices) {
    write_file(folder_ / "two.lua", two_cars);
    const Result result = call({"accept", "two.lua", "--because", "x", "--pin", "eog"});
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.out,
                HasSubstr("REFUSED   two  a golden cannot pin 'eog' (did you mean 'ego'?)"));
    EXPECT_THAT(result.out, HasSubstr("verdict, events, numbers, ego, other"));
    EXPECT_FALSE(fs::exists(folder_ / "two.golden"));
}

TEST_F(Pins, ChecksOnlyLetsNumbersBe) {
    accept("numbers");
    edit("ego_speed = 10", "ego_speed = 11");
    EXPECT_EQ(call({"test", "two.lua"}).code, 1);
    const Result result = call({"test", "two.lua", "--checks"});
    EXPECT_EQ(result.code, 0) << result.out;
    edit("'hello'", "'good day'");
    EXPECT_EQ(call({"test", "two.lua", "--checks"}).code, 1) << "events count";
}

TEST_F(Pins, ChecksOnlyNeedsNoGolden) {
    write_file(folder_ / "two.lua", two_cars);
    const Result good = call({"test", "two.lua", "--checks"});
    EXPECT_EQ(good.code, 0) << good.out;
    EXPECT_THAT(good.out, HasSubstr("checks only: verdict passed"));
    edit("least = 5", "least = 500");
    const Result bad = call({"test", "two.lua", "--checks"});
    EXPECT_EQ(bad.code, 1);
    EXPECT_THAT(bad.out, HasSubstr("FAILED    two  checks only: verdict failed"));
    EXPECT_THAT(bad.out, HasSubstr("gap: failed at"));
}

TEST_F(Pins, RepeatedRunsAreOneHistory) {
    accept("numbers");
    const Result result = call({"test", "two.lua", "--repeat", "5"});
    EXPECT_EQ(result.code, 0) << result.out;
    EXPECT_THAT(result.out, HasSubstr("equal, verdict passed; 5 runs, one history"));
}

TEST_F(Pins, RunThatIsAnotherOneIsFoundByRepeatingIt) {
    accept("numbers");
    // The fourth run has another seed; the golden is that of the first three.
    fs::create_directory(folder_ / "bin");
    const fs::path real = fs::path(REPRISE_PROGRAM).parent_path() / "reprise-run";
    fs::copy_file(REPRISE_PROGRAM, folder_ / "bin/reprise");
    write_file(folder_ / "bin/reprise-run",
               "#!/bin/sh\necho x >> " + (folder_ / "count") + "\n[ $(wc -l < " +
                   (folder_ / "count") + ") = 4 ] && set -- \"$@\" --seed 8\nexec " +
                   real.string() + " \"$@\"\n");
    fs::permissions(folder_ / "bin/reprise-run", fs::perms::owner_all);
    const Result result =
        run_program(folder_ / "bin/reprise", {"test", "two.lua", "--repeat", "6"}, folder_.path());
    EXPECT_EQ(result.code, 3) << result.out;
    EXPECT_THAT(result.out, HasSubstr("(run 4 of 6)"));
    EXPECT_THAT(result.out, HasSubstr("tick 1 (0.05 s), stage"));
    EXPECT_TRUE(fs::exists(folder_ / "reprise-test/two.second.mcap"));
}

}  // namespace
}  // namespace reprise::test
