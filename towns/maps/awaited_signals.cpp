#include "towns/maps/awaited_signals.h"

#include <cstring>
#include <sys/wait.h>

#include <fmt/format.h>

#include "world/check.h"

namespace reprise::towns {

AwaitedSignals::AwaitedSignals() {
    sigemptyset(&awaited_);
    sigaddset(&awaited_, SIGCHLD);
    // What is ignored, as under nohup, stays so.
    for (const int one : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction now {};

        sigaction(one, nullptr, &now);
        if (now.sa_handler != SIG_IGN)
            sigaddset(&awaited_, one);
    }
    sigprocmask(SIG_BLOCK, &awaited_, &before_);
}

AwaitedSignals::~AwaitedSignals() {
    sigprocmask(SIG_SETMASK, &before_, nullptr);
}

int AwaitedSignals::wait_for(pid_t child, pid_t target) const {
    int status = 0;
    // A tenth of a second: somebody else's SIGCHLD may have hidden ours.
    const timespec tenth{0, 100'000'000};
    while (waitpid(child, &status, WNOHANG) != child) {
        const int came = sigtimedwait(&awaited_, nullptr, &tenth);
        if (came == -1 || came == SIGCHLD)
            continue;
        kill(target, SIGKILL);
        waitpid(child, &status, 0);
        throw world::Error(fmt::format("stopped ({})", strsignal(came)));
    }
    return status;
}

}  // namespace reprise::towns
