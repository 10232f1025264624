#include "cli/process/child_processes.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "cli/process/guard.h"
#include "world/check.h"

namespace reprise::cli {

namespace {

std::size_t processors() {
    cpu_set_t mine;
    CPU_ZERO(&mine);
    return sched_getaffinity(0, sizeof(mine), &mine) == 0
               ? static_cast<std::size_t>(std::max(1, CPU_COUNT(&mine)))
               : 1;
}

void check_alone() {
    namespace fs = std::filesystem;
    const auto threads =
        std::distance(fs::directory_iterator("/proc/self/task"), fs::directory_iterator());
    REPRISE_CHECK(threads == 1, fmt::format("{} threads run, a copy would have one", threads));
}

[[noreturn]] void be_child(pid_t parent,
                           std::size_t item,
                           const std::function<int(std::size_t)>& work) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent)
        _exit(exit_our_fault);  // it went before we could ask to go with it
    const int code = work(item);
    std::fflush(nullptr);
    _exit(code);  // without libsumo's farewell: the simulation is the parent's, too
}

}  // namespace

std::vector<int> in_child_processes(std::size_t count,
                                    const std::function<int(std::size_t)>& work) {
    check_alone();
    std::fflush(nullptr);
    std::vector<int> codes(count, exit_our_fault);
    std::map<pid_t, std::size_t> children;
    const pid_t parent = getpid();
    for (std::size_t next = 0; next < count || !children.empty();) {
        if (next < count && children.size() < processors()) {
            const pid_t child = fork();
            if (child == 0)
                be_child(parent, next, work);
            if (child < 0)
                throw world::Error(fmt::format("cannot start a process: {}", std::strerror(errno)));
            children.emplace(child, next++);
            continue;
        }
        int status = 0;
        const pid_t ended = waitpid(-1, &status, 0);
        if (ended < 0 && errno == EINTR)
            continue;
        const auto child = children.find(ended);
        if (child == children.end())
            continue;
        if (WIFEXITED(status))
            codes[child->second] = WEXITSTATUS(status);
        children.erase(child);
    }
    return codes;
}

}  // namespace reprise::cli
