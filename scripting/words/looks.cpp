#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/run/measures.h"
#include "scripting/run/surroundings.h"
#include "scripting/words/handles.h"
#include "scripting/words/vocabulary.h"

// What an actor sees around itself, and what became of its drive. None of it acts.
namespace reprise::scripting {

namespace {

constexpr Key around_key_rows[] = {
    {"kind", "'vehicle'|'bicycle'|'walker'|'prop'", "only these"},
};

constexpr double farthest_look = 1000;     // [m]
constexpr double clear_way = 200;          // [m] as far as gap() searches
constexpr std::uint64_t glance_cost = 5;   // [instructions] of somebody who is looked at
constexpr std::uint64_t entry_cost = 300;  // [instructions] of a table about him
constexpr std::uint64_t way_cost = 500;    // [instructions] of the lanes ahead

// Surfaces as ticks number them, see ground/mesh/ground.h.
constexpr std::uint8_t road = 1;
constexpr std::uint8_t zebra = 2;
constexpr std::uint8_t marking = 5;
constexpr std::uint8_t deck = 6;

Actor& vehicle_at(Run& run, lua_State* L, const char* who) {
    Actor& actor = actor_at(run, L, 1, who);
    if (actor.is_walker())
        refuse(who, fmt::format("'{}' is a walker: only vehicles have that", actor.name));
    return actor;
}

/// Only they are measured.
Actor& vehicle_with_mass(Run& run, lua_State* L, const char* who) {
    Actor& actor = vehicle_at(run, L, who);
    if (!actor.is_driven())
        refuse(who,
               fmt::format("'{}' has driver = '{}', which never leaves its lane: only 'autopilot', "
                           "'manual' and 'external' can",
                           actor.name,
                           actor.driver == world::Driver::parked ? "parked" : "traffic"));
    return actor;
}

/// Somebody's name: his own, or model and number.
std::string name_of(Run& run, const Neighbour& other) {
    return other.id < run.actors.next_id() ? run.actors.at(other.id).name
                                           : fmt::format("{}#{}", model_name(other), other.id);
}

const char* driver_of(Run& run, const Neighbour& other) {
    static constexpr const char* names[] = {
        "autopilot", "manual", "traffic", "parked", "walker", "external", "prop"};
    return other.id < run.actors.next_id()
               ? names[static_cast<std::size_t>(run.actors.at(other.id).driver)]
               : "background";
}

// --- Around.

std::optional<Neighbour::Kind> wanted_kind(const Fields& options) {
    const auto kind = options.text("kind");
    if (!kind)
        return std::nullopt;
    for (const auto each : {Neighbour::Kind::vehicle,
                            Neighbour::Kind::bicycle,
                            Neighbour::Kind::walker,
                            Neighbour::Kind::prop})
        if (*kind == name_of(each))
            return each;
    refuse("around",
           fmt::format("no kind '{}'{}: 'vehicle', 'bicycle', 'walker' or 'prop'",
                       *kind,
                       world::did_you_mean(*kind, {"vehicle", "bicycle", "walker", "prop"})));
}

void set_number(lua_State* L, const char* key, double value) {
    lua_pushnumber(L, value);
    lua_setfield(L, -2, key);
}

void set_text(lua_State* L, const char* key, std::string_view text) {
    lua_pushlstring(L, text.data(), text.size());
    lua_setfield(L, -2, key);
}

/// A table about somebody, seen from `own`.
void push_entry(Run& run, lua_State* L, const Body& own, const Neighbour& other, double away) {
    constexpr int keys = 17;
    const Body body = run.with_lane(other.body, other.kind == Neighbour::Kind::walker);
    const Eigen::Vector3d between = body.centre() - own.centre();
    const Eigen::Vector3d ahead = own.ahead();
    lua_createtable(L, 0, keys);
    set_text(L, "name", name_of(run, other));
    set_text(L, "kind", name_of(other.kind));
    set_text(L, "model", model_name(other));
    set_text(L, "driver", driver_of(run, other));
    lua_pushinteger(L, other.id);
    lua_setfield(L, -2, "id");
    set_number(L, "x", body.position.x());
    set_number(L, "y", body.position.y());
    set_number(L, "heading_deg", body.yaw * 180 / std::numbers::pi);
    set_number(L, "speed", body.speed);
    set_number(L, "length", body.front + body.rear);
    set_number(L, "width", 2 * body.half_width);
    set_number(L, "distance", away);
    set_number(L, "ahead", between.dot(ahead));
    set_number(L, "left", ahead.x() * between.y() - ahead.y() * between.x());
    if (body.lane == world::none)
        return;
    const world::LaneT& lane = run.town.lanes[body.lane];
    set_text(L, "lane", lane.name);
    set_number(L, "s", place_on_lane(run.town, body).s);
}

int around(Run& run, lua_State* L) {
    const Actor& actor = actor_at(run, L, 1, "around");
    const double radius = number_at(L, 2, "around", "the distance");
    if (radius < 0 || radius > farthest_look)
        refuse("around", fmt::format("the distance must be in [0, {}] m", farthest_look));
    const auto kind = wanted_kind(Fields(L, 3, "around", names_of(around_key_rows), true));
    const Body own = *body_of(run.last, actor);
    const auto& all = run.everybody();
    run.vm.charge(L, all.size() * glance_cost);
    std::vector<std::pair<double, const Neighbour*>> near;
    const Eigen::Vector3d centre = own.centre();
    for (const Neighbour& other : all) {
        // A sine and a cosine for those only who may be near.
        const double reach = radius + other.body.front + other.body.rear;
        if (other.id == actor.id || (kind && other.kind != *kind) ||
            (other.body.position - centre).squaredNorm() > reach * reach)
            continue;
        if (const double away = distance(own, other.body); away <= radius)
            near.emplace_back(away, &other);
    }
    std::sort(near.begin(), near.end(), [](const auto& one, const auto& other) {
        return std::tuple(one.first, one.second->id) < std::tuple(other.first, other.second->id);
    });
    run.vm.charge(L, near.size() * entry_cost);
    lua_createtable(L, static_cast<int>(near.size()), 0);
    for (std::size_t i = 0; i < near.size(); ++i) {
        push_entry(run, L, own, *near[i].second, near[i].first);
        lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
    }
    return 1;
}

/// Metres, and what is there: its name and kind. Nil when the way is clear.
int gap_ahead(Run& run, lua_State* L) {
    const Actor& actor = vehicle_at(run, L, "gap_ahead");
    run.vm.charge(L, way_cost + count_everybody(run.last) * glance_cost);
    const auto found = run.in_the_way(actor, clear_way);
    if (!found) {
        lua_pushnil(L);
        return 1;
    }
    const std::string name = name_of(run, found->who);
    lua_pushnumber(L, found->gap);
    lua_pushlstring(L, name.data(), name.size());
    lua_pushstring(L, name_of(found->who.kind));
    return 3;
}

int lateral_gap_to(Run& run, lua_State* L) {
    const Body own = *body_of(run.last, actor_at(run, L, 1, "lateral_gap"));
    const Body other = *body_of(run.last, actor_at(run, L, 2, "lateral_gap"));
    lua_pushnumber(L, lateral_gap(own, other));
    return 1;
}

/// Left of the centre line of its lane, or of the one that is named; nil where it is not beside it.
int offset(Run& run, lua_State* L) {
    constexpr double past_end = 0.5;  // [m]
    const Actor& actor = actor_at(run, L, 1, "offset");
    const bool own = lua_isnoneornil(L, 2);
    const Body body = own ? run.look_at(actor) : *body_of(run.last, actor);
    const std::uint32_t index =
        own ? body.lane : run.lane_named(L, text_at(L, 2, "offset", "the lane"));
    if (index == world::none) {
        lua_pushnil(L);
        return 1;
    }
    const world::LaneT& lane = run.town.lanes[index];
    if (own) {
        lua_pushnumber(L, place_on_lane(run.town, body).t);
        return 1;
    }
    const world::LaneProjection at = world::project(lane, body.position);
    const double beyond =
        (body.position - world::point_at(lane, at.s).position).head<2>().squaredNorm() -
        at.t * at.t;
    if (beyond > past_end * past_end)
        lua_pushnil(L);
    else
        lua_pushnumber(L, at.t);
    return 1;
}

// --- What became of the drive.

/// These can be asked of who has left the world, and wait for who is still to come.
template <int (*function)(Run&, lua_State*)>
int since_spawn(Run& run, lua_State* L) {
    const Actor& actor = actor_at(run, L, 1, "actor");
    return actor.presence == Actor::Presence::coming ? with_presence<function>(run, L)
                                                     : function(run, L);
}

int ran_red(Run& run, lua_State* L) {
    lua_pushboolean(L, vehicle_at(run, L, "ran_red").lights.ran_red() ? 1 : 0);
    return 1;
}

int route_completion(Run& run, lua_State* L) {
    const Actor& actor = vehicle_at(run, L, "route_completion");
    if (actor.route)
        lua_pushnumber(L, actor.route->share());
    else
        lua_pushnil(L);
    return 1;
}

/// Is a wheel on something that is no road? And how many of them are.
int left_road(Run& run, lua_State* L) {
    const std::uint32_t id = vehicle_with_mass(run, L, "left_road").id;
    const auto wheels = run.last.wheels();
    auto wheel =
        std::lower_bound(wheels.begin(), wheels.end(), id, [](const auto& each, std::uint32_t own) {
            return each.vehicle() < own;
        });
    int off = 0;
    for (; wheel != wheels.end() && wheel->vehicle() == id; ++wheel) {
        const std::uint8_t surface = wheel->surface();
        const bool on_road =
            surface == road || surface == zebra || surface == marking || surface == deck;
        off += wheel->in_contact() && !on_road ? 1 : 0;
    }
    lua_pushboolean(L, off > 0 ? 1 : 0);
    lua_pushinteger(L, off);
    return 2;
}

/// Is a part of it on a lane that runs against its heading? And which share of its outline.
int on_opposite_lane(Run& run, lua_State* L) {
    const std::uint32_t id = vehicle_with_mass(run, L, "on_opposite_lane").id;
    const auto* measured = world::find(run.last.measurements(), id);
    const double share = measured == nullptr ? 0 : measured->on_opposite_lane();
    lua_pushboolean(L, share > 0 ? 1 : 0);
    lua_pushnumber(L, share);
    return 2;
}

constexpr Word sight_rows[] = {
    {"offset",
     reading<offset>,
     "(lane?: LaneName): number?",
     "[m] to the left of its lane's centre line, or of that lane's; nil off it"},
    {"around",
     reading<around>,
     "(radius: number, options?: AroundOptions): table[]",
     "everybody within so many metres, by distance"},
    {"gap_ahead",
     reading<gap_ahead>,
     "(): number?, string?, string?",
     "[m] to what is in its way along its lane, its name and kind; nil when the way is clear"},
    {"lateral_gap",
     reading<lateral_gap_to>,
     "(other: Actor): number",
     "[m] between both outlines across its heading"},
    {"ran_red",
     bound<since_spawn<ran_red>>,
     "(): boolean",
     "it has crossed a stop line at red since its spawn"},
    {"route_completion",
     bound<since_spawn<route_completion>>,
     "(): number?",
     "share [0, 1] of the way of its last route that it has driven; nil without one"},
    {"left_road",
     reading<left_road>,
     "(): boolean, integer",
     "a wheel is on something that is no road; and how many"},
    {"on_opposite_lane",
     reading<on_opposite_lane>,
     "(): boolean, number",
     "a part of it is on a lane that runs the other way; and which share"},
};

}  // namespace

constinit const WordList sight_words{Owner::actor, "Actors: looks around", sight_rows};
constinit const KeyList around_keys{"AroundOptions", "around", around_key_rows};

void add_look_words(lua_State* L) {
    add_words(L, sight_words);
}

}  // namespace reprise::scripting
