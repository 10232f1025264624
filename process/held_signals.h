#pragma once

#include <csignal>
#include <stdexcept>

namespace reprise::process {

/// SIGINT, SIGTERM or SIGHUP came while children ran; they are ended.
class Stopped : public std::runtime_error {
  public:
    explicit Stopped(int number);

    int signal;
};

/// While it lives, what would end us (SIGINT, SIGTERM, SIGHUP) waits to be taken out by wait(), so
/// that none can come between a look and a wait. What is ignored, as under nohup, stays so. SIGPIPE
/// is held as well: a reader of ours that goes away shall not end us with something half done. One
/// at a time, of one thread.
class HeldSignals {
  public:
    HeldSignals();
    ~HeldSignals();
    HeldSignals(const HeldSignals&) = delete;
    HeldSignals& operator=(const HeldSignals&) = delete;

    /// Until a child may have ended, at most a tenth of a second. Throws Stopped when we are to
    /// end.
    void wait() const;

    /// For poll(): readable while one of them is waiting to be taken. Also in a child.
    int descriptor() const;

    /// The one that waits, if any: one of those, or SIGCHLD; else 0.
    int take() const;

    /// In a child: signals as they were before. Safe between fork and exec.
    void release() const;

  private:
    sigset_t awaited_{};
    mutable int descriptor_ = -1;
    sigset_t before_{};

    struct sigaction child_before_ {};
};

}  // namespace reprise::process
