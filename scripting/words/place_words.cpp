#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/lua/binding.h"
#include "scripting/run/places.h"
#include "scripting/run/run.h"
#include "scripting/words/vocabulary.h"
#include "world/frames.h"

// Which places there are: lanes behind lanes, lanes at a point, junctions, crossings.
namespace reprise::scripting {

namespace {

constexpr Key pick_junction_key_rows[] = {
    {"lit", "boolean", "with (false: without) traffic lights"},
    {"arms", "integer", "so many streets meet"},
    {"stop", "boolean", "with (without) a stop sign"},
    {"optional", "boolean", "nil when none fits, rather than an error"},
};

constexpr Key pick_crossing_key_rows[] = {
    {"lit", "boolean", "with (without) lights for walkers"},
    {"lanes", "integer", "so many lanes for cars are crossed"},
    {"optional", "boolean", "nil when none fits, rather than an error"},
};

using world::none;

constexpr std::uint64_t search_cost = 20;  // [instructions] a lane of the town
constexpr std::uint64_t find_cost = 300;   // [instructions] of the lanes at a point

void push_name(lua_State* L, const std::string& name) {
    lua_pushlstring(L, name.data(), name.size());
}

const char* turn_name(world::Turn turn) {
    switch (turn) {
        case world::Turn::left:
        case world::Turn::partially_left:
            return "left";
        case world::Turn::right:
        case world::Turn::partially_right:
            return "right";
        case world::Turn::around:
            return "turnaround";
        case world::Turn::straight:
            break;
    }
    return "straight";
}

std::uint32_t lane_at_argument(Run& run, lua_State* L, const char* who) {
    return run.lane_named(L, text_at(L, 1, who, "the lane"));
}

// --- Lanes.

/// The lanes behind this one in that direction, or all; a sharp turn goes before a slight one.
std::vector<std::uint32_t> lanes_behind(const world::LaneT& lane, const std::string& direction) {
    std::vector<std::uint32_t> sharp;
    std::vector<std::uint32_t> slight;
    for (const world::Link& link : lane.links) {
        if (link.to() == none || (!direction.empty() && direction != turn_name(link.turn())))
            continue;
        const bool is_slight = !direction.empty() && (link.turn() == world::Turn::partially_left ||
                                                      link.turn() == world::Turn::partially_right);
        (is_slight ? slight : sharp).push_back(link.to());
    }
    sharp.insert(sharp.end(), slight.begin(), slight.end());
    return sharp;
}

int lane_next(Run& run, lua_State* L) {
    const world::LaneT& lane = run.town.lanes[lane_at_argument(run, L, "lane_next")];
    std::string direction;
    if (!lua_isnoneornil(L, 2)) {
        direction = text_at(L, 2, "lane_next", "the direction");
        const std::vector<std::string> known{"left", "right", "straight", "turnaround"};
        if (std::find(known.begin(), known.end(), direction) == known.end())
            refuse("lane_next",
                   fmt::format("no direction '{}'{}: 'left', 'right', 'straight' or 'turnaround'",
                               direction,
                               world::did_you_mean(direction, known)));
    }
    const auto lanes = lanes_behind(lane, direction);
    run.vm.charge(L, lane.links.size() * search_cost);
    if (!direction.empty()) {
        if (lanes.empty())
            lua_pushnil(L);
        else
            push_name(L, run.town.lanes[lanes.front()].name);
        return 1;
    }
    lua_createtable(L, static_cast<int>(lanes.size()), 0);
    for (std::size_t i = 0; i < lanes.size(); ++i) {
        push_name(L, run.town.lanes[lanes[i]].name);
        lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
    }
    return 1;
}

/// Kinds in the order in which they are preferred where lanes lie over each other.
int preference(world::LaneKind kind) {
    constexpr std::array order{world::LaneKind::driving,
                               world::LaneKind::internal,
                               world::LaneKind::sidewalk,
                               world::LaneKind::crossing,
                               world::LaneKind::walking_area,
                               world::LaneKind::other};
    return static_cast<int>(std::find(order.begin(), order.end(), kind) - order.begin());
}

/// Without a height: the uppermost road there.
std::optional<double> height_at(const Run& run, double x, double y) {
    std::optional<double> highest;
    for (const std::uint32_t index : run.lanes.near({x, y, 0}, 0)) {
        const world::LaneT& lane = run.town.lanes[index];
        Eigen::Vector3d p_world(x, y, lane.centre.front().z());
        for (int i = 0; i < 2; ++i)  // on a slope the nearest point moves a little
            p_world.z() = world::point_at(lane, world::project(lane, p_world).s).position.z();
        const auto holds = [&](const auto& found) {
            return std::any_of(
                found.begin(), found.end(), [&](const auto& each) { return each.lane == index; });
        };
        if ((!highest || p_world.z() > *highest) &&
            (holds(run.lanes.at(p_world)) || holds(run.lanes.walkable_at(p_world))))
            highest = p_world.z();
    }
    return highest;
}

int lane_at(Run& run, lua_State* L) {
    const double x = number_at(L, 1, "lane_at", "x");
    const double y = number_at(L, 2, "lane_at", "y");
    run.vm.charge(L, find_cost);
    const auto z = lua_isnoneornil(L, 3) ? height_at(run, x, y)
                                         : std::optional(number_at(L, 3, "lane_at", "z"));
    std::optional<world::LaneMap::Found> best;
    const auto consider = [&](const std::vector<world::LaneMap::Found>& found) {
        for (const world::LaneMap::Found& each : found) {
            const auto rank = [&](const world::LaneMap::Found& lane) {
                return std::pair(preference(run.town.lanes[lane.lane].kind), std::abs(lane.at.t));
            };
            if (!best || rank(each) < rank(*best))
                best = each;
        }
    };
    if (z) {
        consider(run.lanes.at({x, y, *z}));
        consider(run.lanes.walkable_at({x, y, *z}));
    }
    if (!best) {
        lua_pushnil(L);
        return 1;
    }
    push_name(L, run.town.lanes[best->lane].name);
    lua_pushnumber(L, best->at.s);
    lua_pushnumber(L, best->at.t);
    return 3;
}

int lane_junction(Run& run, lua_State* L) {
    const std::uint32_t junction =
        run.town.lanes[lane_at_argument(run, L, "lane_junction")].junction;
    if (junction == none)
        lua_pushnil(L);
    else
        push_name(L, run.town.junctions[junction].name);
    return 1;
}

// --- Junctions and crossings.

void set_point(lua_State* L, const Eigen::Vector3d& p_world) {
    constexpr std::array keys{"x", "y", "z"};
    for (int i = 0; i < 3; ++i) {
        lua_pushnumber(L, p_world[i]);
        lua_setfield(L, -2, keys[static_cast<std::size_t>(i)]);
    }
}

void set_flag(lua_State* L, const char* key, bool value) {
    lua_pushboolean(L, value ? 1 : 0);
    lua_setfield(L, -2, key);
}

void set_lanes(Run& run, lua_State* L, const char* key, const std::vector<std::uint32_t>& lanes) {
    lua_createtable(L, static_cast<int>(lanes.size()), 0);
    for (std::size_t i = 0; i < lanes.size(); ++i) {
        push_name(L, run.town.lanes[lanes[i]].name);
        lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
    }
    lua_setfield(L, -2, key);
}

double in_degrees(double angle) {
    return angle * 180 / std::numbers::pi;
}

void push_junction(Run& run, lua_State* L, std::uint32_t index) {
    const world::JunctionT& junction = run.town.junctions[index];
    const auto& arms = run.junction_arms()[index];
    bool stop = false;
    lua_newtable(L);
    push_name(L, junction.name);
    lua_setfield(L, -2, "name");
    set_point(L, world::to_eigen(junction.centre));
    set_flag(L, "lit", junction.lit);
    lua_createtable(L, static_cast<int>(arms.size()), 0);
    for (std::size_t i = 0; i < arms.size(); ++i) {
        const world::JunctionArm& arm = arms[i];
        lua_newtable(L);
        lua_pushnumber(L, in_degrees(arm.yaw));
        lua_setfield(L, -2, "heading_deg");
        set_lanes(run, L, "incoming", arm.incoming);
        set_lanes(run, L, "outgoing", arm.outgoing);
        set_flag(L, "yields", arm.yields);
        set_flag(L, "stop", arm.stop_sign);
        stop = stop || arm.stop_sign;
        lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
    }
    lua_setfield(L, -2, "arms");
    set_flag(L, "stop", stop);
}

void push_crossing(Run& run, lua_State* L, const world::CrossingPlace& crossing) {
    const world::LaneT& lane = run.town.lanes[crossing.lane];
    lua_newtable(L);
    push_name(L, lane.name);
    lua_setfield(L, -2, "name");
    set_point(L, (crossing.from + crossing.to) / 2);
    set_flag(L, "lit", crossing.lit);
    lua_pushnumber(L, lane.length);
    lua_setfield(L, -2, "length");
    lua_pushnumber(L, lane.width);
    lua_setfield(L, -2, "width");
    for (const auto& [key, end] :
         {std::pair("from", crossing.from), std::pair("to", crossing.to)}) {
        lua_newtable(L);
        set_point(L, end);
        lua_setfield(L, -2, key);
    }
    set_lanes(run, L, "incoming", crossing.incoming);
    set_lanes(run, L, "outgoing", crossing.outgoing);
    if (lane.junction != none) {
        push_name(L, run.town.junctions[lane.junction].name);
        lua_setfield(L, -2, "junction");
    }
}

std::string wish_text(const Fields& fields,
                      std::initializer_list<const char*> flags,
                      std::initializer_list<const char*> numbers) {
    std::string text;
    const auto add = [&](const std::string& part) {
        text += (text.empty() ? " with " : ", ") + part;
    };
    for (const char* key : flags)
        if (const auto flag = fields.flag(key))
            add(fmt::format("{} = {}", key, *flag));
    for (const char* key : numbers)
        if (const auto number = fields.integer(key))
            add(fmt::format("{} = {}", key, *number));
    return text;
}

/// One of these by the seed, or none: an error unless that is allowed. Each word draws from a
/// stream of its own.
template <typename Found>
const Found* choose(Run& run,
                    const Fields& fields,
                    const std::vector<Found>& found,
                    const std::string& what,
                    const std::string& wish) {
    if (!found.empty()) {
        const auto last = static_cast<std::int64_t>(found.size()) - 1;
        return &found[static_cast<std::size_t>(run.streams.draw_integer(fields.who(), 0, last))];
    }
    if (!fields.flag("optional").value_or(false))
        refuse(fields.who(), fmt::format("{} has no {}{}", run.town.name, what, wish));
    return nullptr;
}

bool as_wished(const std::optional<bool>& wish, bool is) {
    return !wish || *wish == is;
}

int pick_junction(Run& run, lua_State* L) {
    const Fields fields(L, 1, "pick_junction", names_of(pick_junction_key_rows), true);
    const auto lit = fields.flag("lit");
    const auto stop = fields.flag("stop");
    const auto wanted = fields.integer("arms");
    if (wanted && *wanted < 3)
        refuse("pick_junction", fmt::format("'arms' must be 3 or more, got {}", *wanted));
    run.vm.charge(L, run.town.lanes.size() * search_cost);
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < run.town.junctions.size(); ++i) {
        const auto& arms = run.junction_arms()[i];
        const bool has_stop =
            std::any_of(arms.begin(), arms.end(), [](const auto& arm) { return arm.stop_sign; });
        if (arms.size() >= 3 && (!wanted || static_cast<std::size_t>(*wanted) == arms.size()) &&
            as_wished(lit, run.town.junctions[i].lit) && as_wished(stop, has_stop))
            found.push_back(i);
    }
    const std::string wish = wish_text(fields, {"lit", "stop"}, {"arms"});
    const auto* const chosen = choose(run, fields, found, "junction", wish);
    if (chosen == nullptr)
        lua_pushnil(L);
    else
        push_junction(run, L, *chosen);
    return 1;
}

int pick_crossing(Run& run, lua_State* L) {
    const Fields fields(L, 1, "pick_crossing", names_of(pick_crossing_key_rows), true);
    const auto lit = fields.flag("lit");
    const auto wanted = fields.integer("lanes");
    run.vm.charge(L, run.town.lanes.size() * search_cost);
    std::vector<const world::CrossingPlace*> found;
    for (const world::CrossingPlace& crossing : run.crossings()) {
        const std::size_t lanes = crossing.incoming.size() + crossing.outgoing.size();
        if (!crossing.incoming.empty() && as_wished(lit, crossing.lit) &&
            (!wanted || static_cast<std::size_t>(*wanted) == lanes))
            found.push_back(&crossing);
    }
    const std::string wish = wish_text(fields, {"lit"}, {"lanes"});
    const auto* const chosen = choose(run, fields, found, "pedestrian crossing", wish);
    if (chosen == nullptr)
        lua_pushnil(L);
    else
        push_crossing(run, L, **chosen);
    return 1;
}

constexpr Word junction_rows[] = {
    {"lane_at",
     bound<lane_at>,
     "(x: number, y: number, z?: number): LaneName?, number?, number?",
     "the lane there, s and offset [m] on it; nil where no lane is"},
    {"lane_next",
     bound<lane_next>,
     "(lane: LaneName, direction?: 'left'|'right'|'straight'|'turnaround'): "
     "LaneName|LaneName[]|nil",
     "the lane behind it in that direction, or nil; without one a list of all"},
    {"lane_junction",
     bound<lane_junction>,
     "(lane: LaneName): string?",
     "the junction at its end, or nil"},
    {"pick_junction",
     acting<pick_junction>,
     "(wish?: PickJunctionOptions): table?",
     "a junction of three streets or more that fits, by the seed"},
    {"pick_crossing",
     acting<pick_crossing>,
     "(wish?: PickCrossingOptions): table?",
     "a pedestrian crossing that fits, by the seed"},
};

}  // namespace

constinit const WordList junction_words{Owner::global, "Junctions and crossings", junction_rows};
constinit const KeyList pick_junction_keys{
    "PickJunctionOptions", "pick_junction", pick_junction_key_rows};
constinit const KeyList pick_crossing_keys{
    "PickCrossingOptions", "pick_crossing", pick_crossing_key_rows};

void add_place_words(lua_State* L) {
    add_words(L, junction_words);
}

}  // namespace reprise::scripting
