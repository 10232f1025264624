#include "kernel/physics/box_gap.h"

#include <algorithm>

namespace reprise::kernel {

namespace {

/// [m] of the box to either side of its middle, along a direction of length 1.
double extent(const PlacedBox& box, const btVector3& along) {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis)
        sum += box.half[axis] * std::abs(along.dot(box.pose.getBasis().getColumn(axis)));
    return sum;
}

}  // namespace

double gap_between(const PlacedBox& one, const PlacedBox& other) {
    constexpr double parallel = 1e-6;  // edges whose cross product says nothing
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
