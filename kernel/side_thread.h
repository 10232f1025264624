#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <thread>

namespace reprise::kernel {

/// A second thread, for work that needs nothing of what the first one does meanwhile. What comes
/// out is the same with and without it: it decides when something is done, never what. Behind its
/// work it stays awake for a millisecond, where nobody else wants the processor: a tick needs it
/// again long before, and to be woken costs more than much of what it is given.
class SideThread {
  public:
    SideThread() = default;
    ~SideThread();
    SideThread(const SideThread&) = delete;
    SideThread& operator=(const SideThread&) = delete;

    /// Does `here` in this thread and `there` in the other one, or behind `here` in this one as
    /// well: where there is one processor only, no more threads are to be had, or the other one has
    /// not begun by then. Returns when both are done; throws what `here` threw, then what `there`
    /// did. 10 us more than the longer of the two, where the other one sleeps.
    void both(const std::function<void()>& here, const std::function<void()>& there);

    /// Does the other thread stay awake? Not where programs beside this one need the processors as
    /// much as it does.
    void stay_awake(bool awake) { stays_awake_ = awake; }

    /// Does `there` in the other thread while this one goes on, until drop().
    void offer(std::function<void()> there);

    /// Returns once what was offered is done, or will never be: where the other thread has not
    /// begun by now. Throws what it threw. Nothing where nothing was offered.
    void drop();

    /// As drop(), and ends the other thread until it is needed again: so that the process can be
    /// copied.
    void rest();

  private:
    enum class State : int { idle, offered, taken, done, leaving };

    void start();
    void run();
    void offer_it();
    bool take_back();
    void work() noexcept;
    void tell(State state);

    std::atomic<State> state_ = State::idle;
    std::atomic<bool> stays_awake_ = true;
    const std::function<void()>* there_ = nullptr;
    std::function<void()> offered_;
    std::exception_ptr error_;
    std::thread thread_;
    bool tried_ = false;  ///< to start it
};

}  // namespace reprise::kernel
