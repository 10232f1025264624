#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/lua/text.h"
#include "scripting/run/caps.h"
#include "scripting/run/places.h"
#include "scripting/words/handles.h"
#include "scripting/words/obedience.h"
#include "scripting/words/rig.h"
#include "scripting/words/vocabulary.h"
#include "scripting/words/where.h"
#include "world/models/catalogue.h"
#include "world/models/prop_models.h"
#include "world/story/wording.h"

// Who is there, and where: spawn, and the words about places.
namespace reprise::scripting {

namespace {

constexpr double fastest = 150;                // [m/s]
constexpr std::int64_t longest_latency = 100;  // [ticks]
constexpr std::int64_t longest_pause = 100;    // [ticks]

std::string all_models() {
    std::string known;
    for (const world::VehicleModel& each : world::vehicle_models())
        known += std::string(each.name) + ", ";
    return fmt::format(
        "{}one of {} walkers such as {} (reprise list walkers), or one of {} props "
        "such as {} (reprise list props)",
        known,
        world::walker_models().size(),
        world::walker_models().front().name,
        world::prop_models().size(),
        world::prop_models().front().name);
}

void read_model(const Fields& fields, Actor& actor) {
    const auto model = fields.text("model");
    if (!model) {
        refuse("spawn", "'model' is missing: one of " + all_models());
    }
    const auto vehicle = world::find_vehicle_model(*model);
    const auto walker = world::find_walker_model(*model);
    const auto prop = world::find_prop_model(*model);
    if (!vehicle && !walker && !prop)
        refuse("spawn",
               fmt::format("no model '{}'{}; there are {}",
                           *model,
                           world::did_you_mean(*model, world::model_names()),
                           all_models()));
    actor.model = vehicle ? *vehicle : walker ? *walker : *prop;

    const std::string driver = fields.text("driver").value_or(vehicle  ? "autopilot"
                                                              : walker ? "walker"
                                                                       : "prop");
    const std::vector<std::string>& drivers = driver_names();
    const auto known = std::find(drivers.begin(), drivers.end(), driver);
    if (known == drivers.end())
        refuse("spawn",
               fmt::format("no driver '{}'{}; there are {}",
                           driver,
                           world::did_you_mean(driver, drivers),
                           fmt::join(drivers, ", ")));
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

/// Into the command and the actor; where none is said, the kernel finds a free one.
void take_place(
    Run& run, lua_State* L, const Fields& fields, Actor& actor, world::CommandT& command) {
    const auto place = read_place(run, L, fields, actor);
    if (!place) {
        if (!drives(actor))
            refuse("spawn", "'lane' is missing: only who drives is given a free place");
        command.lane = world::none;
        return;
    }
    place->say(command);
    actor.p_world_asked = place->p_world;
    actor.asked = footprint_at(actor, *place);
    want_free_place(run, L, "spawn", actor);
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

/// [ticks] of an external driver.
std::uint8_t read_ticks(const Fields& fields,
                        const Actor& actor,
                        const char* key,
                        std::int64_t usual,
                        std::int64_t most) {
    if (!fields.mentions(key))
        return static_cast<std::uint8_t>(usual);
    if (actor.driver != world::Driver::external)
        refuse("spawn",
               fmt::format(
                   "'{}' is for driver = 'external', '{}' is driven by Reprise", key, actor.name));
    const auto ticks = fields.integer(key).value_or(usual);
    if (ticks < usual || ticks > most)
        refuse("spawn",
               fmt::format("'{}' must be in [{}, {}] ticks, got {}", key, usual, most, ticks));
    return static_cast<std::uint8_t>(ticks);
}

Rhythm read_rhythm(const Fields& fields, const Actor& actor) {
    return {read_ticks(fields, actor, "latency", 0, longest_latency),
            read_ticks(fields, actor, "every", 1, longest_pause)};
}

/// Which of the built-in drivers.
world::Pilot read_pilot(const Fields& fields, const Actor& actor) {
    const auto said = fields.text("pilot");
    if (!said)
        return world::Pilot::idm;
    if (actor.driver != world::Driver::autopilot)
        refuse("spawn",
               fmt::format("'pilot' is for driver = 'autopilot', which '{}' has not", actor.name));
    if (*said != "idm" && *said != "pid")
        refuse("spawn", fmt::format("no pilot '{}'; there are idm, pid", *said));
    return *said == "pid" ? world::Pilot::pid : world::Pilot::idm;
}

int spawn(Run& run, lua_State* L);

int spawn_again(lua_State* L, int, std::ptrdiff_t) {
    return acting<spawn>(L);
}

constexpr Key spawn_key_rows[] = {
    {"name", "string", "unique; default the model's, 'sedan_2' of a second one"},
    {"model",
     "ModelName|WalkerName|PropName",
     "what it is: reprise list models, walkers, props",
     true},
    {"driver", "DriverName", "who moves it; default 'autopilot', of walkers 'walker'"},
    {"pilot",
     "'idm'|'pid'",
     "which 'autopilot': ours (default), or the PID driver of CARLA's paper"},
    {"latency", "integer", "[ticks] 0 to 100, of an 'external' driver's controls"},
    {"every",
     "integer",
     "[ticks] 1 to 100, from one that an 'external' driver is shown to the next; default 1"},
    {"lane",
     "LaneName|'left'|'right'|'same'",
     "its lane; who drives and has none is given a free place by the seed"},
    {"s", "number", "[m] along the lane, of the rear axle; default 0"},
    {"offset", "number", "[m] to the left of the lane's centre line; default 0"},
    {"x", "number", "[m] of a pose, east"},
    {"y", "number", "[m] of a pose, north"},
    {"z", "number", "[m] of a pose, where roads lie above each other"},
    {"heading_deg", "number", "of a pose, counter-clockwise from east"},
    {"ahead_of", "Actor", "along the road from that one, 'gap' metres away"},
    {"behind", "Actor", "likewise, behind it"},
    {"beside", "Actor", "abreast, in the lane to its 'left' or 'right'"},
    {"gap", "number", "[m] from bumper to bumper"},
    {"speed", "number", "[m/s] from the first tick on; default 0"},
    {"speed_kmh", "number", "[km/h] the same"},
    {"rig", "SensorOptions[]", "up to 16 cameras on a vehicle with mass"},
    {"sees", "'everything'|'sensors'", "what an 'external' driver is shown of others"},
    {"lane_changes",
     "boolean",
     "false: keeps its lane; of 'autopilot' and 'traffic'; default true"},
    {"may_overtake",
     "boolean",
     "true: an 'autopilot' goes around what stands or crawls in its lane; default false"},
};

/// Of who is still to be given a place: another one cannot be put beside it before.
bool waits_for_its_place(Run& run, lua_State* L, const Fields& fields) {
    lua_settop(L, 1);
    if (!push_related(fields))
        return false;
    const Actor& other = actor_at(run, L, 2, "spawn");
    return other.presence == Actor::Presence::gone ||
           (other.presence == Actor::Presence::coming && !other.p_world_asked);
}

int spawn(Run& run, lua_State* L) {
    const Fields fields(L, 1, "spawn", names_of(spawn_key_rows));
    if (waits_for_its_place(run, L, fields))
        return wait_for_presence(run, L, spawn_again);
    Actor actor;
    actor.id = run.actors.next_id();
    actor.line = run.vm.line(L);
    actor.asked_at = run.now();
    read_model(fields, actor);
    want_room(run, actor);
    read_name(run, fields, actor);
    world::CommandT command;
    take_place(run, L, fields, actor, command);
    const double speed = fields.speed().value_or(0);
    if (speed > fastest)
        refuse(
            "spawn",
            fmt::format("the speed must be in [0, {}] m/s, got {}", fastest, number_text(speed)));
    if (speed > 0 && !drives(actor))
        refuse("spawn", fmt::format("'{}' starts at rest", actor.name));

    const double step = world::seconds(1, run.episode.step_ns);
    const Rhythm rhythm = read_rhythm(fields, actor);
    auto rig = read_rig(L, fields, actor, rhythm, step);
    const bool sees_sensors = read_sees_sensors(fields, actor);
    actor.keeps_lane = read_keeps_lane(fields, actor);
    actor.pilot = read_pilot(fields, actor);
    const bool may_overtake = fields.flag("may_overtake").value_or(false);
    if (may_overtake)
        want_overtaker("spawn", actor);
    if (may_overtake && actor.keeps_lane)
        refuse("spawn", "'may_overtake = true' needs what 'lane_changes = false' forbids");

    world::CommandT& said = run.say(L, world::CommandKind::spawn, actor.id);
    said.driver = actor.driver;
    said.model = actor.model;
    said.lane = command.lane;
    said.s = command.s;
    said.offset = command.offset;
    said.has_pose = command.has_pose;
    said.target = command.target;
    said.heading = command.heading;
    said.speed = speed;
    said.text = actor.name;
    said.latency = rhythm.latency;
    said.duration = rhythm.every > 1 ? rhythm.every * step : 0;
    said.rig = std::move(rig);
    said.sees_sensors = sees_sensors;
    said.pilot = actor.pilot;
    if (actor.keeps_lane)
        run.say(L, world::CommandKind::change_lane, actor.id).lanes = {world::none};
    if (may_overtake)
        run.say(L, world::CommandKind::may_overtake, actor.id).on = true;
    push_handle(L, run.actors.add(std::move(actor)).id);
    return 1;
}

// --- Places in any town.

constexpr Key pick_lane_key_rows[] = {
    {"length", "number", "[m] at least so long"},
    {"left", "boolean", "with (false: without) a lane to the left in its direction"},
    {"right", "boolean", "with (without) a lane to the right in its direction"},
    {"sidewalk", "boolean", "with (without) a sidewalk directly to the right"},
    {"straight", "boolean", "without (with) a bend below 500 m radius"},
    {"lanes", "integer", "so many lanes for cars in its direction"},
    {"optional", "boolean", "nil when none fits, rather than an error"},
};

int pick_lane(Run& run, lua_State* L) {
    const Fields fields(L, 1, "pick_lane", names_of(pick_lane_key_rows), true);
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

constexpr Word spawn_rows[] = {
    {"spawn", acting<spawn>, "(options: SpawnOptions): Actor", "an actor; stands in the next tick"},
};

constexpr Word place_rows[] = {
    {"pick_lane",
     acting<pick_lane>,
     "(options?: PickLaneOptions): LaneName",
     "a driving lane that fits, chosen by the seed"},
    {"lane_point",
     bound<lane_point>,
     "(lane: LaneName, s: number, offset?: number): number, number, number, number",
     "x, y, z [m] and heading [deg] there"},
    {"lane_length", bound<lane_length>, "(lane: LaneName): number", "[m]"},
    {"lane_width", bound<lane_width>, "(lane: LaneName): number", "[m]"},
    {"speed_limit", bound<speed_limit>, "(lane: LaneName): number", "[m/s] of a lane"},
    {"lane_left_of",
     bound<neighbour<&world::LaneT::left>>,
     "(lane: LaneName): LaneName?",
     "the lane for cars to its left in its direction, or nil"},
    {"lane_right_of",
     bound<neighbour<&world::LaneT::right>>,
     "(lane: LaneName): LaneName?",
     "the lane for cars to its right in its direction, or nil"},
};

}  // namespace

constinit const WordList spawn_words{Owner::global, "Actors", spawn_rows};
constinit const WordList place_words{Owner::global, "Places in any town", place_rows};
constinit const KeyList spawn_keys{"SpawnOptions", "spawn", spawn_key_rows};
constinit const KeyList pick_lane_keys{"PickLaneOptions", "pick_lane", pick_lane_key_rows};

const std::vector<std::string>& driver_names() {
    static const std::vector<std::string> names{
        "autopilot", "manual", "traffic", "parked", "walker", "external", "prop"};
    return names;
}

void add_spawn_words(lua_State* L) {
    add_words(L, spawn_words);
    add_words(L, place_words);
}

}  // namespace reprise::scripting
