#include "process/offshoot.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <string>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>

#include "world/check.h"

namespace reprise::process {

namespace {

constexpr int parent_is_gone = 70;
constexpr auto short_while = std::chrono::milliseconds(1);

Ended ended_with(int status) {
    return WIFSIGNALED(status) ? Ended{0, WTERMSIG(status), 0} : Ended{WEXITSTATUS(status), 0, 0};
}

}  // namespace

Offshoot::Offshoot(const std::function<int()>& work, bool leads) : leads_(leads) {
    const pid_t parent = getpid();
    pid_ = fork();
    if (pid_ == 0) {
        if (leads)
            setpgid(0, 0);
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (getppid() != parent)
            _exit(parent_is_gone);  // it went before we could ask to go with it
        _exit(work());
    }
    if (pid_ < 0)
        throw world::Error(std::string("cannot start a process: ") + std::strerror(errno));
    if (leads)
        setpgid(pid_, pid_);  // here as well: whoever comes first
}

Offshoot::Offshoot(Offshoot&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      leads_(other.leads_),
      ended_(other.ended_) {}

Offshoot::~Offshoot() {
    if (pid_ < 0 || ended_)
        return;
    signal(SIGKILL);
    wait(std::nullopt);
}

void Offshoot::signal(int number) const {
    if (pid_ > 0 && !ended_)
        kill(leads_ ? -pid_ : pid_, number);
}

void Offshoot::ask_to_end() const {
    signal(SIGTERM);
}

std::optional<Ended> Offshoot::wait(std::optional<double> seconds) {
    using Clock = std::chrono::steady_clock;
    const auto until = Clock::now() + std::chrono::duration<double>(seconds.value_or(0));
    while (!ended_) {
        int status = 0;
        const pid_t found = waitpid(pid_, &status, seconds ? WNOHANG : 0);
        if (found == pid_)
            ended_ = ended_with(status);
        else if (found < 0 && errno != EINTR)
            world::check_failed(
                "waitpid", __FILE__, __LINE__, "somebody else waited for our child");
        else if (seconds && Clock::now() >= until)
            break;
        else if (seconds)
            std::this_thread::sleep_for(short_while);
    }
    return ended_;
}

}  // namespace reprise::process
