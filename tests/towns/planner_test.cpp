#include "world/lanes/planner.h"

#include <cmath>
#include <filesystem>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <gtest/gtest.h>

#include "tests/support/towns.h"
#include "world/random.h"

// Ways over real networks, compared with those of Boost's Dijkstra over a graph that is built here.
namespace reprise::world {
namespace {

namespace fs = std::filesystem;
using Graph = boost::adjacency_list<boost::vecS,
                                    boost::vecS,
                                    boost::directedS,
                                    boost::no_property,
                                    boost::property<boost::edge_weight_t, double>>;

/// Every lane is cut at the start and at the goal; a vertex is the start of a piece.
class CutLanes {
  public:
    CutLanes(const TownT& town, LanePlace from, LanePlace to) : town_(town), from_(from), to_(to) {
        for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
            if (is_for_cars(town.lanes[i])) {
                for (std::size_t layer = 0; layer < layers; ++layer)
                    add_lane(i, layer % 2 == 1 ? entry(i) : 0, layer);
            }
    }

    double shortest() const {
        const std::size_t goal = layers * count();
        Graph graph(goal + 1);
        for (const auto& [source, target, weight] : ways_)
            boost::add_edge(source, target, weight, graph);
        std::vector<double> cost(goal + 1);
        boost::dijkstra_shortest_paths(
            graph, count() + from_.lane, boost::distance_map(cost.data()));
        return cost[goal];
    }

  private:
    /// Even: entered at the start; odd: where the way begins or beside. Two more for each change.
    static constexpr std::size_t layers = 18;

    std::size_t count() const { return town_.lanes.size(); }

    double entry(std::uint32_t lane) const {
        return from_.s * town_.lanes[lane].length / town_.lanes[from_.lane].length;
    }

    Eigen::Vector3d start(std::size_t vertex) const {
        const auto lane = static_cast<std::uint32_t>(vertex % count());
        return point_at(town_.lanes[lane], vertex / count() % 2 == 1 ? entry(lane) : 0).position;
    }

    void add(std::size_t source, std::size_t target, double weight, double extra = 0) {
        ways_.emplace_back(
            source, target, std::max(weight, (start(source) - start(target)).norm()) + extra);
    }

    static double change_cost(double room) { return room < 20 ? 10'000 : room < 40 ? 200 : 40; }

    void add_lane(std::uint32_t i, double at, std::size_t layer) {
        const LaneT& lane = town_.lanes[i];
        const std::size_t vertex = layer * count() + i;
        for (const Link& link : lane.links) {
            const std::uint32_t next = link.via() != none ? link.via() : link.to();
            if (next != none && is_for_cars(town_.lanes[next]))
                add(vertex, next, lane.length - at, link.turn() == Turn::around ? 1000 : 0);
        }
        const double room = (lane.length - at) / static_cast<double>(layer / 2 + 1);
        for (const std::uint32_t side : {lane.left, lane.right})
            if (side != none && town_.lanes[side].kind == LaneKind::driving && layer + 2 < layers)
                add(vertex, (layer + 2) * count() + side, change_cost(room));
        if (i != to_.lane || to_.s < at)
            return;
        // Who changes lanes on the last street must be done before the goal.
        const auto changes = static_cast<double>(layer / 2);
        const double more = layer < 2 ? 0
                                      : change_cost((to_.s - at) / changes) -
                                            change_cost((lane.length - at) / changes);
        ways_.emplace_back(vertex, layers * count(), to_.s - at + changes * more);
    }

    const TownT& town_;
    LanePlace from_;
    LanePlace to_;
    std::vector<std::tuple<std::size_t, std::size_t, double>> ways_;
};

LanePlace random_place(const TownT& town, std::uint64_t seed, std::uint64_t item) {
    for (std::uint64_t round = 0;; ++round) {
        const auto lane = static_cast<std::uint32_t>(
            draw_index(town.lanes.size(), seed, round, Purpose::scenario, 2 * item));
        if (town.lanes[lane].kind == LaneKind::driving)
            return {lane,
                    draw(seed, round, Purpose::scenario, 2 * item + 1) * town.lanes[lane].length};
    }
}

void expect_connected(const TownT& town, const Route& route, LanePlace from, LanePlace to) {
    EXPECT_EQ(route.pieces.front().lane, from.lane);
    EXPECT_EQ(route.pieces.front().from, from.s);
    EXPECT_EQ(route.pieces.back().lane, to.lane);
    EXPECT_EQ(route.pieces.back().to, to.s);
    double along = 0;
    for (const Route::Piece& piece : route.pieces) {
        EXPECT_NEAR(piece.start, along, 1e-6);
        EXPECT_LE(piece.from, piece.to + 1e-9);
        along += piece.to - piece.from;
    }
    EXPECT_NEAR(route.length, along, 1e-6);
    const std::vector<Eigen::Vector3d> line = centre_line(town, route);
    double drawn = 0;
    for (std::size_t i = 1; i < line.size(); ++i)
        drawn += (line[i] - line[i - 1]).norm();
    EXPECT_NEAR(drawn, route.length, 1 + 0.01 * route.length) << "no jumps";
    EXPECT_EQ(route.steps.front().begins, 0);
    EXPECT_EQ(route.steps.back().command, RouteCommand::reach_goal);
    for (std::size_t i = 1; i < route.steps.size(); ++i)
        EXPECT_GT(route.steps[i].begins, route.steps[i - 1].begins - 1e-9);
}

void expect_shortest_ways(const TownT& town, int pairs) {
    const Planner planner(town);
    int found = 0;
    for (int i = 0; i < pairs; ++i) {
        const auto item = static_cast<std::uint64_t>(2 * i);
        const LanePlace from = random_place(town, 7, item);
        const LanePlace to = random_place(town, 7, item + 1);
        SCOPED_TRACE(town.lanes[from.lane].name + " to " + town.lanes[to.lane].name);
        const double expected = CutLanes(town, from, to).shortest();
        const auto cost = planner.cost(from, to);
        const auto route = planner.plan(from, to);
        ASSERT_EQ(cost.has_value(), expected < 1e100);
        ASSERT_EQ(route.has_value(), cost.has_value());
        if (!route)
            continue;
        ++found;
        EXPECT_NEAR(*cost, expected, 1e-6);
        expect_connected(town, *route, from, to);
    }
    EXPECT_GT(found, pairs / 4);
}

class PlannerInTowns : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Own, PlannerInTowns, ::testing::Values("town1", "town2"));

TEST_P(PlannerInTowns, TakesTheShortestWays) {
    expect_shortest_ways(test::own_town(GetParam()).town, 200);
}

class PlannerInNets : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Others,
                         PlannerInNets,
                         ::testing::Values("quarter.net.xml",
                                           "Town04_sumo115.net.xml",
                                           "DRT/osm.net.xml"),
                         [](const auto& net) {
                             const std::string name = net.param;
                             return name.substr(0, name.find_first_of("/_."));
                         });

TEST_P(PlannerInNets, TakesTheShortestWays) {
    fs::path path = test::own_map(GetParam());
    if (!fs::exists(path))
        path = test::real_map(GetParam());
    if (!fs::exists(path))
        GTEST_SKIP() << test::missing_map(path);
    expect_shortest_ways(test::load(path).town, 20);
}

/// A roundabout is several junctions of SUMO's and one for its driver.
TEST(PlannerInTown1, ARoundaboutIsOneCommand) {
    const TownT& town = test::own_town("town1").town;
    const Planner planner(town);
    const auto command = [&](const char* from, const char* to) {
        const auto route = planner.plan({test::lane(town, from), 5}, {test::lane(town, to), 20});
        EXPECT_TRUE(route);
        std::string said;
        for (const Route::Step& step : route->steps)
            if (step.command != RouteCommand::follow_lane)
                said += std::string(name_of(step.command)) + " ";
        return said;
    };
    EXPECT_EQ(command("m1_m2s_1", "m2n_t2_1"), "straight reach_goal ");
    EXPECT_EQ(command("m1_m2s_1", "m2e_c3_1"), "right reach_goal ");
    EXPECT_EQ(command("m1_m2s_1", "m2w_a3_1"), "left reach_goal ");
    EXPECT_EQ(command("a3_m2w_1", "m2n_t2_1"), "left reach_goal ");
}

}  // namespace
}  // namespace reprise::world
