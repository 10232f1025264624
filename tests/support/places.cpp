#include "tests/support/places.h"

#include <algorithm>

namespace reprise::test {

using world::LaneKind;
using world::LaneT;
using world::TownT;
using world::Vec3;

LaneT lane(const std::string& name, LaneKind kind, std::vector<Vec3> centre) {
    LaneT lane;
    lane.name = name;
    lane.edge = name.substr(0, name.rfind('_'));
    lane.kind = kind;
    lane.width = kind == LaneKind::sidewalk ? 2.5 : 3.5;
    lane.speed_limit = 13.89;
    lane.left = lane.right = lane.opposite = lane.junction = world::none;
    for (std::size_t i = 1; i < centre.size(); ++i)
        lane.length += std::hypot(centre[i].x() - centre[i - 1].x(),
                                  centre[i].y() - centre[i - 1].y(),
                                  centre[i].z() - centre[i - 1].z());
    lane.sumo_length = lane.length;
    lane.centre = std::move(centre);
    return lane;
}

namespace {

void settle(TownT& town) {
    std::sort(town.lanes.begin(), town.lanes.end(), [](const LaneT& one, const LaneT& other) {
        return one.name < other.name;
    });
}

}  // namespace

TownT t_junction(double slope) {
    const auto on_slope = [&](std::vector<std::pair<double, double>> points) {
        std::vector<Vec3> raised;
        for (const auto& [x, y] : points)
            raised.emplace_back(x, y, slope * x);
        return raised;
    };
    TownT town;
    town.name = "t_junction";
    const auto add = [&](const char* name,
                         LaneKind kind,
                         std::vector<std::pair<double, double>> points) -> LaneT& {
        town.lanes.push_back(lane(name, kind, on_slope(std::move(points))));
        return town.lanes.back();
    };
    add("west_in_1", LaneKind::driving, {{0, -1.75}, {40, -1.75}});
    add("west_out_1", LaneKind::driving, {{40, 1.75}, {0, 1.75}});
    add("east_in_1", LaneKind::driving, {{100, 1.75}, {60, 1.75}});
    add("east_out_1", LaneKind::driving, {{60, -1.75}, {100, -1.75}});
    add("south_in_1", LaneKind::driving, {{51.75, -60}, {51.75, -14}});
    add("south_out_1", LaneKind::driving, {{48.25, -14}, {48.25, -60}});
    add("west_in_0", LaneKind::sidewalk, {{0, -4.75}, {40, -4.75}});
    add("west_out_0", LaneKind::sidewalk, {{40, 4.75}, {0, 4.75}});
    add("east_in_0", LaneKind::sidewalk, {{100, 4.75}, {60, 4.75}});
    add("east_out_0", LaneKind::sidewalk, {{60, -4.75}, {100, -4.75}});
    add("south_in_0", LaneKind::sidewalk, {{54.75, -60}, {54.75, -14}});
    add("south_out_0", LaneKind::sidewalk, {{45.25, -14}, {45.25, -60}});
    add(":t_0_0", LaneKind::internal, {{40, -1.75}, {60, -1.75}});
    add(":t_1_0", LaneKind::internal, {{40, -1.75}, {46, -4}, {48.25, -14}});
    add(":t_2_0", LaneKind::internal, {{60, 1.75}, {40, 1.75}});
    add(":t_3_0", LaneKind::internal, {{60, 1.75}, {51, -2}, {48.25, -14}});
    add(":t_4_0", LaneKind::internal, {{51.75, -14}, {54, -4}, {60, -1.75}});
    add(":t_5_0", LaneKind::internal, {{51.75, -14}, {49, -2}, {40, 1.75}});
    LaneT& crossing = add(":t_c0_0", LaneKind::crossing, {{53.5, -12.5}, {46.5, -12.5}});
    crossing.width = 3;
    crossing.outline = on_slope({{46.5, -14}, {53.5, -14}, {53.5, -11}, {46.5, -11}});
    using Outline = std::vector<std::pair<double, double>>;
    const std::vector<Outline> corners{
        {{40, -6}, {44, -14}, {46.5, -14}, {46.5, -10}, {43, -3.5}, {40, -3.5}},
        {{60, -3.5}, {57, -3.5}, {53.5, -10}, {53.5, -14}, {56, -14}, {60, -6}},
        {{40, 3.5}, {60, 3.5}, {60, 6}, {40, 6}}};
    for (std::size_t i = 0; i < corners.size(); ++i)
        add((":t_w" + std::to_string(i) + "_0").c_str(),
            LaneKind::walking_area,
            {corners[i][0], corners[i][3]})
            .outline = on_slope(corners[i]);
    world::JunctionT junction;
    junction.name = "t";
    junction.outline = on_slope({{40, -6}, {44, -14}, {56, -14}, {60, -6}, {60, 6}, {40, 6}});
    junction.centre = Vec3(50, -4, slope * 50);
    town.junctions.push_back(junction);
    for (LaneT& part : town.lanes)
        if (part.edge.front() == ':')
            part.junction = 0;
    town.low = Vec3(0, -60, std::min(0.0, slope * 100));
    town.high = Vec3(100, 6, std::max(0.0, slope * 100));
    settle(town);
    return town;
}

TownT bend() {
    TownT town;
    town.name = "bend";
    town.lanes = {lane(":b_0_0",
                       LaneKind::internal,
                       {{8.386, 2.639, 0},
                        {5.852, 2.544, 0},
                        {4.039, 3.060, 0},
                        {2.946, 4.188, 0},
                        {2.574, 5.929, 0}}),
                  lane(":b_1_0",
                       LaneKind::internal,
                       {{-0.626, 5.911, 0},
                        {-0.019, 2.603, 0},
                        {1.759, 0.427, 0},
                        {4.707, -0.617, 0},
                        {8.826, -0.530, 0}}),
                  lane(":b_w0_0", LaneKind::walking_area, {{5.174, 5.944, 0}, {-3.226, 5.896, 0}}),
                  lane("east_in_0", LaneKind::driving, {{60, 9.797, 0}, {8.386, 2.639, 0}}),
                  lane("east_out_0", LaneKind::driving, {{8.826, -0.530, 0}, {60, 6.567, 0}}),
                  lane("north_in_0", LaneKind::sidewalk, {{-3.226, 60, 0}, {-3.226, 5.896, 0}}),
                  lane("north_in_1", LaneKind::driving, {{-0.626, 60, 0}, {-0.626, 5.911, 0}}),
                  lane("north_out_0", LaneKind::sidewalk, {{5.174, 5.944, 0}, {5.174, 60, 0}}),
                  lane("north_out_1", LaneKind::driving, {{2.574, 5.929, 0}, {2.574, 60, 0}})};
    for (LaneT& part : town.lanes)
        part.width = part.kind == LaneKind::sidewalk ? 2 : 3.2;
    town.lanes[2].outline = {{4.174, 5.938, 0},
                             {6.174, 5.949, 0},
                             {8.167, 4.224, 0},
                             {8.606, 1.054, 0},
                             {9.046, -2.115, 0},
                             {-4.226, 5.891, 0},
                             {-2.226, 5.902, 0}};
    const auto ahead = world::Turn::straight;
    town.lanes[3].links = {{8, 0, world::none, ahead, false, 0}};
    town.lanes[6].links = {{4, 1, world::none, ahead, false, 0}};
    town.lanes[0].links = {{8, world::none, world::none, ahead, false, 0}};
    town.lanes[1].links = {{4, world::none, world::none, ahead, false, 0}};
    town.junctions.resize(1);
    town.junctions[0].outline = {{8.167, 4.224, 0},
                                 {9.046, -2.115, 0},
                                 {1.697, -2.041, 0},
                                 {-2.726, 0.628, 0},
                                 {-4.226, 5.891, 0},
                                 {6.174, 5.949, 0}};
    for (const std::size_t part : {0, 1, 2})
        town.lanes[part].junction = 0;
    town.low = Vec3(-5, -3, 0);
    town.high = Vec3(61, 60, 1);
    return town;
}

TownT bridge() {
    TownT town;
    town.name = "bridge";
    town.lanes.push_back(lane("below_0", LaneKind::driving, {{-80, 0, 0}, {80, 0, 0}}));
    town.lanes.push_back(lane("over_0",
                              LaneKind::driving,
                              {{0, -80, 0}, {0, -60, 1}, {0, -20, 6}, {0, 20, 6}, {0, 80, 0}}));
    town.low = Vec3(-80, -80, 0);
    town.high = Vec3(80, 80, 6);
    settle(town);
    return town;
}

}  // namespace reprise::test
