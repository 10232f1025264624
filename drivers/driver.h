#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "drivers/road_map.h"
#include "world/episode_generated.h"
#include "world/tick.h"

namespace reprise::drivers {

/// The built-in driver: follows lanes with Stanley steering, holds speed by feed-forward with
/// proportional and integral terms, keeps its distance (IDM), stops at red and at stop signs, gives
/// way. It sees what any driver sees: the last tick. Without a route it wanders: at every junction
/// it draws one of the ways that go on. It leaves its lane where its route needs it, or where the
/// lane leads nowhere and another one does.
class Autopilot {
  public:
    /// `map` must outlive the driver; it copies what it needs of `episode`.
    Autopilot(std::uint32_t actor,
              std::uint16_t model,
              const world::EpisodeT& episode,
              const RoadMap& map);
    ~Autopilot();
    Autopilot(Autopilot&&) noexcept;
    Autopilot& operator=(Autopilot&&) noexcept;

    /// Lanes to pass in this order, the last one at `last_s` [m]. Planned at the next decide, which
    /// throws world::Error when one cannot be reached. Who misses a change of lanes goes another
    /// way.
    void set_route(std::vector<std::uint32_t> lanes, double last_s);

    /// To a lane beside the one that it is on, and then on through what is left of its route. Where
    /// it is too late for that, nothing happens.
    void change_lane(std::uint32_t lane);

    /// From now on it stays on its lane, whatever comes, but for change_lane: goes on as the lane
    /// does, and stops where that ends. What is left of its route must be possible so; the next
    /// decide throws world::Error where it is not. Or again as it likes.
    void keep_lane(bool keep);

    /// [m/s]; a cap below the limits of the lanes.
    void set_speed(double speed);

    /// Back to the lanes' limits.
    void free_speed();

    /// The scenario moved it: at the next decide it looks where it is, and goes on from there to
    /// what is left of its route. Or gave it another speed.
    void put_elsewhere();
    void put_to_speed();

    /// The control for the next tick. The actor must be in `last`.
    world::Control decide(const world::TickView& last);

    /// As it last decided: does it want to get on? Not where the road leads nowhere, and not
    /// when it was told to stand. (Behind its route it wanders on.)
    bool is_under_way() const;

    /// Lane indices of the way ahead, from the one under the car. For tests.
    const std::vector<std::uint32_t>& path() const;

    std::uint64_t digest() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace reprise::drivers
