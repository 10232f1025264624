#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include "remote/frame_channel.h"
#include "remote/rhythm.h"
#include "remote/seat_plan.h"
#include "world/recording.h"
#include "world/tick.h"

namespace reprise::remote {

class Guide;

/// Why a driver drives no longer, in words for people, such as "its program ended with exit code
/// 1".
struct Lost {
    std::string reason;
    std::optional<Frame> said{};  ///< what it said in place of an answer, where that was a message
    bool ours = false;            ///< not the driver failed, but we did
    bool left = false;            ///< nobody failed: it wants the run to end
};

/// How the scenario spawned a vehicle: what it carries, and what its driver is shown.
struct Spawned {
    const world::CommandT* command = nullptr;
    std::uint64_t tick = 0;        ///< in which it appeared
    std::uint64_t now = 0;         ///< in which its driver sits down; of who takes over: later
    std::string render_program;    ///< for the shell, see LiveRig
    const Guide* guide = nullptr;  ///< of who takes over: what the vehicle was told until now
    std::span<const std::uint8_t> tick_before{};     ///< of who takes over, as recorded
    std::span<const std::uint8_t> traffic_before{};  ///< likewise
};

/// The place at the wheel that a driver in another program takes. The run goes tick by tick with
/// it: show() what was recorded, then wait for its answer(), where it is asked for one (Rhythm).
/// Where the vehicle carries a rig, a tick is shown as soon as its frames are there.
class Seat {
  public:
    /// Starts the program, or makes the socket, open for this user only. `patience`: for each
    /// answer. Throws world::Error.
    Seat(const SeatPlan& plan, Patience patience);

    /// Of a driver that is here already.
    Seat(std::string actor, FrameChannel channel, Patience patience);

    ~Seat();
    Seat(const Seat&) = delete;
    Seat& operator=(const Seat&) = delete;

    const std::string& actor() const;

    /// Where its driver is to come to; empty: we started it.
    std::string place() const;

    /// The vehicle is there, with this id: says hello, and waits for the driver to be ready.
    /// Throws world::Error for a rig that is not possible.
    std::optional<Lost> take(std::uint32_t id,
                             const world::Recording& recording,
                             const Spawned& spawned = {});

    /// Its id, once taken.
    std::optional<std::uint32_t> id() const;

    /// Which ticks its driver is shown, once taken.
    const Rhythm& rhythm() const;

    /// Hands over a tick, or begins to render what belongs to it; one that the driver is not shown
    /// goes along with the next. Does not wait for what the driver makes of it.
    std::optional<Lost> show(const world::SealedTick& tick);

    /// Before answer(), where there are several: waits for the frames of the tick that it is to
    /// answer, and hands them over.
    std::optional<Lost> show_due();

    /// What the driver makes of the first tick that was shown and not answered yet.
    std::variant<world::Control, Lost> answer();

    /// The run is over, or the vehicle gone: says goodbye. `outcome`: of the run.
    void leave(const std::string& reason, const std::optional<world::Outcome>& outcome = {});

    /// The run cannot go on, which is not the driver's doing: says why. `line` of the scenario, or
    /// 0.
    void fail(const std::string& text, std::uint32_t line);

    /// Lets go of the connection without a word.
    void abandon();

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace reprise::remote
