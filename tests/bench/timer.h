#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <numeric>
#include <vector>

namespace reprise::bench {

/// Time of CPU that the thread takes: on a busy machine others do not count.
struct ThreadClock {
    using time_point = std::chrono::time_point<ThreadClock, std::chrono::nanoseconds>;
    using duration = time_point::duration;
    using rep = duration::rep;
    using period = duration::period;
    static constexpr bool is_steady = true;

    static time_point now() {
        timespec now{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
        return time_point(std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec));
    }
};

/// Sums and medians of what was timed tick by tick: one slow tick of a busy machine does not count.
template <typename Clock>
class TimerOf {
  public:
    /// Times `work`. [s]
    template <typename Work>
    void time(const Work& work) {
        const auto begin = Clock::now();
        work();
        times_.push_back(std::chrono::duration<double>(Clock::now() - begin).count());
    }

    double sum() const { return std::accumulate(times_.begin(), times_.end(), 0.0); }

    double median() const {
        std::vector<double> sorted = times_;
        const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
        std::nth_element(sorted.begin(), middle, sorted.end());
        return *middle;
    }

  private:
    std::vector<double> times_;
};

using Timer = TimerOf<std::chrono::steady_clock>;
using ThreadTimer = TimerOf<ThreadClock>;

}  // namespace reprise::bench
