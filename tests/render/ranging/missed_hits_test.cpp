// Hits that tracing in packets, or leaving out who is far, could miss.
#include <cstdint>
#include <numbers>
#include <set>

#include <gmock/gmock.h>

#include "render/sensors.h"
#include "tests/render/ranging/points.h"

namespace reprise {

using test::clear;
using test::point_at;
using test::ranger;
using test::whole_at;
using world::SensorFrame;
using world::SensorKind;

/// Embree's coherent packets lost all of their eight rays when one of them ran along an axis of the
/// world but for less than 1e-18 to the negative side, as in a car on a straight street of a town's
/// grid: a sector of 16 degrees, or the middle of a picture.
TEST(Sensors, RaysAlongTheWorldsAxesTakeNobodyElseWithThem) {
    const world::TownT town = test::street();
    const world::SealedTick tick = test::street_tick();
    render::Sensors fast(town);
    render::Sensors portable(town, {.portable = true});
    world::SensorSpec lidar = ranger(SensorKind::semantic_lidar,
                                     {{"rolling", 0},
                                      {"channels", 33},
                                      {"upper_fov", 16},
                                      {"lower_fov", -16},
                                      {"points_per_second", 33 * 177 * 20}});
    world::SensorSpec classes = test::camera(SensorKind::semantic, {44.37, -12.25, 1.81});
    classes.width = 161;
    classes.height = 121;
    lidar.position = classes.position;
    for (const double axis : {0.0, 90.0, 180.0, -90.0})
        for (const double off :
             {0.0, 1e-19, -1e-19, 1e-12, -1e-12, 1e-7, -1e-7, 1e-5, -1e-5, 1e-3}) {
            lidar.yaw = classes.yaw = axis * std::numbers::pi / 180 + off;
            const auto found = fast.observe(tick.view(), {lidar, classes}, clear());
            const auto expected = portable.observe(tick.view(), {lidar, classes}, clear());
            EXPECT_NEAR(found[0].height, expected[0].height, 3) << axis << " degrees " << off;
            std::size_t others = 0;
            for (std::size_t i = 0; i < expected[1].data.size(); ++i)
                others += static_cast<std::size_t>(found[1].data[i] != expected[1].data[i]);
            EXPECT_LE(others, expected[1].data.size() / 1000) << axis << " degrees " << off;
        }
}

/// Who is farther than a shot goes is not even told to the tracer.
TEST(Lidar, OfAShortRangeFindsWhatALongOneFindsThere) {
    const world::TownT town = test::street();
    const world::SealedTick tick = test::street_tick();
    render::Sensors sensors(town);
    world::SensorSpec spec = ranger(SensorKind::semantic_lidar);
    spec.actor = 1;
    const SensorFrame far = sensors.observe(tick.view(), {spec}, clear())[0];
    std::set<std::uint32_t> met;
    for (const double range : {4.0, 9.0, 16.0, 22.0, 55.0, 90.0}) {
        spec.attributes.front() = {"range", range};
        const SensorFrame near = sensors.observe(tick.view(), {spec}, clear())[0];
        int within = 0;
        for (int i = 0; i < far.height; ++i)
            within += static_cast<int>(point_at(far, i).norm() < range);
        EXPECT_NEAR(near.height, within, 2) << range;
        for (int i = 0; i < near.height; ++i)
            met.insert(whole_at(near, i, 4));
    }
    EXPECT_THAT(met, testing::IsSupersetOf({10U, 11U, 13U, 20U}));
}

}  // namespace reprise
