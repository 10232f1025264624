#include <cmath>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/towns.h"
#include "world/lanes/planner.h"

// The pairs in scenarios/towns/NAME/tasks.json are what their names say.
namespace reprise::world {
namespace {

using nlohmann::json;

/// [m] Dosovitskiy et al., "CARLA: An Open Urban Driving Simulator", CoRL 2017, section 4.
struct Paper {
    const char* town;
    double straight, one_turn, navigation;
};

std::ostream& operator<<(std::ostream& out, const Paper& paper) {
    return out << paper.town;
}

class Tasks : public ::testing::TestWithParam<Paper> {
  protected:
    Tasks() : town_(test::own_town(GetParam().town).town) {
        const std::string name = GetParam().town;
        std::ifstream file(std::string(REPRISE_SOURCE_DIR) + "/scenarios/towns/" + name +
                           "/tasks.json");
        tasks_ = json::parse(file).at("tasks");
    }

    LanePlace place(const json& place) const {
        return {test::lane(town_, place.at("lane").get<std::string>()), place.at("s")};
    }

    Route route(const json& pair) const {
        const auto route = Planner(town_).plan(place(pair.at("start")), place(pair.at("goal")));
        EXPECT_TRUE(route) << pair;
        return route.value_or(Route{});
    }

    const TownT& town_;
    json tasks_;
};

INSTANTIATE_TEST_SUITE_P(Towns,
                         Tasks,
                         ::testing::Values(Paper{"town1", 200, 400, 770},
                                           Paper{"town2", 100, 170, 360}),
                         [](const auto& town) { return std::string(town.param.town); });

TEST_P(Tasks, HaveThePapersMeanLengths) {
    for (const auto& [task, wanted] : {std::pair("straight", GetParam().straight),
                                       std::pair("one_turn", GetParam().one_turn),
                                       std::pair("navigation", GetParam().navigation)}) {
        double sum = 0;
        for (const json& pair : tasks_.at(task)) {
            const double length = route(pair).length;
            EXPECT_NEAR(length, pair.at("length").get<double>(), 1e-3) << pair;
            sum += length;
        }
        ASSERT_GE(tasks_.at(task).size(), 25U);
        EXPECT_NEAR(sum / static_cast<double>(tasks_.at(task).size()), wanted, wanted / 10);
    }
}

TEST_P(Tasks, TurnAsOftenAsTheirNamesSay) {
    for (const auto& [task, pairs] : tasks_.items())
        for (const json& pair : pairs) {
            int turns = 0;
            json commands = json::array();
            for (const Route::Step& step : route(pair).steps) {
                turns += step.command == RouteCommand::left || step.command == RouteCommand::right;
                if (step.command != RouteCommand::follow_lane &&
                    step.command != RouteCommand::reach_goal)
                    commands.push_back(name_of(step.command));
            }
            EXPECT_EQ(commands, pair.at("commands")) << pair;
            EXPECT_TRUE(task == "straight"   ? turns == 0
                        : task == "one_turn" ? turns == 1
                                             : turns >= 2)
                << task << ": " << pair;
        }
}

TEST_P(Tasks, StartAndEndWhereTheyAreDrawn) {
    for (const auto& [task, pairs] : tasks_.items())
        for (const json& pair : pairs)
            for (const char* end : {"start", "goal"}) {
                const LanePlace there = place(pair.at(end));
                const LaneT& lane = town_.lanes[there.lane];
                EXPECT_EQ(lane.kind, LaneKind::driving);
                EXPECT_GE(there.s, 8) << "the rear is on the lane";
                EXPECT_LE(there.s, lane.length - 14) << "clear of the stop line";
                const LanePoint at = point_at(lane, there.s);
                EXPECT_NEAR(at.position.x(), pair.at(end).at("x").get<double>(), 1e-3);
                EXPECT_NEAR(at.position.y(), pair.at(end).at("y").get<double>(), 1e-3);
                EXPECT_NEAR(at.yaw, pair.at(end).at("yaw").get<double>(), 1e-3);
            }
}

}  // namespace
}  // namespace reprise::world
