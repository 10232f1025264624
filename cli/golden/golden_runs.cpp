#include "cli/golden/golden_runs.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <map>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "cli/process/helper_program.h"
#include "world/check.h"

namespace reprise::cli {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;
constexpr int cannot_start = 127;  ///< as shells have it

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// What happens in the child between fork and exec.
[[noreturn]] void become(const char* program, char** words, const char* log, pid_t parent) {
    setpgid(0, 0);  // so that its own children can be ended with it
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent)
        _exit(cannot_start);
    const int in = open("/dev/null", O_RDONLY | O_CLOEXEC);
    const int out = open(log, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (in < 0 || out < 0)
        _exit(cannot_start);
    dup2(in, STDIN_FILENO);
    dup2(out, STDOUT_FILENO);
    dup2(out, STDERR_FILENO);
    // What a run that is killed leaves behind goes with the folder of ours that holds its log.
    const std::string temporary = fs::path(log).parent_path();
    setenv("TMPDIR", temporary.c_str(), 1);
    execv(program, words);
    dprintf(STDERR_FILENO, "cannot start %s: %s\n", program, std::strerror(errno));
    _exit(cannot_start);
}

}  // namespace

/// Blocked while this lives; sigtimedwait takes them out one by one, so that none can come between
/// a look and a wait.
struct GoldenRunner::Signals {
    sigset_t awaited{};
    sigset_t before{};

    Signals() {
        sigemptyset(&awaited);
        for (const int one : {SIGCHLD, SIGINT, SIGTERM, SIGHUP})
            sigaddset(&awaited, one);
        // A reader of ours that goes away must not end us with a temporary folder left behind.
        sigset_t blocked = awaited;
        sigaddset(&blocked, SIGPIPE);
        sigprocmask(SIG_BLOCK, &blocked, &before);
    }

    ~Signals() { sigprocmask(SIG_SETMASK, &before, nullptr); }

    Signals(const Signals&) = delete;
    Signals& operator=(const Signals&) = delete;

    /// The next signal, or -1 after a tenth of a second.
    int wait() const {
        const timespec tenth{0, 100'000'000};
        return sigtimedwait(&awaited, nullptr, &tenth);
    }
};

namespace {

/// The children of one call of run().
class Children {
  public:
    explicit Children(std::vector<GoldenRunResult>& results) : results_(results) {}

    /// Whatever happens, none is left.
    ~Children() {
        for (const auto& [pid, child] : alive_)
            kill(-pid, SIGKILL);
        for (const auto& [pid, child] : alive_)
            waitpid(pid, nullptr, 0);
    }

    Children(const Children&) = delete;
    Children& operator=(const Children&) = delete;

    std::size_t alive() const { return alive_.size(); }

    void start(const fs::path& program,
               const GoldenRun& run,
               std::size_t index,
               const sigset_t& signals) {
        std::vector<std::string> words{"reprise"};
        words.insert(words.end(), run.words.begin(), run.words.end());
        std::vector<char*> arguments;
        for (std::string& word : words)
            arguments.push_back(word.data());
        arguments.push_back(nullptr);
        const pid_t parent = getpid();
        const pid_t pid = fork();
        if (pid < 0)
            throw world::Error(std::string("cannot start a process: ") + std::strerror(errno));
        if (pid == 0) {
            sigprocmask(SIG_SETMASK, &signals, nullptr);
            become(program.c_str(), arguments.data(), run.log.c_str(), parent);
        }
        setpgid(pid, pid);  // here as well: whoever comes first
        alive_[pid] = {index, Clock::now()};
    }

    /// Takes in those that ended. Returns how many.
    std::size_t reap() {
        std::size_t count = 0;
        int status = 0;
        for (pid_t pid = 0; (pid = waitpid(-1, &status, WNOHANG)) > 0;) {
            const auto at = alive_.find(pid);
            if (at == alive_.end())
                continue;
            GoldenRunResult& result = results_[at->second.index];
            result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
            result.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
            result.seconds = seconds_since(at->second.begin);
            alive_.erase(at);
            ++count;
        }
        return count;
    }

  private:
    struct Child {
        std::size_t index = 0;
        Clock::time_point begin;
    };

    std::vector<GoldenRunResult>& results_;
    std::map<pid_t, Child> alive_;
};

}  // namespace

GoldenRunner::GoldenRunner(std::size_t jobs)
    : signals_(std::make_unique<Signals>()),
      program_(helper_program("reprise-run")),
      jobs_(std::max<std::size_t>(jobs, 1)) {}

GoldenRunner::~GoldenRunner() = default;

std::vector<GoldenRunResult> GoldenRunner::run(const std::vector<GoldenRun>& runs,
                                               const std::function<void(std::size_t)>& done) {
    std::vector<GoldenRunResult> results(runs.size());
    Children children(results);
    std::size_t next = 0;
    std::size_t finished = 0;
    while (finished < runs.size()) {
        while (next < runs.size() && children.alive() < jobs_) {
            children.start(program_, runs[next], next, signals_->before);
            ++next;
        }
        const int signal = signals_->wait();
        if (signal == SIGINT || signal == SIGTERM || signal == SIGHUP)
            throw Interrupted(signal);
        finished += children.reap();
        if (done)
            done(finished);
    }
    return results;
}

std::size_t default_jobs() {
    return std::max(1u, std::thread::hardware_concurrency());
}

}  // namespace reprise::cli
