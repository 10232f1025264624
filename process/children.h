#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "process/held_signals.h"
#include "process/processors.h"

namespace reprise::process {

/// How a child ended.
struct Ended {
    int code = 0;        ///< exit code; 0 when a signal ended it
    int signal = 0;      ///< that ended it; 0: none did
    double seconds = 0;  ///< of wall time
};

/// What there is to do for each child, by its index.
struct Tasks {
    std::size_t count = 0;
    std::function<void(std::size_t)> prepare;  ///< in us, just before it is started
    /// In the child, which ends with the exit code that is returned. May throw nothing. In a
    /// process of several threads, only calls that are safe between fork and exec.
    std::function<int(std::size_t)> in_child;
    std::function<void(std::size_t, const Ended&)> collect;  ///< in us, when it has ended
};

/// Starts children and waits for them; what they are is program.h's and copy.h's. Each leads a
/// process group: when it has ended, so has what it left running there. When one of ours throws, or
/// we are told to end (SIGINT, SIGTERM, SIGHUP; throws Stopped), all are ended with their groups
/// first. Whatever else ends us, they go with the thread that runs them. While it lives, those
/// signals are held, between its runs as well, so that the caller can tidy up.
class Children {
  public:
    explicit Children(std::size_t at_once = processors());

    /// `waiting` hears how many are through, about ten times a second.
    void run(const Tasks& tasks,
             const std::function<void(std::size_t through)>& waiting = {}) const;

  private:
    std::size_t at_once_;
    HeldSignals signals_;
};

}  // namespace reprise::process
