// Whole runs: what scenarios say of a drive (red lights, roads left, routes driven) and of
// junctions and crossings, held against the ticks and the town themselves.
#include <algorithm>
#include <map>
#include <set>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ground/mesh/ground.h"
#include "tests/kernel/whole_run.h"
#include "tests/support/towns.h"
#include "world/lanes/junctions.h"
#include "world/lanes/stop_lines.h"
#include "world/models/catalogue.h"

namespace reprise::test {

using testing::ElementsAre;

namespace {

std::vector<std::string> lines_of(const std::vector<KeptTick>& ticks) {
    std::vector<std::string> lines;
    for (const KeptTick& tick : ticks)
        for (const world::Event* event : *tick.recorded().view.tick->events())
            if (event->kind() == world::EventKind::printed)
                lines.push_back(event->text()->str());
    return lines;
}

/// Who drives over the end of a lane all of whose lights are red, as the measurements have it: the
/// bumper's place along the lane, from tick to tick.
std::set<std::uint32_t> runners(const world::TownT& town, const std::vector<KeptTick>& ticks) {
    std::set<std::uint32_t> found;
    std::map<std::uint32_t, std::pair<std::uint32_t, double>> before;  // lane, bumper
    for (const KeptTick& tick : ticks) {
        const world::TickView view = tick.recorded().view;
        for (const world::Measurement& measured : view.measurements()) {
            const auto* vehicle = world::find(view.vehicles(), measured.actor());
            const world::VehicleModel& model = world::vehicle_models()[vehicle->model()];
            const double bumper = measured.lane_s() + model.length - model.rear_overhang;
            const auto [lane, last] = before.count(measured.actor()) != 0
                                          ? before[measured.actor()]
                                          : std::pair(world::none, 0.0);
            before[measured.actor()] = {measured.lane(), bumper};
            if (lane == world::none || measured.lane() != lane || town.lanes[lane].links.empty())
                continue;
            const double line = town.lanes[lane].length + world::StopLines::slack;
            const bool all_red =
                std::all_of(town.lanes[lane].links.begin(),
                            town.lanes[lane].links.end(),
                            [&](const world::Link& link) {
                                return link.signal() != world::none &&
                                       world::is_red(view.signals()[link.signal()]);
                            });
            if (last <= line && bumper > line && all_red)
                found.insert(measured.actor());
        }
    }
    return found;
}

}  // namespace

TEST(RanRed, IsWhatTheTicksShow) {
    // Cars that do not stop, one on each lane into four lit junctions, every 8 s.
    const world::Recording recording = in_town1(R"(
        local cars = {}
        for _ = 1, 4 do
            local junction = pick_junction{ lit = true }
            for _, arm in ipairs(junction.arms) do
                for _, lane in ipairs(arm.incoming) do
                    local ok, car = pcall(spawn, { model = 'sedan', driver = 'manual', lane = lane,
                                                   s = lane_length(lane) - 25, speed = 10 })
                    if ok then
                        cars[#cars + 1] = car
                        start(function() while true do car:control{ throttle = 0.2 } wait_ticks(1) end end)
                    end
                end
            end
            wait(4)
        end
        wait(2)
        for _, car in ipairs(cars) do if car:ran_red() then print(car:id()) end end)",
                                                0,
                                                60);
    const auto ticks = run(recording);
    const auto expected = runners(recording.town, ticks);
    std::set<std::uint32_t> said;
    for (const std::string& line : lines_of(ticks))
        said.insert(static_cast<std::uint32_t>(std::stoul(line)));
    EXPECT_GE(expected.size(), 4U);
    EXPECT_EQ(said, expected);
}

TEST(RanRed, NobodyDoesWhoObeysLights) {
    const auto ticks = run(in_town1(R"(
        local cars = {}
        for i = 1, 20 do
            cars[i] = spawn{ model = 'sedan', driver = i % 2 == 0 and 'traffic' or 'autopilot' }
        end
        wait(90)
        for _, car in ipairs(cars) do
            if car:ran_red() then print(car:name(), 'ran red') end
        end)",
                                    40,
                                    100));
    EXPECT_THAT(lines_of(ticks), ElementsAre());
}

TEST(RanRed, IsDrivenNotTeleported) {
    const auto lines = lines_of(run(in_town("junctions",
                                            R"(
        local lane = pick_junction{ lit = true, arms = 4 }.arms[1].incoming[1]
        local before, behind = lane_length(lane) - 4.5, lane_length(lane) - 3  -- the bumper is 3.7 m ahead
        local car = spawn{ model = 'sedan', driver = 'manual', lane = lane, s = before }
        set_signal(lane, 'red')
        wait(1)
        car:teleport{ lane = lane, s = behind }
        wait(1)
        print(car:ran_red())
        car:teleport{ lane = lane, s = before }
        wait(1)
        car:control{ throttle = 0.5 }
        wait_until(function() return car:s() > behind end, { timeout = 5 })
        wait_ticks(2)
        print(car:ran_red()))",
                                            20)));
    EXPECT_THAT(lines, ElementsAre("false", "true"));
}

TEST(LeftRoad, IsWhereAWheelLeavesIt) {
    const auto lines = lines_of(run(on_straight_lanes(R"(
        local car = spawn{ model = 'sedan', driver = 'manual', lane = 'main_0', s = 100, speed = 10 }
        wait_ticks(1)
        print(car:left_road())
        start(function() while true do car:control{ throttle = 0.3, steer = -0.1 } wait_ticks(1) end end)
        wait_until(function() return car:left_road() end, { timeout = 8 })
        local _, wheels = car:left_road()
        print(wheels == 1)
        print(wait_until(function() return select(2, car:left_road()) >= 2 end, { timeout = 8 })))",
                                                      20)));
    EXPECT_THAT(lines, ElementsAre("false 0", "true", "true"));
    // The numbers that the words know.
    EXPECT_EQ(static_cast<int>(ground::Surface::road), 1);
    EXPECT_EQ(static_cast<int>(ground::Surface::crossing), 2);
    EXPECT_EQ(static_cast<int>(ground::Surface::marking), 5);
    EXPECT_EQ(static_cast<int>(ground::Surface::deck), 6);
}

TEST(OnOppositeLane, IsWhereItsOutlineReaches) {
    const auto lines = lines_of(run(in_town1(R"(
        local lane = pick_lane{ length = 60, lanes = 1, straight = true }
        local car = spawn{ model = 'sedan', driver = 'manual', lane = lane, s = 10, speed = 8 }
        wait_ticks(1)
        print(car:on_opposite_lane())
        start(function() while true do car:control{ throttle = 0.2, steer = 0.1 } wait_ticks(1) end end)
        wait_until(function() return car:on_opposite_lane() end, { timeout = 5 })
        local is, share = car:on_opposite_lane()
        print(is, share > 0 and share < 0.5))",
                                             0,
                                             20)));
    EXPECT_THAT(lines, ElementsAre("false 0.0", "true true"));
}

TEST(RouteCompletionWord, GrowsToOneAsTheAutopilotDrives) {
    const auto lines = lines_of(run(in_town1(R"(
        local ego = spawn{ model = 'sedan' }
        wait_ticks(1)
        local goal = pick_lane{ length = 60 }
        ego:route_to{ lane = goal, s = 30 }
        local last = ego:route_completion()
        check.never('back', function()
            local now = ego:route_completion()
            local back = now < last
            last = now
            return back
        end)
        print(last < 0.01)
        print(wait_until(function() return ego:route_completion() == 1 end, { timeout = 150 }))
        print(ego:lane() == goal, ego:s() > 24 and ego:s() < 28))",
                                             20,
                                             160)));
    EXPECT_THAT(lines, ElementsAre("true", "true", "true true"))
        << "30 m less the 3.70 m of its bumper";
}

TEST(Arms, HoldEveryLaneIntoAJunctionOnce) {
    for (const char* name : {"town1", "town2", "junctions"}) {
        const world::TownT& town = own_town(name).town;
        const auto arms = world::arms_of_junctions(town);
        std::vector<int> seen(town.lanes.size(), 0);
        std::size_t with_three = 0;
        for (std::uint32_t junction = 0; junction < arms.size(); ++junction) {
            with_three += arms[junction].size() >= 3 ? 1 : 0;
            for (const world::JunctionArm& arm : arms[junction]) {
                for (const std::uint32_t lane : arm.incoming) {
                    EXPECT_EQ(town.lanes[lane].junction, junction);
                    ++seen[lane];
                }
                for (const std::uint32_t lane : arm.outgoing)
                    EXPECT_EQ(town.lanes[lane].kind, world::LaneKind::driving);
                if (arm.incoming.empty() || arm.outgoing.empty())
                    continue;
                // Both directions of a street: the leftmost lanes run against each other.
                const double in = world::point_at(town.lanes[arm.incoming.back()], 1e9).yaw;
                const double out = world::point_at(town.lanes[arm.outgoing.back()], 0).yaw;
                EXPECT_LT(std::cos(in - out), -0.8) << town.junctions[junction].name;
            }
        }
        for (std::uint32_t lane = 0; lane < town.lanes.size(); ++lane)
            EXPECT_EQ(seen[lane],
                      town.lanes[lane].kind == world::LaneKind::driving &&
                              town.lanes[lane].junction != world::none
                          ? 1
                          : 0)
                << name << ' ' << town.lanes[lane].name;
        EXPECT_GE(with_three, 5U) << name;
    }
}

TEST(Crossings, AreCrossedByTheLanesThatTheyName) {
    for (const char* name : {"town1", "town2", "junctions"}) {
        const world::TownT& town = own_town(name).town;
        const world::LaneMap lanes(town);
        std::size_t lit = 0;
        const auto crossings = world::crossings_of(town, lanes);
        for (const world::CrossingPlace& crossing : crossings) {
            const world::LaneT& zebra = town.lanes[crossing.lane];
            EXPECT_FALSE(crossing.incoming.empty() && crossing.outgoing.empty())
                << name << ' ' << zebra.name;
            lit += crossing.lit ? 1 : 0;
            // Its length is that of the lanes that it crosses, and what lies between them.
            double width = 0;
            for (const auto* side : {&crossing.incoming, &crossing.outgoing})
                for (const std::uint32_t lane : *side)
                    width += town.lanes[lane].width;
            EXPECT_LE(width, zebra.length * 1.2 + 1) << name << ' ' << zebra.name;
            EXPECT_GE(width, zebra.length * 0.4) << name << ' ' << zebra.name;
        }
        EXPECT_GE(crossings.size(), 4U) << name;
        EXPECT_GE(lit, 2U) << name;
    }
}

TEST(PickJunction, IsChosenByTheSeedAndFits) {
    const auto lines = lines_of(run(in_town1(R"(
        for _ = 1, 6 do
            local four = pick_junction{ arms = 4, lit = true, optional = true }
            if four then assert(#four.arms == 4 and four.lit) end
            local three = pick_junction{ arms = 3, lit = false }
            assert(#three.arms == 3 and not three.lit)
            local stop = pick_junction{ stop = true }
            assert(stop.stop)
            local zebra = pick_crossing{ lit = true }
            assert(zebra.lit and #zebra.incoming > 0)
            for _, lane in ipairs(zebra.incoming) do assert(lane_junction(lane) == zebra.junction) end
            print(three.name, zebra.name)
        end)",
                                             0,
                                             1)));
    EXPECT_EQ(lines.size(), 6U);
    EXPECT_GT(std::set<std::string>(lines.begin(), lines.end()).size(), 3U);
}

}  // namespace reprise::test
