#pragma once

#include <csignal>
#include <filesystem>

namespace reprise::files {

/// From now on, when a signal ends this program (Ctrl-C, SIGTERM, a closed terminal or pipe, a
/// limit on its time), what it has unfinished is removed first; then the signal does as usual. What
/// is ignored, as under nohup, stays so. Call once, at the start. `last`, if any, is called before
/// that: it may do only what POSIX allows in a signal handler.
void tidy_up_when_ended(void (*last)(int signal) = nullptr);

/// Removes what is unfinished, now. Only calls that POSIX allows in a signal handler.
void remove_unfinished() noexcept;

/// While it lives, signals that would end this program wait: between making a file and noting it
/// down. In the calling thread; one that comes to another thread waits for this to end, and who
/// begins after it came never gets on.
class EndingHeld {
  public:
    EndingHeld();
    ~EndingHeld();
    EndingHeld(const EndingHeld&) = delete;
    EndingHeld& operator=(const EndingHeld&) = delete;

  private:
    sigset_t before_{};
};

/// Notes down a file, or a folder that goes when it is empty, to be removed when a signal ends us.
/// A forked child has notes of its own.
class RemovedWhenEnded {
  public:
    explicit RemovedWhenEnded(const std::filesystem::path& path);
    ~RemovedWhenEnded();
    RemovedWhenEnded(const RemovedWhenEnded&) = delete;
    RemovedWhenEnded& operator=(const RemovedWhenEnded&) = delete;

  private:
    std::size_t slot_;
};

/// While it lives, the first signal that would end us is only remembered, so that work ends where
/// nothing of it is lost. The second one ends us at once. One at a time.
class StopRequest {
  public:
    StopRequest();
    ~StopRequest();
    StopRequest(const StopRequest&) = delete;
    StopRequest& operator=(const StopRequest&) = delete;

    /// The signal that came; 0: none did.
    int signal() const;
};

}  // namespace reprise::files
