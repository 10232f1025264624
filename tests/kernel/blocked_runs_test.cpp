// What becomes of blockages in whole runs: who is on its way, branches, verify.
#include <filesystem>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernel/verify.h"
#include "replay/trace_writer.h"
#include "tests/kernel/whole_run.h"

namespace reprise::test {

namespace {

/// The blockages of a run: "tick actor other".
std::vector<std::string> blockages(const std::vector<KeptTick>& ticks) {
    std::vector<std::string> found;
    for (const KeptTick& tick : ticks) {
        const world::TickView view = tick.recorded().view;
        for (const world::Event* event : *view.tick->events())
            if (event->kind() == world::EventKind::blocked)
                found.push_back(std::to_string(view.index()) + " " +
                                std::to_string(event->actor()) + " " +
                                std::to_string(event->other()));
    }
    return found;
}

std::vector<std::string> blockages(const std::string& body, double seconds = 75) {
    return blockages(run(in_town1(body, 0, seconds)));
}

/// A lane with a car that stands in its middle, and somebody who was not told to get around it.
const std::string obstacle = R"(
    local road = pick_lane{ length = 80 }
    spawn{ model = 'sedan', driver = 'parked', lane = road, s = 50 }
)";

const std::string behind_it = obstacle + R"(
    local ego = spawn{ name = 'ego', model = 'sedan', driver = 'autopilot', lane = road, s = 20 }
)";

TEST(Blocked, AnAutopilotBehindAParkedCarIs) {
    EXPECT_THAT(blockages(behind_it + "wait(100)"),
                testing::ElementsAre(testing::EndsWith(" 2 1")));
}

TEST(Blocked, WhoWasToldToStandIsNot) {
    EXPECT_THAT(blockages(behind_it + "ego:set_speed(0) wait(100)"), testing::IsEmpty());
}

TEST(Blocked, AManualVehicleIsWhileItPushesNotWhileItStandsOnPurpose) {
    const std::string manual = obstacle + R"(
        local hand = spawn{ model = 'sedan', driver = 'manual', lane = road, s = 30 })";
    EXPECT_THAT(blockages(manual + "wait(100)"), testing::IsEmpty()) << "nobody drives";
    EXPECT_THAT(blockages(manual + R"(
        hand:control{ throttle = 0.4 } wait(2) hand:control{ brake = 1 } wait(100))"),
                testing::IsEmpty())
        << "the script brakes";
    EXPECT_THAT(blockages(manual + R"(
        hand:control{ throttle = 0.4, brake = 1 } wait(100))"),
                testing::SizeIs(1));
    EXPECT_THAT(blockages(manual + R"(
        hand:control{ throttle = 0.4, brake = 1, hand_brake = true } wait(100))"),
                testing::IsEmpty());
}

TEST(Blocked, ADriverFromOutsideIsFromWhenItFirstMoved) {
    const auto driven = [](double throttle) {
        const world::Recording recording = in_town1(R"(
            spawn{ model = 'sedan', driver = 'manual', lane = pick_lane{ length = 80 }, s = 20 }
            wait(100))",
                                                    0,
                                                    75);
        kernel::Kernel kernel(recording);
        std::vector<KeptTick> ticks;
        while (!kernel.finished()) {
            const bool go = ticks.size() < 80;
            const world::Control control(
                go ? throttle : 0, go && throttle > 0 ? 0 : 1, 0, 1, 0, false, false);
            ticks.emplace_back(kernel.step(std::span(&control, 1)));
        }
        return blockages(ticks);
    };
    EXPECT_THAT(driven(0), testing::IsEmpty());
    EXPECT_THAT(driven(0.5), testing::SizeIs(1));
}

TEST(Blocked, ABranchGoesOnWithTheCount) {
    world::Recording recording = in_town1(behind_it + "wait(100)", 0, 75);
    const std::vector<std::string> whole = blockages(run(recording));
    ASSERT_EQ(whole.size(), 1U);
    world::BranchT branch;
    branch.tick = 600;
    branch.max_ticks = recording.episode.max_ticks;
    branch.name = "other";
    branch.scenario_path = "other.lua";
    branch.scenario =
        "return scenario 'other' { run = function() check.never('blocked') wait(100) end }";
    recording.episode.branches.push_back(branch);
    kernel::Kernel kernel(recording);
    std::vector<KeptTick> ticks;
    while (!kernel.finished())
        ticks.emplace_back(kernel.step());
    EXPECT_EQ(blockages(ticks), whole);
    // The check sees the tick of the event one tick later, as everything a scenario sees, and says
    // in which tick its own event lies.
    const world::CheckResult check = kernel.checks().at(0);
    EXPECT_EQ(check.status, world::CheckResult::Status::fail);
    EXPECT_EQ(std::to_string(check.tick - 1), whole[0].substr(0, whole[0].find(' ')));
    EXPECT_EQ(kernel.outcome().verdict, "failed");
}

TEST(Blocked, VerifyFindsTheSame) {
    const auto path = std::filesystem::temp_directory_path() /
                      ("reprise_blocked_" + std::to_string(getpid()) + ".mcap");
    const world::Recording recording =
        in_town1(behind_it + "check.never('blocked') wait(100)", 0, 75);
    {
        replay::TraceWriter trace(path, recording);
        kernel::Kernel kernel(recording);
        while (!kernel.finished())
            trace.append(kernel.step());
        EXPECT_EQ(kernel.outcome().verdict, "failed");
        trace.close(kernel.outcome());
    }
    replay::TraceReader trace(path);
    EXPECT_EQ(kernel::verify(trace), std::nullopt);
    std::filesystem::remove(path);
}

}  // namespace

}  // namespace reprise::test
