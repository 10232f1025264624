#include "kernel/lamp_orders.h"

#include <gtest/gtest.h>

#include "tests/kernel/whole_run.h"
#include "tests/support/worlds.h"
#include "world/models/catalogue.h"

namespace reprise::kernel {
namespace {

constexpr std::uint16_t hazard = world::lamp_left | world::lamp_right;

/// Lamps of the actors 1 (autopilot) and 2 (SUMO's) in a tick.
std::pair<int, int> lamps(const world::TickView& tick) {
    const world::VehicleState* ego = world::find(tick.vehicles(), 1);
    const world::CarState* car = world::find(tick.cars(), 2);
    return {ego == nullptr ? -1 : ego->lamps(), car == nullptr ? -1 : car->lamps()};
}

TEST(LampOrders, LightWhatTheyNameWhoeverDrivesAndNothingElse) {
    const auto run = [](const std::string& words) {
        std::vector<std::pair<int, int>> seen;
        const world::Recording recording = test::in_town1(
            "local lane = pick_lane{ length = 120 } "
            "local ego = spawn{ model = 'sedan', lane = lane, s = 60 } "
            "local car = spawn{ model = 'sedan', driver = 'traffic', lane = lane, s = 20 } "
            "wait_ticks(10) " +
                words + " wait_ticks(30)",
            0,
            10);
        Kernel kernel(recording);
        while (!kernel.finished())
            seen.push_back(lamps(kernel.step({}).view()));
        return seen;
    };
    const auto plain = run("");
    const auto lit =
        run("ego:set_lamps{ hazard = true } car:set_lamps{ left = true } "
            "wait_ticks(10) ego:set_lamps{ hazard = false } wait_ticks(10) "
            "ego:set_lamps() car:set_lamps()");
    ASSERT_EQ(plain.size() + 20, lit.size());
    int held = 0;
    for (std::size_t i = 0; i < plain.size(); ++i) {
        const std::size_t tick = i + 1;
        const bool of_ego = tick >= 11 && tick < 31;
        const int ego_hazard = tick < 21 ? hazard : 0;
        EXPECT_EQ(lit[i].first, of_ego ? (plain[i].first & ~hazard) | ego_hazard : plain[i].first)
            << "tick " << tick;
        EXPECT_EQ(lit[i].second, of_ego ? plain[i].second | world::lamp_left : plain[i].second)
            << "tick " << tick;
        held += of_ego ? 1 : 0;
    }
    EXPECT_EQ(held, 20);
}

}  // namespace
}  // namespace reprise::kernel
