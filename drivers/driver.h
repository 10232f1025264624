#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "drivers/driver_news.h"
#include "drivers/road_map.h"
#include "world/episode_generated.h"
#include "world/tick.h"
#include "world/transition.h"

namespace reprise::drivers {

struct DriverState;  // driver_state.h

/// The built-in driver: follows lanes with Stanley steering, holds speed by feed-forward with
/// proportional and integral terms, keeps its distance (IDM), stops at red and at stop signs, gives
/// way. It sees what any driver sees: the last tick. Without a route it wanders: at every junction
/// it draws one of the ways that go on. It leaves its lane where its route needs it, or where the
/// lane leads nowhere and another one does, and, where it may overtake, for as long as it takes to
/// pass what stands or crawls in it. Held by something that it touches, it goes back a little and
/// tries again.
class Autopilot {
  public:
    /// `map` must outlive the driver; it copies what it needs of `episode`. Pilot::pid drives as
    /// PidDriver does, and passes nothing.
    Autopilot(std::uint32_t actor,
              std::uint16_t model,
              const world::EpisodeT& episode,
              const RoadMap& map,
              world::Pilot pilot = world::Pilot::idm);
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

    /// To this lane, beside the one that it is on, at once and whoever is there, within `duration`
    /// [s]: the car is on the line of that shape between the middles of both lanes. With the shape
    /// `step` as quickly as the grip allows.
    void switch_lane(std::uint32_t lane, double duration, world::Shape shape);

    /// [m] left of the middle of whatever lane it is on, from now on; duration and shape as above,
    /// 0 as it likes.
    void set_offset(double offset, double duration, world::Shape shape);

    /// From now on it stays on its lane, whatever comes, but for change_lane: goes on as the lane
    /// does, and stops where that ends. What is left of its route must be possible so; the next
    /// decide throws world::Error where it is not. Or again as it likes.
    void keep_lane(bool keep);

    /// [m/s]; a cap below the limits of the lanes, reached in `duration` [s], or as it likes.
    void set_speed(double speed, double duration = 0, world::Shape shape = world::Shape::linear);

    /// Exactly that fast: it reacts to nothing, neither others nor lights, bends, limits or right
    /// of way, and steers along its way. Where that ends it goes straight on.
    void hold_speed(double speed, double duration, world::Shape shape);
    void end_hold();

    /// At `deceleration` [m/s^2] until it stands, and then stands; it reacts to nothing.
    void brake(double deceleration);
    void end_brake();

    /// Back to the lanes' limits. Ends holding and braking, too.
    void free_speed();

    /// The scenario moved it: at the next decide it looks where it is, and goes on from there to
    /// what is left of its route. Or gave it another speed.
    void put_elsewhere();
    void put_to_speed();

    /// Red lights and stop lines are as green ones. It still looks out for others.
    void ignore_lights(bool ignore);

    /// May it pass what stands or crawls in its lane? Not until it is told so: a scenario that puts
    /// something into its way is to see what it does about that in its lane.
    void may_overtake(bool may);

    /// The control for the next tick. The actor must be in `last`.
    world::Control decide(const world::TickView& last);

    /// Of the last decide: what it begins to do that nobody told it to; null: nothing.
    const DriverNews* news() const;

    /// As it last decided: does it want to get on? Not where the road leads nowhere, and not
    /// when it was told to stand. (Behind its route it wanders on.)
    bool is_under_way() const;

    /// Lane indices of the way ahead, from the one under the car. For tests.
    const std::vector<std::uint32_t>& path() const;

    std::uint64_t digest() const;

  private:
    std::unique_ptr<DriverState> state_;
};

}  // namespace reprise::drivers
