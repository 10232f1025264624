#include "remote/polling.h"

#include <algorithm>
#include <ctime>
#include <sched.h>
#include <utility>

#include "process/processors.h"

namespace reprise::remote {

namespace {

constexpr double least_share = 0.8;    // of a processor that nobody else wants
constexpr unsigned pause_in_vain = 2;  // [waits], as the others

// A scheduler needs some waits to part two that it put on one processor while another stood idle:
// one rival is no reason to sleep.
constexpr unsigned per_rival = 2;
constexpr unsigned most_rivalry = 16;
constexpr unsigned shortest_pause = 16;
constexpr unsigned most_doublings = 6;
constexpr unsigned long_calm = 64;

double seconds_of(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

Polling::Clocks Polling::Clocks::real() {
    return {[] { return seconds_of(CLOCK_MONOTONIC); },
            [] { return seconds_of(CLOCK_THREAD_CPUTIME_ID); }};
}

Polling::Polling(double longest, Clocks clocks)
    : longest_(longest > 0 && process::processors() > 1 ? longest : 0),
      clocks_(std::move(clocks)) {}

bool Polling::finds(const std::function<bool()>& there) {
    if (to_sleep_ > 0) {
        --to_sleep_;
        return false;
    }
    if (longest_ <= 0)
        return false;
    const double begin = clocks_.wall(), own_begin = clocks_.own();
    bool found = there();
    double waited = 0;
    while (!found && waited < longest_) {
        sched_yield();  // it may stand behind us, on the same processor
        found = there();
        waited = clocks_.wall() - begin;
    }
    to_sleep_ = found ? 0 : pause_in_vain;
    heed(clocks_.own() - own_begin < least_share * waited);
    return found;
}

void Polling::heed(bool had_a_rival) {
    if (!had_a_rival) {
        rivalry_ -= std::min(rivalry_, 1U);
        if (++calm_ == long_calm)
            doublings_ = 0;
        return;
    }
    calm_ = 0;
    rivalry_ += per_rival;
    if (rivalry_ < most_rivalry)
        return;
    rivalry_ = 0;
    to_sleep_ = shortest_pause << doublings_;
    doublings_ = std::min(doublings_ + 1, most_doublings);
}

}  // namespace reprise::remote
