#include "process/children.h"

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sys/wait.h>

#include <gmock/gmock.h>

#include "process/program.h"
#include "tests/process/scratch.h"

namespace reprise::process {
namespace {

using ::testing::Each;
using ::testing::Le;

/// Interrupts us as Ctrl-C would, and would go on; so would its own child.
Program interrupting(const std::string& signal) {
    return {"sh", {"-c", "sleep 1000 & kill -" + signal + " $PPID; wait"}};
}

class ChildProcesses : public test::Scratch {};

TEST_F(ChildProcesses, AreGoneWithTheirOwnChildrenWhenWeAreToldToEnd) {
    for (const auto& [name, signal] :
         {std::pair{"INT", SIGINT}, {"TERM", SIGTERM}, {"HUP", SIGHUP}}) {
        test::LifeLine life;
        try {
            run_programs(Children(3),
                         {{"sleep", {"1000"}}, interrupting(name), {"sleep", {"1000"}}});
            FAIL() << "not stopped";
        } catch (const Stopped& stopped) {
            EXPECT_EQ(stopped.signal, signal);
            EXPECT_EQ(stopped.what(), std::string("stopped (") + strsignal(signal) + ")");
        }
        EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "there is a child left";
        life.expect_all_gone();
    }
    // From then on signals do what they did before.
    sigset_t blocked;
    sigprocmask(SIG_BLOCK, nullptr, &blocked);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD, SIGPIPE})
        EXPECT_EQ(sigismember(&blocked, signal), 0);
}

TEST_F(ChildProcesses, GoOnUnderASignalThatWeIgnore) {
    std::signal(SIGHUP, SIG_IGN);
    const ProgramResult result =
        run_program({"sh", {"-c", "kill -HUP $PPID; kill -HUP $$; exit 5"}});
    std::signal(SIGHUP, SIG_DFL);
    EXPECT_EQ(result.code, 5);
}

TEST_F(ChildProcesses, SignalsBetweenTwoRunsEndTheSecond) {
    const Children children(1);
    run_programs(children, std::vector<Program>{{"true"}});
    raise(SIGINT);
    EXPECT_THROW(run_programs(children, std::vector<Program>{{"sleep", {"1000"}}}), Stopped);
}

TEST_F(ChildProcesses, LeaveNothingRunningWhenTheyEnd) {
    test::LifeLine life;
    EXPECT_EQ(run_program({"sh", {"-c", "sleep 1000 & exit 0"}}).code, 0);
    life.expect_all_gone();
}

TEST_F(ChildProcesses, EndWithUsWhateverEndsUs) {
    test::LifeLine life;
    const pid_t us = fork();  // by hand: nobody ends what this one leaves
    if (us == 0) {
        run_program({"sh", {"-c", "kill -KILL $PPID; exec sleep 1000"}});
        _exit(0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(us, &status, 0), us);
    EXPECT_TRUE(WIFSIGNALED(status));
    life.expect_all_gone();
}

TEST_F(ChildProcesses, RunNoMoreThanSomeAtATime) {
    std::vector<Program> programs(
        12,
        {"sh", {"-c", "echo $$ >running.$$; set -- running.*; echo $#; rm running.$$"}, folder_});
    std::vector<int> seen;
    for (const ProgramResult& result : run_programs(Children(2), programs))
        seen.push_back(std::stoi(result.said));
    EXPECT_THAT(seen, Each(Le(2)));
    seen.clear();
    for (const ProgramResult& result : run_programs(Children(1), programs))
        seen.push_back(std::stoi(result.said));
    EXPECT_THAT(seen, Each(1));
}

TEST_F(ChildProcesses, KeepTheirExitCodesWhereSigchldIsIgnored) {
    std::signal(SIGCHLD, SIG_IGN);
    const ProgramResult result = run_program({"sh", {"-c", "exit 5"}});
    EXPECT_EQ(std::signal(SIGCHLD, SIG_DFL), SIG_IGN) << "it is ignored again afterwards";
    EXPECT_EQ(result.code, 5);
}

TEST_F(ChildProcesses, LeaveOtherChildrenToWhoStartedThem) {
    const pid_t other = fork();
    if (other == 0)
        _exit(7);
    siginfo_t info{};
    ASSERT_EQ(waitid(P_PID, static_cast<id_t>(other), &info, WEXITED | WNOWAIT), 0);
    EXPECT_EQ(run_program({"true"}).code, 0);
    int status = 0;
    EXPECT_EQ(waitpid(other, &status, 0), other);
    EXPECT_EQ(WEXITSTATUS(status), 7);
}

}  // namespace
}  // namespace reprise::process
