#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "remote/seat.h"
#include "world/recording.h"
#include "world/tick.h"

namespace reprise::cli {

/// The drivers in other programs through a run: who appears gets the one that was named for it, all
/// are shown each tick, and all are waited for. Their controls are inputs of the run, which is
/// recorded with them and needs no driver to be made again.
class Seats {
  public:
    /// `plans` as --driver says them. Starts the programs. `recording` must outlive this. Throws
    /// world::Error.
    Seats(const std::vector<std::string>& plans,
          const remote::Patience& patience,
          const world::Recording& recording);

    /// Behind a tick that is not the last: shows it, and waits for the answers that are due: to
    /// this tick, or to an earlier one by the latency that the scenario gave an actor. Throws
    /// world::Error, "my.lua:3: ...", for an actor that nobody was named for.
    void go_on(const world::SealedTick& tick);

    /// For the next step, sorted by actor.
    std::span<const world::Control> controls() const { return controls_; }

    /// A driver that drives no longer: the run ends where it is.
    struct Loss {
        std::string actor;   ///< its name
        std::string reason;  ///< for people
        bool ours = false;   ///< not the driver failed, but we did
    };

    const std::optional<Loss>& loss() const { return loss_; }

    /// The run is over. Returns the names of drivers whose actor never came.
    std::vector<std::string> leave(const std::string& reason);

  private:
    void welcome(const world::Tick& tick);
    void lose(const remote::Seat& seat, const remote::Lost& lost);

    const world::Recording* recording_;
    std::vector<std::unique_ptr<remote::Seat>> free_;

    struct Taken {
        std::unique_ptr<remote::Seat> seat;
        unsigned silent_ticks = 0;  ///< that go by before the first answer is waited for
    };

    std::map<std::uint32_t, Taken> taken_;  ///< by actor
    std::vector<world::Control> controls_;
    std::optional<Loss> loss_;
};

}  // namespace reprise::cli
