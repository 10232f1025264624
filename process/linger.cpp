#include "process/linger.h"

#include <chrono>
#include <sched.h>

#include "process/processors.h"

namespace reprise::process {

void linger(double longest, const std::function<bool()>& there) {
    using Clock = std::chrono::steady_clock;
    using Seconds = std::chrono::duration<double>;
    constexpr Seconds somebody_elses_turn(20e-6);
    static const bool has_several = processors() > 1;
    if (!has_several)
        return;
    const Clock::time_point begin = Clock::now();
    Clock::time_point last = begin;
    while (!there()) {
        sched_yield();
        const Clock::time_point now = Clock::now();
        if (now - begin > Seconds(longest) || now - last > somebody_elses_turn)
            return;
        last = now;
    }
}

}  // namespace reprise::process
