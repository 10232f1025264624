#include "scripting/words/run.h"

#include <fmt/format.h>

#include "scripting/words/places.h"
#include "world/check.h"

namespace reprise::scripting {

namespace {

constexpr std::uint64_t look_cost = 300;          // [instructions] of a lane by its place
constexpr std::uint64_t mistaken_lane_cost = 20;  // [instructions] a lane, to find what was meant

}  // namespace

std::uint32_t Run::lane_named(lua_State* L, const std::string& name) {
    if (!world::find_lane(town, name))
        vm.charge(L, town.lanes.size() * mistaken_lane_cost);
    return scripting::lane_named(town, name);
}

Body Run::look_at(const Actor& actor) {
    vm.charge_later(look_cost);
    const auto body = body_of(last, actor);
    REPRISE_CHECK(body, fmt::format("actor {} is not in tick {}", actor.name, now()));
    Body placed = *body;
    if (placed.lane != world::none)
        return placed;
    if (actor.is_walker()) {
        const auto walkable = lanes.walkable_at(placed.position);
        const auto roads = lanes.at(placed.position);
        if (!roads.empty())
            placed.lane = roads.front().lane;
        else if (!walkable.empty())
            placed.lane = walkable.front().lane;
    } else if (const auto best = lanes.best(placed.position, placed.yaw)) {
        placed.lane = best->lane;
    }
    return placed;
}

}  // namespace reprise::scripting
