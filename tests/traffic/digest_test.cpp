
#include <functional>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/worlds.h"
#include "tests/traffic/stage.h"
#include "traffic/cars/cars.h"
#include "traffic/cars/trail.h"
#include "traffic/roads/road_graph.h"
#include "world/models/catalogue.h"
#include "world/models/vehicle_classes.h"

// What decides the future is in the digest as soon as it is there, before it shows in the record.
namespace reprise::traffic {
namespace {

using test::command;
using test::lane;
using test::own_town;
using test::spawn;
using test::Stage;
using test::vehicle_on;
using world::CommandKind;

constexpr std::uint32_t some_actor = 3;

struct After {
    std::vector<std::uint8_t> cars;  ///< as recorded
    std::uint64_t digest;
};

After after(const Stage& stage) {
    const auto& cars = stage.draft().traffic.cars;
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(cars.data());
    return {{bytes, bytes + cars.size() * sizeof(world::CarState)}, stage.digest()};
}

/// A car on its way that is told this.
After after_order(const world::CommandT& order) {
    const auto& loaded = own_town("town1");
    Stage stage(loaded, 0);
    stage.step({spawn(some_actor, lane(loaded.town, "l1_b1_2"), 50, 10)});
    stage.steps(3);
    stage.step({order});
    return after(stage);
}

void expect_only_digests_differ(const After& one, const After& other) {
    EXPECT_EQ(one.cars, other.cars);
    EXPECT_NE(one.digest, other.digest);
}

TEST(TrafficDigest, KnowsHowLongALaneChangeWillTake) {
    const auto order = [](double duration) {
        world::CommandT change = command(CommandKind::change_lane, some_actor);
        change.lanes = {lane(own_town("town1").town, "l1_b1_1") + 40};  // of another road
        change.duration = duration;
        return after_order(change);
    };
    const After one = order(2);
    EXPECT_EQ(one.digest, order(2).digest);
    expect_only_digests_differ(one, order(2.01));
}

/// Two ways round the blocks, of as many roads and to the same end: nothing but the roads between
/// tells them apart.
TEST(TrafficDigest, KnowsWhichWayACarWillTake) {
    const auto& town = own_town("town1").town;
    const RoadGraph graph(
        town, std::vector<world::ClassSet>(town.lanes.size(), world::permitted("", "")));
    const auto way_to = [&](std::uint32_t from, std::uint32_t to) {
        return graph.shortest(graph.edge_of(from), graph.edge_of(to)).size();
    };
    const auto order = [](std::uint32_t first, std::uint32_t last) {
        world::CommandT route = command(CommandKind::set_route, some_actor);
        route.lanes = {first, last};
        return after_order(route);
    };
    const auto& links = town.lanes[lane(town, "l1_b1_2")].links;
    const std::uint32_t one = links.front().to();
    for (const world::Link& link : links)
        for (std::uint32_t end = 0; end < town.lanes.size(); ++end) {
            const std::uint32_t other = link.to();
            if (graph.edge_of(other) == graph.edge_of(one) ||
                !world::is_for_cars(town.lanes[end]) ||
                town.lanes[end].kind != world::LaneKind::driving || way_to(one, end) < 3 ||
                way_to(one, end) != way_to(other, end))
                continue;
            expect_only_digests_differ(order(one, end), order(other, end));
            return;
        }
    FAIL() << "town1 has no two such ways";
}

TEST(TrafficDigest, KnowsTheWayThatIsExpectedOfAPhysicsVehicle) {
    const auto with_lamps = [](std::uint16_t lamps) {
        const auto& loaded = own_town("town1");
        world::VehicleState ego =
            vehicle_on(loaded.town.lanes[lane(loaded.town, "l1_b1_2")], 1, 40, 8);
        ego.mutate_lamps(lamps);
        Stage stage(loaded, 0);
        for (int i = 0; i < 3; ++i)
            stage.step({}, {ego});
        return after(stage);
    };
    expect_only_digests_differ(with_lamps(world::lamp_left), with_lamps(0));
}

/// In the tick whose step moved it, not in the next one.
TEST(CarsDigest, KnowsHowEachCarMovedToTheLastBit) {
    const auto digest = [](const std::function<void(Car&)>& change) {
        world::TickDraft next;
        Cars cars;
        change(cars.add({}, "", 0, next));
        world::Hasher hasher;
        cars.add_motions_to(hasher);
        return hasher.digest64();
    };
    const std::uint64_t still = digest([](Car&) {});
    EXPECT_EQ(still, digest([](Car&) {}));
    constexpr double bit = 1e-300;
    const std::map<std::string, std::function<void(Car&)>> changes{
        {"bumper", [](Car& car) { car.sumo_front.z() = bit; }},
        {"axle", [](Car& car) { car.rear.x() = bit; }},
        {"yaw", [](Car& car) { car.yaw = bit; }},
        {"speed", [](Car& car) { car.speed = bit; }},
        {"place on its lane", [](Car& car) { car.lane_position = bit; }}};
    for (const auto& [what, change] : changes)
        EXPECT_NE(still, digest(change)) << what;
}

/// Two bumpers in one place whose cars came there by different ways: the rear axles will differ.
TEST(TrailDigest, KnowsTheWayBehindTheBumper) {
    const auto digest = [](double bend) {
        Trail trail;
        trail.start({0, 0, 0}, {-1, 0, 0}, 3);
        for (const Eigen::Vector3d& p : {Eigen::Vector3d(1, bend, 0), Eigen::Vector3d(2, 0, 0)})
            trail.advance(p);
        return trail.points_digest();
    };
    EXPECT_EQ(digest(0.5), digest(0.5));
    EXPECT_NE(digest(0.5), digest(-0.5));  // as long, and the rear is still on the straight part
}

}  // namespace
}  // namespace reprise::traffic
