#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "world/digest.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::traffic {

/// Signals that the scenario has taken from their programs. SUMO knows but one state for all the
/// links of a traffic light: where an order holds one of them, the others are given what their
/// program says, which goes on counting meanwhile. It is read before SUMO's step, so those others
/// change a tick later than they would have.
class SignalOrders {
  public:
    /// `town` must outlive this.
    explicit SignalOrders(const world::TownT& town) : town_(&town) {}

    /// A command set_signal, from this tick on: a colour for its duration, or back to the program.
    void give(const world::CommandT& command, std::uint64_t step_ns, std::uint64_t tick);

    /// Before SUMO's step to `tick`: what is ordered shows, what has run out goes back.
    void follow(std::uint64_t tick);

    void add_to(world::Hasher& hasher) const;

  private:
    struct Order {
        world::SignalColor color = world::SignalColor::off;
        std::uint64_t until = 0;  ///< the first tick that is its program's again
    };

    /// A traffic light of SUMO's with at least one order.
    struct Held {
        std::string program;                  ///< SUMO's id of the program it had before
        std::map<std::size_t, Order> orders;  ///< by index in Town.signals
        std::string shown;                    ///< the state that SUMO was told last
    };

    std::string wanted_state(const std::string& light, const Held& held) const;

    const world::TownT* town_;
    std::map<std::string, Held> held_;  ///< by SUMO's id of the traffic light
};

}  // namespace reprise::traffic
