#pragma once

#include <functional>

namespace reprise::remote {

/// [s] for so long a driver polls for a tick where its author says nothing else.
constexpr double usual_polling = 5e-3;

/// Whether, and for how long, one looks again and again for what is to come before one sleeps. Who
/// sleeps is woken late, and at the cost of who wakes him: on a virtual machine some 50 and 20 us.
/// It decides how one waits, never what happens.
class Polling {
  public:
    /// [s]
    struct Clocks {
        std::function<double()> wall;
        std::function<double()> own;  ///< runs while this thread has a processor

        static Clocks real();
    };

    /// `longest`: [s] of a wait; 0: sleeps at once, as where one processor is ours only.
    explicit Polling(double longest = 0, Clocks clocks = Clocks::real());

    /// Looks until `there` says so, or too much time has gone by; then the next 2 waits are not
    /// polled. Nor are 16 where somebody else wanted our processor in 8 of them, and twice as many
    /// each time, up to 1,024, until 64 in a row were not disturbed.
    bool finds(const std::function<bool()>& there);

  private:
    void heed(bool had_a_rival);

    double longest_;
    Clocks clocks_;
    unsigned to_sleep_ = 0;   ///< waits that are not polled
    unsigned rivalry_ = 0;    ///< grows with each wait that was disturbed, shrinks with others
    unsigned calm_ = 0;       ///< waits in a row that were not
    unsigned doublings_ = 0;  ///< of the next pause for a rival
};

}  // namespace reprise::remote
