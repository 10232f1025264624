#include "process/companion.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "process/program.h"
#include "world/check.h"

namespace reprise::process {

namespace {

constexpr double moment = 2;          // [s] for a driver that has been told goodbye
constexpr int no_such_program = 127;  // as shells have it
constexpr auto glance = std::chrono::milliseconds(2);

std::string filled_in(std::string variable, int descriptor) {
    const auto place = variable.find("%d");
    REPRISE_CHECK(place != std::string::npos, "no %d in " + variable);
    return variable.replace(place, 2, std::to_string(descriptor));
}

/// In the child: only calls that are safe between fork and exec.
[[noreturn]] void be_program(pid_t parent,
                             int descriptor,
                             const std::array<char*, 4>& words,
                             const std::vector<char*>& environment) noexcept {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent)
        _exit(no_such_program);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    const int in = open("/dev/null", O_RDONLY | O_CLOEXEC);
    dup2(in, STDIN_FILENO);
    fcntl(descriptor, F_SETFD, 0);
    execve(words[0], words.data(), environment.data());
    _exit(no_such_program);
}

/// Ends the program's group when we are gone, however we went: then nobody holds the other end of
/// the pipe any more. PR_SET_PDEATHSIG reaches the shell only, and not what it started. A shell,
/// because a copy of us would hold our memory and our sockets.
[[noreturn]] void be_guardian(pid_t group, int pipe_end) noexcept {
    static constexpr const char* word = "read nothing; kill -s KILL 0";
    if (setpgid(0, group) != 0)
        _exit(no_such_program);  // in the group of our owner it would end that
    sigset_t all;
    sigfillset(&all);
    sigprocmask(SIG_SETMASK, &all, nullptr);  // what the group is sent is not meant for it
    dup2(pipe_end, STDIN_FILENO);
    close_range(STDERR_FILENO + 1, ~0U, 0);
    execl("/bin/sh", "sh", "-c", word, nullptr);
    _exit(no_such_program);
}

/// A shell says of a program that a signal ended: 128 + signal.
Ended how(int status) {
    constexpr int by_signal = 128;
    if (WIFSIGNALED(status))
        return {0, WTERMSIG(status), 0};
    const int code = WEXITSTATUS(status);
    return code > by_signal && code < by_signal + NSIG ? Ended{0, code - by_signal, 0}
                                                       : Ended{code, 0, 0};
}

/// The shell would hold the program's socket as well, and nobody would see that the program closes
/// it. So the program takes the shell's place, where the line is one program's and nothing more:
/// what is built into a shell is none.
std::string line_of(const std::string& command) {
    const bool is_one_line = command.find_first_of(";&|(){}`\n") == std::string::npos;
    const bool is_one_program =
        is_one_line && path_of_program(command.substr(0, command.find_first_of(" \t"))).has_value();
    return is_one_program ? "exec " + command : command;
}

}  // namespace

Companion::Companion(const std::string& command, int descriptor, const std::string& variable) {
    std::string shell = "/bin/sh";
    std::string option = "-c";
    std::string line = line_of(command);
    std::string told = filled_in(variable, descriptor);
    const std::array<char*, 4> words{shell.data(), option.data(), line.data(), nullptr};
    std::vector<char*> environment{told.data()};
    for (char** ours = environ; *ours != nullptr; ++ours)
        environment.push_back(*ours);
    environment.push_back(nullptr);
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        throw world::Error(command + ": cannot be started: " + std::strerror(errno));
    we_live_ = ends[1];
    const pid_t parent = getpid();
    pid_ = fork();
    if (pid_ == 0)
        be_program(parent, descriptor, words, environment);
    if (pid_ > 0) {
        setpgid(pid_, pid_);  // here as well: whoever comes first
        guardian_ = fork();
        if (guardian_ == 0)
            be_guardian(pid_, ends[0]);
        // Here as well, before anybody waits for the program: when that has ended and is waited
        // for, its group is gone, and there is none to join.
        setpgid(guardian_, pid_);
    }
    const int reason = errno;
    close(ends[0]);
    if (pid_ < 0)
        throw world::Error(command + ": cannot be started: " + std::strerror(reason));
}

Companion::~Companion() {
    wait(moment);
    kill(-pid_, SIGKILL);  // what it left, or itself, and the guardian
    close(we_live_);
    wait(moment);
    if (guardian_ > 0)
        waitpid(guardian_, nullptr, 0);
}

std::optional<Ended> Companion::wait(double seconds) {
    using Clock = std::chrono::steady_clock;
    const auto until = Clock::now() + std::chrono::duration<double>(seconds);
    while (!ended_) {
        int status = 0;
        if (waitpid(pid_, &status, WNOHANG) == pid_)
            ended_ = how(status);
        else if (Clock::now() >= until)
            break;
        else
            std::this_thread::sleep_for(glance);
    }
    return ended_;
}

}  // namespace reprise::process
