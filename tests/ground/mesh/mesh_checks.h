#pragma once

#include <cmath>
#include <cstddef>

#include <Eigen/Core>

#include "ground/mesh/ground.h"
#include "world/town.h"

/// What is to hold of the ground of any town.
namespace reprise::test {

/// Half a car's track and a bit, both sides of every path.
template <typename Visit>
void for_each_wheel(const world::TownT& town, Visit&& visit) {
    for (const world::LaneT& lane : town.lanes) {
        if (!world::is_for_cars(lane))
            continue;
        for (double s = 0.05; s < lane.length; s += 0.7)
            for (const double t : {-0.9, 0.0, 0.9}) {
                const world::LanePoint at = world::point_at(lane, s);
                visit(lane,
                      Eigen::Vector3d(at.position.x() - t * std::sin(at.yaw),
                                      at.position.y() + t * std::cos(at.yaw),
                                      at.position.z()));
            }
    }
}

void expect_road_under_every_wheel(const world::TownT& town);

/// Not empty, no slivers; kerbs are upright, decks look down, all else looks up.
void expect_well_formed(const ground::GroundMesh& mesh);

/// Of triangle `i`; as long as twice its area.
Eigen::Vector3d normal_of(const ground::GroundMesh& mesh, std::size_t i);

/// The first surface from 1 m above; `marking`, which no ground has, where there is none.
ground::Surface surface_at(const ground::GroundMesh& mesh, double x, double y, double z = 0);

}  // namespace reprise::test
