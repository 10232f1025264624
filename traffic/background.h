#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

#include "world/episode_generated.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::traffic {

/// SUMO's cars and traffic lights. Owns the process's one libsumo simulation: constructing a second
/// one while the first lives throws. Kept deterministic by naming the SUMO options that decide a
/// run, one thread, a fixed seed, and by calling SUMO in the order of ids.
class Background {
  public:
    /// Starts SUMO in this process with the network's bytes (no file is left behind) and places
    /// `episode.cars` cars, spread over the town by the seed. `town` and its `lanes` must outlive
    /// this. Throws world::Error when SUMO refuses the network.
    Background(const world::EpisodeT& episode,
               const world::TownT& town,
               const world::LaneMap& lanes,
               std::string_view network);
    ~Background();
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;

    using Work = std::function<void()>;

    /// Does two things of which neither needs anything of the other, in whatever order, or at once.
    using Both = std::function<void(const Work& here, const Work& elsewhere)>;

    static void in_turn(const Work& here, const Work& elsewhere) {
        here();
        elsewhere();
    }

    /// Stage 3. Mirrors the physics vehicles of the last tick into SUMO, carries out next's
    /// commands for cars that traffic drives (spawn, despawn, set_speed, free_speed, change_lane,
    /// set_route, follow, teleport, set_velocity), makes one SUMO step, and writes
    /// next.traffic.cars (sorted by id, parked ones among them), next.tick.signals, and
    /// spawned/despawned events. Keeps the number of background cars. `both` is called
    /// twice: for SUMO's step and what can be done elsewhere meanwhile, and for the two halves of
    /// what came of it.
    void advance(const world::TickView& last, world::TickDraft& next, const Both& both);

    /// Works out beforehand what the next advance, which makes `tick`, will need, if nothing
    /// happens to the cars until then. Changes nothing that can be asked here: for another thread,
    /// in the time between two advances. What it throws is of no interest: whoever advances hears
    /// of it.
    void look_ahead(std::uint64_t tick);

    /// Are there enough cars that a thread of its own pays?
    bool are_many() const;

    /// Of all that this keeps: every car unrounded, with its route, trail and orders; the signals;
    /// the mirrors; as of before SUMO's step of the last tick. And of what that step made of the
    /// cars, unrounded: whatever else is kept behind it follows from these two. SUMO's own memory
    /// cannot be read: what it holds (its drivers' random streams, say) shows in the cars and
    /// signals, in the tick in which it first matters.
    std::uint64_t digest() const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace reprise::traffic
