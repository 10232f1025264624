#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/lua/text.h"
#include "scripting/run/places.h"
#include "scripting/words/handles.h"
#include "scripting/words/obedience.h"
#include "scripting/words/vocabulary.h"
#include "world/models/motion_limits.h"
#include "world/transition.h"
#include "world/units.h"

// How an actor that has a driver moves: how fast, on which lane, and where on it. Every word
// becomes one command in the tick.
namespace reprise::scripting {

namespace {

constexpr Key over_key_rows[] = {
    {"over", "number", "[s] that the change takes"},
    {"shape", "'sinusoidal'|'linear'|'cubic'|'step'", "of the change"},
};

using world::CommandKind;
using world::Driver;
using world::Shape;

constexpr double longest_change = 3600;  // [s]
constexpr double fastest_order = 150;    // [m/s]

const std::vector<std::string> shape_names{"sinusoidal", "linear", "cubic", "step"};

/// How a change is to go: the options `over` and `shape` of a word.
struct Change {
    double duration = 0;         ///< [s] 0: not said
    std::optional<Shape> shape;  ///< said
};

Change change_at(lua_State* L, int index, const char* who) {
    const Fields options(L, index, who, names_of(over_key_rows), true);
    Change change;
    change.duration = options.number("over").value_or(0);
    if (change.duration < 0 || change.duration > longest_change)
        refuse(who, "'over' must be in [0, 3600] s");
    if (!options.mentions("shape"))
        return change;
    const std::string name = options.text("shape").value_or("");
    const auto known = std::find(shape_names.begin(), shape_names.end(), name);
    if (known == shape_names.end())
        refuse(who,
               fmt::format("no shape '{}'{}: 'sinusoidal', 'linear', 'cubic' or 'step'",
                           name,
                           world::did_you_mean(name, shape_names)));
    change.shape = static_cast<Shape>(known - shape_names.begin());
    if (change.shape == Shape::step && change.duration > 0)
        refuse(who, "'over' has no effect with the shape 'step', which is as quick as can be");
    if (change.shape != Shape::step && change.duration == 0)
        refuse(who, "'shape' needs 'over', the time of the whole change: over = 3");
    return change;
}

/// Of a speed: evenly where nothing else is said.
Change speed_change_at(lua_State* L, int index, const Actor& actor, const char* who) {
    Change change = change_at(L, index, who);
    if (change.duration > 0 && actor.is_walker())
        refuse(who,
               fmt::format("'over' has no effect on '{}': a walker changes its speed by 2 m/s^2; "
                           "leave it out, or take driver = 'traffic'",
                           actor.name));
    if (change.shape == Shape::step)
        refuse(who, "nobody's speed changes by a step: leave 'shape' out, as fast as it likes");
    if (change.duration > 0 && !change.shape)
        change.shape = Shape::linear;
    return change;
}

world::CarModel car_of(const Actor& actor) {
    return world::car_model(world::vehicle_models()[actor.model]);
}

/// [s] that such a change of speed takes at least on the flat; infinity: it never gets there.
double quickest_change(const Actor& actor, const world::Transition& change, double friction) {
    constexpr int samples = 32;
    const world::CarModel car = car_of(actor);
    double share = 0;
    for (int i = 0; i < samples; ++i) {
        const double at = change.duration * (i + 0.5) / samples;
        const double wanted = change.rate(at);
        const double most = wanted < 0
                                ? world::hardest_braking(car, friction)
                                : world::hardest_accelerating(car, change.value(at), friction);
        if (most <= 0)
            return world::infinity;
        share = std::max(share, std::abs(wanted) / most);
    }
    return change.duration * share;
}

/// Refuses what the actor's engine, its brakes or the road cannot do.
void want_possible(
    const Run& run, const Actor& actor, double speed, const Change& change, const char* who) {
    if (actor.driver != Driver::autopilot)
        return;
    const double friction = run.last.tick->road_friction();
    if (world::hardest_accelerating(car_of(actor), speed, friction) < 0)
        refuse(who, fmt::format("'{}' cannot drive at {} m/s", actor.name, number_text(speed)));
    if (change.duration == 0)
        return;
    const double now = std::max(body_of(run.last, actor)->speed, 0.0);
    const double least = quickest_change(
        actor, {now, speed, change.duration, change.shape.value_or(Shape::linear)}, friction);
    if (least > change.duration)
        refuse(who,
               fmt::format("'{}' cannot get from {:.1f} to {:.1f} m/s in {} s: it takes {:.1f} s "
                           "or more",
                           actor.name,
                           now,
                           speed,
                           number_text(change.duration),
                           least));
}

/// A walker's speed counts while it walks.
Actor& with_a_speed(Run& run, lua_State* L, const char* who) {
    Actor& actor = driven(run, L, who);
    if (actor.is_walker() && !actor.walks)
        refuse(who,
               fmt::format("has no effect on '{}', which stands until it is told where to go: "
                           "{}:walk{{ to = {{ x, y }}, speed = 2 }}",
                           actor.name,
                           actor.name));
    return actor;
}

void say_change(world::CommandT& command, const Change& change) {
    command.duration = change.duration;
    command.shape = change.shape.value_or(Shape::sinusoidal);
}

double speed_at(lua_State* L, const char* who, double unit) {
    const double speed = number_at(L, 2, who, "the speed") * unit;
    if (speed < 0 || speed > fastest_order)
        refuse(who, fmt::format("the speed must be in [0, 150] m/s, got {}", number_text(speed)));
    return speed;
}

int change_speed(Run& run, lua_State* L, const char* who, double unit) {
    const Actor& actor = with_a_speed(run, L, who);
    const double speed = speed_at(L, who, unit);
    const Change change = speed_change_at(L, 3, actor, who);
    if (change.duration > 0)
        want_possible(run, actor, speed, change, who);
    world::CommandT& command = run.say(L, CommandKind::set_speed, actor.id);
    command.speed = speed;
    say_change(command, change);
    return 0;
}

int set_speed(Run& run, lua_State* L) {
    return change_speed(run, L, "set_speed", 1);
}

int set_speed_kmh(Run& run, lua_State* L) {
    return change_speed(run, L, "set_speed_kmh", 1 / 3.6);
}

int free_speed(Run& run, lua_State* L) {
    run.say(L, CommandKind::free_speed, with_a_speed(run, L, "free_speed").id);
    return 0;
}

/// `false` in the place of a value lifts an order: a command that says no more.
bool lifts(Run& run, lua_State* L, CommandKind order, const Actor& actor) {
    if (!lua_isboolean(L, 2) || lua_toboolean(L, 2) != 0)
        return false;
    run.say(L, order, actor.id);
    return true;
}

/// Without an argument the speed that it has; false lifts it.
int hold(Run& run, lua_State* L, const char* who, double unit) {
    const Actor& actor = driver_of_car(run, L, who);
    if (lifts(run, L, CommandKind::hold_speed, actor))
        return 0;
    const double speed = lua_isnoneornil(L, 2) ? std::max(body_of(run.last, actor)->speed, 0.0)
                                               : speed_at(L, who, unit);
    const Change change = speed_change_at(L, 3, actor, who);
    want_possible(run, actor, speed, change, who);
    world::CommandT& command = run.say(L, CommandKind::hold_speed, actor.id);
    command.on = true;
    command.speed = speed;
    say_change(command, change);
    return 0;
}

int hold_speed(Run& run, lua_State* L) {
    return hold(run, L, "hold_speed", 1);
}

int hold_speed_kmh(Run& run, lua_State* L) {
    return hold(run, L, "hold_speed_kmh", 1 / 3.6);
}

int brake(Run& run, lua_State* L) {
    constexpr double of_traffic = 9;  // [m/s^2] see traffic/orders.cpp
    const Actor& actor = driver_of_car(run, L, "brake");
    if (lifts(run, L, CommandKind::brake, actor))
        return 0;
    const double deceleration = number_at(L, 2, "brake", "the deceleration in m/s^2");
    const double most = actor.driver == Driver::traffic
                            ? of_traffic
                            : world::hardest_braking(car_of(actor), run.last.tick->road_friction());
    if (!(deceleration > 0 && deceleration <= most))
        refuse("brake",
               fmt::format("the deceleration must be in (0, {:.1f}] m/s^2, what the brakes of '{}' "
                           "and the road give, got {}",
                           most,
                           actor.name,
                           number_text(deceleration)));
    world::CommandT& command = run.say(L, CommandKind::brake, actor.id);
    command.on = true;
    command.deceleration = deceleration;
    return 0;
}

int ignore_lights(Run& run, lua_State* L) {
    const Actor& actor = driver_of_car(run, L, "ignore_lights");
    if (!lua_isnoneornil(L, 2) && !lua_isboolean(L, 2))
        refuse("ignore_lights", "takes true or false, true where it is left out");
    run.say(L, CommandKind::ignore_lights, actor.id).on =
        lua_isnoneornil(L, 2) || lua_toboolean(L, 2) != 0;
    return 0;
}

int may_overtake(Run& run, lua_State* L) {
    const Actor& actor = driver_of_car(run, L, "may_overtake");
    if (!lua_isnoneornil(L, 2) && !lua_isboolean(L, 2))
        refuse("may_overtake", "takes true or false, true where it is left out");
    const bool may = lua_isnoneornil(L, 2) || lua_toboolean(L, 2) != 0;
    if (may)
        want_overtaker("may_overtake", actor);
    run.say(L, CommandKind::may_overtake, actor.id).on = may;
    return 0;
}

/// 'left' and 'right' are of the lane that the actor is on now.
std::uint32_t target_lane(Run& run, lua_State* L, const Body& body, const Actor& actor) {
    const std::string target = text_at(L, 2, "change_lane", "the target");
    if (target != "left" && target != "right") {
        const std::uint32_t lane = run.lane_named(L, target);
        if (run.town.lanes[lane].kind != world::LaneKind::driving)
            refuse("change_lane", not_for_cars(run.town, run.town.lanes[lane]));
        return lane;
    }
    if (body.lane == world::none)
        refuse("change_lane", "'" + actor.name + "' is on no lane");
    const world::LaneT& here = run.town.lanes[body.lane];
    const std::uint32_t lane = target == "left" ? here.left : here.right;
    if (lane == world::none || run.town.lanes[lane].kind != world::LaneKind::driving)
        refuse("change_lane", fmt::format("no lane to the {} of '{}'", target, here.name));
    return lane;
}

bool is_beside(const world::TownT& town, std::uint32_t here, std::uint32_t there) {
    if (here == world::none)
        return false;
    return town.lanes[here].edge == town.lanes[there].edge &&
           town.lanes[here].kind == world::LaneKind::driving;
}

/// Refuses a move aside that the speed and the grip do not allow.
void want_room(const Run& run,
               const Actor& actor,
               const Body& body,
               double distance,
               const Change& change,
               const char* who) {
    if (change.duration == 0 || actor.driver != Driver::autopilot)
        return;
    const double least = world::quickest_shift(car_of(actor),
                                               distance,
                                               change.shape.value_or(Shape::sinusoidal),
                                               body.speed,
                                               run.last.tick->road_friction());
    if (least > change.duration)
        refuse(who,
               fmt::format(
                   "'{}' cannot move {:.1f} m aside in {} s at {:.1f} m/s{}",
                   actor.name,
                   std::abs(distance),
                   number_text(change.duration),
                   body.speed,
                   std::isinf(least) ? "" : fmt::format(": it takes {:.1f} s or more", least)));
}

int change_lane(Run& run, lua_State* L) {
    const Actor& actor = driver_of_car(run, L, "change_lane");
    const Body body = run.look_at(actor);
    const std::uint32_t lane = target_lane(run, L, body, actor);
    Change change = change_at(L, 3, "change_lane");
    const world::LaneT& target = run.town.lanes[lane];
    if (actor.driver == Driver::traffic) {
        if (change.shape.value_or(Shape::linear) != Shape::linear)
            refuse("change_lane",
                   fmt::format("'{}' is SUMO's, which goes over evenly: leave 'shape' out, or take "
                               "driver = 'autopilot'",
                               actor.name));
        if (change.duration > 0)
            change.shape = Shape::linear;
    } else if (change.duration > 0 || change.shape) {
        if (!is_beside(run.town, body.lane, lane))
            refuse("change_lane",
                   fmt::format("within a time only to a lane beside its own, which '{}' is not: "
                               "leave 'over' and 'shape' out",
                               target.name));
        want_room(run, actor, body, world::project(target, body.position).t, change, "change_lane");
    }
    world::CommandT& command = run.say(L, CommandKind::change_lane, actor.id);
    command.lanes.push_back(lane);
    say_change(command, change);
    return 0;
}

/// A change of lanes to no lane; to leave it open again, one that says nothing.
int keep_lane(Run& run, lua_State* L) {
    Actor& actor = driver_of_car(run, L, "keep_lane");
    if (!lua_isnoneornil(L, 2) && !lua_isboolean(L, 2))
        refuse("keep_lane", "takes true or false, true where it is left out");
    actor.keeps_lane = lua_isnoneornil(L, 2) || lua_toboolean(L, 2) != 0;
    world::CommandT& command = run.say(L, CommandKind::change_lane, actor.id);
    if (actor.keeps_lane)
        command.lanes.push_back(world::none);
    return 0;
}

int set_offset(Run& run, lua_State* L) {
    const Actor& actor = driver_of_car(run, L, "set_offset");
    const double offset = number_at(L, 2, "set_offset", "the offset in metres");
    const Change change = change_at(L, 3, "set_offset");
    const Body body = run.look_at(actor);
    if (body.lane == world::none)
        refuse("set_offset", "'" + actor.name + "' is on no lane");
    const world::LaneT& here = run.town.lanes[body.lane];
    const bool traffic = actor.driver == Driver::traffic;
    const double most = traffic ? here.width / 2 : here.width;
    if (std::abs(offset) > most)
        refuse("set_offset",
               fmt::format("the offset must be in [{:.2f}, {:.2f}] m, {} '{}' is wide, got {}",
                           -most,
                           most,
                           traffic ? "for 'traffic' half of what" : "what",
                           here.name,
                           number_text(offset)));
    want_room(
        run, actor, body, offset - world::project(here, body.position).t, change, "set_offset");
    world::CommandT& command = run.say(L, CommandKind::set_offset, actor.id);
    command.offset = offset;
    say_change(command, change);
    return 0;
}

constexpr Word motion_rows[] = {
    {"set_speed",
     commanding<set_speed>,
     "(speed: number, options?: OverOptions)",
     "[m/s] a cap for the autopilot, the speed of others"},
    {"set_speed_kmh",
     commanding<set_speed_kmh>,
     "(speed: number, options?: OverOptions)",
     "[km/h] the same"},
    {"free_speed", commanding<free_speed>, "()", "back to the driver's own choice"},
    {"hold_speed",
     commanding<hold_speed>,
     "(speed?: number|boolean, options?: OverOptions)",
     "[m/s] exactly that, and reacts to nothing; false lifts it"},
    {"hold_speed_kmh",
     commanding<hold_speed_kmh>,
     "(speed: number, options?: OverOptions)",
     "[km/h] the same"},
    {"brake",
     commanding<brake>,
     "(deceleration: number|boolean)",
     "[m/s^2] until it stands, and stays; false lifts it"},
    {"ignore_lights",
     commanding<ignore_lights>,
     "(ignore?: boolean)",
     "drives over red lights and stop lines; false lifts it"},
    {"may_overtake",
     commanding<may_overtake>,
     "(may?: boolean)",
     "an autopilot goes around what stands or crawls in its lane; false: waits behind it"},
    {"change_lane",
     commanding<change_lane>,
     "(target: 'left'|'right'|LaneName, options?: OverOptions)",
     "to the lane beside, or one of that name"},
    {"keep_lane",
     commanding<keep_lane>,
     "(keep?: boolean)",
     "stays on its lane, but for change_lane; false: again as its way needs it"},
    {"set_offset",
     commanding<set_offset>,
     "(offset: number, options?: OverOptions)",
     "[m] to the left of its lane's centre line, from now on"},
};

}  // namespace

constinit const WordList motion_words{Owner::actor, "Actors: speed and lane", motion_rows};
constinit const KeyList over_keys{
    "OverOptions", "set_speed, change_lane, set_offset", over_key_rows};

void add_motion_words(lua_State* L) {
    add_words(L, motion_words);
}

}  // namespace reprise::scripting
