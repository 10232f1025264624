// A run reads its scenario twice: once to know its town, once to play. Whatever is in the file, the
// whole program takes no longer than a load may: 2 s of the processor's time.
#include <gmock/gmock.h>

#include "process/program.h"
#include "tests/cli/program.h"
#include "tests/scripting/hostile.h"

namespace reprise::test {

namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

class HostileRun : public testing::TestWithParam<Hostile> {};

/// As many jumps as a file may have, and such work outside of `run`.
Hostile working(const std::string& name, const LazyText& work, const std::string& message) {
    return {name,
            "local a local x = " + times(9'990, "a or ") + "a\n" + work +
                "\nreturn scenario 'test' { run = function() end }",
            message};
}

std::vector<Hostile> scripts() {
    std::vector<Hostile> all = hostile_loads();
    // The dearest that both readings let pass.
    all.push_back(working("AsMuchAsIsPlayed",
                          "local s = ('a'):rep(600) local p = '%f[' .. ('b'):rep(600) .. ']' "
                          "for i = 1, 32 do s:find(p) end",
                          ""));
    // Almost what a tick may take: twice, it would be more than 2 s.
    all.push_back(working(
        "AlmostATicksWork",
        "local b, c = 1.0000001, -7.3e9 for i = 1, 98000 do " + times(100, "x = b ^ c ") + "end",
        spent_in_a_load));
    return all;
}

}  // namespace

TEST_P(HostileRun, EndsWithinTwoSecondsOfTheProcessor) {
    const Hostile& script = GetParam();
    const Folder folder;
    write_file(folder / "test.lua", script.source.made());
    const process::ProgramResult run = process::run_program(
        {.name = REPRISE_PROGRAM,
         .words =
             {"run", "test.lua", "--town", source("tests/cli/crash/small.net.xml"), "--for", "1"},
         .folder = folder.path(),
         .limits = {.memory = std::uint64_t{1200} << 20U, .seconds = 2}});
    EXPECT_EQ(run.stopped, "");
    EXPECT_EQ(run.code, script.message.empty() ? 0 : 2) << run.said;
    if (script.message.empty())
        return;
    if (script.message == "more than 1 MB") {
        EXPECT_THAT(run.said, HasSubstr("'test.lua' is larger than 1 MB"));
    } else {
        EXPECT_THAT(run.said, HasSubstr(script.message));
        EXPECT_THAT(run.said, ContainsRegex("test\\.lua:[0-9]+: "));
    }
    EXPECT_THAT(folder.files(), testing::ElementsAre("test.lua"));
}

INSTANTIATE_TEST_SUITE_P(Load, HostileRun, testing::ValuesIn(scripts()), [](const auto& info) {
    return info.param.name;
});

}  // namespace reprise::test
