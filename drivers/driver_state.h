#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drivers/back_off.h"
#include "drivers/control/ego.h"
#include "drivers/control/lateral_order.h"
#include "drivers/control/pedals.h"
#include "drivers/control/pid_driver.h"
#include "drivers/control/wide_turn.h"
#include "drivers/driver_news.h"
#include "drivers/gatekeeper.h"
#include "drivers/hazards.h"
#include "drivers/navigator.h"
#include "drivers/passing.h"
#include "drivers/road_map.h"
#include "drivers/speed_order.h"
#include "drivers/to_and_fro.h"
#include "drivers/turn_around.h"
#include "world/episode_generated.h"
#include "world/models/car_model.h"

namespace reprise::drivers {

/// The parts of the built-in driver, and how they work together. Private to driver*.cpp and
/// way_back.cpp.
struct DriverState {
    DriverState(std::uint32_t actor_id,
                std::uint16_t model,
                const world::EpisodeT& episode,
                const RoadMap& road_map,
                world::Pilot pilot);

    const world::TownT& town() const { return map->town; }

    const Way& way() const { return navigator.way(); }

    bool has_tight_bends() const;
    void plan_wide_turns(const Ego& ego);
    double change_lanes(const world::TickView& last, Ego& ego);
    void begin_orders(const world::TickView& last, const Ego& ego);
    double descent(const Ego& ego) const;
    double cruise(const Ego& ego) const;
    double ordered_acceleration(const Ego& ego) const;
    double obedient_acceleration(const world::TickView& last, Ego& ego);
    double past_junction_things(const world::TickView& last, const Ego& ego);
    double look_around(const world::TickView& last, const Ego& ego);
    double turn_past(const world::TickView& last, const Ego& ego);
    double nose_up(const world::TickView& last, const Ego& ego);
    double last_resort(const world::TickView& last, const Ego& ego);
    bool is_held_from_beside(const Ego& ego) const;
    bool town_is_before(const Ego& ego, double reach) const;
    bool wheels_lead_into_town(const Ego& ego, double reach) const;
    void drive_back(const world::TickView& last, const Ego& ego, world::Control& control);
    double careful_acceleration(const world::TickView& last, Ego& ego);
    double off_line(const Ego& ego) const;
    double ended_acceleration(const Ego& ego) const;
    std::span<const SweptWidth> corridor(const Ego& ego);
    double approach_turn(const world::TickView& last, const Ego& ego);
    void resume_turn(const Ego& ego);
    void turn(const world::TickView& last, Ego& ego, world::Control& control);
    std::uint16_t lamps(const world::TickView& last, const Ego& ego) const;
    void creep(double speed, double along, double climb, world::Control& control);
    void notice_pushing(const world::TickView& last, const Ego& ego);
    void notice_circling(const world::TickView& last, const Ego& ego);
    void go_back(const world::TickView& last, Ego& ego, world::Control& control);
    void begin_to_and_fro(const Ego& ego);
    void go_to_and_fro(const world::TickView& last, const Ego& ego, world::Control& control);
    void pass(const world::TickView& last, const Ego& ego);
    void notice_standoff(const world::TickView& last, const Ego& ego);
    bool is_held_by(std::uint32_t other, const world::TickView& last, const PathPoint& there) const;
    void take_jump(const Ego& ego);
    double expected_offset() const;
    double tracked_beside(const Ego& ego) const;
    std::optional<BesidePath> beside(const Ego& ego) const;

    std::uint32_t actor;
    double step;  ///< [s] of a tick
    world::CarModel car;
    DrivingStyle style;
    const RoadMap* map;
    Navigator navigator;
    std::optional<WideTurnPlan> wide_turn;  ///< once there was a bend that needs it
    std::uint64_t wide_turn_of_way = 0;     ///< the way's plan_digest() that it was planned for
    bool has_wide_turn = false;             ///< on the way ahead
    Hazards hazards;
    Gatekeeper gatekeeper;
    Pedals pedals;
    std::optional<PidDriver> pid;  ///< drives in the place of pedals and steering
    TurnAround turn_around;
    std::uint32_t turns_into = 0;  ///< the lane behind the turn
    SpeedOrder speed_order;
    LateralOrder lateral_order;
    Passing passing;
    bool may_overtake = false;
    BackOff back_off;
    ToAndFro to_and_fro;
    std::optional<DriverNews> news;       ///< of this tick
    std::uint64_t tick = 0;               ///< the last one: not digested, nor what follows
    double rear_axle_s = 0;               ///< then
    std::vector<SweptWidth> moved_swept;  ///< beside the path
    std::uint32_t waiting_ticks = 0;      ///< beside cars on the lane that we want
    std::uint32_t standoff_ticks = 0;     ///< before somebody who cannot go on before we do
    std::uint32_t standoffs = 0;          ///< in which it made room, since it drove on
    std::uint32_t cramped_ticks = 0;      ///< without room to turn out, nor to go back for it
    std::uint32_t held_ticks = 0;         ///< before what its wheels lead into
    std::uint32_t strays = 0;             ///< off every road: how often something held it there
    std::uint32_t turner_ticks = 0;       ///< before somebody who turns where we want to
    std::uint32_t wedged_ticks = 0;       ///< beside somebody whom it could creep past
    std::uint32_t nosing_ticks = 0;       ///< in a tight turn, before somebody across its way
    bool at_end = false;                  ///< follows from the last tick and the way: not digested
};

}  // namespace reprise::drivers
