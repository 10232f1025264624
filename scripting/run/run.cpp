#include "scripting/run/run.h"

#include <cmath>

#include <fmt/format.h>

#include "scripting/run/places.h"
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
    return with_lane(*body, actor.is_walker());
}

Body Run::with_lane(const Body& body, bool is_walker) {
    Body placed = body;
    if (placed.lane != world::none)
        return placed;
    if (is_walker) {
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

Gap Run::gap(const Actor& a, const Actor& b) {
    if (gaps_at_ != now())
        gaps_.clear();
    gaps_at_ = now();
    const auto [found, is_new] = gaps_.try_emplace({a.id, b.id});
    if (is_new)
        found->second = scripting::gap(town, look_at(a), look_at(b));
    return found->second;
}

std::optional<InTheWay> Run::in_the_way(const Actor& actor, double range) {
    if (in_the_way_at_ != now())
        in_the_way_.clear();
    in_the_way_at_ = now();
    const auto [found, is_new] = in_the_way_.try_emplace(actor.id);
    if (is_new) {
        std::span<const world::Route::Piece> route;
        if (actor.route)
            route = actor.route->to_come();
        found->second = find_ahead(town, last, look_at(actor), actor.id, route, range);
    }
    return found->second;
}

void Run::observe() {
    actors.observe(last, step, [&](Actor& actor, const Body& body, double driven) {
        if (actor.is_walker() || actor.driver == world::Driver::parked)
            return;
        if (!stop_lines.empty()) {
            if (actor.displaced_at != 0 && actor.displaced_at + 1 == now())
                actor.lights.lose_sight();
            const double farthest = 2 * std::abs(body.speed) * step + 2;
            actor.lights.observe(
                town, stop_lines, last, body.position, body.yaw, body.front, farthest);
        }
        if (!actor.route)
            return;
        std::optional<world::LanePlace> place;
        if (body.lane != world::none)
            place = {body.lane, place_on_lane(town, body).s};
        actor.route->drive_on(town, place, driven, body.front);
    });
}

const std::vector<Neighbour>& Run::everybody() {
    if (everybody_at_ != now()) {
        everybody_at_ = now();
        everybody_ = scripting::everybody(last);
    }
    return everybody_;
}

const std::vector<std::vector<world::JunctionArm>>& Run::junction_arms() {
    if (!arms_)
        arms_ = world::arms_of_junctions(town);
    return *arms_;
}

const std::vector<world::CrossingPlace>& Run::crossings() {
    if (!crossings_)
        crossings_ = world::crossings_of(town, lanes);
    return *crossings_;
}

}  // namespace reprise::scripting
