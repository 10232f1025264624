#pragma once

#include <algorithm>
#include <cmath>

#include "kernel/physics/bullet/bullet.h"

namespace reprise::kernel {

/// A box anywhere: its middle, and half of its length, width and height.
struct PlacedBox {
    btTransform pose;
    btVector3 half;
};

/// How far two boxes are apart, as the largest gap along any of the 15 axes that can tell two boxes
/// apart (S. Gottschalk et al., "OBBTree", SIGGRAPH 1996): never more than the true distance.
/// Negative where they reach into each other. [m]
inline double gap_between(const PlacedBox& one, const PlacedBox& other) {
    constexpr double parallel = 1e-6;  // edges whose cross product says nothing
    const auto extent = [](const PlacedBox& box, const btVector3& along) {  // to either side
        double sum = 0;
        for (int axis = 0; axis < 3; ++axis)
            sum += box.half[axis] * std::abs(along.dot(box.pose.getBasis().getColumn(axis)));
        return sum;
    };
    const btVector3 apart = other.pose.getOrigin() - one.pose.getOrigin();
    double gap = -1e300;
    const auto look_along = [&](const btVector3& axis) {
        gap = std::max(gap, std::abs(apart.dot(axis)) - extent(one, axis) - extent(other, axis));
    };
    for (int axis = 0; axis < 3; ++axis) {
        look_along(one.pose.getBasis().getColumn(axis));
        look_along(other.pose.getBasis().getColumn(axis));
    }
    for (int mine = 0; mine < 3; ++mine)
        for (int its = 0; its < 3; ++its) {
            const btVector3 across =
                one.pose.getBasis().getColumn(mine).cross(other.pose.getBasis().getColumn(its));
            if (across.length2() > parallel)
                look_along(across.normalized());
        }
    return gap;
}

}  // namespace reprise::kernel
