#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "traffic/cars/trail.h"
#include "world/geometry2d.h"
#include "world/tick.h"
#include "world/trajectory.h"
#include "world/transition.h"
#include "world/units.h"

namespace reprise::traffic {

/// Who wanted the car, which decides what happens to it at the end of its way.
enum class Origin : std::uint8_t { demand, scripted, parked };

/// A scripted speed: from `from` at `start`, over `ticks`, then held. [m/s]
struct SpeedOrder {
    double from = 0;
    double to = 0;
    std::uint64_t start = 0;
    std::uint64_t ticks = 0;
    world::Shape shape = world::Shape::linear;
    bool reacts = true;  ///< to others, lights and right of way
    bool brakes = false;
};

/// A scripted place beside the middle of the lane, left positive. SUMO does not know of it.
struct OffsetOrder {
    world::Transition change;  ///< [m]
    std::uint64_t start = 0;   ///< tick
};

/// A scripted lane change: asked of SUMO again and again until it is made or `until` has passed.
struct LaneOrder {
    std::uint32_t lane = world::none;
    double duration = 0;  ///< [s]
    std::uint64_t until = 0;
};

/// On its way around what blocks its lane: through the oncoming one, or into the one beside; see
/// passing.h and pulling_out.h.
struct PassOrder {
    std::uint32_t lane = world::none;  ///< its own
    double end = 0;                    ///< [m] along that: from there on it comes back
    double pace = 0;                   ///< [m/s] at most, until it is aside
    bool joins = false;                ///< into the lane beside, where SUMO has it already
};

/// A car that traffic owns. Positions are world, metres.
struct Car {
    std::uint32_t id = 0;
    std::uint16_t model = 0;
    Origin origin = Origin::demand;
    std::string sumo;  ///< SUMO's id; empty when SUMO does not drive it (parked, on a trajectory)
    void* in_sumo = nullptr;    ///< what it is there, once looked up: see vehicle_lookup.h
    std::uint32_t entries = 0;  ///< times that it was put into SUMO, under another id each time

    // As of the last SUMO step.
    std::uint32_t lane = world::none;
    double lane_position = 0;  ///< [m] of the front bumper, in SUMO's measure of the lane
    double speed = 0;
    double acceleration = 0;
    std::uint16_t lamps = 0;
    Eigen::Vector3d sumo_front = Eigen::Vector3d::Zero();  ///< where SUMO believes the bumper
    Eigen::Vector2d slip = Eigen::Vector2d::Zero();        ///< [m] shown minus SUMO's, world
    Trail trail;
    Eigen::Vector3d rear = Eigen::Vector3d::Zero();  ///< the origin: ground below the rear axle
    double yaw = 0;
    Eigen::Vector2d ahead = Eigen::Vector2d::UnitX();  ///< of that yaw
    double pitch = 0;
    std::uint32_t standing_ticks = 0;
    std::uint32_t stuck_ticks = 0;  ///< as those, but creeping by a hand's breadth is no way out
    double stuck_from = 0;          ///< [m] of its trail, where it got stuck

    // What SUMO was told last of how it may drive.
    double aside_wanted = 0;    ///< [m/s] sideways, by its last ordered change of lanes; 0: none
    double aside_limit = -1;    ///< [m/s] sideways; negative: what its type says
    double bend_limit = 0;      ///< [m/s] for a bend of its lane; 0: none
    int lane_change_mode = -1;  ///< SUMO's bits, of the demand's cars; negative: nothing yet
    std::uint32_t skips = 0;    ///< [ticks] between two decisions; see decisions.h

    // Where it goes: edges, the current one first; `last_lane` is where the plan ends.
    std::vector<std::uint32_t> route;
    std::uint32_t last_lane = world::none;
    std::uint32_t draws = 0;           ///< made for its route so far
    bool dead_end = false;             ///< nothing goes on from last_lane
    bool keeps_lane = false;           ///< changes lanes where it is ordered to only
    std::vector<std::uint32_t> stops;  ///< edges of the last set_route

    std::optional<SpeedOrder> speed_order;
    std::optional<LaneOrder> lane_order;
    std::optional<OffsetOrder> offset_order;
    double offset = 0;            ///< [m] that it shows by now
    bool ignores_lights = false;  ///< red ones and stop lines

    // By the scenario's word; see placements.h.
    std::optional<world::Trajectory> trajectory;  ///< says where it is
    std::uint64_t trajectory_start = 0;           ///< tick of its time 0
    std::vector<world::CommandT> waiting;         ///< orders for when SUMO drives it again
    std::uint64_t held_in = 0;                    ///< tick in which SUMO must hold its speed

    bool held_back = false;  ///< by what it sees on its way; see lookout.h
    bool boxed_in = false;   ///< so close behind a thing that it cannot pull out; see pulling_out.h
    std::optional<PassOrder> pass;

    // Among others of SUMO's; see meetings.h and standoffs.h.
    std::vector<std::uint32_t> waits_for;   ///< ids of those whom it lets go first
    std::vector<std::uint32_t> blocked_by;  ///< ids of those who stand in its way, for long
    std::vector<std::uint32_t>
        pushes_past;                  ///< ids of those who stand in its way, and it in theirs
    std::uint64_t pushes_until = 0;   ///< tick; until then it stops for none of these
    bool leans = false;               ///< aside in its lane, for whom it pushes past
    std::uint64_t brushes_until = 0;  ///< tick; until then it stops for no body beside its way
    std::uint64_t wedged_until = 0;   ///< tick; a vehicle stands at its flank, which it would hit
    bool ignores_standing = false;    ///< SUMO was told so
    std::uint64_t lets_in_until = 0;  ///< tick; until then it stops before that way through
    std::uint32_t lets_in_way = world::none;  ///< a junction, by which another one comes

    // For vehicles with their blue lamps on; see rescue_lane.h and blue_lamps.h.
    bool on_call = false;                ///< its own are on, as of the last tick
    bool goes_first = false;             ///< SUMO was told so
    bool makes_way = false;              ///< for another one: it drives aside
    double way_speed = world::infinity;  ///< [m/s] at most in this tick

    void turn_to(double new_yaw) {
        yaw = new_yaw;
        ahead = world::ahead_of(new_yaw);
    }
};

/// SUMO has it in its lane, and it is not there, or not yet: of its own will, not by order.
inline bool passes_or_comes_back(const Car& car) {
    constexpr double beside = 0.6;  // [m]
    return car.pass ||
           (car.origin == Origin::demand && car.offset_order && std::abs(car.offset) > beside);
}

}  // namespace reprise::traffic
