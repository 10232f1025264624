#pragma once

#include <csignal>
#include <sys/types.h>

namespace reprise::towns {

/// While a child runs, what would end us (SIGINT, SIGTERM, SIGHUP) comes here first, so that
/// neither the child nor what was begun is left behind. One thread at a time.
class AwaitedSignals {
  public:
    AwaitedSignals();
    ~AwaitedSignals();
    AwaitedSignals(const AwaitedSignals&) = delete;
    AwaitedSignals& operator=(const AwaitedSignals&) = delete;

    /// What a child should have blocked: what was blocked before.
    const sigset_t& before() const { return before_; }

    /// The child's wait status. When we are to end, `target` gets SIGKILL (as kill(2) takes it: a
    /// child, or less than 0 for its process group), and world::Error "stopped (Interrupt)" is
    /// thrown when the child has ended.
    int wait_for(pid_t child, pid_t target) const;

  private:
    sigset_t awaited_{};
    sigset_t before_{};
};

}  // namespace reprise::towns
