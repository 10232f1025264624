// Whole runs on straight roads of several lanes: nobody changes lanes unasked.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/kernel/whole_run.h"
#include "world/check.h"

namespace reprise::test {

using testing::ElementsAre;

namespace {

/// The lanes that actor 1 was on, one after another.
std::vector<std::string> lanes_of(const std::string& body, double seconds) {
    const world::Recording recording = on_straight_lanes(body, seconds);
    std::vector<std::string> lanes;
    for (const KeptTick& tick : run(recording)) {
        const world::TickView view = tick.recorded().view;
        std::uint32_t lane = world::none;
        if (const auto* measured = world::find(view.measurements(), 1))
            lane = measured->lane();
        else if (const auto* car = world::find(view.cars(), 1))
            lane = car->lane();
        if (lane == world::none || recording.town.lanes[lane].kind != world::LaneKind::driving)
            continue;
        const std::string& name = recording.town.lanes[lane].name;
        if (lanes.empty() || lanes.back() != name)
            lanes.push_back(name);
    }
    return lanes;
}

std::string spawn_on(const std::string& lane, double kmh, const std::string& more = "") {
    return fmt::format(
        "local ego = spawn{{ model = 'sedan', lane = '{}', s = 100, speed_kmh = {}{} }}\n",
        lane,
        kmh,
        more);
}

}  // namespace

TEST(LaneKeeping, WhoIsRoutedAlongItsOwnLaneStaysOnIt) {
    for (const double kmh : {0, 40, 50, 130})
        EXPECT_THAT(
            lanes_of(spawn_on("main_1", kmh) + "ego:route_to{ lane = 'main_1' } wait(100)", 12),
            ElementsAre("main_1"))
            << kmh << " km/h";
}

TEST(LaneKeeping, WithoutARouteALaneIsLeftOnlyBeforeItsEnd) {
    for (const char* lane : {"main_0", "main_1", "hill_0"})
        EXPECT_THAT(lanes_of(spawn_on(lane, 50) + "wait(100)", 7), ElementsAre(lane));
    const auto main_1 = lanes_of(spawn_on("main_1", 100) + "wait(100)", 90);
    EXPECT_THAT(std::vector(main_1.begin(), main_1.begin() + 3),
                ElementsAre("main_1", "main_2", "main_back_2"))
        << "the lane ends in nothing: it must";
}

TEST(LaneKeeping, AChangeThatIsAskedForIsTheFirstOne) {
    EXPECT_THAT(lanes_of(spawn_on("main_1", 50) + "wait(1) ego:change_lane 'right' wait(100)", 9),
                ElementsAre("main_1", "main_0"));
    EXPECT_THAT(lanes_of(spawn_on("main_1", 90) + "wait(1) ego:change_lane 'left' wait(100)", 9),
                ElementsAre("main_1", "main_2"));
}

TEST(LaneKeeping, WhoMayNotChangeLanesStopsWhereItsLaneEnds) {
    for (const char* body : {"wait(100)", "ego:keep_lane() wait(100)"}) {
        const std::string spawn = spawn_on(
            "main_1", 100, std::string(body) == "wait(100)" ? ", lane_changes = false" : "");
        EXPECT_THAT(lanes_of(spawn + body, 95), ElementsAre("main_1"));
    }
}

TEST(LaneKeeping, EndsWhenItIsLifted) {
    EXPECT_THAT(lanes_of(spawn_on("hill_0", 100, ", lane_changes = false") +
                             "wait(2) ego:keep_lane(false) wait(100)",
                         25),
                testing::Contains("hill_1"));
}

TEST(LaneKeeping, AnOrderedChangeIsStillMade) {
    EXPECT_THAT(lanes_of(spawn_on("main_1", 100, ", lane_changes = false") +
                             "wait(1) ego:change_lane 'right' wait(100)",
                         60),
                ElementsAre("main_1", "main_0"));
}

TEST(LaneKeeping, ARouteThatNeedsAnotherLaneIsAMistake) {
    const auto mistake = [](const std::string& body) -> std::string {
        try {
            lanes_of(body, 5);
        } catch (const world::Error& error) {
            return error.what();
        }
        return "none";
    };
    EXPECT_EQ(mistake(spawn_on("main_1", 50, ", lane_changes = false") +
                      "ego:route_to{ lane = 'main_2' } wait(100)"),
              "test.lua:4: route_to: no way leads from 'main_1' to 'main_2' without a change of "
              "lanes");
    EXPECT_EQ(mistake(spawn_on("main_1", 50) +
                      "ego:route_to{ lane = 'main_2' }\nego:keep_lane() wait(100)"),
              "test.lua:5: route: no way leads from lane 'main_1' to lane 'main_2' without a "
              "change of lanes");
}

TEST(LaneKeeping, OfTrafficsCarsLikewise) {
    const std::string traffic = ", driver = 'traffic'";
    EXPECT_THAT(lanes_of(spawn_on("hill_0", 60, traffic) + "wait(200)", 40),
                testing::Contains("hill_1"))
        << "else it must, for its way on";
    EXPECT_THAT(
        lanes_of(spawn_on("hill_0", 60, traffic + ", lane_changes = false") + "wait(200)", 40),
        ElementsAre("hill_0"));
}

}  // namespace reprise::test
