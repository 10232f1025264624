#include "traffic/sight/obstructions.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/towns.h"
#include "tests/support/worlds.h"
#include "world/frames.h"
#include "world/geometry2d.h"

namespace reprise::traffic {
namespace {

constexpr double tick_length = 0.05;
constexpr double walking = 1.4;  // [m/s]

/// One on foot beside every fourth lane for cars, up to 7 m from its middle, each another way.
std::vector<world::WalkerState> people_beside(const world::TownT& town) {
    std::vector<world::WalkerState> people;
    for (std::uint32_t i = 0; i < town.lanes.size(); i += 4) {
        const world::LaneT& lane = town.lanes[i];
        if (!world::is_for_cars(lane))
            continue;
        const world::LanePoint at = world::point_at(lane, lane.length / 2);
        const Eigen::Vector2d place =
            at.position.head<2>() + (1 + i % 7) * world::left_of(at.yaw) * (i % 8 < 4 ? 1 : -1);
        const auto yaw = static_cast<float>(at.yaw + 0.1 * (i % 60));
        const auto speed = static_cast<float>(i % 5 == 0 ? 0 : walking);
        people.emplace_back(world::Vec3(place.x(), place.y(), at.position.z()),
                            yaw,
                            speed,
                            0.0F,
                            1000 + i,
                            std::uint16_t{0},
                            false,
                            std::uint8_t{0},
                            0U);
    }
    return people;
}

/// Two routes: what is remembered of lanes around, and of who is off them, and a look without.
TEST(Obstructions, WhoWalksOnIsSeenAsIfHeWereSeenForTheFirstTime) {
    const world::TownT& town = test::own_town("town1").town;
    const world::LaneMap lanes(town);
    Obstructions kept(town, lanes, tick_length);
    std::vector<world::WalkerState> people = people_beside(town);
    std::size_t seen = 0;
    for (int tick = 0; tick < 200; ++tick) {
        world::TickDraft draft;
        draft.traffic.walkers = people;
        const world::SealedTick last = world::seal(draft, {});
        kept.look(last.view(), {});
        Obstructions fresh(town, lanes, tick_length);
        fresh.look(last.view(), {});
        ASSERT_EQ(kept.all().size(), fresh.all().size()) << "tick " << tick;
        for (std::size_t i = 0; i < fresh.all().size(); ++i) {
            const Obstruction& one = kept.all()[i];
            const Obstruction& other = fresh.all()[i];
            ASSERT_TRUE(one.id == other.id && one.lane == other.lane && one.begin == other.begin &&
                        one.right == other.right && one.left == other.left)
                << "tick " << tick << ": " << other.id << " on " << town.lanes[other.lane].name;
        }
        seen += fresh.all().size();
        for (world::WalkerState& walker : people) {
            const Eigen::Vector2d way = tick_length * static_cast<double>(walker.speed()) *
                                        world::ahead_of(static_cast<double>(walker.yaw()));
            const world::Vec3& from = walker.position();
            walker.mutable_position() =
                world::Vec3(from.x() + way.x(), from.y() + way.y(), from.z());
        }
    }
    EXPECT_GT(seen, 1000U) << "nothing is shown";
}

/// A car of SUMO's on a road with an oncoming lane, its bumper beside its own lane's middle.
Car car_beside(const world::TownT& town, double s, double offset, double turned) {
    Car car;
    car.id = 1'000'000;
    car.sumo = "1000000";
    car.lane = test::lane(town, "m1_b2_1");
    const world::LaneT& lane = town.lanes[car.lane];
    car.lane_position = s * lane.sumo_length / lane.length;
    const world::LanePoint at = world::point_at(lane, s);
    const Eigen::Vector2d place = at.position.head<2>() + offset * world::left_of(at.yaw);
    const Eigen::Vector3d front(place.x(), place.y(), at.position.z());
    car.turn_to(at.yaw + turned);
    const Eigen::Vector3d back(-car.ahead.x(), -car.ahead.y(), 0);
    constexpr double length = 3.7;  // [m]
    car.trail.start(front, back, length);
    car.rear = front + length * back;
    return car;
}

std::vector<Obstruction> seen_by_oncoming(const world::TownT& town, const Car& car) {
    const world::LaneMap lanes(town);
    Obstructions obstructions(town, lanes, tick_length);
    world::TickDraft draft;
    const world::SealedTick last = world::seal(draft, {});
    obstructions.look(last.view(), {&car, 1});
    const auto all = obstructions.on(town.lanes[car.lane].opposite);
    return {all.begin(), all.end()};
}

/// [m] before its bumper that who comes towards it finds its lane taken.
double taken_ahead(const world::TownT& town, const Car& car) {
    const auto seen = seen_by_oncoming(town, car);
    if (seen.empty())
        return 0;
    EXPECT_FALSE(seen.front().lasts) << "nobody passes that";
    const world::LaneT& oncoming = town.lanes[town.lanes[car.lane].opposite];
    return world::project(oncoming, car.trail.front()).s - seen.front().begin;
}

TEST(Obstructions, WhoComesTowardsOneOnAPassLeavesHimTheWayThatHeStillNeeds) {
    const world::TownT& town = test::own_town("town1").town;
    const world::LaneT& lane = town.lanes[test::lane(town, "m1_b2_1")];
    Car car = car_beside(town, 30, lane.width, 0);
    car.offset = lane.width;
    car.offset_order = OffsetOrder{{0, lane.width, 2.5, world::Shape::linear}, 0};
    car.pass = PassOrder{car.lane, 42, 5};
    EXPECT_NEAR(taken_ahead(town, car), 12 + 10, 2.5);
}

/// Who turned into the street just then came so near that the bus had no room to come back.
TEST(Obstructions, WhoComesTowardsOneSeesThatItWillPassBeforeItIsOverTheLine) {
    const world::TownT& town = test::own_town("town1").town;
    const world::LaneT& lane = town.lanes[test::lane(town, "m1_b2_1")];
    Car car = car_beside(town, 20, 0, 0);
    EXPECT_TRUE(seen_by_oncoming(town, car).empty());
    car.model = *world::find_vehicle_model("bus");
    car.offset_order = OffsetOrder{{0, lane.width, 2.5, world::Shape::linear}, 0};
    car.pass = PassOrder{car.lane, 42, 5};
    EXPECT_NEAR(taken_ahead(town, car), 22 + 10 + 6.9, 2.5) << "and for its tail";
}

TEST(Obstructions, ATailThatIsStillInTheOncomingLaneIsSeenThere) {
    const world::TownT& town = test::own_town("town1").town;
    Car car = car_beside(town, 30, 0, -0.5);
    EXPECT_TRUE(seen_by_oncoming(town, car).empty());
    car.offset_order = OffsetOrder{{3, 0, 2.5, world::Shape::linear}, 0};
    EXPECT_FALSE(seen_by_oncoming(town, car).empty());
}

/// Where a street ends in nothing a vehicle with mass turns around to and fro.
TEST(Obstructions, WhoStandsAtADeadEndIsLeftRoomToTurnAround) {
    world::TownT town = test::straight_road(120);
    std::uint32_t east = 0, west = 0;
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
        east = town.lanes[i].name == "east_1" ? i : east;
        west = town.lanes[i].name == "west_1" ? i : west;
    }
    const world::Vec3 before_end = world::to_vec3(world::point_at(town.lanes[east], 110).position);
    const auto gap_there = [&](world::Turn turn) {
        town.lanes[east].links = {world::Link(west, world::none, world::none, turn, false, 0)};
        const world::LaneMap lanes(town);
        Obstructions obstructions(town, lanes, tick_length);
        const world::SealedTick last =
            test::tick_with({test::vehicle_at(1, before_end.x(), before_end.y())});
        obstructions.look(last.view(), {});
        EXPECT_FALSE(obstructions.on(east).empty());
        return obstructions.on(east).empty() ? 0 : obstructions.on(east).front().gap;
    };
    EXPECT_LT(gap_there(world::Turn::straight), 2);
    EXPECT_GT(gap_there(world::Turn::around), 5);
}

}  // namespace
}  // namespace reprise::traffic
