#include "process/linger.h"

#include <chrono>
#include <sched.h>
#include <sys/resource.h>

#include "process/processors.h"

namespace reprise::process {

namespace {

/// How often another thread has got the processor from this one, as by sched_yield().
long times_given_up() {
    rusage use{};
    getrusage(RUSAGE_THREAD, &use);
    return use.ru_nivcsw;
}

}  // namespace

void linger(double longest, const std::function<bool()>& there) {
    using Clock = std::chrono::steady_clock;
    using Seconds = std::chrono::duration<double>;
    constexpr Seconds somebody_elses_turn(20e-6);
    static const bool has_several = processors() > 1;
    if (!has_several)
        return;
    const Clock::time_point begin = Clock::now();
    Clock::time_point last = begin;
    const long given_up = times_given_up();
    while (!there()) {
        sched_yield();
        const Clock::time_point now = Clock::now();
        if (now - begin > Seconds(longest))
            return;
        // So much time may have gone to the host of a virtual machine, too, which minds nobody.
        if (now - last > somebody_elses_turn && times_given_up() != given_up)
            return;
        last = now;
    }
}

}  // namespace reprise::process
