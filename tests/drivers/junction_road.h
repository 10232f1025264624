#pragma once

#include "tests/drivers/kinematic_car.h"
#include "world/town.h"

namespace reprise::test {

/// A lane east along y = 0 from x = 0 to 200, a junction of 10 m, and on to x = 410. A lane north
/// along x = 205 crosses inside the junction. Neither has a signal; `yields`: the eastbound gives
/// way.
inline world::TownT junction_road(bool yields) {
    using world::LaneKind;
    world::TownT town;
    town.name = "crossing";
    town.lanes = {
        make_lane("west", Turtle(0, 0, 0).ahead(200)),
        make_lane(":0", Turtle(200, 0, 0).ahead(10), 13.89, LaneKind::internal),
        make_lane("east", Turtle(210, 0, 0).ahead(200)),
        make_lane("south", Turtle(205, -205, std::numbers::pi / 2).ahead(200)),
        make_lane(":1", Turtle(205, -5, std::numbers::pi / 2).ahead(10), 13.89, LaneKind::internal),
        make_lane("north", Turtle(205, 5, std::numbers::pi / 2).ahead(200))};
    town.junctions.resize(1);
    town.lanes[0].junction = town.lanes[3].junction = 0;
    town.lanes[0].links = {make_link(2, 1, world::Turn::straight, yields)};
    town.lanes[1].links = {make_link(2, world::none, world::Turn::straight)};
    town.lanes[3].links = {make_link(5, 4, world::Turn::straight, !yields)};
    town.lanes[4].links = {make_link(5, world::none, world::Turn::straight)};
    return town;
}

}  // namespace reprise::test
