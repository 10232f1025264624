#include <cmath>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/towns.h"
#include "tests/traffic/stage.h"

namespace reprise::towns {
namespace {

namespace fs = std::filesystem;

std::string short_name(const ::testing::TestParamInfo<const char*>& net) {
    const std::string name = net.param;
    return name.substr(0, name.find_first_of("/_."));
}

class Networks : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Own, Networks, ::testing::Values("quarter.net.xml"), short_name);

/// Networks that nobody here wrote.
INSTANTIATE_TEST_SUITE_P(Real,
                         Networks,
                         ::testing::Values("Town04_sumo115.net.xml",
                                           "DRT/osm.net.xml",
                                           "A10KW/osm.net.xml",
                                           "cross/cross.net.xml",
                                           "grid6/grid6.net.xml"),
                         short_name);

TEST_P(Networks, CarryACityOfCars) {
    fs::path path = test::own_map(GetParam());
    if (!fs::exists(path))
        path = test::real_map(GetParam());
    if (!fs::exists(path))
        GTEST_SKIP() << test::missing_map(path);
    const test::Loaded loaded = test::load(path);
    test::Stage stage(loaded, 100);
    double driven = 0;
    for (int i = 0; i < 400; ++i) {
        const auto& cars = stage.step().traffic.cars;
        EXPECT_GE(cars.size(), 97U) << "tick " << i + 1;
        for (const world::CarState& car : cars) {
            const double sum = car.position().x() + car.position().y() + car.position().z();
            ASSERT_TRUE(std::isfinite(sum) && std::isfinite(car.yaw()) &&
                        std::isfinite(car.pitch()));
            ASSERT_LT(car.lane(), loaded.town.lanes.size());
            EXPECT_LT(std::abs(car.pitch()), 0.3F);
            driven += static_cast<double>(car.speed()) * 0.05;
        }
    }
    EXPECT_GT(driven, 100 * 20 * 2.0) << "traffic flows";
}

}  // namespace
}  // namespace reprise::towns
