#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/lua/text.h"
#include "scripting/words/caps.h"
#include "scripting/words/handles.h"
#include "scripting/words/places.h"
#include "scripting/words/rig.h"
#include "scripting/words/vocabulary.h"
#include "world/models/catalogue.h"
#include "world/models/prop_models.h"
#include "world/story/wording.h"

// Who is there, and where: spawn, and the words about places.
namespace reprise::scripting {

namespace {

constexpr double farthest_beside = 50;         // [m] from a lane's centre line
constexpr double fastest = 150;                // [m/s]
constexpr std::int64_t longest_latency = 100;  // [ticks]

const std::vector<std::string> drivers{
    "autopilot", "manual", "traffic", "parked", "walker", "external", "prop"};

void read_model(const Fields& fields, Actor& actor) {
    const auto model = fields.text("model");
    if (!model) {
        std::string known;
        for (const world::VehicleModel& each : world::vehicle_models())
            known += std::string(each.name) + ", ";
        refuse(
            "spawn",
            fmt::format("'model' is missing: one of {}one of {} walkers such as {}, or one of {} "
                        "props such as {}",
                        known,
                        world::walker_models().size(),
                        world::walker_models().front().name,
                        world::prop_models().size(),
                        world::prop_models().front().name));
    }
    const auto vehicle = world::find_vehicle_model(*model);
    const auto walker = world::find_walker_model(*model);
    const auto prop = world::find_prop_model(*model);
    if (!vehicle && !walker && !prop)
        refuse("spawn",
               fmt::format(
                   "no model '{}'{}", *model, world::did_you_mean(*model, world::model_names())));
    actor.model = vehicle ? *vehicle : walker ? *walker : *prop;

    const std::string driver = fields.text("driver").value_or(vehicle  ? "autopilot"
                                                              : walker ? "walker"
                                                                       : "prop");
    const auto known = std::find(drivers.begin(), drivers.end(), driver);
    if (known == drivers.end())
        refuse("spawn",
               fmt::format("no driver '{}'{}", driver, world::did_you_mean(driver, drivers)));
    actor.driver = static_cast<world::Driver>(known - drivers.begin());
    if (actor.is_walker() != walker.has_value() || actor.is_prop() != prop.has_value())
        refuse("spawn",
               fmt::format("{} cannot have the driver '{}'", world::with_article(*model), driver));
}

void read_name(Run& run, const Fields& fields, Actor& actor) {
    const auto name = fields.name("name");
    if (name && run.actors.has_name(*name))
        refuse("spawn", fmt::format("the name '{}' is taken", *name));
    actor.name = name ? *name : run.actors.free_name(*fields.text("model"));
}

void want_room(const Run& run, const Actor& actor) {
    const auto [present, driven] = run.actors.present();
    if (run.actors.next_id() > most_actors)
        refuse("spawn", fmt::format("more than {} actors in one run", most_actors));
    if (present >= most_present_actors)
        refuse("spawn", fmt::format("more than {} actors at a time", most_present_actors));
    if (actor.is_driven() && driven >= most_driven_actors)
        refuse(
            "spawn",
            fmt::format(
                "more than {} actors with the driver 'autopilot', 'manual' or 'external' at a time",
                most_driven_actors));
}

/// As the kernel will put it down, roughly: on the centre line, then aside.
Eigen::Vector3d place_of(const world::LaneT& lane, const world::CommandT& command) {
    const world::LanePoint at = world::point_at(lane, command.s);
    return at.position + command.offset * Eigen::Vector3d(-std::sin(at.yaw), std::cos(at.yaw), 0);
}

/// What it will cover there.
Footprint footprint_of(const Actor& actor,
                       const world::LaneT& lane,
                       const world::CommandT& command) {
    const double yaw = world::point_at(lane, command.s).yaw;
    const Eigen::Vector3d p_world = place_of(lane, command);
    if (actor.is_walker()) {
        const double half = world::walker_models()[actor.model].shoulder_width / 2;
        return {p_world, yaw, half, half};
    }
    if (actor.is_prop()) {
        const world::PropModel& prop = world::prop_models()[actor.model];
        return {p_world, yaw, prop.length / 2, prop.width / 2};
    }
    const world::VehicleModel& model = world::vehicle_models()[actor.model];
    const double middle = model.length / 2 - model.rear_overhang;
    return {p_world + middle * Eigen::Vector3d(std::cos(yaw), std::sin(yaw), 0),
            yaw,
            model.length / 2,
            model.width / 2};
}

void want_free_place(const Run& run, const Actor& actor) {
    const std::size_t most = actor.is_prop() ? most_props_in_a_place : most_in_a_place;
    if (!actor.is_walker() &&
        run.actors.count_near(*actor.p_world_asked, place_radius, actor.is_prop()) >= most)
        refuse("spawn",
               fmt::format("more than {} {} within {:.0f} m: they would stand in each other",
                           most,
                           actor.is_prop() ? "props" : "vehicles",
                           place_radius));
    const auto [other, depth] = run.actors.obstructor(run.last, actor.asked);
    if (other != nullptr)
        refuse("spawn",
               fmt::format("'{}' would stand in '{}', which line {} spawned: they reach {:.2f} m "
                           "into each other; move one of them by 's' or 'offset'",
                           actor.name,
                           other->name,
                           other->line,
                           depth));
}

bool drives(const Actor& actor) {
    return !actor.is_walker() && !actor.is_prop() && actor.driver != world::Driver::parked;
}

/// Lane, s and offset into the command, the place into the actor.
void read_place(
    Run& run, lua_State* L, const Fields& fields, Actor& actor, world::CommandT& command) {
    const auto name = fields.text("lane");
    if (!name) {
        if (!drives(actor))
            refuse("spawn", "'lane' is missing: only who drives is given a free place");
        if (fields.has("s") || fields.has("offset"))
            refuse("spawn", "'s' and 'offset' need a 'lane'");
        command.lane = world::none;
        return;
    }
    try {
        command.lane = run.lane_named(L, *name);
    } catch (const world::Error& error) {
        refuse("spawn", error.what());
    }
    const world::LaneT& lane = run.town.lanes[command.lane];
    const bool on_its_lane = drives(actor);
    if (on_its_lane && !world::is_for_cars(lane))
        refuse("spawn", fmt::format("'{}' is not a lane for cars", *name));
    command.s = fields.number("s").value_or(0);
    if (command.s < 0 || command.s > lane.length)
        refuse("spawn",
               fmt::format("'s' must be in [0, {:.2f}], the length of '{}', got {}",
                           lane.length,
                           *name,
                           number_text(command.s)));
    command.offset = fields.number("offset").value_or(0);
    if (command.offset != 0 && actor.driver == world::Driver::traffic)
        refuse("spawn",
               fmt::format("'offset' has no effect on '{}': driver = 'traffic' keeps to the middle "
                           "of its lane; leave it out, or take driver = 'autopilot'",
                           actor.name));
    // Who drives begins on its lane; who is put down may stand beside it.
    const double farthest = on_its_lane ? lane.width / 2 : farthest_beside;
    if (std::abs(command.offset) > farthest)
        refuse("spawn",
               fmt::format("'offset' must be in [-{:.2f}, {:.2f}]{}, got {}",
                           farthest,
                           farthest,
                           on_its_lane ? ", half the width of '" + *name + "'" : "",
                           number_text(command.offset)));
    actor.p_world_asked = place_of(lane, command);
    actor.asked = footprint_of(actor, lane, command);
    run.vm.charge(L, run.actors.next_id());
    want_free_place(run, actor);
}

/// Is it to keep its lane?
bool read_keeps_lane(const Fields& fields, const Actor& actor) {
    if (!fields.mentions("lane_changes"))
        return false;
    const bool free = fields.flag("lane_changes").value_or(true);
    if (actor.driver != world::Driver::autopilot && actor.driver != world::Driver::traffic)
        refuse("spawn",
               fmt::format("'lane_changes' is for driver = 'autopilot' and 'traffic': whoever else "
                           "moves '{}' changes lanes by itself",
                           actor.name));
    return !free;
}

/// [ticks]
std::uint8_t read_latency(const Fields& fields, const Actor& actor) {
    if (!fields.mentions("latency"))
        return 0;
    if (actor.driver != world::Driver::external)
        refuse("spawn",
               fmt::format("'latency' is for driver = 'external', '{}' is driven by Reprise",
                           actor.name));
    const auto ticks = fields.integer("latency").value_or(0);
    if (ticks < 0 || ticks > longest_latency)
        refuse("spawn",
               fmt::format("'latency' must be in [0, {}] ticks, got {}", longest_latency, ticks));
    return static_cast<std::uint8_t>(ticks);
}

int spawn(Run& run, lua_State* L) {
    const Fields fields(L,
                        1,
                        "spawn",
                        {"name",
                         "model",
                         "driver",
                         "latency",
                         "lane",
                         "s",
                         "offset",
                         "speed",
                         "speed_kmh",
                         "rig",
                         "sees",
                         "lane_changes"});
    Actor actor;
    actor.id = run.actors.next_id();
    actor.line = run.vm.line(L);
    actor.asked_at = run.now();
    read_model(fields, actor);
    want_room(run, actor);
    read_name(run, fields, actor);
    world::CommandT command;
    read_place(run, L, fields, actor, command);
    const double speed = fields.speed().value_or(0);
    if (speed > fastest)
        refuse(
            "spawn",
            fmt::format("the speed must be in [0, {}] m/s, got {}", fastest, number_text(speed)));
    if (speed > 0 && !drives(actor))
        refuse("spawn", fmt::format("'{}' starts at rest", actor.name));

    const std::uint8_t latency = read_latency(fields, actor);
    auto rig = read_rig(L, fields, actor, latency);
    const bool sees_sensors = read_sees_sensors(fields, actor);
    actor.keeps_lane = read_keeps_lane(fields, actor);

    world::CommandT& said = run.say(L, world::CommandKind::spawn, actor.id);
    said.driver = actor.driver;
    said.model = actor.model;
    said.lane = command.lane;
    said.s = command.s;
    said.offset = command.offset;
    said.speed = speed;
    said.text = actor.name;
    said.latency = latency;
    said.rig = std::move(rig);
    said.sees_sensors = sees_sensors;
    if (actor.keeps_lane)
        run.say(L, world::CommandKind::change_lane, actor.id).lanes = {world::none};
    push_handle(L, run.actors.add(std::move(actor)).id);
    return 1;
}

// --- Places in any town.

int pick_lane(Run& run, lua_State* L) {
    const Fields fields(L,
                        1,
                        "pick_lane",
                        {"length", "left", "right", "sidewalk", "straight", "lanes", "optional"},
                        true);
    LaneWish wish;
    wish.length = fields.number("length").value_or(0);
    wish.left = fields.flag("left");
    wish.right = fields.flag("right");
    wish.sidewalk = fields.flag("sidewalk");
    wish.straight = fields.flag("straight");
    wish.lanes = fields.integer("lanes");
    const auto lanes = fitting_lanes(run.town, wish);
    run.vm.charge(L, run.town.lanes.size() * 20);
    if (lanes.empty()) {
        if (!fields.flag("optional").value_or(false))
            refuse("pick_lane",
                   run.town.name + " has no driving lane" +
                       (describe(wish).empty() ? "" : " with " + describe(wish)));
        lua_pushnil(L);
        return 1;
    }
    const auto last = static_cast<std::int64_t>(lanes.size()) - 1;
    const auto choice = run.streams.draw_integer("pick_lane", 0, last);
    const std::string& name = run.town.lanes[lanes[static_cast<std::size_t>(choice)]].name;
    lua_pushlstring(L, name.data(), name.size());
    return 1;
}

const world::LaneT& lane_argument(Run& run, lua_State* L, const char* who) {
    return run.town.lanes[run.lane_named(L, text_at(L, 1, who, "the lane"))];
}

int lane_point(Run& run, lua_State* L) {
    const world::LaneT& lane = lane_argument(run, L, "lane_point");
    const double s = number_at(L, 2, "lane_point", "s");
    const double offset = lua_isnoneornil(L, 3) ? 0 : number_at(L, 3, "lane_point", "offset");
    const world::LanePoint at = world::point_at(lane, s);
    lua_pushnumber(L, at.position.x() - offset * std::sin(at.yaw));
    lua_pushnumber(L, at.position.y() + offset * std::cos(at.yaw));
    lua_pushnumber(L, at.position.z());
    lua_pushnumber(L, at.yaw * 180 / std::numbers::pi);
    return 4;
}

int lane_length(Run& run, lua_State* L) {
    lua_pushnumber(L, lane_argument(run, L, "lane_length").length);
    return 1;
}

int lane_width(Run& run, lua_State* L) {
    lua_pushnumber(L, lane_argument(run, L, "lane_width").width);
    return 1;
}

int speed_limit(Run& run, lua_State* L) {
    lua_pushnumber(L, lane_argument(run, L, "speed_limit").speed_limit);
    return 1;
}

/// The neighbour in the same direction, or nil.
template <std::uint32_t world::LaneT::*side>
int neighbour(Run& run, lua_State* L) {
    const std::uint32_t index = lane_argument(run, L, "lane_beside").*side;
    if (index == world::none || run.town.lanes[index].kind != world::LaneKind::driving) {
        lua_pushnil(L);
        return 1;
    }
    const std::string& name = run.town.lanes[index].name;
    lua_pushlstring(L, name.data(), name.size());
    return 1;
}

}  // namespace

void add_spawn_words(lua_State* L) {
    add_function(L, "spawn", acting<spawn>);
    add_function(L, "pick_lane", acting<pick_lane>);
    add_function(L, "lane_point", bound<lane_point>);
    add_function(L, "lane_length", bound<lane_length>);
    add_function(L, "lane_width", bound<lane_width>);
    add_function(L, "speed_limit", bound<speed_limit>);
    add_function(L, "lane_left_of", bound<neighbour<&world::LaneT::left>>);
    add_function(L, "lane_right_of", bound<neighbour<&world::LaneT::right>>);
}

}  // namespace reprise::scripting
