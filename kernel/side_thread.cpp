#include "kernel/side_thread.h"

#include <sched.h>
#include <system_error>
#include <utility>

#include "process/linger.h"
#include "world/arithmetic.h"
#include "world/check.h"

namespace reprise::kernel {

namespace {

/// Has this process another processor beside the one that it is on?
bool has_another_processor() {
    cpu_set_t mine;
    return sched_getaffinity(0, sizeof(mine), &mine) == 0 && CPU_COUNT(&mine) > 1;
}

}  // namespace

SideThread::~SideThread() {
    if (state_ != State::idle)
        take_back();
    state_ = State::idle;
    rest();
}

void SideThread::rest() {
    drop();
    tried_ = false;
    if (!thread_.joinable())
        return;
    tell(State::leaving);
    thread_.join();
    state_ = State::idle;
}

/// Not before the first work: until then the process may be copied (process/offshoot.h).
void SideThread::start() {
    tried_ = true;
    if (!has_another_processor())
        return;
    try {
        thread_ = std::thread([this] { run(); });
    } catch (const std::system_error&) {  // no more threads for us: one does it as well
    }
}

void SideThread::tell(State state) {
    state_.store(state);
    state_.notify_one();
}

/// The thread.
void SideThread::run() {
    for (;;) {
        State state = state_.load();
        if (state == State::leaving)
            return;
        if (state != State::offered) {
            state_.wait(state);
        } else if (state_.compare_exchange_strong(state, State::taken)) {
            work();
            tell(State::done);
            if (stays_awake_)
                process::linger(1e-3, [this] {
                    const State now = state_.load(std::memory_order_relaxed);
                    return now != State::done && now != State::idle;
                });
        }
    }
}

void SideThread::work() noexcept {
    try {
        (*there_)();
        REPRISE_CHECK(world::is_plain_arithmetic(), world::unusual_arithmetic());
    } catch (...) {
        error_ = std::current_exception();
    }
}

void SideThread::offer_it() {
    if (!tried_)
        start();
    error_ = nullptr;
    if (thread_.joinable())
        tell(State::offered);
    else
        state_ = State::offered;
}

/// True: the other thread has not begun, and will not. False: it is done.
bool SideThread::take_back() {
    State state = State::offered;
    const bool ours = state_.compare_exchange_strong(state, State::taken) || state == State::idle;
    while (!ours && state != State::done) {
        state_.wait(state);
        state = state_.load();
    }
    return ours;
}

void SideThread::both(const std::function<void()>& here, const std::function<void()>& there) {
    drop();
    there_ = &there;
    offer_it();
    std::exception_ptr error_here;
    try {
        here();
    } catch (...) {
        error_here = std::current_exception();
    }
    if (take_back())
        work();
    state_ = State::idle;
    if (error_here)
        std::rethrow_exception(error_here);
    if (error_)
        std::rethrow_exception(error_);
}

void SideThread::offer(std::function<void()> there) {
    drop();
    offered_ = std::move(there);
    there_ = &offered_;
    offer_it();
}

void SideThread::drop() {
    if (state_ == State::idle)
        return;
    const bool done = !take_back();
    state_ = State::idle;
    if (done && error_)
        std::rethrow_exception(std::exchange(error_, nullptr));
}

}  // namespace reprise::kernel
