#include "traffic/drawn_buildings.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "traffic/building_choice.h"
#include "traffic/draws.h"
#include "traffic/floors.h"

namespace reprise::traffic {

namespace {

using Eigen::Vector2d;
using world::Purpose;

constexpr double overlap_allowed = 0.5;  ///< [m] a drawn building may reach into a lane
constexpr double smallest_drawn = 2;     ///< [m2]

/// Does no wall of it reach into a lane by more than is allowed?
bool leaves_lanes_free(const world::Loop& loop, const Clearance& lanes) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vector2d along = loop[(i + 1) % loop.size()] - loop[i];
        const double yaw = std::atan2(along.y(), along.x());
        if (!lanes.is_clear({loop[i] + along / 2, yaw, along.norm(), 0}, 0))
            return false;
    }
    return true;
}

}  // namespace

void keep_drawn_buildings(Land& land) {
    Clearance lanes(1);
    for (const world::LaneT& lane : land.town.lanes)
        if (world::is_for_cars(lane))
            lanes.add_line(lane.centre, std::max(0.1, lane.width / 2 - overlap_allowed));
    const Districts districts(land);
    for (std::size_t i = 0; i < land.place.buildings.size(); ++i) {
        world::DrawnBuildingT drawn = land.place.buildings[i];
        const double area = world::signed_area(world::in_plan(drawn.outline));
        if (std::abs(area) < smallest_drawn)
            continue;
        if (area < 0)
            std::reverse(drawn.outline.begin(), drawn.outline.end());
        const world::Loop loop = world::in_plan(drawn.outline);
        if (!leaves_lanes_free(loop, lanes))
            continue;
        set_floor(land, drawn);
        Draws draws(land.seed, Purpose::building_model, 1U << 24 | i);
        if (drawn.style == 0)
            drawn.style = draws.style();
        if (drawn.model == 0)
            drawn.model =
                1 + choose_model(districts.at(loop[0]), Situation::street, draws.between(0, 1));
        land.town.drawn_buildings.push_back(std::move(drawn));
        land.solid.add_polygon(loop);
        land.buildings.add_polygon(loop);
    }
}

}  // namespace reprise::traffic
