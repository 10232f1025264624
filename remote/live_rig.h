#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include "remote/frame_channel.h"
#include "remote/picture_ring.h"
#include "world/external/rig.h"
#include "world/recording.h"
#include "world/tick.h"

namespace reprise::remote {

class SharedMemory;

/// The process that renders is gone: "was ended by signal 9". That is ours unless it has said
/// itself what it lacked, such as memory.
class RenderFault : public std::runtime_error {
  public:
    RenderFault(const std::string& what, bool ours) : std::runtime_error(what), is_ours(ours) {}

    bool is_ours;
};

/// What the sensors of one vehicle see while the run goes on. A process of its own renders: it is
/// told the town once, then ticks as they are recorded, and writes pixels and points into memory
/// that it, the run and the driver share; readings are in its answers. It knows no kernel, the run
/// no renderer.
class LiveRig {
  public:
    /// Starts it; does not wait for it. `program`: the line for the shell; it finds its socket in
    /// the variable REPRISE_LIVE. `rig` is not empty. Throws world::Error.
    LiveRig(const std::string& program,
            const world::CommandT& spawn,
            const world::Rig& rig,
            const world::Recording& recording);
    ~LiveRig();
    LiveRig(const LiveRig&) = delete;
    LiveRig& operator=(const LiveRig&) = delete;

    const SharedMemory& memory() const;

    /// Of a rig in the middle of a run: the tick before the first that it is asked for.
    void remember(std::span<const std::uint8_t> tick, std::span<const std::uint8_t> traffic);

    /// Has the frames of this tick rendered; whether any sensor is due. Does not wait for them.
    /// Throws RenderFault.
    bool ask(const world::SealedTick& tick);

    /// Whether the frames of this tick, for which it was asked, are there. Throws RenderFault.
    bool has(std::uint64_t tick);

    /// Waits for them. Throws RenderFault, and ChannelFault when somebody gives up.
    void wait_for(std::uint64_t tick, const std::function<bool()>& given_up);

    /// The frames of the first tick that was asked for and not taken yet; they are there.
    std::vector<PlacedPicture> take();

    /// Readable when frames have come, for poll().
    int descriptor() const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// The other side, which the process that renders is: what it was told, and how it answers.
class LivePictures {
  public:
    /// From the variable REPRISE_LIVE. Waits for the run's first word. Throws world::Error where
    /// there is no run; all here throw ChannelFault when it is gone.
    LivePictures();
    ~LivePictures();
    LivePictures(const LivePictures&) = delete;
    LivePictures& operator=(const LivePictures&) = delete;

    const world::TownT& town() const;

    /// The town's SUMO network; empty where no sensor asks for it.
    const std::string& network() const;

    const world::SensorRig& sensors() const;

    /// Says that all is ready for the first tick.
    void ready();

    struct Wish {
        world::TickView tick;
        world::SensorRig sensors;             ///< due in this tick
        std::optional<world::TickView> last;  ///< the tick before it, where a sensor needs that
    };

    /// The next tick to be looked at, until the next call.
    Wish next();

    /// What was seen of the last wish, in its order. Of readings the bytes of their rows.
    void show(std::span<const world::SensorFrame> frames);

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace reprise::remote
