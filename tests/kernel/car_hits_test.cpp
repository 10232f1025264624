#include "kernel/car_hits.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernel/verify.h"
#include "tests/kernel/whole_run.h"
#include "tests/support/worlds.h"

namespace reprise::kernel {
namespace {

/// What a run tells of collisions: "begins 1 2" (actor, other) or "ends 1 2".
std::vector<std::string> collisions(const std::vector<test::KeptTick>& ticks) {
    std::vector<std::string> found;
    for (const test::KeptTick& tick : ticks) {
        const auto recorded = tick.recorded();
        for (const world::Event* event : *recorded.view.tick->events()) {
            const std::string both =
                std::to_string(event->actor()) + " " + std::to_string(event->other());
            if (event->kind() == world::EventKind::collision)
                found.push_back("begins " + both);
            if (event->kind() == world::EventKind::collision_ended)
                found.push_back("ends " + both);
        }
    }
    return found;
}

double hardest_braking_of(std::uint32_t car, const std::vector<test::KeptTick>& ticks) {
    double least = 0;
    for (const test::KeptTick& tick : ticks) {
        const auto recorded = tick.recorded();
        if (const world::CarState* state = world::find(recorded.view.cars(), car))
            least = std::min(least, static_cast<double>(state->acceleration()));
    }
    return -least;
}

const std::string car_at_50 = R"(
    local car = spawn{ model = 'sedan', driver = 'traffic', lane = 'east_1', s = 100, speed_kmh = 50 }
)";

std::vector<test::KeptTick> run_of(const std::string& body, double seconds) {
    return test::run(test::in_town("straight", car_at_50 + body, seconds));
}

TEST(CarHits, ACarThatLooksStopsBeforeAWalkerInItsLane) {
    const auto ticks = run_of(
        "spawn{ model = 'adult', driver = 'walker', lane = 'east_1', s = 180 } wait(30)", 20);
    EXPECT_THAT(collisions(ticks), testing::IsEmpty());
    const auto last = ticks.back().recorded();
    const world::CarState* car = world::find(last.view.cars(), 1);
    ASSERT_NE(car, nullptr);
    EXPECT_LT(hardest_braking_of(1, ticks), 5);
}

TEST(CarHits, AWalkerWhoIsThereAllAtOnceIsHitByACarThatBrakesAsHardAsItCan) {
    const auto ticks = run_of(R"(
        wait(1)
        spawn{ model = 'adult', driver = 'walker', lane = 'east_1', s = car:s() + 14 }
        wait(30))",
                              10);
    EXPECT_THAT(collisions(ticks), testing::ElementsAre("begins 1 2", "ends 1 2"));
    EXPECT_NEAR(hardest_braking_of(1, ticks), 9, 0.2);
    const auto last = ticks.back().recorded();
    EXPECT_TRUE(world::find(last.view.walkers(), 2)->down());
}

TEST(CarHits, OneThatReactsToNothingHitsAtItsSpeed) {
    const auto ticks = run_of(R"(
        spawn{ model = 'adult', driver = 'walker', lane = 'east_1', s = 160 }
        car:hold_speed_kmh(50)
        wait(30))",
                              10);
    EXPECT_THAT(collisions(ticks), testing::ElementsAre("begins 1 2", "ends 1 2"));
    for (const test::KeptTick& tick : ticks) {
        const auto recorded = tick.recorded();
        for (const world::Event* event : *recorded.view.tick->events())
            if (event->kind() == world::EventKind::collision) {
                EXPECT_GT(event->value(), 50 * 50 / 3.6 * 0.9) << "a person of 50 kg or more";
            }
    }
}

TEST(CarHits, AWalkerWhoBumpsIntoAStandingCarIsNoEvent) {
    world::TickDraft draft;
    draft.traffic.cars = {test::car_at(1'000'000, 0, 0)};
    const world::WalkerState walker(
        world::Vec3(1, 1, 0), -1.5F, 1.4F, 0, 5, 0, false, std::uint8_t{0}, 0);
    draft.traffic.walkers = {walker};
    const world::SealedTick last = test::tick_with({});
    note_hit_walkers(0.05, last.view(), draft);
    EXPECT_TRUE(draft.tick.events.empty());
    draft.traffic.cars = {test::car_at(1'000'000, 0, 0, 0, 3)};
    draft.traffic.walkers = {{world::Vec3(3.9, 0.2, 0), 0, 0, 0, 5, 0, false, std::uint8_t{0}, 0}};
    note_hit_walkers(0.05, last.view(), draft);
    ASSERT_EQ(draft.tick.events.size(), 1U) << "the same, driving";
    EXPECT_EQ(draft.tick.events.front().actor, 1'000'000U);
    EXPECT_EQ(draft.tick.events.front().other, 5U);
}

/// Its tail goes sideways, while the bus drives on; a walker beside one that drives straight on is
/// only passed.
TEST(CarHits, TheTailOfABusThatTurnsHits) {
    const auto model = *world::find_vehicle_model("bus");
    const world::VehicleModel& bus = world::vehicle_models()[model];
    const double turned = 0.25 * 0.05;  // [rad] in a tick, to the left
    const auto at = [&](double x, double yaw) {
        world::CarState car = test::car_at(1'000'000, x, 0, yaw, 2);
        car.mutate_model(model);
        return car;
    };
    for (const double before : {0.0, -turned}) {
        const world::SealedTick last = test::tick_with({}, {at(-0.1, before)});
        world::TickDraft draft;
        draft.traffic.cars = {at(0, 0)};
        draft.traffic.walkers = {{world::Vec3(0.2 - bus.rear_overhang, -bus.width / 2 - 0.1, 0),
                                  0,
                                  0,
                                  0,
                                  5,
                                  0,
                                  false,
                                  std::uint8_t{0},
                                  0}};
        note_hit_walkers(0.05, last.view(), draft);
        ASSERT_EQ(draft.tick.events.size(), before < 0 ? 1U : 0U);
        if (before < 0) {
            EXPECT_EQ(draft.tick.events.front().other, 5U);
            EXPECT_NEAR(draft.tick.events.front().value,
                        world::walker_models()[0].mass * 0.25 * (bus.rear_overhang - 0.2),
                        0.05 * world::walker_models()[0].mass);
        }
    }
}

}  // namespace
}  // namespace reprise::kernel
