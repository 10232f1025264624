#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <numbers>
#include <optional>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "towns/town_reader.h"
#include "world/check.h"
#include "world/lanes/planner.h"
#include "world/random.h"

// Chooses the start and goal pairs of a town's tasks: make_tasks NAME.net.xml TASKS.json
// 25 pairs for each of three tasks, whose mean lengths are those of Dosovitskiy et al., "CARLA: An
// Open Urban Driving Simulator", CoRL 2017. Pairs are drawn from a fixed seed; a pair is taken when
// it belongs to the task and pulls the mean of those taken so far towards the wanted one. The same
// network gives the same file.
namespace reprise {
namespace {

using nlohmann::ordered_json;
using world::LaneKind;
using world::LanePlace;
using world::Route;
using world::RouteCommand;
using world::TownT;

constexpr std::uint64_t seed = 2017;
constexpr std::size_t pairs_a_task = 25;
constexpr double clear_start = 8;    // [m] of a lane's start: the car's rear is on the lane as well
constexpr double clear_end = 14;     // [m] of a lane's end: no start at a stop line
constexpr double straight_on = 0.5;  // [rad] a straight task ends in this direction, and lies in it
constexpr int most_uses = 2;         // of one lane as a start, or as a goal, in a task

struct Task {
    const char* name;
    double town1_length, town2_length;  ///< [m] wanted mean
};

constexpr Task tasks[] = {{"straight", 200, 100}, {"one_turn", 400, 170}, {"navigation", 770, 360}};

std::size_t turns(const Route& route) {
    return static_cast<std::size_t>(
        std::count_if(route.steps.begin(), route.steps.end(), [](const Route::Step& step) {
            return step.command == RouteCommand::left || step.command == RouteCommand::right;
        }));
}

double angle_between(double one, double other) {
    return std::abs(std::remainder(one - other, 2 * std::numbers::pi));
}

/// The goal lies ahead, and the way there ends in the direction that it began in.
bool leads_straight_on(const TownT& town, LanePlace from, LanePlace to) {
    const world::LanePoint start = world::point_at(town.lanes[from.lane], from.s);
    const world::LanePoint goal = world::point_at(town.lanes[to.lane], to.s);
    const Eigen::Vector3d way = goal.position - start.position;
    return angle_between(start.yaw, goal.yaw) < straight_on &&
           angle_between(start.yaw, std::atan2(way.y(), way.x())) < straight_on;
}

bool belongs_to(
    const std::string& task, const TownT& town, LanePlace from, LanePlace to, const Route& route) {
    if (task == "straight")
        return turns(route) == 0 && leads_straight_on(town, from, to);
    return task == "one_turn" ? turns(route) == 1 : turns(route) >= 2;
}

/// A place where a car may start or arrive.
std::optional<LanePlace> draw_place(const TownT& town, std::uint64_t round, std::uint64_t item) {
    const auto lane = static_cast<std::uint32_t>(
        world::draw_index(town.lanes.size(), seed, round, world::Purpose::scenario, item));
    const double room = town.lanes[lane].length - clear_start - clear_end;
    if (town.lanes[lane].kind != LaneKind::driving || room < 0)
        return std::nullopt;
    const double s =
        clear_start + room * world::draw(seed, round, world::Purpose::scenario, item + 1);
    return LanePlace{lane, std::floor(s * 10) / 10};
}

double rounded(double value) {
    return std::nearbyint(value * 1000) / 1000;
}

ordered_json place_json(const TownT& town, LanePlace place) {
    const world::LanePoint at = world::point_at(town.lanes[place.lane], place.s);
    return {{"lane", town.lanes[place.lane].name},
            {"s", place.s},
            {"x", rounded(at.position.x())},
            {"y", rounded(at.position.y())},
            {"yaw", rounded(at.yaw)}};
}

ordered_json pair_json(const TownT& town, LanePlace from, LanePlace to, const Route& route) {
    ordered_json commands = ordered_json::array();
    for (const Route::Step& step : route.steps)
        if (step.command != RouteCommand::follow_lane && step.command != RouteCommand::reach_goal)
            commands.push_back(world::name_of(step.command));
    return {{"start", place_json(town, from)},
            {"goal", place_json(town, to)},
            {"length", rounded(route.length)},
            {"commands", commands}};
}

ordered_json choose_pairs(const TownT& town, const Task& task, double wanted) {
    const world::Planner planner(town);
    ordered_json pairs = ordered_json::array();
    std::multiset<std::uint32_t> starts, goals;
    double sum = 0;
    for (std::uint64_t round = 0; pairs.size() < pairs_a_task; ++round) {
        REPRISE_CHECK(round < 2'000'000, task.name);
        const auto from = draw_place(town, round, 0);
        const auto to = draw_place(town, round, 2);
        if (!from || !to || starts.count(from->lane) >= most_uses ||
            goals.count(to->lane) >= most_uses)
            continue;
        const auto route = planner.plan(*from, *to);
        const double mean = pairs.empty() ? wanted : sum / static_cast<double>(pairs.size());
        if (!route || !belongs_to(task.name, town, *from, *to, *route) ||
            (route->length < wanted) == (mean < wanted) || route->length < wanted / 2)
            continue;
        pairs.push_back(pair_json(town, *from, *to, *route));
        sum += route->length;
        starts.insert(from->lane);
        goals.insert(to->lane);
    }
    std::cerr << town.name << " " << task.name << ": mean "
              << sum / static_cast<double>(pairs.size()) << " m\n";
    return pairs;
}

/// A pair a line: that is how differences are read.
std::string tasks_json(const TownT& town) {
    std::string all = "{\n\"town\": " + ordered_json(town.name).dump() + ",\n\"tasks\": {\n";
    for (const Task& task : tasks) {
        const double wanted = town.name == "town1" ? task.town1_length : task.town2_length;
        all += (&task == tasks ? "\"" : ",\n\"") + std::string(task.name) + "\": [\n";
        const char* separator = "";
        for (const ordered_json& pair : choose_pairs(town, task, wanted)) {
            all += separator + pair.dump();
            separator = ",\n";
        }
        all += "\n]";
    }
    return all + "\n}\n}\n";
}

void make_tasks(const char* network, const char* file) {
    const std::string all = tasks_json(towns::read_town(towns::load_network(network)));
    std::ofstream out(file);
    out << all << std::flush;
    if (!out)
        throw world::Error(std::string(file) + ": cannot be written");
}

}  // namespace
}  // namespace reprise

int main(int count, char** words) {
    if (count != 3) {
        std::cerr << "make_tasks NAME.net.xml TASKS.json\n";
        return 2;
    }
    try {
        reprise::make_tasks(words[1], words[2]);
    } catch (const std::exception& error) {
        std::cerr << error.what() << "\n";
        return 2;
    }
}
