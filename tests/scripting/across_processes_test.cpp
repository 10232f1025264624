#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "process/program.h"

// The same scenario in processes that differ in all that must not count: addresses, hash seeds,
// environment. `traps.lua` prints the answers of everything in Lua that could differ; the digests
// in the last line hold instructions and memory of every tick.
namespace reprise::scripting {

namespace {

using testing::HasSubstr;

std::string play(const std::string& scenario,
                 int ticks,
                 const std::string& environment = "",
                 int code = 0) {
    const std::string command = environment + " '" REPRISE_PLAY_SCENARIO "' '" REPRISE_TRAPS "/" +
                                scenario + ".lua' " + std::to_string(ticks);
    const process::ProgramResult played = process::run_program({"sh", {"-c", command}});
    EXPECT_EQ(played.code, code) << played.stopped << played.said;
    return played.said;
}

const std::vector<std::string>& environments() {
    static const std::vector<std::string> all{"setarch -R",
                                              "env -i",
                                              "MALLOC_PERTURB_=165",
                                              "MALLOC_ARENA_MAX=1 MALLOC_TOP_PAD_=1000000",
                                              "LC_ALL=C.utf8",
                                              "LC_ALL=de_DE.UTF-8 LANG=de_DE",
                                              "TZ=Asia/Kolkata LUA_INIT=nonsense LUA_PATH=/",
                                              "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-SSE4_2"};
    return all;
}

}  // namespace

TEST(AcrossProcesses, EveryTrapAnswersTheSameInEveryEnvironment) {
    const std::string here = play("traps", 200);
    EXPECT_THAT(here, HasSubstr(": scenario ended"));
    for (const std::string& environment : environments())
        EXPECT_EQ(play("traps", 200, environment), here) << environment;
    for (int repeat = 0; repeat < 10; ++repeat)
        EXPECT_EQ(play("traps", 200), here);
}

// Traps 16, 17, 19, 20: what memory is asked for, when it is collected and when it runs out.
TEST(AcrossProcesses, Trap20_MemoryRunsOutInTheSameTick) {
    const std::string here = play("out_of_memory", 200, "", 2);
    EXPECT_THAT(here, HasSubstr("the scenario needs more than 64 MB of memory"));
    EXPECT_THAT(here, Not(HasSubstr("went on")));
    for (int repeat = 0; repeat < 10; ++repeat)
        EXPECT_EQ(play("out_of_memory", 200, "", 2), here);
    EXPECT_EQ(play("out_of_memory", 200, "setarch -R", 2), here);
    EXPECT_EQ(play("out_of_memory", 200, "MALLOC_PERTURB_=90", 2), here);
}

}  // namespace reprise::scripting
