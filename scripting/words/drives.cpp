#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/lua/text.h"
#include "scripting/run/caps.h"
#include "scripting/run/places.h"
#include "scripting/run/stops.h"
#include "scripting/words/handles.h"
#include "scripting/words/obedience.h"
#include "scripting/words/vocabulary.h"
#include "world/frames.h"
#include "world/lanes/planner.h"

// What an actor can be told. Every word becomes one command in the tick.
namespace reprise::scripting {

namespace {

using world::CommandKind;
using world::Driver;

constexpr lua_Integer few_stops = 10;  ///< of a route that anybody would write
constexpr std::uint64_t leg_cost = 5;  ///< [instructions] a lane, of a way from stop to stop

/// A car that is sent somewhere: another program's, too, which reads in the tick where to.
Actor& sent_car(Run& run, lua_State* L, const char* who) {
    Actor& actor = actor_at(run, L, 1, who);
    return actor.driver == Driver::external ? actor : driver_of_car(run, L, who);
}

/// Where it is, if on a lane for cars.
std::optional<world::LanePlace> place_of(Run& run, const Actor& actor) {
    const Body body = run.look_at(actor);
    if (body.lane == world::none || !world::is_for_cars(run.town.lanes[body.lane]))
        return std::nullopt;
    return world::LanePlace{body.lane, world::project(run.town.lanes[body.lane], body.position).s};
}

world::Planner planner_for(const Run& run, const Actor& actor) {
    return world::Planner(
        run.town, actor.keeps_lane ? world::LaneChanges::forbidden : world::LaneChanges::allowed);
}

/// From here on it is watched how much of the way it has driven.
void note_route(Run& run,
                lua_State* L,
                Actor& actor,
                std::optional<world::LanePlace> here,
                const std::vector<std::uint32_t>& stops) {
    actor.route.reset();
    run.forget_way(actor);
    if (!here)
        return;
    run.vm.charge(L, stops.size() * run.town.lanes.size() * leg_cost);
    auto route = world::plan_over(
        planner_for(run, actor), *here, stops, run.town.lanes[stops.back()].length);
    if (route)
        actor.route.emplace(std::move(*route));
}

/// The list of lanes and edges that is the second argument.
std::vector<StopLanes> stops_at(Run& run, lua_State* L) {
    if (lua_type(L, 2) != LUA_TTABLE || lua_rawlen(L, 2) == 0)
        refuse("set_route", "needs a list of lanes or edges: ego:set_route{ 'a1_b1', 'b1_b2' }");
    std::vector<StopLanes> stops;
    const auto count = static_cast<lua_Integer>(lua_rawlen(L, 2));
    if (count > static_cast<lua_Integer>(longest_route))
        refuse("set_route", fmt::format("a route of more than {} lanes and edges", longest_route));
    for (lua_Integer i = 1; i <= count; ++i) {
        lua_rawgeti(L, 2, i);
        // An edge is looked for among all lanes.
        run.vm.charge(L, 50 + run.town.lanes.size());
        // The kernel plans a way from each to the next.
        if (i > few_stops)
            run.vm.charge(L, run.town.lanes.size() * 20);
        stops.push_back(
            stop_named(run.town, text_at(L, -1, "set_route", fmt::format("entry {}", i))));
        if (const world::LaneT& stop = run.town.lanes[stops.back().front()];
            !world::is_for_cars(stop))
            refuse("set_route", fmt::format("entry {}: {}", i, not_for_cars(run.town, stop)));
        lua_pop(L, 1);
    }
    return stops;
}

int set_route(Run& run, lua_State* L) {
    Actor& actor = sent_car(run, L, "set_route");
    const std::vector<StopLanes> stops = stops_at(run, L);
    const std::optional<world::LanePlace> here = place_of(run, actor);
    run.vm.charge(L, searches_for(stops) * run.town.lanes.size() * leg_cost);
    std::vector<std::uint32_t> lanes = choose_lanes(run.town, planner_for(run, actor), here, stops);
    world::CommandT& command = run.say(L, CommandKind::set_route, actor.id);
    command.s = run.town.lanes[lanes.back()].length;
    note_route(run, L, actor, here, lanes);
    command.lanes = std::move(lanes);
    return 0;
}

std::string wanted_lane(const Fields& fields) {
    const auto lane = fields.text("lane");
    if (!lane)
        refuse("route_to", "needs a lane: ego:route_to{ lane = 'b1_b2_1', s = 30 }");
    return *lane;
}

constexpr Key route_key_rows[] = {
    {"lane", "LaneName", "where to", true},
    {"s", "number", "[m] along it; default its end"},
};

int route_to(Run& run, lua_State* L) {
    Actor& actor = sent_car(run, L, "route_to");
    const Fields fields(L, 2, "route_to", names_of(route_key_rows));
    const std::uint32_t lane = run.lane_named(L, wanted_lane(fields));
    const world::LaneT& goal = run.town.lanes[lane];
    if (goal.kind != world::LaneKind::driving)
        refuse("route_to", not_for_cars(run.town, goal));
    const double s = fields.number("s").value_or(goal.length);
    if (!(s >= 0 && s <= goal.length))
        refuse("route_to", fmt::format("'s' must be in [0, {:.1f}] m, got {}", goal.length, s));
    const Body body = run.look_at(actor);
    if (body.lane == world::none || !world::is_for_cars(run.town.lanes[body.lane]))
        refuse("route_to", "'" + actor.name + "' is on no lane");
    run.vm.charge(L, run.town.lanes.size() * 20);
    const world::LaneT& here = run.town.lanes[body.lane];
    const auto changes =
        actor.keeps_lane ? world::LaneChanges::forbidden : world::LaneChanges::allowed;
    auto route = world::Planner(run.town, changes)
                     .plan({body.lane, world::project(here, body.position).s}, {lane, s});
    if (!route)
        refuse("route_to",
               fmt::format("no way leads from '{}' to '{}'{}",
                           here.name,
                           goal.name,
                           actor.keeps_lane ? " without a change of lanes" : ""));
    world::CommandT& command = run.say(L, CommandKind::set_route, actor.id);
    command.lanes = {lane};
    command.s = s;
    lua_pushnumber(L, route->length);
    actor.route.emplace(std::move(*route));
    run.forget_way(actor);
    return 1;
}

/// { 3, 4 } or { x = 3, y = 4 } at the top of the stack.
Eigen::Vector3d point_at_top(lua_State* L, const char* who) {
    if (lua_type(L, -1) != LUA_TTABLE)
        refuse(who, "'to' must be a point: to = { x, y }");
    Eigen::Vector3d point(0, 0, 0);
    for (int i = 0; i < 2; ++i) {
        if (lua_rawgeti(L, -1, i + 1) == LUA_TNIL) {
            lua_pop(L, 1);
            lua_pushstring(L, i == 0 ? "x" : "y");
            lua_rawget(L, -2);
        }
        point[i] = number_at(L, -1, who, i == 0 ? "x" : "y");
        lua_pop(L, 1);
    }
    return point;
}

void say_walk(Run& run,
              lua_State* L,
              Actor& actor,
              const Eigen::Vector3d& target,
              const Fields& fields,
              bool by_map) {
    const double speed = fields.speed().value_or(0);  // 0: the model's own
    if (speed > 12)
        refuse(fields.who(), "nobody runs faster than 12 m/s");
    world::CommandT& command = run.say(L, CommandKind::walk, actor.id);
    command.target = world::to_vec3(target);
    command.speed = speed;
    command.on = by_map;
    actor.walks = true;
}

/// By the walk map, or straight?
bool goes_by_map(const Fields& fields) {
    const std::string by = fields.text("by").value_or("straight");
    if (by != "map" && by != "straight")
        refuse(fields.who(),
               fmt::format("'by' must be 'map' or 'straight', got '{}'{}",
                           by,
                           world::did_you_mean(by, {"map", "straight"})));
    return by == "map";
}

Actor& walking(Run& run, lua_State* L, const char* who) {
    Actor& actor = actor_at(run, L, 1, who);
    if (!actor.is_walker())
        refuse(who, "'" + actor.name + "' is no walker");
    return actor;
}

constexpr Key walk_key_rows[] = {
    {"to", "number[]|{x: number, y: number}", "[m] the point in the world", true},
    {"speed", "number", "[m/s] default the model's own"},
    {"speed_kmh", "number", "[km/h] the same"},
};

constexpr Key walk_to_key_rows[] = {
    {"x", "number", "[m] in the world, with y"},
    {"y", "number", "[m] in the world, with x"},
    {"lane", "LaneName", "or a place on this lane"},
    {"s", "number", "[m] along it; default 0"},
    {"offset", "number", "[m] to the left of its centre line; default 0"},
    {"across", "LaneName", "or the far side of this lane's road"},
    {"by",
     "'map'|'straight'",
     "'map': by sidewalks and crossings, over the road where that saves a lot; default 'straight'"},
    {"speed", "number", "[m/s] default the model's own"},
    {"speed_kmh", "number", "[km/h] the same"},
};

int walk(Run& run, lua_State* L) {
    Actor& actor = walking(run, L, "walk");
    const Fields fields(L, 2, "walk", names_of(walk_key_rows));
    fields.push("to");
    const Eigen::Vector3d target = point_at_top(L, "walk");
    say_walk(run, L, actor, target, fields, false);
    return 0;
}

int walk_to(Run& run, lua_State* L) {
    Actor& actor = walking(run, L, "walk_to");
    const Fields fields(L, 2, "walk_to", names_of(walk_to_key_rows));
    const auto across = fields.text("across");
    const auto lane = fields.text("lane");
    const auto x = fields.number("x");
    const auto y = fields.number("y");
    if ((across ? 1 : 0) + (lane ? 1 : 0) + (x && y ? 1 : 0) != 1 || x.has_value() != y.has_value())
        refuse("walk_to", "needs { x, y }, { lane, s, offset } or { across = lane }");
    if (!lane && (fields.has("s") || fields.has("offset")))
        refuse("walk_to", "'s' and 'offset' need a 'lane'");
    const Body body = *body_of(run.last, actor);
    Eigen::Vector3d target(x.value_or(0), y.value_or(0), body.position.z());
    if (across)
        target = across_road(run.town, run.lane_named(L, *across), body.position);
    if (lane) {
        const world::LanePoint at = world::point_at(run.town.lanes[run.lane_named(L, *lane)],
                                                    fields.number("s").value_or(0));
        target = world::pose(world::to_vec3(at.position), at.yaw, 0) *
                 Eigen::Vector3d(0, fields.number("offset").value_or(0), 0);
    }
    say_walk(run, L, actor, target, fields, goes_by_map(fields));
    return 0;
}

double in_range(const Fields& fields, const char* key, double low) {
    const double value = fields.number(key).value_or(0);
    if (value < low || value > 1)
        refuse("control", fmt::format("'{}' must be in [{}, 1], got {}", key, low, value));
    return value;
}

constexpr Key control_key_rows[] = {
    {"throttle", "number", "[0, 1] default 0"},
    {"brake", "number", "[0, 1] default 0"},
    {"steer", "number", "[-1, 1] to the left; default 0"},
    {"hand_brake", "boolean", "default false"},
    {"reverse", "boolean", "default false"},
};

int control(Run& run, lua_State* L) {
    const Actor& actor = actor_at(run, L, 1, "control");
    if (actor.driver != Driver::manual)
        refuse("control", "'" + actor.name + "' has a driver: spawn it with driver = 'manual'");
    const Fields fields(L, 2, "control", names_of(control_key_rows));
    const world::Control said(in_range(fields, "throttle", 0),
                              in_range(fields, "brake", 0),
                              in_range(fields, "steer", -1),
                              actor.id,
                              std::uint16_t{0},
                              fields.flag("hand_brake").value_or(false),
                              fields.flag("reverse").value_or(false));
    run.say(L, CommandKind::control, actor.id).control = said;
    return 0;
}

int despawn(Run& run, lua_State* L) {
    Actor& actor = actor_at(run, L, 1, "despawn");
    run.say(L, CommandKind::despawn, actor.id);
    actor.is_leaving = true;
    return 0;
}

constexpr Word order_rows[] = {
    {"set_route",
     commanding<set_route>,
     "(stops: LaneOrEdgeName[])",
     "lanes or edges to pass in this order"},
    {"route_to",
     commanding<route_to>,
     "(goal: RouteOptions): number",
     "the shortest way there, planned now; its length [m]"},
    {"walk", commanding<walk>, "(options: WalkOptions)", "a walker: in a straight line"},
    {"walk_to",
     commanding<walk_to>,
     "(options: WalkToOptions)",
     "a walker: to a point, a place on a lane, or across a road"},
    {"control",
     commanding<control>,
     "(controls: ControlOptions)",
     "of driver = 'manual': the pedals and the wheel, until the next one"},
    {"despawn", commanding<despawn>, "()", "takes it out of the world"},
};

}  // namespace

Actor& driven(Run& run, lua_State* L, const char* who) {
    Actor& actor = actor_at(run, L, 1, who);
    const char* why_not = actor.driver == Driver::parked     ? "parked"
                          : actor.driver == Driver::manual   ? "driven by hand"
                          : actor.driver == Driver::external ? "driven by another program"
                          : actor.driver == Driver::prop     ? "a prop"
                                                             : nullptr;
    if (why_not != nullptr)
        refuse(
            who,
            fmt::format(
                "'{}' is {}: only 'autopilot', 'traffic' and walkers obey", actor.name, why_not));
    return actor;
}

Actor& driver_of_car(Run& run, lua_State* L, const char* who) {
    Actor& actor = driven(run, L, who);
    if (actor.is_walker())
        refuse(who, "'" + actor.name + "' is a walker");
    return actor;
}

void want_overtaker(const char* who, const Actor& actor) {
    if (actor.driver != world::Driver::autopilot)
        refuse(who,
               fmt::format("overtaking is for driver = 'autopilot': '{}' is driven as '{}'",
                           actor.name,
                           world::EnumNameDriver(actor.driver)));
    if (actor.pilot == world::Pilot::pid)
        refuse(who, fmt::format("'{}' has pilot = 'pid', which overtakes nobody", actor.name));
}

constinit const WordList actor_orders{Owner::actor, "Actors: orders", order_rows};
constinit const KeyList route_keys{"RouteOptions", "route_to", route_key_rows};
constinit const KeyList walk_keys{"WalkOptions", "walk", walk_key_rows};
constinit const KeyList walk_to_keys{"WalkToOptions", "walk_to", walk_to_key_rows};
constinit const KeyList control_keys{"ControlOptions", "control", control_key_rows};

void add_drive_words(lua_State* L) {
    add_words(L, actor_orders);
    add_motion_words(L);
}

}  // namespace reprise::scripting
