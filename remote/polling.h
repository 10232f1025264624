#pragma once

#include <functional>

namespace reprise::remote {

/// Whether, and for how long, one looks again and again for what is to come before one sleeps. Who
/// sleeps is woken late, and at the cost of who wakes him: on a virtual machine some 50 and 20 us.
/// It decides how one waits, never what happens.
class Polling {
  public:
    /// `longest`: [s] of a wait; 0: sleeps at once, as where we may use one processor only.
    explicit Polling(double longest = 0);

    /// Looks until `there` says so, or too much time has gone by. Where that was in vain the next
    /// waits are not polled: 2 of them, and twice as many each time, up to 64.
    bool finds(const std::function<bool()>& there);

  private:
    double longest_;
    unsigned in_vain_ = 0;   ///< times one after the other
    unsigned to_sleep_ = 0;  ///< waits that are not polled
};

}  // namespace reprise::remote
