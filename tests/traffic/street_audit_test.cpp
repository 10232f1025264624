#include "tests/traffic/street_audit.h"

#include <gtest/gtest.h>

#include "tests/support/worlds.h"

namespace reprise::test {
namespace {

constexpr double audit_step = 0.05;

TEST(StreetAudit, FindsWhoDrivesThroughWhom) {
    const world::TownT town = straight_road(400);
    world::Obstacle wall;
    wall.position = {200, -1.75, 1};
    wall.half = {1, 1, 1};
    wall.radius = 1.5;
    const std::vector<world::Obstacle> walls{wall};
    StreetAudit audit(town, walls, audit_step);
    // One drives through one who stands at 100 m, and later through a wall; the third passes both.
    for (std::uint64_t tick = 1; tick <= 500; ++tick)
        audit.see(tick_with({},
                            {car_at(7, 20 + 0.5 * static_cast<double>(tick), -1.75, 0, 10),
                             car_at(8, 100, -1.75),
                             car_at(9, 20 + 0.5 * static_cast<double>(tick), 3, 0, 10)},
                            {},
                            tick)
                      .view());
    audit.finish();
    ASSERT_EQ(audit.intrusions().size(), 2U) << audit.text();
    EXPECT_EQ(audit.intrusions()[0].what, "car in car");
    EXPECT_GT(audit.intrusions()[0].depth, 1.5) << "all of its width";
    EXPECT_EQ(audit.intrusions()[1].what, "car in a wall or pole");
    EXPECT_EQ(audit.intrusions()[1].who, 7U);
    EXPECT_TRUE(audit.collisions().empty());
}

/// Who stands in the way from afar could have been avoided; who steps out at the last moment not.
TEST(StreetAudit, KnowsWhatAnAttentiveDriverCouldHaveAvoided) {
    const world::TownT town = straight_road(400);
    const auto audited = [&](double comes_at, std::uint64_t appears_in = 1) {
        StreetAudit audit(town, {}, audit_step);
        for (std::uint64_t tick = 1; tick <= 100; ++tick) {
            const double x = 20 + 0.5 * static_cast<double>(tick);
            const double y = static_cast<double>(tick) < comes_at ? 8 : -1.75;
            world::TickDraft draft;
            draft.tick.index = tick;
            draft.tick.vehicles = {vehicle_at(1, x, -1.75, 0, 10)};
            world::Measurement measured;
            measured.mutate_actor(1);
            measured.mutate_speed(10);
            measured.mutate_lane(1);
            draft.tick.measurements = {measured};
            if (tick >= appears_in)
                draft.traffic.cars = {car_at(7, 74, y)};
            if (tick == 100) {
                for (const auto kind :
                     {world::EventKind::collision, world::EventKind::collision_ended}) {
                    world::EventT event;
                    event.kind = kind;
                    event.actor = 1;
                    event.other = 7;
                    event.value = 5000;
                    event.duration = kind == world::EventKind::collision ? 0 : 0.05;
                    draft.tick.events.push_back(event);
                }
            }
            audit.see(world::seal(draft, {}).view());
        }
        audit.finish();
        return audit.collisions();
    };
    ASSERT_EQ(audited(1).size(), 1U);
    EXPECT_TRUE(audited(1)[0].avoidable);
    EXPECT_EQ(audited(1)[0].fault, "the other stood in its way");
    EXPECT_EQ(audited(1)[0].lane, "east_1");
    EXPECT_FALSE(audited(90)[0].avoidable) << "half a second";
    EXPECT_FALSE(audited(1, 100)[0].avoidable) << "spawned there";
    EXPECT_EQ(audited(1, 100)[0].fault, "the other appeared where it drove");
}

}  // namespace
}  // namespace reprise::test
