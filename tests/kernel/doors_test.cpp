#include "kernel/doors.h"

#include <gtest/gtest.h>

#include "kernel/kernel.h"
#include "tests/kernel/whole_run.h"
#include "world/models/doors.h"

namespace reprise::kernel {
namespace {

using test::KeptTick;

std::vector<KeptTick> play(const std::string& body, double seconds) {
    return test::run(test::on_straight_lanes(body, seconds));
}

/// The impulses of all collisions of actor 2 with actor 1. [N s]
double hits(const std::vector<KeptTick>& ticks) {
    double sum = 0;
    for (const KeptTick& tick : ticks)
        for (const world::Event* event : *tick.recorded().view.tick->events())
            if (event->kind() == world::EventKind::collision && event->actor() == 2 &&
                event->other() == 1)
                sum += event->value();
    return sum;
}

/// A parked car at the right edge of its lane, and one that comes along blindly beside it.
std::string beside(const std::string& driver, const std::string& words) {
    return "local parked = spawn{ name = 'parked', model = 'sedan', driver = 'parked', "
           "lane = 'main_1', s = 60, offset = -0.8 } "
           "local comer = spawn{ name = 'comer', model = 'sedan', driver = '" +
           driver + "', lane = 'main_1', s = 10, offset = 1.4, speed = 8 } " +
           (driver == "manual" ? "start(function() while true do comer:control{ throttle = 0.15 } "
                                 "wait_ticks(1) end end) "
                               : "") +
           words + " wait(12)";
}

TEST(Doors, SwingOpenAndShutAtAPersonsPace) {
    const auto ticks = play(
        "local car = spawn{ model = 'sedan', driver = 'parked', lane = 'main_1', "
        "s = 60 } car:set_doors{ front_left = true, rear_right = true } wait(3) "
        "car:set_doors{ front_left = false } wait(3)",
        7);
    const auto open = ticks[50].recorded().view.doors();
    ASSERT_EQ(open.size(), 2U);
    EXPECT_EQ(open[0].door(), 0);
    EXPECT_DOUBLE_EQ(open[0].angle(), world::widest_door);
    EXPECT_EQ(open[1].door(), 3);
    const auto late = ticks.back().recorded().view.doors();
    ASSERT_EQ(late.size(), 1U) << "the other one is shut again";
    EXPECT_EQ(late[0].door(), 3);
}

TEST(Doors, StopWhoComesTooClose) {
    EXPECT_EQ(hits(play(beside("manual", ""), 10)), 0) << "shut it leaves room";
    EXPECT_GT(hits(play(beside("manual", "parked:set_doors{ front_left = true }"), 10)), 20);
}

TEST(Doors, OfACarWithMassDoNotPushIt) {
    const auto still = play(
        "spawn{ model = 'sedan', driver = 'manual', lane = 'main_1', s = 60 } "
        "wait(4)",
        4);
    const auto open = play(
        "spawn{ model = 'sedan', driver = 'manual', lane = 'main_1', s = 60 }"
        ":set_doors{ front_left = true, front_right = true } wait(4)",
        4);
    EXPECT_EQ(open.back().recorded().view.vehicles()[0],
              still.back().recorded().view.vehicles()[0]);
    EXPECT_EQ(open.back().recorded().view.doors().size(), 2U);
}

/// Each time it has another body in Bullet, and elsewhere in memory: bodies of as many cars as
/// malloc keeps of one size were given back before.
TEST(Doors, OfACarThatIsPutElsewhereDoNotPushItEither) {
    const auto states = [](const std::string& doors) {
        return play(
            "local car = spawn{ model = 'sedan', driver = 'manual', lane = 'main_1', s = 60 } " +
                doors +
                " local others = {} for i = 1, 9 do others[i] = spawn{ model = 'sedan', driver = "
                "'manual', lane = 'main_0', s = 20 + 15 * i } end wait(0.2) "
                "for i = 1, 9 do others[i]:despawn() end wait(0.3) for i = 1, 6 do car:teleport{ "
                "lane = 'main_1', s = 60 + 15 * i, "
                "speed = 5 } wait(0.5) end",
            4);
    };
    const auto shut = states("car:set_doors{ front_left = false, front_right = false }");
    const auto open = states("car:set_doors{ front_left = true, front_right = true }");
    ASSERT_EQ(open.size(), shut.size());
    for (std::size_t i = 0; i < open.size(); ++i)
        EXPECT_EQ(open[i].recorded().view.vehicles()[0], shut[i].recorded().view.vehicles()[0]);
}

TEST(Doors, AreSeenByAnAutopilot) {
    const auto ticks = play(beside("autopilot", "parked:set_doors{ front_left = true }"), 12);
    EXPECT_EQ(hits(ticks), 0);
}

}  // namespace
}  // namespace reprise::kernel
