#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/lua/binding.h"
#include "scripting/run/run.h"
#include "scripting/words/vocabulary.h"
#include "world/lanes/road_place.h"

// Places as OpenDRIVE says them, in towns that were made of such a map.
namespace reprise::scripting {

namespace {

constexpr std::uint64_t road_cost = 20;  // [instructions] a lane, to find a road

/// Of an id both '12' and 12 are taken.
std::string road_at(lua_State* L, int index, const char* who) {
    return lua_isinteger(L, index) != 0 ? std::to_string(lua_tointeger(L, index))
                                        : text_at(L, index, who, "the road");
}

int road_lane(Run& run, lua_State* L) {
    world::RoadPlace place;
    place.road = road_at(L, 1, "road_lane");
    place.lane = static_cast<int>(integer_at(L, 2, "road_lane", "the lane"));
    place.s = number_at(L, 3, "road_lane", "s");
    run.vm.charge(L, run.town.lanes.size() * road_cost);
    try {
        const world::FoundPlace found = world::road_place_named(run.town, place);
        const std::string& name = run.town.lanes[found.lane].name;
        lua_pushlstring(L, name.data(), name.size());
        lua_pushnumber(L, found.s);
    } catch (const world::Error& error) {
        refuse("road_lane", error.what());
    }
    return 2;
}

int lane_road(Run& run, lua_State* L) {
    const world::LaneT& lane =
        run.town.lanes[run.lane_named(L, text_at(L, 1, "lane_road", "the lane"))];
    const double s = lua_isnoneornil(L, 2) ? 0 : number_at(L, 2, "lane_road", "s");
    const auto place = world::road_place(lane, s);
    if (!place) {
        lua_pushnil(L);
        return 1;
    }
    lua_pushlstring(L, place->road.data(), place->road.size());
    lua_pushinteger(L, place->lane);
    lua_pushnumber(L, place->s);
    return 3;
}

constexpr Word road_rows[] = {
    {"road_lane",
     bound<road_lane>,
     "(road: string|integer, lane: integer, s: number): LaneName, number",
     "the lane and s [m] on it of a place of the OpenDRIVE map that the town was"},
    {"lane_road",
     bound<lane_road>,
     "(lane: LaneName, s?: number): string?, integer?, number?",
     "the OpenDRIVE road, its lane and s [m] of a place on a lane; nil where there is none"},
};

}  // namespace

constinit const WordList road_words{Owner::global, "Places of an OpenDRIVE map", road_rows};

}  // namespace reprise::scripting
