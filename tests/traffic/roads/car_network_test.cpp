#include "traffic/roads/car_network.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <libsumo/libsumo.h>

#include "tests/support/towns.h"
#include "tests/traffic/stage.h"
#include "traffic/roads/right_of_way.h"
#include "traffic/roads/road_graph.h"
#include "traffic/sumo.h"
#include "world/episode_generated.h"
#include "world/models/vehicle_classes.h"

namespace reprise::traffic {
namespace {

world::EpisodeT episode() {
    world::EpisodeT plain;
    plain.step_ns = 50'000'000;
    return plain;
}

/// Town 1 with a lane for bicycles beside one for cars; one that turned left from it waited within
/// the junction, which has lights.
test::Loaded with_bicycle_lane() {
    return test::load_changed("town1", [](std::string& line) {
        const auto at = line.find("disallow=\"");
        if (line.find("<lane id=\"r1_t3_2\"") != line.npos && at != line.npos)
            line.replace(at, line.find('"', at + 10) + 1 - at, "allow=\"bicycle\"");
    });
}

/// Each lane in a junction that lets another one go first, with it.
using Rights = std::set<std::pair<std::string, std::string>>;

Rights rights(const test::Loaded& loaded, std::string_view network) {
    const SumoProcess process(episode(), network);
    const RightOfWay right_of_way = right_of_way_in_sumo(loaded.town);
    Rights all;
    const auto& lanes = loaded.town.lanes;
    for (std::uint32_t i = 0; i < lanes.size(); ++i)
        for (std::uint32_t j = 0; j < lanes.size(); ++j)
            if (right_of_way.lets_go(i, j))
                all.emplace(lanes[i].name, lanes[j].name);
    return all;
}

TEST(CarNetwork, WithoutPathsAndPavementsSumoLetsTheSameCarsGoFirst) {
    for (const std::string name : {"town1", "town2", "junctions"}) {
        const test::Loaded& loaded = test::own_town(name);
        const Rights before = rights(loaded, loaded.network.xml);
        EXPECT_GT(before.size(), 20U) << name;
        EXPECT_EQ(rights(loaded, network_for_cars(loaded.network.xml, loaded.town)), before)
            << name;
    }
}

TEST(CarNetwork, WithoutAWayForBicyclesTheOtherWaysOfTheJunctionKeepTheirRights) {
    const test::Loaded loaded = with_bicycle_lane();
    ASSERT_EQ(loaded.town.lanes[test::lane(loaded.town, "r1_t3_2")].kind, world::LaneKind::other);
    const std::string reduced = network_for_cars(loaded.network.xml, loaded.town);
    const Rights after = rights(loaded, reduced);
    Rights before = rights(loaded, loaded.network.xml);
    const std::size_t of_all = before.size();
    std::erase_if(before, [&](const auto& pair) {
        return reduced.find("id=\"" + pair.first + "\"") == reduced.npos ||
               reduced.find("id=\"" + pair.second + "\"") == reduced.npos;
    });
    EXPECT_LT(before.size(), of_all);
    EXPECT_EQ(after, before);
}

TEST(CarNetwork, SumoHasTheLanesForCarsAndCountsThemAsTheGraphDoes) {
    for (const test::Loaded& loaded : {test::own_town("town2"), with_bicycle_lane()}) {
        const RoadGraph graph(loaded.town,
                              std::vector<world::ClassSet>(loaded.town.lanes.size(), ~0U));
        const SumoProcess process(episode(), network_for_cars(loaded.network.xml, loaded.town));
        for (std::uint32_t i = 0; i < graph.size(); ++i)
            EXPECT_EQ(libsumo::Edge::getLaneNumber(graph.edge(i).name),
                      static_cast<int>(graph.edge(i).lanes.size()));
        for (std::uint32_t i = 0; i < graph.size(); ++i)
            for (const std::uint32_t lane : graph.edge(i).lanes) {
                const std::string& name = loaded.town.lanes[lane].name;
                libsumo::Route::add("to_" + name, {graph.edge(i).name});
                libsumo::Vehicle::add(name, "to_" + name);
                libsumo::Vehicle::moveTo(name, name, 1);
                EXPECT_EQ(libsumo::Vehicle::getLaneIndex(name),
                          static_cast<int>(graph.index_of(lane)))
                    << name;
            }
    }
}

/// The rightmost lane of the straight is one for buses and taxis. On such a one a taxi drove over
/// somebody who had stood there for 97 s.
TEST(CarNetwork, BusesAndTaxisStayOutOfLanesThatAreNotForCars) {
    const test::Loaded loaded = test::load_changed("straight", [](std::string& line) {
        const std::string others = "disallow=\"pedestrian tram ";
        const auto at = line.find(others);
        if (line.find("id=\"east_0\"") != std::string::npos && at != std::string::npos)
            line.replace(at, line.find('"', at + others.size()) + 1 - at, "allow=\"bus taxi\"");
    });
    const std::uint32_t for_buses = test::lane(loaded.town, "east_0");
    ASSERT_EQ(loaded.town.lanes[for_buses].kind, world::LaneKind::other);
    test::Stage stage(loaded, 200);
    for (int i = 0; i < 1200; ++i) {
        stage.step();
        const auto cars = stage.view().cars();
        ASSERT_TRUE(
            std::none_of(cars.begin(),
                         cars.end(),
                         [&](const world::CarState& car) { return car.lane() == for_buses; }))
            << "tick " << stage.tick();
    }
}

}  // namespace
}  // namespace reprise::traffic
