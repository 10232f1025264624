#include "towns/maps/child_program.h"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "towns/maps/netconvert.h"
#include "world/check.h"

namespace reprise::towns {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class ChildProgram : public ::testing::Test {
  protected:
    ChildProgram()
        : folder_(fs::path(::testing::TempDir()) / ("reprise child, " + std::to_string(getpid()))) {
        fs::create_directories(folder_);
    }

    ~ChildProgram() override { fs::remove_all(folder_); }

    ProgramResult shell(const std::string& script, const ProgramLimits& limits = {}) const {
        return run_program("sh", {"-c", script}, folder_, limits);
    }

    fs::path folder_;
};

TEST_F(ChildProgram, GetsItsWordsAsTheyAre) {
    const ProgramResult result =
        run_program("printf", {"%s|", "a b", "$HOME", "`x`", "'", "*"}, folder_);
    EXPECT_EQ(result.code, 0);
    EXPECT_EQ(result.said, "a b|$HOME|`x`|'|*|");
    EXPECT_TRUE(fs::is_empty(folder_)) << "nothing is left behind";
}

TEST_F(ChildProgram, IsEndedWhenWeAreStopped) {
    try {
        // It stops us, and would go on.
        shell("kill -TERM $PPID; exec sleep 30");
        FAIL() << "not stopped";
    } catch (const world::Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("stopped (Terminated)"));
    }
    // From then on signals do what they did before.
    sigset_t blocked;
    sigprocmask(SIG_BLOCK, nullptr, &blocked);
    EXPECT_EQ(sigismember(&blocked, SIGTERM), 0);
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "there is a child left";
}

TEST_F(ChildProgram, WorksInTheFolderWithAnEnvironmentOfItsOwn) {
    setenv("LC_ALL", "de_DE.UTF-8", 1);
    const ProgramResult result = shell("pwd; echo $LC_ALL $SUMO_HOME; echo err >&2; exit 3");
    unsetenv("LC_ALL");
    EXPECT_EQ(result.code, 3);
    EXPECT_THAT(result.said, StartsWith(fs::canonical(folder_).string()));
    EXPECT_THAT(result.said, HasSubstr("C " + sumo_folder().string() + "\nerr\n"));
}

TEST_F(ChildProgram, CrashesAreTold) {
    EXPECT_THAT(shell("kill -SEGV $$").stopped, HasSubstr("crashed (signal 11"));
    EXPECT_EQ(shell("true").stopped, "");
}

TEST_F(ChildProgram, IsStoppedWhenItNeedsTooMuch) {
    ProgramLimits limits;
    limits.seconds = 1;
    EXPECT_THAT(shell("while :; do :; done", limits).stopped, HasSubstr("more than 1 s"));
    limits = {};
    limits.file = 1 << 20;
    EXPECT_THAT(run_program("cat", {"/dev/zero"}, folder_, limits).stopped,
                HasSubstr("more than 1 MB"));
    limits = {};
    limits.memory = 64 << 20;
    const ProgramResult result = run_program("tail", {"/dev/zero"}, folder_, limits);
    EXPECT_EQ(result.code, 1);
    EXPECT_THAT(result.said, HasSubstr("memory"));
}

TEST_F(ChildProgram, WhatIsNotThereIsNamedWithItsPackage) {
    try {
        run_program("netconvert_of_nobody", {}, folder_);
        FAIL();
    } catch (const world::Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("netconvert_of_nobody: there is no such program"));
        EXPECT_THAT(error.what(), HasSubstr("package sumo"));
    }
}

TEST(Reason, IsTheErrorsInOneLine) {
    EXPECT_EQ(reason_in("Warning: x\nError: unexpected end of input\n In file 'a.osm'\n At "
                        "line/column 2/10.\n\nQuitting (on error).\n"),
              "unexpected end of input (line/column 2/10)");
    EXPECT_EQ(reason_in("Error: a\nError: a\nError: b\nError: c\nError: d\n"),
              "a; b; c; and 1 more");
    EXPECT_EQ(reason_in("Error: No nodes loaded.\n"), "No nodes loaded: it has no roads");
    EXPECT_EQ(reason_in("terminate called\nwhat(): \x1b[2J\n"), "what(): ?[2J");
    EXPECT_EQ(reason_in("\n"), "it did not say why");
}

}  // namespace
}  // namespace reprise::towns
