#include "kernel/side_thread.h"

#include <sched.h>
#include <system_error>

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
    rest();
}

void SideThread::rest() {
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

void SideThread::both(const std::function<void()>& here, const std::function<void()>& there) {
    if (!tried_)
        start();
    there_ = &there;
    error_ = nullptr;
    if (thread_.joinable())
        tell(State::offered);
    else
        state_ = State::offered;
    std::exception_ptr error_here;
    try {
        here();
    } catch (...) {
        error_here = std::current_exception();
    }
    State state = State::offered;
    if (state_.compare_exchange_strong(state, State::taken)) {
        work();
    } else {
        while (state != State::done) {
            state_.wait(state);
            state = state_.load();
        }
    }
    state_ = State::idle;
    if (error_here)
        std::rethrow_exception(error_here);
    if (error_)
        std::rethrow_exception(error_);
}

}  // namespace reprise::kernel
