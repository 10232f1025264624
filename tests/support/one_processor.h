#pragma once

#include <sched.h>
#include <string>

#include "world/check.h"

namespace reprise::test {

/// While it lives this thread, and what it starts, has one processor.
class OneProcessor {
  public:
    OneProcessor() {
        REPRISE_CHECK(sched_getaffinity(0, sizeof(before_), &before_) == 0, "");
        cpu_set_t one;
        CPU_ZERO(&one);
        int first = 0;
        while (!CPU_ISSET(first, &before_))
            ++first;
        CPU_SET(first, &one);
        REPRISE_CHECK(sched_setaffinity(0, sizeof(one), &one) == 0, std::to_string(first));
    }

    ~OneProcessor() { sched_setaffinity(0, sizeof(before_), &before_); }

    OneProcessor(const OneProcessor&) = delete;
    OneProcessor& operator=(const OneProcessor&) = delete;

  private:
    cpu_set_t before_{};
};

}  // namespace reprise::test
