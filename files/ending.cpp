// What happens to files when a signal ends us.
//   must      leave nothing unfinished behind, at whatever moment the signal comes
//   assumes   nothing of whom it interrupts: only calls that POSIX allows in a handler
//   goes      files are noted down in a fixed table as they are made; the handler unlinks them,
//             then the signal does what it does without us; it waits for threads that are between
//             making a file and noting it down, and none makes another one
//   keeps     the table and the signal that came, for the whole process
#include "files/ending.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <poll.h>
#include <unistd.h>

#include "world/check.h"

namespace reprise::files {

namespace {

constexpr std::array endings{SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGXCPU};

struct Slot {
    std::atomic<bool> taken = false;
    std::atomic<pid_t> owner = 0;  ///< 0: not to be removed
    std::array<char, PATH_MAX> path{};
};

std::array<Slot, 1024> slots;  // some for each thread

std::atomic<bool> is_ending = false;
std::atomic<int> makers = 0;  ///< threads that hold endings back
thread_local int held_by_us = 0;
std::atomic<bool> only_remember = false;
std::atomic<int> came = 0;
void (*say_last)(int) = nullptr;

extern "C" void on_ending(int signal) {
    const int error = errno;
    if (only_remember && came == 0) {
        came = signal;
        errno = error;
        return;
    }
    is_ending = true;
    // None of them is this thread. A child may have been forked beside one, and waits in vain.
    for (int waited = 0; makers > 0 && waited < 1000; ++waited)
        poll(nullptr, 0, 1);
    remove_unfinished();
    if (say_last != nullptr)
        say_last(signal);
    // Held until this handler returns; then it ends us as it would have done without us.
    std::signal(signal, SIG_DFL);
    raise(signal);
    errno = error;
}

sigset_t all_endings() {
    sigset_t set;
    sigemptyset(&set);
    for (const int one : endings)
        sigaddset(&set, one);
    return set;
}

}  // namespace

void remove_unfinished() noexcept {
    const pid_t us = getpid();
    for (const Slot& slot : slots)
        if (slot.owner == us)
            unlink(slot.path.data());
    // Folders last, and as long as another one became empty.
    for (bool removed = true; removed;) {
        removed = false;
        for (const Slot& slot : slots)
            removed = (slot.owner == us && rmdir(slot.path.data()) == 0) || removed;
    }
}

void tidy_up_when_ended(void (*last)(int)) {
    say_last = last;

    struct sigaction action {};

    action.sa_handler = on_ending;
    action.sa_mask = all_endings();
    action.sa_flags = SA_RESTART;
    for (const int one : endings) {
        struct sigaction before {};

        sigaction(one, nullptr, &before);
        if (before.sa_handler != SIG_IGN)
            sigaction(one, &action, nullptr);
    }
}

EndingHeld::EndingHeld() {
    const sigset_t held = all_endings();
    pthread_sigmask(SIG_BLOCK, &held, &before_);
    if (held_by_us++ > 0)
        return;
    ++makers;
    if (!is_ending)
        return;
    --makers;
    for (;;)  // another thread ends us
        pause();
}

EndingHeld::~EndingHeld() {
    if (--held_by_us == 0)
        --makers;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

RemovedWhenEnded::RemovedWhenEnded(const std::filesystem::path& path) : slot_(0) {
    // Whole, as the folder that we are in may become another.
    const std::string text = std::filesystem::absolute(path).string();
    if (text.size() >= PATH_MAX)
        throw world::Error(text + ": this path is too long");
    while (slot_ < slots.size() && slots[slot_].taken.exchange(true))
        ++slot_;
    REPRISE_CHECK(slot_ < slots.size(), "more unfinished files than can be noted down");
    Slot& slot = slots[slot_];
    std::memcpy(slot.path.data(), text.c_str(), text.size() + 1);
    slot.owner = getpid();
}

RemovedWhenEnded::~RemovedWhenEnded() {
    slots[slot_].owner = 0;
    slots[slot_].taken = false;
}

StopRequest::StopRequest() {
    came = 0;
    only_remember = true;
}

StopRequest::~StopRequest() {
    only_remember = false;
}

int StopRequest::signal() const {
    return came;
}

}  // namespace reprise::files
