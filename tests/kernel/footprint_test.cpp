// The clipped shares, against a fine raster of points that are asked one by one.
#include "kernel/footprint.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/towns.h"
#include "world/random.h"

namespace reprise::test {
namespace {

using kernel::FootprintShares;

FootprintShares raster(const world::TownT& town,
                       const world::LaneMap& lanes,
                       const world::VehicleModel& model,
                       const Eigen::Isometry3d& pose) {
    constexpr int along = 150;
    constexpr int across = 60;
    const Eigen::Vector3d ahead = pose.linear().col(0);
    int opposite = 0;
    int sidewalk = 0;
    for (int i = 0; i < along; ++i)
        for (int j = 0; j < across; ++j) {
            const Eigen::Vector3d p =
                pose * Eigen::Vector3d(model.length * (i + 0.5) / along - model.rear_overhang,
                                       model.width * ((j + 0.5) / across - 0.5),
                                       0);
            bool with = false;
            const auto found = lanes.at(p);
            for (const auto& [lane, at] : found) {
                const double yaw = world::point_at(town.lanes[lane], at.s).yaw;
                with = with || ahead.x() * std::cos(yaw) + ahead.y() * std::sin(yaw) > 0;
            }
            opposite += !found.empty() && !with ? 1 : 0;
            sidewalk += found.empty() && !lanes.walkable_at(p).empty() ? 1 : 0;
        }
    return {1.0 * opposite / (along * across), 1.0 * sidewalk / (along * across)};
}

/// Beside and across the streets of a town, at any angle.
TEST(FootprintShares, AreThoseOfAFineRaster) {
    const world::TownT& town = own_town("town2").town;
    const world::LaneMap lanes(town);
    const world::VehicleModel& model = world::vehicle_models()[0];
    int opposite = 0;
    int sidewalk = 0;
    for (std::uint64_t i = 0; i < 40; ++i) {
        const auto drawn = [&](std::uint64_t item) {
            return world::draw(i, item, world::Purpose::walker_place, 0);
        };
        std::size_t index =
            static_cast<std::size_t>(drawn(1) * static_cast<double>(town.lanes.size()));
        while (town.lanes[index].kind != world::LaneKind::driving)
            index = (index + 1) % town.lanes.size();
        const world::LaneT& lane = town.lanes[index];
        const auto point = world::point_at(lane, drawn(2) * lane.length);
        Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
        const double turn = i % 2 == 0 ? (drawn(3) - 0.5) * 6.28 : (drawn(3) - 0.5);
        pose.linear() =
            Eigen::AngleAxisd(point.yaw + turn, Eigen::Vector3d::UnitZ()).toRotationMatrix();
        const Eigen::Vector3d left(-std::sin(point.yaw), std::cos(point.yaw), 0);
        pose.translation() = point.position + (drawn(4) * 9 - 5) * left;
        const FootprintShares clipped = kernel::footprint_shares(town, lanes, model, pose);
        const FootprintShares fine = raster(town, lanes, model, pose);
        EXPECT_NEAR(clipped.opposite_lane, fine.opposite_lane, 0.02) << i << ' ' << lane.name;
        EXPECT_NEAR(clipped.sidewalk, fine.sidewalk, 0.02) << i << ' ' << lane.name;
        opposite += clipped.opposite_lane > 0.02 && clipped.opposite_lane < 0.98 ? 1 : 0;
        sidewalk += clipped.sidewalk > 0.02 && clipped.sidewalk < 0.98 ? 1 : 0;
    }
    EXPECT_GT(opposite, 5) << "some were partly over an opposite lane";
    EXPECT_GT(sidewalk, 5) << "and some over a sidewalk";
}

}  // namespace
}  // namespace reprise::test
