#include "scripting/words/handles.h"

#include <cmath>
#include <cstring>
#include <numbers>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/lua/sandbox.h"
#include "scripting/run/measures.h"
#include "scripting/words/vocabulary.h"
#include "world/frames.h"

namespace reprise::scripting {

namespace {

constexpr Key ttc_key_rows[] = {
    {"same_lane", "boolean", "math.huge as well while both are on different lanes"},
};

constexpr const char* handle_type = "actor";    // name of the metatable in Lua's registry
constexpr const char* handle_list = "handles";  // id -> handle
constexpr std::uint64_t lane_cost = 50;  // [instructions] of a lane that a search for a way passed
constexpr std::uint64_t patience = 100;  // [ticks] for an actor to appear

/// 0 when the argument is no handle. Of all userdata the first four bytes can be read: tasks have
/// eight.
std::uint32_t handle_id(lua_State* L, int index) {
    const void* held = lua_touserdata(L, index);
    if (held == nullptr)
        return 0;
    std::uint32_t id = 0;
    std::memcpy(&id, held, sizeof id);
    const std::vector<const void*>& handles = Vm::of(L).actor_handles;
    return id < handles.size() && handles[id] == held ? id : 0;
}

Actor& self(Run& run, lua_State* L) {
    return actor_at(run, L, 1, "actor");
}

int name(Run& run, lua_State* L) {
    const Actor& actor = self(run, L);
    lua_pushlstring(L, actor.name.data(), actor.name.size());
    return 1;
}

int id(Run& run, lua_State* L) {
    lua_pushinteger(L, self(run, L).id);
    return 1;
}

int exists(Run& run, lua_State* L) {
    lua_pushboolean(L, self(run, L).presence == Actor::Presence::here ? 1 : 0);
    return 1;
}

int position(Run& run, lua_State* L) {
    const Body body = *body_of(run.last, self(run, L));
    lua_pushnumber(L, body.position.x());
    lua_pushnumber(L, body.position.y());
    lua_pushnumber(L, body.position.z());
    return 3;
}

int speed(Run& run, lua_State* L) {
    lua_pushnumber(L, body_of(run.last, self(run, L))->speed + 0.0);  // never -0.0
    return 1;
}

int acceleration(Run& run, lua_State* L) {
    const Actor& actor = self(run, L);
    if (actor.is_walker() || actor.is_prop())
        refuse("acceleration",
               fmt::format("'{}' is a {}: only vehicles have one",
                           actor.name,
                           actor.is_prop() ? "prop" : "walker"));
    lua_pushnumber(L, body_of(run.last, actor)->acceleration);
    return 1;
}

int heading_deg(Run& run, lua_State* L) {
    lua_pushnumber(L, body_of(run.last, self(run, L))->yaw * 180 / std::numbers::pi);
    return 1;
}

int lane(Run& run, lua_State* L) {
    const Body body = run.look_at(self(run, L));
    if (body.lane == world::none) {
        lua_pushnil(L);
        return 1;
    }
    const std::string& name_of_lane = run.town.lanes[body.lane].name;
    lua_pushlstring(L, name_of_lane.data(), name_of_lane.size());
    return 1;
}

/// Along its lane, or nil off every lane.
int s_on_lane(Run& run, lua_State* L) {
    const Body body = run.look_at(self(run, L));
    if (body.lane == world::none)
        lua_pushnil(L);
    else
        lua_pushnumber(L, place_on_lane(run.town, body).s);
    return 1;
}

int collided(Run& run, lua_State* L) {
    const Contacts& contacts = self(run, L).contacts;
    bool did = contacts.vehicle || contacts.walker || contacts.fixed || contacts.prop;
    if (const std::uint32_t other = handle_id(L, 2)) {
        did = contacts.others.count(other) != 0;
    } else if (!lua_isnoneornil(L, 2)) {
        const std::string kind = text_at(L, 2, "collided", "the other one");
        if (kind == "vehicle")
            did = contacts.vehicle;
        else if (kind == "walker")
            did = contacts.walker;
        else if (kind == "static")
            did = contacts.fixed;
        else if (kind == "prop")
            did = contacts.prop;
        else
            refuse("collided",
                   fmt::format("no kind '{}'{}: 'vehicle', 'walker', 'prop', 'static' or an actor",
                               kind,
                               world::did_you_mean(kind, {"vehicle", "walker", "prop", "static"})));
    }
    lua_pushboolean(L, did ? 1 : 0);
    return 1;
}

/// A check that asks about an actor which never came has seen nothing.
int collided_since_spawn(Run& run, lua_State* L) {
    return self(run, L).presence == Actor::Presence::coming ? with_presence<collided>(run, L)
                                                            : collided(run, L);
}

int distance_driven(Run& run, lua_State* L) {
    lua_pushnumber(L, self(run, L).travelled);
    return 1;
}

int to_string(Run& run, lua_State* L) {
    return name(run, L);
}

/// Who was spawned before this script took over, by name.
int actor_named(Run& run, lua_State* L) {
    const std::string wanted = text_at(L, 1, "actor", "the name");
    run.vm.charge(L, run.actors.next_id());
    const Actor* actor = run.actors.find(wanted);
    if (actor == nullptr) {
        std::string list;
        for (const std::string& name : run.actors.names())
            list += (list.empty() ? "" : ", ") + name;
        refuse("actor",
               fmt::format("nobody is called '{}'{}; there are {}",
                           wanted,
                           world::did_you_mean(wanted, run.actors.names()),
                           list.empty() ? "none" : list));
    }
    push_handle(L, actor->id);
    return 1;
}

// --- Between two actors.

int gap_between(Run& run, lua_State* L) {
    const Actor& a = actor_at(run, L, 1, "gap");
    const Actor& b = actor_at(run, L, 2, "gap");
    const Gap between = run.gap(a, b);
    run.vm.charge(L, between.searched * lane_cost);
    lua_pushnumber(L, between.length);
    return 1;
}

int distance_between(Run& run, lua_State* L) {
    const Body a = *body_of(run.last, actor_at(run, L, 1, "distance"));
    const Body b = *body_of(run.last, actor_at(run, L, 2, "distance"));
    lua_pushnumber(L, distance(a, b));
    return 1;
}

int ttc(Run& run, lua_State* L) {
    const Actor& a = actor_at(run, L, 1, "ttc");
    const Actor& b = actor_at(run, L, 2, "ttc");
    const bool one_lane =
        !lua_isnoneornil(L, 3) &&
        Fields(L, 3, "ttc", names_of(ttc_key_rows)).flag("same_lane").value_or(false);
    if (one_lane && !share_lane(run.town, run.look_at(a), run.look_at(b))) {
        lua_pushnumber(L, HUGE_VAL);
        return 1;
    }
    const Gap between = run.gap(a, b);
    run.vm.charge(L, between.searched * lane_cost);
    const auto body = [&](const Actor& actor) { return *body_of(run.last, actor); };
    lua_pushnumber(L, time_to_collision(between, body(a), body(b)));
    return 1;
}

constexpr Word look_rows[] = {
    {"name", bound<name>, "(): string", "of the spawn"},
    {"id", bound<id>, "(): integer", "in the trace"},
    {"exists", bound<exists>, "(): boolean", "is it in the world?"},
    {"position", reading<position>, "(): number, number, number", "x, y, z [m] in the world"},
    {"speed", reading<speed>, "(): number", "[m/s] along its heading"},
    {"acceleration", reading<acceleration>, "(): number", "[m/s^2] along its heading; of vehicles"},
    {"heading_deg", reading<heading_deg>, "(): number", "(-180, 180] counter-clockwise from east"},
    {"lane", reading<lane>, "(): LaneName?", "the lane it is on; nil off every lane"},
    {"s", reading<s_on_lane>, "(): number?", "[m] along its lane; nil off every lane"},
    {"collided",
     bound<collided_since_spawn>,
     "(other?: Actor|'vehicle'|'walker'|'prop'|'static'): boolean",
     "did it touch anybody, or that one, since its spawn?"},
    {"distance_driven", bound<distance_driven>, "(): number", "[m] since its spawn"},
    {"speed_kmh", nullptr, "(): number", "[km/h] along its heading"},
    {"x", nullptr, "(): number", "[m] in the world, to the east"},
    {"y", nullptr, "(): number", "[m] in the world, to the north"},
};

constexpr Word pair_rows[] = {
    {"gap", reading<gap_between>, "(a: Actor, b: Actor): number", "[m] from bumper to bumper"},
    {"distance",
     reading<distance_between>,
     "(a: Actor, b: Actor): number",
     "[m] between the centres of the bounding boxes"},
    {"ttc",
     reading<ttc>,
     "(a: Actor, b: Actor, options?: TtcOptions): number",
     "[s] until the gap is closed at the present speeds; math.huge when it is not closing"},
};

constexpr Word branch_rows[] = {
    {"actor", bound<actor_named>, "(name: string): Actor", "who was spawned before"},
};

}  // namespace

constinit const WordList actor_looks{Owner::actor, "Actors: looks", look_rows};
constinit const WordList pair_words{Owner::global, "Between two", pair_rows};
constinit const KeyList ttc_keys{"TtcOptions", "ttc", ttc_key_rows};
constinit const WordList branch_words{
    Owner::global, "What if: in scripts of reprise branch only", branch_rows};

void push_handle(lua_State* L, std::uint32_t actor) {
    luaL_getsubtable(L, LUA_REGISTRYINDEX, handle_list);
    if (lua_rawgeti(L, -1, actor) == LUA_TNIL) {
        lua_pop(L, 1);
        auto* const handle = static_cast<std::uint32_t*>(lua_newuserdatauv(L, sizeof actor, 0));
        *handle = actor;
        std::vector<const void*>& handles = Vm::of(L).actor_handles;
        if (handles.size() <= actor)
            handles.resize(actor + 1);
        handles[actor] = handle;
        luaL_setmetatable(L, handle_type);
        lua_pushvalue(L, -1);
        lua_rawseti(L, -3, actor);
    }
    lua_remove(L, -2);
}

Actor& actor_at(Run& run, lua_State* L, int index, const char* who) {
    const std::uint32_t actor = handle_id(L, index);
    if (actor == 0)
        refuse(who,
               fmt::format("an actor is needed as argument {}, got {}: write ego:speed(), "
                           "gap(ego, other)",
                           index,
                           luaL_typename(L, index)));
    return run.actors.at(actor);
}

bool all_present(Run& run, lua_State* L) {
    for (int index = 1; index <= lua_gettop(L); ++index) {
        const std::uint32_t actor = handle_id(L, index);
        if (actor != 0 && run.actors.at(actor).presence != Actor::Presence::here)
            return false;
    }
    return true;
}

int wait_for_presence(Run& run, lua_State* L, int (*again)(lua_State*, int, std::ptrdiff_t)) {
    if (run.vm.in_check) {
        run.vm.not_ready = true;
        run.vm.raise(L, "not there");
    }
    for (int index = 1; index <= lua_gettop(L); ++index) {
        const std::uint32_t absent = handle_id(L, index);
        if (absent == 0)
            continue;
        const Actor& actor = run.actors.at(absent);
        if (actor.presence == Actor::Presence::gone)
            throw world::Error(fmt::format("'{}' left the world in tick {}: ask {}:exists() first",
                                           actor.name,
                                           actor.gone_at,
                                           actor.name));
        if (actor.presence == Actor::Presence::coming && run.now() > actor.asked_at + patience)
            throw world::Error(fmt::format("{}:{}: spawn: '{}' did not appear within {} ticks",
                                           run.vm.script(),
                                           actor.line,
                                           actor.name,
                                           patience));
    }
    if (lua_isyieldable(L) == 0)
        throw world::Error("an actor used here is not there yet: wait_ticks(1) after spawn");
    return lua_yieldk(L, 0, 0, again);
}

void add_handle_words(lua_State* L) {
    luaL_newmetatable(L, handle_type);
    lua_newtable(L);  // the methods
    add_words(L, actor_looks);
    add_look_words(L);
    add_drive_words(L);
    add_equipment_words(L);
    add_placing_words(L);
    refuse_unknown(L, "an actor");
    lua_pushvalue(L, -1);
    lua_setfield(L, -4, "_actor");  // the prelude adds to it
    lua_setfield(L, -2, "__index");
    add_function(L, "__tostring", bound<to_string>);
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_pop(L, 1);
    // Only there: a word more would change the memory of every script that never says it.
    if (Vm::of(L).in_branch)
        add_words(L, branch_words);
    add_words(L, pair_words);
}

}  // namespace reprise::scripting
