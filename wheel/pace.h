#pragma once

#include <cstdint>
#include <deque>

namespace reprise::wheel {

/// Keeps a run from being faster than the clock, and says how fast it is. Reads no clock itself.
class Pace {
  public:
    /// `factor`: simulated over real time that is wanted; 0: as fast as it goes. `step`: [s] of
    /// simulated time a tick.
    Pace(double factor, double step) : wanted_(factor), step_(step) {}

    /// A tick is there, at this time [s]: so long until it is to be answered, 0 when it is late.
    /// What a run is late by is made up for as long as it is little; else time goes on from here,
    /// so that nobody is raced through what was missed.
    double wait(std::uint64_t tick, double now);

    /// Simulated over real time in the last second or so; 0 before two ticks have come.
    double factor() const;

  private:
    struct Arrival {
        std::uint64_t tick;
        double at;  ///< [s]
    };

    double wanted_;
    double step_;
    std::deque<Arrival> arrivals_;  ///< of the last second, and the one before
    bool begun_ = false;
    Arrival anchor_{};  ///< a tick that was in time
};

}  // namespace reprise::wheel
