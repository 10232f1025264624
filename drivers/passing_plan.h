#pragma once

#include <optional>
#include <span>
#include <vector>

#include "drivers/bypass.h"
#include "drivers/control/ego.h"
#include "drivers/road_map.h"
#include "drivers/road_view.h"
#include "drivers/way/way.h"
#include "world/tick.h"

namespace reprise::drivers {

/// All that a way past something is planned from.
struct PassingScene {
    const world::TickView& last;
    const Ego& ego;
    const Way& way;
    const RoadMap& map;
    std::span<const Neighbour> neighbours;
    double beside = 0;  ///< [m] left of the path, where the car is
    double waited = 0;  ///< [s] for the first of them
    double share = 1;   ///< as in DrivingStyle

    /// Of the point that is steered along the path. [m]
    double tracked_s() const;

    /// From there to the bumpers. [m]
    double to_front() const;
    double to_rear() const;
};

/// A way past a row of things, as one would drive it from here.
struct PassingPlan {
    /// What it takes of the road.
    enum class Uses : std::uint8_t { own_lane, next_lane, oncoming_lane, junction };

    Bypass bypass;
    double out_speed = 0;            ///< [m/s] at most, while it turns out
    double speed = 0;                ///< [m/s] at most, beside them
    std::vector<std::uint32_t> row;  ///< ids of those who are passed
    Uses uses = Uses::own_lane;
    double missing = 0;   ///< [m] ahead of the car to get out at all; 0: it has the room
    double room = 0;      ///< [m] from the bumper to the first of them, that getting out takes
    bool is_free = true;  ///< nobody comes
    bool past_waiting = false;       ///< who stands does not count as coming: they wait for us
    std::optional<double> stood_at;  ///< [m] along the path, the rear of the first one: if it stood
};

/// Does it stand on our way with its front towards us? No queue that we are in will move it.
bool faces_us(const Neighbour& one, const Way& way);

/// How far from them one keeps. [m]
double clearance_of(const Neighbour& one);

/// Past `first` and those behind it who would be in the way: on the side where least of the road is
/// taken, and where it is free. None: the road is too narrow, or the lane ends too soon. The plan
/// may lack room ahead of the car, or be not free now.
std::optional<PassingPlan> plan_passing(const PassingScene& scene, const Neighbour& first);

/// Once planned: is it still so that nobody comes?
bool is_free(const PassingScene& scene, const PassingPlan& plan);

/// [m] of a step aside at that speed; `share` as in DrivingStyle.
double step_length(const world::VehicleModel& model, double width, double speed, double share);

}  // namespace reprise::drivers
