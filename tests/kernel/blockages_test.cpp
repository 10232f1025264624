#include "kernel/blockages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernel/measurements.h"
#include "tests/support/worlds.h"
#include "world/blockage.h"

namespace reprise::kernel {
namespace {

constexpr std::uint64_t step_ns = 50'000'000;
constexpr std::uint64_t minute = 60 * 20;  // ticks

/// The first vehicle on a straight road with a signal, tick by tick through stage 6.
class Road {
  public:
    /// So many ticks at this speed. The vehicle itself stays where it is.
    void drive(std::uint64_t ticks, double speed, bool under_way = true) {
        for (std::uint64_t i = 0; i < ticks; ++i) {
            world::TickDraft next;
            next.tick.index = last_.view().index() + 1;
            next.tick.vehicles = {test::vehicle_at(1, x, -1.75, 0, speed)};
            next.traffic.cars = cars;
            next.traffic.walkers = walkers;
            next.tick.signals = {signal};
            measure(town_, lanes_, 0.05, {}, last_.view(), next);
            note_blockages(
                town_, step, [&](const auto&) { return under_way; }, last_.view(), next);
            for (const world::EventT& event : next.tick.events) {
                events.push_back(event);
                event_ticks.push_back(next.tick.index);
            }
            halted_ticks = next.tick.measurements.at(0).halted_ticks();
            last_ = world::seal(next, {});
        }
    }

    double x = 100;
    std::uint64_t step = step_ns;
    std::vector<world::CarState> cars;
    std::vector<world::WalkerState> walkers;
    world::SignalColor signal = world::SignalColor::green;
    std::vector<world::EventT> events;
    std::vector<std::uint64_t> event_ticks;
    std::uint64_t halted_ticks = 0;

  private:
    world::TownT town_ = [] {
        world::TownT town = test::straight_road_with_signal(400);
        for (world::LaneT& lane : town.lanes)
            if (lane.name == "east_1")
                lane.links = {world::Link(
                    world::none, world::none, 0, world::Turn::straight, false, std::uint16_t{0})};
        return town;
    }();
    world::LaneMap lanes_{town_};
    world::SealedTick last_ = [] {
        world::TickDraft genesis;
        return world::seal(genesis, {});
    }();
};

}  // namespace

TEST(Blockages, AMinuteWithoutMovingIsSaidOnceAndLessIsNot) {
    Road road;
    road.drive(20, 5);
    road.drive(minute - 1, 0);
    EXPECT_TRUE(road.events.empty()) << "59.95 s, as before many a red light";
    road.drive(3 * minute, 0.09);
    ASSERT_EQ(road.events.size(), 1U);
    EXPECT_EQ(road.event_ticks[0], 20 + minute);
    EXPECT_EQ(road.events[0].kind, world::EventKind::blocked);
    EXPECT_EQ(road.events[0].actor, 1U);
    EXPECT_EQ(road.events[0].value, 1) << "since then it stands [s]";
    EXPECT_EQ(road.events[0].position.x(), 100);
    EXPECT_EQ(road.events[0].text, "since 1.00 s on east_1");
}

TEST(Blockages, WhoMovesInBetweenBeginsAnewAndCanBeBlockedAgain) {
    Road road;
    road.drive(minute - 1, 0);
    road.drive(1, 0.2);
    road.drive(minute - 1, 0);
    EXPECT_TRUE(road.events.empty());
    road.drive(1, 0);
    road.drive(1, -0.2);  // backwards is moving too
    EXPECT_EQ(road.halted_ticks, 0U);
    road.drive(minute, 0);
    EXPECT_THAT(road.event_ticks, testing::ElementsAre(2 * minute, 3 * minute + 1));
}

TEST(Blockages, WhoDoesNotWantToGetOnIsNotBlocked) {
    Road road;
    road.drive(2 * minute, 0, false);
    EXPECT_TRUE(road.events.empty());
    EXPECT_EQ(road.halted_ticks, 0U);
    road.drive(minute, 0);
    EXPECT_THAT(road.event_ticks, testing::ElementsAre(3 * minute)) << "from when it wanted to";
}

TEST(Blockages, TheMinuteIsOfTimeNotOfTicks) {
    Road road;
    road.step = 2 * step_ns;
    road.drive(minute, 0);
    EXPECT_THAT(road.event_ticks, testing::ElementsAre(minute / 2));
}

TEST(Blockages, SaysWhatIsAhead) {
    const auto blocked = [](const std::function<void(Road&)>& arrange) {
        Road road;
        arrange(road);
        road.drive(minute, 0);
        return road.events.at(0);
    };
    const world::EventT car = blocked([](Road& road) {
        road.cars = {test::car_at(77, 108, -1.75)};
        road.signal = world::SignalColor::red;
    });
    EXPECT_EQ(car.other, 77U);
    EXPECT_THAT(car.detail, testing::StartsWith("vehicle 77 is "));
    const world::EventT walker = blocked([](Road& road) {
        road.walkers.emplace_back(world::Vec3(108, -1, 0),
                                  0.0F,
                                  0.0F,
                                  0.0F,
                                  5U,
                                  std::uint16_t{0},
                                  false,
                                  std::uint8_t{0},
                                  0U);
    });
    EXPECT_EQ(walker.other, 5U);
    EXPECT_EQ(walker.detail, "walker 5 is ahead");
    const world::EventT red = blocked([](Road& road) {
        road.x = 395;
        road.signal = world::SignalColor::red;
    });
    EXPECT_EQ(red.detail, "the signal is red");
    EXPECT_EQ(red.other, 0U);
    const world::EventT nothing = blocked([](Road& road) {
        road.cars = {test::car_at(77, 140, -1.75)};  // too far to be the reason
    });
    EXPECT_EQ(nothing.detail, "");
    EXPECT_EQ(nothing.other, 0U);
}

}  // namespace reprise::kernel
