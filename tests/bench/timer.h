#pragma once

#include <algorithm>
#include <chrono>
#include <numeric>
#include <vector>

namespace reprise::bench {

/// Sums and medians of what was timed tick by tick: one slow tick of a busy machine does not count.
class Timer {
  public:
    using Clock = std::chrono::steady_clock;

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

}  // namespace reprise::bench
