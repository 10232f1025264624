#include <cmath>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scripting/scenario.h"
#include "tests/scripting/stage.h"
#include "world/town.h"

// The scenarios that come with the program, played on a stage of straight roads.
namespace reprise::scripting {

namespace {

std::filesystem::path path_of(const std::string& name) {
    return std::filesystem::path(REPRISE_SCENARIOS) / (name + ".lua");
}

/// A stage with the parameters that the file itself gives.
class Rehearsal {
  public:
    explicit Rehearsal(const std::string& name)
        : episode(load_episode(path_of(name), {})),
          town(test::straight_road(400, 2)),
          lanes(town),
          scenario(episode, town, lanes) {}

    world::EpisodeT episode;
    world::TownT town;
    world::LaneMap lanes;
    Scenario scenario;
};

}  // namespace

using testing::StartsWith;

TEST(Scenarios, AllOfThemLoadAndThoseOfAnyTownStart) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(REPRISE_SCENARIOS)) {
        if (entry.path().extension() != ".lua")
            continue;
        Rehearsal rehearsal(entry.path().stem().string());
        EXPECT_EQ(rehearsal.episode.name, entry.path().stem().string());
        EXPECT_THAT(rehearsal.episode.scenario, StartsWith("-- ")) << "a line that tells the story";
        ++count;
        if (rehearsal.episode.town != "town1")
            continue;  // it asks for what the stage's road has not; its golden starts it
        world::TickDraft next;
        rehearsal.scenario.advance(test::tick_with({}, {}, {}, 0).view(), next);
        EXPECT_FALSE(next.tick.commands.empty());
    }
    EXPECT_GE(count, 3);
}

TEST(Scenarios, FreeDriveLeavesThePlaceToTheKernel) {
    Rehearsal rehearsal("free_drive");
    EXPECT_EQ(rehearsal.episode.cars, 100U);
    world::TickDraft next;
    rehearsal.scenario.advance(test::tick_with({}, {}, {}, 0).view(), next);
    ASSERT_EQ(next.tick.commands.size(), 2U);
    EXPECT_EQ(next.tick.commands[0].lane, world::none);
    EXPECT_EQ(next.tick.commands[1].kind, world::CommandKind::may_overtake);
}

TEST(Scenarios, CutInChangesLanesOnceTheOtherCarIsAhead) {
    Rehearsal rehearsal("cut_in");
    world::SealedTick last = test::tick_with({}, {}, {}, 0);
    double x = 20;
    std::vector<world::CommandT> changes;
    for (std::uint64_t tick = 1; tick < 300 && changes.empty(); ++tick) {
        world::TickDraft next;
        rehearsal.scenario.advance(last.view(), next);
        for (const world::CommandT& command : next.tick.commands)
            if (command.kind == world::CommandKind::change_lane)
                changes.push_back(command);
        x += 15.28 * 0.05;
        const double ego = 8 + 12.5 * 0.05 * static_cast<double>(tick);
        last = test::tick_with({test::vehicle_at(1, ego, -5.25, 0, 12.5)},
                               {test::car_at(2, x, -1.75, 0, 15.28)},
                               {},
                               tick);
    }
    ASSERT_EQ(changes.size(), 1U);
    EXPECT_EQ(changes[0].actor, 2U);
    EXPECT_EQ(changes[0].duration, 2.5);
}

TEST(Scenarios, ChildRunsOnceTheCarIsNear) {
    Rehearsal rehearsal("child_runs_out");
    world::SealedTick last = test::tick_with({}, {}, {}, 0);
    const world::LaneT* lane = nullptr;
    world::Vec3 child(0, 0, 0);
    double s = 6;
    for (std::uint64_t tick = 1; tick < 200; ++tick) {
        world::TickDraft next;
        rehearsal.scenario.advance(last.view(), next);
        for (const world::CommandT& command : next.tick.commands) {
            if (command.kind == world::CommandKind::spawn) {
                lane = &rehearsal.town.lanes.at(command.lane);
                const world::LanePoint at = world::point_at(*lane, command.s);
                const double side = std::cos(at.yaw);
                if (command.driver == world::Driver::walker)
                    child =
                        world::Vec3(at.position.x(), at.position.y() + side * command.offset, 0);
            }
            if (command.kind == world::CommandKind::walk) {
                EXPECT_NEAR(s + 3.7 + 24, 63.2, 1.0);
                EXPECT_GT(std::abs(command.target.y() - child.y()), 14);  // four lanes
                EXPECT_EQ(command.speed, 2.5);
                return;
            }
        }
        ASSERT_NE(lane, nullptr);
        s += 0.5;
        const world::LanePoint at = world::point_at(*lane, s);
        world::TickDraft draft;
        draft.tick.index = tick;
        draft.tick.vehicles.push_back(
            test::vehicle_at(3, at.position.x(), at.position.y(), at.yaw, 10));
        draft.traffic.walkers.emplace_back(
            child, 0.0F, 0.0F, 0.0F, 2U, std::uint16_t{1}, false, std::uint8_t{0}, 0U);
        last = world::seal(draft, {});
    }
    FAIL() << "the child never ran";
}

}  // namespace reprise::scripting
