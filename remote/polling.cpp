#include "remote/polling.h"

#include <algorithm>
#include <chrono>
#include <sched.h>

namespace reprise::remote {

namespace {

constexpr unsigned most_doublings = 6;

/// Where there is one only, whom we wait for could not run while we look.
bool has_several_processors() {
    cpu_set_t allowed;
    CPU_ZERO(&allowed);
    return sched_getaffinity(0, sizeof(allowed), &allowed) != 0 || CPU_COUNT(&allowed) > 1;
}

}  // namespace

Polling::Polling(double longest)
    : longest_(longest > 0 && has_several_processors() ? longest : 0) {}

bool Polling::finds(const std::function<bool()>& there) {
    using Clock = std::chrono::steady_clock;
    if (to_sleep_ > 0) {
        --to_sleep_;
        return false;
    }
    if (longest_ <= 0)
        return false;
    const auto begin = Clock::now();
    do {
        if (there()) {
            in_vain_ = 0;
            return true;
        }
        sched_yield();  // it may stand behind us, on the same processor
    } while (std::chrono::duration<double>(Clock::now() - begin).count() < longest_);
    in_vain_ = std::min(in_vain_ + 1, most_doublings);
    to_sleep_ = 1U << in_vain_;
    return false;
}

}  // namespace reprise::remote
