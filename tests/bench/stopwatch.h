#pragma once

#include <algorithm>
#include <ctime>
#include <limits>

namespace reprise::bench {

/// The best of some rounds: on a shared machine others only ever add.
struct Best {
    double wall = std::numeric_limits<double>::infinity();    ///< [s]
    double cpu = std::numeric_limits<double>::infinity();     ///< [s] of all threads
    double thread = std::numeric_limits<double>::infinity();  ///< [s] of CPU, of the one that calls

    /// One more round.
    template <typename Work>
    void time(const Work& work) {
        const double wall_begin = seconds(CLOCK_MONOTONIC);
        const double cpu_begin = seconds(CLOCK_PROCESS_CPUTIME_ID);
        const double thread_begin = seconds(CLOCK_THREAD_CPUTIME_ID);
        work();
        thread = std::min(thread, seconds(CLOCK_THREAD_CPUTIME_ID) - thread_begin);
        cpu = std::min(cpu, seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu_begin);
        wall = std::min(wall, seconds(CLOCK_MONOTONIC) - wall_begin);
    }

  private:
    static double seconds(clockid_t clock) {
        timespec now{};
        clock_gettime(clock, &now);
        return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    }
};

}  // namespace reprise::bench
