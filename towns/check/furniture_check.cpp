// Must: find every signal without a lamp, every spawn point that is none, and everything that
//   stands in the way of cars, walkers, or of a bus that turns.
// Assumes: nothing; indices out of range are faults like others.
// Goes: lanes look up what stands near.
// Keeps: for each criterion the faults, in the order of the town.
#include "towns/check/furniture_check.h"

#include <cmath>
#include <map>

#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/town.h"

namespace reprise::towns {

namespace {

constexpr double for_cars = 0.9;      ///< [m] kept clear on both sides of a centre line
constexpr double spawn_reach = 0.05;  ///< [m] of a spawn point from its place on the lane

using Place = Criterion::Place;

Criterion check_ways(const world::TownT& town, const ThingsInTown& things) {
    std::map<std::string, Place> faults;
    for (const world::LaneT& lane : town.lanes) {
        const bool is_sidewalk =
            lane.kind == world::LaneKind::sidewalk || lane.kind == world::LaneKind::crossing;
        if (!world::is_for_cars(lane) && !is_sidewalk)
            continue;
        for (std::size_t i = 0; i + 1 < lane.centre.size(); ++i)
            things.for_each_on(lane.centre[i],
                               lane.centre[i + 1],
                               is_sidewalk ? walker_clearance : for_cars,
                               [&](const ThingsInTown::Thing& thing) {
                                   const std::string name = thing.name + " on " + lane.name;
                                   faults.try_emplace(name, Place{name, thing.loop[0], 1});
                               });
    }
    std::vector<Place> listed;
    for (const auto& [name, place] : faults)
        listed.push_back(place);
    return none_of(
        "things in the way", std::move(listed), std::to_string(things.size()) + " things");
}

/// In bends a bus passes over more than its lane.
Criterion check_bends(const world::TownT& town, const ThingsInTown& things) {
    constexpr double grazing = 0.05;  // [m] of bodies that are boxes, and poles of one size
    std::map<std::string, Place> faults;
    const std::vector<ground::SweptBody> bodies = ground::bus_bodies(town);
    for (const ground::SweptBody& body : bodies)
        things.for_each_in(body, grazing, [&](const ThingsInTown::Thing& thing) {
            faults.try_emplace(thing.name, Place{thing.name, thing.loop[0], 1});
        });
    std::vector<Place> listed;
    for (const auto& [name, place] : faults)
        listed.push_back(place);
    return none_of("things that buses sweep",
                   std::move(listed),
                   std::to_string(bodies.size()) + " places of a bus in bends");
}

/// A group is what one lane (or crossing) sees of one program.
Criterion check_heads(const world::TownT& town) {
    std::vector<bool> is_shown(town.signals.size(), false);
    for (const world::SignalHeadT& head : town.heads)
        for (const std::uint32_t signal : head.signals)
            if (signal < is_shown.size())
                is_shown[signal] = true;
    std::map<std::string, Place> dark;
    std::map<std::string, int> groups;
    for (std::size_t i = 0; i < town.signals.size(); ++i) {
        const world::SignalT& signal = town.signals[i];
        std::string name = signal.program + " for ";
        if (signal.lane < town.lanes.size())
            name += town.lanes[signal.lane].name;
        else
            name += "walkers, link " + std::to_string(signal.index);
        ++groups[name];
        if (!is_shown[i])
            dark.try_emplace(name, Place{name, world::in_plan(signal.position), 1});
    }
    std::vector<Place> listed;
    for (const auto& [name, place] : dark)
        listed.push_back(place);
    return none_of(
        "signals without a head", std::move(listed), std::to_string(groups.size()) + " groups");
}

/// What is wrong with a spawn point; "": nothing.
std::string fault_of(const world::TownT& town, const world::SpawnPoint& point) {
    if (point.lane() >= town.lanes.size())
        return "no such lane";
    const world::LaneT& lane = town.lanes[point.lane()];
    if (lane.kind != (point.for_walkers() ? world::LaneKind::sidewalk : world::LaneKind::driving))
        return "is not for " + std::string(point.for_walkers() ? "walkers" : "cars");
    if (!(point.s() >= 0 && point.s() <= lane.length))
        return "beyond the lane's end";
    // A walker's stands on the sidewalk, a kerb above the lane's line.
    const Eigen::Vector3d off =
        world::to_eigen(point.position()) - world::point_at(lane, point.s()).position;
    const double aside = off.head<2>().norm();
    const double reach = point.for_walkers() ? lane.width / 2 : spawn_reach;
    return aside <= reach && std::abs(off.z()) <= 0.25 ? "" : "not on its lane";
}

Criterion check_spawn_points(const world::TownT& town, const ThingsInTown& things) {
    std::vector<Place> faults;
    for (std::size_t i = 0; i < town.spawn_points.size(); ++i) {
        const world::SpawnPoint& point = town.spawn_points[i];
        std::string fault = fault_of(town, point);
        things.for_each_on(
            point.position(),
            point.position(),
            point.for_walkers() ? walker_clearance : for_cars,
            [&](const ThingsInTown::Thing& thing) { fault = thing.name + " stands there"; });
        if (!fault.empty())
            faults.push_back(
                {numbered("spawn point", i) + ": " + fault, world::in_plan(point.position()), 1});
    }
    if (town.spawn_points.empty())
        faults.push_back({"there is no spawn point", world::in_plan(town.low), 1});
    return none_of("bad spawn points",
                   std::move(faults),
                   std::to_string(town.spawn_points.size()) + " points");
}

}  // namespace

std::vector<Criterion> check_furniture(const world::TownT& town) {
    const ThingsInTown things(town);
    return {check_heads(town),
            check_spawn_points(town, things),
            check_ways(town, things),
            check_bends(town, things)};
}

}  // namespace reprise::towns
