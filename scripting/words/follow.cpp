#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/lua/text.h"
#include "scripting/words/handles.h"
#include "scripting/words/trajectory_points.h"
#include "scripting/words/vocabulary.h"
#include "scripting/words/where.h"
#include "world/frames.h"
#include "world/trajectory.h"
#include "world/units.h"

// Where an actor is by the scenario's word: trajectories, teleports, velocities.
namespace reprise::scripting {

namespace {

constexpr Key follow_key_rows[] = {
    {"from", "'start'", "times are those of time(); default: from now"},
    {"teleport", "boolean", "is put at the first point"},
};

constexpr Key teleport_key_rows[] = {
    {"speed", "number", "[m/s] default: as it was"},
    {"speed_kmh", "number", "[km/h] the same"},
    {"lane", "LaneName|'left'|'right'|'same'", "as of spawn"},
    {"s", "number", "[m] along the lane"},
    {"offset", "number", "[m] to the left of its centre line"},
    {"x", "number", "[m] of a pose, east"},
    {"y", "number", "[m] of a pose, north"},
    {"z", "number", "[m] where roads lie above each other"},
    {"heading_deg", "number", "counter-clockwise from east"},
    {"ahead_of", "Actor", "along the road from that one"},
    {"behind", "Actor", "likewise, behind it"},
    {"beside", "Actor", "abreast, in the lane beside"},
    {"gap", "number", "[m] from bumper to bumper"},
};

using world::CommandKind;
using world::Driver;

constexpr double fastest_vehicle = 150;  // [m/s]
constexpr double fastest_walker = 12;    // [m/s]
constexpr double at_the_start = 0.1;     // [m] an actor that is so near a point is there

/// Whoever is put somewhere must be able to move.
Actor& movable(Run& run, lua_State* L, const char* who) {
    Actor& actor = actor_at(run, L, 1, who);
    if (actor.driver == Driver::parked)
        refuse(who, fmt::format("'{}' is parked, and never moves", actor.name));
    if (actor.is_prop())
        refuse(who, fmt::format("'{}' is a prop: take it away and spawn another one", actor.name));
    return actor;
}

bool follows(const Run& run, const Actor& actor) {
    if (actor.follows_until <= run.now())
        return false;
    const auto* walker = actor.is_walker() ? world::find(run.last.walkers(), actor.id) : nullptr;
    return walker == nullptr || !walker->down();  // who lies goes nowhere
}

void want_unled(const Run& run, const Actor& actor, const char* who) {
    if (follows(run, actor))
        refuse(who,
               fmt::format("'{}' follows a trajectory until {:.2f} s: end it first with "
                           "{}:follow(false)",
                           actor.name,
                           static_cast<double>(actor.follows_until) * run.step,
                           actor.name));
}

double fastest_of(const Actor& actor) {
    return actor.is_walker() ? fastest_walker : fastest_vehicle;
}

void want_speed(const char* who, const Actor& actor, double speed) {
    // Whoever is driven by forces can roll backwards; SUMO's cars and walkers only go ahead.
    const double least = actor.is_driven() ? -fastest_vehicle : 0;
    if (speed < least || speed > fastest_of(actor))
        refuse(who,
               fmt::format("the speed of '{}' must be in [{}, {}] m/s, got {}",
                           actor.name,
                           number_text(least),
                           number_text(fastest_of(actor)),
                           number_text(speed)));
}

// --- Trajectories.

/// The times of `from = 'start'` are those of the run's clock; else they begin now.
void count_from_now(const Run& run, const Fields& options, std::vector<SaidPoint>& points) {
    const auto from = options.text("from");
    const double now = static_cast<double>(run.now()) * run.step;
    if (from && *from != "start" && *from != "now")
        refuse("follow",
               fmt::format("'from' must be 'now' or 'start', got '{}'{}",
                           *from,
                           world::did_you_mean(*from, {"now", "start"})));
    if (from.value_or("now") == "start")
        for (SaidPoint& point : points)
            point.time -= now;
    else if (points.front().time < 0)
        refuse(
            "follow",
            fmt::format("{}: t = {} is before now; with from = 'start' times are those of time()",
                        points.front().where,
                        number_text(points.front().time)));
    if (points.back().time < run.step)
        refuse("follow",
               fmt::format("the trajectory ends at t = {} s, before the next tick: nothing is left "
                           "of it",
                           number_text(points.back().time)));
}

/// Headings as said; where some are left out, those of the way through the points.
bool fill_headings(std::vector<SaidPoint>& points, std::vector<world::PathPoint>& path) {
    const auto said = std::count_if(
        points.begin(), points.end(), [](const SaidPoint& point) { return point.heading; });
    const bool has_headings = said > 0;
    for (const SaidPoint& point : points)
        path.emplace_back(world::to_vec3(point.p_world), 0, point.time);
    if (!has_headings)
        return false;
    const world::Trajectory way(path, false);
    std::optional<double> last = way.first_heading();
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!points[i].heading)
            points[i].heading = way.at(points[i].time).heading;
        last = points[i].heading ? points[i].heading : last;
        path[i].mutate_heading(world::wrap_angle(last.value_or(0)));
    }
    return true;
}

/// From one to the next nobody goes faster than it could be.
void want_possible(const Actor& actor, const std::vector<SaidPoint>& points) {
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double way = (points[i].p_world - points[i - 1].p_world).head<2>().norm();
        const double speed = way / (points[i].time - points[i - 1].time);
        if (speed > fastest_of(actor))
            refuse("follow",
                   fmt::format("from {} to {} '{}' would go {:.1f} m in {} s, {:.1f} m/s: at most "
                               "{} m/s",
                               points[i - 1].where,
                               points[i].where,
                               actor.name,
                               way,
                               number_text(points[i].time - points[i - 1].time),
                               speed,
                               number_text(fastest_of(actor))));
    }
}

/// It begins where the actor is, or says that it is put there.
void want_start(
    Run& run, const Actor& actor, const Body& body, bool teleport, std::vector<SaidPoint>& points) {
    constexpr double rounding = 1e-9;  // [s]
    if (points.front().time > rounding) {
        if (teleport)
            refuse("follow",
                   fmt::format("'teleport' needs a point at t = 0, {} has t = {}",
                               points.front().where,
                               number_text(points.front().time)));
        // It begins where it is, and heads as it does.
        SaidPoint here{0, body.position, std::nullopt, "where it is"};
        if (points.front().heading)
            here.heading = body.yaw;
        points.insert(points.begin(), here);
        return;
    }
    if (teleport || points.size() < 2)
        return;
    std::vector<world::PathPoint> path;
    for (const SaidPoint& point : points)
        path.emplace_back(world::to_vec3(point.p_world), 0, point.time);
    const Eigen::Vector3d start = world::Trajectory(path, false).at(0).position;
    const double away = (start - body.position).head<2>().norm();
    if (away > at_the_start)
        refuse("follow",
               fmt::format("'{}' is at ({:.2f}, {:.2f}), {:.2f} m from ({:.2f}, {:.2f}), where the "
                           "trajectory is at {:.2f} s: leave out the point at t = 0, so that it "
                           "begins where '{}' is, or say {{ teleport = true }}",
                           actor.name,
                           body.position.x(),
                           body.position.y(),
                           away,
                           start.x(),
                           start.y(),
                           static_cast<double>(run.now()) * run.step,
                           actor.name));
}

/// SUMO's cars drive on behind the end: there must be a lane.
void want_road_behind(Run& run, const Actor& actor, const world::Trajectory& way, double yaw) {
    constexpr double reach = 4;  // [m]
    if (actor.driver != Driver::traffic)
        return;
    const world::Trajectory::State end = way.at(way.end());
    const double heading = end.heading.value_or(way.at(way.end() - 0.5).heading.value_or(yaw));
    const Body body = *body_of(run.last, actor);
    const Eigen::Vector3d ahead(std::cos(heading), std::sin(heading), 0);
    if (!run.lanes.best(end.position + body.front * ahead, heading, reach))
        refuse("follow",
               fmt::format("'{}' would end at ({:.2f}, {:.2f}) heading {:.1f} degrees, on no lane "
                           "that leads its way: driver = 'traffic' has to drive on from there",
                           actor.name,
                           end.position.x(),
                           end.position.y(),
                           heading / world::degree));
}

/// Puts the actor there in this tick; whatever it followed has ended.
void say_teleport(
    Run& run, lua_State* L, const char* who, Actor& actor, const Place& place, double speed) {
    actor.p_world_asked = place.p_world;
    actor.asked = footprint_at(actor, place);
    want_free_place(run, L, who, actor);
    actor.displaced_at = run.now();
    actor.follows_until = 0;
    world::CommandT& command = run.say(L, CommandKind::teleport, actor.id);
    command.driver = actor.driver;
    command.model = actor.model;
    command.speed = speed;
    place.say(command);
}

void put_at_start(Run& run, lua_State* L, Actor& actor, const world::Trajectory& way, double yaw) {
    const world::Trajectory::State start = way.at(0);
    Place place;
    place.p_world = start.position;
    place.yaw = start.heading.value_or(way.first_heading().value_or(yaw));
    const Eigen::Vector2d ahead(std::cos(place.yaw), std::sin(place.yaw));
    say_teleport(run, L, "follow", actor, place, std::max(0.0, start.velocity.dot(ahead)));
}

int follow(Run& run, lua_State* L) {
    Actor& actor = movable(run, L, "follow");
    const Fields options(L, 3, "follow", names_of(follow_key_rows), true);
    if (lua_isboolean(L, 2) && lua_toboolean(L, 2) == 0) {
        actor.follows_until = 0;
        run.say(L, CommandKind::follow, actor.id);
        return 0;
    }
    const Body body = *body_of(run.last, actor);
    std::vector<SaidPoint> points = read_points(run, L, 2, body.position.z());
    count_from_now(run, options, points);
    const bool teleport = options.flag("teleport").value_or(false);
    want_start(run, actor, body, teleport, points);
    want_possible(actor, points);
    if (points.size() < 2)
        refuse("follow", "needs a second point: where to, and when");

    std::vector<world::PathPoint> path;
    const bool has_headings = fill_headings(points, path);
    const world::Trajectory way(path, has_headings);
    want_road_behind(run, actor, way, body.yaw);
    if (teleport)
        put_at_start(run, L, actor, way, body.yaw);
    actor.follows_until = run.now() + world::last_tick_of(path, run.step);
    world::CommandT& command = run.say(L, CommandKind::follow, actor.id);
    command.has_pose = has_headings;
    command.path = std::move(path);
    return 0;
}

int following(Run& run, lua_State* L) {
    lua_pushboolean(L, follows(run, actor_at(run, L, 1, "following")) ? 1 : 0);
    return 1;
}

// --- Teleports and velocities.

int teleport(Run& run, lua_State* L) {
    Actor& actor = movable(run, L, "teleport");
    const Fields fields(L, 2, "teleport", names_of(teleport_key_rows));
    const auto place = read_place(run, L, fields, actor);
    if (!place)
        refuse(
            "teleport",
            "needs a place: { lane =, s =, offset = }, { x =, y =, heading_deg = } or { ahead_of "
            "=, gap = }");
    const Body body = *body_of(run.last, actor);
    const auto said = fields.speed();
    if (said && actor.is_walker())
        refuse("teleport",
               fmt::format("'speed' has no effect on '{}', a walker: {}:set_velocity(1.5) while it "
                           "walks",
                           actor.name,
                           actor.name));
    const double speed = said.value_or(actor.is_driven() ? body.speed : std::max(0.0, body.speed));
    want_speed("teleport", actor, speed);
    say_teleport(run, L, "teleport", actor, *place, speed);
    return 0;
}

int say_velocity(Run& run, lua_State* L, const char* who, double unit) {
    Actor& actor = movable(run, L, who);
    const double speed = number_at(L, 2, who, "the speed") * unit;
    want_unled(run, actor, who);
    if (actor.is_walker() && !actor.walks)
        refuse(who,
               fmt::format("has no effect on '{}', which stands until it is told where to go: "
                           "{}:walk{{ to = {{ x, y }} }}",
                           actor.name,
                           actor.name));
    want_speed(who, actor, speed);
    run.say(L, CommandKind::set_velocity, actor.id).speed = speed;
    return 0;
}

int set_velocity(Run& run, lua_State* L) {
    return say_velocity(run, L, "set_velocity", 1);
}

int set_velocity_kmh(Run& run, lua_State* L) {
    return say_velocity(run, L, "set_velocity_kmh", 1 / 3.6);
}

/// As spawn and teleport take it.
int pose(Run& run, lua_State* L) {
    const Body body = *body_of(run.last, actor_at(run, L, 1, "pose"));
    lua_pushnumber(L, body.position.x());
    lua_pushnumber(L, body.position.y());
    lua_pushnumber(L, body.yaw / world::degree);
    lua_pushnumber(L, body.position.z());
    return 4;
}

constexpr Word placing_rows[] = {
    {"follow",
     commanding<follow>,
     "(points: table[]|string|boolean, options?: FollowOptions)",
     "is exactly at these points at their times; the name of a CSV beside the script; false ends "
     "it"},
    {"following", reading<following>, "(): boolean", "is it on a trajectory?"},
    {"teleport", commanding<teleport>, "(place: TeleportOptions)", "is put there, as by spawn"},
    {"set_velocity",
     commanding<set_velocity>,
     "(speed: number)",
     "[m/s] along its heading, at once"},
    {"set_velocity_kmh", commanding<set_velocity_kmh>, "(speed: number)", "[km/h] the same"},
    {"pose",
     reading<pose>,
     "(): number, number, number, number",
     "x, y [m], heading_deg, z [m], as spawn takes them"},
};

}  // namespace

constinit const WordList placing_words{
    Owner::actor, "Actors: trajectories and places", placing_rows};
constinit const KeyList follow_keys{"FollowOptions", "follow", follow_key_rows};
constinit const KeyList teleport_keys{"TeleportOptions", "teleport", teleport_key_rows};

void add_placing_words(lua_State* L) {
    add_words(L, placing_words);
}

}  // namespace reprise::scripting
