#pragma once

#include <cstdint>
#include <optional>

#include "drivers/control/ego.h"
#include "drivers/road_map.h"
#include "drivers/way/path.h"
#include "world/digest.h"
#include "world/tick.h"

namespace reprise::drivers {

/// What a driver does whose car does not move though it should: goes back a little and tries again.
///
/// MUST    notice after two seconds that the car is held by what it touches; look behind itself;
///         stay on the road, and out of lanes that lead the other way; end.
/// ASSUMES that what one is pressed against shows in the impulses that a car measures of itself.
/// GOES    backwards along the path, its tail turned towards it, so that the next try leads past;
///         farther the next time, when there was one before.
/// KEEPS   for how long it pushes, where it goes back, and how often it did.
class BackOff {
  public:
    struct Move {
        double speed = 0;  ///< [m/s] backwards
        double steer = 0;  ///< as in Control
    };

    /// `map` must outlive this. `step`: [s] of a tick.
    BackOff(const RoadMap& map, double step) : map_(&map), step_(step) {}

    /// After each tick: `throttle` is what was given in it. True: it has pushed for too long, and
    /// begins to go back.
    bool notice(const world::TickView& last, const Ego& ego, double throttle);

    /// After each tick of driving: `s` is where the car is along its path, `steer` as in Control.
    /// True: at full lock it gets nowhere along it, and begins to go back.
    bool notice_circling(const Ego& ego, double s, double steer);

    /// Goes back by so much, to have room ahead [m]; false: somebody is behind, or it did often.
    bool make_room(double distance, const world::TickView& last, const Ego& ego);

    /// As above, before a wall in a bend: with the wheels turned the other way, so that the car
    /// points farther around the bend when it goes on.
    bool turn_on(double distance, const world::TickView& last, const Ego& ego);

    /// Two stand, each in the other's way: goes back by so much [m], and lets the other one go
    /// first, for some seconds. False: as above.
    bool give_room(double distance, const world::TickView& last, const Ego& ego);

    /// It was put elsewhere.
    void end();

    bool is_going_back() const { return going_back_; }

    /// Where it goes back: [m] that it means to.
    double distance() const { return distance_; }

    /// After it turned on backwards, the next metres: the steering, as in Control, that leads
    /// around the bend. None: as always, to the path, which would lead to where it stood.
    std::optional<double> steer_on(const Ego& ego, const Path& path, double s);

    /// While it goes back. `path` and `s`: where the car is on its way, none off every road.
    Move next(const world::TickView& last, const Ego& ego, const Path* path, double s);

    void add_to(world::Hasher& hasher) const;

  private:
    void begin(double distance, const Ego& ego);
    static double turn_behind_bend(const Ego& ego, const Path& path, double s);
    bool somebody_is_behind(const world::TickView& last, const Ego& ego) const;
    bool somebody_moves_ahead(const world::TickView& last, const Ego& ego) const;
    bool leaves_its_lanes(const Ego& ego) const;
    bool somebody_is_beside_nose(const world::TickView& last, const Ego& ego, double side) const;

    const RoadMap* map_;
    double step_;
    double impulse_ = 0;                ///< [N s] taken up so far, of all kinds
    std::uint32_t pushing_ticks_ = 0;   ///< of throttle, contact and standing
    std::uint32_t free_ticks_ = 0;      ///< since the last contact
    std::uint32_t tries_ = 0;           ///< one after another
    std::uint32_t circling_ticks_ = 0;  ///< at full lock, without getting on
    double circling_from_ = 0;          ///< along the path, where that began
    bool going_back_ = false;
    double distance_ = 0;
    Eigen::Vector2d from_ = {0, 0};     ///< where it began
    std::uint32_t standing_ticks_ = 0;  ///< while it wants to go back
    bool turns_on_ = false;             ///< towards where the path goes behind the bend
    bool steers_on_ = false;            ///< forward again, from `from_`
    bool lets_go_first_ = false;        ///< and then waits
    std::uint32_t waiting_ticks_ = 0;   ///< for so long
};

}  // namespace reprise::drivers
