#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/town/towns.h"
#include "drivers/control/wide_turn.h"
#include "kernel/kernel.h"
#include "scripting/scenario.h"
#include "towns/town_reader.h"
#include "world/check.h"
#include "world/digest.h"
#include "world/frames.h"
#include "world/lanes/planner.h"
#include "world/models/catalogue.h"
#include "world/random.h"
#include "world/recording.h"

// Drives routes through an empty town with the built-in driver, and watches it:
//     drive_routes TOWN TASKS.json [--every N]     every pair of every task, or every N-th
//     drive_routes TOWN COUNT [--seed N]           as many random ways
// With --sample N one in N of these, unless REPRISE_THOROUGH is set.
// One line for each route that goes wrong, a table, exit status 1 when any did.
namespace reprise {
namespace {

using world::LanePlace;
using world::TownT;

constexpr double most_off = 0.3;     // share of the footprint on the sidewalk, or on the other side
constexpr double most_across = 0.6;  // on the other side, of a long vehicle in a tight bend
constexpr double most_height = 0.5;  // [m] between the car and its lane
constexpr double most_aside = 3;     // [m] from the lane's nearest point, to compare heights

struct Pair {
    std::string task;
    LanePlace from, to;
};

/// What went wrong on one way.
struct Watch {
    double length = 0;
    double seconds = 0;
    double sidewalk = 0;  ///< greatest share
    double opposite = 0;  ///< greatest share
    double height = 0;    ///< [m] greatest distance
    double impulse = 0;   ///< [N s] on what stands
    double most_opposite = most_off;
    bool arrived = false;
    std::string where;  ///< where the first limit was passed, or where it stood in the end
};

/// Every step-th pair of the tasks.
std::vector<Pair> pairs_of(const TownT& town, const std::string& file, std::size_t step) {
    std::vector<Pair> pairs;
    std::size_t next = 0;
    const auto place = [&](const nlohmann::json& json) {
        const std::string name = json.at("lane");
        const auto lane = world::find_lane(town, name);
        if (!lane)
            throw world::Error(file + ": no lane '" + name + "' in " + town.name);
        return LanePlace{*lane, json.at("s")};
    };
    std::ifstream in(file);
    if (!in)
        throw world::Error(file + ": cannot be read");
    const nlohmann::json all = nlohmann::json::parse(in);
    for (const auto& [task, list] : all.at("tasks").items())
        for (const nlohmann::json& pair : list)
            if (next++ % step == 0)
                pairs.push_back({task, place(pair.at("start")), place(pair.at("goal"))});
    return pairs;
}

/// Places 8 m and more from the ends of lanes that hold a car.
std::vector<Pair> random_pairs(const TownT& town, int count, std::uint64_t seed) {
    constexpr double margin = 8;     // [m]
    constexpr double shortest = 80;  // [m]
    const world::Planner planner(town);
    std::vector<Pair> pairs;
    const auto place = [&](std::uint64_t round, std::uint64_t item) -> LanePlace {
        const auto lane = static_cast<std::uint32_t>(
            world::draw_index(town.lanes.size(), seed, round, world::Purpose::scenario, item));
        const double room = town.lanes[lane].length - 2 * margin;
        if (town.lanes[lane].kind != world::LaneKind::driving || room < 1)
            return {world::none, 0};
        return {lane, margin + room * world::draw(seed, round, world::Purpose::scenario, item + 1)};
    };
    for (std::uint64_t round = 0;
         pairs.size() < static_cast<std::size_t>(count) && round < 1'000'000;
         ++round) {
        const LanePlace from = place(round, 0);
        const LanePlace to = place(round, 2);
        if (from.lane == world::none || to.lane == world::none)
            continue;
        const auto route = planner.plan(from, to);
        if (route && route->length > shortest)
            pairs.push_back({"random", from, to});
    }
    return pairs;
}

/// One in so many.
std::vector<Pair> sample_of(const std::vector<Pair>& pairs, std::size_t step) {
    std::vector<Pair> some;
    for (std::size_t i = 0; i < pairs.size(); i += step)
        some.push_back(pairs[i]);
    return some;
}

world::Recording recording_of(const towns::Network& network,
                              const TownT& town,
                              const Pair& pair,
                              const std::string& model) {
    const auto number = [](double value) { return fmt::format("{}", value); };
    world::Recording recording;
    recording.episode =
        scripting::load_episode(std::string(REPRISE_SOURCE) + "/scenarios/drive_route.lua",
                                {{},
                                 {},
                                 {},
                                 {{"model", model},
                                  {"start", town.lanes[pair.from.lane].name},
                                  {"s", number(pair.from.s)},
                                  {"goal", town.lanes[pair.to.lane].name},
                                  {"goal_s", number(pair.to.s)}}});
    recording.town = town;
    recording.network = network.xml;
    recording.episode.town_digest = world::digest128(recording.network);
    return recording;
}

/// Where a car turns around, all lanes of the street are its own for a moment.
bool may_turn_around(const TownT& town, std::uint32_t lane, double s) {
    constexpr double around = 20;  // [m]
    const world::LaneT& here = town.lanes[lane];
    const bool inside = here.kind == world::LaneKind::internal;
    const auto turns_here = [&](const world::LaneT& from) {
        return std::any_of(from.links.begin(), from.links.end(), [&](const world::Link& link) {
            return link.turn() == world::Turn::around &&
                   (inside ? &from == &here || link.via() == lane
                           : (from.edge == here.edge && s > here.length - around) ||
                                 (town.lanes[link.to()].edge == here.edge && s < around));
        });
    };
    return std::any_of(town.lanes.begin(), town.lanes.end(), turns_here);
}

bool keeps_to_the_road(const Watch& watch) {
    return watch.sidewalk <= most_off && watch.opposite <= watch.most_opposite &&
           watch.height <= most_height && watch.impulse <= 0;
}

void look(const TownT& town, const world::Tick& tick, Watch& watch) {
    if (tick.vehicles()->size() == 0)
        return;
    const world::VehicleState& ego = *tick.vehicles()->Get(0);
    const world::Measurement& measured = *tick.measurements()->Get(0);
    double height = 0;
    std::string lane = "no lane";
    if (measured.lane() != world::none) {
        const world::LaneT& under = town.lanes[measured.lane()];
        lane = fmt::format("{} {:.0f}", under.name, measured.lane_s());
        const Eigen::Vector3d off =
            world::to_eigen(ego.position()) - world::point_at(under, measured.lane_s()).position;
        // Who turns around may be on a lane that begins metres ahead, up or down the slope.
        if (off.head<2>().norm() < most_aside)
            height = std::abs(off.z());
    }
    const bool fine = keeps_to_the_road(watch);
    watch.sidewalk = std::max(watch.sidewalk, measured.on_sidewalk());
    if (measured.on_opposite_lane() > watch.opposite &&
        (measured.lane() == world::none ||
         !may_turn_around(town, measured.lane(), measured.lane_s())))
        watch.opposite = std::max(watch.opposite, measured.on_opposite_lane());
    watch.height = std::max(watch.height, height);
    watch.impulse = measured.impulse_static();
    if (fine)
        watch.where = lane;
}

Watch drive(const towns::Network& network,
            const TownT& town,
            const Pair& pair,
            const std::string& model) {
    Watch watch;
    watch.length = world::Planner(town).plan(pair.from, pair.to)->length;
    const auto index = world::find_vehicle_model(model);
    if (index && drivers::WideTurnPlan::is_needed(world::vehicle_models()[*index]))
        watch.most_opposite = most_across;
    const world::Recording recording = recording_of(network, town, pair, model);
    kernel::Kernel kernel(recording);
    std::uint64_t ticks = 0;
    while (!kernel.finished()) {
        const world::SealedTick& tick = kernel.step();
        look(town, *tick.view().tick, watch);
        ++ticks;
    }
    watch.seconds = static_cast<double>(ticks) * 0.05;
    watch.arrived = kernel.outcome().reason == "arrived";
    return watch;
}

bool is_fine(const Watch& watch) {
    return watch.arrived && keeps_to_the_road(watch);
}

/// Worst of all ways of a task.
void print_row(const std::string& task, const std::vector<Watch>& ways) {
    const auto most = [&](double Watch::*value) {
        double greatest = 0;
        for (const Watch& watch : ways)
            greatest = std::max(greatest, watch.*value);
        return greatest;
    };
    double length = 0;
    double seconds = 0;
    for (const Watch& watch : ways) {
        length += watch.length;
        seconds += watch.seconds;
    }
    fmt::print("{:<12} {:>5} {:>5} {:>8.1f} {:>8.1f} {:>9.2f} {:>9.2f} {:>7.2f}\n",
               task,
               ways.size(),
               std::count_if(ways.begin(), ways.end(), is_fine),
               length / static_cast<double>(ways.size()),
               length / seconds * 3.6,
               most(&Watch::sidewalk),
               most(&Watch::opposite),
               most(&Watch::height));
}

bool drive_all(const towns::Network& network,
               const TownT& town,
               const std::vector<Pair>& pairs,
               const std::string& model) {
    bool fine = true;
    std::vector<Watch> ways;
    fmt::print("{:<12} ways  fine   mean m     km/h  sidewalk  opposite height m\n", town.name);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const Pair& pair = pairs[i];
        ways.push_back(drive(network, town, pair, model));
        const Watch& watch = ways.back();
        if (!is_fine(watch)) {
            fine = false;
            fmt::print(
                "  --set start={} --set s={} --set goal={} --set goal_s={}: {}, sidewalk "
                "{:.2f}, opposite {:.2f}, height {:.2f} m, hit {:.0f} N s, at {}\n",
                town.lanes[pair.from.lane].name,
                pair.from.s,
                town.lanes[pair.to.lane].name,
                pair.to.s,
                watch.arrived ? "arrived" : "did not arrive",
                watch.sidewalk,
                watch.opposite,
                watch.height,
                watch.impulse,
                watch.where);
        }
        if (i + 1 == pairs.size() || pairs[i + 1].task != pair.task) {
            print_row(pair.task, ways);
            ways.clear();
        }
    }
    return fine && !pairs.empty();
}

}  // namespace
}  // namespace reprise

int main(int count, char** words) {
    std::string town_name;
    std::string what;
    std::string model = "sedan";
    std::uint64_t seed = 7;
    std::size_t every = 1;
    std::size_t sample = 1;
    CLI::App app("Drives routes through an empty town with the built-in driver, and watches it");
    app.add_option("town", town_name, "A town as reprise run --town takes it")->required();
    app.add_option("what", what, "TASKS.json, or how many random ways")->required();
    app.add_option("--model", model, "Of the vehicle")->capture_default_str();
    app.add_option("--seed", seed, "Of random ways")->capture_default_str();
    app.add_option("--every", every, "Only every N-th pair of the tasks")
        ->check(CLI::PositiveNumber);
    app.add_option("--sample", sample, "Only one in N, unless REPRISE_THOROUGH is set")
        ->check(CLI::PositiveNumber);
    CLI11_PARSE(app, count, words);
    try {
        const auto network = reprise::cli::load_town(town_name);
        const auto town = reprise::towns::read_town(network);
        const bool random = what.find_first_not_of("0123456789") == std::string::npos;
        const auto pairs = random ? reprise::random_pairs(town, std::stoi(what), seed)
                                  : reprise::pairs_of(town, what, every);
        const auto some = reprise::sample_of(pairs, std::getenv("REPRISE_THOROUGH") ? 1 : sample);
        return reprise::drive_all(network, town, some, model) ? 0 : 1;
    } catch (const std::exception& error) {
        std::cerr << error.what() << "\n";
        return 2;
    }
}
