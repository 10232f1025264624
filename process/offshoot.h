#pragma once

#include <functional>
#include <optional>
#include <sys/types.h>

#include "process/children.h"

namespace reprise::process {

/// A copy of this process that goes on by itself until it is done, and ends with us however we end.
/// Signals that we hold (HeldSignals) it holds as well. Only one thread may run when it is made.
class Offshoot {
  public:
    /// `work` happens in the copy, which ends with the exit code that is returned; it may throw
    /// nothing. `leads`: it and what it starts in turn are a process group of their own; else it
    /// stays in ours. Throws world::Error when no process can be started.
    Offshoot(const std::function<int()>& work, bool leads);

    /// Ends it at once, with its group.
    ~Offshoot();
    Offshoot(Offshoot&& other) noexcept;
    Offshoot(const Offshoot&) = delete;
    Offshoot& operator=(const Offshoot&) = delete;
    Offshoot& operator=(Offshoot&&) = delete;

    /// Asks it and its group to end (SIGTERM).
    void ask_to_end() const;

    /// Waits so long [s] for its end, without a number for ever; nothing when it still runs.
    std::optional<Ended> wait(std::optional<double> seconds);

  private:
    void signal(int number) const;

    pid_t pid_ = -1;
    bool leads_ = false;
    std::optional<Ended> ended_;
};

}  // namespace reprise::process
