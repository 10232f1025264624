#include "process/companion.h"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/process/held_pipe.h"

namespace reprise::process {
namespace {

/// A program below the shell that hears of nothing, and holds the pipe that it is given.
constexpr const char* deaf =
    "trap '' HUP TERM INT; sh -c 'printf x >/proc/self/fd/${END#fd:}; sleep 1000' & wait";

TEST(Companion, FindsItsDescriptorAndTellsHowItEnded) {
    HeldPipe held;
    Companion good("printf x >/proc/self/fd/${END#fd:}; exit 7", held.ends[1], "END=fd:%d");
    EXPECT_TRUE(held.hear());
    EXPECT_EQ(good.wait(10)->code, 7);
    Companion crashes("kill -s ABRT $$", held.ends[1], "END=fd:%d");
    EXPECT_EQ(crashes.wait(10)->signal, SIGABRT);
}

TEST(Companion, EndsWithAllThatItStarted) {
    HeldPipe held;
    {
        const Companion companion(deaf, held.ends[1], "END=fd:%d");
        held.let_go();
        EXPECT_TRUE(held.hear());
    }
    EXPECT_FALSE(held.hear()) << "nobody holds the pipe any more";
}

/// No shell between holds it for the program.
TEST(Companion, ThatClosesItsDescriptorIsSeenToDoSoWhileItRuns) {
    const auto script = std::filesystem::path(testing::TempDir()) / "closes.sh";
    std::ofstream(script) << "eval \"exec ${END#fd:}>&-\"; exec sleep 20";
    HeldPipe held;
    Companion companion("sh '" + script.string() + "'", held.ends[1], "END=fd:%d");
    held.let_go();
    EXPECT_FALSE(held.hear());
    EXPECT_FALSE(companion.wait(1)) << "it is its end that was seen";
}

TEST(Companion, AndItsOwnEndWhenItsOwnerIsKilled) {
    HeldPipe held;
    const pid_t owner = fork();
    if (owner == 0) {
        const Companion companion(deaf, held.ends[1], "END=fd:%d");
        pause();
        _exit(0);
    }
    held.let_go();
    EXPECT_TRUE(held.hear());
    kill(owner, SIGKILL);
    waitpid(owner, nullptr, 0);
    EXPECT_FALSE(held.hear()) << "nobody holds the pipe any more";
}

/// Where the guardian of one that has ended already stayed in our own group, it would end that.
TEST(Companion, WhoEndsAtOnceTakesNobodyAlong) {
    constexpr int programs = 300;
    constexpr int good = 7;
    const pid_t owner = fork();
    if (owner == 0) {
        setpgid(0, 0);  // what would be lost
        for (int i = 0; i < programs; ++i) {
            Companion companion("exit 0", STDERR_FILENO, "END=fd:%d");
            companion.wait(10);
        }
        _exit(good);
    }
    int status = 0;
    waitpid(owner, &status, 0);
    EXPECT_TRUE(WIFEXITED(status)) << "ended by signal " << WTERMSIG(status);
    EXPECT_EQ(WEXITSTATUS(status), good);
}

}  // namespace
}  // namespace reprise::process
