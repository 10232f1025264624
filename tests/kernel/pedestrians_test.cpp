#include "kernel/pedestrians.h"

#include <cmath>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ground/mesh/build_ground.h"
#include "ground/mesh/ground.h"
#include "tests/support/worlds.h"
#include "world/models/catalogue.h"

namespace reprise::kernel {

namespace {

constexpr double tick_seconds = 0.05;
constexpr double grid = 1.0 / 1024;  // [m] recorded lengths

world::CommandT command(world::CommandKind kind, std::uint32_t actor) {
    world::CommandT result;
    result.kind = kind;
    result.actor = actor;
    result.driver = world::Driver::walker;
    result.lane = world::none;
    return result;
}

world::CommandT spawn_at(std::uint32_t actor, double x, double y) {
    world::CommandT result = command(world::CommandKind::spawn, actor);
    result.target = world::Vec3(x, y, 0);
    result.text = "walker" + std::to_string(actor);
    return result;
}

world::CommandT walk_to(std::uint32_t actor, double x, double y, double speed = 0) {
    world::CommandT result = command(world::CommandKind::walk, actor);
    result.target = world::Vec3(x, y, 0);
    result.speed = speed;
    return result;
}

/// The stage alone, on a straight road with a sidewalk on either side.
class Street {
  public:
    Street()
        : town_(test::straight_road()),
          lanes_(town_),
          ground_(ground::build_ground(town_)),
          pedestrians(test::episode(), town_, lanes_, ground_) {}

    const std::vector<world::WalkerState>& step(const std::vector<world::CommandT>& commands = {}) {
        last_.emplace(world::seal(next, {}));
        walkers::OnFoot on_foot = pedestrians.advance(last_->view(), commands);
        next = {};
        next.tick.index = on_foot.tick;
        next.tick.events = std::move(on_foot.events);
        next.traffic.walkers = std::move(on_foot.walkers);
        return next.traffic.walkers;
    }

    std::vector<world::WalkerState> steps(int count) {
        for (int i = 0; i < count; ++i)
            step();
        return next.traffic.walkers;
    }

  private:
    world::TownT town_;
    world::LaneMap lanes_;
    ground::GroundMesh ground_;
    std::optional<world::SealedTick> last_;

  public:
    Pedestrians pedestrians;
    world::TickDraft next;
};

TEST(Pedestrians, WalkStraightToTheTargetAndStopThere) {
    Street street;
    street.step({spawn_at(3, 10, 0)});
    street.step({walk_to(3, 13, 4, 2)});
    double farthest_off = 0;
    for (int tick = 0; tick < 100; ++tick) {
        const world::Vec3 p = street.step()[0].position();
        farthest_off = std::max(farthest_off, std::abs((p.x() - 10) * 4 - (p.y()) * 3) / 5);
    }
    const world::WalkerState walker = street.next.traffic.walkers[0];
    EXPECT_LT(farthest_off, 2 * grid);
    EXPECT_NEAR(walker.position().x(), 13, grid);
    EXPECT_NEAR(walker.position().y(), 4, grid);
    EXPECT_NEAR(static_cast<double>(walker.yaw()), std::atan2(4, 3), 1e-3);
    EXPECT_EQ(walker.speed(), 0.0F);
}

TEST(Pedestrians, ReachTheirSpeedWithTwoMetresPerSecondSquared) {
    Street street;
    street.step({spawn_at(3, 10, 0)});
    street.step({walk_to(3, 100, 0, 2)});
    EXPECT_NEAR(static_cast<double>(street.steps(9)[0].speed()), 1, 2 * grid);
    EXPECT_NEAR(static_cast<double>(street.steps(30)[0].speed()), 2, grid);
    const double before = street.next.traffic.walkers[0].position().x();
    EXPECT_NEAR(street.steps(20)[0].position().x() - before, 2, 2 * grid);
}

TEST(Pedestrians, WalkAtTheirModelsSpeedWhenNoneIsGiven) {
    Street street;
    world::CommandT child = spawn_at(3, 10, 0);
    child.model = world::find_walker_model("child").value();
    street.step({child});
    street.step({walk_to(3, 100, 0)});
    const double expected = world::walker_models()[child.model].walking_speed;
    EXPECT_NEAR(static_cast<double>(street.steps(40)[0].speed()), expected, grid);
}

TEST(Pedestrians, StandOnTheSidewalkAndOnTheRoadBesideIt) {
    Street street;
    world::CommandT on_sidewalk = command(world::CommandKind::spawn, 1);
    on_sidewalk.lane = 0;  // east_0
    on_sidewalk.s = 50;
    on_sidewalk.offset = 0.5;
    street.step({on_sidewalk, spawn_at(2, 50, -1.75)});
    const auto& walkers = street.next.traffic.walkers;
    EXPECT_NEAR(walkers[0].position().x(), 50, grid);
    EXPECT_NEAR(walkers[0].position().y(), -3.5 - 1.25 + 0.5, grid);
    EXPECT_NEAR(walkers[0].position().z(), ground::kerb_height, grid);
    EXPECT_NEAR(walkers[1].position().z(), 0, grid);
    // And step down from one to the other.
    street.step({walk_to(1, 50, 0)});
    EXPECT_NEAR(street.steps(100)[0].position().z(), 0, grid);
}

TEST(Pedestrians, WalkCycleFollowsTheDistance) {
    Street street;
    street.step({spawn_at(3, 10, 0)});
    street.step({walk_to(3, 100, 0, 1.5)});
    street.steps(40);
    const double cycle = walk_cycle_length(1.5, world::walker_models()[0].height);
    EXPECT_GT(cycle, 1.3);  // two steps of a grown-up
    EXPECT_LT(cycle, 1.8);
    const world::WalkerState before = street.next.traffic.walkers[0];
    const world::WalkerState after = street.steps(10)[0];
    const double walked = after.position().x() - before.position().x();
    const double turned =
        std::fmod(static_cast<double>(after.phase()) - static_cast<double>(before.phase()) + 1, 1);
    EXPECT_NEAR(turned, walked / cycle, 1e-3);
}

TEST(Pedestrians, LieDownAfterAHitAndStayThere) {
    Street street;
    street.step({spawn_at(3, 10, 0), spawn_at(4, 20, 0)});
    street.step({walk_to(3, 100, 0), walk_to(4, 100, 0)});
    street.steps(10);
    world::EventT hit;
    hit.kind = world::EventKind::collision;
    hit.actor = 1;
    hit.other = 3;
    street.next.tick.events.push_back(hit);
    const double where = street.next.traffic.walkers[0].position().x();
    const auto walkers = street.steps(20);
    EXPECT_TRUE(walkers[0].down());
    EXPECT_EQ(walkers[0].position().x(), where);
    EXPECT_EQ(walkers[0].speed(), 0.0F);
    EXPECT_FALSE(walkers[1].down());
    EXPECT_GT(walkers[1].position().x(), 20.5);
    street.step({walk_to(3, 0, 0)});
    EXPECT_EQ(street.steps(20)[0].position().x(), where);
}

TEST(Pedestrians, ComeAndGoWithEventsSortedById) {
    Street street;
    street.step({spawn_at(7, 10, 0), spawn_at(2, 20, 0)});
    ASSERT_EQ(street.next.traffic.walkers.size(), 2u);
    EXPECT_EQ(street.next.traffic.walkers[0].id(), 2u);
    EXPECT_EQ(street.next.traffic.walkers[1].id(), 7u);
    ASSERT_EQ(street.next.tick.events.size(), 2u);
    EXPECT_EQ(street.next.tick.events[0].kind, world::EventKind::spawned);
    EXPECT_EQ(street.next.tick.events[0].text, "walker7");
    street.step({command(world::CommandKind::despawn, 7)});
    ASSERT_EQ(street.next.traffic.walkers.size(), 1u);
    ASSERT_EQ(street.next.tick.events.size(), 1u);
    EXPECT_EQ(street.next.tick.events[0].kind, world::EventKind::despawned);
    EXPECT_EQ(street.next.tick.events[0].actor, 7u);
}

TEST(Pedestrians, LeaveOtherActorsToOtherStages) {
    Street street;
    world::CommandT car = spawn_at(5, 10, 0);
    car.driver = world::Driver::traffic;
    street.step({car, walk_to(5, 0, 0), command(world::CommandKind::despawn, 6)});
    EXPECT_TRUE(street.next.traffic.walkers.empty());
    EXPECT_TRUE(street.next.tick.events.empty());
}

TEST(Pedestrians, DigestSeesWhatRoundingHides) {
    Street one;
    Street other;
    one.step({spawn_at(3, 10, 0)});
    other.step({spawn_at(3, 10 + 1e-9, 0)});
    EXPECT_EQ(one.next.traffic, other.next.traffic);
    EXPECT_NE(one.pedestrians.digest(), other.pedestrians.digest());
}

}  // namespace

}  // namespace reprise::kernel
