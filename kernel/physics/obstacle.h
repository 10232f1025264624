#pragma once

#include <memory>
#include <vector>

#include "kernel/physics/bullet.h"
#include "world/town_generated.h"

namespace reprise::kernel {

/// Something that stands beside the road and stops a car.
struct Obstacle {
    enum class Shape : std::uint8_t { box, cylinder, prism };

    btVector3 position;  ///< middle of the foot, on the ground
    double yaw = 0;
    btVector3 half;     ///< half sizes; a cylinder's are (radius, radius, half height)
    double radius = 0;  ///< of the bounding circle
    Shape shape = Shape::box;
    std::vector<btVector3> corners = {};  ///< a prism's foot, seen from its middle: convex
    double depth = 0;  ///< of its lower end below the ground: a building's foundation
};

/// Buildings (drawn ones in convex pieces), trunks, the wood of bushes, poles, street furniture and
/// parked vehicles. Sorted by x, then by their order in the town.
std::vector<Obstacle> obstacles_of(const world::TownT& town);

/// Its middle is half its height above its lower end.
std::unique_ptr<btCollisionShape> make_shape(const Obstacle& obstacle);

}  // namespace reprise::kernel
