#pragma once

#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

#include "process/children.h"

namespace reprise::process {

/// A program of the user's that runs beside us, with an open socket of ours as its own, and ends
/// with us however we end. Both its outputs are ours. It gets no input.
class Companion {
  public:
    /// `command` goes through the shell, as the user wrote it. The program finds `descriptor` under
    /// its number, which the variable (NAME=value with "%d" where the number is to stand) tells.
    /// Throws world::Error when no process can be started.
    Companion(const std::string& command, int descriptor, const std::string& variable);

    /// Gives it a moment to end by itself, then ends it and all that it started.
    ~Companion();
    Companion(const Companion&) = delete;
    Companion& operator=(const Companion&) = delete;

    /// Waits so long [s] for its end; nothing when it still runs.
    std::optional<Ended> wait(double seconds);

  private:
    pid_t pid_ = -1;
    pid_t guardian_ = -1;
    int we_live_ = -1;  ///< our end of a pipe: the guardian sees it close
    std::optional<Ended> ended_;
};

}  // namespace reprise::process
