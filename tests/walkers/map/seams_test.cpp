#include "tests/walkers/map/seams.h"

#include <gtest/gtest.h>

#include "tests/support/towns.h"
#include "walkers/walking_ground.h"

namespace reprise::test {
namespace {

void expect_none(const world::TownT& town, const walkers::WalkMap& map) {
    const Seams seams = seams_of(town, map);
    EXPECT_GT(seams.pairs, 100);
    EXPECT_EQ(seams.off, 0);
    for (const Seam& seam : seams.all)
        ADD_FAILURE() << town.name << ": " << seam.from << " to " << seam.to << ": " << seam.why
                      << " at " << seam.stuck_at.transpose();
}

TEST(Seams, ThereIsNoneInTown1) {
    const world::TownT& town = own_town("town1").town;
    walkers::WalkingGround ground(town);
    expect_none(town, ground.pavement());
    expect_none(town, ground.streets());
}

TEST(Seams, ThereIsNoneInTown2) {
    const world::TownT& town = own_town("town2").town;
    walkers::WalkingGround ground(town);
    expect_none(town, ground.pavement());
    expect_none(town, ground.streets());
}

}  // namespace
}  // namespace reprise::test
