#include "traffic/roads/road_graph.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/towns.h"
#include "tests/support/worlds.h"
#include "traffic/route_planner.h"
#include "world/models/catalogue.h"
#include "world/models/vehicle_classes.h"

namespace reprise::traffic {
namespace {

using test::lane;
using test::own_town;
using world::TownT;

RoadGraph graph_of(const TownT& town) {
    return {town,
            std::vector<world::ClassSet>(town.lanes.size(), world::permitted("", "pedestrian"))};
}

TEST(RoadGraph, InternalLanesKnowWhereTheyComeFromAndLead) {
    const TownT& town = own_town("town1").town;
    const RoadGraph graph = graph_of(town);
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
        if (world::is_for_cars(town.lanes[i])) {
            ASSERT_NE(graph.edge_of(i), world::none) << town.lanes[i].name;
            const auto& successors = graph.edge(graph.edge_of(i)).successors;
            if (town.lanes[i].kind == world::LaneKind::internal) {
                EXPECT_TRUE(
                    std::binary_search(successors.begin(), successors.end(), graph.edge_after(i)));
            }
        }
}

TEST(RoadGraph, ShortestWaysAreThoseOfFloydAndWarshall) {
    const TownT& town = own_town("town2").town;
    const RoadGraph graph = graph_of(town);
    const std::size_t count = graph.size();
    std::vector<std::vector<double>> cost(count, std::vector<double>(count, 1e9));
    for (std::uint32_t i = 0; i < count; ++i) {
        for (const std::uint32_t next : graph.edge(i).successors)
            cost[i][next] = graph.edge(next).length;
        cost[i][i] = 0;
    }
    for (std::size_t via = 0; via < count; ++via)
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = 0; j < count; ++j)
                cost[i][j] = std::min(cost[i][j], cost[i][via] + cost[via][j]);
    for (std::uint32_t i = 0; i < count; ++i)
        for (std::uint32_t j = 0; j < count; ++j) {
            const std::vector<std::uint32_t> way = graph.shortest(i, j);
            ASSERT_FALSE(way.empty());
            EXPECT_EQ(way.front(), i);
            EXPECT_EQ(way.back(), j);
            double length = 0;
            for (std::size_t k = 1; k < way.size(); ++k) {
                const auto& successors = graph.edge(way[k - 1]).successors;
                EXPECT_TRUE(std::binary_search(successors.begin(), successors.end(), way[k]));
                length += graph.edge(way[k]).length;
            }
            EXPECT_NEAR(length, cost[i][j], 1e-6);
        }
}

/// A bus that turned around at the end of a street of 3.2 m lanes pressed a walker against a hedge
/// for 100 s.
TEST(RoutePlanner, BusesOfTheTownTurnAroundNowhereNarrow) {
    TownT town = test::straight_road(200);
    const std::uint32_t there = lane(town, "east_1");
    const std::uint32_t back = lane(town, "west_1");
    town.lanes[there].links.emplace_back(
        back, world::none, 0, world::Turn::around, false, std::uint16_t{0});
    const auto leaves = [&](const char* model, Origin origin) {
        const RoadGraph graph = graph_of(town);
        Car car;
        car.id = 1'000'003;
        car.origin = origin;
        car.model = *world::find_vehicle_model(model);
        RoutePlanner(graph, 7).start(there, car);
        return car.route.size() == 1 && car.dead_end;
    };
    EXPECT_TRUE(leaves("bus", Origin::demand));
    EXPECT_TRUE(leaves("lorry", Origin::demand));
    EXPECT_FALSE(leaves("sedan", Origin::demand));
    EXPECT_FALSE(leaves("bus", Origin::scripted)) << "by a scenario's word";
    for (world::Vec3& point : town.lanes[back].centre)
        point.mutate_y(point.y() + 10);
    EXPECT_FALSE(leaves("bus", Origin::demand)) << "round a wide green";
}

TEST(RoutePlanner, RoutesFollowConnections) {
    const TownT& town = own_town("town1").town;
    const RoadGraph graph = graph_of(town);
    Car car;
    car.id = 1'000'003;
    RoutePlanner(graph, 7).start(lane(town, "a1_a2_1"), car);
    EXPECT_FALSE(car.dead_end);
    double length = 0;
    for (std::size_t i = 1; i < car.route.size(); ++i) {
        const auto& successors = graph.edge(car.route[i - 1]).successors;
        EXPECT_TRUE(std::binary_search(successors.begin(), successors.end(), car.route[i]));
        length += graph.edge(car.route[i]).length;
    }
    EXPECT_GE(length, RoutePlanner::length);
    Car other = car;
    RoutePlanner(graph, 8).start(lane(town, "a1_a2_1"), other);
    EXPECT_NE(car.route, other.route);
}

}  // namespace
}  // namespace reprise::traffic
