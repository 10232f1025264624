#include "process/offshoot.h"

#include <array>
#include <csignal>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace reprise::process {
namespace {

/// Its other end is closed when the last process that holds it has ended.
struct Pipe {
    Pipe() { EXPECT_EQ(pipe(ends.data()), 0); }

    ~Pipe() {
        for (const int end : ends)
            if (end >= 0)
                close(end);
    }

    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    /// Waits for a byte; false when nobody is left to write one.
    bool hear() const {
        char byte = 0;
        return read(ends[0], &byte, 1) == 1;
    }

    void say() const { EXPECT_EQ(write(ends[1], "x", 1), 1); }

    void let_go() {
        close(ends[1]);
        ends[1] = -1;
    }

    std::array<int, 2> ends{-1, -1};
};

TEST(Offshoot, TellsItsExitCodeOrSignal) {
    Offshoot returns([] { return 7; }, false);
    EXPECT_EQ(returns.wait(std::nullopt)->code, 7);
    Offshoot crashes([] { return raise(SIGKILL); }, false);
    EXPECT_EQ(crashes.wait(std::nullopt)->signal, SIGKILL);
}

TEST(Offshoot, IsAskedToEndWithItsGroup) {
    Pipe held;
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
    Pipe held;
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
    Pipe held;
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
