#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/words/handles.h"
#include "scripting/words/obedience.h"
#include "scripting/words/vocabulary.h"
#include "world/frames.h"
#include "world/lanes/planner.h"
#include "world/units.h"

// What it must do: steer one's speed so that two actors come to their points at the same time.
// What it assumes: the other one goes on as fast as it is, and both take the shortest way.
// How it goes: tick by tick, from what is left of both ways; a speed to hold is said each time, so
//   the trace has all of it.
// What it keeps: nothing; the prelude's arrive_together hands back what was left a tick ago.
namespace reprise::scripting {

namespace {

constexpr Key arrive_key_rows[] = {
    {"speed", "number", "[m/s] when they arrive"},
    {"speed_kmh", "number", "[km/h] the same"},
    {"timeout", "number", "[s] to give up after; default never, unless both stand for a minute"},
};

using world::CommandKind;
using world::Driver;

constexpr const char* arrival = "arrive_together";
constexpr double met_within = 0.1;        // [s] apart, at most
constexpr double slowest_mover = 0.1;     // [m/s] below it nobody comes nearer
constexpr double fastest_walk = 12;       // [m/s]
constexpr double fastest_drive = 60;      // [m/s]
constexpr double change_of_speed = 3;     // [m/s^2]
constexpr double foresight = 0.5;         // [s] of a speed that is on its way to another one
constexpr double beside_lane = 0.5;       // [m] a point may lie beyond a lane's edge
constexpr double lost_way = 5;            // [m] that a way grows by who has left it for a moment
constexpr double patience_standing = 60;  // [s] with both of them

/// Where one of them is to come.
struct Goal {
    Eigen::Vector3d p_world{0, 0, 0};
    std::optional<world::LanePlace> place;  ///< where it was named so
};

/// One of both, and how far it has to go.
struct Comer {
    const Actor* actor;
    Body body;
    double left = 0;  ///< [m]

    /// [s] at the present speed
    double time() const {
        return body.speed > slowest_mover ? std::max(left, 0.0) / body.speed : world::infinity;
    }
};

/// { 3, 4 }, { x = 3, y = 4 } or { lane =, s = } at this index.
Goal goal_at(Run& run, lua_State* L, int index) {
    Goal goal;
    if (lua_type(L, index) != LUA_TTABLE)
        refuse(arrival,
               "the point must be { x, y } or { lane =, s = }, or one for each: { a =, b = }");
    const bool listed = lua_rawgeti(L, index, 1) != LUA_TNIL;
    lua_pop(L, 1);
    if (listed) {
        for (int i = 0; i < 2; ++i) {
            lua_rawgeti(L, index, i + 1);
            goal.p_world[i] = number_at(L, -1, arrival, i == 0 ? "x" : "y");
            lua_pop(L, 1);
        }
        return goal;
    }
    const Fields fields(L, index, arrival, {"x", "y", "lane", "s"});
    const auto lane = fields.text("lane");
    const auto x = fields.number("x");
    const auto y = fields.number("y");
    const auto s = fields.number("s");
    if (lane ? (!s || x || y) : (!x || !y || s))
        refuse(arrival,
               "the point must be { x, y } or { lane =, s = }, or one for each: { a =, b = }");
    if (!lane) {
        goal.p_world = {*x, *y, 0};
        return goal;
    }
    const std::uint32_t index_of_lane = run.lane_named(L, *lane);
    const double length = run.town.lanes[index_of_lane].length;
    if (*s < 0 || *s > length)
        refuse(arrival, fmt::format("'s' must be in [0, {:.1f}] m, got {}", length, *s));
    goal.place = world::LanePlace{index_of_lane, *s};
    goal.p_world = world::point_at(run.town.lanes[index_of_lane], *s).position;
    return goal;
}

/// The point of both, or of each: { a = ..., b = ... }.
Goal goal_of(Run& run, lua_State* L, int index, const char* key) {
    if (lua_type(L, index) == LUA_TTABLE) {
        const int top = lua_gettop(L);
        lua_pushstring(L, key);
        if (lua_rawget(L, index) != LUA_TNIL) {
            Fields(L, index, arrival, {"a", "b"});
            const Goal goal = goal_at(run, L, top + 1);
            lua_settop(L, top);
            return goal;
        }
        lua_settop(L, top);
    }
    return goal_at(run, L, index);
}

/// Places on lanes for cars where a point lies, whatever their height.
std::vector<world::LanePlace> places_at(const Run& run, const Eigen::Vector3d& p_world) {
    std::vector<world::LanePlace> places;
    for (const std::uint32_t lane : run.lanes.near(p_world, beside_lane)) {
        const world::LaneT& there = run.town.lanes[lane];
        if (!world::is_for_cars(there))
            continue;
        const world::LaneProjection at = world::project(there, p_world);
        const Eigen::Vector3d middle = world::point_at(there, at.s).position;
        if ((middle - p_world).head<2>().norm() <= there.width / 2 + beside_lane)
            places.push_back({lane, at.s});
    }
    return places;
}

/// [m] along the lanes, of the shortest way to any of these places; none: no way leads there.
std::optional<double> way_along_lanes(Run& run,
                                      lua_State* L,
                                      const Body& body,
                                      const std::vector<world::LanePlace>& places) {
    const world::LaneT& here = run.town.lanes[body.lane];
    const double s = world::project(here, body.position).s;
    // A car of traffic is on the lane of its front bumper before its rear axle is.
    const world::LanePoint start = world::point_at(here, 0);
    const Eigen::Vector2d along(std::cos(start.yaw), std::sin(start.yaw));
    const double behind =
        s > 0 ? 0 : std::max((start.position - body.position).head<2>().dot(along), 0.0);
    const world::Planner planner(run.town);
    std::optional<double> least;
    for (const world::LanePlace& place : places) {
        run.vm.charge(L, run.town.lanes.size() * 20);
        const auto route = planner.plan({body.lane, s}, place);
        if (route && (!least || route->length + behind < *least))
            least = route->length + behind;
    }
    return least;
}

/// [m] as the crow flies, along its heading once it is near.
double straight_way(const Body& body, const Eigen::Vector3d& p_world) {
    constexpr double near = 3;  // [m]
    const Eigen::Vector2d way = (p_world - body.position).head<2>();
    const double ahead = way.dot(body.ahead().head<2>());
    return way.norm() < near || ahead < 0 ? ahead : way.norm();
}

/// What is left of the way; `before`: a tick ago, where that is known.
double left_of_way(
    Run& run, lua_State* L, const Comer& comer, const Goal& goal, std::optional<double> before) {
    if (comer.actor->is_walker() || comer.body.lane == world::none ||
        !world::is_for_cars(run.town.lanes[comer.body.lane]))
        return straight_way(comer.body, goal.p_world);
    const std::vector<world::LanePlace> places =
        goal.place ? std::vector{*goal.place} : places_at(run, goal.p_world);
    if (places.empty())
        refuse(arrival,
               fmt::format("no lane for cars is at ({:.1f}, {:.1f}), where '{}' is to come",
                           goal.p_world.x(),
                           goal.p_world.y(),
                           comer.actor->name));
    const std::optional<double> way = way_along_lanes(run, L, comer.body, places);
    if (before) {
        const double expected = *before - comer.body.speed * run.step;
        if (!way || *way > expected + lost_way)
            return expected;
    }
    if (!way)
        refuse(arrival, fmt::format("no way leads '{}' to its point", comer.actor->name));
    return *way;
}

Comer comer_at(Run& run, lua_State* L, int index, const Goal& goal, std::optional<double> before) {
    const Actor& actor = actor_at(run, L, index, arrival);
    if (actor.driver == Driver::parked)
        refuse(arrival, "'" + actor.name + "' is parked and never comes");
    Comer comer{&actor, run.look_at(actor)};
    comer.left = left_of_way(run, L, comer, goal, before);
    return comer;
}

std::optional<double> left_before(lua_State* L, int index) {
    return lua_type(L, index) == LUA_TNUMBER ? std::optional(lua_tonumber(L, index)) : std::nullopt;
}

/// A speed, and in how many seconds.
struct SpeedIn {
    double speed = 0;
    double duration = 0;
};

/// With which `left` metres are covered in `time` seconds, at `final_speed` at last.
SpeedIn wanted(double left, double speed, double time, std::optional<double> final_speed) {
    if (!final_speed) {
        const double even = left / time;
        return {even, std::abs(even - speed) / change_of_speed};
    }
    if (time < foresight)
        return {*final_speed, time};
    // The cubic that is there in time, as fast as it should be.
    const double start = 6 * left / (time * time) - (4 * speed + 2 * *final_speed) / time;
    const double jerk = 2 * (*final_speed - speed - start * time) / (time * time);
    return {speed + start * foresight + jerk * foresight * foresight / 2, foresight};
}

void say_speed(Run& run, lua_State* L, const Comer& comer, SpeedIn to) {
    const bool walks = comer.actor->is_walker();
    const CommandKind kind = walks ? CommandKind::set_speed : CommandKind::hold_speed;
    world::CommandT& command = run.say(L, kind, comer.actor->id);
    command.speed = std::clamp(to.speed, 0.0, walks ? fastest_walk : fastest_drive);
    if (walks)
        return;
    command.on = true;
    command.duration = to.duration < run.step ? 0 : to.duration;
    command.shape = command.duration > 0 ? world::Shape::linear : world::Shape::sinusoidal;
}

/// Where its way says that it is? Who has left the way for good comes to no point.
bool is_on_way(const Run& run, const Comer& comer, const Goal& goal) {
    const double away = (goal.p_world - comer.body.position).head<2>().norm();
    return away <= std::max(comer.left, 0.0) + lost_way + std::abs(comer.body.speed) * run.step;
}

/// (..., began, moved): since when it is tried, and the last tick in which one of both moved.
bool gives_up(const Run& run, lua_State* L, const Fields& options) {
    const std::optional<double> timeout = options.number("timeout");
    if (timeout && (*timeout < 0 || *timeout > 1e9))
        refuse(arrival, "'timeout' must be in [0, 1e9] s");
    const auto since = [&](int index) {
        return run.now() - static_cast<std::uint64_t>(lua_tointeger(L, index));
    };
    return (timeout && since(7) >= ticks_of(*timeout, run.episode.step_ns)) ||
           since(8) >= ticks_of(patience_standing, run.episode.step_ns);
}

/// (a, b, point, options, left_a, left_b, began, moved): one tick. Returns whether it is over,
/// whether they meet as it stands, how far apart in time they are, what is left for both, and
/// whether one of them moves. Nothing but true where they have hit each other on the way: what was
/// said last holds.
int steer_together(Run& run, lua_State* L) {
    lua_settop(L, 8);
    const Actor& steered = driven(run, L, arrival);
    if (steered.is_walker() && !steered.walks)
        refuse(arrival, "'" + steered.name + "' stands: tell it first where to walk");
    const Fields options(L, 4, arrival, names_of(arrive_key_rows), true);
    const std::optional<double> final_speed = options.speed();
    const Goal goal_a = goal_of(run, L, 3, "a");
    const Goal goal_b = goal_of(run, L, 3, "b");
    const Comer a = comer_at(run, L, 1, goal_a, left_before(L, 5));
    const Comer b = comer_at(run, L, 2, goal_b, left_before(L, 6));
    if (a.actor == b.actor)
        refuse(arrival, "needs two actors");
    if (left_before(L, 5) && a.actor->contacts.others.count(b.actor->id) != 0) {
        lua_pushboolean(L, 1);
        return 1;
    }
    const bool there = std::min(a.time(), b.time()) <= run.step || a.left <= 0 || b.left <= 0;
    const bool over = there || gives_up(run, L, options);
    const bool both_come = is_on_way(run, a, goal_a) && is_on_way(run, b, goal_b);
    const double apart = both_come ? std::abs(a.time() - b.time()) : world::infinity;
    if (!over && !std::isinf(b.time()))
        say_speed(run, L, a, wanted(a.left, a.body.speed, b.time(), final_speed));
    lua_pushboolean(L, over ? 1 : 0);
    const bool gave_up = over && !there;
    lua_pushboolean(L, !gave_up && apart <= met_within ? 1 : 0);  // not for NaN: both stand
    lua_pushnumber(L, std::isnan(apart) ? world::infinity : apart);
    lua_pushnumber(L, a.left);
    lua_pushnumber(L, b.left);
    lua_pushboolean(L, std::isinf(a.time()) && std::isinf(b.time()) ? 0 : 1);
    return 6;
}

constexpr Word meeting_rows[] = {
    {"arrive_together",
     nullptr,
     "(a: Actor, b: Actor, point: table, options?: ArriveOptions): boolean, number",
     "steers a so that both come to the point at once; waits: met within 0.1 s, and how far apart; "
     "false where it gives up"},
};

}  // namespace

constinit const WordList meeting_words{Owner::global, "Arriving together", meeting_rows};
constinit const KeyList arrive_keys{"ArriveOptions", "arrive_together", arrive_key_rows};

void add_meeting_words(lua_State* L) {
    add_words(L, meeting_words);
    add_function(L, "_steer_together", commanding<steer_together>);  // for the prelude
}

}  // namespace reprise::scripting
