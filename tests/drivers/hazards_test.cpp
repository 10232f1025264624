#include "drivers/hazards.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/drivers/kinematic_car.h"
#include "tests/support/worlds.h"
#include "world/models/prop_models.h"
#include "world/units.h"

namespace reprise::drivers {
namespace {

constexpr double northward = std::numbers::pi / 2;

/// A sedan at x = 0 that drives east on a path along y = 0.
class Road {
  public:
    explicit Road(double speed, const test::Turtle& way = test::Turtle(0, 0, 0).ahead(300))
        : town_(town_with_a_turn()),
          hazards(town_),
          ego_(ego_of(test::vehicle_at(1, 0, 0, 0, speed))) {
        std::vector<Eigen::Vector3d> line;
        for (const world::Vec3& point : way.line())
            line.push_back(world::to_eigen(point));
        path_.append(line, 30);
        path_.finish({});
    }

    double look(std::vector<world::CarState> cars,
                std::vector<world::WalkerState> walkers = {},
                std::vector<world::PropState> props = {},
                std::vector<world::VehicleState> vehicles = {},
                double swept_left = 0) {
        world::TickDraft draft;
        draft.tick.props = std::move(props);
        draft.tick.vehicles = std::move(vehicles);
        draft.traffic.cars = std::move(cars);
        draft.traffic.walkers = std::move(walkers);
        const world::SealedTick tick = world::seal(draft, {});
        const std::vector<SweptWidth> swept(path_.points().size(), {swept_left, 1});
        const auto none = std::span<const SweptWidth>();
        hazards.look(tick.view(), ego_, path_, style, swept_left > 0 ? swept : none);
        return hazards.acceleration();
    }

    double front() const { return ego_.front_s(); }

  private:
    /// Lane 0: in a junction, from (10, 30) southward into a left turn that ends eastward; lane 1:
    /// the same, of a street.
    static world::TownT town_with_a_turn() {
        world::TownT town;
        town.lanes = {
            test::make_lane(":turn",
                            test::Turtle(10, 30, -northward).ahead(12).turn(northward, 14),
                            8,
                            world::LaneKind::internal)};
        town.lanes.push_back(town.lanes[0]);
        town.lanes[1].kind = world::LaneKind::driving;
        return town;
    }

    world::TownT town_;
    Path path_;

  public:
    Hazards hazards;
    DrivingStyle style;

  private:
    Ego ego_;
};

world::WalkerState walker(double x, double y, double yaw, double speed) {
    return {world::Vec3(x, y, 0),
            static_cast<float>(yaw),
            static_cast<float>(speed),
            0,
            9,
            0,
            false,
            0,
            0};
}

}  // namespace

TEST(Hazards, AnEmptyRoadAllowsEverything) {
    EXPECT_EQ(Road(15).look({}), world::infinity);
}

TEST(Hazards, ALeaderIsFollowedByTheIntelligentDriverModel) {
    const world::VehicleModel& sedan = world::vehicle_models()[0];
    Road road(15);
    const double allowed = road.look({test::car_at(1'000'000, 60, 0, 0, 12)});
    ASSERT_EQ(road.hazards.overlaps().size(), 1U);
    const double rear = 60 - sedan.rear_overhang;
    EXPECT_NEAR(road.hazards.overlaps()[0].s, rear, 0.02);
    EXPECT_NEAR(road.hazards.overlaps()[0].speed, 12, 1e-6);
    EXPECT_NEAR(allowed, follow_acceleration(rear - road.front(), 15, 12, road.style), 0.01);
}

TEST(Hazards, WhoStandsOnTheNextLaneDoesNotConcernUs) {
    Road road(15);
    EXPECT_EQ(road.look({test::car_at(1'000'000, 60, 3.5, 0, 0)}), world::infinity);
    EXPECT_TRUE(road.hazards.overlaps().empty());
}

TEST(Hazards, TheNearestOfSeveralDecides) {
    Road road(15);
    const world::CarState near = test::car_at(1'000'000, 40, 0, 0, 0);
    const double alone = road.look({near});
    EXPECT_EQ(road.look({near, test::car_at(1'000'001, 50, 0, 0, 0)}), alone);
    EXPECT_EQ(road.hazards.overlaps().size(), 2U);
}

/// Thinner than the steps that the path is looked at in; turned in any way.
TEST(Hazards, APostOrAConeIsSeenWhereverItStands) {
    for (const char* name : {"cone", "sign_post", "warning_triangle", "box"}) {
        const std::uint16_t model = world::find_prop_model(name).value();
        for (int i = 0; i < 40; ++i) {
            const double x = 40 + 0.05 * i;
            const double half_turn = 0.1 * i;
            Road road(15);
            const world::PropState prop{world::Vec3(x, 0.3, 0),
                                        world::Quat(std::cos(half_turn), 0, 0, std::sin(half_turn)),
                                        {},
                                        {},
                                        9,
                                        model,
                                        0};
            const double allowed = road.look({}, {}, {prop});
            ASSERT_EQ(road.hazards.overlaps().size(), 1U) << name << " at " << x;
            EXPECT_NEAR(road.hazards.overlaps()[0].s, x, 0.5);
            EXPECT_LT(allowed, 0);
        }
    }
}

TEST(Hazards, WhoTurnsInBesideOurNoseIsLetIn) {
    // From the left, on our lane in a quarter of a second, where our nose is by then.
    const double turned = -45 * std::numbers::pi / 180;
    for (const double speed : {8.0, 10.0})
        EXPECT_LT(Road(6).look({test::car_at(1'000'000, 3, 4.5, turned, speed)}), -5) << speed;
    // Far ahead of us it is somebody to follow.
    EXPECT_GT(Road(6).look({test::car_at(1'000'000, 30, 4.5, turned, 8)}), 0);
}

TEST(Hazards, TheTailOfALongVehicleThatTurnsNeedsRoom) {
    // Beside our lane, its side 1.5 m from the middle of it; in a junction or not, long or not.
    const auto beside_us = [](const char* model, std::uint32_t lane, float lane_s = 20) {
        const world::VehicleModel& of = world::vehicle_models()[*world::find_vehicle_model(model)];
        world::CarState car = test::car_at(1'000'000, 18, 1.5 + of.width / 2, 0, 4);
        car.mutate_model(*world::find_vehicle_model(model));
        car.mutate_lane(lane);
        car.mutate_lane_s(lane_s);
        return Road(6).look({car});
    };
    EXPECT_LT(beside_us("bus", 0), 1);
    EXPECT_EQ(beside_us("bus", world::none), world::infinity);
    EXPECT_EQ(beside_us("sedan", 0), world::infinity);
    // In a street where that bends: its front still looks south while it lies eastward.
    EXPECT_LT(beside_us("bus", 1, 13), 1);
    EXPECT_EQ(beside_us("bus", 1, 60), world::infinity);
}

TEST(Hazards, WhoTurnsIsForeseenWhereHisWheelsLead) {
    // Ahead of us on the right, parallel: within 1.5 s it turns through a quarter of a circle of 6
    // m, onto our lane or away from it.
    const auto turning = [](double yaw_rate) {
        world::VehicleState other = test::vehicle_at(2, 20, -6, 0, 6);
        other.mutable_angular_velocity() = world::Vec3(0, 0, yaw_rate);
        return Road(10).look({}, {}, {}, {other});
    };
    EXPECT_LT(turning(1), 0);
    EXPECT_EQ(turning(0), world::infinity);
    EXPECT_EQ(turning(-1), world::infinity);
}

TEST(Hazards, WhoSwingsOutOverTheNextLaneLooksWhoComesFromBehind) {
    // On the lane to the left, behind our nose and faster; our body will reach half over that lane.
    const auto overtaken_by = [](double y, double x, double swept_left) {
        return Road(5).look({test::car_at(1'000'000, x, y, 0, 12)}, {}, {}, {}, swept_left);
    };
    EXPECT_LT(overtaken_by(3.5, -8, 3), 0);
    EXPECT_EQ(overtaken_by(3.5, -8, 1), world::infinity) << "we keep to our lane";
    EXPECT_EQ(overtaken_by(3.5, -8, 0), world::infinity);
    EXPECT_EQ(overtaken_by(3.5, -40, 3), world::infinity) << "we are through before it comes";
    EXPECT_EQ(overtaken_by(0, -12, 3), world::infinity) << "who follows us looks out himself";
}

TEST(Hazards, TheOuterCornerOfTheFrontNeedsRoomInABend) {
    // A quarter of a circle to the left, of 7 m; the corner reaches 1.7 m beyond it.
    const auto on_bend = [](double beside) {
        const double yaw = std::numbers::pi / 4;
        const Eigen::Vector2d place =
            Eigen::Vector2d(20, 7) + (7 + beside) * Eigen::Vector2d(std::sin(yaw), -std::cos(yaw));
        Road road(4, test::Turtle(0, 0, 0).ahead(20).turn(northward, 7).ahead(60));
        return road.look({}, {walker(place.x(), place.y(), 0, 0)});
    };
    EXPECT_LT(on_bend(1.7), world::infinity);
    EXPECT_LT(on_bend(-1.2), world::infinity);
    EXPECT_EQ(on_bend(2.5), world::infinity);
    EXPECT_EQ(on_bend(-1.7), world::infinity) << "on the inner side the car is as wide as ever";
}

TEST(Hazards, AWalkerWhoWillStepOntoThePathIsSeenBeforeHeIsThere) {
    // 2.2 m beside the path at 1.5 m/s he reaches our corridor within the 1.5 s that are foreseen;
    // at 10 m/s we are 20 m ahead of the bumper in 2 s.
    Road road(10);
    const double x = road.front() + 15;
    EXPECT_LT(road.look({}, {walker(x, -2.2, northward, 1.5)}), 0);
    EXPECT_TRUE(road.hazards.overlaps().empty());
    EXPECT_EQ(road.look({}, {walker(x, -2.2, -northward, 1.5)}), world::infinity) << "walks away";
    EXPECT_EQ(road.look({}, {walker(x, -2.2, northward, 0)}), world::infinity) << "stands";
}

}  // namespace reprise::drivers
