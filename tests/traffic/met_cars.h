#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "tests/support/towns.h"
#include "traffic/cars/cars.h"
#include "traffic/cars/fleet.h"
#include "traffic/roads/road_graph.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"
#include "world/models/vehicle_classes.h"
#include "world/tick.h"
#include "world/town.h"

/// Cars put where ways meet, without SUMO.
namespace reprise::traffic {

using test::own_town;
using world::TownT;

constexpr double meeting_step = 0.05;  // [s]

inline RoadGraph graph_for(const TownT& town) {
    return {town,
            std::vector<world::ClassSet>(town.lanes.size(), world::permitted("", "pedestrian"))};
}

/// Of SUMO, that far [m] before the end of a lane that leads into `via`, on its way through that.
inline Car car_before(const TownT& town,
                      const RoadGraph& graph,
                      std::uint32_t id,
                      const char* model,
                      std::uint32_t lane,
                      std::uint32_t via,
                      double before,
                      double speed) {
    Car car;
    car.id = id;
    car.model = world::find_vehicle_model(model).value();
    car.sumo = "known";
    car.lane = lane;
    const world::LaneT& on = town.lanes[lane];
    car.lane_position = (on.length - before) / on.length * on.sumo_length;
    car.speed = speed;
    car.route = {graph.edge_of(lane), graph.edge_after(via)};
    const world::LanePoint at = world::point_at(on, on.length - before);
    car.turn_to(at.yaw);
    const Eigen::Vector3d ahead(std::cos(at.yaw), std::sin(at.yaw), 0);
    car.trail.start(at.position, -ahead, origin_to_front(car.model));
    car.rear = car.trail.rear();
    return car;
}

/// A lane and the one of a junction that it leads to.
using Entry = std::pair<std::uint32_t, std::uint32_t>;

inline std::vector<Entry> entries_of(const TownT& town) {
    std::vector<Entry> entries;
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
        if (world::is_for_cars(town.lanes[i]) && town.lanes[i].kind != world::LaneKind::internal &&
            town.lanes[i].length > 25)
            for (const world::Link& link : town.lanes[i].links)
                if (link.via() != world::none)
                    entries.emplace_back(i, link.via());
    return entries;
}

/// In the junction, so far [m] along its lane, and there for long.
inline Car car_inside(
    const TownT& town, const RoadGraph& graph, std::uint32_t id, const Entry& entry, double s) {
    Car car = car_before(town, graph, id, "sedan", entry.first, entry.second, 1, 0);
    const world::LaneT& on = town.lanes[entry.second];
    for (double driven = -1; driven <= s; driven += 0.1)
        car.trail.advance(driven < 0 ? world::point_at(town.lanes[entry.first],
                                                       town.lanes[entry.first].length + driven)
                                           .position
                                     : world::point_at(on, driven).position);
    car.lane = entry.second;
    car.lane_position = s / on.length * on.sumo_length;
    car.rear = car.trail.rear();
    const Eigen::Vector2d body = (car.trail.front() - car.rear).head<2>();
    car.turn_to(std::atan2(body.y(), body.x()));
    car.standing_ticks = car.stuck_ticks = 200;
    return car;
}

/// [m] between the places of the first and of the second one on their lanes, and of the last place
/// before the lane's end.
struct PairPlaces {
    double one = 1;
    double other = 1;
    double margin = 1;
};

/// Two that stand in one junction, which they came into by different roads, at each two places of
/// their lanes: visit(one's entry, the other one's, both cars).
template <typename Visit>
void for_pairs_inside(const TownT& town,
                      const RoadGraph& graph,
                      const PairPlaces& places,
                      const Visit& visit) {
    const std::vector<Entry> entries = entries_of(town);
    for (const Entry& one : entries)
        for (const Entry& other : entries) {
            if (graph.edge_of(one.first) >= graph.edge_of(other.first) ||
                town.lanes[one.second].junction != town.lanes[other.second].junction)
                continue;
            const double end = town.lanes[one.second].length - places.margin;
            const double its_end = town.lanes[other.second].length - places.margin;
            for (double s = 1; s < end; s += places.one)
                for (double its = 1; its < its_end; its += places.other) {
                    Cars cars;
                    world::TickDraft draft;
                    cars.add(car_inside(town, graph, 7, one, s), "", 0, draft);
                    cars.add(car_inside(town, graph, 8, other, its), "", 0, draft);
                    visit(one, other, cars);
                }
        }
}

}  // namespace reprise::traffic
