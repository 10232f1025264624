#include "process/offshoot.h"

#include <csignal>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/process/held_pipe.h"

namespace reprise::process {
namespace {

TEST(Offshoot, TellsItsExitCodeOrSignal) {
    Offshoot returns([] { return 7; }, false);
    EXPECT_EQ(returns.wait(std::nullopt)->code, 7);
    Offshoot crashes([] { return raise(SIGKILL); }, false);
    EXPECT_EQ(crashes.wait(std::nullopt)->signal, SIGKILL);
}

TEST(Offshoot, IsAskedToEndWithItsGroup) {
    HeldPipe held;
    Offshoot leader(
        [&] {
            Offshoot member(
                [&] {
                    held.say();
                    pause();
                    return 0;
                },
                false);
            member.wait(std::nullopt);
            return 0;
        },
        true);
    ASSERT_TRUE(held.hear());
    held.let_go();
    EXPECT_FALSE(leader.wait(0));
    leader.ask_to_end();
    EXPECT_EQ(leader.wait(std::nullopt)->signal, SIGTERM);
    EXPECT_FALSE(held.hear());
}

TEST(Offshoot, AndItsOwnEndWhenItsOwnerIsKilled) {
    HeldPipe held;
    const pid_t owner = fork();
    if (owner == 0) {
        Offshoot child(
            [&] {
                Offshoot grandchild(
                    [&] {
                        held.say();
                        pause();
                        return 0;
                    },
                    true);
                grandchild.wait(std::nullopt);
                return 0;
            },
            true);
        child.wait(std::nullopt);
        _exit(0);
    }
    ASSERT_TRUE(held.hear());
    held.let_go();
    kill(owner, SIGKILL);
    waitpid(owner, nullptr, 0);
    EXPECT_FALSE(held.hear());  // all that held the other end are gone
}

TEST(Offshoot, IsEndedWithItsOwnersObject) {
    HeldPipe held;
    {
        const Offshoot child(
            [&] {
                held.say();
                pause();
                return 0;
            },
            true);
        ASSERT_TRUE(held.hear());
    }
    held.let_go();
    EXPECT_FALSE(held.hear());
}

}  // namespace
}  // namespace reprise::process
