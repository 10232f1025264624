#include "traffic/lookout.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/worlds.h"
#include "tests/traffic/stage.h"
#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"
#include "world/models/doors.h"
#include "world/models/prop_models.h"

namespace reprise::traffic {
namespace {

using test::lane;
using test::own_town;
using test::spawn;
using test::Stage;
using world::Driver;

constexpr std::uint32_t obstacle = 9;
constexpr int two_minutes = 2400;

/// An oriented box seen from above.
struct Box {
    Eigen::Vector2d centre;
    Eigen::Vector2d direction;
    Eigen::Vector2d half;
};

Box box_of_car(const world::CarState& car) {
    const world::VehicleModel& model = world::vehicle_models()[car.model()];
    const Eigen::Vector2d ahead = world::ahead_of(static_cast<double>(car.yaw()));
    const Eigen::Vector2d rear(car.position().x(), car.position().y());
    return {rear + (model.length / 2 - model.rear_overhang) * ahead,
            ahead,
            {model.length / 2, model.width / 2}};
}

/// By the separating axes of both.
bool overlap(const Box& one, const Box& other) {
    for (const Box* box : {&one, &other})
        for (const Eigen::Vector2d& axis : {box->direction, world::turned_left(box->direction)}) {
            const auto extent = [&](const Box& of) {
                return of.half.x() * std::abs(of.direction.dot(axis)) +
                       of.half.y() * std::abs(world::turned_left(of.direction).dot(axis));
            };
            if (std::abs((other.centre - one.centre).dot(axis)) >= extent(one) + extent(other))
                return false;
        }
    return true;
}

world::WalkerState walker_on(const world::LaneT& lane, double s, double offset, bool down = false) {
    const world::LanePoint at = world::point_at(lane, s);
    const Eigen::Vector2d p = at.position.head<2>() + offset * world::left_of(at.yaw);
    return {world::Vec3(p.x(), p.y(), at.position.z()),
            static_cast<float>(at.yaw),
            0,
            0,
            obstacle,
            0,
            down,
            std::uint8_t{0},
            0};
}

/// What stands in the way, and what is seen around it.
class Scene {
  public:
    Scene(const char* town, const char* lane_name, std::uint32_t cars = 100, std::uint64_t seed = 7)
        : Scene(own_town(town), lane_name, cars, seed) {}

    Scene(const test::Loaded& loaded,
          const char* lane_name,
          std::uint32_t cars = 100,
          std::uint64_t seed = 7)
        : town_(loaded.town),
          road_(lane(town_, lane_name)),
          stage(loaded, cars, seed) {
        stage.steps(200);
    }

    const world::LaneT& road() const { return town_.lanes[road_]; }

    /// The next place along the lane that nobody is near to.
    double free_place(double s, double before) const {
        while (s < road().length) {
            const auto& all = stage.draft().traffic.cars;
            if (std::none_of(all.begin(), all.end(), [&](const world::CarState& car) {
                    const auto front = static_cast<double>(car.lane_s());
                    return is_on_road(car) && front > s - before && front < s + 15;
                }))
                return s;
            s += 5;
        }
        ADD_FAILURE() << "no free place";
        return s;
    }

    void put_walker(double s, double offset, bool down = false) {
        stage.walkers.push_back(walker_on(road(), s, offset, down));
        stage.walkers.back().mutate_id(obstacle + static_cast<std::uint32_t>(boxes_.size()));
        const world::WalkerModel& model = world::walker_models()[0];
        boxes_.push_back(box_on(s, offset, down ? model.height : 0.4, 0.4));
        end_ = s;
    }

    void put_cone(double s) {
        const std::uint16_t cone = world::find_prop_model("cone").value();
        const world::LanePoint at = world::point_at(road(), s);
        stage.props = {
            {world::to_vec3(at.position), world::Quat(0, 0, 0, 1), {}, {}, obstacle, cone, 0}};
        const world::PropModel& model = world::prop_models()[cone];
        boxes_.push_back(box_on(s, 0, model.length, model.width));
        end_ = s;
    }

    /// A scenario's car that stands there for good.
    void park(const char* model, double s, double offset) {
        world::CommandT command = spawn(obstacle, road_, s, 0, Driver::parked, offset);
        command.model = world::find_vehicle_model(model).value();
        stage.step({command});
        boxes_.push_back(box_of_car(*stage.car(obstacle)));
        end_ = s + 6;
    }

    void open_door(std::uint8_t door) {
        const world::CarState& car = *stage.car(obstacle);
        stage.doors = {{world::widest_door, obstacle, door, 0, 0}};
        const world::DoorLeaf leaf =
            world::door_leaf(world::vehicle_models()[car.model()],
                             world::pose(car.position(), static_cast<double>(car.yaw()), 0),
                             door,
                             world::widest_door);
        boxes_.push_back({leaf.pose.translation().head<2>(),
                          leaf.pose.linear().col(0).head<2>().normalized(),
                          leaf.half.head<2>()});
    }

    /// A car with mass that has come to rest askew.
    void put_wreck(double s, double offset, double turn) {
        const world::LanePoint at = world::point_at(road(), s);
        const Eigen::Vector2d p = at.position.head<2>() + offset * world::left_of(at.yaw);
        vehicles_ = {test::vehicle_at(obstacle, p.x(), p.y(), at.yaw + turn)};
        const world::VehicleModel& model = world::vehicle_models()[0];
        const Eigen::Vector2d ahead = world::ahead_of(at.yaw + turn);
        boxes_.push_back({p + (model.length / 2 - model.rear_overhang) * ahead,
                          ahead,
                          {model.length / 2, model.width / 2}});
        end_ = s + 5;
    }

    void watch(int ticks) {
        for (int i = 0; i < ticks; ++i) {
            stage.step({}, vehicles_);
            for (const world::CarState& car : stage.draft().traffic.cars)
                look(car);
        }
    }

    std::set<std::uint32_t> touched;
    std::set<std::uint32_t> passed;  ///< went by, on whatever lane of its road

  private:
    bool is_on_road(const world::CarState& car) const {
        return car.lane() != world::none && town_.lanes[car.lane()].edge == road().edge;
    }

    Box box_on(double s, double offset, double length, double width) const {
        const world::LanePoint at = world::point_at(road(), s);
        return {at.position.head<2>() + offset * world::left_of(at.yaw),
                world::ahead_of(at.yaw),
                {length / 2, width / 2}};
    }

    void look(const world::CarState& car) {
        if (car.id() == obstacle)
            return;
        for (const Box& box : boxes_)
            if (overlap(box_of_car(car), box))
                touched.insert(car.id());
        if (!is_on_road(car))
            return;
        const auto front = static_cast<double>(car.lane_s());
        if (front < boxes_s() - 1)
            before_.insert(car.id());
        if (front > end_ + 8 && before_.contains(car.id()))
            passed.insert(car.id());
    }

    double boxes_s() const { return end_ - 7; }

    const world::TownT& town_;
    std::uint32_t road_;
    std::vector<Box> boxes_;
    std::vector<world::VehicleState> vehicles_;
    std::set<std::uint32_t> before_;
    double end_ = 0;

  public:
    Stage stage;
};

struct Obstacle {
    const char* name;
    void (*put)(Scene& scene, double s);
};

struct Place {
    const char* town;
    const char* lane;
    double s;
    double before;  ///< [m] free behind the place
    std::size_t pass;
};

constexpr Place three_lanes{"straight", "east_1", 1000, 250, 10};
constexpr Place one_lane{"town1", "m1_b2_1", 30, 25, 2};
/// Who comes first has no way left to change lanes as he drives: he pulls out from a standstill.
constexpr Place close_before_a_queue{"town1", "t1_l1_1", 120, 25, 8};

class LookoutIn : public testing::TestWithParam<std::tuple<Place, Obstacle>> {};

TEST_P(LookoutIn, NobodyTouchesWhatStandsInTheLaneForTwoMinutes) {
    const auto& [place, what] = GetParam();
    Scene scene(place.town, place.lane);
    what.put(scene, scene.free_place(place.s, place.before));
    scene.watch(two_minutes);
    EXPECT_TRUE(scene.touched.empty()) << scene.touched.size() << " cars";
    EXPECT_GE(scene.passed.size(), place.pass);
}

/// With this seed a bus comes to stand behind the van, whose corner its side would cut if it swung
/// out as cars do.
TEST(Lookout, ABusDoesNotSwingOutPastWhatStandsCloseBeforeIt) {
    Scene scene(one_lane.town, one_lane.lane, 100, 9);
    scene.park("van", scene.free_place(one_lane.s, one_lane.before), 0);
    scene.watch(two_minutes);
    EXPECT_TRUE(scene.touched.empty());
}

/// Behind a lorry that had to brake hard and then had no room to pull out, a queue stood on a lane
/// beside a free one until the lorry was taken out.
TEST(Lookout, WhoStandsBehindOneWhoIsBoxedInPullsOut) {
    const test::Loaded& town1 = own_town("town1");
    const std::uint32_t road = lane(town1.town, "b1_l1_1");
    Stage stage(town1, 100, 4);
    const auto first_on_road = [&] {
        for (const world::CarState& car : stage.draft().traffic.cars)
            if (car.lane() == road && car.speed() > 5 && car.lane_s() > 40 && car.lane_s() < 100)
                return car.id();
        return 0U;
    };
    while (stage.tick() < 1000 && first_on_road() == 0)
        stage.step();
    const std::uint32_t boxed_in = first_on_road();
    ASSERT_NE(boxed_in, 0U);
    const world::CarState& car = *stage.car(boxed_in);
    const auto speed = static_cast<double>(car.speed());
    const world::LanePoint at = world::point_at(
        town1.town.lanes[road], static_cast<double>(car.lane_s()) + speed * speed / 16 + 2);
    stage.props = {{world::to_vec3(at.position),
                    world::Quat(0, 0, 0, 1),
                    {},
                    {},
                    obstacle,
                    world::find_prop_model("cone").value(),
                    0}};
    std::map<std::uint32_t, int> stood;  // [ticks] behind it on its lane
    std::set<std::uint32_t> passed;
    for (int i = 0; i < 1800; ++i) {
        stage.step();
        ASSERT_NE(stage.car(boxed_in), nullptr);
        for (const world::CarState& other : stage.draft().traffic.cars) {
            if (other.id() == boxed_in)
                continue;
            if (other.lane() == road && other.speed() < 0.1F &&
                other.lane_s() < stage.car(boxed_in)->lane_s())
                ++stood[other.id()];
            else if (other.lane() != world::none &&
                     town1.town.lanes[other.lane()].edge == "b1_l1" &&
                     other.lane_s() > stage.car(boxed_in)->lane_s() + 12 && stood[other.id()] > 60)
                passed.insert(other.id());
        }
    }
    EXPECT_LT(stage.car(boxed_in)->speed(), 0.1F) << "nothing is shown";
    EXPECT_GE(passed.size(), 2U);
}

/// Its corner is a hand beyond the line between; there is room beside it all the same.
TEST(Lookout, AWreckWhoseCornerIsOverTheLineIsPassed) {
    Scene scene(one_lane.town, one_lane.lane);
    scene.put_wreck(scene.free_place(one_lane.s, one_lane.before), 0, 0.2);
    scene.watch(two_minutes);
    EXPECT_TRUE(scene.touched.empty());
    EXPECT_GE(scene.passed.size(), one_lane.pass);
}

/// As netconvert makes towns of other maps: SUMO knows no opposite lanes there, and does not sort a
/// lane's vehicles again.
TEST(Lookout, WhoHasPassedAParkedVanDrivesOnWhereSumoKnowsNoOppositeLanes) {
    const test::Loaded town = test::load_changed(one_lane.town, [](std::string& line) {
        if (line.find("<neigh ") != std::string::npos)
            line.clear();
    });
    Scene scene(town, one_lane.lane);
    scene.park("van", scene.free_place(one_lane.s, one_lane.before), 0);
    scene.watch(two_minutes);
    EXPECT_TRUE(scene.touched.empty());
    EXPECT_GE(scene.passed.size(), one_lane.pass);
}

/// The first is stopped in the middle of a change of lanes, which SUMO goes on with wherever the
/// car is put.
TEST(Lookout, WhoIsStoppedInTheMiddleOfAChangeOfLanesEndsIt) {
    Scene scene("town1", "l1_b1_1", 100, 4);
    scene.put_walker(scene.free_place(120, 25), 0);
    scene.watch(two_minutes);
    EXPECT_TRUE(scene.touched.empty());
    EXPECT_GE(scene.passed.size(), 8U);
}

/// Who keeps to its lane passes them by half a metre; who changes lanes there would not.
TEST(Lookout, NobodyChangesLanesOverWhoStandsOnTheLineBetween) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        SCOPED_TRACE(seed);
        Scene scene(three_lanes.town, three_lanes.lane, 100, seed);
        const double line = scene.road().width / 2;
        for (double s = 300; s < 3500; s += 160)
            scene.put_walker(scene.free_place(s, 60), line);
        scene.watch(two_minutes);
        EXPECT_TRUE(scene.touched.empty()) << scene.touched.size() << " cars";
        EXPECT_GE(scene.passed.size(), 10U);
    }
}

/// A scenario's car that is to change lanes when there is room: not next to him, but beyond.
TEST(Lookout, WhoIsToldToChangeLanesDoesSoPastWhoStandsOnTheLine) {
    constexpr std::uint32_t actor = 3;
    for (const double begin : {955.0, 970.0, 985.0, 993.0}) {
        SCOPED_TRACE(begin);
        Scene scene(three_lanes.town, three_lanes.lane, 0);
        scene.put_walker(1000, scene.road().width / 2);
        world::CommandT bus = spawn(actor, lane(own_town("straight").town, "east_1"), begin, 4);
        bus.model = world::find_vehicle_model("bus").value();
        world::CommandT change = test::command(world::CommandKind::change_lane, actor);
        change.lanes = {lane(own_town("straight").town, "east_2")};
        scene.stage.step({bus});
        scene.stage.step({change});
        scene.watch(240);
        EXPECT_TRUE(scene.touched.empty());
        EXPECT_EQ(scene.stage.car(actor)->lane(), change.lanes.front());
    }
}

/// One on every sidewalk that is long enough, in its middle, walking along it.
std::vector<world::WalkerState> walkers_on_sidewalks(const world::TownT& town, std::size_t count) {
    std::vector<world::WalkerState> walkers;
    for (std::size_t i = 0; walkers.size() < count; i = (i + 1) % town.lanes.size()) {
        const world::LaneT& lane = town.lanes[i];
        if (lane.kind != world::LaneKind::sidewalk || lane.length < 20)
            continue;
        const auto id = static_cast<std::uint32_t>(walkers.size() + 100);
        const world::LanePoint at = world::point_at(lane, lane.length * 0.2 + id % 8);
        walkers.emplace_back(world::to_vec3(at.position),
                             static_cast<float>(at.yaw),
                             1.4F,
                             0.0F,
                             id,
                             std::uint16_t{0},
                             false,
                             std::uint8_t{0},
                             0U);
    }
    return walkers;
}

TEST(Lookout, WalkersOnSidewalksChangeNothing) {
    const auto& loaded = own_town("town1");
    const auto digest = [&](const std::vector<world::WalkerState>& walkers) {
        Stage stage(loaded, 100);
        stage.walkers = walkers;
        stage.steps(600);
        return stage.digest();
    };
    EXPECT_EQ(digest(walkers_on_sidewalks(loaded.town, 100)), digest({}));
}

/// 30 cm beside a lorry's way, where 40 are left beside people: it goes past at their pace.
TEST(Lookout, WhoStandsAtTheKerbHoldsNobodyUp) {
    const auto& loaded = own_town("town1");
    const std::uint32_t road = lane(loaded.town, "m1_b2_1");
    const std::uint16_t lorry = world::find_vehicle_model("lorry").value();
    Stage stage(loaded, 0);
    world::CommandT command = spawn(1, road, 10);
    command.model = lorry;
    stage.step({command});
    const double half = world::vehicle_models()[lorry].width / 2;
    stage.walkers = {walker_on(loaded.town.lanes[road], 35, -half - 0.3 - 0.2)};
    double s = 0;
    double slowest = 10;
    for (int i = 0; i < 400 && s < 44; ++i) {
        stage.step();
        s = static_cast<double>(stage.car(1)->lane_s());
        if (s > 28)
            slowest = std::min(slowest, static_cast<double>(stage.car(1)->speed()));
    }
    EXPECT_GE(s, 44) << "it stands";
    EXPECT_GT(slowest, 1);
    EXPECT_LT(slowest, 2);
}

/// As one stands who turns around: its tail's corner in front of the car, its middle beside that.
world::VehicleState askew_before(const world::LaneT& lane, double front) {
    constexpr double turned = 2.64;  // [rad]
    const Eigen::Vector2d middle(front - 0.1, 2.3);
    world::VehicleState vehicle = test::vehicle_on(lane, 2, front);
    const world::VehicleModel& model = world::vehicle_models()[vehicle.model()];
    const world::LanePoint at = world::point_at(lane, middle.x());
    const Eigen::Vector2d p =
        at.position.head<2>() + middle.y() * world::left_of(at.yaw) -
        (model.length / 2 - model.rear_overhang) * world::ahead_of(at.yaw + turned);
    vehicle.mutable_position() = world::Vec3(p.x(), p.y(), at.position.z());
    const double half = (at.yaw + turned) / 2;
    vehicle.mutable_orientation() = world::Quat(std::cos(half), 0, 0, std::sin(half));
    return vehicle;
}

TEST(Lookout, WhoWaitsDoesNotStartIntoATailThatStandsAskewBeforeIt) {
    const auto& loaded = own_town("straight");
    const std::uint32_t road = lane(loaded.town, "east_1");
    Stage stage(loaded, 0);
    stage.step({spawn(1, road, 60)});
    const world::VehicleState turning =
        askew_before(loaded.town.lanes[road], static_cast<double>(stage.car(1)->lane_s()));
    const world::VehicleModel& model = world::vehicle_models()[turning.model()];
    const Eigen::Isometry3d pose = world::pose(turning.position(), turning.orientation());
    const Eigen::Vector2d ahead = pose.linear().col(0).head<2>();
    const Box body{pose.translation().head<2>() + (model.length / 2 - model.rear_overhang) * ahead,
                   ahead,
                   {model.length / 2, model.width / 2}};
    const Box waiting = box_of_car(*stage.car(1));
    ASSERT_FALSE(overlap(waiting, body))
        << waiting.centre.transpose() << ", " << body.centre.transpose() << ", "
        << stage.car(1)->lane_s();
    for (int i = 0; i < 300; ++i) {
        stage.step({}, {turning});
        ASSERT_FALSE(overlap(box_of_car(*stage.car(1)), body)) << "tick " << i;
    }
}

TEST(Lookout, RunsWithThingsInTheWayAreRepeatable) {
    const auto digest = [] {
        Scene scene("straight", "east_1");
        scene.park("van", 1000, 0);
        scene.put_walker(1500, 0);
        scene.watch(600);
        return scene.stage.digest();
    };
    EXPECT_EQ(digest(), digest());
}

/// A car at 13 m/s on Town 1's m1_b2_1, and a walker who crosses that 38 m from its start, at 1.4
/// m/s, from a step beside it in tick `start`.
struct Crossing {
    Crossing(int start, bool seen)
        : loaded(own_town("town1")),
          road(lane(loaded.town, "m1_b2_1")),
          stage(loaded, 0) {
        stage.step({spawn(1, road, 5, 13)});
        for (int i = 1; i < 200; ++i) {
            const Eigen::Vector3d p = walker_at(std::max(i - start, 0) * 1.4 * 0.05);
            const auto yaw = static_cast<float>(world::point_at(way(), place).yaw + std::acos(0.0));
            const float speed = i > start ? 1.4F : 0.0F;
            if (seen)
                stage.walkers = {{world::to_vec3(p), yaw, speed, 0, obstacle, 0, false, 0, 0}};
            stage.step();
            const world::CarState& car = *stage.car(1);
            touched |= overlap(box_of_car(car), Box{p.head<2>(), {1, 0}, {0.25, 0.25}});
            if (front_there == 0 && car.lane() == road && static_cast<double>(car.lane_s()) > place)
                front_there = i;
        }
    }

    const world::LaneT& way() const { return loaded.town.lanes[road]; }

    Eigen::Vector3d walker_at(double walked) const {
        const world::LanePoint at = world::point_at(way(), place);
        Eigen::Vector3d p = at.position;
        p.head<2>() += (walked - beside) * world::left_of(at.yaw);
        return p;
    }

    static constexpr double place = 38;
    static constexpr double beside = 2.5;  // [m] from the lane's middle

    const test::Loaded& loaded;
    std::uint32_t road;
    Stage stage;
    int front_there = 0;  ///< tick of the car's bumper at the walker's way
    bool touched = false;
};

TEST(Lookout, AWalkerWhoCrossesIsLetThrough) {
    // In the middle of the lane when the car would be there: the sight alone prevents it.
    const int start = Crossing(0, false).front_there - static_cast<int>(Crossing::beside / 0.07);
    ASSERT_TRUE(Crossing(start, false).touched);
    const Crossing crossing(start, true);
    EXPECT_FALSE(crossing.touched);
    EXPECT_GT(crossing.front_there, start) << "drove on";
}

INSTANTIATE_TEST_SUITE_P(
    ,
    LookoutIn,
    testing::Combine(
        testing::Values(three_lanes, one_lane, close_before_a_queue),
        testing::Values(
            Obstacle{"walker", [](Scene& scene, double s) { scene.put_walker(s, 0); }},
            Obstacle{"walker_lying",
                     [](Scene& scene, double s) { scene.put_walker(s, 0.5, true); }},
            Obstacle{"cone", [](Scene& scene, double s) { scene.put_cone(s); }},
            Obstacle{"van", [](Scene& scene, double s) { scene.park("van", s, 0); }},
            Obstacle{"door",
                     [](Scene& scene, double s) {
                         scene.park("sedan", s, -2.2);
                         scene.open_door(0);
                     }},
            Obstacle{"wreck", [](Scene& scene, double s) { scene.put_wreck(s, 0, -0.9); }},
            Obstacle{"dead_car", [](Scene& scene, double s) { scene.put_wreck(s, 0, 0); }})),
    [](const auto& info) {
        const Place& place = std::get<0>(info.param);
        return fmt::format("{}_{}_{}", place.town, place.lane, std::get<1>(info.param).name);
    });

}  // namespace
}  // namespace reprise::traffic
