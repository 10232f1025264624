#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/towns.h"
#include "tests/traffic/stage.h"

namespace reprise::traffic {
namespace {

/// The rightmost lane of the straight is one for buses and taxis. On such a one a taxi drove over
/// somebody who had stood there for 97 s.
TEST(ClosedLanes, BusesAndTaxisStayOutOfLanesThatAreNotForCars) {
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
