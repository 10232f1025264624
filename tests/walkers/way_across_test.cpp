#include "walkers/way_across.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/towns.h"
#include "walkers/walking_ground.h"

namespace reprise::walkers {
namespace {

using ground::Surface;

/// Main street in Town 1, between y = 92.5 and 99.5: crossings at x = 216 and 290.
struct Street {
    const world::TownT& town = test::own_town("town1").town;
    world::LaneMap lanes{town};
    WalkingGround ground{town};

    std::vector<WalkMap::Step> way(const Eigen::Vector2d& from,
                                   const Eigen::Vector2d& to,
                                   double road_cost) {
        const auto place = [&](const Eigen::Vector2d& p) {
            return *ground.streets().nearest({p.x(), p.y(), 0.1});
        };
        return way_across({ground.pavement(), ground.streets(), town, lanes},
                          place(from),
                          place(to),
                          road_cost)
            .value();
    }
};

double on_road(const std::vector<WalkMap::Step>& way, Eigen::Vector2d& along) {
    double metres = 0;
    for (std::size_t i = 0; i + 1 < way.size(); ++i)
        if (way[i].surface == Surface::road) {
            along = (way[i + 1].position - way[i].position).head<2>();
            metres += along.norm();
        }
    return metres;
}

TEST(WayAcross, GoesStraightOverWhereItSavesAFewMetres) {
    Street street;
    Eigen::Vector2d over(0, 0);
    const auto way = street.way({240, 91}, {270, 101}, 1.3);
    const double metres = on_road(way, over);
    EXPECT_GT(metres, 6);
    EXPECT_LT(metres, 10) << "straight over 7 m, and not drawn out along it";
    EXPECT_LT(std::abs(over.x()), 0.3 * std::abs(over.y()));
}

TEST(WayAcross, StaysOnThePavementWhereTheRoadCostsMuch) {
    Street street;
    Eigen::Vector2d over(0, 0);
    EXPECT_EQ(on_road(street.way({222, 91}, {222, 101}, 10), over), 0) << "a crossing is 6 m away";
    EXPECT_EQ(on_road(street.way({222, 91}, {260, 91}, 1.3), over), 0) << "the same side";
}

}  // namespace
}  // namespace reprise::walkers
