// Child processes.
//   must      leave no child and no grandchild behind, however we or they end; mix up no exit codes
//   assumes   that nobody else in this process waits for any child (waitpid(-1)) meanwhile
//   goes      fork, a process group each; wait for a signal; see which of ours ended
//   keeps     nothing beyond a run
#include "process/children.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <map>
#include <string>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "world/check.h"

namespace reprise::process {

namespace {

using Clock = std::chrono::steady_clock;
constexpr int not_wanted = 70;  ///< nobody waits for this exit code

/// In a child of ours: its own children stay in its group, so that they are ended with it.
bool in_group_of_parent = false;

[[noreturn]] void be_child(pid_t parent,
                           const HeldSignals& signals,
                           std::size_t index,
                           const std::function<int(std::size_t)>& in_child) noexcept {
    if (!in_group_of_parent)
        setpgid(0, 0);
    in_group_of_parent = true;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent)
        _exit(not_wanted);  // it went before we could ask to go with it
    signals.release();
    _exit(in_child(index));
}

/// Those that run now.
class Alive {
  public:
    Alive() = default;

    /// Whatever happens, none is left. They are asked first, so that they can tidy up.
    ~Alive() {
        signal_all(SIGTERM);
        for (int tenths = 0; tenths < patience && any_runs(); ++tenths)
            usleep(100'000);
        signal_all(SIGKILL);
        for (const auto& [pid, child] : children_)
            waitpid(pid, nullptr, 0);
    }

    Alive(const Alive&) = delete;
    Alive& operator=(const Alive&) = delete;

    std::size_t count() const { return children_.size(); }

    void start(std::size_t index, const HeldSignals& signals, const Tasks& tasks) {
        const pid_t parent = getpid();
        const pid_t pid = fork();
        if (pid == 0)
            be_child(parent, signals, index, tasks.in_child);
        if (pid < 0)
            throw world::Error(std::string("cannot start a process: ") + std::strerror(errno));
        if (!in_group_of_parent)
            setpgid(pid, pid);  // here as well: whoever comes first
        children_[pid] = {index, Clock::now()};
    }

    /// Takes in those that ended. Returns how many.
    std::size_t collect(const Tasks& tasks) {
        std::size_t count = 0;
        for (auto at = children_.begin(); at != children_.end();) {
            const auto [pid, child] = *at;
            if (still_runs(pid)) {
                ++at;
                continue;
            }
            if (!in_group_of_parent)
                kill(-pid, SIGKILL);  // what it left; before waitpid() gives its number away
            int status = 0;
            waitpid(pid, &status, 0);
            at = children_.erase(at);
            ++count;
            const std::chrono::duration<double> time = Clock::now() - child.begin;
            tasks.collect(child.index,
                          {WIFEXITED(status) ? WEXITSTATUS(status) : 0,
                           WIFSIGNALED(status) ? WTERMSIG(status) : 0,
                           time.count()});
        }
        return count;
    }

  private:
    static constexpr int patience = 20;  ///< [0.1 s]

    void signal_all(int signal) const {
        for (const auto& [pid, child] : children_)
            kill(in_group_of_parent ? pid : -pid, signal);
    }

    bool any_runs() const {
        return std::any_of(children_.begin(), children_.end(), [](const auto& child) {
            return still_runs(child.first);
        });
    }

    struct Child {
        std::size_t index = 0;
        Clock::time_point begin;
    };

    static bool still_runs(pid_t pid) {
        siginfo_t info{};
        const int looked =
            waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOHANG | WNOWAIT);
        REPRISE_CHECK(looked == 0, "somebody else waited for our child");
        return info.si_pid == 0;
    }

    std::map<pid_t, Child> children_;
};

}  // namespace

Children::Children(std::size_t at_once) : at_once_(std::max<std::size_t>(at_once, 1)) {}

void Children::run(const Tasks& tasks, const std::function<void(std::size_t)>& waiting) const {
    Alive alive;
    for (std::size_t next = 0, through = 0; through < tasks.count;) {
        while (next < tasks.count && alive.count() < at_once_) {
            tasks.prepare(next);
            alive.start(next++, signals_, tasks);
        }
        signals_.wait();
        through += alive.collect(tasks);
        if (waiting)
            waiting(through);
    }
}

}  // namespace reprise::process
