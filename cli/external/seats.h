#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "remote/guide.h"
#include "remote/seat.h"
#include "world/external/external_drivers.h"
#include "world/recording.h"
#include "world/tick.h"

namespace reprise::cli {

/// What --driver was given. Throws world::Error, also when an actor is named twice.
std::vector<remote::SeatPlan> parse_seats(const std::vector<std::string>& texts);

/// As they are recorded; of somebody else.
struct TickBytes {
    std::span<const std::uint8_t> tick{};
    std::span<const std::uint8_t> traffic{};
};

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

    /// One more, of a driver that is here already.
    void add(std::unique_ptr<remote::Seat> seat) { free_.push_back(std::move(seat)); }

    /// The same of one that hears the end of the run whatever happens to its vehicle, from who adds
    /// it: when that is taken away, nothing is said to it.
    void add_client(std::unique_ptr<remote::Seat> seat);

    /// Whether the vehicle of that one was taken away.
    bool has_client_without_car() const { return client_is_without_car_; }

    /// Behind a tick that is not the last: shows it to those who are to see it, does `meanwhile`
    /// while drivers think, and waits for the answers that are due: to this tick, or to an earlier
    /// one by the latency that the scenario gave an actor. Until the next is due the last one
    /// holds. Throws world::Error, "my.lua:3: ...", for an actor that nobody was named for.
    void go_on(const world::SealedTick& tick, const std::function<void()>& meanwhile);

    /// Likewise in the middle of a run: who is named here drives whoever is there from this tick
    /// on; nobody else needs a driver. Until its first answer acts, a vehicle keeps its control.
    /// `guides`: what those vehicles were told until then, by actor. `before`: the tick before, as
    /// it was recorded, which some sensors look at; empty where there is none.
    void take_over(const world::ExternalDrivers& there,
                   const std::map<std::uint32_t, remote::Guide>& guides,
                   const TickBytes& before,
                   const world::SealedTick& tick);

    /// Behind the last tick: who appears in it has nothing left to be asked for, and its driver,
    /// should there be one, came for nothing.
    void see_last(const world::SealedTick& tick);

    /// For the next step, sorted by actor.
    std::span<const world::Control> controls() const { return controls_; }

    /// A driver that drives no longer: the run ends where it is.
    struct Loss {
        std::string actor;                    ///< its name
        std::string reason;                   ///< for people
        bool ours = false;                    ///< not the driver failed, but we did
        bool left = false;                    ///< nobody failed: it ends the run
        std::optional<remote::Frame> said{};  ///< in place of an answer
    };

    const std::optional<Loss>& loss() const { return loss_; }

    /// What the lost driver said in place of an answer; once.
    std::optional<remote::Frame> take_said();

    /// The run is over: says goodbye, and on stderr who was lost and who never came; that is said
    /// there only, because equal runs write equal traces. Returns how it ended: with the loss, or
    /// as `otherwise` has it.
    world::Outcome end(const world::Outcome& otherwise);

    /// The same without a word to people. Returns the names of drivers whose actor never came.
    std::vector<std::string> leave(const std::string& reason,
                                   const std::optional<world::Outcome>& outcome = {});

    /// The run cannot go on: tells all drivers why.
    void fail(const std::string& text, std::uint32_t line);

    /// Without a word: they have something else to listen to.
    void abandon();

    /// The name of one that is driven now; none: nobody is on the road.
    std::optional<std::string> somebody_driven() const;

    /// Whether the driver of this actor is one of ours.
    bool drives(std::uint32_t actor) const { return taken_.count(actor) > 0; }

  private:
    struct Taken {
        std::unique_ptr<remote::Seat> seat;
        unsigned latency = 0;                  ///< [ticks]
        std::uint64_t asked = 0;               ///< tick whose answer is to be the next
        std::optional<world::Control> said{};  ///< in the last one

        bool is_due(std::uint64_t tick) const { return tick >= asked + latency; }
    };

    void welcome(const world::Tick& tick);
    void take_away(std::map<std::uint32_t, Taken>::iterator gone);
    std::string unused() const;
    bool seat(const world::Spawn& spawn,
              std::uint64_t now,
              const remote::Guide* guide = nullptr,
              const TickBytes& before = {});
    void ask(const world::SealedTick& tick, const std::function<void()>& meanwhile);
    void hear(Taken& taken);
    void lose(const remote::Seat& seat, remote::Lost lost);

    const world::Recording* recording_;
    std::vector<std::unique_ptr<remote::Seat>> free_;

    std::map<std::uint32_t, Taken> taken_;  ///< by actor
    std::vector<world::Control> controls_;
    std::optional<Loss> loss_;
    std::string client_;  ///< name of its actor; empty: nobody was added as client
    bool client_is_without_car_ = false;
};

}  // namespace reprise::cli
