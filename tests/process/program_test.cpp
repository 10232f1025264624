#include "process/program.h"

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sys/resource.h>

#include <gmock/gmock.h>

#include "tests/process/scratch.h"
#include "world/check.h"

namespace reprise::process {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class ChildProgram : public test::Scratch {
  protected:
    ProgramResult shell(const std::string& script, const Limits& limits = {}) const {
        return run_program(
            {.name = "sh", .words = {"-c", script}, .folder = folder_, .limits = limits});
    }
};

TEST_F(ChildProgram, GetsItsWordsAsTheyAreAndNoInput) {
    const ProgramResult result = run_program({.name = "printf",
                                              .words = {"%s|", "a b", "$HOME", "`x`", "'", "*", ""},
                                              .folder = folder_});
    EXPECT_EQ(result.code, 0);
    EXPECT_EQ(result.said, "a b|$HOME|`x`|'|*||");
    EXPECT_TRUE(fs::is_empty(folder_)) << "nothing is left behind";
    EXPECT_EQ(run_program({"cat"}).said, "");
}

TEST_F(ChildProgram, WorksInItsFolderAndSaysWhatItHasToSayInOrder) {
    const ProgramResult result = shell("pwd; echo err >&2; echo out; exit 3");
    EXPECT_EQ(result.code, 3);
    EXPECT_EQ(result.said, fs::canonical(folder_).string() + "\nerr\nout\n");
}

TEST_F(ChildProgram, MayBeNamedByItsPathFromItsFolderOn) {
    std::ofstream(folder_ / "own") << "#!/bin/sh\necho mine\n";
    fs::permissions(folder_ / "own", fs::perms::owner_all);
    EXPECT_EQ(run_program({.name = "./own", .folder = folder_}).said, "mine\n");
}

TEST_F(ChildProgram, IsFoundInUsrBinWhereThereIsNoPath) {
    const std::string path = std::getenv("PATH");
    unsetenv("PATH");
    const ProgramResult result = run_program({.name = "printf", .words = {"found"}});
    setenv("PATH", path.c_str(), 1);
    EXPECT_EQ(result.said, "found");
}

TEST_F(ChildProgram, HasOurVariablesAndThoseGivenOrThoseOnly) {
    setenv("REPRISE_OURS", "ours", 1);
    setenv("REPRISE_OTHER", "other", 1);
    Program program{.name = "/usr/bin/env", .variables = {"REPRISE_OURS=given"}};
    const std::string all = run_program(program).said;
    EXPECT_THAT(all, HasSubstr("REPRISE_OURS=given\n"));
    EXPECT_THAT(all, Not(HasSubstr("REPRISE_OURS=ours\n")));
    EXPECT_THAT(all, HasSubstr("REPRISE_OTHER=other\n"));
    program.only_these_variables = true;
    EXPECT_EQ(run_program(program).said, "REPRISE_OURS=given\n");
    unsetenv("REPRISE_OURS");
    unsetenv("REPRISE_OTHER");
}

TEST_F(ChildProgram, SaysNoMoreThanIsAskedFor) {
    const Program program{.name = "sh", .words = {"-c", "yes | head -c 300000"}, .most_said = 1000};
    EXPECT_EQ(run_program(program).said.size(), 1000U);
    EXPECT_EQ(shell("yes | head -c 300000").said.size(), std::size_t{256} << 10);
}

TEST_F(ChildProgram, WritesItsLogWhereItIsAskedTo) {
    std::ofstream(folder_ / "log") << "what was there before, and is longer";
    const ProgramResult result = run_program(
        {.name = "sh", .words = {"-c", "echo out; echo err >&2"}, .log = folder_ / "log"});
    EXPECT_EQ(result.said, "");
    EXPECT_EQ(read("log"), "out\nerr\n");
}

TEST_F(ChildProgram, CrashesAreTold) {
    const ProgramResult crashed = shell("echo last words; kill -SEGV $$");
    EXPECT_EQ(crashed.stopped, "crashed (signal 11, Segmentation fault)");
    EXPECT_EQ(crashed.signal, SIGSEGV);
    EXPECT_EQ(crashed.said, "last words\n");
    EXPECT_EQ(shell("true").stopped, "");
}

TEST_F(ChildProgram, IsStoppedWhenItNeedsTooMuchProcessorTime) {
    EXPECT_EQ(shell("while :; do :; done", {.seconds = 1}).stopped,
              "was stopped: it needed more than 1 s of processor time");
}

TEST_F(ChildProgram, IsStoppedWhenItWritesTooMuch) {
    std::signal(SIGXFSZ, SIG_IGN);  // as our programs do; it must not inherit that
    const Limits limits{.file = 1 << 20};
    const char* stopped = "was stopped: it wrote more than 1 MB";
    EXPECT_EQ(shell("exec cat /dev/zero >large", limits).stopped, stopped);
    EXPECT_EQ(fs::file_size(folder_ / "large"), 1U << 20);
    EXPECT_EQ(shell("exec cat /dev/zero", limits).stopped, stopped) << "its outputs as well";
    std::signal(SIGXFSZ, SIG_DFL);
}

TEST_F(ChildProgram, GetsNoMoreMemoryThanItMay) {
    const Program program{.name = "tail", .words = {"/dev/zero"}, .limits = {.memory = 64 << 20}};
    const ProgramResult result = run_program(program);
    EXPECT_EQ(result.code, 1);
    EXPECT_THAT(result.said, HasSubstr("memory"));
}

TEST_F(ChildProgram, LeavesNoCoreBehind) {
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_CORE, &before), 0);
    const rlimit allowed{before.rlim_max, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_CORE, &allowed), 0);
    EXPECT_EQ(shell("ulimit -c").said, "0\n");
    setrlimit(RLIMIT_CORE, &before);
}

TEST_F(ChildProgram, ThatIsNotThereIsNamedWithItsPackage) {
    const Program nobody{.name = "convert_of_nobody", .package = "sumo"};
    EXPECT_THAT([&] { run_program(nobody); },
                ThrowsMessage<world::Error>("convert_of_nobody: there is no such program here; it "
                                            "is in Debian's package sumo"));
    EXPECT_THAT([] { run_program({"/nowhere/convert"}); },
                ThrowsMessage<world::Error>("/nowhere/convert: there is no such program here"));
}

TEST_F(ChildProgram, ThatCannotBeStartedIsNamedWithTheReason) {
    std::ofstream(folder_ / "text") << "no program\n";
    EXPECT_THAT([&] { run_program({(folder_ / "text").string()}); },
                ThrowsMessage<world::Error>(HasSubstr("text: cannot be started: Permission")));
    EXPECT_THAT([&] { run_program({.name = "true", .folder = folder_ / "no"}); },
                ThrowsMessage<world::Error>(HasSubstr("no: cannot be opened for true: No such")));
    EXPECT_THAT([&] { run_program({.name = "true", .log = folder_ / "no/log"}); },
                ThrowsMessage<world::Error>(HasSubstr("no/log: cannot be opened for true: No ")));
}

TEST_F(ChildProgram, ResultsOfManyAreInTheOrderOfThePrograms) {
    // Each waits for the next one: they end in the opposite order.
    run_program({.name = "mkfifo", .words = {"b", "c"}, .folder = folder_});
    std::vector<Program> programs;
    for (const char* script :
         {"read line <b; exit 1", "read line <c; echo >b; exit 2", "echo >c; exit 3"})
        programs.push_back({"sh", {"-c", script}, folder_});
    std::size_t through = 0;
    const auto results =
        run_programs(Children(3), programs, [&](std::size_t count) { through = count; });
    ASSERT_EQ(results.size(), 3U);
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(results[static_cast<std::size_t>(i)].code, i + 1);
    EXPECT_EQ(through, 3U);
}

TEST_F(ChildProgram, OneThatIsMissingEndsTheOthers) {
    test::LifeLine others;
    EXPECT_THROW(run_programs(Children(2), {{"sleep", {"1000"}}, {"convert_of_nobody"}}),
                 world::Error);
    others.expect_all_gone();
}

}  // namespace
}  // namespace reprise::process
