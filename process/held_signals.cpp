#include "process/held_signals.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <sys/signalfd.h>
#include <unistd.h>

namespace reprise::process {

Stopped::Stopped(int number)
    : std::runtime_error(std::string("stopped (") + strsignal(number) + ")"),
      signal(number) {}

HeldSignals::HeldSignals() {
    sigemptyset(&awaited_);
    sigaddset(&awaited_, SIGCHLD);
    for (const int one : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction now {};

        sigaction(one, nullptr, &now);
        if (now.sa_handler != SIG_IGN)
            sigaddset(&awaited_, one);
    }
    sigset_t held = awaited_;
    sigaddset(&held, SIGPIPE);
    sigprocmask(SIG_BLOCK, &held, &before_);

    // Where whoever started us ignores SIGCHLD, children would vanish without an exit code.
    struct sigaction usual {};

    usual.sa_handler = SIG_DFL;
    sigaction(SIGCHLD, &usual, &child_before_);
}

HeldSignals::~HeldSignals() {
    if (descriptor_ >= 0)
        close(descriptor_);
    release();
}

void HeldSignals::wait() const {
    // A tenth of a second: somebody else's SIGCHLD may have hidden ours.
    const timespec tenth{0, 100'000'000};
    const int came = sigtimedwait(&awaited_, nullptr, &tenth);
    if (came != -1 && came != SIGCHLD)
        throw Stopped(came);
}

int HeldSignals::descriptor() const {
    if (descriptor_ < 0)
        descriptor_ = signalfd(-1, &awaited_, SFD_CLOEXEC);
    return descriptor_;
}

int HeldSignals::take() const {
    const timespec at_once{};
    return std::max(0, sigtimedwait(&awaited_, nullptr, &at_once));
}

void HeldSignals::release() const {
    sigaction(SIGCHLD, &child_before_, nullptr);
    sigprocmask(SIG_SETMASK, &before_, nullptr);
}

}  // namespace reprise::process
