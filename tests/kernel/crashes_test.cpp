// Whole runs in which a vehicle with mass hits cars of traffic's, parked ones and two-wheelers.
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/kernel/whole_run.h"
#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/car_model.h"

namespace reprise::test {
namespace {

world::Recording on_ice(const std::string& body, double seconds) {
    world::Recording recording = on_straight_lanes(body, seconds);
    recording.episode.road_friction = 0.05;  // what is not of the crash stays small
    return recording;
}

const world::Event* find_event(const KeptTick& tick, world::EventKind kind, std::uint32_t actor) {
    for (const auto* event : *tick.recorded().view.tick->events())
        if (event->kind() == kind && event->actor() == actor)
            return event;
    return nullptr;
}

std::size_t count_events(const std::vector<KeptTick>& ticks, world::EventKind kind) {
    std::size_t count = 0;
    for (const KeptTick& tick : ticks)
        for (const auto* event : *tick.recorded().view.tick->events())
            count += event->kind() == kind ? 1 : 0;
    return count;
}

/// [i] of the tick in which it happens; the number of ticks: never.
std::size_t tick_of(const std::vector<KeptTick>& ticks,
                    world::EventKind kind,
                    std::uint32_t actor) {
    std::size_t i = 0;
    while (i < ticks.size() && find_event(ticks[i], kind, actor) == nullptr)
        ++i;
    return i;
}

/// Along the ground, of whoever has this id, in ticks[i]. [kg m/s] A car of traffic's does not go
/// where it points to while it swerves: as it moved since the tick before.
Eigen::Vector2d momentum(const std::vector<KeptTick>& ticks, std::size_t i, std::uint32_t id) {
    const world::TickView tick = ticks[i].recorded().view;
    if (const auto* car = world::find(tick.cars(), id)) {
        constexpr double step = 0.05;  // [s]
        const world::TickView last = ticks[i - 1].recorded().view;
        const world::VehicleModel& model = world::vehicle_models()[car->model()];
        const auto middle = [&](const world::CarState& state) -> Eigen::Vector2d {
            return world::in_plan(state.position()) +
                   world::car_model(model).com_ahead * world::ahead_of(double{state.yaw()});
        };
        return model.mass * (middle(*car) - middle(*world::find(last.cars(), id))) / step;
    }
    const world::VehicleState& state = *world::find(tick.vehicles(), id);
    const world::VehicleModel& model = world::vehicle_models()[state.model()];
    const bool fallen = world::is_two_wheeler(model.body);
    const world::CarModel car = fallen ? world::unbalanced_model(model) : world::car_model(model);
    const Eigen::Vector3d arm =
        world::to_eigen(state.orientation()) * Eigen::Vector3d(car.com_ahead, 0, car.com_height);
    const Eigen::Vector3d velocity =
        world::to_eigen(state.velocity()) + world::to_eigen(state.angular_velocity()).cross(arm);
    return model.mass * velocity.head<2>();
}

/// [N s] of all vehicles with mass against the ground and what stands on it, so far.
double impulse_of_ground(const KeptTick& tick) {
    double sum = 0;
    for (const auto& measured : tick.recorded().view.measurements())
        sum += measured.impulse_static();
    return sum;
}

double largest_impulse(const std::vector<KeptTick>& ticks) {
    double most = 0;
    for (const KeptTick& tick : ticks)
        for (const auto* event : *tick.recorded().view.tick->events())
            if (event->kind() == world::EventKind::collision ||
                event->kind() == world::EventKind::collision_ended)
                most = std::max(most, event->value());
    return most;
}

/// A ramming: who hits whom, how fast, and from where. Actor 1 rams actor 2.
struct Ramming {
    const char* rammer;
    double speed;  ///< [m/s]
    const char* target;
    double target_speed;   ///< [m/s]; 0: it is parked
    double direction_deg;  ///< of the rammer's motion; the target's is 0
};

std::string scenario_of(const Ramming& ramming) {
    // They would meet at x = 300 on the middle lane, this many seconds behind the start.
    const bool along = std::abs(std::sin(ramming.direction_deg)) < 1e-3 ||
                       std::fmod(ramming.direction_deg, 180) == 0;
    const double closing =
        along ? std::abs(ramming.speed -
                         ramming.target_speed * (ramming.direction_deg == 0 ? 1.0 : -1.0))
              : ramming.speed;
    const double time = (along ? 14 : 12) / closing;
    const double turn = ramming.direction_deg * M_PI / 180;
    const double x = 300 - std::cos(turn) * ramming.speed * time;
    const double y = -4.8 - std::sin(turn) * ramming.speed * time;
    const bool parked = ramming.target_speed == 0;
    std::string text = fmt::format(
        "local ego = spawn{{ model = '{}', driver = 'manual', x = {}, y = {}, heading_deg = {}, "
        "speed = {} }}\n"
        "local car = spawn{{ model = '{}', driver = '{}', lane = 'main_1', s = {}{} }}\n",
        ramming.rammer,
        x,
        y,
        ramming.direction_deg,
        ramming.speed,
        ramming.target,
        parked ? "parked" : "traffic",
        300 - ramming.target_speed * time,
        parked ? "" : fmt::format(", speed = {}", ramming.target_speed));
    if (!parked)
        text += fmt::format("car:hold_speed({})\n", ramming.target_speed);
    return text + "ego:control{}\nwait(60)";
}

class Rammings : public testing::TestWithParam<Ramming> {};

/// Tyres on ice, a tick long, are what is lost: 37 N s for 1,500 kg; and where a car is pressed
/// onto the ground, or is at a kerb, what that takes of it.
TEST_P(Rammings, KeepTheMomentumOfBoth) {
    const auto ticks = run(on_ice(scenario_of(GetParam()), 4));
    const std::size_t hit = tick_of(ticks, world::EventKind::wrecked, 2);
    ASSERT_LT(hit, ticks.size());
    ASSERT_GT(hit, 1U);
    const Eigen::Vector2d before_1 = momentum(ticks, hit - 1, 1);
    const Eigen::Vector2d before_2 = momentum(ticks, hit - 1, 2);
    const Eigen::Vector2d after = momentum(ticks, hit + 1, 1) + momentum(ticks, hit + 1, 2);
    const double ground = impulse_of_ground(ticks[hit + 1]) - impulse_of_ground(ticks[hit - 1]);
    const double most = std::max(before_1.norm(), before_2.norm());
    EXPECT_LT((after - before_1 - before_2).norm(), 0.05 * most + ground)
        << (before_1 + before_2).transpose() << " before, " << after.transpose() << " behind, "
        << ground << " into the ground";
    // They bounce by 0.3 * 0.3 of the speed at which they close.
    EXPECT_LT(largest_impulse(ticks), 1.1 * (before_1.norm() + before_2.norm()));
    const auto* event = find_event(ticks[hit], world::EventKind::wrecked, 2);
    EXPECT_NEAR(event->value(), GetParam().target_speed, 0.1);
    EXPECT_EQ(event->other(), 1U);
}

INSTANTIATE_TEST_SUITE_P(Crashes,
                         Rammings,
                         testing::Values(Ramming{"sedan", 15, "hatchback", 5, 0},
                                         Ramming{"sedan", 30, "hatchback", 10, 0},
                                         Ramming{"suv", 20, "lorry", 8, 0},
                                         Ramming{"lorry", 20, "sedan", 10, 0},
                                         Ramming{"sedan", 18, "bus", 8, 0},
                                         Ramming{"sedan", 12, "bicycle", 4, 0},
                                         Ramming{"sedan", 25, "motorcycle", 10, 0},
                                         Ramming{"sedan", 5, "hatchback", 0, 0},
                                         Ramming{"sedan", 20, "hatchback", 0, 0},
                                         Ramming{"suv", 30, "bus", 0, 0},
                                         Ramming{"sedan", 10, "suv", 8, 180},
                                         Ramming{"sedan", 25, "lorry", 15, 180},
                                         Ramming{"lorry", 15, "hatchback", 0, 180},
                                         Ramming{"sedan", 15, "hatchback", 8, -90},
                                         Ramming{"suv", 20, "lorry", 6, -90},
                                         Ramming{"sedan", 10, "bicycle", 5, -90},
                                         Ramming{"sedan", 30, "sedan", 0, -90},
                                         Ramming{"sedan", 20, "suv", 10, -45},
                                         Ramming{"suv", 25, "bus", 0, -45},
                                         Ramming{"sedan", 15, "motorcycle", 0, -60},
                                         // It swerves.
                                         Ramming{"city_car", 8, "lorry", 6, 165},
                                         // From a slope: pressed onto the ground.
                                         Ramming{"suv", 30, "city_car", 0, 135},
                                         // Its tail is at a kerb as it hits.
                                         Ramming{"bus", 9, "bus", 10, 60}));

/// Neither of the two has mass before, and nothing but the crash would stop them.
TEST(Crashes, CarsThatDriveIntoEachOtherAreWreckedAndKeepTheirMomentum) {
    const std::string second = "local b = spawn{ model = 'van', ";
    const std::vector<std::pair<std::string, std::string>> stories = {
        {"rear end",
         second + "driver = 'traffic', lane = 'main_1', s = 120, speed = 3 }\n"
                  "b:hold_speed(3) a:hold_speed(15)"},
        {"parked", second + "driver = 'parked', lane = 'main_1', s = 120 }\na:hold_speed(15)"},
        {"from the side",
         second + "driver = 'traffic', lane = 'main_2', s = 100, speed = 15 }\n"
                  "b:hold_speed(15) a:follow{ { t = 2, lane = 'main_2', s = 130 } }"}};
    for (const auto& [name, story] : stories) {
        const auto ticks = run(on_ice(
            "local a = spawn{ model = 'sedan', driver = 'traffic', lane = 'main_1', s = 100, "
            "speed = 15 }\n" +
                story + "\nwait(60)",
            8));
        const std::size_t hit = tick_of(ticks, world::EventKind::wrecked, 1);
        ASSERT_LT(hit, ticks.size()) << name;
        ASSERT_GT(hit, 1U) << name;
        EXPECT_EQ(tick_of(ticks, world::EventKind::wrecked, 2), hit) << name;
        EXPECT_EQ(find_event(ticks[hit], world::EventKind::wrecked, 1)->other(), 2U) << name;
        EXPECT_NE(find_event(ticks[hit], world::EventKind::collision, 1), nullptr) << name;
        const Eigen::Vector2d before = momentum(ticks, hit - 1, 1) + momentum(ticks, hit - 1, 2);
        const Eigen::Vector2d after = momentum(ticks, hit + 1, 1) + momentum(ticks, hit + 1, 2);
        EXPECT_LT((after - before).norm(), 0.05 * before.norm()) << name;
    }
}

/// Who hits and who is hit, on a trajectory or not, whatever it is.
TEST(Crashes, VehiclesOnTrajectoriesKeepTheMomentumOfBoth) {
    const std::string led = "a:follow{ { t = 4, lane = 'main_1', s = 160 } }\n";
    const std::vector<std::pair<std::string, std::string>> stories = {
        {"who is led hits", "'lorry', driver = 'manual', lane = 'main_1', s = 120 }\n" + led},
        {"who is led hits a parked car",
         "'van', driver = 'parked', lane = 'main_1', s = 120 }\n" + led},
        {"who is led is hit",
         "'van', driver = 'manual', lane = 'main_1', s = 80, speed = 25 } b:control{}\n" + led},
        {"both are led",
         "'van', driver = 'manual', lane = 'main_1', s = 140 }\n"
         "b:follow{ { t = 4, lane = 'main_1', s = 120 } }\n" +
             led}};
    for (const auto& [name, story] : stories) {
        const auto ticks = run(on_ice(
            "local a = spawn{ model = 'sedan', driver = 'manual', lane = 'main_1', s = 100, speed "
            "= 15 }\na:control{}\nlocal b = spawn{ model = " +
                story + "wait(60)",
            6));
        const std::size_t hit = tick_of(ticks, world::EventKind::collision, 1);
        ASSERT_LT(hit, ticks.size()) << name;
        ASSERT_GT(hit, 2U) << name;
        const Eigen::Vector2d before_1 = momentum(ticks, hit - 1, 1);
        const Eigen::Vector2d before_2 = momentum(ticks, hit - 1, 2);
        const Eigen::Vector2d after = momentum(ticks, hit + 1, 1) + momentum(ticks, hit + 1, 2);
        EXPECT_LT((after - before_1 - before_2).norm(),
                  0.05 * std::max(before_1.norm(), before_2.norm()))
            << name << ": " << (before_1 + before_2).transpose() << " before, " << after.transpose()
            << " behind";
    }
}

TEST(Crashes, CarsThatPassOrFollowCloselyAreLeftAlone) {
    const auto ticks = run(on_straight_lanes(
        "local a = spawn{ model = 'sedan', driver = 'traffic', lane = 'main_1', s = 100, speed = "
        "15 }\n"
        "spawn{ model = 'bus', driver = 'parked', x = 160, y = -2.3, heading_deg = 0 }\n"
        "local b = spawn{ model = 'van', driver = 'traffic', lane = 'main_1', s = 90, speed = 15 "
        "}\n"
        "a:hold_speed(15) b:hold_speed(15) wait(60)",
        10));
    EXPECT_EQ(count_events(ticks, world::EventKind::wrecked), 0U);
}

const std::string rear_end =
    "local ego = spawn{ name = 'ego', model = 'sedan', driver = 'manual', lane = 'main_1', s = "
    "100, speed = 20 }\n"
    "local car = spawn{ name = 'lead', model = 'hatchback', driver = 'traffic', lane = 'main_1', s "
    "= 115, speed = 10 }\n"
    "car:hold_speed(10)\n"
    "ego:control{}\n";

TEST(Crashes, ACarThatIsHitBecomesAVehicleRestsAndStays) {
    const auto ticks = run(on_straight_lanes(rear_end + "wait(60)", 12));
    const std::size_t hit = tick_of(ticks, world::EventKind::wrecked, 2);
    ASSERT_LT(hit, ticks.size());
    EXPECT_EQ(count_events(ticks, world::EventKind::wrecked), 1U);
    EXPECT_EQ(count_events(ticks, world::EventKind::despawned), 0U);
    EXPECT_NE(find_event(ticks[hit], world::EventKind::collision, 1), nullptr);
    for (std::size_t i = 0; i < ticks.size(); ++i) {
        const world::TickView view = ticks[i].recorded().view;
        ASSERT_EQ(world::find(view.cars(), 2) == nullptr, i >= hit) << i;
        ASSERT_EQ(world::find(view.vehicles(), 2) == nullptr, i < hit) << i;
        ASSERT_EQ(view.wheels().size(), 4 * view.vehicles().size()) << i;
        ASSERT_EQ(view.controls().size(), view.vehicles().size()) << i;
        ASSERT_EQ(view.measurements().size(), view.vehicles().size()) << i;
        ASSERT_EQ(view.vehicle_looks().size(), view.vehicles().size()) << i;
        ASSERT_EQ(view.car_looks().size(), view.cars().size()) << i;
    }
    // The same car, from one tick to the next.
    const world::CarState& before = *world::find(ticks[hit - 1].recorded().view.cars(), 2);
    const world::VehicleState& after = *world::find(ticks[hit].recorded().view.vehicles(), 2);
    EXPECT_LT((world::to_eigen(after.position()) - world::to_eigen(before.position())).norm(), 1.0);
    EXPECT_EQ(after.model(), before.model());
    const world::TickView last = ticks.back().recorded().view;
    const world::VehicleState& rests = *world::find(last.vehicles(), 2);
    EXPECT_LT(world::to_eigen(rests.velocity()).norm(), 0.02);
    EXPECT_GT(rests.position().x(), before.position().x() + 2) << "it slid";
    EXPECT_TRUE(world::find(last.controls(), 2)->hand_brake());
    EXPECT_GT(world::find(last.measurements(), 2)->impulse_vehicles(), 1000);
}

TEST(Crashes, TrafficBehindAWreckDoesNotRunIntoIt) {
    const std::string behind =
        "local next = spawn{ name = 'next', model = 'sedan', driver = 'traffic', lane = 'main_1', "
        "s = 20, speed = 12 }\n";
    const auto ticks = run(on_straight_lanes(rear_end + behind + "wait(60)", 20));
    EXPECT_EQ(count_events(ticks, world::EventKind::wrecked), 1U);
    EXPECT_NE(world::find(ticks.back().recorded().view.cars(), 3), nullptr);
}

TEST(Crashes, AnEgoBetweenTwoCarsStaysOnItsWheels) {
    const std::string body =
        "local ego = spawn{ name = 'ego', model = 'hatchback', driver = 'manual', lane = 'main_1', "
        "s = 200 }\n"
        "spawn{ model = 'lorry', driver = 'parked', ahead_of = ego, gap = 0.5 }\n"
        "local car = spawn{ model = 'lorry', driver = 'traffic', lane = 'main_1', s = 150, speed = "
        "15 }\n"
        "car:hold_speed(15)\nego:control{ brake = 1 }\nwait(60)";
    const auto ticks = run(on_straight_lanes(body, 10));
    EXPECT_EQ(count_events(ticks, world::EventKind::wrecked), 2U);
    const double most = 15 * world::vehicle_models()[*world::find_vehicle_model("lorry")].mass;
    EXPECT_GT(largest_impulse(ticks), 1000);
    EXPECT_LT(largest_impulse(ticks), 1.1 * most) << "the lorry's momentum, and the bounce";
    const auto& ego = *world::find(ticks.back().recorded().view.vehicles(), 1);
    EXPECT_GT((world::to_eigen(ego.orientation()) * Eigen::Vector3d::UnitZ()).z(), 0.9);
}

class TwoWheelers : public testing::TestWithParam<const char*> {};

TEST_P(TwoWheelers, FallWhenTheyAreHit) {
    const std::string body = fmt::format(
        "local ego = spawn{{ name = 'ego', model = 'sedan', driver = 'manual', lane = 'main_1', s "
        "= 100, speed = 12 }}\n"
        "local it = spawn{{ model = '{}', driver = 'traffic', lane = 'main_1', s = 115, speed = 5 "
        "}}\nit:hold_speed(5)\nego:control{{}}\nwait(1.5)\nego:control{{ brake = 0.5 }}\nwait(60)",
        GetParam());
    const auto ticks = run(on_straight_lanes(body, 10));
    ASSERT_EQ(count_events(ticks, world::EventKind::wrecked), 1U);
    const auto& lies = *world::find(ticks.back().recorded().view.vehicles(), 2);
    EXPECT_LT((world::to_eigen(lies.orientation()) * Eigen::Vector3d::UnitZ()).z(), 0.4);
    EXPECT_LT(world::to_eigen(lies.velocity()).norm(), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Crashes, TwoWheelers, testing::Values("bicycle", "motorcycle"));

TEST(Crashes, WhatIsSaidToAWreckIsAnsweredOnce) {
    const auto ticks = run(on_straight_lanes(rear_end + "wait(3)\nfor i = 1, 5 do car:set_speed(3) "
                                                        "wait(0.1) end\ncar:despawn() wait(1)",
                                             12));
    std::size_t answers = 0;
    for (const KeptTick& tick : ticks)
        for (const auto* event : *tick.recorded().view.tick->events())
            if (event->kind() == world::EventKind::printed) {
                EXPECT_EQ(event->text()->str().find("set_speed: lead is a wreck since "), 0U)
                    << event->text()->str();
                EXPECT_GT(event->line(), 0U);
                ++answers;
            }
    EXPECT_EQ(answers, 1U);
    EXPECT_EQ(count_events(ticks, world::EventKind::despawned), 1U);
    EXPECT_EQ(ticks.back().recorded().view.vehicles().size(), 1U);
    EXPECT_TRUE(ticks.back().recorded().view.cars().empty());
}

TEST(Crashes, TheDemandIsKeptInCarsThatDrive) {
    const std::string body =
        "local ego = spawn{ name = 'ego', model = 'lorry', driver = 'manual', speed = 15 }\n"
        "local car = spawn{ name = 'lead', model = 'sedan', driver = 'parked', ahead_of = ego, gap "
        "= 3 }\nego:control{}\nwait(60)";
    const auto ticks = run(in_town1(body, 20, 6));
    ASSERT_EQ(count_events(ticks, world::EventKind::wrecked), 1U);
    std::size_t background = 0;
    for (const world::CarState& car : ticks.back().recorded().view.cars())
        background += car.id() >= world::first_background_id ? 1 : 0;
    EXPECT_EQ(background, 20U);
}

TEST(Crashes, TwoRunsAreEqualInEveryTick) {
    const auto recording = on_straight_lanes(rear_end + "wait(60)", 6);
    const auto once = run(recording);
    const auto again = run(recording);
    ASSERT_EQ(once.size(), again.size());
    for (std::size_t i = 0; i < once.size(); ++i)
        ASSERT_EQ(once[i].recorded().view.tick->digests()->chain().low(),
                  again[i].recorded().view.tick->digests()->chain().low())
            << i;
}

}  // namespace
}  // namespace reprise::test
